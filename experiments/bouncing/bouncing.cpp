/// A ball bounces on a floor: what does each way to find and answer the impact do to its energy, and what time does it take?
/// See docs/bouncing.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/bouncing/scenarios.hpp>
#include <thinwall/experiments/bouncing/theory.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

using Cell = BounceCell;
using Row = BounceRow;
using Tally = BounceTally;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr const char* unit = "g h / V";  // of the energy

/// A crowd of impacts, and the kind that it is of.
struct Crowd {
  std::string group;
  BounceScenario scenario;
};

/// Balls that bounce on and on, after some bounces.
struct LongRow {
  std::string policy;
  Cell cell;
  LongRunPoint at;
  double random_mean, random_sigma;  ///< [1] the mean and the deviation, if every phase were random
};

/// A policy at a step, timed: whole bounces without loss at evenly spaced phases, and nothing else.
struct Timed {
  BouncePolicy policy;
  Cell cell;
  int passes;  ///< through the phases

  static constexpr std::int64_t phases = 32;
  std::int64_t bounces() const { return phases * passes; }
  Tally bounce() const {
    Tally tally;
    for (int pass = 0; pass < passes; ++pass) tally = even_bounces(policy, cell, phases);
    return tally;
  }
};

/// What it took. Each is repeated, in turn with all others, and the median counts.
struct WorkRow {
  std::string policy;
  Cell cell;
  Tally errors;          ///< [g h / V] no chance in it
  Measured nanoseconds;  ///< a bounce, from apex to apex: median over the rounds

  double mean_error() const { return errors.mean * delta(cell); }  ///< [1] of the energy, a bounce
  double rms_error() const { return errors.rms() * delta(cell); }  ///< [1] the same, root of the mean square
  double nanoseconds_per_step() const { return nanoseconds.value * delta(cell) / 2; }
};

struct Results {
  std::vector<Row> rows;
  std::vector<BounceTest> tests;
  std::vector<Crowd> crowds;
  std::vector<LongRow> long_rows;
  std::vector<LongRow> dropped;  ///< the one ball that begins with the drop itself
  std::vector<WorkRow> work;

  std::int64_t crowds_passed() const {
    return std::ranges::count_if(crowds, [](const Crowd& crowd) { return crowd.scenario.passed; });
  }
  bool crowds_pass() const { return crowds_passed() == std::ssize(crowds); }
};

/// The rows at the highest restitution that was asked for: 1, unless the settings leave it out.
std::vector<Row> liveliest(const std::vector<Row>& rows) {
  const double most = std::ranges::max(rows, {}, [](const Row& r) { return r.cell.restitution; }).cell.restitution;
  std::vector<Row> chosen;
  std::ranges::copy_if(rows, std::back_inserter(chosen), [&](const Row& r) { return r.cell.restitution == most; });
  return chosen;
}

/// The last row of each policy.
template <class R> std::vector<R> last_of_each(const std::vector<R>& rows) {
  std::vector<R> last;
  for (const Group<R>& group : group_by(rows, &R::policy)) last.push_back(*group.back());
  return last;
}

// What the tables show.

auto policy_column() {
  return text("policy", "What is done in a step.", [](const auto& row) { return row.policy; });
}
auto step_column() {
  return value("step", "s", "Time step h.", [](const auto& row) { return row.cell.step; });
}
auto delta_column() {
  return value("delta", "1", "g h / V: what gravity adds in a step, over the impact speed V.",
               [](const auto& row) { return delta(row.cell); });
}

