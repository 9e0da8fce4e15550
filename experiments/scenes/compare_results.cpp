#include <thinwall/experiments/scenes/comparison.hpp>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

std::optional<double> median_error(const Contest& c) {
  return c.errors.empty() ? std::nullopt : std::optional(median(c.errors));
}
std::optional<double> largest_error(const Contest& c) {
  return c.errors.empty() ? std::nullopt : std::optional(c.errors.back());
}

/// [s] of stepping one second of the scene.
double cost(const Contest& c, double duration) { return median(c.seconds) / duration; }

std::string milliseconds(const std::optional<double>& seconds) {
  return seconds ? rounded_text(1e3 * *seconds, 3) : "-";
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
    if (c.contender.policy != TimePolicy::discrete || c.contender.dt != contests.back().contender.dt) continue;
    text +=
        fmt::format("Looking only at the end of steps of {} ms, {} go through each other unseen and {} never meet. ",
                    rounded_text(1e3 * c.contender.dt, 4), grouped_text(c.trial.tunneled), grouped_text(c.unmet));
  }
  const Contest* const all_met = cheapest_clean(contests, true);
  const Contest* const best = all_met ? all_met : cheapest_clean(contests, false);
  if (!best) return text + "None of the ways compared lets nothing through.";
  text += fmt::format("The fastest that lets nothing through{} is {} at {} ms: {} ms of run time a second of the scene",
                      all_met ? " and meets every pair" : "", best->contender.label(),
                      rounded_text(1e3 * best->contender.dt, 4),
                      rounded_text(1e3 * cost(*best, comparison.scene.duration()), 3));
  if (all_met) return text + fmt::format(", first meetings off by {} ms at most.", milliseconds(largest_error(*best)));
  return text + ". No way meets every pair that the exact run does: after enough bounces any two runs part.";
}

Columns<Contest> key_columns() {
  return columns_of<Contest>(text("policy", "Time policy; substeps_N tests N poses a step.",
                                  [](const Contest& c) { return c.contender.label(); }),
                             value("dt", "s", "Step.", [](const Contest& c) { return c.contender.dt; }));
}

auto run_time_column(double duration) {
  return value("seconds", "1", "Run time over time of the scene: median of the repeats.",
               [duration](const Contest& c) { return cost(c, duration); });
}

Columns<Contest> compare_columns() {
  return columns_of<Contest>(
      key_columns(), fields(&Contest::trial, {"tunneled"}),
      value("met", "1", "Pairs of bodies that met here and in the exact run.", &Contest::met),
      value("unmet", "1", "Pairs that met in the exact run alone, in time for this one to see it.", &Contest::unmet),
      value("extra", "1", "Pairs that met here alone.", &Contest::extra),
      value("error_median", "s", "Between the first meetings of a pair here and there: median over pairs.",
            median_error),
      value("error_largest", "s", "The same: the largest.", largest_error), fields(&Contest::trial, {"hits", "sweeps"}),
      value("energy_change", "J", "Energy at the end less energy at the start.",
            [](const Contest& c) { return c.trial.energy_end - c.trial.energy; }),
      value("repeated_alike", "", "Every repeat gave the same bits.", &Contest::repeated_alike));
}

Table compare_table(const std::vector<Contest>& contests) {
  return in_report(table("compare", "Each time policy and step against the exact run.", compare_columns(), contests));
}

Table compare_timings_table(const Comparison& comparison, const std::vector<Contest>& contests) {
  const double duration = comparison.scene.duration();
  const auto columns =
      columns_of<Contest>(key_columns(), run_time_column(duration),
                          value("seconds_least", "1", "The shortest of the repeats.",
                                [duration](const Contest& c) { return std::ranges::min(c.seconds) / duration; }),
                          value("seconds_most", "1", "The longest.",
                                [duration](const Contest& c) { return std::ranges::max(c.seconds) / duration; }));
  return in_report(timing(
      table("timings", "Run time of stepping one second of the scene, with other contenders at work on other cores.",
            columns, contests)));
}

