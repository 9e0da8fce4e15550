/// See docs/bouncing.md.
#include <memory>
#include <utility>

#include <thinwall/experiments/bouncing/model.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

using Cell = BounceCell;
using Row = BounceRow;
using Tally = BounceTally;
using Scenario = BounceScenario;

constexpr const char* unit = "g h / V";  // of the energy

/// Balls that bounce on and on, whose phases are not random: each follows from the one before. What `energies` tells of them after 1, 2,
/// 4, ... bounces, as long as every run lasts. Each begins at a time of its own within the first step.
std::vector<Tally> long_run(const Cell& cell, std::uint64_t seed, std::int64_t runs, std::int64_t bounces) {
  const RandomStream stream = bounce_factors.stream(cell, seed);
  constexpr std::uint64_t draw = 1;  // draw 0 is the phases'
  std::vector<Tally> tallies;
  for (std::int64_t i = 0; i < runs; ++i) {
    const double elapsed = uniform(random_words(stream, static_cast<std::uint64_t>(i), draw)[0]);
    const std::vector<double> run = energies(cell, elapsed, bounces);
    for (std::size_t n = 1, k = 0; n <= run.size(); n *= 2, ++k) {
      if (k == tallies.size()) tallies.emplace_back();
      tallies[k].add(run[n - 1]);
    }
  }
  std::erase_if(tallies, [=](const Tally& tally) { return tally.trials < runs; });
  return tallies;
}

/// After some bounces without loss.
struct LongRow {
  Cell cell;
  double bounces;     ///< whole, but along a curve
  Tally energy = {};  ///< [1] over that of the first flight

  BounceTheory theory() const { return bounce_theory(cell.policy.name, 0, 1); }
  /// [1] What `energy` would be if every phase were random, to first order; and its standard deviation.
  double random_mean() const {
    const double speed = std::max(0.0, 1 + theory().mean() * delta(cell) * bounces / 2);  // of V
    return speed * speed;
  }
  double random_sigma() const { return std::sqrt(random_mean() * bounces) * delta(cell) * theory().sigma(); }
};

constexpr int even_phases = 32;  // in the middle of equal parts of a step

/// How many are timed at once: all phases so often that it takes less than a millisecond, so that most are not interrupted.
std::int64_t timed_bounces(const Cell& cell) {
  const double steps = 2 / delta(cell) * even_phases;
  return even_phases * std::max(std::int64_t{1}, static_cast<std::int64_t>((1 << 14) / steps));
}

/// What is timed: whole bounces at evenly spaced phases, and nothing else. The tally of the last time: all are alike.
Tally even_bounces(const Cell& cell) {
  Tally tally;
  for (std::int64_t i = 0, all = timed_bounces(cell); i < all; ++i) {
    if (i % even_phases == 0) tally = {};
    tally.add(error_at(cell, (static_cast<double>(i % even_phases) + 0.5) / even_phases));
  }
  return tally;
}

Measured time_of(const Row& row) { return median_of_rounds(row.nanoseconds); }  // [ns] a bounce
double mean_error(const Row& row) { return row.tally.mean * delta(row.cell); }  // [1] of the energy, a bounce
double rms_error(const Row& row) { return row.tally.rms() * delta(row.cell); }  // [1] the same, root of the mean square

struct Results {
  std::vector<Row> rows, lively;  ///< lively: at the highest restitution that was asked for, usually 1
  std::vector<BounceTest> tests;
  std::vector<Scenario> scenarios;
  std::vector<LongRow> long_rows, dropped;  ///< dropped: the one ball that begins with the drop itself
  std::vector<Row> work;                    ///< timed: without loss, at evenly spaced phases, in turn with each other

  std::int64_t scenarios_passed() const { return std::ranges::count(scenarios, true, &Scenario::passed); }
};

constexpr auto cell_of = [](const auto& row) { return row.cell; };
constexpr auto policy_of = [](const auto& row) { return row.cell.policy.name; };

/// The last row of each policy.
template <class R> std::vector<R> last_of_each(const std::vector<R>& rows) {
  std::vector<R> last;
  for (const Group<R>& group : group_by(rows, policy_of)) last.push_back(*group.back());
  return last;
}

