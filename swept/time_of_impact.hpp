#pragma once
/// The front door of every time of impact: puts the later shape first (and flips the answer back), checks the input, keeps
/// coordinates near the largest number from overflowing, computes a float query in double; and of the closed form, the ladder.

#include <algorithm>
#include <limits>
#include <type_traits>

#include <thinwall/swept/clear/clear_impact.hpp>
#include <thinwall/swept/methods/closed_form.hpp>

namespace thinwall {

/// The same question with every length divided by 2^huge_exponent, for coordinates near the largest number.
template <class Method, Shape A, Shape B>
THINWALL_COLD Toi<typename A::Scalar> impact_scaled_down(Method method, const Moving<A>& a, const Moving<B>& b) {
  using std::ldexp;
  method.min_separation = ldexp(method.min_separation, -huge_exponent);
  Toi<typename A::Scalar> toi = impact(method, scaled(a, -huge_exponent), scaled(b, -huge_exponent));
  toi.point = times_power_of_two(toi.point, huge_exponent);
  return toi;
}

/// What `method` says of any input: checked, kept from overflowing, and in double for float. The shape of later rank comes first.
template <class Method, Shape A, Shape B>
THINWALL_HOT Toi<typename A::Scalar> checked_impact(const Method& method, const Moving<A>& a, const Moving<B>& b) {
  using S = typename A::Scalar;
  const bool has_valid_option = method.min_separation >= 0 && is_finite(method.min_separation);
  const Magnitudes sizes = magnitudes_of(S(magnitude(a) + magnitude(b) + S(method.min_separation)), a, b);
  if (sizes == Magnitudes::invalid || !has_valid_option) return invalid_toi<S>();
  if constexpr (std::is_same_v<S, float>) {  // boxes as they are: by other axes, what is never late might be
    return cast<float>(impact(method, cast<double>(a), cast<double>(b)));
  } else {
    return sizes == Magnitudes::ordinary ? impact(method, a, b) : impact_scaled_down(method, a, b);
  }
}

/// The careful rung, out of the way of the clear one; which is asked once more, at a size near 1, what it may have left for its size alone (that
/// of the smallest part of a question counts, the largest is known), so that the unit of length changes no bit; but where a part is below 2^-60 of
/// the whole it may.
template <Shape A, Shape B>
[[gnu::noinline]] Toi<double> careful_impact(const ClosedForm<double>& method, const Moving<A>& a, const Moving<B>& b) {
  const double lengths = extent(a.shape) + extent(b.shape),
               paths = a.displacement.cwiseAbs().sum() + b.displacement.cwiseAbs().sum();
  const double size = std::max(lengths, paths);
  const bool alike = 0x1p-60 * size < std::min(lengths, paths);  // what a power of two flushes is nothing beside them
  // asked before, as a size below zero might be flushed
  const bool is_question = valid(a) && valid(b) && method.min_separation >= 0;
  if (is_question && alike && (size < 0x1p-20 || size > 0x1p20)) {
    const int e = binary_exponent(size);
    const ClearToi answer = clear_impact(scaled(a, -e), scaled(b, -e), times_power_of_two(method.min_separation, -e));
    Toi<double> toi = answer.toi();
    toi.point = times_power_of_two(toi.point, e);
    if (answer.clear) return toi;
  }
  return checked_impact(method, a, b);
}

/// How far shapes are apart at the start, of which that is not clear: careful where it is clear that they overlap, as of turned boxes of which
/// two ways out are as short, else infinitely far.
template <Shape A, Shape B> [[gnu::noinline]] Separation<double> doubtful_start(const A& a, const B& b) {
  if constexpr (HasClearOverlap<A, B>) {
    const ClearOverlap overlap = clear_overlap(a, b);
    if (overlap.clear && overlap.overlaps) return careful_separation(a, b);
  }
  return {.distance = std::numeric_limits<double>::infinity()};
}

/// What has no clear time: it overlaps clearly at the start, or is the careful rung's.
template <Shape A, Shape B>
[[gnu::noinline]] Toi<double> doubtful_impact(const ClosedForm<double>& method, const Moving<A>& a,
                                              const Moving<B>& b) {
  if (method.min_separation == 0) {
    const Separation<double> start =
        clear_separation_or(a.shape, b.shape, [&] { return doubtful_start(a.shape, b.shape); });
    if (start.distance <= 0 && is_finite(a.displacement) && is_finite(b.displacement))
      return overlapping_at_start(start, 1);
  }
  return careful_impact(method, a, b);
}

/// A float's query, of the ladder in double. In a function of its own: GCC 12 at -O3 leaves out a caller's rounding to float where the
/// conversion back is inlined beside it.
template <Shape A, Shape B>
[[gnu::noinline]] Toi<float> impact_in_double(const ClosedForm<float>& method, const Moving<A>& a, const Moving<B>& b);

/// The closed form's ladder. The clear rung answers in plain arithmetic what no rounding can decide (swept/clear/, discrete/clear/):
/// nearly everything; and then whether the two overlap at the start. The rest is asked of the careful rung (swept/closed_form/), which asks
/// itself once more in a wider scalar where even it is in doubt. A float's query climbs in double. docs/closed_forms.md draws it.
/// Given A and B the other way round, the answer is `turned`: a clear one while it is in registers.
template <bool turned = false, class Method, Shape A, Shape B>
THINWALL_HOT Toi<typename A::Scalar> impact_by_ladder(const Method& method, const Moving<A>& a, const Moving<B>& b) {
  const auto turn = [](const Toi<typename A::Scalar>& toi) { return turned ? flipped(toi) : toi; };
  if constexpr (std::is_same_v<Method, ClosedForm<double>> && HasClearImpact<A, B>) {
    ClearToi answer = clear_impact(a, b, method.min_separation);
    if (turned) answer.normal = packed::all(0) - answer.normal;
    if (answer.clear) [[likely]]
      return answer.toi();
    return turn(doubtful_impact(method, a, b));
  } else if constexpr (std::is_same_v<typename A::Scalar, float> && std::is_same_v<Method, ClosedForm<float>>) {
    return turn(impact_in_double(method, a, b));
  } else {
    return turn(checked_impact(method, a, b));
  }
}

template <Shape A, Shape B>
Toi<float> impact_in_double(const ClosedForm<float>& method, const Moving<A>& a, const Moving<B>& b) {
  if (!has_valid_axes(a) || !has_valid_axes(b)) return invalid_toi<float>();  // in double they would be mended
  const ClosedForm<double> in_double{method.min_separation};
  return cast<float>(impact_by_ladder(in_double, widened<double>(a), widened<double>(b)));
}

/// When A and B first touch during the step, by `method`.
/// Returns `invalid` with time NaN for a NaN, an infinity, a negative size, axes that are not orthonormal (valid()) or a
/// negative min_separation.
/// Degenerate: touching at the start is `overlapping` with time 0, whatever the motion; no relative motion is `apart`, or
/// `overlapping` if they touch. Not by EndOfStep and Substeps, which look only at the poses they sample, as those are rounded.
/// Passing A and B the other way round flips the normal and changes nothing else; where both are of one kind, the time may differ by the
/// method's error.
template <class Method, Shape A, Shape B>
THINWALL_HOT Toi<typename A::Scalar> time_of_impact(const Method& method, const Moving<A>& a, const Moving<B>& b) {
  static_assert(std::same_as<typename A::Scalar, typename B::Scalar>, "both shapes must have the same scalar");
  static_assert(serves<Method, A, B>, "this method does not serve this pair of shapes");
  if constexpr (A::rank < B::rank) {
    return impact_by_ladder<true>(method, b, a);
  } else {
    return impact_by_ladder(method, a, b);
  }
}

/// When A and B first touch during the step, exact to rounding.
template <Shape A, Shape B>
THINWALL_HOT Toi<typename A::Scalar> time_of_impact(const Moving<A>& a, const Moving<B>& b) {
  return time_of_impact(ClosedForm<typename A::Scalar>{}, a, b);
}

}  // namespace thinwall
