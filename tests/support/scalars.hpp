#pragma once
/// The scalars every typed test runs at, and their neighbors.

#include <cmath>
#include <limits>
#include <type_traits>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

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
