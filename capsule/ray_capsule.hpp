#pragma once
/// When a moving point first enters a segment rounded by a radius: the side of the cylinder, or the nearer cap.
///
/// Seen along the axis d, the infinite cylinder is a disc and the motion stays a line: with k = p x d and w = v x d, both
/// perpendicular to d, the point is on the cylinder when |k + w t| = R |d|, which is ball_entry.hpp's own question. No axis
/// is normalized, so none is turned by rounding. If the point enters beside the segment, that is the answer; if it enters
/// beyond an end, only that end's ball can be hit, because the end's flat disc lies inside that ball.
///
/// Degenerate: a segment of no length is a ball; motion parallel to the axis meets a cap.
/// Source: derived here.

#include <thinwall/capsule/segment.hpp>
#include <thinwall/discrete/entry/ball_entry.hpp>

namespace thinwall {

/// Requires lengths and displacements whose products of four are in range.
template <Scalar S>
Entry<S> rounded_segment_entry_in_range(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Vec3<S>& d) {
  using std::sqrt;
  Entry<S> entry;
  entry.inside = within<S>(p - d * closest_parameter(p, d), R);
  if (entry.inside || v == Vec3<S>::Zero()) return entry;
  const int e = binary_exponent(largest(d));
  const Vec3<S> axis = times_power_of_two(d, -e);  // about 1 long: of products with it four are in range too
  const S axis_square = axis.squaredNorm(),
          end = times_power_of_two(axis_square, e);  // x.axis at the end of the segment
  const S along = p.dot(axis), length = sqrt(axis_square);
  bool far_end = along > end / 2;  // the cap to try: the nearer, or the one beyond which the side is met
  if (length > S(0)) {
    const Entry<S> side = ball_entry<S>(cross(p, axis), accurate_cross<S>(v, axis), R * length, [&] {
      return accurate_edge_discriminant(p, v, axis, R) * (axis_square * axis_square);
    });
    if (side.inside && along >= S(0) && along <= end) {  // touching, but for the rounding of the test above
      entry.inside = true;
      return entry;
    }
    if (!side.inside) {
      if (!is_finite(side.time)) return entry;
      const S at = along + v.dot(axis) * side.time;
      if (at >= S(0) && at <= end) {
        entry.time = side.time;
        entry.normal = safe_unit(cross(axis, side.normal));
        return entry;
      }
      far_end = at > S(0);
    }
  }
  const Entry<S> cap = ball_entry<S>(far_end ? Vec3<S>(p - d) : p, v, R);
  if (is_finite(cap.time)) return cap;
  // Met and left beyond the end, or, but for a rounding, beside it: they are one where it crosses the end's plane.
  const S at_end = ((far_end ? end : S(0)) - along) / v.dot(axis);
  entry.graze = within<S>(cross<S>(p + v * at_end, axis), (R + near_miss(largest(p, d, R))) * length);
  return entry;
}

/// First time at which p + v t is within R of the segment s * d, s in [0, 1].
template <Scalar S> Entry<S> rounded_segment_entry(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& d, const S& R) {
  return entry_at_safe_scale<S>(&rounded_segment_entry_in_range<S>, p, v, R, d);
}

}  // namespace thinwall
