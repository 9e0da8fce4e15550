#include <algorithm>
#include <cmath>
#include <limits>

#include <thinwall/experiments/scenes/compare_results.hpp>
#include <thinwall/experiments/statistics.hpp>

namespace thinwall {

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
