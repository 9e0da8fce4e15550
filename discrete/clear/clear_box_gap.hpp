#pragma once
/// The clear cases of box_gap(): two boxes of which one at least is turned, as five groups of three axes.
///
/// Where they overlap one axis alone, beyond all noise, is of least overlap, and leads to a face and a corner, or to two edges; or several are,
/// which are normal to one face of each but for roundings. Where they are apart, a corner of one and the other box are nearest, or two edges
/// whose product parts them most; the plane across the gap must then part them by all of it, which no nearer places allow.

#include <bit>

#include <thinwall/discrete/boxes/box_pair.hpp>
#include <thinwall/discrete/clear/clear_answers.hpp>
#include <thinwall/discrete/clear/clear_box_axes.hpp>

namespace thinwall {

/// The boxes a and b, seen from the center of a along its axes, which are made of unit length, as those of b are.
struct ClearBoxPair {
  packed::Lanes ha, hb, d;                      ///< [length] half extents, and the center of b
  packed::Vectors<packed::Lanes> rows, axes_b;  ///< of each of a's axes what b's have along it; and b's axes
  packed::Pair size, noise;                     ///< [length]
  bool clear;                                   ///< valid, in range, and their axes clear

  /// `turned` are the rows of ClearBoxAxes, of axes as they are.
  template <class FrameA>
  THINWALL_HOT ClearBoxPair(const FrameA& of_a, const Vec3<double>& half_a, const ClearFrame& of_b,
                            const Vec3<double>& half_b, const packed::Vectors<packed::Lanes>& turned,
                            const packed::Lanes& between) {
    using packed::both;
    const packed::Lanes per_a = of_a.per_length(), per_b = of_b.per_length();
    const packed::Vectors<packed::Lanes> each_per_a = spread(per_a);
    ha = packed::lanes(half_a) / per_a, hb = packed::lanes(half_b) / per_b, d = of_a.into(between) * per_a;
    rows = {turned.x * (each_per_a.x * per_b), turned.y * (each_per_a.y * per_b), turned.z * (each_per_a.z * per_b)};
    axes_b = packed::transposed(rows.x, rows.y, rows.z);
    size = sum(abs(between) + (ha + hb)), noise = size * both(0x1p-46);
    const packed::PairMask in_range = (size <= both(packed::most_length)) & (both(1 / packed::most_length) <= size);
    const packed::LanesMask is_valid = (packed::all(0) <= min(ha, hb)) & of_a.clear() & of_b.clear();
    clear = both(all_of(is_valid & axes().in_range()), all_of(in_range));
  }
  THINWALL_HOT ClearBoxAxes axes() const { return {rows, ha, hb, all(noise)}; }
  THINWALL_HOT packed::Lanes from_b(const packed::Lanes& own) const {
    const packed::Vectors<packed::Lanes> part = spread(own);
    return (axes_b.x * part.x + axes_b.y * part.y) + axes_b.z * part.z;
  }
  /// How far they overlap along the unit vector n, from a to b.
  THINWALL_HOT packed::Pair overlap(const packed::Lanes& n) const {
    return (dot(ha, abs(n)) + dot(hb, abs(dot(spread(n), rows)))) - dot(n, d);
  }
};

/// A place on each of two boxes, one straight along n from the other.
struct ClearFacing {
  bool clear;
  packed::Lanes n, on_a, on_b;
};

/// Where the boxes overlap least, along the one axis whose bit is set: a corner of one and the face of the other that is across it, or two edges.
/// Clear if no face or edge is level with the other box; of edges, if they also cross within both.
struct ClearFeatures {
  ClearFacing facing;
  bool edges_face;  ///< they are edges, and the two places within them

  THINWALL_HOT ClearFeatures(const ClearBoxPair& boxes, unsigned axes) {
    using packed::Lanes, packed::LanesMask, packed::Pair, packed::PairMask, packed::all, packed::both;
    const Lanes zero = all(0), &ha = boxes.ha, &hb = boxes.hb;
    const ClearAxis& k = ClearAxis::of(axes);
    const LanesMask is_own = zero < all(k.own), is_its = zero < all(k.its);
    const LanesMask along_a = packed::lowest(k.edge_a), along_b = packed::lowest(k.edge_b);
    const Lanes edge_a = ClearUpright::axis(k.a);
    const Lanes edge_b = only(packed::lowest(1U << static_cast<unsigned>(k.b)), boxes.rows);
    const Lanes product = cross(edge_a, edge_b), axis = select(is_own, edge_a, select(is_its, edge_b, product));
    const Pair square_sine = dot(product, product), toward = dot(axis, boxes.d);
    const Lanes n = unit(against(zero - axis, all(toward)));

    // the corner of each that is farthest along n, or the middle of an edge
    const Lanes g = dot(spread(n), boxes.rows);
    const Lanes from_a = select(along_a, zero, against(zero - ha, n));
    const Lanes from_b = boxes.d + boxes.from_b(select(along_b, zero, against(hb, g))), way = from_b - from_a;
    const Pair on_edges = two_sums(way * edge_a, way * edge_b), cosine = dot(edge_a, edge_b);
    const Pair along = (on_edges - swapped(on_edges) * cosine) / square_sine;  // of a's edge, and back along b's
    const Lanes depth = n * all(boxes.overlap(n));
    const Lanes on_a = select(is_own, from_b + depth, from_a + keep(along_a, all(firsts(along))));

    const LanesMask leans_a = (all(boxes.noise) < abs(n) * ha) | (ha <= zero) | along_a | is_own;
    const LanesMask leans_b = (all(boxes.noise) < abs(g) * hb) | (hb <= zero) | along_b | is_its;
    const PairMask crossed = both(0x1p-6) < square_sine;
    const bool is_product = k.edge_a != 0;
    const PairMask within = (firsts(abs(along)) <= dot(keep(along_a, ha), all(1))) &
                            (seconds(abs(along)) <= dot(keep(along_b, hb), all(1)));
    edges_face = both(both(k.alone, is_product), all_of(within & crossed));
    const bool lies_so = both(all_of(leans_a & leans_b), all_of(boxes.noise < abs(toward)));
    facing = {both(both(k.alone, lies_so), all_of(crossed) || !is_product), n, on_a, on_a - depth};
  }
};

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
    const packed::Lanes to_corner = corner - held_within(corner, h);
    const packed::Pair its_square = dot(to_corner, to_corner);
    const packed::LanesMask nearer = all(its_square) < all(square);
    at = select(nearer, corner, at), gap = select(nearer, to_corner, gap);
    square = min(its_square, square);
  }
};

