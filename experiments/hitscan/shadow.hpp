#pragma once
/// Which places of a ball a path meets: plane geometry for hitscan's theory. Derived in docs/hitscan.md.

#include <vector>

#include <thinwall/experiments/statistics.hpp>

namespace thinwall {

/// A straight bit of path in the plane of the arc, x0 < x1.
struct PathPiece {
  double x0, s0, x1, s1;  ///< [m]
};

/// A set of places on a line: ascending, apart.
using Places = std::vector<Interval>;

/// The places `p` for which some point of the pieces has (x - range)^2 + (s - p)^2 <= radius^2.
Places shadow(const std::vector<PathPiece>& pieces, double range, double radius);

double length(const Places& places);
Places common(const Places& a, const Places& b);

/// [m^2] What two discs, their centers `apart`, have in common.
double lens_area(double radius_a, double radius_b, double apart);

}  // namespace thinwall