Columns<Row> row_columns() {
  return columns_of<Row>(
      policy_column(), step_column(), delta_column(),
      value("restitution", "1", "Speed after over speed before.", [](const Row& r) { return r.cell.restitution; }),
      fields(&Row::tally, {"bounces"}),
      measured(
          "mean", unit, "Mean change of the flight's energy, beyond that of the restitution.",
          [](const Row& r) {
            return Measured{r.tally.mean, mean_interval(r)};
          },
          "mean_"),
      value("theory", unit, "The same by theory.", [](const Row& r) { return r.theory.mean(); }),
      value("first_order", unit, "The theory for short steps.",
            [](const Row& r) { return bounce_theory(r.policy, 0, r.cell.restitution).mean(); }),
      value("residual", "1", "Standard errors between the two; missing where phases do not matter.", mean_residual),
      value("sigma", unit, "Standard deviation over the bounces.", [](const Row& r) { return r.tally.sigma(); }),
      value("sigma_theory", unit, "The same by theory.", [](const Row& r) { return r.theory.sigma(); }),
      value("variance_residual", "1", "Standard errors between the variance and theory.", variance_residual),
      fields(&Row::tally, {"least", "most"}),
      value("rounding", unit, "What rounding can explain.", [](const Row& r) { return rounding_of(r.cell); }));
}

Table test_table(const std::vector<BounceTest>& tests) {
  using T = BounceTest;
  const auto bound = [](double Interval::*end) {
    return [end](const T& t) -> std::optional<std::int64_t> {
      if (t.means.judged == 0) return std::nullopt;
      return static_cast<std::int64_t>(*t.covered_allowed().*end);
    };
  };
  const auto residuals = [](const std::string& prefix, const char* what, ResidualTest T::*test) {
    return where(
        [=](const T& t) { return (t.*test).judged > 0; },
        columns_of<T>(
            value(prefix + "_chi_square", "1", what, [=](const T& t) { return (t.*test).chi_square; }),
            value(prefix + "_lower", "1", "Least allowed: central 99.9 % of the chi-square distribution.",
                  [=](const T& t) { return (t.*test).allowed()->lower; }),
            value(prefix + "_upper", "1", "Most allowed.", [=](const T& t) { return (t.*test).allowed()->upper; })));
  };
  const auto columns = columns_of<T>(
      policy_column(),
      value("certain_cells", "1", "Cells in which phases do not matter: every bounce must give what theory says.",
            &T::certain_cells),
      value("certain_wrong", "1", "Of those, cells in which one does not; must be 0.", &T::certain_wrong),
      value("judged_cells", "1", "Cells of at least 30 bounces in which they do.",
            [](const T& t) { return t.means.judged; }),
      value("covered", "1", "Of those, cells whose 95 % interval holds the mean by theory.", &T::covered),
      value("covered_lower", "1", "Least allowed: central 99.9 % of Binomial(judged_cells, 0.95).",
            bound(&Interval::lower)),
      value("covered_upper", "1", "Most allowed.", bound(&Interval::upper)),
      residuals("mean", "Sum of squared residuals of the means.", &T::means),
      value("spread_cells", "1", "Cells of at least 100 bounces, whose variance is judged too.",
            [](const T& t) { return t.variances.judged; }),
      residuals("spread", "Sum of squared residuals of the variances.", &T::variances),
      value("other_cells", "1", "Cells with too few bounces to judge.", &T::other_cells),
      value("passed", "", "All of the above hold.", &T::passed));
  return in_report(table(
      "self_test", "Means and variances of the change of energy against theory, over all cells of a policy at once.",
      columns, tests));
}

Table scenarios_table(const std::vector<Crowd>& crowds) {
  return in_report(table("scenarios", "Impacts that come in crowds: what must happen, and what did.",
                         columns_of<Crowd>(text("group", "Kind of scenario.", &Crowd::group), fields(&Crowd::scenario)),
                         crowds));
}

Columns<LongRow> long_columns() {
  using R = LongRow;
  return columns_of<R>(policy_column(), step_column(), fields(&R::at, {"bounces", "runs", "mean"}),
                       value("random_mean", "1", "The same at random phases, to first order.", &R::random_mean),
                       fields(&R::at, {"sigma"}),
                       value("random_sigma", "1", "The same at random phases, to first order.", &R::random_sigma));
}

Table dropped_table(const std::vector<LongRow>& rows) {
  using R = LongRow;
  const auto columns =
      columns_of<R>(policy_column(), step_column(), fields(&R::at, {"bounces"}),
                    value("energy", "1", "Energy after the last bounce over that of the first flight.",
                          [](const R& r) { return r.at.mean; }),
                    value("random_mean", "1", "Its mean at random phases, to first order.", &R::random_mean));
  return in_report(table(
      "dropped", "The same for one run that begins with the drop itself: its phase may lock where nothing is lost.",
      columns, rows));
}