// What the tables show.

auto policy_column(auto policy) { return text("policy", "What is done in a step.", policy); }
auto policy_and_step() { return together(policy_column(policy_of), bounce_factors.columns(cell_of, {"step"})); }
auto delta_column() {
  return value("delta", "1", "g h / V: what gravity adds in a step, over the impact speed V.", of(cell_of, delta));
}

Columns<Row> row_columns() {
  const auto mean = [](const Row& r) { return normal_mean(r.tally.mean, r.tally.sigma(), r.tally.trials, normal_95); };
  return columns_of<Row>(
      policy_and_step(), delta_column(), bounce_factors.columns(&Row::cell, {"restitution"}),
      fields(&Row::tally, {"bounces"}),
      measured("mean", unit, "Mean change of the flight's energy, beyond that of the restitution.", mean, "mean_"),
      value("theory", unit, "The same by theory.", [](const Row& r) { return r.theory.mean(); }),
      value("first_order", unit, "The theory for short steps.",
            [](const Row& r) { return bounce_theory(policy_of(r), 0, r.cell.restitution).mean(); }),
      value("residual", "1", "Standard errors between the two; missing where phases do not matter.",
            &Row::mean_residual),
      value("sigma", unit, "Standard deviation over the bounces.", [](const Row& r) { return r.tally.sigma(); }),
      value("sigma_theory", unit, "The same by theory.", [](const Row& r) { return r.theory.sigma(); }),
      value("variance_residual", "1", "Standard errors between the variance and theory.", &Row::variance_residual),
      fields(&Row::tally, {"least", "most"}),
      value("rounding", unit, "What rounding can explain.", [](const Row& r) { return rounding_of(r.cell); }));
}

Table test_table(const std::vector<BounceTest>& tests) {
  using T = BounceTest;
  return in_report(table(
      "self_test", "Means and variances of the change of energy against theory, over all cells of a policy at once.",
      tests, policy_column(&T::policy),
      value("certain_cells", "1", "Cells in which phases do not matter: every bounce must give what theory says.",
            &T::certain_cells),
      value("certain_wrong", "1", "Of those, cells in which one does not; must be 0.", &T::certain_wrong),
      value("judged_cells", "1", "Cells of at least 30 bounces in which they do.",
            of(&T::means, &ResidualTest::judged)),
      value("covered", "1", "Of those, cells whose 95 % interval holds the mean by theory.", &T::covered),
      where(of(&T::means, &ResidualTest::judged),
            allowed_columns<std::int64_t>("covered_", "Least allowed: central 99.9 % of Binomial(judged_cells, 0.95).",
                                          &T::covered_allowed)),
      chi_square_columns("mean_chi_square", "Sum of squared residuals of the means.", &T::means, "mean_"),
      value("spread_cells", "1", "Cells of at least 100 bounces, whose variance is judged too.",
            of(&T::variances, &ResidualTest::judged)),
      chi_square_columns("spread_chi_square", "Sum of squared residuals of the variances.", &T::variances, "spread_"),
      value("other_cells", "1", "Cells with too few bounces to judge.", &T::other_cells),
      value("passed", "", "All of the above hold.", &T::passed)));
}

auto bounces_column() {
  return value("bounces", "1", "Bounces so far.", [](const LongRow& r) { return std::int64_t(r.bounces); });
}

Table dropped_table(const std::vector<LongRow>& rows) {
  return in_report(table(
      "dropped", "The same for one run that begins with the drop itself: its phase may lock where nothing is lost.",
      rows, policy_and_step(), bounces_column(),
      value("energy", "1", "Energy after the last bounce over that of the first flight.",
            of(&LongRow::energy, &Tally::mean)),
      value("random_mean", "1", "Its mean at random phases, to first order.", &LongRow::random_mean)));
}

auto error_columns() {
  return together(value("mean_error", "1", "Mean change of the energy a bounce, relative.", mean_error),
                  value("rms_error", "1", "Root of its mean square.", rms_error));
}

