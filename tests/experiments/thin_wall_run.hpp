#pragma once
/// Runs of the thin wall experiment in memory, for its tests.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment_list.hpp>

#include "support/experiment_run.hpp"

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
  return run_of(thin_wall_experiment(), text, options);
}

/// The number of shots of `method` that tunneled, by row of `table`.
inline std::vector<std::int64_t> tunneled(const Table& table, const std::string& method) {
  std::vector<std::int64_t> counts;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (value_of(table, row, "method") == Value(method))
      counts.push_back(std::get<std::int64_t>(value_of(table, row, "tunneled")));
  }
  return counts;
}

}  // namespace thinwall
