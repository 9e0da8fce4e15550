#pragma once
/// What `--json` prints: one object or array, ended by a newline.

#include <span>
#include <string>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/results/record.hpp>
#include <thinwall/experiments/run/estimate.hpp>

namespace thinwall {

std::string list_reply(std::span<const Experiment> experiments);
std::string dry_run_reply(const RunRecord& run, const std::string& out, double seconds, const RunEstimate& told);
std::string list_cells_reply(const RunRecord& run, const std::string& out, std::span<const Unit> units);
std::string shard_json(const RunRecord& run, const std::string& out, const std::string& shard);
std::string run_reply(const RunRecord& run, const std::string& out, const Outcome& outcome, const std::string& report);

}  // namespace thinwall
