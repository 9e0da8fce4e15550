#pragma once
/// Runs of hitscan in memory, for its tests.

#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/hitscan/theory.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

/// Small enough for a debug build, and still with every kind of cell: near and far, thin and thick, steep and flat.
inline constexpr std::string_view few_hitscans = R"(
  range = [3, 30]
  speed = [30, 300]
  radius = [0, 0.02]
  wind = [5]
  shots = 1000
)";

/// A cell like the default's, without the rest.
inline HitscanCell some_shot(double range, double speed, double radius) {
  return {.range = range,
          .speed = speed,
          .radius = radius,
          .wind = 5,
          .drag = 0.5,
          .step = 1.0 / 60,
          .target = 0.15,
          .gravity = 9.81,
          .aim = 1.25};
}

inline std::unique_ptr<Run> hitscan_run(std::string_view text, RunOptions options = {.seed = 1, .trials = {}}) {
  return run_of(hitscan_experiment(), text, options);
}

inline Outcome hitscan_outcome(std::string_view text) { return outcome_of(*hitscan_run(text)); }

}  // namespace thinwall
