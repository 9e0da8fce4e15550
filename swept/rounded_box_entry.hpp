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
#include <thinwall/discrete/ball_entry.hpp>

namespace thinwall {

/// The times and places at which a moving point p + v t meets the slabs of the box [-h, h].
template <Scalar S> struct SlabTimes {
  Vec3<S> enter, leave;  ///< [1] of the box's own slabs; before `enter` and from `leave` on the axis takes part
  Vec3<S> near, far;     ///< [length] the face passed at `enter`, at `leave`
  S first = 0;           ///< [1] >= 0: when the point is in all slabs widened by R
  S last = std::numeric_limits<S>::infinity();  ///< [1] until when; before `first`: never
  int axis = -1;                                ///< the axis that decided `first`; -1 where `first` is the start

  SlabTimes(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& h, const S& R) {
    const S infinity = std::numeric_limits<S>::infinity();
    for (int i = 0; i < 3; ++i) {
      const bool upward = v[i] == S(0) ? p[i] < S(0) : v[i] > S(0);
      near[i] = upward ? S(-h[i]) : h[i];
      far[i] = -near[i];
      if (v[i] == S(0)) {
        const S outside = largest(p[i]) - h[i];
        enter[i] = outside > S(0) ? infinity : -infinity;
        leave[i] = infinity;
        if (outside > R) last = -S(1);
        continue;
      }
      enter[i] = (near[i] - p[i]) / v[i];
      leave[i] = (far[i] - p[i]) / v[i];
      const S widened = upward ? R : S(-R);
      const S widened_enter = ((near[i] - p[i]) - widened) / v[i];
      if (widened_enter > first) {
        first = widened_enter;
        axis = i;
      }
      last = std::min(last, S(((far[i] - p[i]) + widened) / v[i]));
    }
  }
};

/// First time at which p + v t is within R of the box [-h, h].
template <Scalar S> Entry<S> rounded_box_entry(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& h, const S& R) {
  Entry<S> entry;
  if (within(excess_of(p, h), R)) {
    entry.inside = true;
    return entry;
  }
  const S length = largest(p, h, R), speed = largest(v);
  if (speed == S(0)) return entry;
  const int length_exponent = products_in_range(length) ? 0 : binary_exponent(length);
  const int speed_exponent = products_in_range(speed) ? 0 : binary_exponent(speed);
  if (length_exponent != 0 || speed_exponent != 0) {
    entry = rounded_box_entry(times_power_of_two(p, -length_exponent), times_power_of_two(v, -speed_exponent),
                              times_power_of_two(h, -length_exponent), times_power_of_two(R, -length_exponent));
    entry.time = times_power_of_two(entry.time, length_exponent - speed_exponent);
    return entry;
  }
  const SlabTimes<S> slabs(p, v, h, R);
  if (!(slabs.first <= slabs.last)) return entry;
  S now = slabs.first;
  while (now <= slabs.last) {
    Vec3<S> q = Vec3<S>::Zero(), u = Vec3<S>::Zero();  // the axes outside their slabs, from the nearest corner
    S next = std::numeric_limits<S>::infinity();
    int outside = 0;
    for (int i = 0; i < 3; ++i) {
      if (now < slabs.enter[i] || now >= slabs.leave[i]) {
        const bool before = now < slabs.enter[i];
        q[i] = p[i] - (before ? slabs.near[i] : slabs.far[i]);
        u[i] = v[i];
        ++outside;
        if (before) next = std::min(next, slabs.enter[i]);
      } else {
        next = std::min(next, slabs.leave[i]);
      }
    }
    const bool on_face = outside == 1 && slabs.axis >= 0 && now == slabs.first && u[slabs.axis] != S(0);
    if (outside == 0 || on_face) {
      int axis = slabs.axis;
      if (outside == 0) slabs.enter.maxCoeff(&axis);
      entry.time = now;
      entry.normal = axis_vector<S>(axis, v[axis] > S(0));
      return entry;
    }
    if (u == Vec3<S>::Zero()) return entry;  // at constant distance until it grows
    const Chord<S> chord = chord_through_ball(q, u, R);
    ++entry.rounds;
    if (chord.exists && chord.approach > S(0)) {
      const S root = chord.entry_time();
      if (root <= next && chord.approach + chord.half >= now * chord.speed_square) {
        entry.time = std::max(root, now);
        entry.normal = chord.entry_normal(u, R);
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

}  // namespace thinwall
