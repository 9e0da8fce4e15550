#include <thinwall/experiments/extremes/summary.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/extremes/breaks.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

bool all_of_them(const std::vector<LadderTest>& tests) {
  return std::all_of(tests.begin(), tests.end(), [](const LadderTest& t) { return t.passed(); });
}

std::string place_text(const Arm& arm, double value) {
  return fmt::format("{} {}", info(arm.axis).title, rounded_text(value, 2));
}

/// "distance / R 1000 (verdict), scale 1e+20 (nan)"; empty where it survives everything.
std::string breaks_text(const std::vector<ExtremeLine>& lines, std::string_view method, std::size_t precision) {
  std::string text;
  for (const Arm& arm : all_arms()) {
    const Survival s = survival(lines, arm, method, precision);
    if (!s.broken) continue;
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", place_text(arm, *s.broken), name(s.flaw));
  }
  return text;
}

std::string closed_form_text(const std::vector<ExtremeLine>& lines, const std::vector<LadderTest>& tests) {
  double forward = 0;
  std::int64_t cells = 0;
  for (const LadderTest& t : tests) {
    if (t.what != "closed_form_forward") continue;
    forward = std::max(forward, t.measured);
    cells += t.cells;
  }
  if (cells == 0) return "";
  std::string text = fmt::format(
      "Where contact lasts longer than {} u of the path until it, the closed form's time is off by at most {:.2f} u kappa t in "
      "all {} cells. ",
      least_contact, forward, grouped_text(cells));
  for (const std::size_t p : precisions_of(lines)) {
    const std::string breaks = breaks_text(lines, "closed_form", p);
    if (!breaks.empty()) text += fmt::format("In {} it breaks at {}. ", all_precisions()[p].title, breaks);
  }
  return text;
}

std::string foil_text(const std::vector<ExtremeLine>& lines) {
  std::string text;
  const Arm& far = *std::find_if(all_arms().begin(), all_arms().end(),
                                 [](const Arm& arm) { return arm.axis == ExtremeAxis::distance; });
  for (const std::size_t p : precisions_of(lines)) {
    const Survival s = survival(lines, far, "textbook", p);
    if (!s.survived && !s.broken) continue;
    text +=
        fmt::format("{}{} in {}", text.empty() ? "" : ", ",
                    s.broken ? "from " + rounded_text(*s.broken, 2) : std::string("never"), all_precisions()[p].title);
  }
  return text.empty() ? "" : fmt::format("The textbook forms break at distances over R {}. ", text);
}

/// Of the methods, in double or the last precision there is: who survives how many of the arms.
std::string survivors_text(const std::vector<ExtremeLine>& lines) {
  const std::vector<std::size_t> precisions = precisions_of(lines);
  if (precisions.empty()) return "";
  const std::size_t p = std::find(precisions.begin(), precisions.end(), 1U) != precisions.end() ? 1 : precisions.back();
  std::string text;
  for (const std::string_view method : methods_of(lines, p)) {
    std::int64_t asked = 0, survived = 0, at_once = 0;
    for (const Arm& arm : all_arms()) {
      const Survival s = survival(lines, arm, method, p);
      if (!s.survived && !s.broken) continue;
      ++asked;
      survived += s.broken ? 0 : 1;
      at_once += s.survived ? 0 : 1;
    }
    if (at_once > asked / 2) continue;  // it does not find the time where nothing is extreme
    text += fmt::format("{}{} {} of {}", text.empty() ? "" : ", ", method, survived, asked);
  }
  return text.empty() ? "" : fmt::format("In {}, of the ways outward survived: {}.", all_precisions()[p].title, text);
}

}  // namespace

std::string extreme_answer(const std::vector<ExtremeLine>& lines, const std::vector<LadderTest>& tests) {
  const std::string text = closed_form_text(lines, tests) + foil_text(lines) + survivors_text(lines);
  return text.empty() ? "No query was asked: see the tables." : text;
}

