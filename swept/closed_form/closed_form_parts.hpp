#pragma once
/// The closed form's options, and how an entry becomes the answer.

#include <string_view>

#include <thinwall/discrete/entry/ball_entry.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/swept/serves.hpp>

namespace thinwall {

/// Claims: exact to rounding.
/// Error: forward at most 4 u kappa t, backward at most 4 u; the time is late as often as early (docs/closed_forms.md).
/// Degenerate: no relative motion is `apart`, or `overlapping` if they touch.
template <Scalar S> struct ClosedForm {
  static constexpr std::string_view name = "closed_form";
  S min_separation = 0;  ///< [length] >= 0: a gap this small counts as contact
};

/// Turns an entry (its normal from A to B) into the answer; point(time) says where they touch.
template <class A, class B, Scalar T, class Point>
THINWALL_HOT Toi<T> toi_of(const Moving<A>& a, const Moving<B>& b, const Entry<T>& entry, const Point& point) {
  if (entry.inside) return overlapping_at_start(a, b, entry.rounds);
  if (entry.gave_up) return {ToiStatus::gave_up, entry.rounds, std::min(T(1), entry.time)};
  if (!(entry.time <= T(1))) return {ToiStatus::apart, entry.rounds};
  return {ToiStatus::hit, entry.rounds, entry.time, entry.normal, point(entry.time)};
}

/// Where a moving sphere touches something that lies along `outward` at `time`; the middle of the gap if there is one.
template <Scalar T>
Vec3<T> sphere_point(const Moving<Sphere<T>>& s, const T& time, const Vec3<T>& outward, const T& gap) {
  return (s.shape.center + s.displacement * time) + outward * (s.shape.radius + gap / 2);
}

/// The middle of the closest points at `time`.
template <class A, class B, Scalar T> Vec3<T> middle_point(const Moving<A>& a, const Moving<B>& b, const T& time) {
  return middle(separation(pose_at(a, time), pose_at(b, time)));
}

template <Scalar T> Entry<T> flipped(Entry<T> entry) {
  entry.normal = Vec3<T>::Zero() - entry.normal;
  return entry;
}

}  // namespace thinwall
