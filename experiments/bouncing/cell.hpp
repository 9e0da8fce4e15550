#pragma once
/// One physical condition: a ball is dropped from a height onto a floor.

#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/experiments/bouncing/world.hpp>
#include <thinwall/experiments/random.hpp>
#include <thinwall/experiments/settings.hpp>

namespace thinwall {

struct BounceCell {
  double gravity;      ///< [m/s^2] > 0
  double height;       ///< [m] > 0, of the gap that it is dropped from
  double radius;       ///< [m] > 0
  double step;         ///< [s] > 0
  double restitution;  ///< [1] in [0, 1]

  bool operator==(const BounceCell&) const = default;
};

std::string key(const BounceCell& c);  ///< one line, for people and the journal

double impact_speed(const BounceCell& c);  ///< [m/s] V, of the true flight
double fall_time(const BounceCell& c);     ///< [s] V / g
double delta(const BounceCell& c);         ///< [1] g h / V: speed that gravity adds in a step, over the impact's
/// The floor is deeper than what a ball falls in a step after `bounces` of which each adds a whole g h to its speed, so that
/// a test of the pose at the end of a step sees it.
BouncingWorld world_of(const BounceCell& c, std::int64_t bounces = 1);
/// [g h / V] More than what rounding does to the energy of a flight of this many steps.
double rounding_of(const BounceCell& c);
RandomStream random_stream(const BounceCell& c, std::uint64_t seed);  ///< from the physical factors alone

/// Every combination of step and restitution, steps from coarse to fine. Throws UsageError.
std::vector<BounceCell> make_bounce_cells(const Settings& settings);

}  // namespace thinwall