Table timings_table(const std::vector<Row>& work) {
  return timing(in_report(table(
      "timings", "Time a bounce, from apex to apex, on this machine, the threads of the run at work.", work,
      policy_and_step(), error_columns(), measured("nanoseconds", "ns", "A bounce; median over the rounds.", time_of),
      value("nanoseconds_per_step", "ns", "The median over the steps of a bounce, 2 V / (g h).",
            [](const Row& w) { return time_of(w).value * delta(w.cell) / 2; }))));
}

// What the pictures show.

Figure energy_figure(const std::vector<Row>& rows, const Table& means) {
  const auto over_step = [&](const char* y, const char* label) {
    return plot(means).x("step", Axis::log).y(y, Axis::linear, label).by("policy");
  };
  Plot energies = over_step("mean", "energy a bounce [g h / V]");
  for (const Row& row : last_of_each(rows)) {
    energies.curve("theory", [row](double step) {
      return bounce_theory(policy_of(row), delta(row.cell) * step / row.cell.step, row.cell.restitution).mean();
    });
  }
  Plot residuals = over_step("residual", "deviation [standard errors]").height(0.6);
  for (const double at : {-1.96, 1.96}) residuals.level("95 % of chance", at, Mark::dashes);
  return {.name = "energy_per_bounce",
          .title = "What a bounce at random phase does to the energy",
          .caption = fmt::format(
              "Mean change of the flight's energy a bounce at restitution {:g}, in units of g h / V of it, with 95 % "
              "intervals (mostly hidden by their points), and the theory. Below, how far the means are from it; the "
              "policies share their phases, so these deviations are almost the same or opposite.",
              rows.front().cell.restitution),
          .panels = {energies, residuals}};
}

