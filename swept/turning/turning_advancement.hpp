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

/// How far a plane was ridden.
template <Scalar S> struct Ride {
  TurningInstant<S> end;  ///< nothing touches before, if nothing did at its start; time 1 is the end of the step
  bool opening = false;   ///< the gap grew at the start
};

/// Rides the plane until it no longer parts the shapes, a step of it gains a tenth of the way only, the gap is less than `enough`, or the
/// step is over.
template <Scalar S>
Ride<S> ride(const TurningPair<S>& pair, const AttachedPlane<S>& plane, const TurningInstant<S>& from,
             const S& enough) {
  Ride<S> ridden{from};
  const S of_centers = curvature_of_centers(pair, plane, from);
  for (int step = 0; step < 16; ++step) {
    const S left = S(1) - ridden.end.time;
    const GapAhead<S> ahead = gap_ahead(pair, plane, ridden.end, of_centers);
    const FirstRoot<S> root = first_root(ahead.bound, left);
    if (step == 0) ridden.opening = root.slope > S(0);
    if (!(root.tau > S(0))) break;
    if (root.tau >= left) {
      ridden.end.time = S(1);
      break;
    }
    const S next = ridden.end.time + root.tau * (S(1) - S(4) * std::numeric_limits<S>::epsilon());
    if (!(next > ridden.end.time)) break;
    ridden.end = instant(pair, next);
    if (root.tau < (next - from.time) / S(10) || root.value < enough * ahead.scale) break;
  }
  return ridden;
}

/// Claims: never late, never misses, rounding included (docs/turning.md), whatever the angles.
/// Error: early by at most what it takes to close a gap of `tolerance` times the speed bound |path| + sum of angle times the farthest
/// point's distance from the axis; a miss nearer than that may be a hit, and so may one that rounding hides.
/// Degenerate: no motion is `apart`, or `overlapping`; very many turns are `gave_up`, or a hit that rounding hides.
/// Source: derived in docs/turning.md; the idea of advancement is Mirtich's, 1996.
template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const ConservativeAdvancement<S>& method, const Turning<A>& a, const Turning<B>& b) {
  using T = typename A::Scalar;
  if (!is_tolerance(method.tolerance) || method.max_evaluations < 1) return invalid_option<T>();
  const TurningPair<T> pair(a, b, T(method.min_separation));
  const T near = std::max(T(T(method.tolerance) * pair.speed), T(T(4) * pair.margin));
  const T many_turns = 3;  // [rad] from here on whole orbits are worth a look
  TurningInstant<T> now = instant(pair, T(0));
  for (int k = 1; k <= method.max_evaluations; ++k) {
    const A a_now = posed(a, now.turn_a, now.time);
    const B b_now = posed(b, now.turn_b, now.time);
    if constexpr (std::is_same_v<A, Obb<T>> && std::is_same_v<B, Obb<T>>) {
      const LeastOverlap<T> axis = least_overlap(box_pair(a_now, b_now));
      if (-axis.overlap - T(method.min_separation) > near) {
        const AttachedPlane<T> plane = plane_across<T>(pair, now, a.shape, b.shape, axis, a_now.axes * axis.normal);
        const TurningInstant<T> next = ride(pair, plane, now, T(near / T(4))).end;
        if (next.time >= T(1)) return {ToiStatus::apart, k};
        if (next.time > now.time) {
          now = next;
          continue;
        }
      }
    }
    const Separation<T> closest = separation_unchecked(a_now, b_now);
    const T gap = closest.distance - T(method.min_separation);
    if (now.time == T(0) && gap <= near && overlaps_unchecked(a.shape, b.shape, T(method.min_separation)))
      return overlapping_at_start(a, b, 1);
    if (pair.speed == T(0)) return {ToiStatus::apart, k};
    const AttachedPlane<T> plane = plane_from(pair, now, closest.normal);
    Ride<T> next = ride(pair, plane, now, T(near / T(4)));
    if (!(next.end.time > now.time) && plane.rides != Rides::world) {
      const bool opening = next.opening;
      next = ride(pair, plane_riding(pair, Rides::world, closest.normal), now, T(near / T(4)));
      next.opening = opening;
    }
    if (next.end.time < T(1) && pair.turn > many_turns) {
      const T until = orbits_apart_until(pair, now, closest.normal);
      if (until > next.end.time) next.end = instant(pair, std::min(until, T(1)));
    }
    if (next.end.time >= T(1)) return {ToiStatus::apart, k};
    const T gained = next.end.time - now.time;
    if (!(gained > T(0)) || (gap <= near && (!next.opening || gained <= T(method.tolerance))))
      return {ToiStatus::hit, k, rounded_down_to<S>(now.time), closest.normal, middle(closest)};
    now = next.end;
  }
  return {ToiStatus::gave_up, method.max_evaluations, rounded_down_to<S>(now.time)};
}

}  // namespace thinwall
