#pragma once
/// Every way to find when shapes touch that turn. A new one is an `impact` overload for Turning<A> and Turning<B> and one line in the list:
/// tests, benchmarks and experiments loop over it.

#include <algorithm>
#include <limits>
#include <string_view>

#include <thinwall/discrete/type_list.hpp>
#include <thinwall/swept/methods/speculative.hpp>
#include <thinwall/swept/methods/substeps.hpp>
#include <thinwall/swept/time_of_impact.hpp>
#include <thinwall/swept/turning/turning_advancement.hpp>

namespace thinwall {

/// Sweeps the shapes as they stand at the start, and leaves their spin out: a linear shape cast, which is what the continuous collision
/// detection of most engines asks.
/// Claims: nothing. Misses what comes round within the step, hits what has turned away, early or late by any time.
/// Error: none in the straight motion.
template <Scalar S = double> struct LinearSweep {
  static constexpr std::string_view name = "linear_sweep";
  S min_separation = 0;  ///< [length] >= 0: a gap this small counts as contact
};

template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const LinearSweep<S>& method, const Turning<A>& a, const Turning<B>& b) {
  using T = typename A::Scalar;
  const Moving<A> straight_a{a.shape, a.displacement};
  const Moving<B> straight_b{b.shape, b.displacement};
  const ClosedForm<T> closed_form{T(method.min_separation)};
  // The ladder would refuse a float's boxes, whose axes are no better than float: the front door has judged them.
  const bool is_question = has_valid_axes(a) && has_valid_axes(b);
  return is_question ? impact_by_ladder(closed_form, straight_a, straight_b)
                     : impact(closed_form, straight_a, straight_b);
}

template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const Substeps<S>& method, const Turning<A>& a, const Turning<B>& b) {
  return first_touch_among_poses(method, a, b);
}

template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const EndOfStep<S>& method, const Turning<A>& a, const Turning<B>& b) {
  return first_touch_among_poses(Substeps<S>{1, method.min_separation}, a, b);
}

/// The gap along the start's normal n shrinks by the path along n and, a body, by the angle times |n x axis| times the farthest
/// point's distance from the axis, at most: the bound of the fastest point. Never late, never misses with margin >= 1.
template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const Speculative<S>& method, const Turning<A>& a, const Turning<B>& b) {
  using T = typename A::Scalar;
  if (!(method.margin >= S(0)) || !is_finite(method.margin)) return invalid_toi<T>();
  const T min_separation(method.min_separation);
  if (overlaps_unchecked(a.shape, b.shape, min_separation)) return overlapping_at_start(a, b, 1);
  const TurningPair<T> pair(a, b, min_separation);
  if (pair.speed == T(0)) return {ToiStatus::apart, 1};
  const Separation<T> closest = separation_unchecked(a.shape, b.shape);
  const Vec3<T>& n = closest.normal;
  const T gap =
      n.dot(pair.between) - core_reach(pair.a.core, n) - core_reach<T>(pair.b.core, -n) - pair.reach - pair.margin;
  const T slack = T(1) + T(64) * std::numeric_limits<T>::epsilon();
  T closing = pair.margin - n.dot(pair.path);
  for (const TurningBody<T>* body : {&pair.a, &pair.b})
    closing += body->angle * across(body->axis, n) * body->off_axis * slack;
  const T time = gap > T(0) ? T(gap / std::max(closing, T(0)) / slack) : T(0);
  if (gap > T(method.margin) * pair.speed * slack || time > T(1)) return {ToiStatus::apart, 2};
  const T free = rounded_down_to<S>(time);
  return {ToiStatus::hit, 2, free, closest.normal, middle(separation_unchecked(pose_at(a, free), pose_at(b, free)))};
}

template <Scalar S>
using TurningMethods = TypeList<  //
    EndOfStep<S>,                 //
    Substeps<S>,                  //
    LinearSweep<S>,               //
    Speculative<S>,               //
    ConservativeAdvancement<S>>;

}  // namespace thinwall
