#pragma once
/// When two oriented boxes first touch. Along every separating axis the shadows overlap during one interval of time; the
/// boxes touch when all fifteen do. This is exact for boxes that do not turn: the fifteen axes are the face normals of their
/// Minkowski sum.
///
/// With a rounding (a minimal separation) the sum has round edges and corners, and the walk of core_entry.hpp steps from
/// one supporting plane to the next instead.
///
/// Error: backward a few u of the coordinates and sizes involved.
/// Source: Ericson, Real-Time Collision Detection, 2005, section 5.5.8, for moving boxes; derived here.

#include <thinwall/discrete/obb.hpp>
#include <thinwall/swept/closed_form/core_entry.hpp>
#include <thinwall/swept/closed_form/shared_time.hpp>

namespace thinwall {

/// Two boxes and the motion of B seen from A. Directions are kept in A's axes and, for the faces, in the world's.
template <Scalar S> struct MovingBoxPair {
  BoxPair<S> pair;
  Vec3<S> motion;                     ///< [length] in A's axes
  Vec3<S> between_on_b, motion_on_b;  ///< [length] along B's axes, from world vectors
  int axis_a = -1, axis_b = -1;       ///< the axes of contact, once found

  /// The middle of the points where they touch at entry, or come within `gap` of each other, in A's axes and relative to
  /// its center. Zero if they never do.
  Vec3<S> touching_point(const Entry<S>& entry) const {
    if (entry.inside || entry.gave_up || !entry.may_hit()) return Vec3<S>::Zero();
    BoxPair<S> there = pair;
    there.between += motion * entry.time;
    const bool has_axis = axis_a >= 0 || axis_b >= 0;
    const BoxPoints<S> points = has_axis ? deepest_points(there, axis_a, axis_b, entry.normal) : closest_points(there);
    return (points.on_a + points.on_b) / S(2);
  }
};

/// First time at which boxes of `moving`, apart at the start, touch; the normal in A's axes, from A to B.
template <Scalar S> Entry<S> sharp_boxes_entry(MovingBoxPair<S>& moving) {
  const BoxPair<S>& pair = moving.pair;
  Entry<S> entry;
  SharedTime<S> shared(pair.between.cwiseAbs().sum() + pair.half_a.sum() + pair.half_b.sum());
  const Mat3<S> size = pair.axes.cwiseAbs();
  const Vec3<S> reach_of_b = size * pair.half_b, reach_of_a = size.transpose() * pair.half_a;
  for (int i = 0; i < 3; ++i) shared.narrow(i, pair.between[i], moving.motion[i], pair.half_a[i] + reach_of_b[i]);
  for (int j = 0; j < 3; ++j) {
    shared.narrow(3 + j, moving.between_on_b[j], moving.motion_on_b[j], pair.half_b[j] + reach_of_a[j]);
  }
  if (!shared.ever()) return entry;  // most misses
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const EdgeAxis<S> axis(pair, i, j);
      shared.narrow(6 + 3 * i + j, axis.along(pair.between), axis.along(moving.motion), axis.reach(pair),
                    largest(axis.on_u) + largest(axis.on_v));
    }
  }
  entry.graze = shared.close();
  if (!shared.ever() || shared.decided_by < 0) return entry;
  if (shared.first < S(0)) {  // apart at the start by rounding alone: which shadows came last then says nothing
    entry.time = S(0);
    entry.not_after = shared.last;
    entry.normal = box_gap(pair).normal;
    return entry;
  }
  moving.axis_a = shared.decided_by < 3 ? shared.decided_by : shared.decided_by < 6 ? -1 : (shared.decided_by - 6) / 3;
  moving.axis_b = shared.decided_by < 3 ? -1 : shared.decided_by % 3;
  entry.time = shared.time();
  entry.not_before = shared.second;
  entry.not_after = shared.last;
  const Vec3<S> n = pair.direction(moving.axis_a, moving.axis_b);
  entry.normal = safe_unit(moving.motion.dot(n) > S(0) ? Vec3<S>(-n) : n);
  return entry;
}

/// The same for boxes rounded by R > 0 in all, at any scale.
template <Scalar S> Entry<S> rounded_boxes_entry(const MovingBoxPair<S>& moving, const S& R) {
  int count = 0;
  const auto support = [&](const Vec3<S>& x, const Vec3<S>& half_a, const Vec3<S>& half_b) {
    const CoreGap<S> gap = parting_gap(BoxPair<S>{half_a, half_b, x, moving.pair.axes});
    // No two planes are taken for the same part.
    CorePart<S> plane{++count, CorePart<S>::face, x - gap.normal * gap.distance, gap.normal, gap.normal};
    if (gap.distance > S(0)) {
      plane.gap = gap.normal * gap.distance;
    } else {
      plane.depth = -gap.distance;
    }
    return plane;
  };
  const BoxPair<S>& pair = moving.pair;
  return core_entry_at_any_scale(support, pair.between, moving.motion, R, pair.half_a, pair.half_b);
}

}  // namespace thinwall
