#pragma once
/// The front door of every time of impact: checks the input, puts the later shape first (and flips the answer back),
/// keeps coordinates near the largest number from overflowing, and computes a float query in double.

#include <cassert>
#include <type_traits>

#include <thinwall/swept/methods/closed_form.hpp>

namespace thinwall {

template <class Method, Shape A, Shape B>
THINWALL_HOT Toi<typename A::Scalar> time_of_impact(const Method& method, const Moving<A>& a, const Moving<B>& b);

/// The same question with every length divided by 2^8, for coordinates near the largest number.
template <class Method, Shape A, Shape B>
THINWALL_COLD Toi<typename A::Scalar> impact_scaled_down(Method method, const Moving<A>& a, const Moving<B>& b) {
  using std::ldexp;
  method.min_separation = ldexp(method.min_separation, -8);
  Toi<typename A::Scalar> toi = time_of_impact(method, scaled(a, -8), scaled(b, -8));
  toi.point = times_power_of_two(toi.point, 8);
  return toi;
}

/// The answer where the sum of all magnitudes is not finite, or a size or option is out of range.
template <class Method, Shape A, Shape B>
THINWALL_COLD Toi<typename A::Scalar> impact_of_extremes(const Method& method, const Moving<A>& a, const Moving<B>& b) {
  using S = typename A::Scalar;
  const auto gap = method.min_separation;
  const bool only_huge =
      valid(a) && valid(b) && gap >= 0 && is_finite(gap);  // finite all the same, but their sum is not
  return only_huge ? impact_scaled_down(method, a, b) : Toi<S>{ToiStatus::invalid, 0, nan_vector<S>()[0]};
}

/// When A and B first touch during the step, by `method`.
/// Returns `invalid` with time NaN for a NaN, an infinity, a negative size or a negative min_separation.
/// Degenerate: touching at the start is `overlapping` with time 0, whatever the motion (but EndOfStep and Substeps look
/// only at the poses they sample); no relative motion is `apart`, or `overlapping` if they touch.
/// Passing A and B the other way round flips the normal and changes nothing else.
template <class Method, Shape A, Shape B>
THINWALL_HOT Toi<typename A::Scalar> time_of_impact(const Method& method, const Moving<A>& a, const Moving<B>& b) {
  using S = typename A::Scalar;
  static_assert(std::same_as<S, typename B::Scalar>, "both shapes must have the same scalar");
  static_assert(serves<Method, A, B>, "this method does not serve this pair of shapes");
  if constexpr (A::rank < B::rank) {
    return flipped(time_of_impact(method, b, a));
  } else {
    const S size = magnitude(a) + magnitude(b) + S(method.min_separation);
    if (!has_valid_sizes(a.shape) || !has_valid_sizes(b.shape) || !(method.min_separation >= 0) || !is_finite(size)) {
      return impact_of_extremes(method, a, b);
    }
    assert(valid(a.shape) && valid(b.shape) && "axes must be orthonormal");
    if constexpr (std::is_same_v<S, float>) {
      const Toi<double> toi = impact(method, cast<double>(a), cast<double>(b));
      return {toi.status, toi.evaluations, static_cast<float>(toi.time), toi.normal.template cast<float>(),
              toi.point.template cast<float>()};
    } else {
      return is_ordinary(size) ? impact(method, a, b) : impact_scaled_down(method, a, b);
    }
  }
}

/// When A and B first touch during the step, exact to rounding.
template <Shape A, Shape B>
THINWALL_HOT Toi<typename A::Scalar> time_of_impact(const Moving<A>& a, const Moving<B>& b) {
  return time_of_impact(ClosedForm<typename A::Scalar>{}, a, b);
}

}  // namespace thinwall
