#include <cmath>

#include <thinwall/experiments/hitscan/figure_parts.hpp>

namespace thinwall {

namespace {

double time_of(const HitscanLine& l) { return flight_time(l.cell); }
double steps_late(const HitscanLine& l) { return *mean_lateness(l) / l.cell.step; }
bool is_timed(const HitscanLine& l) { return l.tally.lateness.count > 0; }

double speed_at_target(const HitscanLine& l) {
  const auto there = at_distance(arc_of<double>(l.cell), l.cell.range);
  return std::hypot(there.vx, there.vs);
}

Panel next_frame_panel(const HitscanLines& lines) {
  Panel panel = {.x_label = "speed at the target [m/s]",
                 .y_label = "mean lateness of next_frame [steps]",
                 .log_x = true,
                 .series = {}};
  add_points(panel, lines, speed_at_target, steps_late, [](const HitscanLine& l) {
    const double half = 1.96 * l.expected.lateness->sigma / std::sqrt(static_cast<double>(l.tally.lateness.count));
    return Interval{steps_late(l) - half / l.cell.step, steps_late(l) + half / l.cell.step};
  });
  panel.series.push_back(theory_through(lines, speed_at_target,
                                        [](const HitscanLine& l) { return l.expected.lateness->mean / l.cell.step; }));
  return panel;
}

Panel hitscan_panel(const HitscanLines& lines) {
  Panel panel = {.x_label = "flight time [s]",
                 .y_label = "hitscan is early by [steps]",
                 .log_x = true,
                 .log_y = true,
                 .series = {}};
  add_points(panel, lines, time_of, [](const HitscanLine& l) { return -steps_late(l); }, {});
  const double radius = *radii_of(lines).begin();
  panel.series.push_back(theory_through(chosen(lines, [&](const HitscanLine& l) { return l.cell.radius == radius; }),
                                        time_of, [](const HitscanLine& l) { return time_of(l) / l.cell.step; }));
  return panel;
}

}  // namespace

Figure path_error_figure(const HitscanLines& lines) {
  Panel panel = {.x_label = "flight time [s]",
                 .y_label = "mean distance from the arc [m]",
                 .log_x = true,
                 .log_y = true,
                 .series = {}};
  const std::vector<HitscanRule> rules = {hitscan_ray, next_frame, swept_steps};
  for (const HitscanRule& rule : rules) {
    Series series = empty_series(std::string(rule.name), Mark::points);
    for (const HitscanLine& l : of_rule(lines, rule)) add_point(series, time_of(l), mean_path_error(l));
    if (!series.x.empty()) panel.series.push_back(series);
  }
  for (const HitscanRule& rule : rules) {
    const HitscanLines drawn = of_rule(lines, rule);
    if (drawn.empty()) continue;
    panel.series.push_back(
        theory_through(drawn, time_of, [](const HitscanLine& l) { return l.expected.path_error.mean; }));
  }
  return {.name = "path_error",
          .title = "How far each rule's path is from the arc at the range",
          .caption =
              "Mean distance from the arc where the path crosses the plane of the target, against the flight "
              "time, and the theory. The ray is off by the whole fall; the rules that go step by step by that of "
              "a step, or less in a first step that reaches the target.",
          .panels = {panel}};
}

Figure lateness_figure(const HitscanLines& lines) {
  Figure figure = {.name = "lateness",
                   .title = "When a hit is reported",
                   .caption =
                       "Above, the mean time from first contact to the report of next_frame, with 95 % "
                       "intervals, and the theory: half a step, and the time from where the ball touches to "
                       "where its center does; flights of a step or more. Below, how much too early hitscan "
                       "reports: the whole flight, until it hits nothing the bullet hits.",
                   .panels = {}};
  const HitscanLines framed = chosen(of_rule(lines, next_frame), [](const HitscanLine& l) {
    return is_timed(l) && flight_time(l.cell) >= l.cell.step;
  });
  if (!framed.empty()) figure.panels.push_back(next_frame_panel(framed));
  const HitscanLines instant = chosen(of_rule(lines, hitscan_ray), is_timed);
  if (!instant.empty()) figure.panels.push_back(hitscan_panel(instant));
  return figure;
}

}  // namespace thinwall
