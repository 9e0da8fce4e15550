#pragma once
/// What geometry expects of a bound: how large it is, and how much of it is never touched. Derived in docs/swept_bounds.md;
/// shares no code with the library's bounds.

#include <optional>
#include <vector>

#include <thinwall/experiments/swept_bounds/model.hpp>

namespace thinwall {

/// Segments added up, each point of one moved by each point of the next, then every point within `radius` of that.
/// No segment is a ball, one a capsule, three at right angles a rounded box.
struct RoundedZonotope {
  std::vector<Vec3<double>> segments;  ///< [length] from end to end
  double radius = 0;                   ///< [length] >= 0
};

/// The three numbers of a convex body that the volumes of all bodies around it follow from.
struct SteinerNumbers {
  double volume;          ///< [length^3]
  double area;            ///< [length^2] of the surface
  double mean_curvature;  ///< [length] integral of the mean curvature over the surface
};
SteinerNumbers steiner_numbers(const std::vector<Vec3<double>>& segments);  ///< of the zonotope, not rounded

/// [length^3] V + S r + M r^2 + 4 pi r^3 / 3, Steiner's formula.
double volume(const RoundedZonotope& body);

/// The sum with a ball: all points within `by` of the body.
RoundedZonotope grown(RoundedZonotope body, double by);

/// [length] Half of the body's extent along a unit vector.
double half_width(const RoundedZonotope& body, const Vec3<double>& along);

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

double volume(const BallRegion& region);  ///< [m^3]

/// Around all centers at which a ball's box overlaps the bound's, `room` times as wide: with a tenth more a bound that is too wide shows.
BallRegion region_around(const FittedBody& bound, const Sweep& s, double room = 1.1);

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
