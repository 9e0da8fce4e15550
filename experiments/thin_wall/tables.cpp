#include <thinwall/experiments/thin_wall/tables.hpp>

#include <array>
#include <functional>
#include <string>

#include <thinwall/experiments/tables/without_columns.hpp>
#include <thinwall/experiments/thin_wall/bounce_results.hpp>

namespace thinwall {

namespace {

using Read = std::function<Value(const Line&)>;
struct Field {
  Column column;
  Read read;
};

Value maybe(const std::optional<double>& x) { return x ? Value(*x) : Value(); }

/// Missing where nothing was detected.
Read of_detected(double Tally::*extreme) {
  return [extreme](const Line& l) { return l.tally.detected() > 0 ? Value(l.tally.*extreme) : Value(); };
}

std::vector<Field> factors() {
  using enum ColumnType;
  return {
      {{"method", text, "", "Way of detecting the hit; substeps_N tests N poses a step."},
       [](const Line& l) { return l.detector->method; }},
      {{"scalar", text, "", "Floating-point type the query is asked in."},
       [](const Line& l) { return l.detector->scalar; }},
      {{"speed", number, "m/s", "Speed of the ball."}, [](const Line& l) { return l.cell->speed; }},
      {{"step", number, "s", "Time between two poses."}, [](const Line& l) { return l.cell->step; }},
      {{"radius", number, "m", "Radius of the ball."}, [](const Line& l) { return l.cell->radius; }},
      {{"thickness", number, "m", "Thickness of the wall."}, [](const Line& l) { return l.cell->thickness; }},
      {{"angle_deg", number, "deg", "Angle of incidence, between the motion and the wall's normal."},
       [](const Line& l) { return l.cell->angle_deg; }},
      {{"wall", text, "", "Infinite, or a finite square."},
       [](const Line& l) { return std::string(name(l.cell->wall)); }},
      {{"wall_size", number, "m", "Side of the square; missing for an infinite wall."},
       [](const Line& l) { return l.cell->wall == Wall::finite ? Value(l.cell->wall_size) : Value(); }},
  };
}

std::vector<Field> counts() {
  using enum ColumnType;
  return {
      {{"step_ratio", number, "1", "speed * step * cos(angle_deg) / (thickness + 2 * radius)."},
       [](const Line& l) { return l.step_ratio; }},
      {{"shots", integer, "1", "Shots fired, at independent uniform phases."},
       [](const Line& l) { return l.tally.shots; }},
      {{"tunneled", integer, "1", "Shots that passed the wall undetected."},
       [](const Line& l) { return l.tally.tunneled; }},
      {{"undecided", integer, "1", "Shots that ended because the method gave up."},
       [](const Line& l) { return l.tally.undecided; }},
      {{"probability", number, "1", "tunneled / shots.", "lower", "upper"},
       [](const Line& l) { return probability(l); }},
      {{"lower", number, "1", "Lower end of the 95 % Wilson interval."},
       [](const Line& l) { return interval(l).lower; }},
      {{"upper", number, "1", "Upper end of the 95 % Wilson interval."},
       [](const Line& l) { return interval(l).upper; }},
      {{"theory", number, "1", "Probability by theory; missing where no formula holds."},
       [](const Line& l) { return maybe(l.theory.probability); }},
      {{"residual", number, "1", "Standard errors between count and theory; missing where theory is 0, 1 or missing."},
       [](const Line& l) { return maybe(residual(l)); }},
  };
}

std::vector<Field> lateness_and_cost() {
  using enum ColumnType;
  return {
      {{"lateness_mean", number, "m", "Mean path length from first contact to detection, of the detected."},
       [](const Line& l) { return maybe(lateness_mean(l)); }},
      {{"lateness_mean_theory", number, "m", "The same by theory; missing where no formula holds."},
       [](const Line& l) { return l.theory.lateness ? Value(l.theory.lateness->mean) : Value(); }},
      {{"lateness_max", number, "m", "Largest path length from first contact to detection."},
       of_detected(&Tally::latest)},
      {{"lateness_max_theory", number, "m", "The largest there can be; missing where no formula holds."},
       [](const Line& l) { return maybe(l.theory.largest_lateness()); }},
      {{"lateness_min", number, "m", "Least one; where the ball grazes, rounding makes it uncertain."},
       of_detected(&Tally::earliest)},
      {{"gap_max", number, "m", "Widest gap between ball and wall at detection; above 0 by rounding, or a false hit."},
       of_detected(&Tally::widest)},
      {{"queries", integer, "1", "Steps that the method was asked about, over all shots."},
       [](const Line& l) { return l.tally.queries; }},
      {{"evaluations", integer, "1", "Overlap tests, rays and closed forms those took: the machine-independent cost."},
       [](const Line& l) { return l.tally.evaluations; }},
  };
}

std::vector<Field> bounces() {
  using enum ColumnType;
  const auto through = [](const Line& l) { return wilson(went_through(l.tally), l.tally.shots); };
  return {
      {{"wrong_side", integer, "1", "Shots seen where the least penetration pushes them ahead or sideways, not back."},
       [](const Line& l) { return l.tally.wrong_side; }},
      {{"behind", integer, "1", "Shots that flew away behind the wall in the end, the tunneled included."},
       [](const Line& l) { return l.tally.behind; }},
      {{"through", number, "1", "(tunneled + wrong_side) / shots.", "through_lower", "through_upper"},
       [](const Line& l) { return static_cast<double>(went_through(l.tally)) / static_cast<double>(l.tally.shots); }},
      {{"through_lower", number, "1", "Lower end of the 95 % Wilson interval."},
       [through](const Line& l) { return through(l).lower; }},
      {{"through_upper", number, "1", "Upper end of the 95 % Wilson interval."},
       [through](const Line& l) { return through(l).upper; }},
      {{"through_theory", number, "1", "The same by theory; missing where no formula holds."},
       [](const Line& l) { return maybe(l.theory.through); }},
  };
}

Table make_table(const std::vector<std::vector<Field>>& groups, const std::vector<Line>& lines) {
  Table table;
  for (const auto& group : groups) {
    for (const Field& field : group) table.columns.push_back(field.column);
  }
  table.rows.reserve(lines.size());
  for (const Line& line : lines) {
    std::vector<Value>& row = table.rows.emplace_back();
    row.reserve(table.columns.size());
    for (const auto& group : groups) {
      for (const Field& field : group) row.push_back(field.read(line));
    }
  }
  return table;
}

}  // namespace

Table cells_table(const std::vector<Line>& lines, Response response) {
  std::vector<std::vector<Field>> groups = {factors(), counts(), lateness_and_cost()};
  if (response == Response::bounce) groups.push_back(bounces());
  Table table = make_table(groups, lines);
  table.name = "cells";
  table.description = "Every cell at every method and scalar: how often the ball tunnels, how late it is detected.";
  return table;
}

Table bullet_table(const std::vector<Line>& lines) {
  std::vector<Line> selected;
  for (const Line& line : lines) {
    if (*line.cell == bullet) selected.push_back(line);
  }
  Table table = make_table({factors(), counts(), lateness_and_cost()}, selected);
  table.name = "bullet";
  table.description = "The bullet at 10 m/s that is before the wall at one frame and behind it at the next.";
  table.in_report = true;
  constexpr std::array<std::string_view, 3> left_out = {"lateness_min", "gap_max", "queries"};  // cells.csv has them
  return without_columns(table, left_out);
}

Table timings_table(const std::vector<Line>& lines) {
  std::vector<Field> time = {
      {{"shots", ColumnType::integer, "1", "Shots fired."}, [](const Line& l) { return l.tally.shots; }},
      {{"nanoseconds_per_shot", ColumnType::number, "ns", "Wall-clock time over shots, drawing the shot included."},
       [](const Line& l) { return 1e9 * l.seconds / static_cast<double>(l.tally.shots); }}};
  Table table = make_table({factors(), time}, lines);
  table.name = "timings";
  table.description = "Time a shot, on this machine, with every core at work.";
  table.is_timing = true;
  return table;
}

}  // namespace thinwall
