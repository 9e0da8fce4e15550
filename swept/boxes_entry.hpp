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

#include <thinwall/discrete/core_entry.hpp>
#include <thinwall/discrete/obb.hpp>

namespace thinwall {

/// Two boxes and the motion of B seen from A. Directions are kept in A's axes and, for the faces, in the world's.
template <Scalar S> struct MovingBoxPair {
  BoxPair<S> pair;
  Vec3<S> motion;                     ///< [length] in A's axes
  Vec3<S> between_on_b, motion_on_b;  ///< [length] along B's axes, from world vectors
  int axis_a = -1, axis_b = -1;       ///< the axes of contact, once found

  /// When the shadows on axis (i, j) overlap: narrows [first, last]; returns false if they never do.
  bool narrow(int i, int j, S& first, S& last) {
    const Vec3<S> n = pair.direction(i, j);
    const S distance = i < 0 ? between_on_b[j] : pair.between.dot(n);
    const S speed = i < 0 ? motion_on_b[j] : motion.dot(n);
    const S reach = pair.reach_a(n) + pair.reach_b(n);
    if (speed == S(0)) return largest(distance) <= reach;
    const S side = speed > S(0) ? S(1) : S(-1);
    const S enter = (-side * reach - distance) / speed;
    if (enter > first) {
      first = enter;
      axis_a = i;
      axis_b = j;
    }
    last = std::min(last, S((side * reach - distance) / speed));
    return first <= last;
  }
};

/// First time at which boxes of `moving`, apart at the start, touch; the normal in A's axes, from A to B.
template <Scalar S> Entry<S> sharp_boxes_entry(MovingBoxPair<S>& moving) {
  Entry<S> entry;
  S first = -std::numeric_limits<S>::infinity(), last = std::numeric_limits<S>::infinity();
  const bool meet = each_separating_axis([&](int i, int j) { return moving.narrow(i, j, first, last); });
  if (!meet || moving.axis_a + moving.axis_b == -2 || last < S(0)) return entry;
  entry.time = std::max(S(0), first);
  const Vec3<S> n = moving.pair.direction(moving.axis_a, moving.axis_b);
  entry.normal = safe_unit(moving.motion.dot(n) > S(0) ? Vec3<S>(-n) : n);
  return entry;
}

/// The same for boxes rounded by R > 0 in all.
template <Scalar S> Entry<S> rounded_boxes_entry(const MovingBoxPair<S>& moving, const S& R) {
  int count = 0;
  const auto support = [&](const Vec3<S>& x) {  // no two planes are taken for the same part
    BoxPair<S> there = moving.pair;
    there.between = x;
    const CoreGap<S> gap = box_gap(there);
    CorePart<S> plane{++count, CorePart<S>::face, x - gap.normal * gap.distance, gap.normal, gap.normal};
    if (gap.distance > S(0)) {
      plane.gap = gap.normal * gap.distance;
    } else {
      plane.depth = -gap.distance;
    }
    return plane;
  };
  return core_entry<S>(moving.pair.between, moving.motion, R, largest(moving.pair.half_a, moving.pair.half_b), support);
}

}  // namespace thinwall