/// What the pictures show of each.
Table drawn_table(const Comparison& comparison, const std::vector<Contest>& contests) {
  const double duration = comparison.scene.duration();
  const double least = duration * std::numeric_limits<double>::epsilon();  // [s] a rounding; a logarithm has no zero
  const auto error = [least](const Contest& c) {
    const auto middle = median_error(c);
    return middle ? std::optional(std::max(*middle, least)) : std::nullopt;
  };
  const auto run_time = [duration](const Contest& c) {
    const auto [shortest, longest] = std::ranges::minmax(c.seconds);
    return Measured{cost(c, duration), {shortest / duration, longest / duration}};
  };
  const auto columns = columns_of<Contest>(
      key_columns(), value("step", "", "", [](const Contest& c) { return 1e3 * c.contender.dt; }),
      fields(&Contest::trial, {"tunneled"}), value("error", "", "", error), measured("seconds", "", "", run_time));
  return table("drawn", "", columns, contests);
}

/// Tunneled pairs and time error against the step, one series a policy.
Figure compare_figure(const Comparison& comparison, const std::vector<Contest>& contests) {
  Plot by_step = plot(drawn_table(comparison, contests)).x("step", Axis::log, "step [ms]").by("policy");
  const Panel tunneled = by_step.y("tunneled", Axis::linear, "tunneled pairs [1]");
  return {.name = "compare",
          .title = "Discrete or swept, on this scene",
          .caption =
              "Above: pairs that went through each other unseen. Below: the median over pairs of how far their first "
              "meeting is from the exact run's; errors below a rounding of the duration are drawn at that.",
          .panels = {tunneled, by_step.y("error", Axis::log, "error of first meetings [s]")}};
}

/// Time error against run time.
Figure error_against_time_figure(const Comparison& comparison, const std::vector<Contest>& contests) {
  return {.name = "error_against_time",
          .title = "What an error of the first meetings costs",
          .caption =
              "Median run time of the repeats against the median error, a point for each step; bars from the "
              "shortest to the longest repeat. A policy that misses a pair altogether has no error for it: see the "
              "table.",
          .panels = {plot(drawn_table(comparison, contests))
                         .x("error", Axis::log, "median error of first meetings [s]")
                         .y("seconds", Axis::log, "run time a second of the scene [s]")
                         .by("policy")},
          .is_timing = true};
}

}  // namespace

Outcome compare_outcome(const Comparison& comparison, const Trial& exact, const std::vector<Contest>& contests) {
  Outcome out;
  const double duration = comparison.scene.duration();
  out.answer = answer_text(comparison, exact, contests);
  const Table shown = table(
      "compare",
      fmt::format("{}: {} bodies, {} s. Exact run: by events, steps of {} ms; {} pairs meet. Seconds of run time a "
                  "second of the scene.",
                  comparison.scene.name, grouped_text(std::ssize(comparison.scene.bodies)), rounded_text(duration, 4),
                  rounded_text(1e3 * comparison.exact.dt, 4), grouped_text(std::ssize(exact.meetings))),
      columns_of<Contest>(compare_columns(), run_time_column(duration)), contests);
  out.summary = terminal(
      shown, {"policy", "dt", "tunneled", "met", "unmet", "extra", "error_median", "error_largest", "seconds"});
  bool held = true;
  for (const Contest& c : contests) {
    held &= c.repeated_alike;
    if (looks_at_all_motion(c.contender.policy, comparison.scene.options.gate)) held &= c.trial.tunneled == 0;
  }
  out.summary += fmt::format("\nSelf-test: {}.\n", verdict_text(held && exact.tunneled == 0));
  out.tables = {compare_table(contests), compare_timings_table(comparison, contests)};
  out.figures = {compare_figure(comparison, contests), error_against_time_figure(comparison, contests)};
  out.self_test_passed = held && exact.tunneled == 0;
  return out;
}

}  // namespace thinwall
