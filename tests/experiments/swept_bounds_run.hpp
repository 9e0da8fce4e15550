#pragma once
/// Runs of the swept bounds in memory, for their tests.

#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/swept_bounds/line.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

/// Small enough for a debug build, and still with every shape, motion along an axis, across and oblique.
inline constexpr std::string_view few_sweeps = R"(
  speed = [2.5, 40]
  angle_deg = [0, 30, 90]
  turn_deg = [0, 45]
  obstacle = [0.1, 1]
  shots = 1000
  timing_repeats = 0
)";

inline std::unique_ptr<Run> sweep_run(std::string_view text, RunOptions options = {.seed = 1, .trials = {}}) {
  return run_of(swept_bounds_experiment(), text, options);
}

inline Outcome sweep_outcome(std::string_view text) { return outcome_of(*sweep_run(text)); }

/// The measured lines of settings laid over the defaults.
inline std::vector<SweepLine> sweep_lines(std::string_view text, std::int64_t shots) {
  const Experiment experiment = swept_bounds_experiment();
  const SweepPlan plan = make_sweeps(Settings(text, "test.toml", experiment.default_toml));
  const std::vector<std::string_view> names = swept_bound_names();
  const std::vector<SweptBound> bounds = swept_bounds_named(std::vector<std::string>(names.begin(), names.end()));
  std::vector<SweepLine> lines;
  for (const SweepPair& pair : serving_pairs(plan.cells, bounds)) {
    lines.push_back(make_line(pair, pair.bound->ask_all(pair.sweep, 1, shots)));
  }
  return lines;
}

}  // namespace thinwall
