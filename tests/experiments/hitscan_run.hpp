#pragma once
/// Runs of hitscan in memory, for its tests.

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/hitscan.hpp>
#include <thinwall/experiments/hitscan/line.hpp>
#include <thinwall/experiments/settings.hpp>

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
  const Experiment experiment = hitscan_experiment();
  const Settings settings(text, "test.toml", experiment.default_toml);
  settings.reject_unknown_keys();
  return experiment.configure(settings, options);
}

inline std::vector<std::string> results_of(const std::vector<Unit>& units) {
  std::vector<std::string> results;
  for (const Unit& unit : units) results.push_back(unit.compute());
  return results;
}

inline Outcome hitscan_outcome(std::string_view text) {
  const auto run = hitscan_run(text);
  const std::vector<std::string> results = results_of(run->units());
  return run->finish(results, std::vector<double>(results.size(), 1e-3));
}

inline const Table& table_of(const Outcome& outcome, const std::string& name) {
  return *std::find_if(outcome.tables.begin(), outcome.tables.end(), [&](const Table& t) { return t.name == name; });
}

/// Of the rule's row in a table with one row a rule.
inline const Value& value_of(const Table& table, const std::string& rule, const std::string& column) {
  const auto at =
      std::find_if(table.columns.begin(), table.columns.end(), [&](const Column& c) { return c.name == column; });
  const auto row =
      std::find_if(table.rows.begin(), table.rows.end(), [&](const auto& r) { return r[0] == Value(rule); });
  return (*row)[static_cast<std::size_t>(at - table.columns.begin())];
}

}  // namespace thinwall
