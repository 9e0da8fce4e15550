#pragma once
/// When a moving sphere comes within R of a triangle: exactly where R is zero, else the walk of core_entry.hpp over the
/// triangle's parts, begun where the shadows on the plane's normal and the coordinate axes first overlap.

#include <thinwall/discrete/triangle.hpp>
#include <thinwall/swept/closed_form/core_entry.hpp>
#include <thinwall/swept/closed_form/shared_time.hpp>

namespace thinwall {

/// When the shadows of the point p + v t, rounded by R, and of the triangle (0, e1, e2) overlap. Reaches are widened by more
/// than rounding: no contact lies outside.
template <Scalar S>
SharedTime<S> point_and_triangle_share(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Vec3<S>& e1,
                                       const Vec3<S>& e2, const S& size) {
  using std::sqrt;
  const Vec3<S> low = e1.cwiseMin(e2).cwiseMin(S(0)), high = e1.cwiseMax(e2).cwiseMax(S(0));
  const Vec3<S> from_middle = p - (low + high) / S(2), half = (high - low) / S(2);
  const S wide = R + gap_noise(size);
  SharedTime<S> shared(p.cwiseAbs().sum() + e1.cwiseAbs().sum() + e2.cwiseAbs().sum() + R);
  for (int i = 0; i < 3; ++i) shared.narrow(i, from_middle[i], v[i], half[i] + wide);
  if (!shared.ever()) return shared;
  const Vec3<S> side1 = times_power_of_two(e1, -safe_exponent(largest(e1)));
  const Vec3<S> side2 = times_power_of_two(e2, -safe_exponent(largest(e2)));
  const Vec3<S> normal = cross(side1, side2);  // turned by rounding, which moves the corners along it
  const S off = gap_noise(S(1)) * largest(side1) * largest(side2) * largest(p, e1, e2);
  shared.narrow(3, p.dot(normal), v.dot(normal), wide * sqrt(normal.squaredNorm()) + off, normal.cwiseAbs().sum());
  return shared;
}

/// Requires lengths and displacements whose products of four are in range.
template <Scalar S>
Entry<S> sphere_triangle_entry_in_range(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Vec3<S>& e1,
                                        const Vec3<S>& e2) {
  const S size = largest(p, R, e1, e2);
  const SharedTime<S> shared = point_and_triangle_share(p, v, R, e1, e2, size);
  if (!shared.ever()) return {};
  const bool starts_apart = shared.first > S(0) && R > 4 * gap_noise(size);
  return core_entry(
      p, v, R, largest(e1, e2), [&](const Vec3<S>& x) { return closest_on_triangle(x, e1, e2); },
      starts_apart ? shared.time() : S(0));
}

/// First time at which p + v t is within R > 0 of the triangle (0, e1, e2); the normal out of the triangle.
template <Scalar S>
Entry<S> sphere_triangle_entry(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Vec3<S>& e1, const Vec3<S>& e2) {
  return entry_at_safe_scale<S>(&sphere_triangle_entry_in_range<S>, p, v, R, e1, e2);
}

}  // namespace thinwall
