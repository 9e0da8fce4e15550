#pragma once
/// What a convex core shows of itself to a point outside: the corner, edge or face that is nearest.

#include <thinwall/discrete/numbers/range.hpp>
#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// Unit, along what of a gap is across an edge, of any length: along that it is turned by roundings where it is short beside it.
template <Scalar S> Vec3<S> unit_across(const Vec3<S>& gap, const Vec3<S>& edge) {
  const Vec3<S> across = cross<S>(edge, safe_unit(cross(gap, edge)));
  return safe_unit(across == Vec3<S>::Zero() ? gap : across);
}

/// A flat part of a convex core, as seen from a point outside.
template <Scalar S> struct CorePart {
  enum Kind { corner, edge, face };
  int id = 0;                           ///< equal for equal parts of one core
  Kind kind = corner;                   ///< what the part extends to: a point, a line, a plane
  Vec3<S> origin = Vec3<S>::Zero();     ///< [length] a point of it
  Vec3<S> direction = Vec3<S>::Zero();  ///< along the edge, or normal to the face; of any length but zero
  Vec3<S> gap = Vec3<S>::Zero();        ///< [length] from the core's closest point to the point that asked
  S depth = -1;  ///< [length] >= 0: the point is in the core, this deep, and `gap` is a unit vector out of it

  bool contains_point() const { return depth >= S(0); }
  S distance() const { return contains_point() ? S(-depth) : safe_norm(gap); }
  /// Unit, from the part to the point that asked. A gap that is short beside the core is turned by rounding, so that even
  /// the sign of a closing speed would be lost; a face or an edge knows better which way it faces.
  Vec3<S> outward() const {
    if (contains_point() || kind == corner) return safe_unit(gap);
    if (kind == face) return safe_unit(gap.dot(direction) < S(0) ? Vec3<S>(-direction) : direction);
    return unit_across(gap, direction);
  }
  S closing_speed(const Vec3<S>& v) const { return -outward().dot(v); }
};

}  // namespace thinwall
