#pragma once
/// Scenes that need everything, something and nothing of what a step can do, each stepped with its plan, with each omission taken
/// back, with nothing omitted, and with the gate.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

struct PlanScene {
  std::string name;
  std::vector<Body> bodies;
  WorldOptions options;
};

inline constexpr std::array<std::string_view, 7> plan_scene_names = {"crowd",  "slow_crowd", "town", "told",
                                                                     "unread", "unasked",    "few"};

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
        kept("tunneled", &W::tunneled, "1", "Contacts that went unseen; of the plan and the gate."),
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

// ---- What the motion gate misses: balls shot at a thin wall and at a ball, each in a lane of its own, nobody stopped.
//
// A ball of radius r moves s r a step. Where s <= gate its pair is looked at only at the starts of steps: at poses s r
// apart, their phase as likely as any. It misses a contact that takes a way of c < s r with chance 1 - c / (s r). For a wall of
// thickness w, c = w + 2 r. For a ball of radius r hit at an offset that is uniform over the disk of radius 2 r, the chord c =
// 4 r u has density 2 u in u: the chance is l^2 / 3 for l = s / 4 <= 1, else 1 - 2 / (3 l). Where s > gate: 0.

enum class GateTarget { wall, ball };

struct GateCell {
  GateTarget target = GateTarget::wall;
  double path = 1;         ///< [1] > 0: radii a step
  double gate = 0.5;       ///< [1] > 0
  std::int64_t shots = 1;  ///< >= 1
};

struct GateTally {
  std::int64_t missed = 0, missed_swept = 0, early = 0;  ///< shots
  double late = 0;                                       ///< [1] steps
  std::int64_t sweeps = 0, gated = 0;
  std::vector<double> milliseconds, swept_milliseconds;  ///< a step with the gate and without, one of each round

  static constexpr auto fields() {
    using T = GateTally;
    return record(kept("missed", &T::missed, "1", "Shots never told to have met their target."),
                  kept("early", &T::early, "1", "Shots that met it earlier than without the gate."),
                  kept("late", &T::late, "1", "Steps from the true meeting to the one told: mean over the shots told."),
                  kept("missed_without_gate", &T::missed_swept, "1", "Shots that are missed with no gate: none."),
                  kept("sweeps", &T::sweeps, "1", "Pairs asked without the gate, over all steps."),
                  kept("gated", &T::gated, "1", "Pairs that the gate did not sweep."),
                  kept("milliseconds", &T::milliseconds), kept("swept_milliseconds", &T::swept_milliseconds));
  }
};

/// A cell and what came of it.
struct GateRow {
  GateCell cell;
  GateTally tally;
};

/// [1] The chance that a shot is never seen.
double missed_by_gate(const GateCell& cell);

/// Each of `rounds` >= 1 steps the shots with and without the gate, one cell at a time.
GateTally shoot_at_gate(const GateCell& cell, std::int64_t rounds, std::uint64_t seed);

std::string gate_target_name(GateTarget target);

/// The shots against theory.
std::vector<SelfTest> gate_self_test(const std::vector<GateRow>& rows);

/// All of it: no shot is missed without the gate, none met early, and with it as many as theory says.
bool gate_is_right(const std::vector<GateRow>& rows);

}  // namespace thinwall
