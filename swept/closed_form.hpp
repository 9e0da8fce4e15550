#pragma once
/// The exact time of impact: a ray against the Minkowski sum, one formula a pair.

#include <string_view>

#include <thinwall/swept/rounded_box_entry.hpp>
#include <thinwall/swept/serves.hpp>

namespace thinwall {

/// Claims: exact to rounding.
/// Error: forward at most 4 u kappa t, backward at most 4 u; the time is late as often as early (docs/closed_forms.md).
/// Degenerate: no relative motion is `apart`, or `overlapping` if they touch.
template <Scalar S> struct ClosedForm {
  static constexpr std::string_view name = "closed_form";
  S min_separation = 0;  ///< [length] >= 0: a gap this small counts as contact
};

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Sphere<T>>& a, const Moving<Sphere<T>>& b) {
  const T margin(method.min_separation);
  const BallEntry<T> entry = ball_entry<T>(b.shape.center - a.shape.center, relative_displacement(b, a),
                                           a.shape.radius + b.shape.radius + margin);
  if (entry.inside) return overlapping_at_start(a, b, 1);
  if (!(entry.time <= T(1))) return {ToiStatus::apart, 1};
  const Vec3<T> center_then = a.shape.center + a.displacement * entry.time;
  return {ToiStatus::hit, 1, entry.time, entry.normal, center_then + entry.normal * (a.shape.radius + margin / 2)};
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Aabb<T>>& box, const Moving<Sphere<T>>& sphere) {
  const T margin(method.min_separation);
  const RoundedBoxEntry<T> entry =
      rounded_box_entry<T>(sphere.shape.center - box.shape.center, relative_displacement(sphere, box),
                           box.shape.half_extents, sphere.shape.radius + margin);
  if (entry.inside) return overlapping_at_start(box, sphere, 1);
  if (!(entry.time <= T(1))) return {ToiStatus::apart, 1};
  const Vec3<T> center_then = sphere.shape.center + sphere.displacement * entry.time;
  return {ToiStatus::hit, 1, entry.time, entry.normal, center_then - entry.normal * (sphere.shape.radius + margin / 2)};
}

}  // namespace thinwall
