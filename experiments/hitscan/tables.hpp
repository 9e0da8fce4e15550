#pragma once
/// Hitscan's results as tables.

#include <thinwall/experiments/hitscan/totals.hpp>
#include <thinwall/experiments/table.hpp>

namespace thinwall {

Table hitscan_cells_table(const std::vector<HitscanLine>& lines);  ///< every line
Table known_shots_table(const std::vector<HitscanLine>& lines);
Table hitscan_rules_table(const std::vector<HitscanTotal>& totals);
/// How far hitscan is good: by speed and air, the range at which it misses a share of the hits.
Table reach_table(const std::vector<HitscanCell>& cells);
Table hitscan_counts_test_table(const std::vector<SelfTest>& tests);
Table moment_tests_table(const std::vector<HitscanMomentTest>& tests);

}  // namespace thinwall
