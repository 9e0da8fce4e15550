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
/// The place that is told is s.
/// Source: Ericson, Real-Time Collision Detection, 2005, section 5.1.9; but s by the normal of both, which does not cancel.
struct ClearSegments {
  packed::Lanes d, e;
  packed::Pair size;
  packed::Pair per_dd, per_ee, per_nn;  ///< 1 / d.d, 1 / e.e and 1 / n.n, of n = d x e
  packed::Pair d_on_e, e_on_d;          ///< d.e / e.e and d.e / d.d
  packed::Lanes to_s;        ///< x.to_s / n.n is the place on the first's line that is nearest to the second's
  packed::PairMask crossed;  ///< far enough from parallel for that

  THINWALL_HOT ClearSegments(const packed::Lanes& first, const packed::Lanes& second)
      : d(first), e(second), size(sum(abs(first) + abs(second))) {
    using packed::Lanes, packed::Pair, packed::both;
    const Lanes normal = cross(d, e);
    const Pair lengths = two_sums(d * d, e * e), per = both(1) / lengths, others = two_sums(d * e, normal * normal);
    per_dd = firsts(per), per_ee = seconds(per), per_nn = both(1) / seconds(others);
    d_on_e = firsts(others) * per_ee, e_on_d = firsts(others) * per_dd;
    to_s = cross(e, normal);
    crossed = both(0x1p-20) * (firsts(lengths) * seconds(lengths)) < seconds(others);
  }

  THINWALL_HOT packed::Pair reach(const packed::Lanes& n) const {
    const packed::Pair along = two_sums(n * d, n * e), none = packed::both(0);
    return max(firsts(along), none) - min(seconds(along), none);
  }

  THINWALL_HOT ClearNearest nearest(const packed::Lanes& x) const {
    using packed::Lanes, packed::Pair, packed::PairMask, packed::all, packed::both;
    const Pair zero = both(0), one = both(1), of_x = two_sums(x * to_s, x * e);
    const Pair across = clear_clamp(firsts(of_x) * per_nn), u = clear_clamp(across * d_on_e - seconds(of_x) * per_ee);
    const PairMask end_u = (u <= zero) | (one <= u);
    const Pair s = select(end_u, clear_clamp(dot(x, d) * per_dd + u * e_on_d), across);
    const Lanes at = d * all(s) - e * all(u);
    return {at, x - at, zero, s, all_of(crossed)};
  }
};

}  // namespace thinwall
