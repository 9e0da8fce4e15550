#pragma once
/// Runs of the stiff contact in memory, for their tests.

#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/stiff_contact/verdicts.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

/// Small enough for a debug build, and still with every kind of cell: soft and stiff, undamped, damped and overdamped.
inline constexpr std::string_view few_contacts = R"(
  bounces = 100
  stiffness = [100, 1e6, 1e10]
  damping_ratio = [0, 1e-5, 0.1, 1, 1e5]
  step = [1.5e-5, 0.15, 1.5, 15]
  bounce_damping = [0, 0.1]
  bounce_step = [0.3, 1.5, 1.9, 5, 1000]
  race_step = [0.8, 0.1]
  race_bounces = 4
  rounds = 3
)";

inline std::unique_ptr<Run> stiff_run(std::string_view text, RunOptions options = {.seed = 1, .trials = {}}) {
  return run_of(stiff_contact_experiment(), text, options);
}

inline StiffPlan stiff_plan(std::string_view text = few_contacts) {
  const Experiment experiment = stiff_contact_experiment();
  return make_stiff_plan(Settings(text, "test.toml", experiment.default_toml), {.seed = 1, .trials = {}});
}

inline Outcome stiff_outcome(std::string_view text = few_contacts) { return outcome_of(*stiff_run(text)); }

}  // namespace thinwall
