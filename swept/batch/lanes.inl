// Vectors of lanes: one row a lane, for whichever width this is compiled for. Included once a target, hence no `#pragma once`.
//
// A lane's verdict counts only where it is clear: where no rounding of the lane, nor any that the scalar code is allowed,
// could turn it. The other rows are marked and asked again in scalar code, so that verdicts are the scalar code's own.

#if defined(THINWALL_BATCH_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef THINWALL_BATCH_LANES
#undef THINWALL_BATCH_LANES
#else
#define THINWALL_BATCH_LANES
#endif

#include <limits>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V> struct Vec3Lanes {
  V x, y, z;
};

template <class V> HWY_INLINE Vec3Lanes<V> minus(const Vec3Lanes<V>& a, const Vec3Lanes<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class V> HWY_INLINE V dot(const Vec3Lanes<V>& a, const Vec3Lanes<V>& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
template <class V> HWY_INLINE Vec3Lanes<V> cross(const Vec3Lanes<V>& a, const Vec3Lanes<V>& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
template <class V> HWY_INLINE V largest(const Vec3Lanes<V>& a) {
  return hn::Max(hn::Abs(a.x), hn::Max(hn::Abs(a.y), hn::Abs(a.z)));
}

/// What a kernel says of each lane. A row that is none of the three is asked again.
template <class D> struct Verdict {
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  M hit, apart, overlapping;
  V time;  ///< of a hit, and of a miss
};

/// The scalar that a lane holds, and the bounds within which its verdicts are proven: docs/batches.md derives them.
template <class S> struct Bounds {
  static constexpr bool is_double = std::numeric_limits<S>::digits > 24;
  static constexpr S power(int e) {
    S x = 1;
    for (; e > 0; --e) x *= 2;
    for (; e < 0; ++e) x /= 2;
    return x;
  }
  static constexpr int p = std::numeric_limits<S>::digits;  // u = 2^-p
  static constexpr S touch = power(5 - p);                  // of squares: 32 u
  static constexpr S length = power(4 - p);                 // of lengths: 16 u
  static constexpr S graze =
      power(is_double ? -20 : -12);  // a chord whose half is below sqrt(this) R is left to scalar code
  static constexpr S far = power(10 - 2 * p + (is_double ? 20 : 12));  // 2^10 u^2 / graze
  static constexpr S end = power((is_double ? 15 : 11) - p);
  static constexpr S end_of_blur = power(is_double ? 12 : 8);  // 4 / sqrt(graze)
  static constexpr S least_place = power(is_double ? -400 : -32),
                     least_speed = power(is_double ? -400 : -48);  // squared
  static constexpr S most = power(is_double ? 400 : 60);           // squared
  static constexpr S least_length = power(is_double ? -200 : -16), most_length = power(is_double ? 200 : 30);
  static constexpr S least_capsule = power(is_double ? -100 : -8), most_capsule = power(is_double ? 100 : 12);
  static constexpr S still = power(is_double ? -300 : -60);
  static constexpr S latest = power(is_double ? 40 : 20);  // where an axis put up to that speed is not entered before
};

/// A line p + v t and a ball of radius R around the origin: discrete/entry/ball_entry.hpp's formulas, with what is clear.
/// `blur` [length] is how far each coordinate of p may be off beyond its own rounding.
template <class D> struct ChordLanes {
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  V speed_square, recess, half, time;  ///< recess: p.v, negative while the closest approach is ahead
  M outside, inside;                   ///< at the start, clearly
  M chord, none;                       ///< the line meets the ball, or does not, clearly
  M before_end, after_end;             ///< the entry is before time 1, or after it, clearly, where there is a chord
  M ordinary;                          ///< no square or product of squares overflows or vanishes
};

/// Where `blurred`, every coordinate of p may be off by `blur` [length] beyond its own rounding.
template <bool blurred = false, class D>
HWY_INLINE ChordLanes<D> chord_lanes(D d, const Vec3Lanes<hn::Vec<D>>& p, const Vec3Lanes<hn::Vec<D>>& v, hn::Vec<D> R,
                                     hn::Vec<D> blur) {
  using B = Bounds<hn::TFromD<D>>;
  const auto pp = dot(p, p), vv = dot(v, v), RR = hn::Mul(R, R);
  const auto m = cross(p, v);
  const auto mm = dot(m, m), reach = hn::Mul(RR, vv), pv = hn::Mul(pp, vv);
  const auto discriminant = hn::Sub(reach, mm);
  auto noise = hn::MulAdd(hn::Set(d, B::graze), reach, hn::Mul(hn::Set(d, B::far), pv));
  const auto excess = hn::Sub(pp, RR), size = hn::Add(pp, RR);
  auto touch = hn::Mul(hn::Set(d, B::touch), size);
  ChordLanes<D> out;
  out.speed_square = vv;
  out.recess = dot(p, v);
  out.half = hn::Sqrt(discriminant);  // NaN where there is no chord
  const auto denominator = hn::Sub(out.half, out.recess);
  out.time = hn::Div(excess, denominator);
  const auto late = hn::Sub(excess, denominator);
  auto end = hn::Mul(hn::Set(d, B::end), hn::Add(size, denominator));
  if constexpr (blurred) {
    using S = hn::TFromD<D>;
    const auto times = [&](S factor, hn::Vec<D> x) HWY_ATTR { return hn::Mul(hn::Mul(hn::Set(d, factor), x), blur); };
    const auto place = hn::Add(hn::Add(hn::Abs(p.x), hn::Abs(p.y)), hn::Add(hn::Abs(p.z), R));
    const auto path = hn::Add(place, hn::Add(hn::Abs(v.x), hn::Add(hn::Abs(v.y), hn::Abs(v.z))));
    touch = hn::Add(touch, times(4, place));
    noise = hn::MulAdd(hn::Add(times(4, R), times(8 / B::graze, blur)), vv, noise);
    end = hn::Add(end, times(B::end_of_blur, path));
  }
  out.outside = hn::Gt(excess, touch);
  out.inside = hn::Lt(excess, hn::Neg(touch));
  out.chord = hn::Gt(discriminant, noise);
  out.none = hn::Lt(discriminant, hn::Neg(noise));
  out.before_end = hn::Lt(late, hn::Neg(end));
  out.after_end = hn::Gt(late, end);
  const auto most = hn::Set(d, B::most);
  const auto sizes = hn::And(hn::Le(size, most), hn::Ge(size, hn::Set(d, B::least_place)));
  const auto speeds =
      hn::And(hn::Le(vv, most), hn::Or(hn::Ge(vv, hn::Set(d, B::least_speed)), hn::Eq(vv, hn::Zero(d))));
  out.ordinary = hn::And(sizes, speeds);
  return out;
}

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
