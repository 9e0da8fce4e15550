#pragma once
/// Discrete tests at poses along the step: what most simulations do, and the foil every other method is held against.

#include <string_view>

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/methods/tolerance.hpp>
#include <thinwall/swept/serves.hpp>

namespace thinwall {

/// Tests the poses at k/n of the step, k = 1 .. n, and answers with the first that touches.
/// Claims: a hit is one. Misses whatever fits between two poses, even contact at the start; late by up to 1/n.
template <Scalar S = double> struct Substeps {
  static constexpr std::string_view name = "substeps";
  int n = 4;             ///< [1] >= 1 poses a step; fewer are `invalid`
  S min_separation = 0;  ///< [length] >= 0: a gap this small counts as contact
};
Substeps(int) -> Substeps<double>;

/// Tests the end pose only: a step of an ordinary discrete simulation.
/// Claims: a hit is one. A body that crosses a wall within the step goes through.
template <Scalar S = double> struct EndOfStep {
  static constexpr std::string_view name = "end_of_step";
  S min_separation = 0;  ///< [length] >= 0: a gap this small counts as contact
};

/// Whatever the motion is: it has poses.
template <Scalar S, template <class> class Motion, Shape A, Shape B>
Toi<typename A::Scalar> first_touch_among_poses(const Substeps<S>& method, const Motion<A>& a, const Motion<B>& b) {
  using T = typename A::Scalar;
  if (method.n < 1) return invalid_toi<T>();
  for (int k = 0; k < method.n;) {
    ++k;  // after the last int there is none
    const T time = T(k) / T(method.n);
    const A a_then = pose_at(a, time);
    const B b_then = pose_at(b, time);
    if (!overlaps_unchecked(a_then, b_then, T(method.min_separation))) continue;
    const Separation<T> deepest = separation_unchecked(a_then, b_then);
    return {ToiStatus::hit, k, time, deepest.normal, middle(deepest)};
  }
  return {ToiStatus::apart, method.n};
}

template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const Substeps<S>& method, const Moving<A>& a, const Moving<B>& b) {
  return first_touch_among_poses(method, a, b);
}

template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const EndOfStep<S>& method, const Moving<A>& a, const Moving<B>& b) {
  return impact(Substeps<S>{1, method.min_separation}, a, b);
}

}  // namespace thinwall
