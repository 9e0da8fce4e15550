#pragma once
/// Runs of the crossing bullets in memory, for their tests.

#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/crossing_bullets/line.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

/// Small enough for a debug build, and still with every kind of cell: at rest, chase, crossing and head-on.
inline constexpr std::string_view few_crossings = R"(
  speed = [10]
  ratio = [0, 0.5]
  angle_deg = [0, 90, 180]
  offset = [1, 4]
  shots = 1000
)";

inline std::unique_ptr<Run> crossing_run(std::string_view text, RunOptions options = {.seed = 1, .trials = {}}) {
  return run_of(crossing_bullets_experiment(), text, options);
}

inline Outcome crossing_outcome(std::string_view text) { return outcome_of(*crossing_run(text)); }

}  // namespace thinwall
