/// A ball bounces on a floor: what does each way to find and answer the impact do to its energy, and what time does it take?
/// See docs/bouncing.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
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
using Scenario = BounceScenario;

constexpr const char* unit = "g h / V";  // of the energy

/// Balls that bounce on and on, after some bounces.
struct LongRow {
  BouncePolicy policy;
  Cell cell;
  LongRunPoint at;

  double bounces() const { return static_cast<double>(at.bounces); }
  double random_mean() const { return random_phase_mean(policy, cell, bounces()); }
  double random_sigma() const { return random_phase_sigma(policy, cell, bounces()); }
};

/// A policy at a step, timed: whole bounces without loss at evenly spaced phases, and nothing else; in turn with all others.
struct WorkRow {
  BouncePolicy policy;
  Cell cell;
  int passes;                 ///< through the phases
  Tally errors = {};          ///< [g h / V] no chance in it
  Measured nanoseconds = {};  ///< a bounce, from apex to apex: median over the rounds

  static constexpr int phases = 32;  ///< in the middle of equal parts of a step
  std::int64_t bounces() const { return std::int64_t{phases} * passes; }
  Tally bounce() const {  ///< of a single pass: all are alike
    Tally tally;
    for (int pass = 0; pass < passes; ++pass) {
      tally = {};
      for (int i = 0; i < phases; ++i) tally.add(error_at(policy, cell, (i + 0.5) / phases));
    }
    return tally;
  }
  double mean_error() const { return errors.mean * delta(cell); }  ///< [1] of the energy, a bounce
  double rms_error() const { return errors.rms() * delta(cell); }  ///< [1] the same, root of the mean square
  double nanoseconds_per_step() const { return nanoseconds.value * delta(cell) / 2; }
};

struct Results {
  std::vector<Row> rows, lively;  ///< lively: at the highest restitution that was asked for, usually 1
  std::vector<BounceTest> tests;
  std::vector<Scenario> scenarios;
  std::vector<LongRow> long_rows;
  std::vector<LongRow> dropped;  ///< the one ball that begins with the drop itself
  std::vector<WorkRow> work;

  std::int64_t scenarios_passed() const { return std::ranges::count(scenarios, true, &Scenario::passed); }
};

/// The last row of each policy.
template <class R> std::vector<R> last_of_each(const std::vector<R>& rows) {
  std::vector<R> last;
  for (const Group<R>& group : group_by(rows, &R::policy)) last.push_back(*group.back());
  return last;
}

// What the tables show.

auto policy_column() {
  return text("policy", "What is done in a step.", [](const auto& row) { return row.policy.name; });
}
auto step_column() {
  return bounce_factors().columns([](const auto& row) { return row.cell; }, {"step"});
}
auto delta_column() {
  return value("delta", "1", "g h / V: what gravity adds in a step, over the impact speed V.",
               [](const auto& row) { return delta(row.cell); });
}

Columns<Row> row_columns() {
  return columns_of<Row>(
      policy_column(), step_column(), delta_column(), bounce_factors().columns(&Row::cell, {"restitution"}),
      fields(&Row::tally, {"bounces"}),
      measured("mean", unit, "Mean change of the flight's energy, beyond that of the restitution.", measured_mean,
               "mean_"),
      value("theory", unit, "The same by theory.", [](const Row& r) { return r.theory.mean(); }),
      value("first_order", unit, "The theory for short steps.",
            [](const Row& r) { return bounce_theory(r.policy.name, 0, r.cell.restitution).mean(); }),
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
      chi_square_columns("mean_chi_square", "Sum of squared residuals of the means.", &T::means, "mean_"),
      value("spread_cells", "1", "Cells of at least 100 bounces, whose variance is judged too.",
            [](const T& t) { return t.variances.judged; }),
      chi_square_columns("spread_chi_square", "Sum of squared residuals of the variances.", &T::variances, "spread_"),
      value("other_cells", "1", "Cells with too few bounces to judge.", &T::other_cells),
      value("passed", "", "All of the above hold.", &T::passed));
  return in_report(table(
      "self_test", "Means and variances of the change of energy against theory, over all cells of a policy at once.",
      columns, tests));
}

