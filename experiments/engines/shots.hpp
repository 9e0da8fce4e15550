#pragma once
/// The shots of a cell: thin_wall's, each at an angle of its own. No engine is in here.

#include <cstdint>
#include <string>

#include <thinwall/experiments/engines/engine.hpp>
#include <thinwall/experiments/random.hpp>

namespace thinwall {

/// One physical condition. The same shots are fired in every mode of every engine.
struct EngineCell {
  double path;       ///< [m] > 0, of the ball in a step
  double step;       ///< [s] > 0
  double radius;     ///< [m] > 0
  double thickness;  ///< [m] > 0
  double wall_size;  ///< [m] side of the wall, a square: wide enough that no ball gets round it
  double angle_deg;  ///< [deg] in [0, 89.9]: the angle of incidence is uniform between 0 and this
  int steps;         ///< >= 4 that a shot is followed for; the ball touches in the first two

  bool operator==(const EngineCell&) const = default;
};

std::string key(const EngineCell& cell);  ///< one line, for people and the journal

/// A ball before the wall, and when it first touches.
struct EngineShot {
  EngineScene scene;
  BallState start;
  double contact;  ///< [steps] from the start to first contact, in (0, 2): the oracle's answer
};
EngineShot engine_shot(const EngineCell& cell, const RandomStream& stream, std::uint64_t trial);

/// From what decides a shot: its motion, and how thick ball and wall are. A wall of another width gets the same shots.
RandomStream random_stream(const EngineCell& cell, std::uint64_t seed);

/// [m] The least that `wall_size` may be.
double least_wall_size(const EngineCell& cell);

}  // namespace thinwall
