#include <thinwall/experiments/lab/judge.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/lab/columns.hpp>

namespace thinwall {

namespace {

constexpr double false_alarms = 0.001, central = 1 - false_alarms;

/// Of a count of which theory is sure, infinite.
double residual_of(const CellCount& cell) {
  if (cell.theory != 0 && cell.theory != 1) return standard_residual(cell.counted, cell.trials, cell.theory);
  const std::int64_t certain = cell.theory == 0 ? 0 : cell.trials;
  return cell.counted == certain ? 0 : std::numeric_limits<double>::infinity();
}

void add(SelfTest& test, const CellCount& cell) {
  const double residual = residual_of(cell);
  if (cell.theory == 0 || cell.theory == 1) {
    ++test.certain_cells;
    if (residual != 0) ++test.certain_wrong;
  } else if (can_be_judged(cell.trials, cell.theory)) {
    ++test.judged_cells;
    if (wilson(cell.counted, cell.trials).contains(cell.theory)) ++test.covered;
    test.chi_square += residual * residual;
  } else {
    ++test.other_cells;
    return;
  }
  if (!test.farthest || std::abs(residual) > std::abs(residual_of(*test.farthest))) test.farthest = cell;
}

}  // namespace

bool can_be_judged(std::int64_t trials, double theory) {
  const double n = static_cast<double>(trials);
  return 5 <= n * theory && n * theory <= n - 5;
}

void ResidualTest::add(double residual) {
  ++judged;
  chi_square += residual * residual;
}

std::optional<Interval> ResidualTest::allowed() const {
  return judged > 0 ? std::optional(chi_square_range(judged, central)) : std::nullopt;
}

bool ResidualTest::passed() const { return judged == 0 || allowed()->contains(chi_square); }

bool SelfTest::passed() const {
  return certain_wrong == 0 && covered_allowed.contains(static_cast<double>(covered)) &&
         chi_square_allowed.contains(chi_square);
}

std::vector<SelfTest> self_test(const std::vector<CellCount>& cells) {
  std::vector<SelfTest> tests;
  for (const CellCount& cell : cells) {
    auto found = std::find_if(tests.begin(), tests.end(),
                              [&](const SelfTest& test) { return test.name == cell.name && test.part == cell.part; });
    if (found == tests.end()) found = tests.insert(tests.end(), {.name = cell.name, .part = cell.part});
    add(*found, cell);
  }
  const auto judged =
      std::count_if(tests.begin(), tests.end(), [](const SelfTest& test) { return test.judged_cells > 0; });
  const double allowed = 1 - false_alarms / static_cast<double>(2 * judged);
  for (SelfTest& test : tests) {
    if (test.judged_cells == 0) continue;
    test.covered_allowed = binomial_range(test.judged_cells, confidence, allowed);
    test.chi_square_allowed = chi_square_range(test.judged_cells, allowed);
  }
  return tests;
}

std::string self_test_text(const std::vector<SelfTest>& tests) {
  std::string text;
  for (const SelfTest& t : tests) {
    text += fmt::format("{}, {}: {} cells certain, {} wrong", t.name, t.part, t.certain_cells, t.certain_wrong);
    if (t.judged_cells > 0) {
      text += fmt::format(
          "; {} of {} intervals hold the theory (allowed {} to {}), chi-square {:.1f} (allowed {:.1f} to {:.1f})",
          t.covered, t.judged_cells, t.covered_allowed.lower, t.covered_allowed.upper, t.chi_square,
          t.chi_square_allowed.lower, t.chi_square_allowed.upper);
    }
    if (!t.passed()) {
      const CellCount& cell = *t.farthest;
      text += fmt::format(": FAILED; farthest off is a cell with {} of {} where {:.6g} are expected", cell.counted,
                          cell.trials, static_cast<double>(cell.trials) * cell.theory);
    }
    text += ".\n\n";
  }
  return text;
}

Table self_test_table(const std::vector<SelfTest>& tests, std::string description, const Heading& of,
                      const Heading& part) {
  using T = SelfTest;
  const auto columns = columns_of<T>(
      text(of.name, of.description, &T::name), text(part.name, part.description, &T::part),
      value("certain_cells", "1", "Cells whose theory is exactly 0 or 1.", &T::certain_cells),
      value("certain_wrong", "1", "Of those, cells whose count is not exactly that; must be 0.", &T::certain_wrong),
      value("judged_cells", "1", "Cells with at least 5 expected events and 5 without.", &T::judged_cells),
      value("covered", "1", "Of those, cells whose 95 % Wilson interval holds the theory.", &T::covered),
      where([](const T& t) { return t.judged_cells > 0; },
            columns_of<T>(
                allowed_columns<std::int64_t>(
                    "covered_",
                    "Least allowed by Binomial(judged_cells, 0.95): all of this table fail a right run once in 1000.",
                    &T::covered_allowed),
                value("chi_square", "1", "Sum of squared standard residuals over the judged cells.", &T::chi_square),
                allowed_columns("chi_square_", "Least allowed by the chi-square distribution, likewise.",
                                &T::chi_square_allowed))),
      value("other_cells", "1", "Cells with a theory but too few expected events to judge alone.", &T::other_cells),
      value("passed", "", "All of the above hold.", &T::passed));
  return in_report(table("self_test", std::move(description), columns, tests));
}

}  // namespace thinwall
