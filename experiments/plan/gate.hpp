#pragma once
/// What the motion gate misses: balls shot at a thin wall and at a ball, each in a lane of its own, nobody stopped.
///
/// A ball of radius r moves s r a step. Where s <= gate its pair is looked at only at the starts of steps: at poses s r
/// apart, their phase as likely as any. It misses a contact that takes a way of c < s r with chance 1 - c / (s r). For a wall of
/// thickness w, c = w + 2 r. For a ball of radius r hit at an offset that is uniform over the disk of radius 2 r, the chord c =
/// 4 r u has density 2 u in u: the chance is l^2 / 3 for l = s / 4 <= 1, else 1 - 2 / (3 l). Where s > gate: 0.

#include <cstdint>
#include <string>
#include <vector>

namespace thinwall {

enum class GateTarget { wall, ball };

struct GateCell {
  GateTarget target = GateTarget::wall;
  double path = 1;         ///< [1] > 0: radii a step
  double gate = 0.5;       ///< [1] > 0
  std::int64_t shots = 1;  ///< >= 1
};

struct GateTally {
  std::int64_t missed = 0;                 ///< shots that never met their target; without the gate all do
  std::int64_t missed_swept = 0;           ///< the same without the gate
  std::int64_t early = 0;                  ///< shots that met it earlier than without the gate
  double late = 0;                         ///< [1] steps from the true meeting to the one told: mean over those told
  std::int64_t sweeps = 0;                 ///< pairs asked without the gate, over all steps
  std::int64_t gated = 0;                  ///< pairs that the gate did not sweep
  std::vector<double> milliseconds;        ///< a step with the gate, one of each round
  std::vector<double> swept_milliseconds;  ///< without it
};

inline constexpr double gate_wall = 0.1;  // [1] thickness of the wall in radii of the ball

/// [1] The chance that a shot is never seen.
double missed_by_gate(const GateCell& cell);

/// Each of `rounds` >= 1 steps the shots with and without the gate, one cell at a time.
GateTally shoot_at_gate(const GateCell& cell, std::int64_t rounds, std::uint64_t seed);

std::string gate_target_name(GateTarget target);

/// As the line that a run's journal keeps, and back. Throws std::runtime_error if it is not one.
std::string to_line(const GateTally& tally);
GateTally gate_tally_from_line(const std::string& line);

}  // namespace thinwall
