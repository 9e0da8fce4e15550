#pragma once
/// Which stretch of the step is the first that cannot be proven free?

#include <algorithm>
#include <string_view>

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/methods/separating_plane.hpp>
#include <thinwall/swept/methods/tolerance.hpp>

namespace thinwall {

/// Bounds the gap over whole intervals of time, the earliest first: across the plane that parts the shapes in the middle
/// of an interval the gap is linear, so that its ends bound it. An interval that is not proven free is halved, down to
/// the tolerance; one that is makes way for the next, twice as long.
/// Claims: never late, never misses.
/// Error: everything before the answered time is proven free, rounding included (docs/methods.md); the gap there is at most
/// the tolerance times the relative displacement, so that it is early by at most the tolerance over the cosine of
/// incidence; a miss nearer than that gap may be a hit, and so may one so near that rounding hides its normal.
/// Degenerate: no relative motion is `apart`, or `overlapping` if they touch; out of evaluations is `gave_up`.
/// Source: derived in docs/methods.md; the search is that of interval root finders, as in Tight-Inclusion (Wang et al.,
/// "A Large-Scale Benchmark and an Inclusion-Based Algorithm for Continuous Collision Detection", 2021).
template <Scalar S = double> struct Inclusion {
  static constexpr std::string_view name = "inclusion";
  S tolerance = half_digits<S>();  ///< [1] epsilon to 1: how short an interval of the step is a hit
  int max_evaluations = 1024;      ///< [1] >= 1 separations; then: gave_up, with the largest time proven free
  S min_separation = 0;            ///< [length] >= 0: a gap this small counts as contact
};

template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const Inclusion<S>& method, const Moving<A>& a, const Moving<B>& b) {
  using T = typename A::Scalar;
  if (!is_tolerance<T>(method.tolerance) || method.max_evaluations < 1) return invalid_toi<T>();
  const T margin(method.min_separation);
  if (overlaps_unchecked(a.shape, b.shape, margin)) return overlapping_at_start(a, b, 1);
  if (relative_displacement(a, b) == Vec3<T>::Zero()) return {ToiStatus::apart, 1};
  T free = 0, width = 1;  // no contact up to `free`
  for (int k = 1; k <= method.max_evaluations; ++k) {
    const T end = std::min(T(1), T(free + width)), middle = (free + end) / 2;
    const Separation<T> closest = separation_unchecked(pose_at(a, middle), pose_at(b, middle));
    const SeparatingPlane<T> plane = separating_plane(a, b, closest.normal, margin);
    if (plane.free_at(free) && plane.free_at(end)) {
      if (end == T(1)) return {ToiStatus::apart, k + 1};
      free = end;
      width *= 2;
    } else if (end - free > T(method.tolerance)) {
      width = (end - free) / 2;
    } else {
      const T time = rounded_down_to<S>(free);
      const bool faces = closest.normal.dot(relative_displacement(a, b)) > T(0);
      if (faces) return {ToiStatus::hit, k + 1, time, closest.normal, middle_after<T>(a, b, closest, time - middle)};
      // in the middle one is through the other: past it, the normal leads on
      const Separation<T> before = separation_unchecked(pose_at(a, time), pose_at(b, time));
      return {ToiStatus::hit, k + 2, time, before.normal, middle_after<T>(a, b, before, T(0))};
    }
  }
  return {ToiStatus::gave_up, method.max_evaluations + 1, rounded_down_to<S>(free)};
}

}  // namespace thinwall