Figure work_figure(const std::vector<Row>& work) {
  const auto panel = [&](std::string label, double (*error)(const Row&)) {
    constexpr double least_error = 0x1p-60;  // drawn in place of an error that is less, down to 0
    return joined(plot(work, policy_column(policy_of), measured("nanoseconds", "ns", "", time_of),
                       value("error", "1", "", [=](const Row& w) { return std::max(least_error, std::abs(error(w))); }))
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
      .panels = {panel("rms energy error a bounce [1]", rms_error),
                 panel("|mean| of the energy error [1]", mean_error)},
      .is_timing = true};
}

Figure long_figure(const std::vector<LongRow>& rows, const Table& runs, double step) {
  Plot both = plot(runs).x("bounces", Axis::log, "bounces").by("policy");
  Plot means = Plot(both).y("mean", Axis::linear, "mean energy / first [1]");
  Plot sigmas = both.where("sigma", [](double x) { return x > 1e-9; }).y("sigma", Axis::log, "standard deviation [1]");
  for (const LongRow& last : last_of_each(rows)) {
    const auto add = [&](Plot& panel, double (LongRow::*part)() const) {
      const auto curve = [=](double n) { return (LongRow{last.cell, n}.*part)(); };
      panel.curve("random phases", curve, 1, last.bounces);
    };
    add(means, &LongRow::random_mean);
    if (last.random_sigma() > 0) add(sigmas, &LongRow::random_sigma);
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
  Series flown = {.label = "true flight", .mark = Mark::dashes};
  add_curve(flown, 0, end, Axis::linear, truth, 400);
  for (const Row& row : last_of_each(rows)) {
    cell.policy = row.cell.policy;
    Series stepped = {.label = std::string(cell.policy.name)};
    for (const double gap : heights(cell, elapsed, static_cast<std::int64_t>(end / cell.step - elapsed)))
      stepped.add((elapsed + static_cast<double>(stepped.x.size())) * cell.step, gap);
    figure.panels.push_back(
        joined({.x_label = "time [s]", .y_label = "height [m]", .height = 0.45, .series = {stepped, flown}}));
  }
  return figure;
}

// What it says.

/// What is good at the least cost: rms error and time of the exact arc at its coarsest step beside the best of the others.
std::string cost_sentence(const std::vector<Row>& work) {
  const auto is_arc = [](const Row& w) { return policy_of(w) == "parabola_toi"; };
  const auto arcs = only(work, is_arc), others = only(work, std::not_fn(is_arc));
  if (arcs.empty() || others.empty()) return "";
  const Row& best = *std::ranges::min_element(others, {}, rms_error);
  return fmt::format(
      "The exact arc is off by {:.1e} (rms) at its coarsest step, in {:.0f} ns a bounce; the nearest of the others, {} "
      "at {:.3g} s, by {:.1e} in {:.0f} ns. ",
      rms_error(arcs[0]), time_of(arcs[0]).value, policy_of(best), best.cell.step, rms_error(best),
      time_of(best).value);
}

std::string answer_of(const Results& results) {
  std::vector<std::string> means;
  for (const Row& row : last_of_each(results.lively)) {
    const double mean = std::abs(row.tally.mean) < 5e-3 ? 0 : row.tally.mean;
    means.push_back(fmt::format("{} {:+.2f}", policy_of(row), mean));
  }
  const Cell& last = results.lively.back().cell;
  const auto was_asked = [](const BounceTest& t) { return t.certain_cells + t.means.judged > 0; };
  const char* const verdict = !all_passed(results.tests)                      ? "DISAGREES"
                              : std::ranges::all_of(results.tests, was_asked) ? "agrees"
                                                                              : "not judged: too few bounces";
  return fmt::format(
      "At random phase a bounce at restitution {:g} changes the energy by, in units of g h / V: {} ({:.3g} s steps; "
      "theory {}). {}{} of {} crowds of impacts end as they must.",
      last.restitution, fmt::join(means, ", "), last.step, verdict, cost_sentence(results.work),
      results.scenarios_passed(), results.scenarios.size());
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

/// Of a table by policy and step: each policy at some of its rows, from 0, the first, to 1, the last.
Table only_at(const std::vector<double>& places, Table table) {
  std::vector<std::vector<Value>> some;
  for (const auto& rows : group_by(table.rows, [](const auto& row) { return row[0]; })) {
    for (const double place : places)
      some.push_back(*rows[static_cast<std::size_t>(std::lround(place * static_cast<double>(rows.size() - 1)))]);
  }
  table.rows = distinct(some, std::identity());
  return table;
}

Outcome outcome_of(const Results& results, double long_step) {
  const Table means =
      in_report(table("means", "Change of energy a bounce at random phase and the highest restitution, against theory.",
                      row_columns(), results.lively));
  const Table runs = in_report(
      table("long_runs",
            "One ball that bounces on and on without loss: energy after a number of bounces over that of the first "
            "flight, and what it would be, to first order in g h / V, if every phase were random (sigma 0: it is "
            "of higher order). Over runs that begin at random in the first step, as long as all last.",
            results.long_rows, policy_and_step(), bounces_column(),
            value("runs", "1", "Balls.", of(&LongRow::energy, &Tally::trials)),
            value("mean", "1", "Mean energy over the first.", of(&LongRow::energy, &Tally::mean)),
            value("random_mean", "1", "The same at random phases, to first order.", &LongRow::random_mean),
            value("sigma", "1", "Standard deviation over the runs.", of(&LongRow::energy, &Tally::sigma)),
            value("random_sigma", "1", "The same at random phases, to first order.", &LongRow::random_sigma)));
  const Table dropped = dropped_table(results.dropped), timings = timings_table(results.work);
  const Table crowds = in_report(table("scenarios", "Impacts that come in crowds: what must happen, and what did.",
                                       results.scenarios, fields(std::identity())));
  return {
      .answer = answer_of(results),
      .summary =
          terminal(only_at({0, 1}, means),
                   {"policy", "step", "restitution", "mean", "theory", "sigma", "sigma_theory"}) +
          "\n" + terminal(only_at({0.5}, timings), {"policy", "step", "nanoseconds_per_step", "rms_error"}) + "\n" +
          terminal(only_at({1}, runs), {"policy", "step", "bounces", "mean", "random_mean", "sigma", "random_sigma"}) +
          "\n" + terminal(dropped) + crowd_lines(results) +
          fmt::format("\nSelf-test: energies {}, crowds {}.\n", verdict_text(all_passed(results.tests)),
                      verdict_text(all_passed(results.scenarios))),
      .tables = {means, crowds, runs, dropped, test_table(results.tests),
                 table("cells", "Change of energy a bounce at random phase, every cell and policy, against theory.",
                       row_columns(), results.rows),
                 table(
                     "even_phases",
                     "Change of energy a bounce without loss at evenly spaced phases: the errors of the timed bounces.",
                     results.work, policy_and_step(), delta_column(),
                     value("bounces", "1", "Phases.", of(&Row::tally, &Tally::trials)), error_columns()),
                 timings},
      .figures = {energy_figure(results.lively, means), work_figure(results.work),
                  long_figure(results.long_rows, runs, long_step), heights_figure(results.rows)},
      .self_test_passed = all_passed(results.tests) && all_passed(results.scenarios)};
}

// What is run.

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const std::vector<Cell> cells = make_bounce_cells(settings);
  const std::int64_t bounces = settings.trials("bounces", 1, std::int64_t(1) << 30, options.trials);
  const std::int64_t runs = settings.integer("runs", 2, 100000), run_bounces = settings.integer("run_bounces", 1, 4096);
  const std::int64_t rounds = settings.integer("rounds", 1, 1000);
  const std::vector<double> mass_ratios = settings.numbers("mass_ratio", {.lower = 1, .upper = 1e16});
  const int digits = static_cast<int>(settings.integer("digits", 0, 7));
  const double middle_step = cells[cells.size() / 2].step;
  // Every policy at every step, without loss.
  std::vector<Cell> timed = only(cells, [&](const Cell& c) { return c.restitution == cells[0].restitution; });
  for (Cell& cell : timed) cell.restitution = 1;
  const std::vector<Cell> long_cells = only(timed, [=](const Cell& c) { return c.step == middle_step; });

  const auto key_of = [](const Cell& c) { return fmt::format("{} {}", bounce_factors.key(c), c.policy.name); };
  const auto long_key = [](const Cell& c) { return fmt::format("long run {}", c.policy.name); };
  std::vector<Task<std::vector<Scenario>>> crowd_tasks;
  for (const std::string& group : settings.choices_as_asked("scenario", scenario_groups))
    crowd_tasks.push_back({"scenario " + group, 1, [=] { return bounce_scenarios(group, mass_ratios, digits); }});
  auto cell_tasks = tasks_of(cells, key_of, bounces,
                             [=, seed = options.seed](const Cell& c) { return random_bounces(c, seed, bounces); });
  auto long_tasks = tasks_of(long_cells, long_key, runs * run_bounces,
                             [=, seed = options.seed](const Cell& c) { return long_run(c, seed, runs, run_bounces); });
  std::vector<Task<Tally>> timing_tasks;
  for (std::int64_t round = 0; round < rounds; ++round) {
    for (const Cell& cell : timed) {
      timing_tasks.push_back(
          {fmt::format("time {} {}", round, key_of(cell)), timed_bounces(cell), [cell] { return even_bounces(cell); }});
    }
  }

  const auto finish = [=](const auto& crowds, const auto& tallies, const auto& long_runs, const auto& times) {
    Results results;
    results.scenarios = flat(crowds.results);
    for (std::size_t i = 0; i < times.results.size(); ++i) {
      if (i < timed.size()) results.work.push_back({timed[i], times.results[i]});
      Row& row = results.work[i % timed.size()];
      row.nanoseconds.push_back(1e9 * times.seconds[i] / static_cast<double>(timed_bounces(row.cell)));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) results.rows.push_back({cells[i], tallies.results[i]});
    const double most = std::ranges::max(cells, {}, &Cell::restitution).restitution;
    results.lively = only(results.rows, [&](const Row& r) { return r.cell.restitution == most; });
    results.tests = bounce_tests(results.rows);
    for (std::size_t i = 0; i < long_cells.size(); ++i) {
      for (double n = 1; const Tally& energy : long_runs.results[i]) {
        results.long_rows.push_back({long_cells[i], n, energy});
        n *= 2;
      }
      const std::vector<double> kept = energies(long_cells[i], 0, run_bounces);
      LongRow& last = results.dropped.emplace_back(LongRow{long_cells[i], static_cast<double>(kept.size())});
      if (!kept.empty()) last.energy.add(kept.back());
    }
    return outcome_of(results, middle_step);
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
