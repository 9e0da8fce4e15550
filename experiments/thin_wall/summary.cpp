#include <thinwall/experiments/thin_wall/summary.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

/// The scalar whose shots are spoken of: double if it was fired. Float's are the same shots and must not count twice.
std::vector<Total> of_one_scalar(const std::vector<Total>& totals) {
  std::vector<Total> chosen;
  for (const char* scalar : {"double", "float"}) {
    for (const Total& total : totals) {
      if (total.scalar == scalar) chosen.push_back(total);
    }
    if (!chosen.empty()) break;
  }
  return chosen;
}

std::string percent(double share) { return fmt::format("{:.2f} %", 100 * share); }

double share(double part, std::int64_t whole) { return part / static_cast<double>(whole); }

std::string upper_bound(std::int64_t shots) { return rounded_text(clopper_pearson(0, shots).upper, 2); }

std::string bullet_row(const Line& line) {
  const auto millimeters = [](std::optional<double> meters) {
    if (!meters) return std::string("-");
    const double hundredths = std::round(*meters * 1e5) + 0.0;  // no -0.00
    return fmt::format("{:.2f}", hundredths / 100);
  };
  const std::optional<Lateness>& late = line.theory.lateness;
  const std::optional<double>& p = line.theory.probability;
  const Interval bars = interval(line);
  const bool seen = line.tally.detected() > 0;
  return fmt::format("{:<25}{:>9} {:>9} {:>18} {:>8} {:>6} {:>6} {:>6} {:>6}\n", line.detector->method,
                     grouped_text(line.tally.shots), percent(probability(line)),
                     fmt::format("[{:.2f}, {:.2f}] %", 100 * bars.lower, 100 * bars.upper), p ? percent(*p) : "-",
                     millimeters(lateness_mean(line)), millimeters(late ? std::optional(late->mean) : std::nullopt),
                     millimeters(seen ? std::optional(line.tally.latest) : std::nullopt),
                     millimeters(line.theory.largest_lateness()));
}

std::string total_row(const Total& total) {
  const bool known = total.theory_shots > 0;
  return fmt::format("{:<25}{:>11}  {:>10}  {:>8}  {:>8}  {:>8}  {:>8}  {:>9.0f}\n", total.method,
                     grouped_text(total.shots), grouped_text(total.tunneled),
                     grouped_text(total.cells - total.clean_cells),
                     known ? percent(share(static_cast<double>(total.theory_tunneled), total.theory_shots)) : "-",
                     known ? percent(share(total.theory_expected, total.theory_shots)) : "-",
                     total.worst_residual ? fmt::format("{:+.2f}", *total.worst_residual) : "-",
                     1e9 * total.seconds / static_cast<double>(total.shots));
}

/// How many cells count differently at float and at double.
std::string scalar_line(const std::vector<Line>& lines) {
  std::int64_t pairs = 0, differing = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size() && lines[j].cell == lines[i].cell; ++j) {
      if (lines[i].detector->method != lines[j].detector->method) continue;
      ++pairs;
      if (lines[i].tally.tunneled != lines[j].tally.tunneled) ++differing;
    }
  }
  if (pairs == 0) return "";
  return fmt::format("float and double count differently in {} of {} cells.\n", grouped_text(differing),
                     grouped_text(pairs));
}

template <class Tests> std::string verdict(const Tests& tests) {
  return std::all_of(tests.begin(), tests.end(), [](const auto& test) { return test.passed(); }) ? "passed" : "FAILED";
}

}  // namespace

bool Verdicts::passed() const {
  return verdict(counts) == "passed" && verdict(stratified) == "passed" && verdict(lateness) == "passed";
}

std::string answer_text(const std::vector<Total>& totals) {
  std::string text;
  for (const Total& t : of_one_scalar(totals)) {
    if (t.method == "end_of_step" && t.theory_shots > 0) {
      const Interval bars = wilson(t.theory_tunneled, t.theory_shots);  // too wide, if anything: the cells differ
      text += fmt::format(
          "Of {} shots for which theory has a formula, testing only the end of the step let {} through "
          "(95 % interval {:.2f} to {}; theory {}). ",
          grouped_text(t.theory_shots), percent(share(static_cast<double>(t.theory_tunneled), t.theory_shots)),
          100 * bars.lower, percent(bars.upper), percent(share(t.theory_expected, t.theory_shots)));
    }
    if (t.method == "closed_form" && t.tunneled + t.undecided == 0) {
      text += fmt::format(
          "The closed form let none of {} through: with 95 % confidence its chance per shot, on average "
          "over these conditions, is below {}.",
          grouped_text(t.shots), upper_bound(t.shots));
    } else if (t.method == "closed_form") {
      text += fmt::format("The closed form let {} of {} through.", grouped_text(t.tunneled), grouped_text(t.shots));
    }
  }
  for (const Total& t : of_one_scalar(totals)) {
    if (text.empty()) text = fmt::format("{} let {} of {} shots through.", t.method, t.tunneled, t.shots);
  }
  return text;
}

