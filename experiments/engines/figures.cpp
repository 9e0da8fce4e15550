#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <utility>

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

bool is_zero(const Series& series) {
  return std::all_of(series.y.begin(), series.y.end(), [](double y) { return y == 0; });
}

/// Those that never let a ball through would hide each other on the zero line: they take turns on it.
void take_turns(std::vector<Series>& all) {
  const auto sharing = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_zero));
  std::size_t turn = 0;
  for (Series& series : all) {
    if (!is_zero(series)) continue;
    for (std::vector<double>* column : {&series.x, &series.y, &series.lower, &series.upper}) {
      std::vector<double> kept;
      for (std::size_t i = turn; i < column->size(); i += sharing) kept.push_back((*column)[i]);
      if (!kept.empty() || column->empty()) *column = kept;
    }
    ++turn;
  }
}

/// A line and its points for each engine and mode, against the path.
void add_engines(Panel& panel, const std::vector<EngineLine>& lines, double wall_size, Looks looks,
                 const EngineRead& read, const EngineBars& bars) {
  std::vector<Series> all;
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
    if (!points.x.empty()) all.push_back(std::move(points));
  }
  if (bars) take_turns(all);
  for (Series& points : all) {
    if (!bars || !is_zero(points)) {
      panel.series.push_back(
          {.label = points.label, .mark = Mark::line, .x = points.x, .y = points.y, .lower = {}, .upper = {}});
    }
    panel.series.push_back(std::move(points));
  }
}

using EngineChance = double (*)(const EngineCell&, int, double);

/// What theory expects of looking at so many poses a step with such a skin, as percent against the path.
void add_curve(Series& series, const EngineCell& like, double most, int poses, double skin, EngineChance chance) {
  constexpr int samples = 200;
  EngineCell cell = like;
  for (int i = 0; i <= samples; ++i) {
    cell.path = like.path * std::pow(most / like.path, static_cast<double>(i) / samples);
    series.x.push_back(cell.path);
    series.y.push_back(100 * chance(cell, poses, skin));
  }
  series.x.push_back(cell.path);
  series.y.push_back(std::numeric_limits<double>::quiet_NaN());
}

/// A curve for each number of poses and skin that took part, and the dashes of the ball that is never seen at the step's end.
void add_theory(Panel& panel, const std::vector<EngineLine>& lines) {
  const EngineCell& cell = *lines.front().cell;
  double most = cell.path;
  std::set<std::pair<int, double>> looked;
  for (const EngineLine& line : lines) {
    most = std::max(most, line.cell->path);
    if (line.theory) looked.emplace(line.setup->mode.poses_per_step, line.setup->mode.skin);
  }
  if (most == cell.path) return;
  Series late{.label = "theory, not seen in time", .mark = Mark::line, .x = {}, .y = {}, .lower = {}, .upper = {}};
  Series never{.label = "theory, never seen", .mark = Mark::dashes, .x = {}, .y = {}, .lower = {}, .upper = {}};
  for (const auto& [poses, skin] : looked) add_curve(late, cell, most, poses, skin, through_theory);
  add_curve(never, cell, most, 1, 0, unseen_theory);
  panel.series.push_back(std::move(late));
  panel.series.push_back(std::move(never));
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
  Figure figure;
  figure.name = "tunneling";
  figure.title = "How often a ball goes through a thin wall in whole engines";
  figure.caption = fmt::format(
      "A ball of radius {} m, a wall {} m thick, angles of incidence uniform up to {} deg, the same shots for all. Bars are 95 % "
      "Wilson intervals, many smaller than the points. Above: who looks at poses. A ball that is first seen when its center is past "
      "the wall's middle is pushed out ahead: that is the theory, a curve for each number of poses a step and for Box2D's skin; the "
      "dashes are balls never seen at the end of a step. Below: who sweeps, at walls of different widths; ccd_F sweeps a ball of F "
      "times the radius. Those that let none through take turns on the zero line.",
      cell.radius, cell.thickness, cell.angle_deg);
  Panel poses = path_panel("through, looking at poses [%]");
  add_engines(poses, lines, cell.wall_size, Looks::at_poses, percent, bars);
  if (!poses.series.empty()) {
    add_theory(poses, lines);
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
    std::vector<EngineLine> some = lines_at(lines, told_path(lines), wall_size);
    std::stable_partition(some.begin(), some.end(), [](const EngineLine& l) { return does(l, Looks::at_poses); });
    for (const EngineLine& line : some) {  // in the other pictures' order, and so with their marks
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
