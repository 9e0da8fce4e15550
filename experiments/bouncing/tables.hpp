#pragma once
/// The bouncing ball's results as tables.

#include <vector>

#include <thinwall/experiments/bouncing/results.hpp>
#include <thinwall/experiments/table.hpp>

namespace thinwall {

Table bounce_means_table(const std::vector<BounceLine>& lines);  ///< at the highest restitution
Table bounce_cells_table(const std::vector<BounceLine>& lines);  ///< every line
Table bounce_test_table(const std::vector<BounceTest>& tests);
Table scenarios_table(const std::vector<ScenarioGroup>& groups);
Table long_runs_table(const std::vector<LongRun>& runs);
Table dropped_table(const std::vector<LongRun>& runs);  ///< the runs that begin with the drop itself
Table even_phases_table(const std::vector<BounceWork>& work);
Table bounce_timings_table(const std::vector<BounceWork>& work);  ///< the one that differs from run to run

}  // namespace thinwall
