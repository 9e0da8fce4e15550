#pragma once
/// Runs of the crossing bullets in memory, for their tests.

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/crossing_bullets.hpp>
#include <thinwall/experiments/crossing_bullets/line.hpp>
#include <thinwall/experiments/settings.hpp>

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
  const Experiment experiment = crossing_bullets_experiment();
  const Settings settings(text, "test.toml", experiment.default_toml);
  settings.reject_unknown_keys();
  return experiment.configure(settings, options);
}

inline std::vector<std::string> results_of(const std::vector<Unit>& units) {
  std::vector<std::string> results;
  for (const Unit& unit : units) results.push_back(unit.compute());
  return results;
}

inline Outcome crossing_outcome(std::string_view text) {
  const auto run = crossing_run(text);
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
