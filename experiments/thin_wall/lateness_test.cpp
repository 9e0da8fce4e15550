#include <thinwall/experiments/thin_wall/lateness_test.hpp>

#include <algorithm>
#include <cmath>

namespace thinwall {

namespace {

/// The mean of this many is near normal: at least 5 times the number over which rare values average out.
bool mean_is_normal(double detected, const Lateness& theory) {
  const double spread = theory.deviation / theory.largest;
  return theory.largest > 0 && detected * spread * spread >= 5;
}

void add(LatenessTest& test, const Line& line) {
  const double detected = static_cast<double>(line.tally.detected());
  if (detected == 0) return;
  ++test.cells;
  if (line.tally.widest > line.theory.widest + line.resolution) ++test.false_cells;
  if (const std::optional<double> largest = line.theory.largest_lateness()) {
    // Against the settings, a shot's step may be shorter and its wall thicker by a grid unit.
    const double rounding = line.resolution / cosine(*line.cell) + *largest * 0x1p-20;
    if (line.tally.latest > *largest + rounding) ++test.late_cells;
  }
  const std::optional<Lateness>& theory = line.theory.lateness;
  if (!theory || !mean_is_normal(detected, *theory)) return;
  ++test.judged_cells;
  const double residual = (*lateness_mean(line) - theory->mean) / (theory->deviation / std::sqrt(detected));
  test.chi_square += residual * residual;
}

}  // namespace

bool LatenessTest::passed() const {
  return false_cells == 0 && late_cells == 0 && chi_square_allowed.contains(chi_square);
}

std::vector<LatenessTest> lateness_test(const std::vector<Line>& lines) {
  std::vector<LatenessTest> tests;
  for (const Line& line : lines) {
    auto found = std::find_if(tests.begin(), tests.end(), [&](const LatenessTest& test) {
      return test.method == line.detector->method && test.scalar == line.detector->scalar;
    });
    if (found == tests.end()) {
      tests.emplace_back();
      found = tests.end() - 1;
      found->method = line.detector->method;
      found->scalar = line.detector->scalar;
    }
    add(*found, line);
  }
  for (LatenessTest& test : tests) {
    if (test.judged_cells > 0) test.chi_square_allowed = chi_square_range(test.judged_cells, 0.999);
  }
  return tests;
}

Table lateness_table(const std::vector<LatenessTest>& tests) {
  Table table;
  table.name = "lateness";
  table.description =
      "Lateness of detection along the path against theory, over all cells of a method and scalar at once.";
  table.in_report = true;
  table.columns = {
      {"method", ColumnType::text, "", "Way of detecting the hit."},
      {"scalar", ColumnType::text, "", "Floating-point type the method ran in."},
      {"cells", ColumnType::integer, "1", "Cells in which anything was detected."},
      {"false_cells", ColumnType::integer, "1",
       "Of those, cells with a hit where ball and wall are farther apart than the method claims; must be 0."},
      {"late_cells", ColumnType::integer, "1", "Of those, cells with one later than theory allows; must be 0."},
      {"judged_cells", ColumnType::integer, "1", "Cells with a theory and enough detections to judge their mean."},
      {"chi_square", ColumnType::number, "1", "Sum of squared standard residuals of the judged means."},
      {"chi_square_lower", ColumnType::number, "1", "Least allowed: central 99.9 % of the chi-square distribution."},
      {"chi_square_upper", ColumnType::number, "1", "Most allowed."},
      {"passed", ColumnType::boolean, "", "All of the above hold."},
  };
  for (const LatenessTest& t : tests) {
    const auto number = [&](double x) { return t.judged_cells > 0 ? Value(x) : Value(); };
    table.rows.push_back({t.method, t.scalar, t.cells, t.false_cells, t.late_cells, t.judged_cells,
                          number(t.chi_square), number(t.chi_square_allowed.lower), number(t.chi_square_allowed.upper),
                          t.passed()});
  }
  return table;
}

}  // namespace thinwall
