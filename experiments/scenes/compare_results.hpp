#pragma once
/// A comparison as tables, pictures and words.

#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/scenes/comparison.hpp>

namespace thinwall {

Table compare_table(const std::vector<Contest>& contests);
Table compare_timings_table(const Comparison& comparison, const std::vector<Contest>& contests);

/// Tunneled pairs and time error against the step, one series a policy.
Figure compare_figure(const Comparison& comparison, const std::vector<Contest>& contests);
/// Time error against run time.
Figure error_against_time_figure(const Comparison& comparison, const std::vector<Contest>& contests);

Outcome compare_outcome(const Comparison& comparison, const Trial& exact, const std::vector<Contest>& contests);

}  // namespace thinwall
