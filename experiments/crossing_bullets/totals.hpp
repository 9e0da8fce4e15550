#pragma once
/// Each rule over all of its cells.

#include <string>
#include <vector>

#include <thinwall/experiments/crossing_bullets/line.hpp>
#include <thinwall/experiments/table.hpp>

namespace thinwall {

struct CrossingTotal {
  std::string rule;
  CrossingTally tally = {};  ///< counts added up; latest and earliest over all cells
  double missed_theory = 0;  ///< expected number of misses
  bool has_theory = true;    ///< in every cell
  double least_missed = 1;   ///< [1] of the true hits, by theory, in the cell where that is least
  double most_missed = 0;    ///< ... where it is most
  double seconds = 0;        ///< of asking, drawing and the oracle included
};

/// By rule, in the order of their first line. `seconds` as long as `lines`.
std::vector<CrossingTotal> totals(const std::vector<CrossingLine>& lines, const std::vector<double>& seconds);

Table rules_table(const std::vector<CrossingTotal>& totals);
Table rule_timings_table(const std::vector<CrossingTotal>& totals);  ///< the one that differs from run to run

}  // namespace thinwall
