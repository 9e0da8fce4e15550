#pragma once
/// When a moving point first enters a segment rounded by a radius: the side of the cylinder, or the nearer cap.
///
/// Seen along the unit axis u, the infinite cylinder is a disc and the motion stays a line: with k = p x u and
/// w = v x u, both perpendicular to u, the point is on the cylinder when |k + w t| = R, which is ball_entry.hpp's own
/// question. If it enters beside the segment, that is the answer; if it enters beyond an end, only that end's ball can
/// be hit, because the end's flat disc lies inside that ball.
///
/// Degenerate: a segment of no length is a ball; motion parallel to the axis meets a cap.
/// Source: derived here.

#include <thinwall/capsule/segment.hpp>
#include <thinwall/discrete/ball_entry.hpp>

namespace thinwall {

/// First time at which p + v t is within R of the segment s * d, s in [0, 1].
template <Scalar S> Entry<S> rounded_segment_entry(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& d, const S& R) {
  Entry<S> entry;
  if (within<S>(p - d * closest_parameter(p, d), R)) {
    entry.inside = true;
    return entry;
  }
  const auto cap = [&](bool far_end) {
    const Entry<S> ball = ball_entry<S>(far_end ? Vec3<S>(p - d) : p, v, R);
    return ball.inside ? entry : ball;
  };
  const S length = safe_norm(d);
  if (length == S(0)) return cap(false);
  const Vec3<S> u = safe_unit(d);
  const Vec3<S> k = cross(p, u);
  const Entry<S> side = ball_entry<S>(k, cross(v, u), R);
  const S along = p.dot(u);
  if (side.inside && along >= S(0) && along <= length) {  // touching, but for the rounding of the test above
    entry.inside = true;
    return entry;
  }
  if (side.inside) return cap(along > length / 2);
  if (!is_finite(side.time)) return entry;
  const S at = along + v.dot(u) * side.time;
  if (at < S(0) || at > length) return cap(at > length);
  entry.time = side.time;
  entry.normal = safe_unit(cross(u, side.normal));
  return entry;
}

}  // namespace thinwall
