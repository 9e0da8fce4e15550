#pragma once
/// Small runs of the experiment plan in memory, for its tests.

#include <memory>
#include <string>
#include <string_view>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/plan/report.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

inline constexpr std::string_view few_steps = R"(
  count = 60
  steps = 8
  rounds = 2
  shots = 300
  shot_path = [0.4, 3]
  shot_gate = [0.5, 4]
)";

inline std::unique_ptr<Run> plan_run(std::string_view text) {
  return run_of(plan_experiment(), text, {.seed = 5, .trials = {}});
}

/// The races of few steps, scene by scene.
inline PlanResults few_results() {
  PlanResults results;
  for (const std::string_view name : plan_scene_names())
    results.races.push_back(race_plans(make_plan_scene(name, 60, 5), {.steps = 8, .rounds = 2, .gate = 0.5}));
  for (const GateTarget target : {GateTarget::wall, GateTarget::ball}) {
    const GateCell cell{target, 3, 4, 400};
    results.shots.push_back({cell, shoot_at_gate(cell, 1, 5)});
  }
  return results;
}

}  // namespace thinwall
