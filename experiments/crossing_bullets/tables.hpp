#pragma once
/// The crossing bullets' results as tables.

#include <vector>

#include <thinwall/experiments/crossing_bullets/line.hpp>
#include <thinwall/experiments/table.hpp>

namespace thinwall {

Table crossings_table(const std::vector<CrossingLine>& lines);  ///< every line
Table head_on_table(const std::vector<CrossingLine>& lines);    ///< two of the textbook's bullets, head-on
Table counts_test_table(const std::vector<SelfTest>& tests);
Table timing_test_table(const std::vector<TimingTest>& tests);

}  // namespace thinwall
