#pragma once
/// Closest points on segments. A point of a segment is named by a parameter in [0, 1], which no rescaling changes; the
/// gap is then measured at the caller's own scale.

#include <algorithm>

#include <thinwall/discrete/entry/core_part.hpp>
#include <thinwall/discrete/numbers/double_word.hpp>
#include <thinwall/discrete/numbers/range.hpp>
#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

template <Scalar S> S clamp01(const S& x) { return std::min(S(1), std::max(S(0), x)); }

/// The s in [0, 1] for which s * d is closest to w; 0 where d is too short to tell.
template <Scalar S> S closest_parameter(const Vec3<S>& w, const Vec3<S>& d) {
  const S size = largest(w, d);
  if (const int e = safe_exponent(size); e != 0)
    return closest_parameter(times_power_of_two(w, -e), times_power_of_two(d, -e));
  const S length_square = d.squaredNorm();
  return length_square > S(0) ? clamp01(S(w.dot(d) / length_square)) : S(0);
}

template <Scalar S> struct SegmentPair {
  S s = 0;                        ///< [1] on the first segment, s * d1
  S t = 0;                        ///< [1] on the second segment, r + t * d2
  Vec3<S> gap = Vec3<S>::Zero();  ///< [length] from the first point to the second
};

/// Closest points of the segments s * d1 and r + t * d2.
/// Solves the 2x2 system with cross products, whose determinant |d1 x d2|^2 does not cancel, then projects the point on the
/// other segment, and back if an end was nearest there. Nearly parallel, the first point is poorly known, and its choice moves
/// the gap by no more than rounding does.
/// Error: the gap is off by a few u (|r| + |d1| + |d2|), however close to parallel the segments are.
/// Degenerate: segments of no length are points; of many closest pairs on parallel segments the middle one.
/// Source: Ericson, Real-Time Collision Detection, 2005, section 5.1.9, for the order of the clamps.
template <Scalar S> SegmentPair<S> closest_on_segments(const Vec3<S>& r, const Vec3<S>& d1, const Vec3<S>& d2) {
  const S size = largest(r, d1, d2);
  if (const int e = safe_exponent(size); e != 0) {
    SegmentPair<S> pair =
        closest_on_segments(times_power_of_two(r, -e), times_power_of_two(d1, -e), times_power_of_two(d2, -e));
    pair.gap = r + (d2 * pair.t - d1 * pair.s);
    return pair;
  }
  SegmentPair<S> pair;
  const Vec3<S> across = accurate_cross(d1, d2);  // a tilt counts by the square of 1 / their angle
  const S determinant = across.squaredNorm();
  if (determinant > S(0)) {
    pair.s = clamp01(S(cross(r, d2).dot(across) / determinant));
  } else {  // parallel: the middle of the stretch of d1 that lies beside d2
    const S first = closest_parameter<S>(r, d1);
    const S last = closest_parameter<S>(r + d2, d1);
    pair.s = (first + last) / 2;
  }
  pair.t = closest_parameter<S>(d1 * pair.s - r, d2);
  const bool at_end = pair.t <= S(0) || pair.t >= S(1);
  if (at_end)
    pair.s = closest_parameter<S>(r + d2 * pair.t, d1);  // else an end of d1 would no longer be one, to rounding
  pair.gap = r + (d2 * pair.t - d1 * pair.s);
  return pair;
}

/// Which part of a segment a parameter names: 0 its inside, 1 its start, 2 its end.
template <Scalar S> int segment_part(const S& s) { return s <= S(0) ? 1 : s >= S(1) ? 2 : 0; }

/// The part closest to x of the parallelogram { s * d1 - t * d2 }: the start of the second segment, seen from that of the
/// first, is at x; a corner or an edge of the parallelogram is where one or both segments end.
template <Scalar S> CorePart<S> closest_on_parallelogram(const Vec3<S>& x, const Vec3<S>& d1, const Vec3<S>& d2) {
  const SegmentPair<S> closest = closest_on_segments(x, d1, d2);
  const int first = segment_part(closest.s), second = segment_part(closest.t);
  CorePart<S> part;
  part.id = 3 * first + second;
  part.gap = closest.gap;
  part.origin = (first == 2 ? d1 : Vec3<S>::Zero()) - (second == 2 ? d2 : Vec3<S>::Zero());
  if (first == 0) part.direction = second == 0 ? accurate_cross(d1, d2) : d1;
  if (first != 0 && second == 0) part.direction = d2;
  part.kind = first == 0 && second == 0   ? CorePart<S>::face
              : first == 0 || second == 0 ? CorePart<S>::edge
                                          : CorePart<S>::corner;
  if (part.kind == CorePart<S>::face) {
    const Vec3<S> beside = cross(safe_unit(part.direction), part.gap);  // zero above the inside of the face
    if (part.direction == Vec3<S>::Zero() || largest(beside) > gap_noise(largest(x, d1, d2))) {
      part.kind = CorePart<S>::edge;  // parallel, to rounding: the parallelogram is a segment
      part.direction = d1;
    }
  }
  return part;
}

}  // namespace thinwall
