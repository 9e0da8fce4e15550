#pragma once
/// The last word on a hit: its time, once more, in a wider scalar.
///
/// The plane of contact, across the normal n, parts two translating shapes until they touch, and its gap is linear in time:
///
///   t = [ n.(c_B - c_A) - h_A(n) - h_B(-n) ] / n.(v_A - v_B),    h: how far a shape reaches from its center.
///
/// What rounding did to n counts in the second order only where the sum of the shapes is round, and on a flat face moves the
/// plane by a rounding of the face's size. So this brings an entry that has come through turned axes back to about one
/// rounding, and decides whether a contact near the end of the step is still in it.
///
/// Not for a graze: where the motion hardly closes the gap, the second order is not small. Nor where it would move the shapes by
/// more than roundings: a corner met without a radius has an answer but no plane of its own, a face that hardly closes would be
/// reached when another has passed, and the plane of a normal that is not quite a long face's is early by what it is off. Nor to where
/// it is not behind the body's other planes.
/// Source: derived in docs/closed_forms.md.

#include <limits>
#include <string_view>

#include <thinwall/discrete/entry/ball_entry.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/swept/moving.hpp>
#include <thinwall/swept/reach_along.hpp>
#include <thinwall/swept/serves.hpp>

namespace thinwall {

/// [1] What an axis of a box may lean from a right angle by roundings, those of a quaternion's included.
template <Scalar T> T most_lean() { return 16 * std::numeric_limits<T>::epsilon(); }

/// [length] By how much the face of a box whose normal is n, which is across its edges, is elsewhere than its own axis has it: what that leans
/// by roundings counts by all of the face.
template <Shape A, Scalar T> T lean_of_face(const A& shape, const Vec3<T>& n) {
  if constexpr (std::is_same_v<A, Obb<T>>) {
    for (int i = 0; i < 3; ++i) {
      const auto x = shape.axes.col((i + 1) % 3), y = shape.axes.col((i + 2) % 3), own = shape.axes.col(i);
      if (!(largest(T(n.dot(x)), T(n.dot(y))) <= most_lean<T>())) continue;
      const T off_x = largest(T(own.dot(x))), off_y = largest(T(own.dot(y)));
      return largest(off_x, off_y) <= most_lean<T>()
                 ? off_x * shape.half_extents[(i + 1) % 3] + off_y * shape.half_extents[(i + 2) % 3]
                 : T(0);
    }
  }
  return 0;
}

/// An entry's time as settled by its normal (unit, from A to B), or as it was, with `graze` set, where that may not be done.
/// The plane may move the shapes by two roundings of their size along the normal, or, where nothing wider has the last word, of all of it, by
/// which what was turned is off; and by what a box's face leans, or `off` [length].
template <class A, class B, Scalar T>
Entry<T> settled(const Moving<A>& narrow_a, const Moving<B>& narrow_b, const T& gap, Entry<T> entry,
                 const T& off = T(0)) {
  using W = Wider<T>;
  const auto a = cast<W>(narrow_a);
  const auto b = cast<W>(narrow_b);
  const Vec3<W> rounded = entry.normal.template cast<W>();
  const Vec3<W> n = rounded * ((W(3) - rounded.squaredNorm()) / W(2));  // unit to second order
  const Vec3<W> motion = relative_displacement(a, b);
  const W round = skin_radius(a.shape) + skin_radius(b.shape) + W(gap), closing = n.dot(motion);
  const W apart = n.dot(Vec3<W>(center(b.shape) - center(a.shape))) -
                  (reach_along(a.shape, n) + reach_along<W>(b.shape, -n) + W(gap));
  const W time = apart / closing, shift = largest(W(time - W(entry.time)));
  const bool second_order_is_small = 32 * shift * motion.squaredNorm() <= round * closing || round == W(0);
  const Vec3<T> paths = narrow_a.displacement.cwiseAbs() + narrow_b.displacement.cwiseAbs();
  const Vec3<T> sizes = coordinate_sizes(narrow_a.shape) + coordinate_sizes(narrow_b.shape) + paths * entry.time;
  constexpr int tiny = has_wider<T> ? -40 : -20;
  const T size = (has_wider<T> ? entry.normal.cwiseAbs().dot(sizes) : sizes.sum()) + gap;
  const T leans = lean_of_face<A, T>(narrow_a.shape, entry.normal) + lean_of_face<B, T>(narrow_b.shape, entry.normal);
  const T trusted = 2 * std::numeric_limits<T>::epsilon() * size + std::max(leans, off);
  const W outside = std::max(W(entry.not_before) - time, time - W(entry.not_after));
  // another plane's time may be known better than this one's: where a wider scalar can say which comes first, this may not pass it
  const W spare = has_wider<T> ? W(std::numeric_limits<T>::epsilon() * entry.time) : W(trusted) / largest(motion);
  const bool by_rounding =
      shift <= W(entry.time * constant_power_of_two<T, tiny>()) && W(shift * closing) <= W(trusted) && outside <= spare;
  entry.graze = !(closing > W(0)) || !second_order_is_small || !by_rounding;
  if (!entry.graze)
    entry.time = time > W(1) ? std::numeric_limits<T>::infinity() : static_cast<T>(std::max(W(0), time));
  return entry;
}

/// The unit vector n, but for what roundings lean it along an edge that it is across: that, times a long edge, is what its plane is early by.
template <Scalar T> Vec3<T> freed_of_lean(const Vec3<T>& n, const Vec3<T>& edge) {
  const Vec3<T> along = safe_unit(edge);
  const T lean = n.dot(along);
  return largest(lean) <= most_lean<T>() ? Vec3<T>(n - along * lean) : n;
}

template <Scalar T> Vec3<T> freed_of_leans(const Vec3<T>& n, const Obb<T>& box) {
  return freed_of_lean<T>(freed_of_lean<T>(freed_of_lean<T>(n, box.axes.col(0)), box.axes.col(1)), box.axes.col(2));
}

// ---- The closed form's options, and how an entry becomes the answer.

/// Claims: exact to rounding.
/// Error: forward at most 4 u kappa t, backward at most 4 u; the time is late as often as early (docs/closed_forms.md).
/// Degenerate: no relative motion is `apart`, or `overlapping` if they touch.
template <Scalar S = double> struct ClosedForm {
  static constexpr std::string_view name = "closed_form";
  S min_separation = 0;  ///< [length] >= 0: a gap this small counts as contact
};

/// The whole question in the wider scalar.
template <class Method, class A, class B, Scalar T = typename A::Scalar>
THINWALL_COLD Toi<T> toi_by_wider(const Method& method, const Moving<A>& a, const Moving<B>& b) {
  using W = Wider<T>;
  return cast<T>(impact(ClosedForm<W>{W(method.min_separation)}, widened<W>(a), widened<W>(b)));
}

template <class A>
concept AnyBox = requires(const A& shape) { shape.half_extents; };

/// The same of what is turned. The wider scalar answers of the nearest boxes of orthonormal axes: what those given lean from them counts by all
/// of an edge. So the plane in which two boxes meet settles the time once more, if it is across the edges given but for those that clearly lean.
template <class Method, class A, class B, Scalar T = typename A::Scalar>
THINWALL_COLD Toi<T> turned_toi_by_wider(const Method& method, const Moving<A>& a, const Moving<B>& b) {
  Toi<T> toi = toi_by_wider(method, a, b);
  if constexpr (AnyBox<A> && AnyBox<B>) {
    if (toi.status != ToiStatus::hit) return toi;
    const Obb<T> first = to_obb(a.shape), second = to_obb(b.shape);
    Entry<T> entry;
    entry.time = toi.time;
    entry.normal = freed_of_leans(freed_of_leans(toi.normal, first), second);
    bool is_plane = true;
    T off = 0;
    for (const Obb<T>& box : {first, second}) {
      const Vec3<T> leans = (box.axes.transpose() * entry.normal).cwiseAbs();
      for (int i = 0; i < 3; ++i) {
        const bool clearly = leans[i] >= constant_power_of_two<T, -10>();
        is_plane = is_plane && (clearly || leans[i] <= std::numeric_limits<T>::epsilon() / 4);
        if (clearly) off += most_lean<T>() * box.half_extents[i];
      }
    }
    const Entry<T> given = settled(a, b, T(method.min_separation), entry, off);
    if (is_plane && !given.graze && given.time <= T(1)) toi.time = given.time;
  }
  return toi;
}

/// Whether roundings may decide that an entry near the end of the step comes in time.
template <class A, class B, Scalar T>
bool is_end_in_doubt(const Moving<A>& a, const Moving<B>& b, const T& gap, const Entry<T>& entry) {
  const T from_end = largest(T(entry.time - T(1)));
  if (!(from_end <= constant_power_of_two<T, -10>()) || skin_radius(a.shape) + skin_radius(b.shape) + gap == T(0))
    return false;  // of what is not round times are found without roundings, or settled
  const Vec3<T> paths = a.displacement.cwiseAbs() + b.displacement.cwiseAbs();
  const T size = (coordinate_sizes(a.shape) + coordinate_sizes(b.shape) + paths).sum() + gap;
  const T closing = entry.normal.dot(relative_displacement(a, b));
  return !(16 * std::numeric_limits<T>::epsilon() * size < from_end * closing);
}

/// Turns an entry (its normal from A to B) into the answer; point(time) says where they touch. Near the end of the step the wider scalar says
/// whether they do; the time keeps its bits, which do not depend on where a step ends.
template <class Method, class A, class B, Scalar T, class Point>
Toi<T> toi_of(const Method& method, const Moving<A>& a, const Moving<B>& b, const Entry<T>& found, const Point& point) {
  if (found.inside) return overlapping_at_start(a, b, found.rounds);
  if (found.gave_up) return {ToiStatus::gave_up, found.rounds, std::min(T(1), found.time)};
  T time = found.time;
  if constexpr (has_wider<T>) {
    if (is_end_in_doubt(a, b, T(method.min_separation), found)) {
      const bool comes = toi_by_wider(method, a, b).status != ToiStatus::apart;
      time = comes ? std::min(T(1), time) : std::numeric_limits<T>::infinity();
    }
  }
  if (!(time <= T(1))) return {ToiStatus::apart, found.rounds};
  return {ToiStatus::hit, found.rounds, time, found.normal, point(time)};
}

/// Whether it slides along the plane that it is told to meet, but for roundings.
template <class A, class B, Scalar T>
bool hardly_closes(const Moving<A>& a, const Moving<B>& b, const Entry<T>& found) {
  const Vec3<T> motion = relative_displacement(a, b);
  return found.may_hit() && !(found.normal.dot(motion) > constant_power_of_two<T, -40>() * largest(motion));
}

/// The answer of a pair whose coordinates are not turned; from the wider scalar where it slides along what it is told to meet, or where a miss by
/// little leaves it in doubt, or which of two parts is met slowly, but not where that is long after the step.
template <class Method, class A, class B, Scalar T, class Point>
Toi<T> toi_or_wider(const Method& method, const Moving<A>& a, const Moving<B>& b, const Entry<T>& found,
                    const Point& point) {
  if constexpr (has_wider<T>) {
    const bool is_late = is_finite(found.time) && found.time > T(2);
    if ((found.graze && !is_late) || (!found.inside && hardly_closes(a, b, found))) return toi_by_wider(method, a, b);
  }
  return toi_of(method, a, b, found, point);
}

/// The same for a pair whose coordinates were turned into a box's axes: three roundings more each, and axes that are
/// orthonormal to rounding only. A hit is settled where that moves it by no more than a backward error of 4 u; all else, a graze too,
/// is asked in the wider scalar.
template <class Method, class A, class B, Scalar T, class Point>
Toi<T> toi_of_turned(const Method& method, const Moving<A>& a, const Moving<B>& b, const Entry<T>& found,
                     const Point& point) {
  if (found.inside || found.gave_up) return toi_of(method, a, b, found, point);
  const Entry<T> entry = found.may_hit() && !found.graze ? settled(a, b, T(method.min_separation), found) : found;
  if constexpr (has_wider<T>) {
    if (entry.graze) return turned_toi_by_wider(method, a, b);
  }
  return toi_of(method, a, b, entry, point);
}

/// Where a moving sphere touches something that lies along `outward` at `time`; the middle of the gap if there is one.
template <Scalar T>
Vec3<T> sphere_point(const Moving<Sphere<T>>& s, const T& time, const Vec3<T>& outward, const T& gap) {
  return (s.shape.center + s.displacement * time) + outward * (s.shape.radius + gap / 2);
}

/// The middle of the closest points at `time`.
template <class A, class B, Scalar T> Vec3<T> middle_point(const Moving<A>& a, const Moving<B>& b, const T& time) {
  return middle(separation_unchecked(pose_at(a, time), pose_at(b, time)));
}

template <Scalar T> Entry<T> flipped(Entry<T> entry) {
  entry.normal = Vec3<T>::Zero() - entry.normal;
  return entry;
}

}  // namespace thinwall
