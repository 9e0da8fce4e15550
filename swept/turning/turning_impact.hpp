#pragma once
/// The front door of every time of impact where a body turns: as that of straight motion (swept/time_of_impact.hpp), and it calls
/// conservative advancement by default.

#include <algorithm>
#include <type_traits>

#include <thinwall/swept/turning/turning_methods.hpp>

namespace thinwall {

template <class Method, class A, class B>
concept ServesTurningInOrder = requires(const Method& method, const Turning<A>& a, const Turning<B>& b) {
  { impact(method, a, b) } -> std::same_as<Toi<typename A::Scalar>>;
};

/// True if `method` can be asked for the time of impact of A and B that turn, in either order.
template <class Method, class A, class B>
inline constexpr bool serves_turning =
    A::rank < B::rank ? ServesTurningInOrder<Method, B, A> : ServesTurningInOrder<Method, A, B>;

/// Of valid input, the shape of later rank first. Lengths are divided by a power of two where their squares would leave the range: bounds of
/// curvature are made of products of four.
template <class Method, Shape A, Shape B>
Toi<typename A::Scalar> turning_impact_in_range(Method method, const Turning<A>& a, const Turning<B>& b) {
  using S = typename A::Scalar;
  using std::ldexp;
  const S size = std::max(std::max(extent(a), extent(b)), S(method.min_separation));
  const int e = is_finite(size) ? binary_exponent(size) : std::numeric_limits<S>::max_exponent;
  if (e >= -64 && e <= 64) return impact(method, a, b);
  method.min_separation = ldexp(method.min_separation, -e);
  Toi<S> toi = impact(method, scaled(a, -e), scaled(b, -e));
  toi.point = times_power_of_two(toi.point, e);
  return toi;
}

/// When A and B, turning, first touch during the step, by `method`. Either may be Moving instead, the Aabb too.
/// Returns `invalid` with time NaN for a shape that is not valid(), a displacement or a rotation that is not finite, or an impossible option.
/// Degenerate: touching at the start is `overlapping` with time 0, whatever the motion (but EndOfStep and Substeps look only at the poses they
/// sample). Passing A and B the other way round flips the normal; where both are of one kind, the time may differ by the method's error.
template <class Method, Shape A, Shape B>
Toi<typename A::Scalar> time_of_impact(const Method& method, const Turning<A>& a, const Turning<B>& b) {
  using S = typename A::Scalar;
  static_assert(std::same_as<S, typename B::Scalar>, "both shapes must have the same scalar");
  static_assert(serves_turning<Method, A, B>, "this method does not serve this pair of shapes, turning");
  if constexpr (A::rank < B::rank) {
    return flipped(time_of_impact(method, b, a));
  } else {
    const bool has_valid_option = method.min_separation >= 0 && is_finite(method.min_separation);
    if (!has_valid_option || !valid(a) || !valid(b)) return invalid_toi<S>();
    if constexpr (std::is_same_v<S, float>) {
      return cast<float>(turning_impact_in_range(method, cast<double>(a), cast<double>(b)));
    } else {
      return turning_impact_in_range(method, a, b);
    }
  }
}
template <class Method, Shape A, Shape B>
Toi<typename A::Scalar> time_of_impact(const Method& method, const Turning<A>& a, const Moving<B>& b) {
  return time_of_impact(method, a, without_spin(b));
}
template <class Method, Shape A, Shape B>
Toi<typename A::Scalar> time_of_impact(const Method& method, const Moving<A>& a, const Turning<B>& b) {
  return time_of_impact(method, without_spin(a), b);
}

/// When they first touch, by conservative advancement: never late, never a miss, to 2^-26 of the step in double.
template <Shape A, Shape B> Toi<typename A::Scalar> time_of_impact(const Turning<A>& a, const Turning<B>& b) {
  return time_of_impact(ConservativeAdvancement<typename A::Scalar>{}, a, b);
}
template <Shape A, Shape B> Toi<typename A::Scalar> time_of_impact(const Turning<A>& a, const Moving<B>& b) {
  return time_of_impact(a, without_spin(b));
}
template <Shape A, Shape B> Toi<typename A::Scalar> time_of_impact(const Moving<A>& a, const Turning<B>& b) {
  return time_of_impact(without_spin(a), b);
}

}  // namespace thinwall
