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
/// more than `trust`: a corner met without a radius has an answer but no plane of its own, a face that hardly closes would be
/// reached when another has passed, and the plane of a normal that is not quite a long face's is early by what it is off.
/// Source: derived in docs/closed_forms.md.

#include <limits>
#include <type_traits>

#include <thinwall/discrete/entry/ball_entry.hpp>
#include <thinwall/swept/moving.hpp>
#include <thinwall/swept/reach_along.hpp>

namespace thinwall {

/// The scalar that has the last word: long double for double where it holds more digits, else S itself.
template <Scalar S>
using Wider =
    std::conditional_t<std::is_same_v<S, double> && (std::numeric_limits<long double>::digits > 60), long double, S>;
template <Scalar S> inline constexpr bool has_wider = !std::is_same_v<Wider<S>, S>;

/// An entry's time as settled by its normal (unit, from A to B), or as it was, with `graze` set, where that may not be done.
/// `trust`: by how much the plane may move the shapes, in roundings of their size as `std::numeric_limits` names one.
template <class A, class B, Scalar T>
Entry<T> settled(const Moving<A>& narrow_a, const Moving<B>& narrow_b, const T& gap, Entry<T> entry, int trust) {
  using W = Wider<T>;
  const auto a = cast<W>(narrow_a);
  const auto b = cast<W>(narrow_b);
  const Vec3<W> rounded = entry.normal.template cast<W>();
  const Vec3<W> n = rounded * ((W(3) - rounded.squaredNorm()) / W(2));  // unit to second order
  const Vec3<W> motion = relative_displacement(a, b);
  const W round = rounding(a.shape) + rounding(b.shape) + W(gap), closing = n.dot(motion);
  const W apart = n.dot(Vec3<W>(center(b.shape) - center(a.shape))) -
                  (reach_along(a.shape, n) + reach_along<W>(b.shape, -n) + W(gap));
  const W time = apart / closing, shift = largest(W(time - W(entry.time)));
  const bool second_order_is_small = 32 * shift * motion.squaredNorm() <= round * closing || round == W(0);
  const Vec3<T> paths = narrow_a.displacement.cwiseAbs() + narrow_b.displacement.cwiseAbs();
  const Vec3<T> sizes = coordinate_sizes(narrow_a.shape) + coordinate_sizes(narrow_b.shape) + paths * entry.time;
  const T size = entry.normal.cwiseAbs().dot(sizes) + gap, tiny = entry.time * constant_power_of_two<T, -40>();
  const T trusted = T(trust) * std::numeric_limits<T>::epsilon() * size;
  const bool by_rounding = shift <= W(tiny) && shift * closing <= W(trusted);
  entry.graze = !(closing > W(0)) || !second_order_is_small || !by_rounding;
  if (!entry.graze)
    entry.time = time > W(1) ? std::numeric_limits<T>::infinity() : static_cast<T>(std::max(W(0), time));
  return entry;
}

}  // namespace thinwall
