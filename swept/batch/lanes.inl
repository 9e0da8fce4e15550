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

/// Three of the columns of a body, from the k-th on.
template <class Columns> HWY_INLINE auto vector_at(const Columns& columns, int k) {
  return Vec3Lanes<decltype(columns(0))>{columns(k), columns(k + 1), columns(k + 2)};
}
template <class V> HWY_INLINE Vec3Lanes<V> minus(const Vec3Lanes<V>& a, const Vec3Lanes<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class V> HWY_INLINE Vec3Lanes<V> plus(const Vec3Lanes<V>& a, const Vec3Lanes<V>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
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

template <class V> HWY_INLINE V smallest(const Vec3Lanes<V>& a) { return hn::Min(a.x, hn::Min(a.y, a.z)); }

/// Of absolute values.
template <class V> HWY_INLINE V sum(const Vec3Lanes<V>& a) {
  return hn::Add(hn::Add(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z));
}

/// What a kernel says of each lane. A row that is not clear is asked again; a clear one that is neither hit nor overlapping is apart.
template <class D> struct Verdict {
  hn::Mask<D> clear, hit, overlapping;
  hn::Vec<D> time;  ///< of a hit, and of a miss
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
  static constexpr S upright = power(4 - p);                // of all six products of a box's axes together
  static constexpr S graze =
      power(is_double ? -20 : -12);  // a chord whose half is below sqrt(this) R is left to scalar code
  static constexpr S far = power(10 - 2 * p + (is_double ? 20 : 12));  // 2^10 u^2 / graze
  static constexpr S end = power((is_double ? 15 : 11) - p);
  static constexpr S end_of_blur = power(is_double ? 12 : 8);  // 4 / sqrt(graze)
  static constexpr S least_square = power(is_double ? -400 : -80), least_reach = power(is_double ? -1000 : -120);
  static constexpr S least_length = power(is_double ? -200 : -16), most_length = power(is_double ? 200 : 30);
  static constexpr S least_capsule = power(is_double ? -100 : -8), most_capsule = power(is_double ? 100 : 12);
  static constexpr S still =
      power(is_double ? -300 : -60);                       // the least speed of a slab: what is slower is put up to it
  static constexpr S latest = power(is_double ? 40 : 20);  // before that time no slab of that speed is entered or left
};

/// How far the numbers of a chord may be off beyond their own rounding.
template <class D> struct Blur {
  hn::Vec<D> place;  ///< [length] of every coordinate of p
  hn::Vec<D> path;   ///< [length] sum of abs(v)
};

/// A line p + v t and a ball of radius R around the origin: discrete/entry/ball_entry.hpp's formulas, with what is clear. What is
/// out of range, or no number, is not: it makes `touch` infinite or NaN, and nothing is above that.
template <class D> struct ChordLanes {
  using V = hn::Vec<D>;
  V time;    ///< [1] of entry
  V excess;  ///< [length^2] above 0 outside the ball at the start
  V touch;   ///< what that is clearly above, or below the negative of
  V sure;    ///< above 0 where it is clear whether the line meets the ball, and whether before time 1
  hn::Mask<D> pierces, in_time, toward;
};

template <class D>
HWY_INLINE ChordLanes<D> chord_lanes(D d, const Vec3Lanes<hn::Vec<D>>& p, const Vec3Lanes<hn::Vec<D>>& v, hn::Vec<D> R,
                                     const Blur<D>* blur = nullptr) {
  using B = Bounds<hn::TFromD<D>>;
  const auto set = [d](hn::TFromD<D> x) HWY_ATTR { return hn::Set(d, x); };
  const auto zero = hn::Zero(d);
  const auto pp = dot(p, p), vv = dot(v, v), RR = hn::Mul(R, R), size = hn::Add(pp, RR);
  const auto m = cross(p, v);
  const auto discriminant = hn::Sub(hn::Mul(RR, vv), dot(m, m));
  ChordLanes<D> out;
  const auto recess = dot(p, v);  // negative while the closest approach is ahead
  const auto denominator = hn::Sub(hn::Sqrt(hn::Max(discriminant, zero)), recess);
  out.excess = hn::Sub(pp, RR);
  out.time = hn::Div(out.excess, denominator);
  const auto late = hn::Sub(out.excess, denominator);
  out.touch = hn::MulAdd(zero, discriminant, hn::MulAdd(set(B::touch), size, set(B::least_square)));
  auto noise = hn::MulAdd(set(B::graze), RR, hn::Mul(set(B::far), pp));
  auto end = hn::Mul(set(B::end), hn::Add(size, denominator));
  if (blur != nullptr) {
    const auto place = hn::Add(sum(p), R);
    out.touch = hn::MulAdd(hn::Mul(set(4), blur->place), place, out.touch);
    noise = hn::MulAdd(hn::MulAdd(set(8 / B::graze), blur->place, hn::Mul(set(4), R)), blur->place, noise);
    end = hn::MulAdd(hn::Mul(set(B::end_of_blur), blur->place), hn::Add(place, blur->path), end);
  }
  noise = hn::MulAdd(vv, noise, set(B::least_reach));
  out.sure = hn::Min(hn::Sub(hn::Abs(discriminant), noise), hn::Sub(hn::Abs(late), end));
  out.pierces = hn::Gt(discriminant, zero);
  out.in_time = hn::Lt(late, zero);
  out.toward = hn::Lt(recess, zero);
  return out;
}

/// Of a chord whose line is walked from time 0.
template <class D> HWY_INLINE Verdict<D> verdict_of(D d, const ChordLanes<D>& chord) {
  const auto zero = hn::Zero(d);
  Verdict<D> out;
  const auto starts_clear = hn::Gt(hn::Abs(chord.excess), chord.touch), inside = hn::Lt(chord.excess, zero);
  out.clear = hn::And(starts_clear, hn::Or(hn::Not(chord.toward), hn::Gt(chord.sure, zero)));
  out.overlapping = inside;
  out.hit = hn::AndNot(inside, hn::And(chord.toward, hn::And(chord.pierces, chord.in_time)));
  out.time = hn::IfThenElse(out.hit, chord.time, hn::Set(d, hn::TFromD<D>(1)));
  return out;
}

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
