#pragma once
/// The clear cases of box_gap(): two boxes of which one at least is turned, as five groups of three axes.
///
/// Where they overlap one axis alone, beyond all noise, is of least overlap, and leads to a face and a corner, or to two edges. Where they
/// are apart, a corner of one and the other box are nearest, or two edges whose product parts them most; the plane across the gap must
/// then part them by all of it, which no nearer places allow.

#include <thinwall/discrete/clear/clear_answers.hpp>
#include <thinwall/discrete/clear/clear_box_axes.hpp>

namespace thinwall {

/// Of the eight corners middle +- x +- y +- z of a box, the one nearest to the box [-h, h].
struct ClearCorner {
  packed::Lanes at, gap;  ///< the corner, and from the box to it
  packed::Pair square;    ///< of the gap

  THINWALL_HOT ClearCorner(const packed::Lanes& middle, const packed::Vectors<packed::Lanes>& edges,
                           const packed::Lanes& h)
      : at(middle), gap(middle), square(packed::both(ClearEntry::never)) {
    const packed::Lanes right = middle + edges.x, left = middle - edges.x;
    for (const packed::Lanes& side : {right + edges.y, right - edges.y, left + edges.y, left - edges.y}) {
      consider(side + edges.z, h);
      consider(side - edges.z, h);
    }
  }

