#pragma once
/// What the queries at one instant return. Everything is a value, every member is initialized.

#include <limits>
#include <optional>
#include <utility>

#include <thinwall/discrete/numbers/range.hpp>

namespace thinwall {

/// One point of contact data between overlapping shapes A and B, in world axes.
template <Scalar S> struct Contact {
  Vec3<S> local_a = Vec3<S>::Zero();  ///< [length] deepest point of A, relative to center(A); an AABB's is always zero
  Vec3<S> local_b = Vec3<S>::Zero();  ///< [length] deepest point of B, relative to center(B)
  Vec3<S> normal = Vec3<S>::Zero();   ///< unit, from A to B
  S penetration = 0;                  ///< [length] >= 0: moving B this far along `normal` leaves the two touching
};

/// How far apart two shapes are, or how deep in each other.
template <Scalar S> struct Separation {
  S distance = 0;                     ///< [length] > 0 apart, 0 touching, < 0 the least penetration
  Vec3<S> normal = Vec3<S>::Zero();   ///< unit, from A to B
  Vec3<S> point_a = Vec3<S>::Zero();  ///< [length] a closest (or deepest) point of A, in world space
  Vec3<S> point_b = Vec3<S>::Zero();  ///< [length] the same of B; point_b - point_a = distance * normal
};

/// A half line, cut off at `max_t`.
template <Scalar S> struct Ray {
  Vec3<S> origin;                                ///< [length]
  Vec3<S> direction;                             ///< [length] of any length; t counts in lengths of it
  S max_t = std::numeric_limits<S>::infinity();  ///< [1] >= 0
};

template <Scalar S> S magnitude(const Ray<S>& ray) {
  return ray.origin.cwiseAbs().sum() + ray.direction.cwiseAbs().sum();
}
template <Scalar S> bool has_valid_sizes(const Ray<S>& ray) { return ray.max_t >= S(0); }
/// True if its origin and direction are finite and max_t is not negative.
template <Scalar S> bool valid(const Ray<S>& ray) {
  return is_finite(ray.origin) && is_finite(ray.direction) && has_valid_sizes(ray);
}
template <Scalar S> Ray<S> scaled(const Ray<S>& ray, int e) {
  return {times_power_of_two(ray.origin, e), times_power_of_two(ray.direction, e), ray.max_t};
}
template <Scalar S> Vec3<S> center(const Ray<S>& ray) { return ray.origin; }
template <Scalar S> Ray<S> moved(const Ray<S>& ray, const Vec3<S>& by) {
  return {ray.origin + by, ray.direction, ray.max_t};
}
template <Scalar S> S extent(const Ray<S>& ray) { return magnitude(ray); }

/// Where a ray first meets a shape.
template <Scalar S> struct RayHit {
  S t = 0;                           ///< [1] in [0, max_t], in lengths of the ray's direction
  Vec3<S> point = Vec3<S>::Zero();   ///< [length] on the shape's surface; the origin if the ray starts inside
  Vec3<S> normal = Vec3<S>::Zero();  ///< unit, outward; zero if the ray starts inside or touching
};

template <Scalar S> RayHit<S> scaled(const RayHit<S>& hit, int e) {
  return {hit.t, times_power_of_two(hit.point, e), hit.normal};
}

/// The same contact with every length multiplied by 2^e.
template <Scalar S> Contact<S> scaled(const Contact<S>& c, int e) {
  return {times_power_of_two(c.local_a, e), times_power_of_two(c.local_b, e), c.normal,
          times_power_of_two(c.penetration, e)};
}
template <Scalar S> Contact<S> flipped(const Contact<S>& c) { return {c.local_b, c.local_a, -c.normal, c.penetration}; }
template <Scalar S> Separation<S> scaled(const Separation<S>& s, int e) {
  return {times_power_of_two(s.distance, e), s.normal, times_power_of_two(s.point_a, e),
          times_power_of_two(s.point_b, e)};
}
template <Scalar S> Separation<S> flipped(const Separation<S>& s) {
  return {s.distance, -s.normal, s.point_b, s.point_a};
}
template <class Answer> std::optional<Answer> scaled(const std::optional<Answer>& answer, int e) {
  return answer ? std::optional(scaled(*answer, e)) : answer;
}

/// Halfway between the closest points.
template <Scalar S> Vec3<S> middle(const Separation<S>& s) { return (s.point_a + s.point_b) / S(2); }

}  // namespace thinwall
