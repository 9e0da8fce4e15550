#pragma once
/// Volumes of convex bodies that are segments added up and rounded: a ball, a capsule, a box, a box swept along a segment.
/// Derived in docs/swept_bounds.md.

#include <vector>

#include <thinwall/discrete/scalar.hpp>

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

}  // namespace thinwall
