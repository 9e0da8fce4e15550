#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include <thinwall/experiments/engines/report.hpp>
#include <thinwall/experiments/engines/theory.hpp>

namespace thinwall {

namespace {

enum class Looks { at_poses, along_the_motion };

bool does(const EngineLine& line, Looks looks) {
  return (line.setup->mode.poses_per_step > 0) == (looks == Looks::at_poses);
}

using EngineRead = std::function<std::optional<double>(const EngineLine&)>;
using EngineBars = std::function<Interval(const EngineLine&)>;

/// A line and its points for each engine and mode, against the path.
void add_engines(Panel& panel, const std::vector<EngineLine>& lines, double wall_size, Looks looks,
                 const EngineRead& read, const EngineBars& bars) {
  for (const std::string& label : labels_of(lines)) {
    Series points{.label = label, .mark = Mark::points, .x = {}, .y = {}, .lower = {}, .upper = {}};
    for (const EngineLine& line : lines_of(lines, label, wall_size)) {
      const std::optional<double> y = read(line);
      if (!does(line, looks) || !y) continue;
      points.x.push_back(line.cell->path);
      points.y.push_back(*y);
      if (!bars) continue;
      points.lower.push_back(bars(line).lower);
      points.upper.push_back(bars(line).upper);
    }
    if (points.x.empty()) continue;
    panel.series.push_back(
        {.label = label, .mark = Mark::line, .x = points.x, .y = points.y, .lower = {}, .upper = {}});
    panel.series.push_back(std::move(points));
  }
}

/// What theory expects of looking at the end of each step, as percent against the path.
Series engine_theory(const EngineCell& like, double least, double most, const char* label, Mark mark,
                     double (*chance)(const EngineCell&, int, double)) {
  Series series{.label = label, .mark = mark, .x = {}, .y = {}, .lower = {}, .upper = {}};
  constexpr int samples = 200;
  EngineCell cell = like;
  for (int i = 0; i <= samples; ++i) {
    cell.path = least * std::pow(most / least, static_cast<double>(i) / samples);
    series.x.push_back(cell.path);
    series.y.push_back(100 * chance(cell, 1, 0));
  }
  return series;
}

Panel path_panel(std::string y_label) {
  Panel panel;
  panel.x_label = "path of the ball in a step [m]";
  panel.y_label = std::move(y_label);
  panel.log_x = true;
  return panel;
}

Figure tunneling_figure(const std::vector<EngineLine>& lines) {
  const auto percent = [](const EngineLine& l) { return std::optional(100 * tunneled_share(l)); };
  const auto bars = [](const EngineLine& l) {
    return Interval{100 * tunneled_interval(l).lower, 100 * tunneled_interval(l).upper};
  };
  const EngineCell& cell = *lines.front().cell;
  double most = cell.path;
  for (const EngineLine& line : lines) most = std::max(most, line.cell->path);
  Figure figure;
  figure.name = "tunneling";
  figure.title = "How often a ball goes through a thin wall in whole engines";
  figure.caption = fmt::format(
      "A ball of radius {} m, a wall {} m thick, angles of incidence uniform up to {} deg; the same shots for all. Bars are 95 % "
      "Wilson intervals, most of them smaller than the points. Above: engines that look at poses. Theory: a ball whose pose is first in "
      "contact when its center is past the wall's middle is pushed out ahead; the dashes are those never in contact. Below: engines "
      "that sweep, at walls of different widths.",
      cell.radius, cell.thickness, cell.angle_deg);
  Panel poses = path_panel("through, looking at poses [%]");
  add_engines(poses, lines, cell.wall_size, Looks::at_poses, percent, bars);
  if (!poses.series.empty()) {
    if (cell.path < most) {
      poses.series.push_back(
          engine_theory(cell, cell.path, most, "theory, not seen in time", Mark::line, through_theory));
      poses.series.push_back(engine_theory(cell, cell.path, most, "theory, never seen", Mark::dashes, unseen_theory));
    }
    figure.panels.push_back(std::move(poses));
  }
  for (const double wall_size : wall_sizes(lines)) {
    Panel motion = path_panel(fmt::format("through, sweeping, wall {} m wide [%]", wall_size));
    add_engines(motion, lines, wall_size, Looks::along_the_motion, percent, bars);
    if (!motion.series.empty()) figure.panels.push_back(std::move(motion));
  }
  return figure;
}

Figure bounce_figure_of(const std::vector<EngineLine>& lines, const char* y_label, const EngineRead& read) {
  Figure figure;
  for (const Looks looks : {Looks::at_poses, Looks::along_the_motion}) {
    Panel panel = path_panel(fmt::format(fmt::runtime(y_label), looks == Looks::at_poses ? "poses" : "sweeping"));
    add_engines(panel, lines, lines.front().cell->wall_size, looks, read, {});
    if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

Figure late_figure(const std::vector<EngineLine>& lines) {
  Figure figure = bounce_figure_of(lines, "lateness, {} [steps]", mean_late);
  figure.name = "lateness";
  figure.title = "How late the ball turns";
  figure.caption = fmt::format(
      "Of the balls that turned: from first contact to where the lines of flight before and after the bounce meet, mean, in steps. "
      "An exact bounce is at 0; a ball that is stopped and waits for the next step is late by half of what it waits. The wall is {} m wide.",
      lines.front().cell->wall_size);
  return figure;
}

Figure energy_figure(const std::vector<EngineLine>& lines) {
  Figure figure = bounce_figure_of(lines, "energy ratio, {} [1]", mean_energy);
  figure.name = "energy";
  figure.title = "What is left of the energy after a bounce of restitution 1";
  figure.caption = fmt::format(
      "Of the balls that turned: kinetic energy after over before, mean. It should be 1. The wall is {} m wide.",
      lines.front().cell->wall_size);
  return figure;
}

Figure time_figure(const std::vector<EngineLine>& lines) {
  Figure figure;
  figure.name = "times";
  figure.title = "Error against run time";
  figure.caption = fmt::format(
      "Time a step of a world of one wall and one ball against the share of balls that go through at {} m a step. Medians over "
      "volleys with 95 % bootstrap intervals, and Wilson intervals of the share.",
      told_path(lines));
  figure.is_timing = true;
  for (const double wall_size : wall_sizes(lines)) {
    Panel panel;
    panel.x_label = fmt::format("through at {} m a step, wall {} m wide [%]", told_path(lines), wall_size);
    panel.y_label = "time a step [ns]";
    panel.log_y = true;
    for (const EngineLine& line : lines_at(lines, told_path(lines), wall_size)) {
      const Interval time = bootstrap_median(line.nanoseconds, {1, line.nanoseconds.size()});
      const Interval share = tunneled_interval(line);
      panel.series.push_back({.label = line.setup->label(),
                              .mark = Mark::points,
                              .x = {100 * tunneled_share(line)},
                              .y = {median(line.nanoseconds)},
                              .lower = {time.lower},
                              .upper = {time.upper},
                              .x_lower = {100 * share.lower},
                              .x_upper = {100 * share.upper}});
    }
    if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace

std::vector<Figure> engine_figures(const std::vector<EngineLine>& lines) {
  std::vector<Figure> figures = {tunneling_figure(lines), late_figure(lines), energy_figure(lines), time_figure(lines)};
  std::erase_if(figures, [](const Figure& f) { return f.panels.empty(); });
  return figures;
}

}  // namespace thinwall
