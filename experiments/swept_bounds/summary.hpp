#pragma once
/// The swept bounds' results in words: the answer, the table on the terminal, and the report's sections.

#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/swept_bounds/timing.hpp>

namespace thinwall {

/// Counts alone: the same on every run.
std::string sweep_answer(const std::vector<SweepLine>& lines, const std::vector<SweepTotal>& totals, const Sweep& view);

/// Counts, and what was timed at the view's speed.
std::string sweep_summary(const std::vector<SweepLine>& lines, const std::vector<SweepTotal>& totals,
                          const std::vector<SelfTest>& tests, const std::vector<SweepCost>& costs, const Sweep& view);
std::vector<Section> sweep_sections(const std::vector<SelfTest>& tests);

}  // namespace thinwall
