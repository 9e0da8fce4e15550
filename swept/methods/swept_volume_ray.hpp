#pragma once
/// The swept sphere's capsule decides whether, a ray from its center decides when.

#include <limits>
#include <string_view>

#include <thinwall/swept/methods/centre_ray.hpp>
#include <thinwall/swept/swept_volume.hpp>

namespace thinwall {

/// If the capsule that the sphere sweeps, seen from the other body, overlaps that body's true shape, there is a hit: at
/// the time the ray from the center along the motion meets that shape, or where it misses, at the closest approach.
/// Claims: approximate. The verdict is right to rounding; the time is late by the radius over the cosine of incidence,
/// at most until the closest approach.
/// Degenerate: of two spheres the one that travels farther is swept.
template <Scalar S = double> struct SweptVolumeRay {
  static constexpr std::string_view name = "swept_volume_ray";
  S min_separation = 0;  ///< [length] >= 0: a gap this small counts as contact
};

/// The same of a triangle. Where the core pierces it, to rounding, it is closest where it crosses the plane, or next to an
/// edge if it runs in the plane: whichever point of the core turns out to be nearest.
template <Scalar S> S closest_core_parameter(const Capsule<S>& capsule, const Triangle<S>& triangle) {
  const PrismPart<S> closest = closest_on_core_and_triangle(capsule, triangle);
  if (!closest.part.contains_point()) return closest.s;
  const Vec3<S> normal = plane_normal(triangle), x = capsule.a - triangle.a, core = capsule.b - capsule.a;
  const Vec3<S> e1 = triangle.b - triangle.a, e2 = triangle.c - triangle.a, along = e2 - e1;
  const S height = normal.dot(x), rise = normal.dot(core);
  S nearest = closest.s, least = std::numeric_limits<S>::infinity();
  for (const S& s : {rise == S(0) ? closest.s : clamp01(S(-height / rise)), closest_on_segments<S>(x, e1, core).t,
                     closest_on_segments<S>(x, e2, core).t, closest_on_segments<S>(x - e1, along, core).t}) {
    const S distance = safe_norm<S>(gap_from_triangle<S>(x + core * s, triangle));
    if (!(distance < least)) continue;
    least = distance;
    nearest = s;
  }
  return nearest;
}

/// The normal points from the sphere to the target.
template <Scalar T, Shape B>
Toi<T> sweep_and_cast(const Moving<Sphere<T>>& sphere, const Moving<B>& target, const T& margin) {
  if (overlaps_unchecked(sphere.shape, target.shape, margin)) return overlapping_at_start(sphere, target, 1);
  const Vec3<T> motion = relative_displacement(sphere, target);
  if (motion == Vec3<T>::Zero()) return {ToiStatus::apart, 1};
  const Capsule<T> swept = swept_volume(Moving<Sphere<T>>{sphere.shape, motion});
  if (!overlaps_unchecked(swept, target.shape, margin)) return {ToiStatus::apart, 2};
  Toi<T> toi = cast_center<T>(sphere, target);
  if (toi.status == ToiStatus::hit) {
    toi.evaluations = 3;
    return toi;
  }
  const T time = closest_core_parameter(swept, target.shape);
  const Separation<T> closest = separation_unchecked(pose_at(sphere, time), pose_at(target, time));
  return {ToiStatus::hit, 4, time, closest.normal, middle(closest)};
}

template <Scalar S, Scalar T>
Toi<T> impact(const SweptVolumeRay<S>& method, const Moving<Sphere<T>>& a, const Moving<Sphere<T>>& b) {
  const T margin(method.min_separation);
  return first_shoots(a, b) ? sweep_and_cast(a, b, margin) : flipped(sweep_and_cast(b, a, margin));
}

template <Scalar S, Shape B, Scalar T>
  requires ServedPair<Capsule<T>, B>
Toi<T> impact(const SweptVolumeRay<S>& method, const Moving<B>& target, const Moving<Sphere<T>>& sphere) {
  return flipped(sweep_and_cast(sphere, target, T(method.min_separation)));
}

}  // namespace thinwall
