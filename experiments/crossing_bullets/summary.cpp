#include <thinwall/experiments/crossing_bullets/summary.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/text/numbers.hpp>
#include <thinwall/swept/methods.hpp>

namespace thinwall {

namespace {

double share(double part, std::int64_t whole) { return whole > 0 ? part / static_cast<double>(whole) : 0; }
double share(std::int64_t part, std::int64_t whole) { return share(static_cast<double>(part), whole); }
std::string percent(double x) { return fmt::format("{:.1f} %", 100 * x); }

std::string confirm_answer(const std::vector<CrossingLine>& lines, const CrossingTotal& total) {
  const CrossingTally& t = total.tally;
  std::string text = fmt::format(
      "Of {} true hits the tutorial's rule for two bodies misses {} (theory {}; {} to {} from cell to cell)",
      grouped_text(t.touching), percent(share(t.missed, t.touching)), percent(share(total.missed_theory, t.touching)),
      percent(total.least_missed), percent(total.most_missed));
  for (const CrossingLine& line : lines) {
    if (line.crossing == head_on && line.rule == total.rule) {
      text += fmt::format(", and {} where two bullets meet head-on",
                          percent(share(line.tally.missed, line.tally.touching)));
    }
  }
  text += fmt::format(
      ". It looks once, when a ray from the faster center enters the slower one's track. In {} of the misses the ray, which "
      "has no radius, does not enter during the step; in {} it enters before the other ball arrives, in {} after that has "
      "gone, and in {} it starts inside the track and looks at the start alone. ",
      percent(share(t.causes.beside, t.missed)), percent(share(t.causes.too_early, t.missed)),
      percent(share(t.causes.too_late, t.missed)), percent(share(t.causes.inside, t.missed)));
  if (t.timed > 0) {
    text += fmt::format("Its {} hits come {:.3g} of a step late on average, and up to {:.3g}. ", grouped_text(t.timed),
                        share(std::ldexp(static_cast<double>(t.lateness), -32), t.timed), t.latest);
  }
  return text;
}

std::string row(const std::string& name, const CrossingTally& t, const std::optional<double>& missed_theory) {
  const std::int64_t apart = t.shots - t.touching;
  const bool timed = t.timed > 0;
  return fmt::format(
      "{:<25}{:>11} {:>11} {:>9} {:>9} {:>10} {:>9} {:>9}\n", name, grouped_text(t.touching), grouped_text(t.missed),
      percent(share(t.missed, t.touching)), missed_theory ? percent(*missed_theory) : "-", grouped_text(t.false_hits),
      apart > 0 ? percent(share(t.false_hits, apart)) : "-", timed ? fmt::format("{:.3g}", t.latest) : "-");
}

constexpr const char* head = "{:<25}{:>11} {:>11} {:>9} {:>9} {:>10} {:>9} {:>9}\n";

std::string header() {
  return fmt::format(fmt::runtime(head), "rule", "true hits", "missed", "share", "theory", "false hits", "of apart",
                     "late max");
}

template <class Tests> bool all_of_them(const Tests& tests) {
  return std::all_of(tests.begin(), tests.end(), [](const auto& test) { return test.passed(); });
}

}  // namespace

bool CrossingVerdicts::passed() const { return all_passed(counts) && all_of_them(times); }

std::string crossing_answer(const std::vector<CrossingLine>& lines, const std::vector<CrossingTotal>& totals) {
  std::string rule, sweeping, exact;
  for (const CrossingTotal& total : totals) {
    const CrossingTally& t = total.tally;
    const std::int64_t apart = t.shots - t.touching;
    if (total.rule == SweepThenConfirm<double>::name && t.touching > 0) rule = confirm_answer(lines, total);
    if (total.rule == "swept_overlap") {
      sweeping = fmt::format(
          "Sweeping both and testing what they sweep misses {} of {} true hits, and calls {} of {} encounters that do not "
          "touch a hit ({}). ",
          grouped_text(t.missed), grouped_text(t.touching), grouped_text(t.false_hits), grouped_text(apart),
          percent(share(t.false_hits, apart)));
    }
    if (total.rule == ClosedForm<double>::name) {
      exact = fmt::format("The closed form of the relative motion is wrong on {} of {}.",
                          grouped_text(t.missed + t.false_hits + t.undecided), grouped_text(t.shots));
    }
  }
  std::string text = rule + sweeping + exact;
  for (const CrossingTotal& total : totals) {
    if (!text.empty()) break;
    text = fmt::format("{} misses {} of {} true hits and makes {} false ones.", total.rule,
                       grouped_text(total.tally.missed), grouped_text(total.tally.touching),
                       grouped_text(total.tally.false_hits));
  }
  return text;
}

std::string crossing_summary(const std::vector<CrossingLine>& lines, const std::vector<CrossingTotal>& totals,
                             const CrossingVerdicts& verdicts) {
  std::string text =
      fmt::format("Two bullets head-on at {} m/s, {:.0f} steps a second, radius {} mm: all of them touch.\n",
                  head_on.speed, 1 / head_on.step, head_on.radius * 1e3);
  text += header();
  for (const CrossingLine& line : lines) {
    if (line.crossing == head_on) text += row(line.rule, line.tally, missed_share_theory(line));
  }
  text += fmt::format(
      "\nAll {} cells. Share: of the true hits. Of apart: of the encounters that do not touch.\nLate max: in steps.\n",
      lines.size() / totals.size());
  text += header();
  for (const CrossingTotal& total : totals) {
    text += row(total.rule, total.tally,
                total.has_theory ? std::optional(share(total.missed_theory, total.tally.touching)) : std::nullopt);
  }
  text += fmt::format("\nSelf-test: counts {}, times {}.\n", all_passed(verdicts.counts) ? "passed" : "FAILED",
                      all_of_them(verdicts.times) ? "passed" : "FAILED");
  return text;
}

std::vector<Section> crossing_sections(const CrossingVerdicts& verdicts) {
  return {
      {"What is asked",
       "Two balls of one radius fly straight through one step. Their centers pass each other within a disc across the "
       "relative motion, uniformly; where in the step is uniform too: first contact where they touch, closest approach where "
       "they do not. So nothing touches at the start, and every rule gets the same encounters.\n\nswept_overlap sweeps both "
       "over the whole step and tests the two capsules, without a time. sweep_then_confirm is the tutorial's rule for two "
       "bodies. end_of_step is what two bullets get in an engine that sweeps a bullet against everything but other bullets: a "
       "test of the poses."},
      {"Oracle",
       "Whether and when the balls touch is the quadratic of their squared distance, in long double, from the encounter's own "
       "numbers. It shares no code with the rules."},
      {"Theory",
       "The starts that touch, that overlap when swept and that the tutorial's rule confirms are volumes in the space of "
       "relative positions; docs/crossing_bullets.md derives them. They share nothing with the rules: the confirmed ones are a flux "
       "through the track's surface, and no ray is cast."},
      {"Self-test",
       "Where theory is exactly 0 or 1 the count must be. Where at least 5 events are expected and 5 not to be, the number of 95 % "
       "Wilson intervals that hold the theory must lie in the central 99.9 % of its binomial distribution, and the sum of squared "
       "standard residuals in that of its chi-square. The mean lateness of the tutorial's rule is held against theory in the same "
       "way; no answered time may be one at which the balls are apart.\n\n" +
           self_test_text(verdicts.counts)},
      {"Limits",
       "Two balls of one radius, straight motion, one step. Totals over all cells weigh them alike and depend on which are asked; "
       "the range over the cells and the table of cells do not."},
  };
}

}  // namespace thinwall