auto error_columns() {
  return columns_of<WorkRow>(
      value("mean_error", "1", "Mean change of the energy a bounce, relative.", &WorkRow::mean_error),
      value("rms_error", "1", "Root of its mean square.", &WorkRow::rms_error));
}

Table even_phases_table(const std::vector<WorkRow>& work) {
  const auto columns = columns_of<WorkRow>(
      policy_column(), step_column(), delta_column(),
      value("bounces", "1", "Phases.", [](const WorkRow& w) { return w.errors.trials; }), error_columns());
  return table("even_phases",
               "Change of energy a bounce without loss at evenly spaced phases: the errors of the timed bounces.",
               columns, work);
}

Columns<WorkRow> timing_columns() {
  using R = WorkRow;
  return columns_of<R>(policy_column(), step_column(), error_columns(),
                       measured("nanoseconds", "ns", "A bounce; median over the rounds.", &R::nanoseconds),
                       value("nanoseconds_per_step", "ns", "The median over the steps of a bounce, 2 V / (g h).",
                             &R::nanoseconds_per_step));
}

// What the pictures show.

Series series_of(std::string label, Mark mark) {
  return {.label = std::move(label), .mark = mark, .x = {}, .y = {}, .lower = {}, .upper = {}};
}

/// A curve of its own, and a gap after it.
void add_curve(Series& curve, double from, double to, const std::function<double(double)>& y) {
  constexpr int pieces = 60;
  for (int i = 0; i <= pieces; ++i) {
    const double x = from * std::pow(to / from, static_cast<double>(i) / pieces);
    curve.x.push_back(x);
    curve.y.push_back(y(x));
  }
  curve.x.push_back(to);
  curve.y.push_back(nan);
}

Figure energy_figure(const std::vector<Row>& rows, const Table& means) {
  const double coarsest = rows.front().cell.step, finest = rows.back().cell.step, e = rows.front().cell.restitution;
  Panel energies = plot(means).x("step", Axis::log).y("mean", Axis::linear, "energy a bounce [g h / V]").by("policy");
  Panel residuals = plot(means)
                        .x("step", Axis::log)
                        .y("residual", Axis::linear, "from theory [standard errors]")
                        .by("policy")
                        .height(0.6);
  Series theory = series_of("theory", Mark::line), limits = series_of("95 % of chance", Mark::dashes);
  for (const Group<Row>& group : group_by(rows, &Row::policy)) {
    const Row& row = *group[0];
    add_curve(theory, finest, coarsest,
              [&](double step) { return bounce_theory(row.policy, delta(row.cell) * step / coarsest, e).mean(); });
  }
  for (const double at : {-1.96, 1.96}) add_curve(limits, finest, coarsest, [at](double) { return at; });
  energies.series.push_back(theory);
  residuals.series.push_back(limits);
  return {.name = "energy_per_bounce",
          .title = "What a bounce at random phase does to the energy",
          .caption = fmt::format(
              "Mean change of the flight's energy a bounce at restitution {:g}, in units of g h / V of it, with 95 % "
              "intervals (mostly hidden by their points), and the theory. Below, how far the means are from it; the "
              "policies share their phases, so these deviations are almost the same or opposite.",
              e),
          .panels = {energies, residuals}};
}