/// A corner of one box and what of the other is nearest to it, of boxes that are apart. Clear if the box leans away from there on every side:
/// planes that part the two as well, to rounding, touch it there too.
THINWALL_HOT ClearFacing clear_nearest_corner(const ClearBoxPair& boxes) {
  using packed::Lanes, packed::all;
  const packed::Vectors<Lanes>&rows = boxes.rows, &axes_b = boxes.axes_b, in_a = spread(boxes.ha),
        in_b = spread(boxes.hb);
  const ClearCorner of_b(boxes.d, {axes_b.x * in_b.x, axes_b.y * in_b.y, axes_b.z * in_b.z}, boxes.ha);
  const ClearCorner of_a(all(0) - dot(spread(boxes.d), rows), {rows.x * in_a.x, rows.y * in_a.y, rows.z * in_a.z},
                         boxes.hb);
  const packed::LanesMask is_of_b = all(of_b.square) <= all(of_a.square);
  const Lanes gap = select(is_of_b, of_b.gap, all(0) - boxes.from_b(of_a.gap));
  const Lanes on_b = select(is_of_b, of_b.at, boxes.d + boxes.from_b(of_a.at) + gap);
  const Lanes n = unit(gap), sines = select(is_of_b, dot(spread(n), rows), n);
  const packed::LanesMask leans = (all(0x1p-10) <= abs(sines)) | (select(is_of_b, boxes.hb, boxes.ha) <= all(0));
  return {all_of(leans), n, on_b - gap, on_b};
}

/// Two boxes, and the frame of the first in the world.
template <class FrameA> struct ClearTwoBoxes {
  FrameA of_a;
  ClearBoxPair pair;

  /// Of two places that face each other, in the world's axes; `depth` is how far the boxes overlap there.
  THINWALL_HOT ClearContact contact(bool touching, const ClearFacing& facing, const packed::Pair& depth) const {
    const packed::Lanes per_a = of_a.per_length();
    return {packed::both(pair.clear, facing.clear),     touching,
            of_a.out_of(facing.on_a * per_a),           of_a.out_of((facing.on_b - pair.d) * per_a),
            nearer_unit(of_a.out_of(facing.n * per_a)), depth};
  }
};

/// Boxes that lie level, and overlap least across a face of a: the middle of what the two faces share. The careful rung finds it.
THINWALL_HOT ClearFacing clear_level_face(const ClearBoxPair& boxes, int axis) {
  using packed::all;
  const packed::Lanes n = all(0) - against(ClearUpright::axis(axis), boxes.d);
  const BoxPoints<double> points = points_on_level_face(boxes.axes(), boxes.d, axis);
  return {all_of(boxes.noise < abs(dot(n, boxes.d))), n, packed::lanes(points.on_a), packed::lanes(points.on_b)};
}

/// Of boxes that are apart nothing more is said, unless `apart_too`.
template <bool apart_too, class FrameA> THINWALL_HOT ClearContact clear_boxes_gap(const ClearTwoBoxes<FrameA>& two) {
  using packed::Lanes, packed::Pair, packed::all, packed::both;
  const ClearBoxPair& boxes = two.pair;
  const ClearOverlaps overlaps(boxes.axes(), boxes.d);
  if (overlaps.apart() && !apart_too) return {boxes.clear, false, all(0), all(0), all(0), both(0)};

  const unsigned near = overlaps.least().axes, axes = boxes.axes().one_axis_of(near);
  if (axes != near && overlaps.within()) [[unlikely]] {
    const ClearFacing level = clear_level_face(boxes, std::countr_zero(axes));
    return two.contact(true, level, boxes.overlap(level.n));
  }
  const ClearFeatures features(boxes, axes);
  const bool is_corner = overlaps.apart() && !features.edges_face;
  ClearFacing facing = is_corner ? clear_nearest_corner(boxes) : features.facing;
  Pair depth = boxes.overlap(facing.n);
  if (overlaps.apart()) {  // no plane parts them by more than they are apart: one that does so by all of it proves it
    const Pair distance = dot(facing.on_b - facing.on_a, facing.n);
    const packed::PairMask proven = distance + depth <= boxes.size * both(0x1p-51);
    facing.clear = both(facing.clear, all_of(proven & (boxes.size * both(0x1p-20) <= distance)));
    depth = both(0) - distance;
  } else {
    facing.clear = both(facing.clear, overlaps.within());
  }
  return two.contact(!overlaps.apart(), facing, depth);
}

}  // namespace thinwall
