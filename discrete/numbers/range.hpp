#pragma once
/// Guards against overflow and underflow: lengths of 1e200 and 1e-200 have no square in double, but their ratios do.
/// Inside the safe range nothing is rescaled, so that no small component is flushed to zero for nothing; outside it
/// every length is multiplied by one power of two, which is exact, and the answer is scaled back.

#include <algorithm>
#include <type_traits>

#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// 2^e, flushed to zero or infinity where S does not hold it.
template <Scalar S> S power_of_two(int e) {
  using std::ldexp;
  return ldexp(S(1), e);
}

/// The same as a constant: computed by the compiler for the built-in types, once for the others.
template <Scalar S, int e> const S& constant_power_of_two() {
  if constexpr (std::is_floating_point_v<S>) {
    static constexpr S value = [] {
      S power = 1;
      for (int i = 0; i < e; ++i) power *= 2;
      for (int i = 0; i > e; --i) power /= 2;
      return power;
    }();
    return value;
  } else {
    static const S value = power_of_two<S>(e);
    return value;
  }
}

/// The exponent e for which 2^e <= |x| < 2^(e + 1); 0 for zero, infinity and NaN.
template <Scalar S> int binary_exponent(const S& x) {
  using std::ilogb;
  return x == S(0) || !is_finite(x) ? 0 : static_cast<int>(ilogb(x));
}

/// x * 2^e, correctly rounded even where 2^e itself is out of range.
template <Scalar S> S times_power_of_two(const S& x, int e) {
  using std::ldexp;
  return e == 0 ? x : S(ldexp(x, e));
}
template <Scalar S> Vec3<S> times_power_of_two(const Vec3<S>& v, int e) {
  return {times_power_of_two(v[0], e), times_power_of_two(v[1], e), times_power_of_two(v[2], e)};
}

/// The largest magnitude among scalars and components; NaN is passed over.
template <Scalar S> THINWALL_HOT S largest(const S& x) {
  using std::abs;
  return abs(x);
}
template <Scalar S> THINWALL_HOT S largest(const Vec3<S>& v) {
  return std::max(largest(v[0]), std::max(largest(v[1]), largest(v[2])));
}
template <class First, class... Rest> THINWALL_HOT auto largest(const First& first, const Rest&... rest) {
  return std::max(largest(first), largest(rest...));
}

/// Products of up to four lengths of magnitude x neither overflow nor lose their leading digits.
template <Scalar S> THINWALL_HOT bool products_in_range(const S& x) {
  return x >= constant_power_of_two<S, std::numeric_limits<S>::min_exponent / 5>() &&
         x <= constant_power_of_two<S, std::numeric_limits<S>::max_exponent / 5>();
}

/// Not so short beside `size` that their products vanish at a scale that is safe for both; or no length at all.
template <Scalar S> bool counts_beside(const S& x, const S& size) {
  return x == S(0) || x >= size * constant_power_of_two<S, std::numeric_limits<S>::min_exponent / 5>();
}

/// The exponent e of the power of two for which x / 2^e has products in range; 0 where x itself has, or is zero.
template <Scalar S> int safe_exponent(const S& x) { return products_in_range(x) ? 0 : binary_exponent(x); }

/// One power of two for all lengths of a question and one for its displacements, which bring their products in range.
template <Scalar S> struct SafeScale {
  int length_exponent, speed_exponent;

  SafeScale(const S& longest, const S& fastest)
      : length_exponent(safe_exponent(longest)), speed_exponent(safe_exponent(fastest)) {}
  bool is_one() const { return length_exponent == 0 && speed_exponent == 0; }
  template <class T> T length(const T& x) const { return times_power_of_two(x, -length_exponent); }
  template <class T> T displacement(const T& v) const { return times_power_of_two(v, -speed_exponent); }
  S time(const S& t) const { return times_power_of_two(t, speed_exponent - length_exponent); }
  template <class T> T length_back(const T& x) const { return times_power_of_two(x, length_exponent); }
  S time_back(const S& t) const { return times_power_of_two(t, length_exponent - speed_exponent); }
};

/// A square that stands for its root: neither overflowed nor gnawed at by underflow.
template <Scalar S> THINWALL_HOT bool square_in_range(const S& square) {
  constexpr int lower = std::numeric_limits<S>::min_exponent + 2 * std::numeric_limits<S>::digits;
  return square >= constant_power_of_two<S, lower>() && square <= std::numeric_limits<S>::max();
}

/// A gap this small between cores of this size is round-off: it has a length but no direction.
template <Scalar S> S gap_noise(const S& size) { return 16 * std::numeric_limits<S>::epsilon() * size; }

/// A miss by no more, which a wider scalar may see as a hit: it is asked there.
template <Scalar S> S near_miss(const S& size) { return S(1 << 20) * gap_noise(size); }

template <Scalar S> THINWALL_COLD S norm_out_of_range(const Vec3<S>& v) {
  using std::sqrt;
  const S size = largest(v);
  if (size == S(0) || !is_finite(v)) return v.cwiseAbs().sum();  // 0, infinity or NaN
  const int e = binary_exponent(size);
  return times_power_of_two(S(sqrt(times_power_of_two(v, -e).squaredNorm())), e);
}

/// |v|, at any scale.
template <Scalar S> THINWALL_HOT S safe_norm(const Vec3<S>& v) {
  using std::sqrt;
  const S square = v.squaredNorm();
  return square_in_range(square) ? S(sqrt(square)) : norm_out_of_range(v);
}

template <Scalar S> THINWALL_COLD Vec3<S> unit_out_of_range(const Vec3<S>& v) {
  using std::sqrt;
  const S size = largest(v);
  if (size == S(0)) return Vec3<S>::Zero();
  const Vec3<S> scaled = times_power_of_two(v, -binary_exponent(size));
  return scaled / sqrt(scaled.squaredNorm());
}

/// v / |v| at any scale; zero where v is zero.
template <Scalar S> THINWALL_HOT Vec3<S> safe_unit(const Vec3<S>& v) {
  using std::sqrt;
  const S square = v.squaredNorm();
  if (!square_in_range(square)) return unit_out_of_range(v);
  return v / sqrt(square);
}

template <Scalar S> THINWALL_COLD bool within_out_of_range(const Vec3<S>& gap, const S& reach) {
  const S size = largest(gap, reach);
  if (size == S(0)) return true;
  if (!is_finite(gap) || !is_finite(reach)) return false;
  const int e = binary_exponent(size);
  const S scaled_reach = times_power_of_two(reach, -e);
  return times_power_of_two(gap, -e).squaredNorm() <= scaled_reach * scaled_reach;
}

/// |gap| <= reach, for reach >= 0, at any scale. False for NaN.
template <Scalar S> THINWALL_HOT bool within(const Vec3<S>& gap, const S& reach) {
  const S reach_square = reach * reach;
  if (square_in_range(reach_square))
    return gap.squaredNorm() <= reach_square;  // a gap whose square is lost is far from it
  return reach == S(0) ? gap == Vec3<S>::Zero() : within_out_of_range(gap, reach);
}

}  // namespace thinwall
