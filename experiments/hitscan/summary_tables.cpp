#include <algorithm>
#include <array>

#include <thinwall/experiments/hitscan/tables.hpp>

namespace thinwall {

Table hitscan_rules_table(const std::vector<HitscanTotal>& totals) {
  Table table;
  table.name = "rules";
  table.description = "Each rule over all of its cells, every cell with the same number of shots.";
  table.in_report = true;
  table.columns = {
      {"rule", ColumnType::text, "", "How a hit is found."},
      {"shots", ColumnType::integer, "1", "Shots."},
      {"touching", ColumnType::integer, "1", "True hits."},
      {"missed", ColumnType::integer, "1", "Of those, not seen."},
      {"missed_expected", ColumnType::number, "1", "By theory."},
      {"reported", ColumnType::integer, "1", "Hits it reports."},
      {"false_hits", ColumnType::integer, "1", "Of those, shots whose bullet does not touch."},
      {"false_expected", ColumnType::number, "1", "By theory."},
      {"lateness_mean", ColumnType::number, "step", "From contact to the report, of the true hits it reports."},
      {"lateness_min", ColumnType::number, "step", "The earliest of all cells."},
      {"lateness_max", ColumnType::number, "step", "The latest of all cells."},
      {"path_error_max", ColumnType::number, "m", "Largest distance from the arc at the range, of all cells."},
      {"point_error_max", ColumnType::number, "m", "Largest distance from the true point on the target, of all cells."},
  };
  for (const HitscanTotal& t : totals) {
    const auto timed = [&](double x) { return t.timed > 0 ? Value(x) : Value(); };
    table.rows.push_back({std::string(t.rule.name), t.shots, t.touching, t.missed, t.missed_theory, t.reported,
                          t.false_hits, t.false_theory, timed(t.late_steps / static_cast<double>(t.timed)),
                          timed(t.earliest), timed(t.latest), t.path_error_most, timed(t.point_error_most)});
  }
  return table;
}

Table reach_table(const std::vector<HitscanCell>& cells) {
  Table table;
  table.name = "reach";
  table.description =
      "How far hitscan is good: the range at which the ray misses a share of the hits of a bullet without radius, in the limit "
      "of flat fire. Missing where the bullet slows to a tenth of its speed before.";
  table.in_report = true;
  table.columns = {
      {"speed", ColumnType::number, "m/s", "At the muzzle."},
      {"drag", ColumnType::number, "1/s", "Share of its speed, as seen from the air, that the bullet loses a second."},
      {"wind", ColumnType::number, "m/s", "Across the line of fire."},
      {"gravity", ColumnType::number, "m/s^2", "Downward."},
      {"target", ColumnType::number, "m", "Radius of the target."},
      {"range_5_percent", ColumnType::number, "m", "Range at which 5 % of the hits are missed."},
      {"time_5_percent", ColumnType::number, "s", "Flight time to there."},
      {"range_50_percent", ColumnType::number, "m", "Range at which half of the hits are missed."},
      {"time_50_percent", ColumnType::number, "s", "Flight time to there."},
  };
  const auto same_bullet = [](const HitscanCell& a, const HitscanCell& b) {
    return std::array{a.speed, a.drag, a.wind, a.gravity, a.target} ==
           std::array{b.speed, b.drag, b.wind, b.gravity, b.target};
  };
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const HitscanCell& c = cells[i];
    const auto before = cells.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::any_of(cells.begin(), before, [&](const HitscanCell& other) { return same_bullet(c, other); })) continue;
    const auto range = [&](double share) {
      const auto found = range_of_missed(c, share);
      return found ? Value(*found) : Value();
    };
    const auto time = [&](double share) {
      const auto found = range_of_missed(c, share);
      return found ? Value(time_to(arc_of<double>(c), *found)) : Value();
    };
    table.rows.push_back(
        {c.speed, c.drag, c.wind, c.gravity, c.target, range(0.05), time(0.05), range(0.5), time(0.5)});
  }
  return table;
}

Table hitscan_counts_test_table(const std::vector<SelfTest>& tests) {
  Table table = self_test_table(tests);
  table.description = "Counts of independent shots against theory, over all cells of a rule and event at once.";
  for (Column& column : table.columns) {
    if (column.name == "method") column = {"rule", ColumnType::text, "", "How a hit is found."};
    if (column.name == "scalar") column = {"event", ColumnType::text, "", "What is counted."};
    if (column.name == "judged_cells") column.description = "Cells with at least 5 expected events and 5 without.";
  }
  return table;
}

Table moment_tests_table(const std::vector<HitscanMomentTest>& tests) {
  Table table;
  table.name = "moments";
  table.description = "Path errors and lateness against theory, over all cells of a rule at once.";
  table.in_report = true;
  table.columns = {
      {"rule", ColumnType::text, "", "How a hit is found."},
      {"quantity", ColumnType::text, "", "What is measured."},
      {"cells", ColumnType::integer, "1", "Cells in which it is."},
      {"out_of_bounds", ColumnType::integer, "1", "Of those, cells with a shot beyond what is possible; must be 0."},
      {"judged_cells", ColumnType::integer, "1", "Cells whose mean is held against theory."},
      {"chi_square", ColumnType::number, "1", "Sum of squared standard residuals of the means."},
      {"chi_square_lower", ColumnType::number, "1", "Least allowed: central 99.9 % of the chi-square distribution."},
      {"chi_square_upper", ColumnType::number, "1", "Most allowed."},
      {"passed", ColumnType::boolean, "", "All of the above hold."},
  };
  for (const HitscanMomentTest& t : tests) {
    const auto judged = [&](double x) { return t.judged > 0 ? Value(x) : Value(); };
    table.rows.push_back({t.rule, t.quantity, t.cells, t.out_of_bounds, t.judged, judged(t.chi_square),
                          judged(t.chi_square_allowed.lower), judged(t.chi_square_allowed.upper), t.passed()});
  }
  return table;
}

}  // namespace thinwall
