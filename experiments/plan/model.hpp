#pragma once
/// Scenes that need everything, something and nothing of what a step can do, each stepped with its plan, with each omission taken
/// back, with nothing omitted, and with the gate.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

struct PlanScene {
  std::string name;
  std::vector<Body> bodies;
  WorldOptions options;
};

std::span<const std::string_view> plan_scene_names();

/// About `count` >= 2 bodies. `name` is one of the names. Bodies start apart, but for the tiles of a floor, which touch.
PlanScene make_plan_scene(std::string_view name, std::int64_t count, std::uint64_t seed);

inline constexpr std::string_view lean_way = "the plan", full_way = "full plan", gate_way = "gate";

/// One way to step a scene.
struct Way {
  std::string name;           ///< one of the above, or the omission that is taken back
  std::uint64_t outcome = 0;  ///< of the state after each step, and of every hit and event that was asked for
  bool repeated_alike = true;
  std::int64_t sweeps = 0, gated = 0, hits = 0, tunneled = 0, bytes = 0;
  std::vector<double> milliseconds = {};  ///< a step, one of each round

  static constexpr auto fields() {
    using W = Way;
    return record(
        kept("way", &W::name, "", "The plan, the omission that is taken back, the full plan, or the gate."),
        kept("outcome", &W::outcome), kept("repeated_alike", &W::repeated_alike, "", "Every round gave the same bits."),
        kept("sweeps", &W::sweeps, "1", "Pairs asked over all steps."),
        kept("gated", &W::gated, "1", "Of these not swept, but looked at where the step starts."),
        kept("hits", &W::hits, "1", "Contacts over all steps."),
        kept("tunneled", &W::tunneled, "1", "Pairs that went through each other unseen; of the plan and the gate."),
        kept("bytes", &W::bytes, "B", "Held for stepping at most, without the memory of the broad phase itself."),
        kept("milliseconds", &W::milliseconds));
  }
  /// Whether anybody asked what passes unseen: of the others it would be the same as of the plan.
  bool is_judged() const { return name == lean_way || name == gate_way; }
};

struct PlanRace {
  std::string scene;
  std::int64_t bodies = 0, steps = 0;
  std::vector<Way> ways;  ///< the plan, each omission, the full plan, the gate

  static constexpr auto fields() {
    return record(kept("scene", &PlanRace::scene), kept("bodies", &PlanRace::bodies), kept("steps", &PlanRace::steps),
                  kept("ways", &PlanRace::ways));
  }
};

struct PlanRaceOptions {
  std::int64_t steps = 1, rounds = 1;  ///< >= 1
  double gate = 0.5;                   ///< [1] > 0
};

/// Processor time of this thread, one race at a time; each round takes every way in turn.
PlanRace race_plans(const PlanScene& scene, const PlanRaceOptions& options);

/// True if all ways but the gate give the outcome of the plan, in every round, and the plan lets nothing through.
bool is_right(const PlanRace& race);

}  // namespace thinwall
