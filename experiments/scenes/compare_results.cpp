#include <thinwall/experiments/scenes/compare_results.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/statistics.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

using enum ColumnType;

Value median_error(const Contest& c) { return c.errors.empty() ? Value() : Value(median(c.errors)); }
Value largest_error(const Contest& c) { return c.errors.empty() ? Value() : Value(c.errors.back()); }

/// [s] of stepping one second of the scene.
double cost(const Contest& c, double duration) { return median(c.seconds) / duration; }

bool looks_at_all_motion(TimePolicy policy) {
  return policy == TimePolicy::clamp || policy == TimePolicy::event_driven;
}

std::string milliseconds(const Value& value) {
  const double* const seconds = std::get_if<double>(&value);
  return seconds ? rounded_text(1e3 * *seconds, 3) : "-";
}

std::string row_text(const Contest& c, double duration) {
  return fmt::format("{:<14}{:>10}{:>10}{:>8}{:>8}{:>8}{:>12}{:>12}{:>14}\n", c.contender->label(),
                     rounded_text(1e3 * c.contender->dt, 4), grouped_text(c.trial.tunneled), grouped_text(c.met),
                     grouped_text(c.unmet), grouped_text(c.extra), milliseconds(median_error(c)),
                     milliseconds(largest_error(c)), rounded_text(1e3 * cost(c, duration), 3));
}

/// The fastest that let nothing through, and if `all_met`, met every pair.
const Contest* cheapest_clean(const std::vector<Contest>& contests, bool all_met) {
  const Contest* best = nullptr;
  for (const Contest& c : contests) {
    if (c.trial.tunneled > 0 || (all_met && c.unmet > 0)) continue;
    if (!best || median(c.seconds) < median(best->seconds)) best = &c;
  }
  return best;
}

std::string answer_text(const Comparison& comparison, const Trial& exact, const std::vector<Contest>& contests) {
  std::string text = fmt::format("In {} s the exact run of '{}' has {} pairs of bodies that meet. ",
                                 rounded_text(comparison.scene.duration(), 4), comparison.scene.name,
                                 grouped_text(static_cast<std::int64_t>(exact.meetings.size())));
  for (const Contest& c : contests) {
    if (c.contender->policy != TimePolicy::discrete || c.contender->dt != contests.back().contender->dt) continue;
    text +=
        fmt::format("Looking only at the end of steps of {} ms, {} go through each other unseen and {} never meet. ",
                    rounded_text(1e3 * c.contender->dt, 4), grouped_text(c.trial.tunneled), grouped_text(c.unmet));
  }
  const Contest* const all_met = cheapest_clean(contests, true);
  const Contest* const best = all_met ? all_met : cheapest_clean(contests, false);
  if (!best) return text + "None of the ways compared lets nothing through.";
  text += fmt::format("The fastest that lets nothing through{} is {} at {} ms: {} ms of run time a second of the scene",
                      all_met ? " and meets every pair" : "", best->contender->label(),
                      rounded_text(1e3 * best->contender->dt, 4),
                      rounded_text(1e3 * cost(*best, comparison.scene.duration()), 3));
  if (all_met) return text + fmt::format(", first meetings off by {} ms at most.", milliseconds(largest_error(*best)));
  return text + ". No way meets every pair that the exact run does: after enough bounces any two runs part.";
}

}  // namespace

Table compare_table(const std::vector<Contest>& contests) {
  Table table;
  table.name = "compare";
  table.description = "Each time policy and step against the exact run.";
  table.in_report = true;
  table.columns = {
      {"policy", text, "", "Time policy; substeps_N tests N poses a step."},
      {"dt", number, "s", "Step."},
      {"tunneled", integer, "1", "Pairs that went through each other unseen, counted step by step."},
      {"met", integer, "1", "Pairs of bodies that met here and in the exact run."},
      {"unmet", integer, "1", "Pairs that met in the exact run alone, in time for this one to see it."},
      {"extra", integer, "1", "Pairs that met here alone."},
      {"error_median", number, "s", "Between the first meetings of a pair here and there: median over pairs."},
      {"error_largest", number, "s", "The same: the largest."},
      {"hits", integer, "1", "Contacts over all steps."},
      {"sweeps", integer, "1", "Pairs asked over all steps: the machine-independent cost."},
      {"energy_change", number, "J", "Energy at the end less energy at the start."},
      {"repeated_alike", boolean, "", "Every repeat gave the same bits."},
  };
  for (const Contest& c : contests) {
    table.rows.push_back({c.contender->label(), c.contender->dt, c.trial.tunneled, c.met, c.unmet, c.extra,
                          median_error(c), largest_error(c), c.trial.hits, c.trial.sweeps,
                          c.trial.energy_end - c.trial.energy, c.repeated_alike});
  }
  return table;
}

