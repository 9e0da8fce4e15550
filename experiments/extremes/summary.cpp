#include <thinwall/experiments/extremes/summary.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

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
std::string breaks_text(const std::vector<ExtremeLine>& lines, std::string_view method, std::size_t precision,
                        PairSet pairs) {
  std::string text;
  for (const Arm& arm : all_arms()) {
    const Survival s = survival(lines, arm, method, precision, pairs);
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
      "The closed form's time is off by at most {1:.2f} u kappa t in all {2} cells in which contact lasts longer than {0} u of "
      "the path until it. ",
      least_contact, forward, grouped_text(cells));
  for (const std::size_t p : precisions_of(lines)) {
    const std::string breaks = breaks_text(lines, "closed_form", p, PairSet::four);
    if (!breaks.empty()) text += fmt::format("In {} it breaks at {}. ", all_precisions()[p].title, breaks);
  }
  return text;
}

/// Between two balls, along the distance: where the foil's verdicts first go wrong.
std::string foil_text(const std::vector<ExtremeLine>& lines) {
  std::string text;
  for (const std::size_t p : precisions_of(lines)) {
    double first = std::numeric_limits<double>::infinity();
    bool asked = false;
    for (const ExtremeLine& line : lines) {
      if (!matches(line, {.method = "textbook", .precision = p}) || line.pair->name != "sphere_sphere") continue;
      if (line.place.axis != ExtremeAxis::distance || line.tally.queries == 0) continue;
      asked = true;
      if (line.tally.far_wrong > 0) first = std::min(first, line.place.value);
    }
    if (!asked) continue;
    text += fmt::format("{}{} in {}", text.empty() ? "" : ", ",
                        std::isfinite(first) ? "from " + rounded_text(first, 2) : std::string("never"),
                        all_precisions()[p].title);
  }
  return text.empty() ? ""
                      : fmt::format("The textbook's verdicts on two balls go wrong at a distance over R {}. ", text);
}

/// Of the methods, in double or the last precision there is: where those break that do not at once.
std::string survivors_text(const std::vector<ExtremeLine>& lines) {
  const std::vector<std::size_t> precisions = precisions_of(lines);
  if (precisions.empty()) return "";
  const std::size_t p = std::find(precisions.begin(), precisions.end(), 1U) != precisions.end() ? 1 : precisions.back();
  std::string text;
  for (const std::string_view method : methods_of(lines, p, PairSet::rounded)) {
    if (method == "closed_form" || breaks_at_once(lines, method, p, PairSet::rounded)) continue;
    const std::string breaks = breaks_text(lines, method, p, PairSet::rounded);
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", method, breaks.empty() ? "nowhere" : breaks);
  }
  return text.empty() ? ""
                      : fmt::format("In {}, on pairs with a ball, the others first break at: {}.",
                                    all_precisions()[p].title, text);
}

/// A row a method that does not break at once, and the names of those that do.
std::string block(const std::vector<ExtremeLine>& lines, std::size_t p, PairSet pairs) {
  std::string rows, others;
  for (const std::string_view method : methods_of(lines, p, pairs)) {
    if (breaks_at_once(lines, method, p, pairs)) {
      others += fmt::format("{}{}", others.empty() ? "" : ", ", method);
      continue;
    }
    rows += fmt::format("{:<25}{:>10.0f}", method, nanoseconds_of(lines, method, p, pairs));
    for (const Arm& arm : all_arms()) rows += fmt::format("{:>7}", short_text(survival(lines, arm, method, p, pairs)));
    rows += "\n";
  }
  if (rows.empty() && others.empty()) return "";
  std::string text = fmt::format(
      "{:<25}{:>10}",
      fmt::format("{}, {}", all_precisions()[p].title, pairs == PairSet::boxes ? "two boxes" : "with a ball"), "ns");
  for (const Arm& arm : all_arms()) text += fmt::format("{:>7}", arm.name);
  text += "\n" + rows;
  constexpr std::size_t width = 96;
  std::string line = "at once: ";
  for (std::size_t at = 0; at < others.size();) {
    const std::size_t comma = std::min(others.find(", ", at), others.size());
    const std::string name = others.substr(at, comma - at) + (comma < others.size() ? ", " : "");
    if (line.size() + name.size() > width) {
      text += line + "\n";
      line = "  ";
    }
    line += name;
    at = comma + 2;
  }
  return text + (others.empty() ? "" : line + "\n") + "\n";
}

}  // namespace

std::string extreme_answer(const std::vector<ExtremeLine>& lines, const std::vector<LadderTest>& tests) {
  const std::string text = closed_form_text(lines, tests) + foil_text(lines) + survivors_text(lines);
  return text.empty() ? "No query was asked: see the tables." : text;
}

std::string extreme_summary(const std::vector<ExtremeLine>& lines, const std::vector<LadderTest>& tests) {
  std::string text;
  for (const PairSet pairs : {PairSet::rounded, PairSet::boxes}) {
    for (const std::size_t p : precisions_of(lines)) text += block(lines, p, pairs);
  }
  if (!text.empty()) {
    text +=
        "The power of ten at which each first breaks, and why: v a verdict wrong by more than 4 u, e a\n"
        "time off by more than 100 u kappa t, n no number, g gave up; all: at the first value; -: never.\n"
        "Small, large: scale. Far, offset: over R. Slow, fast: speed / R. Graze: 1 - b/R. Unequal: sizes.\n"
        "Textbook is a foil. At once: the methods that break at most first values; they claim less.\n\n";
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
       "Where contact lasts longer than 64 u of the path until it (the forward error: and where the path is not within 64 u of "
       "the last that touches), the closed form keeps its contract in every precision and on "
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
