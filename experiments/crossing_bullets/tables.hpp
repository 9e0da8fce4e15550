#pragma once
/// The crossing bullets' results as tables.

#include <vector>

#include <thinwall/experiments/crossing_bullets/line.hpp>
#include <thinwall/experiments/table.hpp>

namespace thinwall {

/// One rule over all of its cells.
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

Table crossings_table(const std::vector<CrossingLine>& lines);  ///< every line
Table head_on_table(const std::vector<CrossingLine>& lines);    ///< two of the textbook's bullets, head-on
Table rules_table(const std::vector<CrossingTotal>& totals);
Table counts_test_table(const std::vector<SelfTest>& tests);
Table timing_test_table(const std::vector<TimingTest>& tests);
Table rule_timings_table(const std::vector<CrossingTotal>& totals);  ///< the one that differs from run to run

}  // namespace thinwall
