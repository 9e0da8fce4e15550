#pragma once
/// The sphere: a point rounded by a radius.

#include <optional>

#include <thinwall/discrete/entry/ball_entry.hpp>
#include <thinwall/discrete/queries.hpp>

namespace thinwall {

/// All points within `radius` of the center.
template <thinwall::Scalar S> struct Sphere {
  using Scalar = S;
  static constexpr int rank = 0;

  Vec3<S> center;  ///< [length]
  S radius;        ///< [length] >= 0; 0 is a point
};
template <Scalar S> Sphere(Vec3<S>, S) -> Sphere<S>;

template <Scalar S> Vec3<S> center(const Sphere<S>& s) { return s.center; }
template <Scalar S> S skin_radius(const Sphere<S>& s) { return s.radius; }
template <Scalar S> S magnitude(const Sphere<S>& s) { return s.center.cwiseAbs().sum() + largest(s.radius); }
template <Scalar S> bool has_valid_sizes(const Sphere<S>& s) { return s.radius >= S(0); }
template <Scalar S> bool valid(const Sphere<S>& s) {
  return is_finite(s.center) && is_finite(s.radius) && has_valid_sizes(s);
}
template <Scalar S> Sphere<S> scaled(const Sphere<S>& s, int e) {
  return {times_power_of_two(s.center, e), times_power_of_two(s.radius, e)};
}
template <Scalar T, Scalar S> Sphere<T> cast(const Sphere<S>& s) {
  return {s.center.template cast<T>(), static_cast<T>(s.radius)};
}
template <Scalar S> Sphere<S> moved(const Sphere<S>& s, const Vec3<S>& by) { return {s.center + by, s.radius}; }
template <Scalar S> Vec3<S> half_widths(const Sphere<S>& s) { return Vec3<S>::Constant(s.radius); }
template <Scalar S> Vec3<S> contact_point(const Sphere<S>& s, const Vec3<S>& core_point, const Vec3<S>& outward) {
  return core_point + outward * s.radius;
}

template <Scalar S> bool cores_within(const Sphere<S>& a, const Sphere<S>& b, const S& reach) {
  return within<S>(b.center - a.center, reach);
}

/// Degenerate: coincident centers leave the normal to the caller.
template <Scalar S> CoreGap<S> core_gap(const Sphere<S>& a, const Sphere<S>& b) {
  CoreGap<S> gap;
  const Vec3<S> between = b.center - a.center;
  gap.distance = safe_norm(between);
  gap.normal = safe_unit(between);
  return gap;
}

template <Scalar S> std::optional<RayHit<S>> ray_entry(const Ray<S>& ray, const Sphere<S>& sphere) {
  const Entry<S> entry = ball_entry<S>(ray.origin - sphere.center, ray.direction, sphere.radius);
  if (entry.inside && ray.max_t >= S(0)) return RayHit<S>{S(0), ray.origin, Vec3<S>::Zero()};
  if (entry.inside || !(entry.time <= ray.max_t) || !is_finite(entry.time)) return std::nullopt;
  return RayHit<S>{entry.time, sphere.center + entry.normal * sphere.radius, entry.normal};
}

// ---- The clear rung (clear/clear_entry.hpp).

THINWALL_HOT ClearContact clear_contact(const Sphere<double>& a, const Sphere<double>& b) {
  using packed::Pair, packed::PairMask, packed::both, packed::all;
  const packed::Lanes between = packed::lanes(b.center) - packed::lanes(a.center);
  const Pair R = both(a.radius + b.radius), RR = R * R, square = dot(between, between), distance = root(square);
  const packed::Lanes normal = between / all(distance);
  const PairMask in_range = (both(packed::least_square) <= min(RR, square)) &
                            (max(RR, square) <= both(packed::most_square)) &
                            (both(0) <= packed::pair(a.radius, b.radius));
  return {all_of(in_range & clearly_apart(square, RR)),
          all_of(square < RR),
          normal * all(a.radius),
          (all(0) - normal) * all(b.radius),
          normal,
          R - distance};
}

/// Who asks for a ray turns on whether it hits, so most misses are told first, without a root or a division: the line passes the ball
/// by the textbook's discriminant, less what that loses, or leads away.
THINWALL_HOT ClearRayHit clear_raycast(const Ray<double>& ray, const Sphere<double>& sphere) {
  using packed::Pair, packed::PairMask, packed::both;
  const packed::Lanes center = packed::lanes(sphere.center), v = packed::lanes(ray.direction);
  const packed::Lanes p = packed::lanes(ray.origin) - center;
  const Pair of_v = two_sums(v * v, p * v), square = dot(p, p), R = both(sphere.radius), RR = R * R;
  const Pair speed = firsts(of_v), toward = seconds(of_v);
  const Pair clearance = square * both(1 - 0x1p-46) - RR * both(1 + 0x1p-9);
  const PairMask passes = toward * toward < speed * clearance;
  const PairMask leads_away = (both(0) <= toward) & (RR * both(packed::more_than_rounding) < square);
  const PairMask in_range =
      (both(packed::least_square) <= min(square, speed)) & (max(square, speed) <= both(packed::most_square));
  if (all_of((passes | leads_away) & in_range)) return ClearRayHit::miss();
  return clear_ray_hit(clear_ball_entry(p, v, R), square, speed, ray.max_t, center, sphere.radius);
}

}  // namespace thinwall
