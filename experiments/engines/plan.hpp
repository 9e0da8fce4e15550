#pragma once
/// What a run of the engines fires: the cells, the modes, and how many shots of each.

#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/experiments/engines/engine.hpp>
#include <thinwall/experiments/engines/fly.hpp>
#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/settings.hpp>

namespace thinwall {

/// An engine in one of its modes.
struct EngineSetup {
  Engine engine;
  EngineMode mode;
  std::string label() const { return engine.called + " " + mode.name; }  ///< for people
  bool can_do(const EngineCell& cell) const { return cell.path <= engine.most_path; }
};

struct EnginePlan {
  std::vector<EngineCell> cells;  ///< by wall, then by path in rising order
  std::vector<EngineSetup> setups;
  std::vector<Engine> missing;  ///< asked for by "all", and not in the program
  std::int64_t shots;           ///< of each cell and setup
  std::uint64_t seed;
};

/// Throws UsageError.
EnginePlan make_engine_plan(const Settings& settings, const RunOptions& options);

/// A line for each engine that is missing: what it is, and what would bring it.
std::vector<std::string> missing_engines(const EnginePlan& plan);

}  // namespace thinwall