std::string summary_text(const std::vector<Line>& lines, const std::vector<Total>& totals, const Verdicts& verdicts) {
  const std::vector<Total> spoken = of_one_scalar(totals);
  std::string text = fmt::format(
      "The bullet at {} m/s, {:.0f} steps a second; radius {} mm, wall {} mm: before the wall at one frame,\n"
      "behind it at the next.                                           lateness [mm]: mean and most\n"
      "{:<25}{:>9} {:>9} {:>18} {:>8} {:>6} {:>6} {:>6} {:>6}\n",
      bullet.speed, 1 / bullet.step, bullet.radius * 1e3, bullet.thickness * 1e3, "method", "shots", "tunneled",
      "95 % interval", "theory", "mean", "theory", "most", "theory");
  for (const Line& line : lines) {
    if (*line.cell == bullet && line.detector->scalar == spoken[0].scalar) text += bullet_row(line);
  }
  text += fmt::format(
      "\nAll {} cells ({}). Share and theory: of the shots for which there is a formula. Residual: the\n"
      "worst of any cell that can be judged, in standard errors. Time a shot includes drawing it.\n"
      "{:<25}{:>11}  {:>10}  {:>8}  {:>8}  {:>8}  {:>8}  {:>9}\n",
      grouped_text(spoken[0].cells), spoken[0].scalar, "method", "shots", "tunneled", "in cells", "share", "theory",
      "residual", "time [ns]");
  for (const Total& total : spoken) text += total_row(total);
  text += "\n";
  text += scalar_line(lines);
  for (const Total& t : spoken) {
    if (t.tunneled + t.undecided > 0) continue;
    text += fmt::format("{}: none of {}; chance per shot below {} (95 %, Clopper-Pearson).\n", t.method,
                        grouped_text(t.shots), upper_bound(t.shots));
  }
  text += fmt::format("Self-test: counts {}, evenly spread phases {}, lateness {}.\n", verdict(verdicts.counts),
                      verdict(verdicts.stratified), verdict(verdicts.lateness));
  return text;
}

std::vector<Section> report_sections(const std::vector<Total>& totals, const Verdicts& verdicts) {
  std::int64_t shots = 0;
  for (const Total& total : of_one_scalar(totals)) shots = std::max(shots, total.shots);
  return {
      {"What is fired",
       "A ball flies straight at a wall, v h a step, and every step is put to each method as a real query. The phase, "
       "where in a step first contact falls, is uniform and independent from shot to shot. At a finite wall the aim is "
       "uniform over the wall's shadow along the motion, rim included.\n\nEvery method and both scalars get the same "
       "shots, to the bit: starts and steps lie on a grid of a power of two that float holds exactly."},
      {"What the zero proves",
       fmt::format(
           "None through in n shots bounds the chance, it does not make it zero: with 95 % confidence it is "
           "below {} for n = {} (Clopper-Pearson, two-sided). It is the mean chance over these conditions, each "
           "with an equal share of the shots; a single condition is bounded by its own interval in cells.csv. "
           "That the closed form cannot miss at all, to rounding, is derived, and tested against an oracle.",
           upper_bound(shots), grouped_text(shots))},
      {"Self-test",
       "Counts against theory, for each method and scalar over all cells. Where theory is exactly 0 or 1 the count must "
       "be. Where at least 5 shots are expected to tunnel and 5 not to, the number of 95 % Wilson intervals that hold the "
       "theory must lie in the central 99.9 % of its binomial distribution, and the sum of squared standard residuals in "
       "that of its chi-square. A correct run fails each of the two about once in 1000 times.\n\n" +
           self_test_text(verdicts.counts) +
           "A second run spreads its phases evenly: there |k - n p| may not exceed 1 in any cell with an infinite wall.\n\n"
           "The lateness of detection must agree with theory in its mean and never "
           "exceed its bound, and no hit may be reported where ball and wall are apart. First contact is found by "
           "Newton's method, not by any of the methods under test."},
      {"Limits",
       "The ball flies straight and does not turn; the wall is at rest; unless the setting 'response' says so, nothing bounces. There is no theory where the wall "
       "is finite and the poses are closer together than its longest chord, nor for the ray from the center at a finite "
       "wall that is not hit head-on: those cells are counted but judged by no formula.\n\nTime a shot includes drawing "
       "the shot and finding its true contact; it differs from run to run."},
  };
}

}  // namespace thinwall
