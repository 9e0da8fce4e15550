#pragma once
/// The scalar every geometric type is a template on, and the vectors made of it.

#ifdef __FAST_MATH__
#error "thinwall needs IEEE arithmetic: build without -ffast-math (its NaN checks and error bounds would not hold)"
#endif

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

#include <Eigen/Core>

/// What every query runs through is inlined, whatever its size: a vector passed through memory costs more than its
/// arithmetic. What only the extremes need is kept out of its way.
#ifndef THINWALL_HOT
#define THINWALL_HOT [[gnu::always_inline]] inline
#endif
#define THINWALL_COLD [[gnu::cold, gnu::noinline]]

namespace thinwall {

/// A binary floating-point type: float, double, long double, or a Boost.Multiprecision float.
template <class S>
concept Scalar = std::numeric_limits<S>::is_specialized && !std::numeric_limits<S>::is_integer &&
                 std::numeric_limits<S>::has_quiet_NaN && std::numeric_limits<S>::radix == 2 && std::copyable<S>;

/// The scalar that has the last word: long double for double where it holds more digits, else S itself.
template <Scalar S>
using Wider =
    std::conditional_t<std::is_same_v<S, double> && (std::numeric_limits<long double>::digits > 60), long double, S>;
template <Scalar S> inline constexpr bool has_wider = !std::is_same_v<Wider<S>, S>;

template <Scalar S> using Vec3 = Eigen::Matrix<S, 3, 1>;
template <Scalar S> using Mat3 = Eigen::Matrix<S, 3, 3>;

/// The unit vector along axis 0, 1 or 2, or its opposite where `negative`.
template <Scalar S> Vec3<S> axis_vector(int axis, bool negative = false) {
  Vec3<S> unit = Vec3<S>::Zero();
  unit[axis] = negative ? S(-1) : S(1);
  return unit;
}

/// a x b. Eigen's own lies in <Eigen/Geometry>, which brings decompositions nobody here needs.
template <Scalar S> Vec3<S> cross(const Vec3<S>& a, const Vec3<S>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// v or -v, whichever points towards +x, or +y where x is zero, or +z.
template <Scalar S> Vec3<S> towards_positive(const Vec3<S>& v) {
  const S& first = v[0] != S(0) ? v[0] : v[1] != S(0) ? v[1] : v[2];
  return first < S(0) ? Vec3<S>(-v) : v;
}

template <Scalar S> Vec3<S> nan_vector() { return Vec3<S>::Constant(std::numeric_limits<S>::quiet_NaN()); }

template <Scalar S> bool is_finite(const S& x) { return x - x == S(0); }
template <Scalar S> bool is_finite(const Vec3<S>& v) { return is_finite(v[0]) && is_finite(v[1]) && is_finite(v[2]); }

}  // namespace thinwall
