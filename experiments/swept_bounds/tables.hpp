#pragma once
/// The swept bounds' results as tables.

#include <vector>

#include <thinwall/experiments/swept_bounds/line.hpp>
#include <thinwall/experiments/table.hpp>

namespace thinwall {

Table diagonal_table(const std::vector<SweepLine>& lines);  ///< the textbook's picture alone, for the report
Table sweeps_table(const std::vector<SweepLine>& lines);    ///< every cell and bound
Table shapes_table(const std::vector<SweepTotal>& totals);  ///< a row a shape and bound
Table sweep_test_table(const std::vector<SelfTest>& tests);

}  // namespace thinwall
