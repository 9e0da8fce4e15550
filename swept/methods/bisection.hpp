#pragma once
/// Find a time at which the shapes touch, then halve the stretch before it.

#include <algorithm>
#include <limits>
#include <string_view>

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/methods/tolerance.hpp>
#include <thinwall/swept/serves.hpp>

namespace thinwall {

/// The separation is convex in time (docs/methods.md). So it is minimized first, by the sign of its slope: if it stays
/// positive the shapes are apart. Otherwise the stretch between the start and the time that was found to touch holds one
/// change of sign, and is halved down to the tolerance.
/// Claims: to the tolerance. The shapes touch at the answered time, to rounding, and did not `tolerance` before.
/// Error: late by at most the tolerance, and by rounding; a contact shorter than epsilon of the step may be missed.
/// Degenerate: no relative motion is `apart`, or `overlapping` if they touch.
/// Source: derived in docs/methods.md.
template <Scalar S = double> struct Bisection {
  static constexpr std::string_view name = "bisection";
  S tolerance = half_digits<S>();  ///< [1] epsilon to 1: how late a hit may be, in steps
  S min_separation = 0;            ///< [length] >= 0: a gap this small counts as contact
};

/// The gap at one time and the slope there.
template <Scalar S> struct GapSample {
  S time = 0;             ///< [1]
  S gap = 0;              ///< [length] <= 0: in contact
  S closing = 0;          ///< [length] per step; > 0 while the gap shrinks
  Separation<S> closest;  ///< the shapes at that time
};

/// Between two times, the first approaching and the second receding, the gap lies above both tangents. They cross at
/// this time, and `lowest` there.
template <Scalar S> struct TangentCrossing {
  S time, lowest;

  TangentCrossing(const GapSample<S>& before, const GapSample<S>& after) {
    const S width = after.time - before.time, opening = -after.closing;
    const S elapsed = ((before.gap - after.gap) + opening * width) / (before.closing + opening);
    time = before.time + elapsed;
    lowest = before.gap - before.closing * elapsed;
  }
};

template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const Bisection<S>& method, const Moving<A>& a, const Moving<B>& b) {
  using T = typename A::Scalar;
  if (!is_tolerance<T>(method.tolerance)) return invalid_toi<T>();
  const T margin = T(method.min_separation);
  if (overlaps_unchecked(a.shape, b.shape, margin)) return overlapping_at_start(a, b, 1);
  const Vec3<T> path = relative_displacement(a, b);
  if (path == Vec3<T>::Zero()) return {ToiStatus::apart, 1};
  int evaluations = 1;
  const auto sample = [&](const T& time) {
    ++evaluations;
    const Separation<T> closest = separation_unchecked(pose_at(a, time), pose_at(b, time));
    return GapSample<T>{time, closest.distance - margin, closest.normal.dot(path), closest};
  };
  // The direction of a gap is off by rounding, S's of the axes too, over its length; and its slope by that part of the path.
  const T noise = T(gap_noise(S(extent(a) + extent(b)))), fastest = safe_norm(path);
  const auto slope_noise = [&](const GapSample<T>& s) -> T {
    return fastest * (noise / std::max(s.closest.distance, noise));
  };
  GapSample<T> before = sample(T(0));
  bool has_slope = before.closing > T(0);
  if (before.closing < -slope_noise(before)) return {ToiStatus::apart, evaluations};
  GapSample<T> after = sample(T(1));
  constexpr int rounds = 2 * std::numeric_limits<S>::digits;  // half of them halve
  for (int k = 0; after.gap > T(0); ++k) {
    const T at_start = after.gap + after.closing * after.time;  // the tangent, which leads up from there
    const bool stays_apart = after.closing > slope_noise(after) || (!has_slope && at_start > -noise);
    if (stays_apart || k == rounds) return {ToiStatus::apart, evaluations};
    GapSample<T> steepest = after;  // it parts no faster than that
    steepest.closing = std::max(T(-fastest), T(after.closing - slope_noise(after)));
    const TangentCrossing<T> crossing(before, steepest);
    if (has_slope && crossing.lowest > T(0)) return {ToiStatus::apart, evaluations};
    const GapSample<T> between = sample(has_slope && k % 2 == 0 ? crossing.time : T((before.time + after.time) / 2));
    if (!(between.time > before.time && between.time < after.time)) continue;
    const bool approaches = between.gap > T(0) && between.closing > T(0);
    (approaches ? before : after) = between;
    has_slope = has_slope || approaches;
  }
  while (after.time - before.time > T(method.tolerance)) {  // at least epsilon: one more halving a digit
    const GapSample<T> between = sample((before.time + after.time) / 2);
    (between.gap > T(0) ? before : after) = between;
  }
  return {ToiStatus::hit, evaluations, after.time, after.closest.normal, middle(after.closest)};
}

}  // namespace thinwall
