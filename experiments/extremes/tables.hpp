#pragma once
/// The tables: the ladder with run time beside it, the self-test, every break, every cell, and times.

#include <vector>

#include <thinwall/experiments/extremes/line.hpp>
#include <thinwall/experiments/extremes/theory.hpp>
#include <thinwall/experiments/table.hpp>

namespace thinwall {

Table ladder_table(const std::vector<ExtremeLine>& lines);
Table ladder_test_table(const std::vector<LadderTest>& tests);
Table breaks_table(const std::vector<ExtremeLine>& lines);
Table extreme_cells_table(const std::vector<ExtremeLine>& lines);
Table extreme_timings_table(const std::vector<ExtremeLine>& lines);

}  // namespace thinwall
