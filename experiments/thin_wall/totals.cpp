#include <thinwall/experiments/thin_wall/totals.hpp>

#include <algorithm>
#include <cmath>

namespace thinwall {

namespace {

void add(Total& total, const Line& line) {
  ++total.cells;
  total.shots += line.tally.shots;
  total.tunneled += line.tally.tunneled;
  total.undecided += line.tally.undecided;
  total.clean_cells += line.tally.tunneled == 0 ? 1 : 0;
  total.seconds += line.seconds;
  if (line.theory.probability) {
    total.theory_shots += line.tally.shots;
    total.theory_tunneled += line.tally.tunneled;
    total.theory_expected += *line.theory.probability * static_cast<double>(line.tally.shots);
  }
  if (can_be_judged(line) && std::abs(*residual(line)) >= std::abs(total.worst_residual.value_or(0))) {
    total.worst_residual = *residual(line);
  }
}

}  // namespace

std::vector<Total> totals(const std::vector<Line>& lines) {
  std::vector<Total> all;
  for (const Line& line : lines) {
    auto found = std::find_if(all.begin(), all.end(), [&](const Total& total) {
      return total.method == line.detector->method && total.scalar == line.detector->scalar;
    });
    if (found == all.end()) {
      all.emplace_back();
      found = all.end() - 1;
      found->method = line.detector->method;
      found->scalar = line.detector->scalar;
    }
    add(*found, line);
  }
  return all;
}

Table totals_table(const std::vector<Total>& totals) {
  Table table;
  table.name = "methods";
  table.description = "Each method over all of its cells, every cell with the same number of shots.";
  table.in_report = true;
  table.columns = {
      {"method", ColumnType::text, "", "Way of detecting the hit."},
      {"scalar", ColumnType::text, "", "Floating-point type the query is asked in."},
      {"cells", ColumnType::integer, "1", "Cells fired at."},
      {"clean_cells", ColumnType::integer, "1", "Cells in which no shot tunneled."},
      {"shots", ColumnType::integer, "1", "Shots fired."},
      {"tunneled", ColumnType::integer, "1", "Shots that passed the wall undetected."},
      {"undecided", ColumnType::integer, "1", "Shots that ended because the method gave up."},
      {"upper", ColumnType::number, "1",
       "With 97.5 % confidence the mean probability over the cells is below this "
       "(Clopper-Pearson); stated where none tunneled."},
      {"theory_shots", ColumnType::integer, "1", "Shots in cells for which there is a theory."},
      {"theory_tunneled", ColumnType::integer, "1", "Of those, counted to tunnel."},
      {"theory_expected", ColumnType::number, "1", "Of those, expected to tunnel."},
      {"worst_residual", ColumnType::number, "1", "Standard errors from theory, in the cell where that is most."},
  };
  for (const Total& t : totals) {
    const bool none = t.tunneled == 0 && t.undecided == 0;
    table.rows.push_back({t.method, t.scalar, t.cells, t.clean_cells, t.shots, t.tunneled, t.undecided,
                          none ? Value(clopper_pearson(0, t.shots).upper) : Value(), t.theory_shots, t.theory_tunneled,
                          t.theory_expected, t.worst_residual ? Value(*t.worst_residual) : Value()});
  }
  return table;
}

}  // namespace thinwall
