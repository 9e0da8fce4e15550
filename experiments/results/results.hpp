#pragma once
/// Turns the outcome of a run into the files of its result folder. Nothing else in the project writes one.

#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/results/record.hpp>
#include <thinwall/experiments/results/result_folder.hpp>

namespace thinwall {

/// Writes and publishes everything. Returns what the user should know, a line each: a figure that could not be drawn.
/// Throws std::system_error if a file cannot be written; the folder then keeps its journal, and the run can go on.
std::vector<std::string> write_results(ResultFolder& folder, const RunRecord& run, const Outcome& outcome);

}  // namespace thinwall
