#pragma once
/// The clear cases of segment.hpp: the nearest points of two segments, without a jump.

#include <limits>

#include <thinwall/discrete/clear/clear_nearest.hpp>

namespace thinwall {

/// The segment s d, s in [0, 1], at rest beside a point; the place that is told is s.
struct ClearSegment {
  packed::Lanes d, sizes;

  THINWALL_HOT explicit ClearSegment(const packed::Lanes& core) : d(core), sizes(abs(core)) {}
  /// How far it reaches along n, times its length, beyond the nearest place.
  THINWALL_HOT packed::Pair beyond(const packed::Lanes& n, const ClearNearest& nearest) const {
    const packed::Pair along = dot(n, d);
    return max(along, packed::both(0)) - along * nearest.place;
  }
  THINWALL_HOT ClearNearest nearest(const packed::Lanes& x) const {
    const packed::Pair along = two_sums(x * d, d * d), s = clear_clamp(firsts(along) / seconds(along));
    const packed::Lanes at = d * all(s);
    return {at, x - at, s};
  }
};

/// The parallelogram { s d + u e }, s and u in [0, 1]: where the start of the second segment, which e leads back to, may not be, seen from
/// that of the first. The place that is told is (s, u).
/// Source: Ericson, Real-Time Collision Detection, 2005, section 5.1.9; but u by the place on the
/// first's line that is nearest to the second's, which their normal tells without cancelling.
struct ClearSegments {
  packed::Lanes d, e, sizes;
  packed::Pair per, on;  ///< 1 / d.d and 1 / e.e; d.e over d.d and e.e
  packed::Lanes n;       ///< d x e, as turned_cross() has it
  packed::Pair nn;       ///< n.n

  THINWALL_HOT ClearSegments(const packed::Lanes& first, const packed::Lanes& second)
      : d(first), e(second), sizes(abs(first) + abs(second)), n(turned_cross(first, second)) {
    using packed::Pair, packed::both;
    const Pair lengths = two_sums(d * d, e * e), others = two_sums(n * n, d * e);
    per = both(1) / lengths, nn = firsts(others), on = seconds(others) * per;
  }

  /// As ClearSegment; nearly parallel ones are beyond any place, as rounding says which is the nearest.
  THINWALL_HOT packed::Pair beyond(const packed::Lanes& along, const ClearNearest& nearest) const {
    using packed::Pair, packed::both;
    const Pair of = two_sums(along * d, along * e), over = max(of, both(0)) - of * nearest.place;
    const packed::PairMask crossed = on * swapped(on) < both(1 - 0x1p-20);  // the square of their cosine
    return select(crossed, over + swapped(over), both(std::numeric_limits<double>::infinity()));
  }

  THINWALL_HOT ClearNearest nearest(const packed::Lanes& x) const {
    using packed::Lanes, packed::Pair, packed::all, packed::both;
    const Pair of_x = two_sums(x * d, x * e) * per, across = clear_clamp(dot(turned_cross(x, e), n) / nn);
    const Pair u = clear_clamp(seconds(of_x) - across * seconds(on)), s = clear_clamp(firsts(of_x) - u * firsts(on));
    const Lanes on_first = d * all(s), on_second = e * all(u);
    return {on_first + on_second, (x - on_second) - on_first, firsts(s, u)};
  }
};

}  // namespace thinwall
