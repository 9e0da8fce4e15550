#pragma once
/// When a moving point first enters a ball around the origin: |p + v t| = R.
///
/// The textbook quadratic (v.v) t^2 + 2 (p.v) t + (p.p - R^2) = 0 loses u (|p|/R)^2 of its discriminant to
/// cancellation, and no better square root or fused multiply-add brings that back, because the coefficients themselves
/// are rounded. The perpendicular form does not cancel: with the moment q = p x v,
///
///   D = (v.v) R^2 - q.q,    t = (p.p - R^2) / (-p.v + sqrt(D)),    p + v t = (v x q - v sqrt(D)) / (v.v).
///
/// Error: forward at most 4 u kappa t, backward at most 4 u (docs/closed_forms.md).
/// Source: the perpendicular discriminant is Haines, Guenther, Akenine-Moeller, "Precision Improvements for Ray/Sphere
/// Intersection", Ray Tracing Gems, 2019, ch. 7; the position by moment is derived in docs/closed_forms.md.

#include <algorithm>
#include <limits>

#include <thinwall/discrete/numbers/double_word.hpp>
#include <thinwall/discrete/numbers/range.hpp>
#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// Where the discriminant is this small beside its terms, the line grazes the ball, and rounding may decide: it is computed
/// again in double-word arithmetic. Plain rounding moves it by a dozen u, which decides below 1e-15 and turns the time
/// of a graze by several u kappa t far above that.
template <Scalar S> S grazing_fraction() { return constant_power_of_two<S, -10>(); }

/// The chord that the line p + v t cuts from the ball of radius R around the origin.
template <Scalar S> struct Chord {
  bool exists = false;               ///< the line meets the closed ball
  S speed_square = 0;                ///< v.v
  S approach = 0;                    ///< -p.v: positive while the closest approach is ahead
  S excess = 0;                      ///< p.p - R^2: positive outside
  S half = 0;                        ///< sqrt(D), half the chord times |v|, where it exists
  Vec3<S> moment = Vec3<S>::Zero();  ///< p x v
  S per_length = 0;  ///< 1 / (v.v R); 0 where R is so small beside |p| that the moment's roundings count

  /// The time the line enters the ball, where the chord exists and the point is outside and approaching: before it is closest, also where
  /// all of them are rounding.
  S entry_time() const { return std::min(S(excess / (approach + half)), S(approach / speed_square)); }
  /// The direction of p + v t at that time; against the motion where R is zero. Its length is v.v R only as far as the moment,
  /// which loses the digits of a small ball far away, allows: there it is made unit as such, else by a step of Newton's, as the clear rung does.
  Vec3<S> entry_normal(const Vec3<S>& v) const {
    const Vec3<S> offset = cross(v, moment) - v * half;
    if (per_length > S(0)) {
      const Vec3<S> near_unit = offset * per_length;
      return near_unit * (S(1.5) - near_unit.squaredNorm() * S(0.5));
    }
    return offset == Vec3<S>::Zero() ? Vec3<S>(-safe_unit(v)) : safe_unit(offset);
  }
};

/// (v.v) R^2 - |p x v|^2 in twice the digits: right in sign, unless the true value is within a few u^2 of zero.
template <Scalar S> THINWALL_COLD S accurate_discriminant(const Vec3<S>& p, const Vec3<S>& v, const S& R) {
  const auto moment = [&](int i, int j) { return exact_product(p[i], v[j]) - exact_product(p[j], v[i]); };
  const auto square = [](const DoubleWord<S>& x) { return x * x; };
  const DoubleWord<S> speed = exact_product(v[0], v[0]) + exact_product(v[1], v[1]) + exact_product(v[2], v[2]);
  const DoubleWord<S> offset = square(moment(1, 2)) + square(moment(2, 0)) + square(moment(0, 1));
  const DoubleWord<S> difference = speed * exact_product(R, R) - offset;
  return difference.high;
}

/// Half the chord of a ball and an offset so small that their squares vanish; negative if there is none. They still
/// compare: rescales just these two.
template <Scalar S> THINWALL_COLD S half_of_tiny(const S& speed_square, const Vec3<S>& moment, const S& R) {
  using std::sqrt;
  const S speed = sqrt(speed_square);
  const int e = binary_exponent(largest(moment, S(R * speed)));
  const S radius = times_power_of_two(R, -e) * speed;
  const S D = radius * radius - times_power_of_two(moment, -e).squaredNorm();
  return D < S(0) ? D : times_power_of_two(S(sqrt(D)), e);
}

/// The same for the line past an edge along d: that of p x n, v x n and R, where n is the unit vector along d. It is
/// [ |v x d|^2 R^2 - (p.(v x d))^2 ] / |d|^2, from the numbers as given: no product is rounded before it counts.
template <Scalar S>
THINWALL_COLD S accurate_edge_discriminant(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& d, const S& R) {
  const Vec3<S> axis = times_power_of_two(d, -binary_exponent(largest(d)));  // for six factors, four are in range
  const auto turn = [&](int i, int j) { return exact_product(v[i], axis[j]) - exact_product(v[j], axis[i]); };
  const DoubleWord<S> x = turn(1, 2), y = turn(2, 0), z = turn(0, 1);
  const auto times = [](const S& a, const DoubleWord<S>& b) { return DoubleWord<S>{a, S(0)} * b; };
  const DoubleWord<S> offset = times(p[0], x) + times(p[1], y) + times(p[2], z);
  const DoubleWord<S> difference = (x * x + y * y + z * z) * exact_product(R, R) - offset * offset;
  return difference.high / axis.squaredNorm();
}

