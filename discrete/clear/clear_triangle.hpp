#pragma once
/// The clear cases of closest_on_triangle(): the nearest point of a triangle, its three edges side by side, without a jump.

#include <limits>

#include <thinwall/discrete/clear/clear_nearest.hpp>
#include <thinwall/discrete/clear/vectors.hpp>

namespace thinwall {

/// The triangle { s d + u f }, s, u >= 0, s + u <= 1, at rest beside a point.
/// Source: Ericson, Real-Time Collision Detection, 2005, section 5.1.5, with the barycentric coordinates of section 3.4.
struct ClearTriangle {
  packed::Lanes d, f, sizes;
  packed::Lanes n;         ///< d x f, as turned_cross() has it
  packed::Pair nn;         ///< n.n
  packed::PairMask broad;  ///< no needle, whose plane roundings tilt

  THINWALL_HOT ClearTriangle(const packed::Lanes& first, const packed::Lanes& second)
      : d(first), f(second), sizes(abs(first) + abs(second)), n(turned_cross(first, second)), nn(dot(n, n)) {
    const packed::Pair lengths = two_sums(d * d, f * f);
    broad = lengths * swapped(lengths) * packed::both(0x1p-8) < nn;
  }

  /// In lanes, each edge from its corner on.
  THINWALL_HOT packed::Vectors<packed::Lanes> corners() const { return packed::transposed(packed::all(0), d, f); }
  THINWALL_HOT packed::Vectors<packed::Lanes> edges() const { return packed::transposed(d, f - d, packed::all(0) - f); }

  /// How far it reaches along `out`, times its length; and beyond the nearest place, a needle beyond any.
  THINWALL_HOT packed::Pair reach(const packed::Lanes& out) const {
    const packed::Pair of = two_sums(out * d, out * f);
    return max(max(of, swapped(of)), packed::both(0));
  }
  THINWALL_HOT packed::Pair beyond(const packed::Lanes& out, const ClearNearest& nearest) const {
    const packed::Pair over = reach(out) - dot(out, nearest.at);
    return select(broad, over, packed::both(std::numeric_limits<double>::infinity()));
  }

  /// The point of the plane below x, by its place (s, u).
  THINWALL_HOT ClearNearest foot(const packed::Lanes& x) const {
    const packed::Pair per = packed::both(1) / nn;
    const packed::Pair place = two_sums(turned_cross(x, f) * n, turned_cross(d, x) * n) * per;
    const packed::Lanes at = d * all(firsts(place)) + f * all(seconds(place)), normal = yzx(n);
    return {at, normal * all(dot(normal, x - at) * per), place};
  }
  /// How far inside of each edge such a place is, in that order.
  THINWALL_HOT static packed::Lanes inwards(const packed::Pair& place) {
    const packed::Pair left = packed::both(1) - (place + swapped(place));
    return lanes(firsts(seconds(place), left), firsts(place));
  }

  /// The place of the plane if it is in the triangle, else that of the edge it is beside and outside of, else the corner whose edges both end
  /// there, seen from x. Squared distances are not compared: they tell places apart only to the square root of a rounding. Where roundings
  /// contradict each other, and none of these is so, the gap has no length, and what is asked of it is in doubt.
  THINWALL_HOT ClearNearest nearest(const packed::Lanes& x) const {
    using packed::Lanes, packed::LanesMask, packed::all, packed::both, packed::Vectors;
    const ClearNearest by_face = foot(x);
    const Lanes inside = inwards(by_face.place);
    const Vectors<Lanes> from = corners(), edge = edges();
    const Lanes along = dot(packed::spread(x) - from, edge) / dot(edge, edge);
    const unsigned before = bits(along <= all(0)), behind = bits(all(1) <= along), outside = bits(inside < all(0));
    const unsigned beside = outside & ~(before | behind), beyond = before & (behind << 1U | behind >> 2U);
    const Lanes on = max(min(along, all(1)), all(0));
    const unsigned one = beside != 0 ? beside : beyond;
    const Lanes by_edge = only(packed::lowest(one), from + edge * on), gap = (x - by_edge) * all(one != 0 ? 1 : 0);
    const LanesMask over = all(both(0) <= smallest_of(inside));
    return {select(over, by_face.at, by_edge), select(over, by_face.gap, gap), by_face.place};
  }
};

}  // namespace thinwall
