#include <thinwall/experiments/bouncing/figures.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace thinwall {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double least_error = 0x1p-60;  // drawn in place of an error that is less, down to 0

Series empty_series(std::string label, Mark mark) {
  return {.label = std::move(label), .mark = mark, .x = {}, .y = {}, .lower = {}, .upper = {}};
}

void add_point(Series& series, double x, double y, const Interval& bars) {
  series.x.push_back(x);
  series.y.push_back(y);
  series.lower.push_back(bars.lower);
  series.upper.push_back(bars.upper);
}

/// The series of a policy, made where it is not there yet.
Series& series_of(Panel& panel, const std::string& label) {
  const auto found =
      std::find_if(panel.series.begin(), panel.series.end(), [&](const Series& s) { return s.label == label; });
  return found != panel.series.end() ? *found : panel.series.emplace_back(empty_series(label, Mark::points));
}

/// A curve of its own for each policy, as one series with gaps.
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

Figure energy_figure(const BouncingResults& results) {
  const std::vector<BounceLine> lines = liveliest(results.lines);
  Panel means, residuals;
  means.x_label = residuals.x_label = "step [s]";
  means.log_x = residuals.log_x = true;
  means.y_label = "energy a bounce [g h / V]";
  residuals.y_label = "from theory [standard errors]";
  residuals.height = 0.6;
  Series theory = empty_series("theory", Mark::line), limits = empty_series("95 % of chance", Mark::dashes);
  const double coarsest = lines.front().cell.step, finest = lines.back().cell.step;
  for (const BounceLine& l : lines) {
    add_point(series_of(means, l.policy), l.cell.step, l.tally.mean, mean_interval(l));
    if (const auto residual = mean_residual(l)) {
      Series& series = series_of(residuals, l.policy);
      series.x.push_back(l.cell.step);
      series.y.push_back(*residual);
    }
    if (l.cell.step != coarsest) continue;
    add_curve(theory, finest, coarsest, [&](double step) {
      return bounce_theory(l.policy, delta(l.cell) * step / coarsest, l.cell.restitution).mean();
    });
  }
  for (const double at : {-1.96, 1.96}) add_curve(limits, finest, coarsest, [at](double) { return at; });
  means.series.push_back(theory);
  residuals.series.push_back(limits);
  return {
      .name = "energy_per_bounce",
      .title = "What a bounce at random phase does to the energy",
      .caption = fmt::format(
          "Mean change of the flight's energy a bounce at restitution {:g}, in units of g h / V of it, with 95 % intervals "
          "(mostly hidden by their points), and the theory. Below, how far the means are from it; the policies share their phases, so these deviations are almost the same or opposite.",
          lines.front().cell.restitution),
      .panels = {means, residuals}};
}

Figure work_figure(const std::vector<BounceWork>& work) {
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
    Panel panel;
    panel.x_label = "run time [ns a bounce]";
    panel.y_label = mean ? "|mean| of the energy error [1]" : "rms energy error a bounce [1]";
    panel.log_x = panel.log_y = true;
    for (const BounceWork& w : work) {
      Series& points = series_of(panel, w.policy);
      const double error = std::max(least_error, mean ? std::abs(w.mean_error()) : w.rms_error());
      add_point(points, w.nanoseconds, error, {error, error});
      points.x_lower.push_back(w.interval.lower);
      points.x_upper.push_back(w.interval.upper);
    }
    const std::size_t count = panel.series.size();
    for (std::size_t i = 0; i < count; ++i) {
      Series line = empty_series(panel.series[i].label, Mark::line);
      line.x = panel.series[i].x;
      line.y = panel.series[i].y;
      panel.series.push_back(std::move(line));
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

Figure long_figure(const std::vector<LongRun>& runs) {
  Panel means, sigmas;
  means.x_label = sigmas.x_label = "bounces";
  means.log_x = sigmas.log_x = sigmas.log_y = true;
  means.y_label = "mean energy / first [1]";
  sigmas.y_label = "standard deviation [1]";
  Series theory = empty_series("random phases", Mark::line);
  Series spread = theory;
  for (const LongRun& run : runs) {
    if (run.points.empty()) continue;
    Series &mean = series_of(means, run.policy), &sigma = series_of(sigmas, run.policy);
    for (const LongRunPoint& p : run.points) {
      const auto n = static_cast<double>(p.bounces);
      mean.x.push_back(n);
      mean.y.push_back(p.mean);
      sigma.x.push_back(n);
      sigma.y.push_back(p.sigma > 1e-9 ? p.sigma : nan);
    }
    const auto last = static_cast<double>(run.points.back().bounces);
    add_curve(theory, 1, last, [&](double n) { return random_phase_mean(run, n); });
    if (run.sigma > 0) add_curve(spread, 1, last, [&](double n) { return random_phase_sigma(run, n); });
  }
  means.series.push_back(theory);
  sigmas.series.push_back(spread);
  return {
      .name = "long_runs",
      .title = "One ball that bounces on and on",
      .caption = fmt::format(
          "Energy over that of the first flight, without loss, at a step of {:.3g} s: mean and standard deviation over balls "
          "that start at random in the first step, and what they would be if every phase were random. Deviations below "
          "1e-9 are not drawn.",
          runs.front().cell.step),
      .panels = {means, sigmas}};
}

Figure heights_figure(BounceCell cell, const std::vector<BouncePolicy>& policies) {
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
  Series truth = empty_series("true flight", Mark::dashes);
  for (int i = 0; i <= 600; ++i) {
    const double t = end * i / 600, from_apex = std::fmod(t + fall, 2 * fall) - fall;
    truth.x.push_back(t);
    truth.y.push_back(cell.height - cell.gravity * from_apex * from_apex / 2);
  }
  for (const BouncePolicy& policy : policies) {
    Panel panel;
    panel.x_label = "time [s]";
    panel.y_label = "height [m]";
    panel.height = 0.45;
    Series line = empty_series(policy.name, Mark::line), points = empty_series(policy.name, Mark::points);
    const auto steps = static_cast<std::int64_t>(end / cell.step - elapsed);
    for (const double gap : policy.heights(cell, elapsed, steps)) {
      line.x.push_back((elapsed + static_cast<double>(line.x.size())) * cell.step);
      line.y.push_back(gap);
    }
    points.x = line.x;
    points.y = line.y;
    panel.series = {truth, line, points};
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace

std::vector<Figure> bouncing_figures(const BouncingResults& results, const std::vector<BouncePolicy>& policies) {
  return {energy_figure(results), work_figure(results.work), long_figure(results.long_runs),
          heights_figure(results.lines.front().cell, policies)};
}

}  // namespace thinwall
