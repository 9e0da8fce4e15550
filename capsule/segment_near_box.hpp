#pragma once
/// The point of a segment that is closest to a box.

#include <algorithm>
#include <array>
#include <cstddef>

#include <thinwall/capsule/segment.hpp>

namespace thinwall {

/// The closest_parameter_to_box of a segment that may be nearest along a whole stretch: the middle of that stretch. Sorts the
/// s at which an axis enters or leaves its slab; between these the slope is linear, so two of them bracket its zero.
template <Scalar S> S middle_closest_parameter_to_box(const Vec3<S>& p, const Vec3<S>& d, const Vec3<S>& h) {
  std::array<S, 8> knots{S(0), S(1)};
  std::size_t count = 2;
  Vec3<S> enter = Vec3<S>::Zero(), leave = Vec3<S>::Zero();
  for (int i = 0; i < 3; ++i) {
    if (d[i] == S(0)) continue;
    const S side = d[i] > S(0) ? S(1) : S(-1);
    enter[i] = (-side * h[i] - p[i]) / d[i];
    leave[i] = (side * h[i] - p[i]) / d[i];
    for (const S& knot : {enter[i], leave[i]}) {
      if (!(knot > S(0) && knot < S(1))) continue;
      std::size_t k = count++;
      for (; knots[k - 1] > knot; --k) knots[k] = knots[k - 1];  // kept in order
      knots[k] = knot;
    }
  }
  const auto slope = [&](const S& s) {
    S sum = 0;
    for (int i = 0; i < 3; ++i) {
      if (d[i] == S(0) || (s >= enter[i] && s <= leave[i])) continue;
      const S face = (s < enter[i]) == (d[i] > S(0)) ? S(-h[i]) : h[i];
      sum += (p[i] + s * d[i] - face) * d[i];
    }
    return sum;
  };
  S falling = 0, falling_slope = 0, rising = 1, rising_slope = 0, first_zero = -1, last_zero = -1;
  for (std::size_t k = 0; k < count && rising_slope == S(0); ++k) {
    const S g = slope(knots[k]);
    if (g == S(0)) {
      if (first_zero < S(0)) first_zero = knots[k];
      last_zero = knots[k];
    } else {
      (g < S(0) ? falling : rising) = knots[k];
      (g < S(0) ? falling_slope : rising_slope) = g;
    }
  }
  if (first_zero >= S(0)) return (first_zero + last_zero) / 2;
  if (falling_slope == S(0)) return S(0);
  if (rising_slope == S(0)) return S(1);
  return falling + (rising - falling) * (falling_slope / (falling_slope - rising_slope));
}

/// Half the derivative of the squared distance from p + s * d to the box [-h, h], and by how much it grows with s.
template <Scalar S> struct BoxSlope {
  S slope = 0, growth = 0;
  int sides = 0;  ///< which of the box's sides the point is beyond, three values an axis

  THINWALL_HOT BoxSlope(const Vec3<S>& p, const Vec3<S>& d, const Vec3<S>& h, const S& s) {
    for (int i = 0; i < 3; ++i) {
      const S x = p[i] + s * d[i];
      const int side = static_cast<int>(x > h[i]) - static_cast<int>(x < -h[i]);
      slope += (x - std::min(h[i], std::max(S(-h[i]), x))) * d[i];
      growth += d[i] * d[i] * S(side * side);
      sides = 3 * sides + side;
    }
  }
};

/// The s in [0, 1] for which p + s * d is closest to the box [-h, h]; the middle of a whole stretch of such s.
/// The slope of the squared distance is continuous, does not decrease, and is linear while the point stays beyond the same
/// sides: Newton's steps end where the sides no longer change.
/// Error: the point is off by a few u (|p| + |d| + |h|). Source: derived here.
template <Scalar S> S closest_parameter_to_box(const Vec3<S>& p, const Vec3<S>& d, const Vec3<S>& h) {
  const S size = largest(p, d, h);
  if (!products_in_range(size) && binary_exponent(size) != 0) {
    const int e = binary_exponent(size);
    return closest_parameter_to_box(times_power_of_two(p, -e), times_power_of_two(d, -e), times_power_of_two(h, -e));
  }
  const BoxSlope<S> start(p, d, h, S(0)), end(p, d, h, S(1));
  if (start.slope > S(0)) return S(0);
  if (end.slope < S(0)) return S(1);
  if (start.slope < S(0) && end.slope > S(0)) {
    S low = 0, high = 1, s = start.slope / (start.slope - end.slope);
    BoxSlope<S> here(p, d, h, s);
    for (int round = 0; round < 6 && here.slope != S(0) && here.growth > S(0); ++round) {
      (here.slope < S(0) ? low : high) = s;
      const S next = s - here.slope / here.growth;
      if (!(next > low && next < high)) break;
      const BoxSlope<S> there(p, d, h, next);
      if (there.sides == here.sides) return next;
      s = next;
      here = there;
    }
  }
  return middle_closest_parameter_to_box(p, d, h);
}

}  // namespace thinwall
