#pragma once
/// Conservative advancement for shapes that turn: attach a plane, ride it for as long as it parts them, look again.

#include <algorithm>
#include <limits>
#include <type_traits>

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/methods/conservative_advancement.hpp>
#include <thinwall/swept/turning/choose_plane.hpp>

namespace thinwall {

/// Until when a plane across n that stands still parts the balls and discs that two shapes turn within. It has no curvature, and is
/// what proves anything about many turns a step.
template <Scalar S> S orbits_apart_until(const TurningPair<S>& pair, const TurningInstant<S>& now, const Vec3<S>& n) {
  S gap = n.dot(now.between) - pair.reach - pair.margin;
  for (const TurningBody<S>* body : {&pair.a, &pair.b}) {
    if (body->angle == S(0)) {
      gap -= core_reach<S>(body->core, body == &pair.a ? n : Vec3<S>(-n));
    } else {
      const S along = largest(S(n.dot(body->axis))), on_axis = core_reach(body->core, body->axis);
      gap -= along * std::max(on_axis, core_reach<S>(body->core, -body->axis)) + across(body->axis, n) * body->off_axis;
    }
  }
  const S opening = n.dot(pair.path) - pair.margin;
  if (!(gap > S(0))) return now.time;
  if (opening >= S(0)) return std::numeric_limits<S>::infinity();
  return now.time + gap / -opening * (S(1) - S(4) * std::numeric_limits<S>::epsilon());
}

/// True if the gap across the plane is growing.
template <Scalar S>
bool opens(const TurningPair<S>& pair, const AttachedPlane<S>& plane, const TurningInstant<S>& now) {
  return first_root(gap_ahead(pair, plane, now, S(0)).bound, S(0)).slope > S(0);
}

/// Rides the plane until it no longer parts the shapes, a step of it gains a tenth of the way only, the gap is less than `enough`, or the
/// step is over: nothing touches from `now` until then, if nothing does now.
template <Scalar S>
TurningInstant<S> ride(const TurningPair<S>& pair, const AttachedPlane<S>& plane, TurningInstant<S> now,
                       const S& enough) {
  const S start = now.time, of_centers = curvature_of_centers(pair, plane, now);
  for (int step = 0; step < 16; ++step) {
    const S left = pair.last - now.time;
    const GapAhead<S> ahead = gap_ahead(pair, plane, now, of_centers);
    const FirstRoot<S> root = first_root(ahead.bound, left);
    if (!(root.tau > S(0))) break;
    if (root.tau >= left) {
      now.time = S(1);  // and free ever after
      break;
    }
    const S next = now.time + root.tau * (S(1) - S(4) * std::numeric_limits<S>::epsilon());
    if (!(next > now.time)) break;
    now = instant(pair, next);
    if (root.tau < (next - start) / S(10) || root.value < enough * ahead.scale) break;
  }
  return now;
}

/// Claims: never late, never misses, rounding included (docs/turning.md), whatever the angles.
/// Error: early by at most what it takes to close a gap of `tolerance` times the speed bound |path| + sum of angle times the farthest
/// point's distance from the axis; a miss nearer than that may be a hit, and so may one that is hidden: by rounding, of
/// shapes without a radius half the digits of their size; and by a box's axes, as far as they are from orthonormal.
/// Degenerate: no motion is `apart`, or `overlapping`, to the roundings of a test at rest; very many turns are `gave_up`, or a hit that
/// rounding hides; a rotation whose length is out of range may be `gave_up`.
/// Source: derived in docs/turning.md; the idea of advancement is Mirtich's, 1996.
template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const ConservativeAdvancement<S>& method, const Turning<A>& a, const Turning<B>& b) {
  using T = typename A::Scalar;
  if (!is_tolerance<T>(method.tolerance) || method.max_evaluations < 1) return invalid_toi<T>();
  const TurningPair<T> pair(a, b, T(method.min_separation));
  const T near = std::max(T(T(method.tolerance) * pair.speed), T(T(4) * pair.margin));
  const bool spins_often = pair.turn > T(3);  // [rad] from here on whole orbits are worth a look
  if (pair.first > pair.last) return {ToiStatus::apart, 1};
  TurningInstant<T> now = instant(pair, pair.first);
  const auto past_orbits = [&](const TurningInstant<T>& next, const Vec3<T>& normal) {
    if (next.time >= T(1)) return next;
    T until = orbits_apart_until(pair, now, normal);
    for (const Vec3<T>& axis : {pair.a.axis, pair.b.axis})  // the disc of what turns about it is flat
      until = std::max(until, orbits_apart_until<T>(pair, now, normal.dot(axis) < T(0) ? Vec3<T>(-axis) : axis));
    return until > next.time ? instant(pair, until >= pair.last ? T(1) : until) : next;  // and free ever after
  };
  for (int k = 1; k <= method.max_evaluations; ++k) {
    const A a_now = pose_of(a.shape, pair.a, now.phase_a, now.core_a, Vec3<T>(pair.a.center + pair.a.path * now.time));
    const B b_now = pose_of(b.shape, pair.b, now.phase_b, now.core_b, Vec3<T>(pair.b.center + pair.b.path * now.time));
    if constexpr (std::is_same_v<A, Obb<T>> && std::is_same_v<B, Obb<T>>) {
      const LeastOverlap<T> axis = least_overlap(box_pair(a_now, b_now));
      if (-axis.overlap - T(method.min_separation) > near) {
        const AttachedPlane<T> plane = plane_across(pair, now, a_now, b_now, axis);
        TurningInstant<T> next = ride(pair, plane, now, T(near / T(4)));
        if (spins_often) next = past_orbits(next, normal_out_of(a_now, axis.normal));
        if (next.time >= T(1)) return {ToiStatus::apart, k};
        if (next.time > now.time) {
          now = next;
          continue;
        }
      }
    }
    const Separation<T> closest = separation_unchecked(a_now, b_now);
    const Vec3<T> point = middle(closest);
    if (!is_finite(closest.normal) || !is_finite(point)) return {ToiStatus::gave_up, k, rounded_down_to<S>(now.time)};
    const T gap = closest.distance - T(method.min_separation);
    if (now.time == T(0) && gap <= near && overlaps_unchecked(a.shape, b.shape, T(method.min_separation)))
      return overlapping_at_start(a, b, 1);
    if (pair.speed == T(0)) return {ToiStatus::apart, k};
    const AttachedPlane<T> plane = plane_from(pair, now, closest.normal);
    const Toi<T> hit{ToiStatus::hit, k, rounded_down_to<S>(now.time), closest.normal, point};
    if (gap <= near && !opens(pair, plane, now)) return hit;
    TurningInstant<T> next = ride(pair, plane, now, T(near / T(4)));
    if (!(next.time > now.time) && plane.rides != Rides::world) {
      next = ride(pair, plane_riding(pair, now, Rides::world, closest.normal), now, T(near / T(4)));
    }
    if (spins_often) next = past_orbits(next, closest.normal);
    if (next.time >= T(1)) return {ToiStatus::apart, k};
    const T gained = next.time - now.time;
    if (gap <= near && gained <= T(method.tolerance)) return hit;
    if (!(gained > T(0)) && gap <= pair.hidden) return hit;
    if (!(gained > T(0))) return {ToiStatus::gave_up, k, rounded_down_to<S>(now.time)};
    now = next;
  }
  return {ToiStatus::gave_up, method.max_evaluations, rounded_down_to<S>(now.time)};
}

}  // namespace thinwall
