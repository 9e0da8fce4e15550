#include <thinwall/experiments/hitscan/tables.hpp>

#include <algorithm>
#include <array>
#include <functional>

#include <thinwall/experiments/tables/without_columns.hpp>

namespace thinwall {

namespace {

/// A column, and what a line writes into it.
struct Field {
  Column column;
  std::function<Value(const HitscanLine&)> read;
};

Value maybe(const std::optional<double>& x) { return x ? Value(*x) : Value(); }
Value maybe(const std::optional<double>& x, double unit) { return x ? Value(*x / unit) : Value(); }

std::vector<Field> factors() {
  using enum ColumnType;
  const auto factor = [](const char* name, const char* unit, const char* what, double HitscanCell::*field) {
    return Field{{name, number, unit, what}, [field](const HitscanLine& l) { return l.cell.*field; }};
  };
  return {
      {{"rule", text, "", "How a hit is found."}, [](const HitscanLine& l) { return std::string(l.rule.name); }},
      {{"shot", text, "", "Which of the known shots it is; empty for the others."},
       [](const HitscanLine& l) { return std::string(known_name(l.cell)); }},
      factor("range", "m", "From the muzzle to the plane of the target's center.", &HitscanCell::range),
      factor("speed", "m/s", "At the muzzle.", &HitscanCell::speed),
      factor("radius", "m", "Of the bullet.", &HitscanCell::radius),
      factor("wind", "m/s", "Across the line of fire; 0 where there is no drag.", &HitscanCell::wind),
      factor("drag", "1/s", "Share of its speed, as seen from the air, that the bullet loses a second.",
             &HitscanCell::drag),
      factor("gravity", "m/s^2", "Downward.", &HitscanCell::gravity),
      factor("step", "s", "Time step of the frames.", &HitscanCell::step),
      factor("target", "m", "Radius of the target.", &HitscanCell::target),
      {{"flight_time", number, "s", "From the muzzle to the range."},
       [](const HitscanLine& l) { return flight_time(l.cell); }},
      {{"deflection", number, "m", "Of the arc from the line of fire, at the range, by gravity and wind."},
       [](const HitscanLine& l) { return deflection(l.cell); }},
  };
}

std::vector<Field> verdicts() {
  using enum ColumnType;
  const auto missed = [](const HitscanLine& l) { return wilson(l.tally.missed, l.tally.touching); };
  const auto wrong = [](const HitscanLine& l) { return wilson(l.tally.false_hits, l.tally.reported()); };
  return {
      {{"shots", integer, "1", "Shots."}, [](const HitscanLine& l) { return l.tally.shots; }},
      {{"touching", integer, "1", "True hits, by the exact arc."},
       [](const HitscanLine& l) { return l.tally.touching; }},
      {{"touching_theory", number, "1", "Expected number of them."},
       [](const HitscanLine& l) { return l.expected.touch * static_cast<double>(l.tally.shots); }},
      {{"missed", integer, "1", "True hits that the rule does not see."},
       [](const HitscanLine& l) { return l.tally.missed; }},
      {{"missed_share", number, "1", "missed / touching; missing if nothing touches.", "missed_lower", "missed_upper"},
       [](const HitscanLine& l) { return maybe(missed_share(l)); }},
      {{"missed_lower", number, "1", "Lower end of its 95 % Wilson interval."},
       [=](const HitscanLine& l) { return l.tally.touching > 0 ? Value(missed(l).lower) : Value(); }},
      {{"missed_upper", number, "1", "Upper end of it."},
       [=](const HitscanLine& l) { return l.tally.touching > 0 ? Value(missed(l).upper) : Value(); }},
      {{"missed_theory", number, "1", "The share by theory."},
       [](const HitscanLine& l) { return maybe(missed_share_theory(l)); }},
      {{"reported", integer, "1", "Hits that the rule reports."},
       [](const HitscanLine& l) { return l.tally.reported(); }},
      {{"false_hits", integer, "1", "Of those, shots whose bullet does not touch."},
       [](const HitscanLine& l) { return l.tally.false_hits; }},
      {{"false_share", number, "1", "false_hits / reported; missing if nothing is reported.", "false_lower",
        "false_upper"},
       [](const HitscanLine& l) { return maybe(false_share(l)); }},
      {{"false_lower", number, "1", "Lower end of its 95 % Wilson interval."},
       [=](const HitscanLine& l) { return l.tally.reported() > 0 ? Value(wrong(l).lower) : Value(); }},
      {{"false_upper", number, "1", "Upper end of it."},
       [=](const HitscanLine& l) { return l.tally.reported() > 0 ? Value(wrong(l).upper) : Value(); }},
      {{"false_theory", number, "1", "The share by theory."},
       [](const HitscanLine& l) { return maybe(false_share_theory(l)); }},
  };
}

std::vector<Field> errors() {
  using enum ColumnType;
  const auto extreme = [](HitscanSpread HitscanTally::*spread, double HitscanSpread::*end) {
    return [=](const HitscanLine& l) { return (l.tally.*spread).count > 0 ? Value(l.tally.*spread.*end) : Value(); };
  };
  const auto steps = [](double HitscanSpread::*end) {
    return [=](const HitscanLine& l) {
      return l.tally.lateness.count > 0 ? Value(l.tally.lateness.*end / l.cell.step) : Value();
    };
  };
  return {
      {{"path_error_mean", number, "m", "From the rule's path to the arc, where they cross the plane of the target."},
       [](const HitscanLine& l) { return mean_path_error(l); }},
      {{"path_error_theory", number, "m", "The same by theory."},
       [](const HitscanLine& l) { return l.expected.path_error.mean; }},
      {{"path_error_max", number, "m", "The largest."}, extreme(&HitscanTally::path_error, &HitscanSpread::most)},
      {{"path_error_bound", number, "m", "The largest possible, by theory."},
       [](const HitscanLine& l) { return l.expected.path_error_most; }},
      {{"point_error_mean", number, "m",
        "From the reported point on the target to the true one, of the true hits it reports; missing if there are none."},
       [](const HitscanLine& l) { return maybe(mean_point_error(l)); }},
      {{"point_error_max", number, "m", "The largest."}, extreme(&HitscanTally::point_error, &HitscanSpread::most)},
      {{"lateness_mean", number, "step", "From first contact to the report, of the same hits; < 0 is early."},
       [](const HitscanLine& l) { return maybe(mean_lateness(l), l.cell.step); }},
      {{"lateness_theory", number, "step", "The same by theory, of next_frame."},
       [](const HitscanLine& l) {
         return l.expected.lateness ? Value(l.expected.lateness->mean / l.cell.step) : Value();
       }},
      {{"lateness_min", number, "step", "The earliest report."}, steps(&HitscanSpread::least)},
      {{"lateness_max", number, "step", "The latest."}, steps(&HitscanSpread::most)},
  };
}

Table make_table(const std::vector<HitscanLine>& lines) {
  Table table;
  table.rows.resize(lines.size());
  for (const auto& group : {factors(), verdicts(), errors()}) {
    for (const Field& field : group) {
      table.columns.push_back(field.column);
      for (std::size_t i = 0; i < lines.size(); ++i) table.rows[i].push_back(field.read(lines[i]));
    }
  }
  return table;
}

}  // namespace

Table hitscan_cells_table(const std::vector<HitscanLine>& lines) {
  Table table = make_table(lines);
  table.name = "cells";
  table.description = "Every cell at every rule: what it misses, what it hits falsely, how far off and how late it is.";
  return table;
}

Table known_shots_table(const std::vector<HitscanLine>& lines) {
  std::vector<HitscanLine> known;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(known),
               [](const HitscanLine& l) { return is_known(l.cell); });
  Table table = make_table(known);
  table.name = "known_shots";
  table.description =
      "Shots whose numbers a reader knows, at every rule; cells.csv holds all that was measured of them.";
  table.in_report = true;
  constexpr std::array<std::string_view, 14> left_out = {
      "drag",         "flight_time", "deflection",     "touching",         "touching_theory",  "missed",
      "reported",     "false_hits",  "path_error_max", "point_error_mean", "path_error_bound", "point_error_max",
      "lateness_min", "lateness_max"};
  return without_columns(table, left_out);
}

}  // namespace thinwall
