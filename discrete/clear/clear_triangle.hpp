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

  /// How far it reaches along `out`, times its length, beyond the nearest place; a needle beyond any.
  THINWALL_HOT packed::Pair beyond(const packed::Lanes& out, const ClearNearest& nearest) const {
    const packed::Pair of = two_sums(out * d, out * f), most = max(max(of, swapped(of)), packed::both(0));
    return select(broad, most - dot(out, nearest.at), packed::both(std::numeric_limits<double>::infinity()));
  }

  /// The place of the plane if it is in the triangle, else that of the edge it is beside and outside of, else the corner whose edges both end
  /// there, seen from x. Squared distances are not compared: they tell places apart only to the square root of a rounding.
  THINWALL_HOT ClearNearest nearest(const packed::Lanes& x) const {
    using packed::Lanes, packed::LanesMask, packed::Pair, packed::all, packed::both, packed::Vectors;
    const Pair per = both(1) / nn;
    const Pair of_plane = two_sums(turned_cross(x, f) * n, turned_cross(d, x) * n) * per;
    const Pair left = both(1) - (of_plane + swapped(of_plane));

    const Vectors<Lanes> from = packed::transposed(all(0), d, f), edge = packed::transposed(d, f - d, all(0) - f);
    const Lanes along = dot(packed::spread(x) - from, edge) / dot(edge, edge);
    const Lanes inwards = lanes(firsts(seconds(of_plane), left), firsts(of_plane));
    const unsigned before = bits(along <= all(0)), behind = bits(all(1) <= along), outside = bits(inwards < all(0));
    const unsigned beside = outside & ~(before | behind), beyond = before & (behind << 1U | behind >> 2U);
    const Lanes on = max(min(along, all(1)), all(0));
    const Lanes by_edge = only(packed::lowest(beside != 0 ? beside : beyond), from + edge * on);

    const LanesMask by_face = all(both(0) <= smallest_of(inwards));
    const Lanes at = select(by_face, d * all(firsts(of_plane)) + f * all(seconds(of_plane)), by_edge);
    const Lanes gap = x - at, normal = yzx(n);
    return {at, select(by_face, normal * all(dot(normal, gap) * per), gap), of_plane};
  }
};

}  // namespace thinwall