std::string extreme_summary(const std::vector<ExtremeLine>& lines, const std::vector<LadderTest>& tests) {
  std::string text;
  for (const std::size_t p : precisions_of(lines)) {
    const std::vector<std::string_view> methods = methods_of(lines, p);
    if (methods.empty()) continue;
    text += fmt::format("{:<25}{:>9}", all_precisions()[p].title, "ns");
    for (const Arm& arm : all_arms()) text += fmt::format("{:>7}", arm.name);
    text += "\n";
    for (const std::string_view method : methods) {
      text += fmt::format("{:<25}{:>9.0f}", method, nanoseconds_of(lines, method, p));
      for (const Arm& arm : all_arms()) text += fmt::format("{:>7}", short_text(survival(lines, arm, method, p), arm));
      text += "\n";
    }
    text += "\n";
  }
  if (!text.empty()) {
    text +=
        "The power of ten at which each first breaks, and why: v a verdict wrong by more than 4 u,\n"
        "e a time off by more than 100 u kappa t, n no number, g gave up; all: where nothing is extreme;\n"
        "-: never. Small, large: scale. Far: distance / R. Slow, fast: speed / R. Offset: / R. Grazing: 1 - b/R.\n"
        "Textbook: the foil. ns: a query of a ball and a box.\n\n";
  }
  std::int64_t passed = 0;
  std::string failed;
  for (const LadderTest& t : tests) {
    passed += t.passed() ? 1 : 0;
    if (t.passed()) continue;
    failed += fmt::format("FAILED: {}, {}: {:.3g}, allowed {:.3g} to {:.3g}, at {}.\n", t.what,
                          all_precisions()[t.precision].title, t.measured, t.least, t.most, t.where);
  }
  return text + fmt::format("Self-test: {} of {} passed.\n{}", passed, tests.size(), failed);
}

std::vector<Section> extreme_sections(const std::vector<LadderTest>& tests) {
  return {
      {"What is asked",
       "One thing at a time is made extreme: the scale of all lengths, the distance, the speed, the thickness of a wall and of what "
       "is fired at it, the offset from the origin, the angle to grazing, the ratio of sizes. Four pairs of shapes are put to "
       "every method, all pairs to the closed form in float and double. The methods' own kernels run in each precision: the front "
       "door, which computes a float query in double, is left out. The methods that have a tolerance are given the finest.\n\nQueries "
       "are drawn in doubles and rounded to each precision. Every answer is judged by the truth about the rounded query, so that no "
       "method is blamed for what rounding did to its input. Far from the origin that is most of what goes wrong: see "
       "the figure of representation."},
      {"Foils",
       "The rows called textbook are the closed forms as the textbooks have them: the quadratic formula for two balls, widened slabs "
       "with the same quadratic at edges and corners, fifteen axes for boxes, without a guard. They are there to be beaten."},
      {"Oracle",
       "First contact at 110 digits, at 220 for the queries at 50, from support functions alone. It shares no code with any method."},
      {"What counts as broken",
       "A verdict that is wrong though its input would have to change by more than 4 u to make it right; a time that is off by more "
       "than 100 u kappa t, two decimals; no number; or an answer withheld. Some methods claim less than that: what they claim "
       "is on their page."},
      {"Self-test",
       "Where contact lasts longer than 64 u of the path until it, the closed form keeps its contract in every precision and on "
       "every pair: 4 u kappa t forward, 4 u backward, no verdict wrong by more than 4 u, an answer always. Between two balls the "
       "textbook's loss is at most 16 times u (d/R)^2 / 2 of the radius and the same at all distances, and its verdicts go wrong "
       "within a decade of d/R = 1/sqrt(u). " +
           std::string(all_of_them(tests) ? "All of it holds." : "Not all of it holds: see the table.")},
      {"Limits",
       "Random queries, not worst cases. The axes are not crossed with each other. Times are of a few dozen queries that lie in the "
       "cache."},
  };
}

}  // namespace thinwall
