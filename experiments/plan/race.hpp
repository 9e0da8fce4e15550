#pragma once
/// A scene stepped with its plan, with each omission taken back, with nothing omitted, and with the gate.

#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/experiments/plan/scenes.hpp>

namespace thinwall {

inline constexpr const char* lean_way = "the plan";
inline constexpr const char* full_way = "full plan";
inline constexpr const char* gate_way = "gate";

/// One way to step a scene.
struct Way {
  std::string name;                    ///< one of the above, or the omission that is taken back
  std::uint64_t outcome = 0;           ///< of the state after each step, and of every hit and event that was asked for
  bool repeated_alike = true;          ///< every round gave the same
  std::int64_t sweeps = 0;             ///< pairs asked, over all steps
  std::int64_t gated = 0;              ///< of these not swept
  std::int64_t hits = 0;               ///< contacts, over all steps
  std::int64_t tunneled = 0;           ///< pairs that went through each other unseen; of the plan and the gate
  std::int64_t bytes = 0;              ///< [B] the most that stepping held
  std::vector<double> milliseconds{};  ///< a step, one of each round
};

struct PlanRace {
  std::string scene;
  std::int64_t bodies = 0, steps = 0;
  std::string plan;       ///< the names of what it omits, separated by commas
  std::vector<Way> ways;  ///< the plan, each omission, the full plan, the gate
};

struct PlanRaceOptions {
  std::int64_t steps = 1, rounds = 1;  ///< >= 1
  double gate = 0.5;                   ///< [1] > 0
};

/// Processor time of this thread, one race at a time; each round takes every way in turn.
PlanRace race_plans(const PlanScene& scene, const PlanRaceOptions& options);

/// The way of that name, or null.
const Way* way_named(const PlanRace& race, const std::string& name);

/// True if all ways but the gate give the outcome of the plan, in every round, and the plan lets nothing through.
bool is_right(const PlanRace& race);

/// As the line that a run's journal keeps, and back. Throws std::runtime_error if it is not one.
std::string to_line(const PlanRace& race);
PlanRace plan_race_from_line(const std::string& line);

}  // namespace thinwall
