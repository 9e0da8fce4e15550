#pragma once
/// When a moving point first meets a flat set, decided without rounding: the slow path of flat_entry.hpp.
/// It is asked in a scalar W that holds the products of seven of the numbers given, however small some of them are beside others.
///
/// Each case comes down to conditions that are linear in the time t alone:
///   across the plane:    the height is zero at one t, and there alpha, beta and their limits hold;
///   within the plane:    alpha and beta are linear in t, seen along the axis on which the set has most area;
///   a set of no area:    a stretch of a line, or a point, on which the distance from the line is zero.

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>

#include <thinwall/discrete/entry/ball_entry.hpp>
#include <thinwall/discrete/numbers/exact_number.hpp>

namespace thinwall {

/// { alpha * e1 + beta * e2 } with alpha, beta >= 0.
enum class FlatShape {
  triangle,       ///< alpha + beta <= 1
  parallelogram,  ///< alpha, beta <= 1
};

/// The times from first to last that satisfy every condition so far, as fractions; a denominator of zero is infinity.
template <Scalar S> struct ExactStretch {
  ExactNumber<S> first = S(0), first_denominator = S(1);
  ExactNumber<S> last, last_denominator = S(1);
  Vec3<S> edge = Vec3<S>::Zero();  ///< what the condition that set `first` came with
  bool empty = false;

  explicit ExactStretch(const S& latest) : last(latest) {
    if (!is_finite(latest)) last = S(1), last_denominator = S(0);
  }

  /// constant + slope * t >= 0.
  void not_negative(const ExactNumber<S>& constant, const ExactNumber<S>& slope,
                    const Vec3<S>& its_edge = Vec3<S>::Zero()) {
    if (slope.sign() == 0) empty = empty || constant.sign() < 0;
    if (slope.sign() > 0 && (constant * first_denominator + first * slope).sign() < 0) {
      first = -constant;
      first_denominator = slope;
      edge = its_edge;
    }
    if (slope.sign() < 0 && (constant * last_denominator + last * slope).sign() < 0) {
      last = constant;
      last_denominator = -slope;
    }
    empty = empty || (last * first_denominator - first * last_denominator).sign() < 0;
  }
  void zero(const ExactNumber<S>& constant, const ExactNumber<S>& slope) {
    not_negative(constant, slope);
    not_negative(-constant, -slope);
  }
};

/// alpha, beta >= 0 and their limits, each times `unit` > 0 and linear in t.
template <Scalar S>
void within_flat_shape(ExactStretch<S>& stretch, FlatShape shape, const std::array<ExactNumber<S>, 2>& alpha,
                       const std::array<ExactNumber<S>, 2>& beta, const ExactNumber<S>& unit, const Vec3<S>& e1,
                       const Vec3<S>& e2) {
  stretch.not_negative(alpha[0], alpha[1], e2);
  stretch.not_negative(beta[0], beta[1], e1);
  if (shape == FlatShape::triangle) {
    stretch.not_negative(unit - alpha[0] - beta[0], -(alpha[1] + beta[1]), e2 - e1);
  } else {
    stretch.not_negative(unit - alpha[0], -alpha[1], e2);
    stretch.not_negative(unit - beta[0], -beta[1], e1);
  }
}

/// e1 and e2 are parallel: on the line along `e`, the longer of them, the set is a stretch; without length a point.
template <Scalar S>
void within_line(ExactStretch<S>& stretch, FlatShape shape, const ExactVec<S>& p, const ExactVec<S>& v,
                 const Vec3<S>& e1, const Vec3<S>& e2, const Vec3<S>& e) {
  int k = 0;
  e.cwiseAbs().maxCoeff(&k);
  if (e[k] == S(0)) {
    for (std::size_t i = 0; i < 3; ++i) stretch.zero(p[i], v[i]);
    return;
  }
  const ExactVec<S> aside = cross(p, exact_vector(e)), drift = cross(v, exact_vector(e));
  for (std::size_t i = 0; i < 3; ++i) stretch.zero(aside[i], drift[i]);
  const S zero(0), lower1 = std::min(zero, e1[k]), lower2 = std::min(zero, e2[k]);
  const S upper1 = std::max(zero, e1[k]), upper2 = std::max(zero, e2[k]);
  const bool one = shape == FlatShape::triangle;
  ExactNumber<S> lower = one ? std::min(lower1, lower2) : lower1, upper = one ? std::max(upper1, upper2) : upper1;
  if (!one) lower += lower2, upper += upper2;
  const std::size_t axis = static_cast<std::size_t>(k);
  stretch.not_negative(p[axis] - lower, v[axis]);
  stretch.not_negative(upper - p[axis], -v[axis]);
}

/// First time t in [0, latest] at which p + v t is in the set; infinity if there is none. Requires that products of seven do not leave the
/// range. An end so late that what is multiplied by it leaves the range is none; who asks compares the time with it.
/// Error: the verdict is right; the time is off by a few u of itself.
template <Scalar S>
Entry<S> exact_flat_entry(FlatShape shape, const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& e1, const Vec3<S>& e2,
                          const S& latest) {
  using Pair = std::array<ExactNumber<S>, 2>;
  constexpr int far = std::numeric_limits<S>::max_exponent / 3;
  const S last = latest < constant_power_of_two<S, far>() ? latest : std::numeric_limits<S>::infinity();
  const ExactVec<S> P = exact_vector(p), V = exact_vector(v), E1 = exact_vector(e1), E2 = exact_vector(e2);
  const ExactVec<S> normal = cross(E1, E2);
  const Vec3<S> plain_normal(normal[0].rounded(), normal[1].rounded(), normal[2].rounded());
  const ExactNumber<S> climb = dot(V, normal);
  const Vec3<S> along = largest(e1) < largest(e2) ? e2 : e1;
  int k = 0;
  plain_normal.cwiseAbs().maxCoeff(&k);
  const bool area = plain_normal[k] != S(0), across = climb.sign() != 0;
  ExactStretch<S> stretch(last);
  if (area) stretch.zero(dot(P, normal), climb);
  if (stretch.empty) return {};
  if (across) {
    const ExactNumber<S> side = S(climb.sign());
    const ExactVec<S> moment = cross(V, P);
    within_flat_shape<S>(stretch, shape, Pair{side * dot(moment, E2)}, Pair{-(side * dot(moment, E1))}, side * climb,
                         e1, e2);
  } else if (area) {
    const std::size_t i = static_cast<std::size_t>(k + 1) % 3, j = static_cast<std::size_t>(k + 2) % 3;
    const ExactNumber<S> side = S(plain_normal[k] > S(0) ? 1 : -1);
    const auto turn = [&](const ExactVec<S>& a, const ExactVec<S>& b) { return side * (a[i] * b[j] - a[j] * b[i]); };
    within_flat_shape<S>(stretch, shape, Pair{turn(P, E2), turn(V, E2)}, Pair{turn(E1, P), turn(E1, V)}, turn(E1, E2),
                         e1, e2);
  } else {
    within_line(stretch, shape, P, V, e1, e2, along);
  }
  if (stretch.empty) return {};
  Entry<S> entry;
  entry.inside = stretch.first.sign() == 0;
  if (entry.inside) return entry;
  entry.time = std::min(last, S(stretch.first.rounded() / stretch.first_denominator.rounded()));
  const Vec3<S> out = across ? plain_normal : area ? cross(stretch.edge, plain_normal) : cross(along, cross(along, v));
  entry.normal = out.dot(v) > S(0) ? Vec3<S>(-safe_unit(out)) : safe_unit(out);
  if (out == Vec3<S>::Zero()) entry.normal = -safe_unit(v);
  return entry;
}

/// Holds the products of seven numbers of S that are not tiny beside each other.
template <Scalar S> using Exact = std::conditional_t<std::is_same_v<S, float>, double, S>;
/// Those of any: long double has fifteen times double's exponents.
template <Scalar S> using ExactOfAny = Wider<Exact<S>>;

/// Not so small beside `size` that a product of seven would lose its last digit in Exact<S>.
template <Scalar S> bool has_products_of_seven(const S& x, const S& size) {
  using Limits = std::numeric_limits<Exact<S>>;
  constexpr int digits = std::numeric_limits<S>::digits;
  constexpr int lowest = Limits::min_exponent / 7 - Limits::digits / 7 + digits;
  return x == S(0) || largest(x) >= size * constant_power_of_two<S, lowest>();
}
template <Scalar S> bool has_products_of_seven(const Vec3<S>& v, const S& size) {
  return has_products_of_seven(v[0], size) && has_products_of_seven(v[1], size) && has_products_of_seven(v[2], size);
}

/// A vector whose largest number, or one beside it, has this exponent, without it.
template <class W, Scalar S> Vec3<W> near_one(const Vec3<S>& x, int exponent) {
  return times_power_of_two<W>(x.template cast<W>(), -exponent);
}

/// exact_flat_entry in the scalar W, of lengths and displacements brought near 1.
template <class W, Scalar S>
THINWALL_COLD Entry<S> exact_flat_entry_by(FlatShape shape, const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& e1,
                                           const Vec3<S>& e2, const S& latest) {
  const int length = binary_exponent(largest(p, e1, e2)), displacement = binary_exponent(largest(v));
  const Entry<W> found =
      exact_flat_entry<W>(shape, near_one<W>(p, length), near_one<W>(v, displacement), near_one<W>(e1, length),
                          near_one<W>(e2, length), times_power_of_two(W(latest), displacement - length));
  Entry<S> entry;
  entry.inside = found.inside;
  entry.time = static_cast<S>(times_power_of_two(found.time, length - displacement));
  entry.normal = found.normal.template cast<S>();
  return entry;
}

/// exact_flat_entry of any numbers: in S itself, or wider where some are tiny beside others.
template <Scalar S>
Entry<S> exact_flat_entry_of_any(FlatShape shape, const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& e1,
                                 const Vec3<S>& e2, const S& latest) {
  const S size = largest(p, e1, e2), speed = largest(v);
  const bool is_held = has_products_of_seven(p, size) && has_products_of_seven(e1, size) &&
                       has_products_of_seven(e2, size) && has_products_of_seven(v, speed) &&
                       has_products_of_seven(S(latest * speed), size);
  const auto exact_entry = is_held ? &exact_flat_entry_by<Exact<S>, S> : &exact_flat_entry_by<ExactOfAny<S>, S>;
  return exact_entry(shape, p, v, e1, e2, latest);
}

}  // namespace thinwall
