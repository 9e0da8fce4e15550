#pragma once
/// Tolerances as fractions of a step, and times that rounding must not make later.

#include <limits>
#include <type_traits>

#include <thinwall/discrete/numbers/range.hpp>
#include <thinwall/swept/toi.hpp>

namespace thinwall {

/// [1] 2 to the power of minus half the digits of S: 2^-26 for double. Half of what S can tell apart, for little work.
template <Scalar S> S half_digits() { return constant_power_of_two<S, -(std::numeric_limits<S>::digits / 2)>(); }

/// True for a fraction of a step that both S and T, the scalar of times, can resolve: from the greater epsilon to 1. False for NaN.
template <Scalar T, Scalar S> bool is_tolerance(const S& tolerance) {
  return tolerance >= std::numeric_limits<S>::epsilon() && T(tolerance) >= std::numeric_limits<T>::epsilon() &&
         tolerance <= S(1);
}

/// A time >= 0 that S holds and that is at most `time`. The front door computes a float query in double and rounds the
/// answer to the nearest float, which may be later: a method that promises never to be late answers with one of these.
template <Scalar S, Scalar T> T rounded_down_to(const T& time) {
  if constexpr (std::numeric_limits<S>::digits >= std::numeric_limits<T>::digits) {
    return time;
  } else {
    using std::nextafter;
    const S nearest = static_cast<S>(time);
    return T(nearest) <= time ? T(nearest) : T(nextafter(nearest, S(0)));
  }
}

}  // namespace thinwall