Table compare_timings_table(const Comparison& comparison, const std::vector<Contest>& contests) {
  Table table;
  table.name = "timings";
  table.description = "Run time of stepping one second of the scene, with other contenders at work on other cores.";
  table.is_timing = true;
  table.in_report = true;
  table.columns = {
      {"policy", text, "", "Time policy; substeps_N tests N poses a step."},
      {"dt", number, "s", "Step."},
      {"seconds", number, "1", "Run time over time of the scene: median of the repeats."},
      {"seconds_least", number, "1", "The shortest of the repeats."},
      {"seconds_most", number, "1", "The longest."},
  };
  const double duration = comparison.scene.duration();
  for (const Contest& c : contests) {
    const auto [least, most] = std::minmax_element(c.seconds.begin(), c.seconds.end());
    table.rows.push_back(
        {c.contender->label(), c.contender->dt, cost(c, duration), *least / duration, *most / duration});
  }
  return table;
}

Outcome compare_outcome(const Comparison& comparison, const Trial& exact, const std::vector<Contest>& contests) {
  Outcome out;
  const double duration = comparison.scene.duration();
  out.answer = answer_text(comparison, exact, contests);
  out.summary = fmt::format(
      "{}: {} bodies, {} s. Exact run: by events, steps of {} ms; {} pairs meet.\n"
      "Errors and steps in ms; run time in ms a second of the scene.\n\n"
      "{:<14}{:>10}{:>10}{:>8}{:>8}{:>8}{:>12}{:>12}{:>14}\n",
      comparison.scene.name, grouped_text(static_cast<std::int64_t>(comparison.scene.bodies.size())),
      rounded_text(duration, 4), rounded_text(1e3 * comparison.exact.dt, 4),
      grouped_text(static_cast<std::int64_t>(exact.meetings.size())), "policy", "step", "tunneled", "met", "unmet",
      "extra", "error", "largest", "run time");
  bool held = true;
  for (const Contest& c : contests) {
    out.summary += row_text(c, duration);
    held &= c.repeated_alike;
    if (looks_at_all_motion(c.contender->policy) && comparison.scene.options.gate == 0) held &= c.trial.tunneled == 0;
  }
  out.summary += fmt::format("\nSelf-test: {}.\n", held && exact.tunneled == 0 ? "passed" : "FAILED");
  out.tables = {compare_table(contests), compare_timings_table(comparison, contests)};
  out.figures = {compare_figure(comparison, contests), error_against_time_figure(comparison, contests)};
  out.sections = {
      {"What is compared",
       "Every contender steps the same scene for the same time. The exact run is stepped by events, with steps shorter "
       "than any contender's; under gravity its path is that of the integrator still, which errs by g t dt / 2. Of each "
       "pair of bodies the first meeting is compared and no later one: after a bounce at another time two runs part. A pair "
       "that met first in the exact run and never here counts as unmet, unless that was within the last step.\n\n"
       "Tunneled is counted step by step, without the exact run: two bodies that nothing else touched in the step, apart "
       "before and after it, which the closed form finds to have touched on the way."},
      {"Self-test",
       "Policies that look at all of the motion let nothing through, and each repeat gives the same bits. "
       "A scene of many bodies that bounce is chaotic: there unmet and extra pairs say that two runs parted, not that one "
       "is wrong."},
      {"Limits",
       "Only first meetings are compared. Bodies do not turn, and there is no friction. Times are of this machine, the scene's "
       "threads at work."},
  };
  out.self_test_passed = held && exact.tunneled == 0;
  return out;
}

}  // namespace thinwall