/// Requires p, v, R whose products of four are in range (products_in_range). accurate() is the discriminant in
/// twice the digits.
template <Scalar S, class Accurate>
Chord<S> chord_through_ball(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Accurate& accurate) {
  using std::sqrt;
  const S speed_square = v.squaredNorm();
  const Vec3<S> moment = cross(p, v);
  const S reach = speed_square * (R * R), offset = moment.squaredNorm(), size = std::max(reach, offset);
  S D = reach - offset, half;
  if (square_in_range(size)) {
    if (largest(D) <= grazing_fraction<S>() * size) D = accurate();
    half = sqrt(largest(D));
  } else {
    D = half = half_of_tiny(speed_square, moment, R);
  }
  const S square = p.squaredNorm(), RR = R * R;
  const bool is_near = square * constant_power_of_two<S, 2 - std::numeric_limits<S>::digits / 2 * 2>() < RR;
  const bool has_length = is_near && square_in_range(speed_square) && square_in_range(reach);
  const S per_length = has_length ? S(1) / (speed_square * R) : S(0);
  return {D >= S(0), speed_square, -p.dot(v), square - RR, half, moment, per_length};
}
template <Scalar S> Chord<S> chord_through_ball(const Vec3<S>& p, const Vec3<S>& v, const S& R) {
  return chord_through_ball(p, v, R, [&] { return accurate_discriminant(p, v, R); });
}

/// The first time at which a moving point is in a closed convex body. The vector comes first: it is written and read in pairs
/// of numbers, and a pair written across two others' places costs ten cycles to read.
template <Scalar S> struct Entry {
  Vec3<S> normal = Vec3<S>::Zero();             ///< unit, out of the body, where the point is at `time`
  S time = std::numeric_limits<S>::infinity();  ///< [1] >= 0; infinity: never
  S not_before = 0;  ///< [1] where known: from when it is behind all planes of the body but the last,
  S not_after = std::numeric_limits<S>::infinity();  ///< [1] and until when
  bool inside = false;                               ///< already so at time 0, touching included
  bool gave_up = false;                              ///< out of rounds; `time` is proven free
  bool graze = false;  ///< a few roundings of the coordinates may turn a miss into a hit, or back, or change the part
  int rounds = 1;      ///< how many closed forms were solved

  /// Not after the step by more than what is settled later may put right.
  bool may_hit() const { return time <= S(1) + constant_power_of_two<S, -10>(); }
  void come_later(const S& by) {
    time += by;
    not_before += by;
    not_after += by;
  }
};

/// entry_of(p, v, R, spans...) asked at a scale whose products of four are in range.
template <Scalar S, class EntryOf, class... Spans>
Entry<S> entry_at_safe_scale(const EntryOf& entry_of, const Vec3<S>& p, const Vec3<S>& v, const S& R,
                             const Spans&... spans) {
  const SafeScale<S> scale(largest(p, R, spans...), largest(v));
  if (scale.is_one()) return entry_of(p, v, R, spans...);
  Entry<S> entry = entry_of(scale.length(p), scale.displacement(v), scale.length(R), scale.length(spans)...);
  entry.time = scale.time_back(entry.time);
  entry.not_before = scale.time_back(entry.not_before);
  entry.not_after = scale.time_back(entry.not_after);
  return entry;
}

/// Requires lengths and displacements whose products of four are in range. accurate() is the discriminant in twice the digits.
template <Scalar S, class Accurate>
Entry<S> ball_entry_in_range(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Accurate& accurate) {
  Entry<S> entry;
  entry.inside = within(p, R);
  if (entry.inside) return entry;
  const Chord<S> chord = chord_through_ball(p, v, R, accurate);
  if (!chord.exists || chord.approach <= S(0)) return entry;
  entry.time = chord.entry_time();  // positive, as the excess is
  entry.normal = chord.entry_normal(v);
  return entry;
}

/// Degenerate: R = 0 is a point, hit only where the line runs exactly through it (normal against the motion);
/// v = 0 never enters.
template <Scalar S> Entry<S> ball_entry(const Vec3<S>& p, const Vec3<S>& v, const S& R) {
  const auto in_range = [](const Vec3<S>& from, const Vec3<S>& along, const S& reach) {
    return ball_entry_in_range(from, along, reach, [&] { return accurate_discriminant(from, along, reach); });
  };
  return entry_at_safe_scale<S>(in_range, p, v, R);
}

/// The same by a better accurate(), for as long as products are in range.
template <Scalar S, class Accurate>
Entry<S> ball_entry(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Accurate& accurate) {
  const bool in_range = SafeScale<S>(largest(p, R), largest(v)).is_one();
  return in_range ? ball_entry_in_range(p, v, R, accurate) : ball_entry(p, v, R);
}

}  // namespace thinwall
