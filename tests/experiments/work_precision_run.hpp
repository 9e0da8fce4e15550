#pragma once
/// Races in memory, for the tests of work_precision.

#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/work_precision/heat.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

/// Every method on two sets, small enough for a debug build.
inline constexpr std::string_view few_races = R"(
  set = ["sphere_wall", "capsule_box"]
  queries = 40
  rounds = 3
  substeps = [8]
  tolerance = [1e-5, 1e-2]
)";

inline std::unique_ptr<Run> race_run(std::string_view text) {
  return run_of(work_precision_experiment(), text, {.seed = 3, .trials = {}});
}

inline std::vector<std::string> run_races(std::string_view text) { return results_of(race_run(text)->units()); }

inline Outcome race_outcome(std::string_view text) { return outcome_of(*race_run(text)); }

/// A racer as none is, for the tests of how they are compared.
inline Racer made_up(std::string method, double p99, std::vector<double> nanoseconds) {
  Racer racer;
  racer.method = std::move(method);
  racer.queries = racer.touching = 100;
  racer.time = {p99 / 2, p99, 2 * p99};
  racer.nanoseconds = std::move(nanoseconds);
  return racer;
}

}  // namespace thinwall
