#pragma once
/// A ray from a body's center along its motion: the bullet as a point.

#include <algorithm>
#include <string_view>

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/serves.hpp>

namespace thinwall {

/// True if A is the one whose center shoots the ray: the body that travels farther; of two that travel as far, the smaller; of two as small,
/// the one whose displacement is greater in the first number in which they differ. So the answer does not depend on the order of the arguments.
template <Shape A, Shape B> bool first_shoots(const Moving<A>& a, const Moving<B>& b) {
  using S = typename A::Scalar;
  const S a_path = safe_norm(a.displacement), b_path = safe_norm(b.displacement);
  if (a_path != b_path) return a_path > b_path;
  const S a_width = half_widths(a.shape).sum(), b_width = half_widths(b.shape).sum();
  if (a_width != b_width) return a_width < b_width;
  const Vec3<S>&v = a.displacement, &w = b.displacement;
  return std::lexicographical_compare(w.data(), w.data() + 3, v.data(), v.data() + 3);
}

/// Claims: nothing. Misses what the radius would have hit, and is late by the radius over the cosine of incidence.
/// The ray starts at the center of the body that travels farther and is cast against the other's true shape.
template <Scalar S = double> struct CentreRay {
  static constexpr std::string_view name = "centre_ray";
  S min_separation = 0;  ///< [length] >= 0: at the start only, a gap this small counts as contact
};

/// The center ray of `shooter` against the shape of `target`. The normal points from the shooter to the target. Where the
/// center starts in a target that, to rounding, the shooter does not overlap, it is along the ray; without a ray they are apart.
template <Scalar T, Shape A, Shape B> Toi<T> cast_center(const Moving<A>& shooter, const Moving<B>& target) {
  const auto hit = ray_entry(Ray<T>{center(shooter.shape), relative_displacement(shooter, target), T(1)}, target.shape);
  if (!hit) return {ToiStatus::apart, 2};
  const bool starts_in_it = hit->normal == Vec3<T>::Zero();
  const Vec3<T> normal = starts_in_it ? safe_unit(relative_displacement(shooter, target)) : Vec3<T>(-hit->normal);
  if (normal == Vec3<T>::Zero()) return {ToiStatus::apart, 2};
  return {ToiStatus::hit, 2, hit->t, normal, hit->point + target.displacement * hit->t};
}

template <Scalar S, Shape A, Shape B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const CentreRay<S>& method, const Moving<A>& a, const Moving<B>& b) {
  using T = typename A::Scalar;
  if (overlaps_unchecked(a.shape, b.shape, T(method.min_separation))) return overlapping_at_start(a, b, 1);
  return first_shoots(a, b) ? cast_center<T>(a, b) : flipped(cast_center<T>(b, a));
}

}  // namespace thinwall
