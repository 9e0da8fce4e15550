#pragma once
/// What geometry expects of a bound: how large it is, and how much of it is never touched. Derived in docs/swept_bounds.md;
/// shares no code with the library's bounds.

#include <optional>

#include <thinwall/experiments/swept_bounds/steiner.hpp>
#include <thinwall/experiments/swept_bounds/sweep.hpp>

namespace thinwall {

/// A bound as a body around the middle of the path, and the axes of a box that fits it well.
struct FittedBody {
  RoundedZonotope body;
  Mat3<double> axes;  ///< unit columns at right angles
};

FittedBody exact_body(const Sweep& s);             ///< what the shape truly sweeps: the sum of shape and path
FittedBody enclosing_sphere_body(const Sweep& s);  ///< the ball around the ball around the shape, at both ends
FittedBody enclosing_aabb_body(const Sweep& s);    ///< the box along x, y, z around both ends
FittedBody capsule_body(const Sweep& s);           ///< what the ball around the shape sweeps
FittedBody oriented_box_body(const Sweep& s);      ///< the least box with an axis along the motion; of box shapes
FittedBody box_around(const FittedBody& exact, const Mat3<double>& axes);  ///< the least with these axes

/// A box that balls are drawn from.
struct BallRegion {
  Vec3<double> middle;        ///< [m]
  Mat3<double> axes;          ///< unit columns
  Vec3<double> half_extents;  ///< [m]
};
double volume(const BallRegion& region);  ///< [m^3]

/// Around all centers at which a ball overlaps the bound, and a tenth more: a bound that is too wide would show.
BallRegion region_around(const FittedBody& bound, const Sweep& s);

/// Of balls drawn from the region around a bound.
struct SweepTheory {
  double touching;    ///< [1] share that the shape touches
  double false_hits;  ///< [1] share that the bound reports and the shape does not touch; exactly 0 for an exact bound
  double false_fraction;  ///< [1] of those reported, the share that is false
  double empty;           ///< [1] share of the bound's volume that is not swept: the false fraction of points

  double reported() const { return touching + false_hits; }
};
SweepTheory sweep_theory(const FittedBody& bound, const Sweep& s);

/// [widths] The path from which the oriented box makes fewer false hits than the box along x, y, z, if there is one: its
/// speed left aside, the cell is kept. Shorter paths do not pay for turning the box into the motion.
std::optional<double> path_to_turn_for(const Sweep& s);

}  // namespace thinwall
