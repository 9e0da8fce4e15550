#pragma once
/// The shots of a cell: where the target stands, when the gun goes off, and whether and when the bullet truly touches.
/// No rule is in here.

#include <cstdint>

#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/hitscan/cell.hpp>

namespace thinwall {

struct Placement {
  Sphere<double> target;
  double phase;  ///< [1] in [0, 1): how far into a frame's step the gun goes off
};

/// The target's center is uniform over the two discs together, in the plane across the line of fire at the range.
Placement random_placement(const HitscanCell& c, const RandomStream& stream, std::uint64_t trial);

/// The arc against the ball, in long double, as a function of the distance flown. Shares no code with any rule.
struct TrueImpact {
  bool touches;
  double time = 0;                             ///< [s] of first contact, from the muzzle, if they touch
  Vec3<double> bullet = Vec3<double>::Zero();  ///< [m] the bullet's center then
};
TrueImpact true_impact(const HitscanCell& c, const Vec3<double>& target_center);

/// [m] Where on the target the bullet touches it.
Vec3<double> contact_point(const HitscanCell& c, const TrueImpact& truth, const Vec3<double>& target_center);

}  // namespace thinwall
