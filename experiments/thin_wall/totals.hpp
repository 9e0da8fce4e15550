#pragma once
/// Each method at each scalar over all of its cells.

#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/experiments/table.hpp>
#include <thinwall/experiments/thin_wall/line.hpp>

namespace thinwall {

struct Total {
  std::string method, scalar;
  std::int64_t cells = 0, shots = 0, tunneled = 0, undecided = 0;
  std::int64_t clean_cells = 0;               ///< in which none tunneled
  std::int64_t theory_shots = 0;              ///< in cells for which there is a theory
  std::int64_t theory_tunneled = 0;           ///< ... counted
  double theory_expected = 0;                 ///< ... expected
  std::optional<double> worst_residual = {};  ///< [1] of the cells that can be judged alone, the one farthest from 0
  double seconds = 0;
};

std::vector<Total> totals(const std::vector<Line>& lines);  ///< by method and scalar, in the order of their first line

Table totals_table(const std::vector<Total>& totals);

}  // namespace thinwall
