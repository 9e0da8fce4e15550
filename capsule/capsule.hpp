#pragma once
/// The capsule: a segment rounded by a radius. It is also the volume a sphere sweeps in one step.

#include <optional>

#include <thinwall/capsule/ray_capsule.hpp>
#include <thinwall/capsule/segment.hpp>
#include <thinwall/capsule/segment_box.hpp>
#include <thinwall/discrete/aabb.hpp>

namespace thinwall {

/// All points within `radius` of the segment [a, b].
template <thinwall::Scalar S> struct Capsule {
  using Scalar = S;
  static constexpr int rank = 3;

  Vec3<S> a, b;  ///< [length] ends of the core segment; a == b is a ball
  S radius;      ///< [length] >= 0; 0 is a segment
};
template <Scalar S> Capsule(Vec3<S>, Vec3<S>, S) -> Capsule<S>;

/// The middle of the core segment.
template <Scalar S> Vec3<S> center(const Capsule<S>& c) { return c.a + (c.b - c.a) / S(2); }
template <Scalar S> S rounding(const Capsule<S>& c) { return c.radius; }
template <Scalar S> S magnitude(const Capsule<S>& c) {
  return c.a.cwiseAbs().sum() + c.b.cwiseAbs().sum() + largest(c.radius);
}
template <Scalar S> bool has_valid_sizes(const Capsule<S>& c) { return c.radius >= S(0); }
template <Scalar S> bool valid(const Capsule<S>& c) {
  return is_finite(c.a) && is_finite(c.b) && is_finite(c.radius) && has_valid_sizes(c);
}
template <Scalar S> Capsule<S> scaled(const Capsule<S>& c, int e) {
  return {times_power_of_two(c.a, e), times_power_of_two(c.b, e), times_power_of_two(c.radius, e)};
}
template <Scalar T, Scalar S> Capsule<T> cast(const Capsule<S>& c) {
  return {c.a.template cast<T>(), c.b.template cast<T>(), static_cast<T>(c.radius)};
}
template <Scalar S> Capsule<S> moved(const Capsule<S>& c, const Vec3<S>& by) { return {c.a + by, c.b + by, c.radius}; }
template <Scalar S> Vec3<S> half_widths(const Capsule<S>& c) {
  return Vec3<S>((c.b - c.a).cwiseAbs() / S(2)) + Vec3<S>::Constant(c.radius);
}
template <Scalar S> Vec3<S> contact_point(const Capsule<S>& c, const Vec3<S>& core_point, const Vec3<S>& outward) {
  return core_point + outward * c.radius;
}

/// The parameter in [0, 1] of the core's point that is closest to the other shape's core; docs of segment.hpp.
template <Scalar S> S closest_core_parameter(const Capsule<S>& capsule, const Sphere<S>& sphere) {
  return closest_parameter<S>(sphere.center - capsule.a, capsule.b - capsule.a);
}
template <Scalar S> S closest_core_parameter(const Capsule<S>& capsule, const Aabb<S>& box) {
  return closest_parameter_to_box<S>(capsule.a - box.center, capsule.b - capsule.a, box.half_extents);
}
template <Scalar S> S closest_core_parameter(const Capsule<S>& a, const Capsule<S>& b) {
  return closest_on_segments<S>(b.a - a.a, a.b - a.a, b.b - b.a).s;
}

template <Scalar S> bool cores_within(const Capsule<S>& capsule, const Sphere<S>& sphere, const S& reach) {
  const S s = closest_core_parameter(capsule, sphere);
  return within<S>((sphere.center - capsule.a) - (capsule.b - capsule.a) * s, reach);
}

template <Scalar S> bool cores_within(const Capsule<S>& capsule, const Aabb<S>& box, const S& reach) {
  const S s = closest_core_parameter(capsule, box);
  return within(excess_of<S>((capsule.a - box.center) + (capsule.b - capsule.a) * s, box.half_extents), reach);
}

template <Scalar S> bool cores_within(const Capsule<S>& a, const Capsule<S>& b, const S& reach) {
  return within(closest_on_segments<S>(b.a - a.a, a.b - a.a, b.b - b.a).gap, reach);
}

/// Degenerate: a center on the core leaves sideways; the direction is the caller's.
template <Scalar S> CoreGap<S> core_gap(const Capsule<S>& capsule, const Sphere<S>& sphere) {
  const Vec3<S> from_a = sphere.center - capsule.a, core = capsule.b - capsule.a;
  const S s = closest_core_parameter(capsule, sphere);
  const Vec3<S> between = from_a - core * s;
  CoreGap<S> gap;
  gap.distance = safe_norm(between);
  gap.local_a = core * (s - S(1) / S(2));
  gap.along = core;
  if (gap.distance > gap_noise(largest(from_a, core))) gap.normal = safe_unit(between);
  return gap;
}

/// Degenerate: cores that cross part along the normal of the plane they span, cores on one line sideways.
template <Scalar S> CoreGap<S> core_gap(const Capsule<S>& a, const Capsule<S>& b) {
  const Vec3<S> between = b.a - a.a, core_a = a.b - a.a, core_b = b.b - b.a;
  const SegmentPair<S> closest = closest_on_segments(between, core_a, core_b);
  CoreGap<S> gap;
  gap.distance = safe_norm(closest.gap);
  gap.local_a = core_a * (closest.s - S(1) / S(2));
  gap.local_b = core_b * (closest.t - S(1) / S(2));
  if (gap.distance > gap_noise(largest(between, core_a, core_b))) {
    gap.normal = safe_unit(closest.gap);
    return gap;
  }
  const Vec3<S> across = cross(safe_unit(core_a), safe_unit(core_b));
  gap.along = core_a == Vec3<S>::Zero() ? core_b : core_a;
  if (largest(across) <= gap_noise(S(1))) return gap;
  gap.normal = towards_positive<S>(safe_unit(across));
  return gap;
}

/// Degenerate: a core that touches or crosses the box parts from it along the axis of least penetration.
template <Scalar S> CoreGap<S> core_gap(const Capsule<S>& capsule, const Aabb<S>& box) {
  const Vec3<S> start = capsule.a - box.center, core = capsule.b - capsule.a;
  const S s = closest_core_parameter(capsule, box);
  const Vec3<S> nearest = start + core * s;
  const Vec3<S> excess = excess_of(nearest, box.half_extents);
  CoreGap<S> gap;
  gap.distance = safe_norm(excess);
  if (gap.distance <= gap_noise(largest(start, core, box.half_extents))) {
    return segment_through_box(start, core, box.half_extents);
  }
  gap.normal = -safe_unit(excess);
  gap.local_a = core * (s - S(1) / S(2));
  gap.local_b = nearest.cwiseMin(box.half_extents).cwiseMax(-box.half_extents);
  return gap;
}

template <Scalar S> std::optional<RayHit<S>> ray_entry(const Ray<S>& ray, const Capsule<S>& capsule) {
  const SegmentEntry<S> entry =
      rounded_segment_entry<S>(ray.origin - capsule.a, ray.direction, capsule.b - capsule.a, capsule.radius);
  if (entry.inside && ray.max_t >= S(0)) return RayHit<S>{S(0), ray.origin, Vec3<S>::Zero()};
  if (entry.inside || !(entry.time <= ray.max_t) || !is_finite(entry.time)) return std::nullopt;
  const Vec3<S> core_point = capsule.a + (capsule.b - capsule.a) * entry.s;
  return RayHit<S>{entry.time, core_point + entry.normal * capsule.radius, entry.normal};
}

}  // namespace thinwall
