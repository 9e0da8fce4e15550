#pragma once
/// The clear cases of closest_on_triangle() in triangle.hpp, without a jump: its three edges in three lanes.

#include <thinwall/discrete/clear/clear_nearest.hpp>
#include <thinwall/discrete/clear/vectors.hpp>

namespace thinwall {

/// The triangle (0, e1, e2), past which a point moves by v.
struct ClearTriangle {
  packed::Lanes e1, e2, normal;
  packed::Pair size, per_nn;  ///< per_nn: 1 / normal.normal
  /// Of each edge: where it starts, where it goes and which side is the triangle's.
  packed::Vectors<packed::Lanes> from, edge, inward;
  packed::Lanes per_length,
      beside;                     ///< of each edge: one over its square, and the square of the motion at right angles
  packed::Pair speed, of_normal;  ///< squares of the motion and of its part along the normal
  packed::PairMask broad;         ///< no needle, whose plane roundings tilt
  packed::Pair through;           ///< v.normal
  packed::Pair extents;           ///< the normal's length, and the product of those of e1 and e2

  THINWALL_HOT ClearTriangle(const packed::Lanes& to_b, const packed::Lanes& to_c, const packed::Lanes& v)
      : e1(to_b), e2(to_c), normal(cross(to_b, to_c)), size(sum(abs(to_b) + abs(to_c))) {
    using packed::Lanes, packed::Pair, packed::all, packed::both;
    const Lanes d[3] = {e1, e2 - e1, all(0) - e2}, none = all(0);
    edge = packed::transposed(d[0], d[1], d[2]), from = packed::transposed(none, e1, e2);
    inward = packed::transposed(cross(normal, d[0]), cross(normal, d[1]), cross(normal, d[2]));
    const Pair of_v = two_sums(v * v, v * normal);
    const Pair lengths = two_sums(e1 * e1, e2 * e2), nn = dot(normal, normal), ee = firsts(lengths) * seconds(lengths);
    per_nn = both(1) / nn;
    speed = firsts(of_v), through = seconds(of_v), of_normal = through * through * per_nn;
    per_length = all(1) / dot(edge, edge);
    broad = both(0x1p-8) * ee * per_nn < both(1), extents = root(firsts(nn, ee) + both(ClearStretch::least_square));
    const Lanes along = dot(edge, spread(v));
    beside = all(speed) - along * along * per_length;
  }

  THINWALL_HOT packed::Lanes low() const { return min(min(e1, e2), packed::all(0)); }
  THINWALL_HOT packed::Lanes high() const { return max(max(e1, e2), packed::all(0)); }
  THINWALL_HOT packed::Pair reach(const packed::Lanes& n) const {
    const packed::Pair along = two_sums(n * e1, n * e2);
    return max(max(firsts(along), seconds(along)), packed::both(0));
  }

  /// The slab of its plane: where its face is met, or passed.
  THINWALL_HOT void narrow(ClearStretch& stretch, const packed::Lanes& p, const packed::Pair& R,
                           const packed::Pair& noise) const {
    stretch.narrow(dot(p, normal), through, firsts(extents) * R, seconds(extents) * noise);
  }

  THINWALL_HOT ClearNearest nearest(const packed::Lanes& x) const {
    using packed::Lanes, packed::LanesMask, packed::Pair, packed::PairMask, packed::all, packed::both;
    const Lanes none = all(0), full = all(1);
    const packed::Vectors<Lanes> to_x = spread(x) - from;
    const Lanes place = max(min(dot(edge, to_x) * per_length, full), none);
    const packed::Vectors<Lanes> gaps = to_x - edge * place;
    const Lanes square = dot(gaps, gaps);
    const LanesMask nearest_edge = packed::lowest(bits(square <= all(smallest_of(square))));
    const LanesMask end = (place <= none) | (full <= place);
    const Pair of_edge = sum(keep(nearest_edge, select(end, all(speed), beside)));
    const Pair depth = smallest_of(dot(inward, to_x));
    const PairMask inside = both(0) < depth;
    const Lanes above = normal * all(dot(x, normal) * per_nn),
                gap = select(all(inside), above, only(nearest_edge, gaps));
    const bool one = packed::all_of(broad | (depth <= both(0)));
    return {x - gap, gap, select(inside, of_normal, of_edge), both(0), one};
  }
};

}  // namespace thinwall