Figure work_figure(const std::vector<WorkRow>& work) {
  constexpr double least_error = 0x1p-60;  // drawn in place of an error that is less, down to 0
  Figure figure = {
      .name = "energy_against_time",
      .title = "Energy error against run time",
      .caption =
          "Each policy from the coarsest step (left) to the finest, without loss. Above, the root of the mean square "
          "of the relative change of energy a bounce; below, its mean, which is what adds up. Bars: 95 % bootstrap "
          "intervals of the median time.",
      .panels = {},
      .is_timing = true};
  for (const bool mean : {false, true}) {
    Panel panel = {.x_label = "run time [ns a bounce]",
                   .y_label = mean ? "|mean| of the energy error [1]" : "rms energy error a bounce [1]",
                   .log_x = true,
                   .log_y = true,
                   .series = {}};
    for (const Group<WorkRow>& group : group_by(work, &WorkRow::policy)) {
      Series points = series_of(group[0]->policy, Mark::points), line = series_of(group[0]->policy, Mark::line);
      for (const WorkRow* w : group) {
        points.x.push_back(w->nanoseconds.value);
        points.y.push_back(std::max(least_error, mean ? std::abs(w->mean_error()) : w->rms_error()));
        points.x_lower.push_back(w->nanoseconds.interval.lower);
        points.x_upper.push_back(w->nanoseconds.interval.upper);
      }
      points.lower = points.upper = line.y = points.y;
      line.x = points.x;
      panel.series.push_back(std::move(points));
      panel.series.push_back(std::move(line));
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

/// `at` is the step of the runs.
Figure long_figure(const std::vector<LongRow>& rows, const Table& runs, const std::vector<BouncePolicy>& policies,
                   const Cell& at) {
  Panel means =
      plot(runs).x("bounces", Axis::log, "bounces").y("mean", Axis::linear, "mean energy / first [1]").by("policy");
  Panel sigmas = plot(runs)
                     .where("sigma", [](double sigma) { return sigma > 1e-9; })
                     .x("bounces", Axis::log, "bounces")
                     .y("sigma", Axis::log, "standard deviation [1]")
                     .by("policy");
  Series theory = series_of("random phases", Mark::line), spread = theory;
  for (const LongRow& last : last_of_each(rows)) {
    const int drift = std::ranges::find(policies, last.policy, &BouncePolicy::name)->drift;
    const double sigma = bounce_theory(last.policy, 0, 1).sigma(), end = static_cast<double>(last.at.bounces);
    add_curve(theory, 1, end, [&](double n) { return random_phase_mean(drift, delta(at), n); });
    if (sigma > 0) add_curve(spread, 1, end, [&](double n) { return random_phase_sigma(drift, sigma, delta(at), n); });
  }
  means.series.push_back(theory);
  sigmas.series.push_back(spread);
  return {.name = "long_runs",
          .title = "One ball that bounces on and on",
          .caption = fmt::format(
              "Energy over that of the first flight, without loss, at a step of {:.3g} s: mean and standard deviation "
              "over balls that start at random in the first step, and what they would be if every phase were random. "
              "Deviations below 1e-9 are not drawn.",
              at.step),
          .panels = {means, sigmas}};
}

Figure heights_figure(Cell cell, const std::vector<BouncePolicy>& policies) {
  constexpr double flights = 5, elapsed = 1.0 / 3;
  cell.restitution = 1;
  Figure figure = {
      .name = "heights",
      .title = "One ball, without loss",
      .caption = fmt::format(
          "Height of the gap over time at a step of {:.3g} s, and the true flight. The first flight is the same.",
          cell.step),
      .panels = {}};
  const double fall = fall_time(cell), end = (2 * flights + 1) * fall;
  Series truth = series_of("true flight", Mark::dashes);
  for (int i = 0; i <= 600; ++i) {
    const double t = end * i / 600, from_apex = std::fmod(t + fall, 2 * fall) - fall;
    truth.x.push_back(t);
    truth.y.push_back(cell.height - cell.gravity * from_apex * from_apex / 2);
  }
  for (const BouncePolicy& policy : policies) {
    Series line = series_of(policy.name, Mark::line);
    for (const double gap : policy.heights(cell, elapsed, static_cast<std::int64_t>(end / cell.step - elapsed))) {
      line.x.push_back((elapsed + static_cast<double>(line.x.size())) * cell.step);
      line.y.push_back(gap);
    }
    Series points = line;
    points.mark = Mark::points;
    figure.panels.push_back(
        {.x_label = "time [s]", .y_label = "height [m]", .height = 0.45, .series = {truth, line, points}});
  }
  return figure;
}

// What it says.

/// What is good at the least cost: rms error and time of the exact arc at its coarsest step beside the best of the others.
std::string cost_sentence(const std::vector<WorkRow>& work) {
  const WorkRow *arc = nullptr, *best = nullptr;
  for (const WorkRow& w : work) {
    if (w.policy == ParabolaToi::name) {
      if (arc == nullptr) arc = &w;
    } else if (best == nullptr || w.rms_error() < best->rms_error()) {
      best = &w;
    }
  }
  if (arc == nullptr || best == nullptr) return "";
  return fmt::format(
      "The exact arc is off by {:.1e} (rms) at its coarsest step, in {:.0f} ns a bounce; the nearest of the others, {} "
      "at {:.3g} s, by {:.1e} in {:.0f} ns. ",
      arc->rms_error(), arc->nanoseconds.value, best->policy, best->cell.step, best->rms_error(),
      best->nanoseconds.value);
}

std::string answer_of(const Results& results) {
  std::string means, energies;
  const std::vector<Row> rows = liveliest(results.rows);
  for (const Row& row : last_of_each(rows)) {
    const double mean = std::abs(row.tally.mean) < 5e-3 ? 0 : row.tally.mean;
    means += fmt::format("{}{} {:+.2f}", means.empty() ? "" : ", ", row.policy, mean);
  }
  for (const LongRow& last : last_of_each(results.long_rows)) {
    energies += fmt::format("{}{} {:.3g} after {} bounces", energies.empty() ? "" : ", ", last.policy, last.at.mean,
                            last.at.bounces);
  }
  if (!energies.empty())
    energies = fmt::format("Of its energy a ball that bounces on without loss keeps: {}. ", energies);
  return fmt::format(
      "At random phase a bounce at restitution {:g} changes the energy by, in units of g h / V: {} ({:.3g} s steps; "
      "theory {}). {}{}{} of {} crowds of impacts end as they must.",
      rows.back().cell.restitution, means, rows.back().cell.step, all_passed(results.tests) ? "agrees" : "DISAGREES",
      cost_sentence(results.work), energies, results.crowds_passed(), results.crowds.size());
}

/// The last crowd of each kind, or the first that went wrong.
std::string crowd_lines(const Results& results) {
  std::string text = fmt::format("\nImpacts in crowds: {} of {} as they must. The last of each kind:\n",
                                 results.crowds_passed(), results.crowds.size());
  for (const Group<Crowd>& group : group_by(results.crowds, &Crowd::group)) {
    const auto wrong = std::ranges::find_if(group, [](const Crowd* crowd) { return !crowd->scenario.passed; });
    const BounceScenario& shown = (wrong != group.end() ? *wrong : group.back())->scenario;
    text +=
        clipped(fmt::format("  {} {}: {}", shown.passed ? "ok    " : "FAILED", shown.name, shown.happened), 97) + "\n";
  }
  return text;
}

/// At the coarsest, and at the finest step; times at the middle one.
std::string summary_of(const Results& results, const Table& dropped) {
  const std::vector<Row> rows = liveliest(results.rows);
  std::vector<Row> ends;
  for (const Group<Row>& group : group_by(rows, &Row::policy)) {
    ends.push_back(*group.front());
    if (group.size() > 1) ends.push_back(*group.back());
  }
  std::vector<WorkRow> middle;
  for (const Group<WorkRow>& group : group_by(results.work, &WorkRow::policy))
    middle.push_back(*group[group.size() / 2]);
  return terminal(table("means", "Energy a bounce at random phase, in g h / V of it.", row_columns(), ends),
                  {"policy", "step", "restitution", "mean", "theory", "sigma", "sigma_theory"}) +
         "\n" +
         terminal(table("timings", "Time of a step, and error of a bounce.", timing_columns(), middle),
                  {"policy", "step", "nanoseconds_per_step", "rms_error"}) +
         "\n" +
         terminal(table("long_runs", "On and on without loss: energy over the first.", long_columns(),
                        last_of_each(results.long_rows)),
                  {"policy", "step", "bounces", "mean", "random_mean", "sigma", "random_sigma"}) +
         "\n" + terminal(dropped) + crowd_lines(results) +
         fmt::format("\nSelf-test: energies {}, crowds {}.\n", all_passed(results.tests) ? "passed" : "FAILED",
                     results.crowds_pass() ? "passed" : "FAILED");
}

Outcome outcome_of(const Results& results, const std::vector<BouncePolicy>& policies, const Cell& long_cell) {
  const std::vector<Row> lively = liveliest(results.rows);
  const Table means =
      in_report(table("means", "Change of energy a bounce at random phase and the highest restitution, against theory.",
                      row_columns(), lively));
  const Table runs = in_report(
      table("long_runs",
            "One ball that bounces on and on without loss: energy after a number of bounces over that of the first "
            "flight, and what it would be if every phase were random. Over runs that begin at random in the first "
            "step, as long as all last.",
            long_columns(), results.long_rows));
  const Table dropped = dropped_table(results.dropped);
  std::string verdicts;
  for (const BounceTest& test : results.tests)
    verdicts += fmt::format("{}: {}.\n\n", test.policy, test.passed() ? "passed" : "FAILED");
  return {.answer = answer_of(results),
          .summary = summary_of(results, dropped),
          .tables = {means, scenarios_table(results.crowds), runs, dropped, test_table(results.tests),
                     table("cells", "Change of energy a bounce at random phase, every cell and policy, against theory.",
                           row_columns(), results.rows),
                     even_phases_table(results.work),
                     timing(in_report(
                         table("timings", "Time a bounce, from apex to apex, on this machine with every core at work.",
                               timing_columns(), results.work)))},
          .figures = {energy_figure(lively, means), work_figure(results.work),
                      long_figure(results.long_rows, runs, policies, long_cell),
                      heights_figure(results.rows.front().cell, policies)},
          .sections = {{"Self-test", verdicts}},
          .self_test_passed = all_passed(results.tests) && results.crowds_pass()};
}

// What is run.

constexpr std::array<std::string_view, 7> scenario_names = {"zeno",   "rest",   "walls", "gap",
                                                            "masses", "cradle", "digits"};

/// In the order asked for.
std::vector<std::string> scenarios_asked(const Settings& settings) {
  std::vector<std::string_view> allowed(scenario_names.begin(), scenario_names.end());
  allowed.emplace_back("all");
  const std::vector<std::string> asked = settings.choices("scenario", allowed);
  if (std::ranges::find(asked, "all") == asked.end()) return asked;
  return {scenario_names.begin(), scenario_names.end()};
}

std::vector<BounceScenario> run_scenarios(std::string_view name, const std::vector<double>& mass_ratios, int digits) {
  if (name == "zeno") return zeno_scenarios();
  if (name == "rest") return rest_scenarios();
  if (name == "walls") return corner_scenarios();
  if (name == "gap") return gap_scenarios();
  if (name == "masses") return mass_scenarios(mass_ratios);
  if (name == "cradle") return cradle_scenarios();
  return digit_scenarios(digits);
}

/// Every policy at every step of the cells, at restitution 1.
std::vector<Timed> timed_of(const std::vector<Cell>& cells, const std::vector<BouncePolicy>& policies) {
  constexpr double steps_a_round = 1 << 14;  // less than a millisecond: most rounds are not interrupted
  std::vector<Timed> all;
  for (const Group<Cell>& group : group_by(cells, &Cell::step)) {
    Cell cell = *group[0];
    cell.restitution = 1;
    const double steps = 2 / delta(cell) * static_cast<double>(Timed::phases);
    for (const BouncePolicy& policy : policies)
      all.push_back({policy, cell, std::max(1, static_cast<int>(steps_a_round / steps))});
  }
  return all;
}

/// `done` round by round.
std::vector<WorkRow> work_of(const std::vector<Timed>& timed, const Done<Tally>& done) {
  std::vector<WorkRow> work;
  for (std::size_t i = 0; i < timed.size(); ++i) {
    std::vector<double> rounds;
    for (std::size_t k = i; k < done.seconds.size(); k += timed.size())
      rounds.push_back(1e9 * done.seconds[k] / static_cast<double>(timed[i].bounces()));
    work.push_back({timed[i].policy.name, timed[i].cell, done.results[i], median_of_rounds(rounds)});
  }
  return work;
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const std::vector<BouncePolicy> policies = bounce_policies(settings.choices_or_all("policy", bounce_policy_names()));
  const std::vector<Cell> cells = make_bounce_cells(settings, policies.size());
  const std::vector<std::string> kinds = scenarios_asked(settings);
  const std::int64_t bounces = settings.trials("bounces", 1, std::int64_t(1) << 30, options.trials);
  const std::int64_t runs = settings.integer("runs", 2, 100000), run_bounces = settings.integer("run_bounces", 1, 4096);
  const std::int64_t rounds = settings.integer("rounds", 1, 1000);
  const std::vector<double> mass_ratios = settings.numbers("mass_ratio", {.lower = 1, .upper = 1e16});
  const int digits = static_cast<int>(settings.integer("digits", 0, 7));
  const std::uint64_t seed = options.seed;
  Cell long_cell = cells[cells.size() / 2];  // the middle step, without loss
  long_cell.restitution = 1;
  const std::vector<Timed> timed = timed_of(cells, policies);

  std::vector<Task<std::vector<BounceScenario>>> crowd_tasks;
  std::vector<Task<Tally>> cell_tasks, timing_tasks;
  std::vector<Task<std::vector<LongRunPoint>>> long_tasks;
  for (const std::string& kind : kinds)
    crowd_tasks.push_back({"scenario " + kind, 1, [=] { return run_scenarios(kind, mass_ratios, digits); }});
  for (const Cell& cell : cells) {
    for (const BouncePolicy& policy : policies) {
      cell_tasks.push_back({fmt::format("{} {}", bounce_factors().key(cell), policy.name), bounces,
                            [=] { return random_bounces(policy, cell, seed, bounces); }});
    }
  }
  for (const BouncePolicy& policy : policies) {
    long_tasks.push_back({fmt::format("long run {}", policy.name), runs * run_bounces,
                          [=] { return long_run(policy, long_cell, seed, runs, run_bounces); }});
  }
  for (std::int64_t round = 0; round < rounds; ++round) {
    for (const Timed& t : timed) {
      timing_tasks.push_back({fmt::format("time {} {} {}", round, bounce_factors().key(t.cell), t.policy.name),
                              t.bounces(), [t] { return t.bounce(); }});
    }
  }

  const auto finish = [=](const Done<std::vector<BounceScenario>>& crowds, const Done<Tally>& tallies,
                          const Done<std::vector<LongRunPoint>>& long_runs, const Done<Tally>& times) {
    Results results;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      for (const BounceScenario& scenario : crowds.results[i]) results.crowds.push_back({kinds[i], scenario});
    }
    results.rows = bounce_rows(cells, policies, tallies.results);
    results.tests = bounce_tests(results.rows);
    for (std::size_t i = 0; i < policies.size(); ++i) {
      const BouncePolicy& policy = policies[i];
      const auto row = [&](const LongRunPoint& at) -> LongRow {
        const double sigma = bounce_theory(policy.name, 0, 1).sigma(), n = static_cast<double>(at.bounces);
        return {policy.name, long_cell, at, random_phase_mean(policy.drift, delta(long_cell), n),
                random_phase_sigma(policy.drift, sigma, delta(long_cell), n)};
      };
      std::ranges::transform(long_runs.results[i], std::back_inserter(results.long_rows), row);
      const std::vector<double> energies = policy.energies(long_cell, 0, run_bounces);
      results.dropped.push_back(row({std::ssize(energies), 1, energies.empty() ? 0 : energies.back(), 0}));
    }
    results.work = work_of(timed, times);
    return outcome_of(results, policies, long_cell);
  };
  return make_run(finish, std::move(crowd_tasks), std::move(cell_tasks), std::move(long_tasks),
                  std::move(timing_tasks));
}

}  // namespace

Experiment bouncing_experiment() {
  return {
      "bouncing",
      "A ball bounces on a floor: what does each way to find and answer the impact do to its energy, and what time does it "
      "take?",
      embedded_toml("bouncing"), configure};
}

}  // namespace thinwall
