#pragma once
/// A shot in an engine: a world of its own, so many steps, and what became of the ball.

#include <cstdint>
#include <vector>

#include <thinwall/experiments/engines/shots.hpp>
#include <thinwall/experiments/engines/tally.hpp>

namespace thinwall {

/// Adds the shot to the tally. `flight` is where the ball was at the end of each step.
void judge(const EngineShot& shot, const std::vector<BallState>& flight, EngineTally& tally);

/// Shots `first`, `first + 1`, ... of a cell.
struct EngineVolley {
  std::int64_t first = 0;
  std::int64_t shots = 0;
};

/// Long enough to be timed, short enough to be lost, and several make an interval.
inline constexpr std::int64_t most_shots_an_engine_volley = 1000;

std::vector<EngineVolley> engine_volleys(std::int64_t shots);

EngineTally fire(const EngineCell& cell, const EngineMode& mode, const EngineVolley& volley, std::uint64_t seed);

}  // namespace thinwall
