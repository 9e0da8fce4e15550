#pragma once
/// Numbers held as an unevaluated sum of two scalars: about twice the digits, by error-free transformations.
/// Used where one rounding decides between hit and miss; a few times slower than plain arithmetic, so only there.
/// Needs round to nearest, no contraction, and products away from underflow and overflow.
/// Source: Dekker, "A floating-point technique for extending the available precision", Numer. Math. 18, 1971.

#include <thinwall/discrete/numbers/range.hpp>
#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

template <Scalar S> struct DoubleWord {
  S high = 0;  ///< the sum rounded to S
  S low = 0;   ///< what that rounding left
};

/// a + b exactly.
template <Scalar S> DoubleWord<S> exact_sum(const S& a, const S& b) {
  const S sum = a + b;
  const S b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a * b exactly, by splitting each factor into halves whose products fit.
template <Scalar S> DoubleWord<S> exact_product(const S& a, const S& b) {
  const S splitter = constant_power_of_two<S, (std::numeric_limits<S>::digits + 1) / 2>() + S(1);
  const auto split = [&splitter](const S& x) {
    const S big = splitter * x;
    const S high = big - (big - x);
    return DoubleWord<S>{high, x - high};
  };
  const DoubleWord<S> x = split(a), y = split(b);
  const S product = a * b;
  return {product, ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

template <Scalar S> DoubleWord<S> operator-(const DoubleWord<S>& a) { return {-a.high, -a.low}; }

/// Relative error at most a few u^2 where the terms do not cancel to less than that.
template <Scalar S> DoubleWord<S> operator+(const DoubleWord<S>& a, const DoubleWord<S>& b) {
  const DoubleWord<S> high = exact_sum(a.high, b.high);
  const DoubleWord<S> low = exact_sum(a.low, b.low);
  const DoubleWord<S> middle = exact_sum(high.high, S(high.low + low.high));
  return exact_sum(middle.high, S(middle.low + low.low));
}
template <Scalar S> DoubleWord<S> operator-(const DoubleWord<S>& a, const DoubleWord<S>& b) { return a + (-b); }

template <Scalar S> DoubleWord<S> operator*(const DoubleWord<S>& a, const DoubleWord<S>& b) {
  const DoubleWord<S> product = exact_product(a.high, b.high);
  return exact_sum(product.high, S(product.low + (a.high * b.low + a.low * b.high)));
}

/// a x b, in direction too where a and b are nearly parallel and the plain products would cancel.
template <Scalar S> Vec3<S> accurate_cross(const Vec3<S>& a, const Vec3<S>& b) {
  const Vec3<S> plain = cross(a, b);
  if (8 * largest(plain) >= largest(a) * largest(b)) return plain;
  const auto turn = [&](int i, int j) { return (exact_product(a[i], b[j]) - exact_product(a[j], b[i])).high; };
  return {turn(1, 2), turn(2, 0), turn(0, 1)};
}

}  // namespace thinwall
