#pragma once
/// Runs of the experiment engines in memory, for its tests.

#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/engines/line.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

inline constexpr std::string_view few_engine_shots = R"(
  path = [0.1, 0.5, 2]
  wall_size = [250]
  swept_radius = [0.2]
  shots = 400
)";

inline EnginePlan engine_plan(std::string_view text, RunOptions options = {.seed = 1, .trials = {}}) {
  return make_engine_plan(Settings(text, "test.toml", engines_experiment().default_toml), options);
}

inline std::unique_ptr<Run> engines_run(std::string_view text, RunOptions options = {.seed = 1, .trials = {}}) {
  return run_of(engines_experiment(), text, options);
}

inline const EngineCell meter_cell = {
    .path = 1, .step = 1.0 / 60, .radius = 0.05, .thickness = 0.01, .wall_size = 250, .angle_deg = 60, .steps = 10};

}  // namespace thinwall
