#pragma once
/// Worlds of moving balls at constant density.

#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall {

/// What a world is like. Its balls do not depend on how they are looked at.
struct CrowdFactors {
  bool clustered = false;  ///< in heaps of 100 on average, each as dense as ten times the whole
  double speed = 1;        ///< [m] the path of a step, in any direction
  double density = 0.1;    ///< [1 / m^3]
  std::int64_t count = 0;  ///< [1]
};

using Crowd = std::vector<Moving<Sphere<double>>>;

inline constexpr double crowd_radius = 0.5;  // [m]

/// Balls in a cube of the volume that the density asks for, in no order of place.
Crowd make_crowd(const CrowdFactors& factors, std::uint64_t seed);

/// The same balls one step later.
Crowd next_step(const Crowd& crowd);

/// The boxes that hold them during the step.
std::vector<Proxy> proxies_of(const Crowd& crowd);

/// How many of the pairs of boxes are of balls that meet during the step.
std::int64_t count_meetings(const Crowd& crowd, const std::vector<ProxyPair>& pairs);

/// "uniform" or "clustered".
std::string placement_name(const CrowdFactors& factors);

}  // namespace thinwall
