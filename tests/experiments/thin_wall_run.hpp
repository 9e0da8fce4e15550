#pragma once
/// Runs of the thin wall experiment in memory, for its tests.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/thin_wall.hpp>

namespace thinwall {

/// Small enough for a debug build, and still with every kind of cell.
inline constexpr std::string_view small = R"(
  speed = [3, 40]
  step = [0.01, 0.05]
  radius = [0, 0.02]
  thickness = [0.01]
  angle_deg = [0, 60]
  wall = ["infinite", "finite"]
  shots = 400
)";

inline std::unique_ptr<Run> configured(std::string_view text, RunOptions options = {.seed = 1, .trials = {}}) {
  const Experiment experiment = thin_wall_experiment();
  const Settings settings(text, "test.toml", experiment.default_toml);
  settings.reject_unknown_keys();
  return experiment.configure(settings, options);
}

inline std::vector<std::string> computed(const std::vector<Unit>& units) {
  std::vector<std::string> results;
  for (const Unit& unit : units) results.push_back(unit.compute());
  return results;
}

inline Outcome outcome_of(const Run& run) {
  const std::vector<std::string> results = computed(run.units());
  return run.finish(results, std::vector<double>(results.size(), 1e-3));
}

inline const Table& table(const Outcome& outcome, const std::string& name) {
  return *std::find_if(outcome.tables.begin(), outcome.tables.end(), [&](const Table& t) { return t.name == name; });
}

inline const Value& value(const Table& table, std::size_t row, const std::string& column) {
  const auto found =
      std::find_if(table.columns.begin(), table.columns.end(), [&](const Column& c) { return c.name == column; });
  return table.rows[row][static_cast<std::size_t>(found - table.columns.begin())];
}

/// The number of shots of `method` that tunneled, by row of `table`.
inline std::vector<std::int64_t> tunneled(const Table& table, const std::string& method) {
  std::vector<std::int64_t> counts;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (value(table, row, "method") == Value(method))
      counts.push_back(std::get<std::int64_t>(value(table, row, "tunneled")));
  }
  return counts;
}

}  // namespace thinwall
