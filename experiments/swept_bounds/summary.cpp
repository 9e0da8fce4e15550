#include <thinwall/experiments/swept_bounds/summary.hpp>

#include <fmt/format.h>

#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

std::string percent(double x) { return fmt::format("{:.1f} %", 100 * x); }
std::string percent(const std::optional<double>& x) { return x ? percent(*x) : "-"; }

std::string spoken(std::string text) {
  if (text == "enclosing_aabb") return "enclosing AABB";
  for (char& letter : text) letter = letter == '_' ? ' ' : letter;
  return text;
}

/// "enclosing sphere 85.8 % (theory 85.9 %), capsule 0.0 % (theory 0.0 %)", of the bounds that are volumes.
std::string diagonal_answer(const std::vector<SweepLine>& lines, const Sweep& diagonal) {
  std::string text;
  for (const SweepLine& l : lines) {
    if (l.sweep != diagonal || !l.is_volume || l.tally.reported == 0) continue;
    text += fmt::format("{}{} {} (theory {})", text.empty() ? "" : ", ", spoken(l.bound),
                        percent(false_fraction(l.tally)), percent(l.theory.false_fraction));
  }
  return text;
}

/// "1.9 widths (cube), 1.0 (plate)", in the direction of the view.
std::string turning_answer(const std::vector<SweepTotal>& totals, Sweep view) {
  std::string text;
  for (const SweepTotal& t : totals) {
    if (t.bound != "oriented_box") continue;
    view.form = t.form;
    const std::optional<double> widths = path_to_turn_for(view);
    if (widths) text += fmt::format("{}{:.2f} ({})", text.empty() ? "" : ", ", *widths, name(t.form));
  }
  if (text.empty()) return "";
  return fmt::format(
      "At {:g} degrees from x, turned by {:g}, the oriented box makes fewer false hits than the enclosing "
      "one on paths longer than, in widths, {}, and more on shorter ones. ",
      view.angle_deg, view.turn_deg, text);
}

std::string row(const SweepLine& l) {
  const Interval bar = l.tally.reported > 0 ? wilson(l.tally.false_hits, l.tally.reported) : Interval{0, 1};
  return fmt::format("{:<7} {:<17} {:>9} {:>9} {:>8} {:>17} {:>8} {:>8} {:>7}\n", name(l.sweep.form), l.bound,
                     grouped_text(l.tally.reported), grouped_text(l.tally.false_hits), percent(false_fraction(l.tally)),
                     fmt::format("[{:.1f}, {:.1f}] %", 100 * bar.lower, 100 * bar.upper),
                     percent(l.theory.false_fraction), percent(l.theory.empty), grouped_text(l.tally.missed));
}

std::string row(const SweepTotal& t) {
  return fmt::format("{:<7} {:<17} {:>6} {:>12} {:>7} {:>12} {:>12} {:>8} {:>8}\n", name(t.form), t.bound,
                     grouped_text(t.cells), grouped_text(t.tally.touching + t.tally.grazing),
                     grouped_text(t.tally.missed), grouped_text(t.tally.reported), grouped_text(t.tally.false_hits),
                     percent(t.least_false), percent(t.most_false));
}

std::string row(const SweepCost& c) {
  const auto ns = [](double time) { return fmt::format("{:.3g}", time); };
  return fmt::format("{:<7} {:<17} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>7} {:>6}-{}\n", name(c.sweep.form), c.bound,
                     percent(c.reported), percent(c.false_hits), ns(c.build_ns), ns(c.test_ns),
                     c.false_ns ? ns(*c.false_ns) : "-", ns(c.wasted_ns()), ns(c.pair_ns), ns(c.pair_lower_ns),
                     ns(c.pair_upper_ns));
}

}  // namespace

std::string sweep_answer(const std::vector<SweepLine>& lines, const std::vector<SweepTotal>& totals,
                         const Sweep& view) {
  std::string text;
  for (const Sweep& diagonal : diagonals) {
    const std::string shares = diagonal_answer(lines, diagonal);
    if (shares.empty()) continue;
    text += fmt::format(
        "Of what is reported when a {} moves {:.2f} widths along a diagonal among balls as wide, false are: {}. ",
        name(diagonal.form), path_in_widths(diagonal), shares);
  }
  std::int64_t missed = 0, touched = 0;
  for (const SweepTotal& t : totals) {
    missed += t.tally.missed;
    touched += t.tally.touching + t.tally.grazing;
  }
  return text + turning_answer(totals, view) +
         fmt::format("Of {} balls that are touched the bounds miss {}.", grouped_text(touched), grouped_text(missed));
}

