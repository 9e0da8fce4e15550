#pragma once
/// Numbers of the oracle: 100 digits for lengths and times, rationals where a verdict must be exact.
/// Every float, double, long double or 50-digit input is lifted without rounding.

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <boost/multiprecision/eigen.hpp>

namespace thinwall::oracle {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;
using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;

/// Three coordinates. A type of its own, so that the oracle shares nothing with the library it judges.
template <class N> struct Triple {
  std::array<N, 3> coordinates{};

  N& operator[](std::size_t i) { return coordinates[i]; }
  const N& operator[](std::size_t i) const { return coordinates[i]; }
  bool operator==(const Triple&) const = default;
};
using Vector = Triple<Real>;

/// The same value with 100 digits; exact, since no scalar under test has more.
template <class S> Real lift(const S& x) { return Real(x); }

template <class V> Vector lift_vector(const V& v) { return {lift(v[0]), lift(v[1]), lift(v[2])}; }

/// The same value as a fraction; exact.
inline Rational exact(const Real& x) {
  constexpr int bits = std::numeric_limits<Real>::digits;
  int exponent = 0;
  const Real mantissa = ldexp(frexp(x, &exponent), bits);
  const Integer whole = mantissa.convert_to<Integer>();
  const int shift = exponent - bits;
  const Integer power = Integer(1) << static_cast<unsigned>(shift < 0 ? -shift : shift);
  return shift < 0 ? Rational(whole, power) : Rational(Integer(whole * power));
}

/// The rounding error of one operation in S, relative to its result.
template <class S> Real unit_roundoff() { return lift(std::numeric_limits<S>::epsilon()) / 2; }

template <class N> Triple<N> operator+(const Triple<N>& a, const Triple<N>& b) {
  return {N(a[0] + b[0]), N(a[1] + b[1]), N(a[2] + b[2])};
}
template <class N> Triple<N> operator-(const Triple<N>& a, const Triple<N>& b) {
  return {N(a[0] - b[0]), N(a[1] - b[1]), N(a[2] - b[2])};
}
template <class N> Triple<N> operator*(const N& s, const Triple<N>& a) {
  return {N(s * a[0]), N(s * a[1]), N(s * a[2])};
}
template <class N> N dot(const Triple<N>& a, const Triple<N>& b) { return N(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]); }
template <class N> Triple<N> cross(const Triple<N>& a, const Triple<N>& b) {
  return {N(a[1] * b[2] - a[2] * b[1]), N(a[2] * b[0] - a[0] * b[2]), N(a[0] * b[1] - a[1] * b[0])};
}
inline Real length(const Vector& a) { return sqrt(dot(a, a)); }

/// The absolute value of each coordinate.
inline Vector magnitude(const Vector& a) { return {abs(a[0]), abs(a[1]), abs(a[2])}; }

}  // namespace thinwall::oracle

// ---- The scalars every typed test runs at, and their neighbors.

namespace thinwall::testing {

/// 50 decimal digits: the one multiprecision type among the scalars under test.
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

#ifdef THINWALL_TEST_WIDE_SCALARS  // the program tests_wide: the same tests once more
using Scalars = ::testing::Types<long double, Wide>;
#else
using Scalars = ::testing::Types<float, double>;
#endif

struct ScalarNames {
  template <class S> static std::string GetName(int) {
    if (std::is_same_v<S, float>) return "float";
    if (std::is_same_v<S, double>) return "double";
    if (std::is_same_v<S, long double>) return "long_double";
    return "wide";
  }
};

/// Two types of shape under one name.
template <class First, class Second> struct PairOf {
  using A = First;
  using B = Second;
  using S = typename First::Scalar;
};

/// 2^exponent.
template <class S> S power(int exponent) {
  using std::ldexp;
  return ldexp(S(1), exponent);
}

/// The next value of S above a positive normal number.
template <class S> S next_up(const S& x) {
  using std::frexp;
  int exponent = 0;
  frexp(x, &exponent);
  return x + power<S>(exponent - std::numeric_limits<S>::digits);
}

/// The next value of S below a positive normal number.
template <class S> S next_down(const S& x) {
  using std::frexp;
  int exponent = 0;
  const S mantissa = frexp(x, &exponent);
  const bool power_of_two = mantissa == S(0.5);
  return x - power<S>(exponent - std::numeric_limits<S>::digits - (power_of_two ? 1 : 0));
}

template <class S> S nan() { return std::numeric_limits<S>::quiet_NaN(); }
template <class S> S infinity() { return std::numeric_limits<S>::infinity(); }

/// The relative rounding error of one operation.
template <class S> S unit() { return std::numeric_limits<S>::epsilon() / 2; }

}  // namespace thinwall::testing
