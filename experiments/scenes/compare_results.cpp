#include <thinwall/experiments/scenes/comparison.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include <thinwall/experiments/lab/columns.hpp>
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

bool looks_at_all_motion(TimePolicy policy) {
  return policy == TimePolicy::clamp || policy == TimePolicy::event_driven;
}

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

}  // namespace

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
    if (looks_at_all_motion(c.contender.policy) && comparison.scene.options.gate == 0) held &= c.trial.tunneled == 0;
  }
  out.summary += fmt::format("\nSelf-test: {}.\n", held && exact.tunneled == 0 ? "passed" : "FAILED");
  out.tables = {compare_table(contests), compare_timings_table(comparison, contests)};
  out.figures = {compare_figure(comparison, contests), error_against_time_figure(comparison, contests)};
  out.self_test_passed = held && exact.tunneled == 0;
  return out;
}

namespace {

/// [s] An error this small is a rounding of the clock: it is drawn here, since a logarithm has no zero.
double least_drawn(const Comparison& comparison) {
  return comparison.scene.duration() * std::numeric_limits<double>::epsilon();
}

double drawn_error(const Comparison& comparison, const Contest& c) {
  if (c.errors.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::max(median(c.errors), least_drawn(comparison));
}

/// One series a policy, in the order of the contests.
template <class X, class Y>
std::vector<Series> by_policy(const std::vector<Contest>& contests, const X& x, const Y& y) {
  std::vector<Series> all;
  for (const Contest& c : contests) {
    if (all.empty() || all.back().label != c.contender.label()) {
      all.push_back({.label = c.contender.label(), .mark = Mark::points, .x = {}, .y = {}, .lower = {}, .upper = {}});
    }
    all.back().x.push_back(x(c));
    all.back().y.push_back(y(c));
  }
  return all;
}

}  // namespace

Figure compare_figure(const Comparison& comparison, const std::vector<Contest>& contests) {
  const auto step = [](const Contest& c) { return 1e3 * c.contender.dt; };
  Panel top, bottom;
  top.x_label = bottom.x_label = "step [ms]";
  top.log_x = bottom.log_x = bottom.log_y = true;
  top.y_label = "tunneled pairs [1]";
  bottom.y_label = "error of first meetings [s]";
  top.series = by_policy(contests, step, [](const Contest& c) { return static_cast<double>(c.trial.tunneled); });
  bottom.series = by_policy(contests, step, [&](const Contest& c) { return drawn_error(comparison, c); });
  return {.name = "compare",
          .title = "Discrete or swept, on this scene",
          .caption =
              "Above: pairs that went through each other unseen. Below: the median over pairs of how far their first "
              "meeting is from the exact run's; errors below a rounding of the duration are drawn at that.",
          .panels = {std::move(top), std::move(bottom)}};
}

Figure error_against_time_figure(const Comparison& comparison, const std::vector<Contest>& contests) {
  const double duration = comparison.scene.duration();
  Panel panel;
  panel.x_label = "median error of first meetings [s]";
  panel.y_label = "run time a second of the scene [s]";
  panel.log_x = panel.log_y = true;
  panel.series = by_policy(
      contests, [&](const Contest& c) { return drawn_error(comparison, c); },
      [&](const Contest& c) { return median(c.seconds) / duration; });
  for (std::size_t i = 0, k = 0; k < panel.series.size(); ++k) {
    Series& series = panel.series[k];
    for (std::size_t j = 0; j < series.x.size(); ++j, ++i) {
      const auto [least, most] = std::minmax_element(contests[i].seconds.begin(), contests[i].seconds.end());
      series.lower.push_back(*least / duration);
      series.upper.push_back(*most / duration);
    }
  }
  return {.name = "error_against_time",
          .title = "What an error of the first meetings costs",
          .caption =
              "Median run time of the repeats against the median error, a point for each step; bars from the "
              "shortest to the longest repeat. A policy that misses a pair altogether has no error for it: see the "
              "table.",
          .panels = {std::move(panel)},
          .is_timing = true};
}

}  // namespace thinwall
