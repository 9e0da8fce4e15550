#pragma once
/// Runs of the swept bounds in memory, for their tests.

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/swept_bounds.hpp>
#include <thinwall/experiments/swept_bounds/line.hpp>

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
  const Experiment experiment = swept_bounds_experiment();
  const Settings settings(text, "test.toml", experiment.default_toml);
  settings.reject_unknown_keys();
  return experiment.configure(settings, options);
}

inline std::vector<std::string> sweep_results(const std::vector<Unit>& units) {
  std::vector<std::string> results;
  for (const Unit& unit : units) results.push_back(unit.compute());
  return results;
}

inline Outcome sweep_outcome(std::string_view text) {
  const auto run = sweep_run(text);
  const std::vector<std::string> results = sweep_results(run->units());
  return run->finish(results, std::vector<double>(results.size(), 1e-3));
}

inline const Table& sweep_table(const Outcome& outcome, const std::string& name) {
  return *std::find_if(outcome.tables.begin(), outcome.tables.end(), [&](const Table& t) { return t.name == name; });
}

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
