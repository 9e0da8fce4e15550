#pragma once
/// Does the lateness of detection agree with theory? Means by their standard residuals, extremes by their bounds. A hit
/// with a gap between ball and wall that the method does not own up to would be a false one: it is looked for in every
/// cell, also where there is no theory.

#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/experiments/statistics.hpp>
#include <thinwall/experiments/table.hpp>
#include <thinwall/experiments/thin_wall/line.hpp>

namespace thinwall {

/// The verdict on one method at one scalar.
struct LatenessTest {
  std::string method, scalar;
  std::int64_t cells = 0;         ///< in which anything was detected
  std::int64_t false_cells = 0;   ///< ... with a gap between ball and wall, by more than theory or rounding explains
  std::int64_t late_cells = 0;    ///< ... later than theory's largest lateness, by more than rounding explains
  std::int64_t judged_cells = 0;  ///< theory varies, and enough was detected for its mean to be near normal
  double chi_square = 0;          ///< sum of the squared standard residuals of their means
  Interval chi_square_allowed = {0, 0};  ///< central 99.9 % of its distribution
  bool passed() const;
};

std::vector<LatenessTest> lateness_test(const std::vector<Line>& lines);  ///< by method and scalar

Table lateness_table(const std::vector<LatenessTest>& tests);

}  // namespace thinwall