 private:
  THINWALL_HOT void consider(const packed::Lanes& corner, const packed::Lanes& h) {
    const packed::Lanes to_corner = corner - max(min(corner, h), packed::all(0) - h);
    const packed::Pair its_square = dot(to_corner, to_corner);
    const packed::LanesMask nearer = all(its_square) < all(square);
    at = select(nearer, corner, at), gap = select(nearer, to_corner, gap);
    square = min(its_square, square);
  }
};

/// The boxes a and b, `between` away from it: `turned` are the rows of ClearBoxAxes. Of boxes that are apart nothing more is said, unless
/// `apart_too`.
template <bool apart_too, class FrameA>
THINWALL_HOT ClearContact clear_boxes_gap(const FrameA& of_a, const Vec3<double>& half_a, const ClearFrame& of_b,
                                          const Vec3<double>& half_b, const packed::Vectors<packed::Lanes>& turned,
                                          const packed::Lanes& between) {
  using packed::Lanes, packed::LanesMask, packed::Pair, packed::PairMask, packed::Vectors, packed::all, packed::both;
  const Lanes zero = all(0), per_a = of_a.per_length(), per_b = of_b.per_length();
  const Lanes ha = packed::lanes(half_a) / per_a, hb = packed::lanes(half_b) / per_b, d = of_a.into(between) * per_a;
  const Vectors<Lanes> D = spread(d), HA = spread(ha), HB = spread(hb), PA = spread(per_a);
  const Vectors<Lanes> rows{turned.x * (PA.x * per_b), turned.y * (PA.y * per_b), turned.z * (PA.z * per_b)};
  const Vectors<Lanes> axes_b = packed::transposed(rows.x, rows.y, rows.z);
  const auto from_b = [&](const Lanes& own) {
    const Vectors<Lanes> part = spread(own);
    return (axes_b.x * part.x + axes_b.y * part.y) + axes_b.z * part.z;
  };
  const Pair size = sum(abs(between) + (ha + hb)), noise = size * both(0x1p-46);
  const PairMask in_range = (size <= both(packed::most_length)) & (both(1 / packed::most_length) <= size);
  const ClearBoxAxes boxes{rows, ha, hb, all(noise)};

  LanesMask apart = all(1) < zero, within = zero <= min(ha, hb);
  Lanes least[5], most[5];  // of how far they overlap on each axis
  int group = 0;
  boxes.each_group([&](const auto& along, const Lanes& reach, const Lanes& rounding, const Lanes& square) {
    const Lanes overlap = reach - abs(along(D)), length = root(square);
    const LanesMask has_length = zero < square;
    apart = apart | (overlap < zero - rounding);
    within = within & (rounding <= overlap);
    least[group] = select(has_length, (overlap - rounding) / length, all(ClearEntry::never));
    most[group++] = select(has_length, (overlap + rounding) / length, all(ClearEntry::never));
  });
  const bool parted = any_of(apart), in_order = both(both(of_a.clear(), of_b.clear()), boxes.in_range());
  ClearContact answer{both(in_order, all_of(in_range)), !parted, zero, zero, zero, both(0)};
  if (parted && !apart_too) return answer;

  // The axis of least overlap, n from a to b and g in the axes of b; of each box the corner that is farthest along it, or the middle of an edge.
  const Pair bound = smallest_of(min(min(most[0], most[1]), min(min(most[2], most[3]), most[4])));
  unsigned axes = 0;
  for (unsigned i = 0; i < 5; ++i) axes |= bits(least[i] <= all(bound)) << 3U * i;
  const ClearAxis& k = ClearAxis::of(axes);
  const LanesMask is_own = zero < all(k.own), is_its = zero < all(k.its);
  const LanesMask along_a = packed::lowest(k.edge_a), along_b = packed::lowest(k.edge_b);
  const Lanes edge_a = ClearUpright::axis(k.a), edge_b = only(packed::lowest(1U << static_cast<unsigned>(k.b)), rows);
  const Lanes product = cross(edge_a, edge_b), axis = select(is_own, edge_a, select(is_its, edge_b, product));
  const Pair sine = dot(product, product), toward = dot(axis, d);
  Lanes n = unit(against(zero - axis, all(toward)));
  const Lanes g = dot(spread(n), rows);
  const Lanes corner_a = select(along_a, zero, against(zero - ha, n)), corner_b = select(along_b, zero, against(hb, g));
  const Lanes at_b = d + from_b(corner_b), r = at_b - corner_a;
  answer.depth = (dot(ha, abs(n)) + dot(hb, abs(g))) - dot(n, d);
  const Pair to_edges = two_sums(r * edge_a, r * edge_b), cosine = dot(edge_a, edge_b);
  const Pair along =
      (to_edges - swapped(to_edges) * cosine) / sine;  // from the middle of a's edge, and back from that of b's
  const bool is_product = k.edge_a != 0;
  const PairMask crossed = both(0x1p-6) < sine;
  Lanes on_a = select(is_own, at_b + n * all(answer.depth), corner_a + keep(along_a, all(firsts(along))));
  Lanes on_b = on_a - n * all(answer.depth);

  if (!parted) {
    const LanesMask leans_a = (all(noise) < abs(n) * ha) | (ha <= zero) | along_a | is_own;
    const LanesMask leans_b = (all(noise) < abs(g) * hb) | (hb <= zero) | along_b | is_its;
    const bool lies_so = both(all_of(within & leans_a & leans_b), all_of(noise < abs(toward)));
    answer.clear = both(both(answer.clear, k.alone), both(lies_so, all_of(crossed) || !is_product));
  } else {
    const PairMask inside = (firsts(abs(along)) <= dot(keep(along_a, ha), all(1))) &
                            (seconds(abs(along)) <= dot(keep(along_b, hb), all(1)));
    if (!(k.alone && is_product && all_of(inside & crossed))) {
      const ClearCorner of_b(d, {axes_b.x * HB.x, axes_b.y * HB.y, axes_b.z * HB.z}, ha);
      const ClearCorner of_a(zero - dot(D, rows), {rows.x * HA.x, rows.y * HA.y, rows.z * HA.z}, hb);
      const LanesMask is_bs = all(of_b.square) <= all(of_a.square);
      const Lanes gap = select(is_bs, of_b.gap, zero - from_b(of_a.gap));
      on_b = select(is_bs, of_b.at, d + from_b(of_a.at) + gap);
      on_a = on_b - gap;
      n = unit(gap);
    }
    const Pair distance = dot(on_b - on_a, n);
    const Pair parts = dot(n, d) - (dot(ha, abs(n)) + dot(hb, abs(dot(spread(n), rows))));
    answer.clear =
        both(answer.clear, all_of((distance - parts <= size * both(0x1p-51)) & (size * both(0x1p-20) <= distance)));
    answer.depth = both(0) - distance;
  }
  answer.normal = of_a.out_of(n * per_a);
  answer.local_a = of_a.out_of(on_a * per_a);
  answer.local_b = of_a.out_of((on_b - d) * per_a);
  return answer;
}

}  // namespace thinwall