std::string sweep_summary(const std::vector<SweepLine>& lines, const std::vector<SweepTotal>& totals,
                          const std::vector<SelfTest>& tests, const std::vector<SweepCost>& costs, const Sweep& view) {
  const Sweep& seen = diagonals[0];
  std::string text = fmt::format(
      "A ball and a cube {} cm wide at {} m/s, {:.0f} steps a second, along a diagonal, among balls as wide.\n"
      "{:<7} {:<17} {:>9} {:>9} {:>8} {:>17} {:>8} {:>8} {:>7}\n",
      seen.width * 100, seen.speed, 1 / seen.step, "shape", "bound", "reported", "false", "share", "95 % interval",
      "theory", "empty", "missed");
  for (const SweepLine& l : lines) {
    if (is_diagonal(l.sweep)) text += row(l);
  }
  text += fmt::format(
      "Empty: share of the bound's volume that is not swept.\n\nAll {} cells and bounds. Least and most: false share of the "
      "reports, by theory, of any cell.\n{:<7} {:<17} {:>6} {:>12} {:>7} {:>12} {:>12} {:>8} {:>8}\n",
      grouped_text(static_cast<std::int64_t>(lines.size())), "shape", "bound", "cells", "touched", "missed", "reported",
      "false", "least", "most");
  for (const SweepTotal& total : totals) text += row(total);
  if (!costs.empty()) {
    text += fmt::format(
        "\nTimes at {:g} m/s, {:g} degrees from x, in ns, among pairs whose swept boxes overlap. Wasted: on false\n"
        "hits, a pair. Pair: the bound, then the closed form on what it reports; median, quartiles.\n"
        "{:<7} {:<17} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>7}\n",
        view.speed, view.angle_deg, "shape", "bound", "reported", "false", "build", "test", "a false", "wasted",
        "pair");
  }
  for (const SweepCost& cost : costs) {
    if (cost.sweep.speed == view.speed) text += row(cost);
  }
  return text + fmt::format("\nSelf-test: {}.\n", all_passed(tests) ? "passed" : "FAILED");
}

std::vector<Section> sweep_sections(const std::vector<SelfTest>& tests) {
  return {
      {"What is asked",
       "A ball or a box moves straight through one step, past balls at rest. A bound of what it sweeps reports the balls it "
       "overlaps; each report costs an exact test. A false hit is a ball that is reported and that the shape does not touch at "
       "any time of the step.\n\nThe centers of the balls are uniform over a box around the bound, a tenth wider than need be. As "
       "many more balls are put where they just touch the swept volume: in directions uniform over the sphere, along the bound's axes and "
       "towards corners, where a bound can be tight. A bound that is too small there misses them."},
      {"Oracle",
       "The moving shape touches a ball if the least distance of the ball's center from it, over the step, is at most the ball's "
       "radius. That distance is found in long double, from the pieces of its derivative; no query of the library takes part."},
      {"Theory",
       "What a moving convex shape sweeps is its sum with a segment, and the centers at which a ball overlaps a convex body fill "
       "the sum of both. By Steiner's formula that sum has the volume V + S q + M q^2 + 4 pi q^3 / 3 for a ball of radius q, where V, S "
       "and M are the body's volume, surface and integral of mean curvature. All bodies here are segments added up and rounded, whose "
       "V, S and M are sums over their segments. False of reported is 1 less the quotient of two such volumes; "
       "docs/swept_bounds.md derives it."},
      {"Self-test",
       "Where theory is exactly 0 the count must be: false hits of exact bounds, and misses of all. Where at least 5 events are "
       "expected and 5 not to be, the number of 95 % Wilson intervals that hold the theory must lie in the central 99.9 % of its "
       "binomial distribution, and the sum of squared standard residuals in that of its chi-square.\n\n" +
           self_test_text(tests)},
      {"Limits",
       "One straight step without turning; obstacles are balls, at rest. Times are of this machine, with every core at work; they "
       "differ from run to run. Totals over all cells weigh them alike and depend on which are asked."},
  };
}

}  // namespace thinwall
