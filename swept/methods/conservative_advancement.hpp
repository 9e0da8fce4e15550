#pragma once
/// Step to where the shapes could first touch, look again, and step on.

#include <string_view>

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/methods/separating_plane.hpp>
#include <thinwall/swept/methods/tolerance.hpp>

namespace thinwall {

/// Steps by gap over closing speed along the normal until the gap is within tolerance.
/// Claims: never late, never misses.
/// Error: the answered time is proven free of earlier contact, rounding included (docs/methods.md); early by at most the
/// tolerance over the cosine of incidence; a miss nearer than the tolerance may be a hit, and so may one so near that
/// rounding hides its normal.
/// Degenerate: no relative motion is `apart`, or `overlapping` if they touch; out of evaluations is `gave_up`.
/// Source: Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996, for the idea; the bound is derived in
/// docs/methods.md.
template <Scalar S = double> struct ConservativeAdvancement {
  static constexpr std::string_view name = "conservative_advancement";
  S tolerance = half_digits<S>();  ///< [1] epsilon to 1: a gap this fraction of the relative displacement is a hit
  int max_evaluations = 64;        ///< [1] >= 1 separations; then: gave_up, with the largest time proven free
  S min_separation = 0;            ///< [length] >= 0: a gap this small counts as contact
};

template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const ConservativeAdvancement<S>& method, const Moving<A>& a, const Moving<B>& b) {
  using T = typename A::Scalar;
  if (!is_tolerance<T>(method.tolerance) || method.max_evaluations < 1) return invalid_toi<T>();
  const T margin(method.min_separation);
  if (overlaps_unchecked(a.shape, b.shape, margin)) return overlapping_at_start(a, b, 1);
  const Vec3<T> path = relative_displacement(a, b);
  if (path == Vec3<T>::Zero()) return {ToiStatus::apart, 1};
  const T near = T(method.tolerance) * safe_norm(path);
  T free = 0;  // no contact before
  for (int k = 1; k <= method.max_evaluations; ++k) {
    const Separation<T> closest = separation_unchecked(pose_at(a, free), pose_at(b, free));
    const SeparatingPlane<T> plane = separating_plane(a, b, closest.normal, margin);
    const T next = plane.free_until();
    if (next > T(1) || plane.free_from(free)) return {ToiStatus::apart, k + 1};
    if (closest.distance - margin <= near || next <= free) {
      const T time = rounded_down_to<S>(free);
      return {ToiStatus::hit, k + 1, time, closest.normal, middle_after<T>(a, b, closest, time - free)};
    }
    free = next;
  }
  return {ToiStatus::gave_up, method.max_evaluations + 1, rounded_down_to<S>(free)};
}

}  // namespace thinwall
