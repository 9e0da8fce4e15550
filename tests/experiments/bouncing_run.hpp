#pragma once
/// Runs of the bouncing ball in memory, for their tests.

#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/bouncing/scenarios.hpp>
#include <thinwall/experiments/bouncing/theory.hpp>
#include <thinwall/experiments/experiment_list.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

/// Small enough for a debug build, and still with every policy.
inline constexpr std::string_view few_bounces = R"(
  step = [0.03333333333333333, 0.016666666666666666, 0.06666666666666667]
  restitution = [0, 0.5, 1]
  bounces = 400
  runs = 8
  run_bounces = 16
  rounds = 1
  mass_ratio = [1, 1e16]
  scenario = ["zeno", "walls", "masses", "cradle", "digits"]
  digits = 2
)";

inline std::unique_ptr<Run> bouncing_run(std::string_view text, RunOptions options = {.seed = 1, .trials = {}}) {
  return run_of(bouncing_experiment(), text, options);
}

inline Outcome bouncing_outcome(std::string_view text) { return outcome_of(*bouncing_run(text)); }

/// Of few_bounces, run once for all tests that only look.
inline const Outcome& few_bounces_outcome() {
  static const Outcome outcome = bouncing_outcome(few_bounces);
  return outcome;
}

inline std::vector<BouncePolicy> all_bounce_policies() {
  const std::vector<std::string_view> names = bounce_policy_names();
  return bounce_policies({names.begin(), names.end()});
}

inline BouncePolicy bounce_policy(const std::string& name) { return bounce_policies({name}).front(); }

}  // namespace thinwall
