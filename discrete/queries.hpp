#pragma once
/// The front door of the queries at one instant. Puts the later shape first (and flips the answer back), keeps
/// coordinates near the largest number from overflowing, and turns the gap between cores into the answer asked for.
///
/// Every query counts touching as contact: shapes are closed sets. (The tutorial these rules come from compares with
/// `<`; the two differ on a set of measure zero.) Every query wants valid() shapes; NaN gives false or nothing.

#include <algorithm>
#include <optional>

#include <thinwall/discrete/results.hpp>
#include <thinwall/discrete/shape.hpp>

namespace thinwall {

/// True if the shapes come within `margin` [length] >= 0 of each other.
/// Error: decides as if the gap were off by a few units of round-off of the coordinates involved.
template <Shape A, Shape B> bool overlaps_within(const A& a, const B& b, const typename A::Scalar& margin) {
  using S = typename A::Scalar;
  static_assert(std::same_as<S, typename B::Scalar>, "both shapes must have the same scalar");
  static_assert(ServedPair<A, B>, "this pair of shapes is not served: include its header, or see docs/pairs.md");
  if constexpr (A::rank < B::rank) {
    return overlaps_within(b, a, margin);
  } else {
    if (is_ordinary(S(magnitude(a) + magnitude(b) + margin))) {
      return cores_within(a, b, S(rounding(a) + rounding(b) + margin));
    }
    if (!valid(a) || !valid(b) || !is_finite(margin)) return false;
    return overlaps_within(scaled(a, -8), scaled(b, -8), times_power_of_two(margin, -8));
  }
}

/// True if the shapes share a point; touching counts.
template <Shape A, Shape B> bool overlaps(const A& a, const B& b) {
  return overlaps_within(a, b, typename A::Scalar(0));
}

/// The gap between the cores of A and B, whichever of the two has the overload.
template <Shape A, Shape B> CoreGap<typename A::Scalar> core_gap_either_way(const A& a, const B& b) {
  if constexpr (A::rank < B::rank) {
    return flipped(core_gap(b, a));
  } else {
    return core_gap(a, b);
  }
}

/// Signed distance, normal, and a closest point on each. NaN throughout if a shape is not valid.
/// Degenerate: where the cores touch, the normal is the one of least penetration; where several serve, the lowest axis
/// and the positive side (boxes), or the one nearest to +x (rounded shapes).
template <Shape A, Shape B> Separation<typename A::Scalar> separation(const A& a, const B& b) {
  using S = typename A::Scalar;
  static_assert(std::same_as<S, typename B::Scalar>, "both shapes must have the same scalar");
  static_assert(ServedPair<A, B>, "this pair of shapes is not served: include its header, or see docs/pairs.md");
  if (!is_ordinary(S(magnitude(a) + magnitude(b)))) {
    if (!valid(a) || !valid(b)) return {nan_vector<S>()[0], nan_vector<S>(), nan_vector<S>(), nan_vector<S>()};
    const Separation<S> small = separation(scaled(a, -8), scaled(b, -8));
    return {times_power_of_two(small.distance, 8), small.normal, times_power_of_two(small.point_a, 8),
            times_power_of_two(small.point_b, 8)};
  }
  const CoreGap<S> gap = core_gap_either_way(a, b);
  const Vec3<S> normal = gap.normal == Vec3<S>::Zero() ? arbitrary_normal(gap.along) : gap.normal;
  return {gap.distance - (rounding(a) + rounding(b)), normal, center(a) + (gap.local_a + normal * rounding(a)),
          center(b) + (gap.local_b - normal * rounding(b))};
}

/// One point of contact data, only when touching or overlapping: exactly where overlaps() is true.
template <Shape A, Shape B> std::optional<Contact<typename A::Scalar>> contact(const A& a, const B& b) {
  using S = typename A::Scalar;
  if (!overlaps(a, b)) return std::nullopt;
  if (!is_ordinary(S(magnitude(a) + magnitude(b)))) {
    auto small = contact(scaled(a, -8), scaled(b, -8));
    if (!small) return std::nullopt;
    return Contact<S>{times_power_of_two(small->local_a, 8), times_power_of_two(small->local_b, 8), small->normal,
                      times_power_of_two(small->penetration, 8)};
  }
  const CoreGap<S> gap = core_gap_either_way(a, b);
  const Vec3<S> normal = gap.normal == Vec3<S>::Zero() ? arbitrary_normal(gap.along) : gap.normal;
  const S penetration = std::max(S(0), S(rounding(a) + rounding(b) - gap.distance));
  return Contact<S>{contact_point(a, gap.local_a, normal), contact_point(b, gap.local_b, Vec3<S>(-normal)), normal,
                    penetration};
}

/// Where the ray first meets the shape; nothing if it does not within max_t.
/// Error: forward error of t a few u * kappa * t (docs/closed_forms.md).
/// Degenerate: a start inside or touching hits at 0 with a zero normal; a ray of no direction hits only there.
template <Scalar S, Shape A> std::optional<RayHit<S>> raycast(const Ray<S>& ray, const A& shape) {
  static_assert(std::same_as<S, typename A::Scalar>, "the ray and the shape must have the same scalar");
  const S size = ray.origin.cwiseAbs().sum() + ray.direction.cwiseAbs().sum() + magnitude(shape);
  if (is_ordinary(size)) return ray_entry(ray, shape);
  if (!is_finite(ray.origin) || !is_finite(ray.direction) || !valid(shape)) return std::nullopt;
  const Ray<S> near{times_power_of_two(ray.origin, -8), times_power_of_two(ray.direction, -8), ray.max_t};
  auto small = raycast(near, scaled(shape, -8));
  if (!small) return small;
  const bool from_inside = small->normal == Vec3<S>::Zero();
  small->point = from_inside ? ray.origin : times_power_of_two(small->point, 8);
  return small;
}

}  // namespace thinwall
