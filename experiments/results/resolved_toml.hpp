#pragma once
/// The whole configuration of a run as a TOML file that runs as it is.

#include <string>

#include <thinwall/experiments/results/record.hpp>

namespace thinwall {

std::string resolved_toml(const RunRecord& run);

}  // namespace thinwall
