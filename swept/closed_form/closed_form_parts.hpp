#pragma once
/// The closed form's options, and how an entry becomes the answer.

#include <string_view>

#include <thinwall/discrete/entry/ball_entry.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/swept/closed_form/settled.hpp>
#include <thinwall/swept/serves.hpp>

namespace thinwall {

/// Claims: exact to rounding.
/// Error: forward at most 4 u kappa t, backward at most 4 u; the time is late as often as early (docs/closed_forms.md).
/// Degenerate: no relative motion is `apart`, or `overlapping` if they touch.
template <Scalar S> struct ClosedForm {
  static constexpr std::string_view name = "closed_form";
  S min_separation = 0;  ///< [length] >= 0: a gap this small counts as contact
};

/// Whether an entry near the end of the step comes in time must not be decided by roundings. Its time keeps its bits, which do
/// not depend on where a step ends.
template <class A, class B, Scalar T>
THINWALL_COLD T settled_near_end(const Moving<A>& a, const Moving<B>& b, const T& gap, const Entry<T>& entry) {
  if (rounding(a.shape) + rounding(b.shape) + gap == T(0)) return entry.time;  // found without roundings, or settled
  const Entry<T> last_word = settled(a, b, gap, entry);
  if (last_word.graze) return entry.time;
  return last_word.time <= T(1) ? std::min(T(1), entry.time) : last_word.time;
}

/// Turns an entry (its normal from A to B, `gap` the minimal separation) into the answer; point(time) says where they touch.
template <class A, class B, Scalar T, class Point>
THINWALL_HOT Toi<T> toi_of(const Moving<A>& a, const Moving<B>& b, const T& gap, const Entry<T>& found,
                           const Point& point) {
  if (found.inside) return overlapping_at_start(a, b, found.rounds);
  if (found.gave_up) return {ToiStatus::gave_up, found.rounds, std::min(T(1), found.time)};
  Entry<T> entry = found;
  if constexpr (has_wider<T>) {
    if (largest(T(entry.time - T(1))) <= constant_power_of_two<T, -10>()) {
      entry.time = settled_near_end(a, b, gap, entry);
    }
  }
  if (!(entry.time <= T(1))) return {ToiStatus::apart, entry.rounds};
  return {ToiStatus::hit, entry.rounds, entry.time, entry.normal, point(entry.time)};
}

/// The whole question in the wider scalar.
template <class Method, class A, class B, Scalar T>
THINWALL_COLD Toi<T> toi_by_wider(const Method& method, const Moving<A>& a, const Moving<B>& b) {
  using W = Wider<T>;
  const auto toi = impact(ClosedForm<W>{W(method.min_separation)}, cast<W>(a), cast<W>(b));
  return {toi.status, toi.evaluations, static_cast<T>(toi.time), toi.normal.template cast<T>(),
          toi.point.template cast<T>()};
}

/// The same for a pair whose coordinates were turned into a box's axes: three roundings more each, and axes that are
/// orthonormal to rounding only. A hit is settled, and what may be a graze is asked in the wider scalar.
template <class Method, class A, class B, Scalar T, class Point>
Toi<T> toi_of_turned(const Method& method, const Moving<A>& a, const Moving<B>& b, const Entry<T>& found,
                     const Point& point) {
  Entry<T> entry = found;
  if constexpr (has_wider<T>) {
    const bool hit = !entry.inside && !entry.gave_up && entry.time <= T(1) + constant_power_of_two<T, -10>();
    if (hit && !entry.graze) entry = settled(a, b, T(method.min_separation), entry);
    if (entry.graze && !entry.inside) return toi_by_wider<Method, A, B, T>(method, a, b);
  }
  return toi_of(a, b, T(method.min_separation), entry, point);
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
