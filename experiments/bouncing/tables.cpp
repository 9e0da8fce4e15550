#include <thinwall/experiments/bouncing/tables.hpp>

#include <cmath>

namespace thinwall {

namespace {

using enum ColumnType;

constexpr const char* unit = "g h / V";  // of the energy

Column policy_column() { return {"policy", text, "", "What is done in a step."}; }
Column step_column() { return {"step", number, "s", "Time step h."}; }
Column delta_column() {
  return {"delta", number, "1", "g h / V: what gravity adds in a step, over the impact speed V."};
}

Value maybe(const std::optional<double>& x) { return x ? Value(*x) : Value(); }

Table cells(const std::vector<BounceLine>& lines) {
  Table table;
  table.columns = {
      policy_column(),
      step_column(),
      delta_column(),
      {"restitution", number, "1", "Speed after over speed before."},
      {"bounces", integer, "1", "Bounces at random phase."},
      {"mean", number, unit, "Mean change of the flight's energy, beyond that of the restitution.", "mean_lower",
       "mean_upper"},
      {"mean_lower", number, unit, "Lower end of its 95 % interval."},
      {"mean_upper", number, unit, "Upper end of its 95 % interval."},
      {"theory", number, unit, "The same by theory."},
      {"first_order", number, unit, "The theory for short steps."},
      {"residual", number, "1", "Standard errors between the two; missing where phases do not matter."},
      {"sigma", number, unit, "Standard deviation over the bounces."},
      {"sigma_theory", number, unit, "The same by theory."},
      {"variance_residual", number, "1", "Standard errors between the variance and theory."},
      {"least", number, unit, "The bounce that loses most."},
      {"most", number, unit, "The bounce that gains most."},
      {"rounding", number, unit, "What rounding can explain."},
  };
  for (const BounceLine& l : lines) {
    const Interval interval = mean_interval(l);
    table.rows.push_back({l.policy, l.cell.step, delta(l.cell), l.cell.restitution, l.tally.trials, l.tally.mean,
                          interval.lower, interval.upper, l.theory.mean(),
                          bounce_theory(l.policy, 0, l.cell.restitution).mean(), maybe(mean_residual(l)),
                          l.tally.sigma(), l.theory.sigma(), maybe(variance_residual(l)), l.tally.least, l.tally.most,
                          rounding_of(l.cell)});
  }
  return table;
}

}  // namespace

Table bounce_means_table(const std::vector<BounceLine>& lines) {
  Table table = cells(liveliest(lines));
  table.name = "means";
  table.description = "Change of energy a bounce at random phase and the highest restitution, against theory.";
  table.in_report = true;
  return table;
}

Table bounce_cells_table(const std::vector<BounceLine>& lines) {
  Table table = cells(lines);
  table.name = "cells";
  table.description = "Change of energy a bounce at random phase, every cell and policy, against theory.";
  return table;
}

Table bounce_test_table(const std::vector<BounceTest>& tests) {
  Table table;
  table.name = "self_test";
  table.description = "Means and variances of the change of energy against theory, over all cells of a policy at once.";
  table.in_report = true;
  table.columns = {
      policy_column(),
      {"certain_cells", integer, "1", "Cells in which phases do not matter: every bounce must give what theory says."},
      {"certain_wrong", integer, "1", "Of those, cells in which one does not; must be 0."},
      {"judged_cells", integer, "1", "Cells of at least 30 bounces in which they do."},
      {"covered", integer, "1", "Of those, cells whose 95 % interval holds the mean by theory."},
      {"covered_lower", integer, "1", "Least allowed: central 99.9 % of Binomial(judged_cells, 0.95)."},
      {"covered_upper", integer, "1", "Most allowed."},
      {"mean_chi_square", number, "1", "Sum of squared residuals of the means."},
      {"mean_lower", number, "1", "Least allowed: central 99.9 % of the chi-square distribution."},
      {"mean_upper", number, "1", "Most allowed."},
      {"spread_cells", integer, "1", "Cells of at least 100 bounces, whose variance is judged too."},
      {"spread_chi_square", number, "1", "Sum of squared residuals of the variances."},
      {"spread_lower", number, "1", "Least allowed, in the same way."},
      {"spread_upper", number, "1", "Most allowed."},
      {"other_cells", integer, "1", "Cells with too few bounces to judge."},
      {"passed", boolean, "", "All of the above hold."},
  };
  for (const BounceTest& t : tests) {
    const auto if_mean = [&](const Value& x) { return t.judged_cells > 0 ? x : Value(); };
    const auto if_spread = [&](const Value& x) { return t.spread_cells > 0 ? x : Value(); };
    table.rows.push_back({t.policy, t.certain_cells, t.certain_wrong, t.judged_cells, t.covered,
                          if_mean(static_cast<std::int64_t>(t.covered_allowed.lower)),
                          if_mean(static_cast<std::int64_t>(t.covered_allowed.upper)), if_mean(t.mean_chi_square),
                          if_mean(t.mean_allowed.lower), if_mean(t.mean_allowed.upper), t.spread_cells,
                          if_spread(t.spread_chi_square), if_spread(t.spread_allowed.lower),
                          if_spread(t.spread_allowed.upper), t.other_cells, t.passed()});
  }
  return table;
}

Table scenarios_table(const std::vector<ScenarioGroup>& groups) {
  Table table;
  table.name = "scenarios";
  table.description = "Impacts that come in crowds: what must happen, and what did.";
  table.in_report = true;
  table.columns = {{"group", text, "", "Kind of scenario."},
                   {"scenario", text, "", "What is done."},
                   {"must", text, "", "What must happen."},
                   {"happened", text, "", "What did."},
                   {"passed", boolean, "", "It is what must."}};
  for (const ScenarioGroup& group : groups) {
    for (const BounceScenario& s : group.scenarios) {
      table.rows.push_back({group.name, s.name, s.must, s.happened, s.passed});
    }
  }
  return table;
}

Table long_runs_table(const std::vector<LongRun>& runs) {
  Table table;
  table.name = "long_runs";
  table.description =
      "One ball that bounces on and on without loss: energy after a number of bounces over that of the first flight, and what "
      "it would be if every phase were random. Over runs that begin at random in the first step, as long as all last.";
  table.in_report = true;
  table.columns = {policy_column(),
                   step_column(),
                   {"bounces", integer, "1", "Bounces so far."},
                   {"runs", integer, "1", "Balls."},
                   {"mean", number, "1", "Mean energy over the first."},
                   {"random_mean", number, "1", "The same at random phases, to first order."},
                   {"sigma", number, "1", "Standard deviation over the runs."},
                   {"random_sigma", number, "1", "The same at random phases, to first order."}};
  for (const LongRun& run : runs) {
    for (const LongRunPoint& p : run.points) {
      const auto n = static_cast<double>(p.bounces);
      table.rows.push_back({run.policy, run.cell.step, p.bounces, p.runs, p.mean, random_phase_mean(run, n), p.sigma,
                            random_phase_sigma(run, n)});
    }
  }
  return table;
}

Table dropped_table(const std::vector<LongRun>& runs) {
  Table table;
  table.name = "dropped";
  table.description =
      "The same for one run that begins with the drop itself: its phase may lock where nothing is lost.";
  table.in_report = true;
  table.columns = {policy_column(),
                   step_column(),
                   {"bounces", integer, "1", "Bounces that the run lasted."},
                   {"energy", number, "1", "Energy after the last of them over that of the first flight."},
                   {"random_mean", number, "1", "Its mean at random phases, to first order."}};
  for (const LongRun& run : runs) {
    table.rows.push_back({run.policy, run.cell.step, run.rest_count, run.dropped_at_rest,
                          random_phase_mean(run, static_cast<double>(run.rest_count))});
  }
  return table;
}

Table even_phases_table(const std::vector<BounceWork>& work) {
  Table table;
  table.name = "even_phases";
  table.description =
      "Change of energy a bounce without loss at evenly spaced phases: the errors of the timed bounces.";
  table.columns = {policy_column(),
                   step_column(),
                   delta_column(),
                   {"bounces", integer, "1", "Phases."},
                   {"mean_error", number, "1", "Mean change of the energy a bounce, relative."},
                   {"rms_error", number, "1", "Root of its mean square."}};
  for (const BounceWork& w : work) {
    table.rows.push_back({w.policy, w.cell.step, delta(w.cell), w.errors.trials, w.mean_error(), w.rms_error()});
  }
  return table;
}

Table bounce_timings_table(const std::vector<BounceWork>& work) {
  Table table;
  table.name = "timings";
  table.description = "Time a bounce, from apex to apex, on this machine with every core at work.";
  table.is_timing = table.in_report = true;
  table.columns = {policy_column(),
                   step_column(),
                   {"mean_error", number, "1", "Mean change of the energy a bounce, relative."},
                   {"rms_error", number, "1", "Root of its mean square."},
                   {"nanoseconds", number, "ns", "A bounce; median over the rounds.", "lower", "upper"},
                   {"lower", number, "ns", "Lower end of its 95 % bootstrap interval."},
                   {"upper", number, "ns", "Upper end of it."},
                   {"nanoseconds_per_step", number, "ns", "The median over the steps of a bounce, 2 V / (g h)."}};
  for (const BounceWork& w : work) {
    table.rows.push_back({w.policy, w.cell.step, w.mean_error(), w.rms_error(), w.nanoseconds, w.interval.lower,
                          w.interval.upper, w.nanoseconds * delta(w.cell) / 2});
  }
  return table;
}

}  // namespace thinwall
