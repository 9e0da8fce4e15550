#include <thinwall/experiments/swept_bounds/tables.hpp>

#include <algorithm>
#include <functional>

namespace thinwall {

namespace {

/// A column, and what a line writes into it.
struct Field {
  Column column;
  std::function<Value(const SweepLine&)> read;
};

Value false_share(const SweepLine& l) {
  const std::optional<double> share = false_fraction(l.tally);
  return share ? Value(*share) : Value();
}

/// Of the false fraction, if anything is reported.
Value false_bar(const SweepLine& l, double Interval::*end) {
  if (l.tally.reported == 0) return {};
  return wilson(l.tally.false_hits, l.tally.reported).*end;
}

std::vector<Field> factors() {
  using enum ColumnType;
  return {
      {{"shape", text, "", "What moves."}, [](const SweepLine& l) { return std::string(name(l.sweep.form)); }},
      {{"bound", text, "", "What stands for the volume it sweeps."}, [](const SweepLine& l) { return l.bound; }},
      {{"speed", number, "m/s", "Of the shape."}, [](const SweepLine& l) { return l.sweep.speed; }},
      {{"step", number, "s", "Time step."}, [](const SweepLine& l) { return l.sweep.step; }},
      {{"width", number, "m", "Diameter of the sphere, longest edge of a box."},
       [](const SweepLine& l) { return l.sweep.width; }},
      {{"path", number, "widths", "How far the shape moves in a step."},
       [](const SweepLine& l) { return path_in_widths(l.sweep); }},
      {{"angle_deg", number, "deg", "Between the motion and x, the axis of plate and rod."},
       [](const SweepLine& l) { return l.sweep.angle_deg; }},
      {{"turn_deg", number, "deg", "Where to the motion leans: 0 towards y, 90 towards z."},
       [](const SweepLine& l) { return l.sweep.turn_deg; }},
      {{"obstacle", number, "widths", "Diameter of the balls at rest."},
       [](const SweepLine& l) { return l.sweep.obstacle; }},
  };
}

std::vector<Field> verdicts() {
  using enum ColumnType;
  return {
      {{"shots", integer, "1", "Balls around the bound."}, [](const SweepLine& l) { return l.tally.shots; }},
      {{"touching", integer, "1", "Of those, truly touched during the step."},
       [](const SweepLine& l) { return l.tally.touching; }},
      {{"touching_theory", number, "1", "Expected number of them."},
       [](const SweepLine& l) { return l.theory.touching * static_cast<double>(l.tally.shots); }},
      {{"reported", integer, "1", "Of the balls, reported by the bound."},
       [](const SweepLine& l) { return l.tally.reported; }},
      {{"reported_theory", number, "1", "Expected number of them."},
       [](const SweepLine& l) { return l.theory.reported() * static_cast<double>(l.tally.shots); }},
      {{"false_hits", integer, "1", "Reported, but not touched."},
       [](const SweepLine& l) { return l.tally.false_hits; }},
      {{"false_fraction", number, "1", "false_hits / reported; missing if none is reported.", "false_lower",
        "false_upper"},
       false_share},
      {{"false_lower", number, "1", "Lower end of its 95 % Wilson interval."},
       [](const SweepLine& l) { return false_bar(l, &Interval::lower); }},
      {{"false_upper", number, "1", "Upper end of it."},
       [](const SweepLine& l) { return false_bar(l, &Interval::upper); }},
      {{"false_theory", number, "1", "The same by Steiner's formula."},
       [](const SweepLine& l) { return l.theory.false_fraction; }},
      {{"wasted_tests", number, "1", "False hits for each true one, by theory: exact tests that find nothing."},
       [](const SweepLine& l) { return l.theory.false_hits / l.theory.touching; }},
      {{"empty", number, "1", "Share of the bound's own volume that is not swept."},
       [](const SweepLine& l) { return l.theory.empty; }},
      {{"grazing", integer, "1", "More balls, which just touch."}, [](const SweepLine& l) { return l.tally.grazing; }},
      {{"missed", integer, "1", "Touched, of either kind, and not reported."},
       [](const SweepLine& l) { return l.tally.missed; }},
  };
}

Table make_table(const std::vector<SweepLine>& lines) {
  Table table;
  table.rows.resize(lines.size());
  for (const auto& group : {factors(), verdicts()}) {
    for (const Field& field : group) {
      table.columns.push_back(field.column);
      for (std::size_t i = 0; i < lines.size(); ++i) table.rows[i].push_back(field.read(lines[i]));
    }
  }
  return table;
}

}  // namespace

Table sweeps_table(const std::vector<SweepLine>& lines) {
  Table table = make_table(lines);
  table.name = "cells";
  table.description = "Every cell at every bound: balls reported, touched, falsely reported and missed.";
  return table;
}

Table diagonal_table(const std::vector<SweepLine>& lines) {
  std::vector<SweepLine> selected;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(selected),
               [](const SweepLine& l) { return is_diagonal(l.sweep); });
  Table table = make_table(selected);
  table.name = "diagonal";
  table.description = "A ball and a cube 4 cm wide that move at 10 m/s and 60 steps a second along a face's diagonal.";
  table.in_report = true;
  return table;
}

Table shapes_table(const std::vector<SweepTotal>& totals) {
  using enum ColumnType;
  Table table;
  table.name = "shapes";
  table.description = "Each bound of each shape over all of its cells.";
  table.in_report = true;
  table.columns = {
      {"shape", text, "", "What moves."},
      {"bound", text, "", "What stands for the volume it sweeps."},
      {"cells", integer, "1", "Conditions."},
      {"touched", integer, "1", "Balls that the shape truly touches, those that just touch included."},
      {"missed", integer, "1", "Of those, not reported by the bound."},
      {"reported", integer, "1", "Balls around the bound that it reports."},
      {"false_hits", integer, "1", "Of those, not touched."},
      {"false_least", number, "1", "Share of reports that are false, by theory, in the cell where it is least."},
      {"false_most", number, "1", "The same where it is most."},
  };
  for (const SweepTotal& t : totals) {
    table.rows.push_back({std::string(name(t.form)), t.bound, t.cells, t.tally.touching + t.tally.grazing,
                          t.tally.missed, t.tally.reported, t.tally.false_hits, t.least_false, t.most_false});
  }
  return table;
}

Table sweep_test_table(const std::vector<SelfTest>& tests) {
  Table table = self_test_table(tests);
  table.description = "Counts of independent balls against theory, over all cells of a bound and event at once.";
  for (Column& column : table.columns) {
    if (column.name == "method") column = {"bound", ColumnType::text, "", "What stands for the swept volume."};
    if (column.name == "scalar") column = {"event", ColumnType::text, "", "What is counted."};
    if (column.name == "judged_cells") column.description = "Cells with at least 5 expected events and 5 without.";
  }
  return table;
}

}  // namespace thinwall
