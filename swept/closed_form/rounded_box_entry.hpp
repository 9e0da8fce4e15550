#pragma once
/// When a moving point first enters a box rounded by a radius: the Minkowski sum of a box and a ball.
///
/// On each axis the point is before, beside or after the box's slab, and changes between these at most twice. While no
/// axis changes, its squared distance to the box is one quadratic, that of a ball around the nearest corner with only
/// the axes outside their slabs taking part; ball_entry.hpp solves it without cancellation. The walk starts where the
/// point enters the slabs widened by R (it cannot touch earlier) and goes from change to change; the distance is convex
/// along the motion, so the first minimum without contact ends it. At most seven rounds, usually one.
///
/// Which axes take part is read off the times of change alone, never off a rounded position, so that no region is
/// skipped or visited twice.
///
/// Error: forward at most 4 u kappa t, backward at most 4 u (docs/closed_forms.md).
/// Degenerate: R = 0 is the box itself; extents of 0 make a plate, a rod or a point.
/// Source: the slabs are Ericson, Real-Time Collision Detection, 2005, sections 5.3.3 and 5.5.7; the walk is derived in
/// docs/closed_forms.md.

#include <algorithm>
#include <limits>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/entry/ball_entry.hpp>

namespace thinwall {

/// The times and places at which a moving point p + v t meets the slabs of the box [-h, h].
template <Scalar S> struct SlabTimes {
  Vec3<S> enter, leave;  ///< [1] of the box's own slabs; before `enter` and from `leave` on the axis takes part
  Vec3<S> near;          ///< [length] the face passed at `enter`; that passed at `leave` is opposite
  S first = 0;           ///< [1] >= 0: when the point is in all slabs widened by R
  S last = std::numeric_limits<S>::infinity();  ///< [1] until when; before `first`: never
  int axis = -1;                                ///< the axis that decided `first`; -1 where `first` is the start
  bool close = false;                           ///< `first` and `last` are equal to rounding

  SlabTimes(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& h, const S& R) {
    using std::copysign;
    const S infinity = std::numeric_limits<S>::infinity();
    Vec3<S> widened_enter;
    for (int i = 0; i < 3; ++i) {
      if (v[i] == S(0)) {
        const S outside = largest(p[i]) - h[i];
        near[i] = p[i] < S(0) ? S(-h[i]) : h[i];
        enter[i] = outside > S(0) ? infinity : -infinity;
        leave[i] = infinity;
        widened_enter[i] = -infinity;
        if (outside > R) last = -S(1);
        continue;
      }
      near[i] = -copysign(h[i], v[i]);
      const S widened = copysign(R, v[i]), to_near = near[i] - p[i], to_far = -near[i] - p[i];
      enter[i] = to_near / v[i];
      leave[i] = to_far / v[i];
      widened_enter[i] = (to_near - widened) / v[i];
      last = std::min(last, S((to_far + widened) / v[i]));
    }
    const S before_last = std::max(widened_enter[0], widened_enter[1]);
    axis = widened_enter[2] > before_last ? 2 : widened_enter[1] > widened_enter[0] ? 1 : 0;
    first = std::max(before_last, widened_enter[2]);
    axis = first > S(0) ? axis : -1;
    first = std::max(S(0), first);
    const S noise = 8 * std::numeric_limits<S>::epsilon() * std::max(first, largest(last));
    close = !(largest(S(last - first)) > noise);
  }

  /// A face of axis i is met: not before the point is in the other slabs, nor after it leaves one.
  void meet(Entry<S>& entry, int i) const {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    entry.not_before = std::max(enter[j], enter[k]);
    entry.not_after = std::min(leave[j], leave[k]);
  }
};

/// The walk from region to region, after the slabs have shown no miss.
template <Scalar S>
Entry<S> walk_around_box(const SlabTimes<S>& slabs, const Vec3<S>& p, const Vec3<S>& v, const S& R) {
  Entry<S> entry;
  entry.graze = slabs.close;
  const S noise = gap_noise(largest(p, slabs.near, R));
  S now = slabs.first;
  while (now <= slabs.last) {
    Vec3<S> q = Vec3<S>::Zero(), u = Vec3<S>::Zero();  // the axes outside their slabs, from the nearest corner
    S next = std::numeric_limits<S>::infinity();
    int outside = 0;
    for (int i = 0; i < 3; ++i) {
      if (now < slabs.enter[i] || now >= slabs.leave[i]) {
        const bool before = now < slabs.enter[i];
        q[i] = before ? S(p[i] - slabs.near[i]) : S(p[i] + slabs.near[i]);
        u[i] = v[i];
        ++outside;
        if (before) next = std::min(next, slabs.enter[i]);
      } else {
        next = std::min(next, slabs.leave[i]);
      }
    }
    if (outside == 0) {
      int axis = 0;
      slabs.enter.maxCoeff(&axis);
      entry.time = now;
      slabs.meet(entry, axis);
      entry.normal = axis_vector<S>(axis, v[axis] > S(0));
      return entry;
    }
    if (u == Vec3<S>::Zero()) return entry;  // at constant distance until it grows
    const Chord<S> chord = chord_through_ball(q, u, R);
    ++entry.rounds;
    entry.graze = entry.graze || chord.half * chord.half <= 4 * noise * R * chord.speed_square;
    if (chord.exists && chord.approach > S(0)) {
      const S root = chord.entry_time();
      if (root <= next && chord.approach + chord.half >= now * chord.speed_square) {
        entry.time = std::max(root, now);
        entry.normal = chord.entry_normal(u);
        return entry;
      }
    }
    S slope = 0;  // of half the squared distance at `next`; the axis that changes there takes no part
    for (int i = 0; i < 3; ++i) {
      if (u[i] != S(0) && slabs.enter[i] != next) slope += (q[i] + u[i] * next) * u[i];
    }
    if (slope >= S(0)) return entry;  // the closest approach was too far
    now = next;
  }
  return entry;
}

/// Requires lengths and displacements whose products of four are in range.
template <Scalar S>
Entry<S> rounded_box_entry_in_range(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Vec3<S>& h) {
  Entry<S> entry;
  entry.inside = within(excess_of(p, h), R);
  if (entry.inside || v == Vec3<S>::Zero()) return entry;
  const SlabTimes<S> slabs(p, v, h, R);
  entry.graze = slabs.close;
  if (!(slabs.first <= slabs.last)) return entry;
  bool on_face = slabs.axis >= 0;  // beside the face, not beyond its edges; a point that comes to an edge is on it
  for (int i = 0; i < 3; ++i) {
    const bool is_beside = slabs.first >= slabs.enter[i] && (slabs.first < slabs.leave[i] || R == S(0));
    on_face = on_face && (i == slabs.axis || is_beside);
  }
  if (!on_face) return walk_around_box(slabs, p, v, R);
  entry.time = slabs.first;
  entry.graze = entry.graze || is_last_in_doubt(slabs.enter, slabs.leave, slabs.axis, slabs.first);
  slabs.meet(entry, slabs.axis);
  entry.normal = axis_vector<S>(slabs.axis, v[slabs.axis] > S(0));
  return entry;
}

/// First time at which p + v t is within R of the box [-h, h].
template <Scalar S> Entry<S> rounded_box_entry(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& h, const S& R) {
  return entry_at_safe_scale<S>(&rounded_box_entry_in_range<S>, p, v, R, h);
}

}  // namespace thinwall
