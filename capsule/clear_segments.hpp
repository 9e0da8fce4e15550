#pragma once
/// The clear cases of segment.hpp: the nearest points of two segments, without a jump.

#include <thinwall/discrete/clear/clear_nearest.hpp>

namespace thinwall {

/// The segment s d, s in [0, 1], at rest beside a point; the place that is told is s.
struct ClearSegment {
  packed::Lanes d;
  packed::Pair size;

  THINWALL_HOT explicit ClearSegment(const packed::Lanes& core) : d(core), size(sum(abs(core))) {}
  THINWALL_HOT packed::Pair reach(const packed::Lanes& n) const { return max(dot(n, d), packed::both(0)); }
  THINWALL_HOT ClearNearest nearest(const packed::Lanes& x) const {
    const packed::Pair along = two_sums(x * d, d * d), s = clear_clamp(firsts(along) / seconds(along));
    const packed::Lanes at = d * all(s);
    return {at, x - at, packed::both(0), s};
  }
};

/// The parallelogram { s d - u e }, s and u in [0, 1]: where the start of the second segment may not be, seen from that of the first.
/// Past it a point moves by v. The place that is told is s.
/// Source: Ericson, Real-Time Collision Detection, 2005, section 5.1.9; but s by the normal of both, which does not cancel.
struct ClearSegments {
  packed::Lanes d, e, normal;
  packed::Pair size;
  packed::Pair de, per_dd, per_ee;  ///< d.e, 1 / d.d, 1 / e.e
  packed::Lanes to_s;               ///< x.to_s is the place on the first's line that is nearest to the second's
  packed::PairMask crossed;         ///< far enough from parallel for that
  packed::Pair speed, of_d, of_e, of_normal;  ///< squares of the motion and of its parts along the three
  packed::Pair through;                       ///< v.normal
  packed::Pair extents;                       ///< the normal's length, and the product of the segments'

  THINWALL_HOT ClearSegments(const packed::Lanes& first, const packed::Lanes& second, const packed::Lanes& v)
      : d(first), e(second), normal(cross(first, second)), size(sum(abs(first) + abs(second))) {
    using packed::Pair, packed::all, packed::both;
    const Pair lengths = two_sums(d * d, e * e), per = both(1) / lengths, others = two_sums(d * e, normal * normal);
    const Pair along = two_sums(v * d, v * e), of_v = two_sums(v * v, v * normal), parts = along * along * per;
    const Pair per_nn = both(1) / seconds(others);
    de = firsts(others), per_dd = firsts(per), per_ee = seconds(per);
    to_s = cross(e, normal) * all(per_nn);
    crossed = both(0x1p-20) * (firsts(lengths) * seconds(lengths)) < seconds(others);
    speed = firsts(of_v), through = seconds(of_v), of_d = firsts(parts), of_e = seconds(parts);
    of_normal = through * through * per_nn;
    extents = root(firsts(seconds(others), firsts(lengths) * seconds(lengths)) + both(ClearStretch::least_square));
  }

  THINWALL_HOT packed::Lanes low() const { return min(d, packed::all(0)) - max(e, packed::all(0)); }
  THINWALL_HOT packed::Lanes high() const { return max(d, packed::all(0)) - min(e, packed::all(0)); }
  THINWALL_HOT packed::Pair reach(const packed::Lanes& n) const {
    const packed::Pair along = two_sums(n * d, n * e), none = packed::both(0);
    return max(firsts(along), none) - min(seconds(along), none);
  }

  /// The slab across both: where their sides meet, or pass.
  THINWALL_HOT void narrow(ClearStretch& stretch, const packed::Lanes& p, const packed::Pair& R,
                           const packed::Pair& noise) const {
    stretch.narrow(dot(p, normal), through, firsts(extents) * R, seconds(extents) * noise);
  }

  THINWALL_HOT ClearNearest nearest(const packed::Lanes& x) const {
    using packed::Lanes, packed::Pair, packed::PairMask, packed::all, packed::both;
    const Pair zero = both(0), one = both(1), of_x = two_sums(x * to_s, x * e);
    const Pair across = clear_clamp(firsts(of_x)), u = clear_clamp((across * de - seconds(of_x)) * per_ee);
    const PairMask end_u = (u <= zero) | (one <= u);
    const Pair s = select(end_u, clear_clamp((dot(x, d) + u * de) * per_dd), across);
    const PairMask end_s = (s <= zero) | (one <= s);
    const Lanes at = d * all(s) - e * all(u);
    const Pair beside = speed - (select(end_s, zero, of_d) + select(end_u, zero, of_e));
    return {at, x - at, select(end_s | end_u, beside, of_normal), s, all_of(crossed)};
  }
};

}  // namespace thinwall