Table scenarios_table(const std::vector<Scenario>& scenarios) {
  return in_report(table("scenarios", "Impacts that come in crowds: what must happen, and what did.",
                         columns_of<Scenario>(fields(std::identity())), scenarios));
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

Figure energy_figure(const std::vector<Row>& rows, const Table& means) {
  const double e = rows.front().cell.restitution;
  Plot energies = plot(means).x("step", Axis::log).y("mean", Axis::linear, "energy a bounce [g h / V]").by("policy");
  for (const Row& row : last_of_each(rows)) {
    energies.curve("theory", [row, e](double step) {
      return bounce_theory(row.policy.name, delta(row.cell) * step / row.cell.step, e).mean();
    });
  }
  Plot residuals = plot(means)
                       .x("step", Axis::log)
                       .y("residual", Axis::linear, "from theory [standard errors]")
                       .by("policy")
                       .height(0.6);
  for (const double at : {-1.96, 1.96}) {
    residuals.curve(
        "95 % of chance", [at](double) { return at; }, Mark::dashes);
  }
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
  const auto panel = [&](std::string label, double (WorkRow::*error)() const) {
    constexpr double least_error = 0x1p-60;  // drawn in place of an error that is less, down to 0
    const auto columns = columns_of<WorkRow>(
        policy_column(), measured("nanoseconds", "ns", "", &WorkRow::nanoseconds),
        value("error", "1", "", [=](const WorkRow& w) { return std::max(least_error, std::abs((w.*error)())); }));
    return joined(plot(columns, work)
                      .x("nanoseconds", Axis::log, "run time [ns a bounce]")
                      .y("error", Axis::log, std::move(label))
                      .by("policy"));
  };
  return {
      .name = "energy_against_time",
      .title = "Energy error against run time",
      .caption =
          "Each policy from the coarsest step (left) to the finest, without loss. Above, the root of the mean square "
          "of the relative change of energy a bounce; below, its mean, which is what adds up. Bars: 95 % bootstrap "
          "intervals of the median time.",
      .panels = {panel("rms energy error a bounce [1]", &WorkRow::rms_error),
                 panel("|mean| of the energy error [1]", &WorkRow::mean_error)},
      .is_timing = true};
}

Figure long_figure(const std::vector<LongRow>& rows, const Table& runs, double step) {
  Plot means =
      plot(runs).x("bounces", Axis::log, "bounces").y("mean", Axis::linear, "mean energy / first [1]").by("policy");
  Plot sigmas = plot(runs)
                    .where("sigma", [](double sigma) { return sigma > 1e-9; })
                    .x("bounces", Axis::log, "bounces")
                    .y("sigma", Axis::log, "standard deviation [1]")
                    .by("policy");
  for (const LongRow& last : last_of_each(rows)) {
    const auto add = [&](Plot& panel, double (*theory)(const BouncePolicy&, const Cell&, double)) {
      panel.curve(
          "random phases", [=](double n) { return theory(last.policy, last.cell, n); }, 1, last.bounces());
    };
    add(means, random_phase_mean);
    if (last.random_sigma() > 0) add(sigmas, random_phase_sigma);
  }
  return {.name = "long_runs",
          .title = "One ball that bounces on and on",
          .caption = fmt::format(
              "Energy over that of the first flight, without loss, at a step of {:.3g} s: mean and standard deviation "
              "over balls that start at random in the first step, and what they would be if every phase were random. "
              "Deviations below 1e-9 are not drawn.",
              step),
          .panels = {means, sigmas}};
}

Figure heights_figure(const std::vector<Row>& rows) {
  constexpr double flights = 5, elapsed = 1.0 / 3;
  Cell cell = rows.front().cell;
  cell.restitution = 1;
  Figure figure = {
      .name = "heights",
      .title = "One ball, without loss",
      .caption = fmt::format(
          "Height of the gap over time at a step of {:.3g} s, and the true flight. The first flight is the same.",
          cell.step)};
  const double fall = fall_time(cell), end = (2 * flights + 1) * fall;
  const auto truth = [&](double time) {
    const double from_apex = std::fmod(time + fall, 2 * fall) - fall;
    return cell.height - cell.gravity * from_apex * from_apex / 2;
  };
  struct Moment {
    double time, height;
  };
  const auto columns =
      columns_of<Moment>(value("time", "s", "", &Moment::time), value("height", "m", "", &Moment::height));
  for (const BouncePolicy& policy : distinct(rows, &Row::policy)) {
    std::vector<Moment> flight;
    for (const double gap : heights(policy, cell, elapsed, static_cast<std::int64_t>(end / cell.step - elapsed)))
      flight.push_back({(elapsed + static_cast<double>(flight.size())) * cell.step, gap});
    Plot panel = plot(columns, flight).x("time").y("height").label(std::string(policy.name)).height(0.45);
    figure.panels.push_back(joined(panel.curve("true flight", truth, 0, end, Mark::dashes)));
  }
  return figure;
}

// What it says.

/// What is good at the least cost: rms error and time of the exact arc at its coarsest step beside the best of the others.
std::string cost_sentence(const std::vector<WorkRow>& work) {
  const auto is_arc = [](const WorkRow& w) { return w.policy.name == "parabola_toi"; };
  const auto arcs = only(work, is_arc), others = only(work, std::not_fn(is_arc));
  if (arcs.empty() || others.empty()) return "";
  const WorkRow& best = *std::ranges::min_element(others, {}, &WorkRow::rms_error);
  return fmt::format(
      "The exact arc is off by {:.1e} (rms) at its coarsest step, in {:.0f} ns a bounce; the nearest of the others, {} "
      "at {:.3g} s, by {:.1e} in {:.0f} ns. ",
      arcs[0].rms_error(), arcs[0].nanoseconds.value, best.policy.name, best.cell.step, best.rms_error(),
      best.nanoseconds.value);
}

std::string answer_of(const Results& results) {
  std::vector<std::string> means;
  for (const Row& row : last_of_each(results.lively)) {
    const double mean = std::abs(row.tally.mean) < 5e-3 ? 0 : row.tally.mean;
    means.push_back(fmt::format("{} {:+.2f}", row.policy.name, mean));
  }
  const Cell& last = results.lively.back().cell;
  return fmt::format(
      "At random phase a bounce at restitution {:g} changes the energy by, in units of g h / V: {} ({:.3g} s steps; "
      "theory {}). {}{} of {} crowds of impacts end as they must.",
      last.restitution, fmt::join(means, ", "), last.step, all_passed(results.tests) ? "agrees" : "DISAGREES",
      cost_sentence(results.work), results.scenarios_passed(), results.scenarios.size());
}

/// The last crowd of each kind, or the first that went wrong.
std::string crowd_lines(const Results& results) {
  std::string text = fmt::format("\nImpacts in crowds: {} of {} as they must. The last of each kind:\n",
                                 results.scenarios_passed(), results.scenarios.size());
  for (const Group<Scenario>& group : group_by(results.scenarios, &Scenario::group)) {
    const auto wrong = std::ranges::find(group, false, &Scenario::passed);
    const Scenario& shown = wrong != group.end() ? **wrong : *group.back();
    text +=
        clipped(fmt::format("  {} {}: {}", shown.passed ? "ok    " : "FAILED", shown.name, shown.happened), 97) + "\n";
  }
  return text;
}

/// At the coarsest, and at the finest step; times at the middle one.
std::string summary_of(const Results& results, const Table& dropped) {
  std::vector<Row> ends;
  for (const Group<Row>& group : group_by(results.lively, &Row::policy)) {
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
         fmt::format("\nSelf-test: energies {}, crowds {}.\n", verdict_text(all_passed(results.tests)),
                     verdict_text(all_passed(results.scenarios)));
}

Outcome outcome_of(const Results& results, double long_step) {
  const Table means =
      in_report(table("means", "Change of energy a bounce at random phase and the highest restitution, against theory.",
                      row_columns(), results.lively));
  const Table runs = in_report(
      table("long_runs",
            "One ball that bounces on and on without loss: energy after a number of bounces over that of the first "
            "flight, and what it would be if every phase were random. Over runs that begin at random in the first "
            "step, as long as all last.",
            long_columns(), results.long_rows));
  const Table dropped = dropped_table(results.dropped);
  return {.answer = answer_of(results),
          .summary = summary_of(results, dropped),
          .tables = {means, scenarios_table(results.scenarios), runs, dropped, test_table(results.tests),
                     table("cells", "Change of energy a bounce at random phase, every cell and policy, against theory.",
                           row_columns(), results.rows),
                     even_phases_table(results.work),
                     timing(in_report(
                         table("timings", "Time a bounce, from apex to apex, on this machine with every core at work.",
                               timing_columns(), results.work)))},
          .figures = {energy_figure(results.lively, means), work_figure(results.work),
                      long_figure(results.long_rows, runs, long_step), heights_figure(results.rows)},
          .sections = {},
          .self_test_passed = all_passed(results.tests) && all_passed(results.scenarios)};
}

// What is run.

/// In the order of the tables.
std::vector<BouncePolicy> policies_asked(const Settings& settings) {
  std::vector<std::string_view> names;
  std::ranges::transform(all_bounce_policies, std::back_inserter(names), &BouncePolicy::name);
  std::vector<BouncePolicy> policies;
  for (const std::string& name : settings.choices_or_all("policy", names))
    policies.push_back(*std::ranges::find(all_bounce_policies, name, &BouncePolicy::name));
  return policies;
}

/// In the order asked for.
std::vector<std::string> groups_asked(const Settings& settings) {
  std::vector<std::string_view> allowed(scenario_groups.begin(), scenario_groups.end());
  allowed.emplace_back("all");
  const std::vector<std::string> asked = settings.choices("scenario", allowed);
  if (std::ranges::find(asked, "all") == asked.end()) return asked;
  return {scenario_groups.begin(), scenario_groups.end()};
}

/// Every policy at every step of the cells, at restitution 1.
std::vector<WorkRow> timed_of(const std::vector<Cell>& cells, const std::vector<BouncePolicy>& policies) {
  constexpr double steps_a_round = 1 << 14;  // less than a millisecond: most rounds are not interrupted
  std::vector<WorkRow> timed;
  for (const Group<Cell>& group : group_by(cells, &Cell::step)) {
    Cell cell = *group[0];
    cell.restitution = 1;
    const double steps = 2 / delta(cell) * WorkRow::phases;
    for (const BouncePolicy& policy : policies)
      timed.push_back({policy, cell, std::max(1, static_cast<int>(steps_a_round / steps))});
  }
  return timed;
}

/// `done` round by round.
std::vector<WorkRow> work_of(std::vector<WorkRow> timed, const Done<Tally>& done) {
  for (std::size_t i = 0; i < timed.size(); ++i) {
    std::vector<double> rounds;
    for (std::size_t k = i; k < done.seconds.size(); k += timed.size())
      rounds.push_back(1e9 * done.seconds[k] / static_cast<double>(timed[i].bounces()));
    timed[i].errors = done.results[i];
    timed[i].nanoseconds = median_of_rounds(rounds);
  }
  return timed;
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const std::vector<BouncePolicy> policies = policies_asked(settings);
  const std::vector<Cell> cells = make_bounce_cells(settings, policies.size());
  const std::int64_t bounces = settings.trials("bounces", 1, std::int64_t(1) << 30, options.trials);
  const std::int64_t runs = settings.integer("runs", 2, 100000), run_bounces = settings.integer("run_bounces", 1, 4096);
  const std::int64_t rounds = settings.integer("rounds", 1, 1000);
  const std::vector<double> mass_ratios = settings.numbers("mass_ratio", {.lower = 1, .upper = 1e16});
  const int digits = static_cast<int>(settings.integer("digits", 0, 7));
  const std::uint64_t seed = options.seed;
  Cell long_cell = cells[cells.size() / 2];  // the middle step, without loss
  long_cell.restitution = 1;
  const std::vector<WorkRow> timed = timed_of(cells, policies);

  std::vector<Task<std::vector<Scenario>>> crowd_tasks;
  std::vector<Task<Tally>> cell_tasks, timing_tasks;
  std::vector<Task<std::vector<LongRunPoint>>> long_tasks;
  for (const std::string& group : groups_asked(settings))
    crowd_tasks.push_back({"scenario " + group, 1, [=] { return bounce_scenarios(group, mass_ratios, digits); }});
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
    for (const WorkRow& t : timed) {
      timing_tasks.push_back({fmt::format("time {} {} {}", round, bounce_factors().key(t.cell), t.policy.name),
                              t.bounces(), [t] { return t.bounce(); }});
    }
  }

  const auto finish = [=](const Done<std::vector<Scenario>>& crowds, const Done<Tally>& tallies,
                          const Done<std::vector<LongRunPoint>>& long_runs, const Done<Tally>& times) {
    Results results;
    results.scenarios = flat(crowds.results);
    results.work = work_of(timed, times);
    for (const Cell& cell : cells) {
      for (const BouncePolicy& policy : policies)
        results.rows.push_back({cell, policy, tallies.results[results.rows.size()]});
    }
    const double most = std::ranges::max(cells, {}, &Cell::restitution).restitution;
    results.lively = only(results.rows, [&](const Row& r) { return r.cell.restitution == most; });
    results.tests = bounce_tests(results.rows);
    for (std::size_t i = 0; i < policies.size(); ++i) {
      for (const LongRunPoint& at : long_runs.results[i]) results.long_rows.push_back({policies[i], long_cell, at});
      const std::vector<double> kept = energies(policies[i], long_cell, 0, run_bounces);
      results.dropped.push_back({policies[i], long_cell, {std::ssize(kept), 1, kept.empty() ? 0 : kept.back(), 0}});
    }
    return outcome_of(results, long_cell.step);
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
