#pragma once
/// One look at the start of the step: who could meet, and when at the earliest?

#include <string_view>

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/methods/separating_plane.hpp>
#include <thinwall/swept/methods/tolerance.hpp>

namespace thinwall {

/// Tests the start pose, inflated by margin times the length of the relative displacement: what is farther apart is
/// `apart`. For the rest the time is that at which the gap along the start's normal is used up; after the step, or never,
/// is `apart` too.
/// Claims: with margin >= 1 never late, never misses, rounding included (docs/methods.md). Hits what would pass beside,
/// and early: it knows the other shape as the plane before it. With margin < 1 it misses what is farther off at the start.
/// Degenerate: no relative motion is `apart`, or `overlapping` if they touch; a gap that rounding hides is a hit at 0.
/// Source: Firth, "Speculative Contacts - a Continuous Collision Engine Approach", 2011, for the contact before contact;
/// the bound is derived in docs/methods.md.
template <Scalar S = double> struct Speculative {
  static constexpr std::string_view name = "speculative";
  S margin = 1;          ///< [1] >= 0, finite: how far to look, in relative displacements
  S min_separation = 0;  ///< [length] >= 0: a gap this small counts as contact
};

template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const Speculative<S>& method, const Moving<A>& a, const Moving<B>& b) {
  using T = typename A::Scalar;
  if (!(method.margin >= S(0)) || !is_finite(method.margin)) return invalid_toi<T>();
  const T min_separation(method.min_separation);
  if (overlaps_unchecked(a.shape, b.shape, min_separation)) return overlapping_at_start(a, b, 1);
  const Vec3<T> path = relative_displacement(a, b);
  if (path == Vec3<T>::Zero()) return {ToiStatus::apart, 1};
  const Separation<T> closest = separation_unchecked(a.shape, b.shape);
  const SeparatingPlane<T> plane = separating_plane(a, b, closest.normal, min_separation);
  const T inflation = T(method.margin) * safe_norm(path);
  const T slack = inflation * (8 * std::numeric_limits<T>::epsilon());
  const T free = plane.free_until();
  if (plane.gap > inflation + slack || free > T(1)) return {ToiStatus::apart, 2};
  const T time = rounded_down_to<S>(free);
  return {ToiStatus::hit, 2, time, closest.normal, middle_after<T>(a, b, closest, time)};
}

}  // namespace thinwall
