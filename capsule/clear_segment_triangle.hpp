#pragma once
/// The clear cases of segment_triangle.hpp: the nearest points of a segment and a triangle, its three edges side by side, without a jump.

#include <thinwall/discrete/clear/clear_triangle.hpp>

namespace thinwall {

/// The prism { y - w d }, y in a triangle, w in [0, 1], which the triangle sweeps along the segment d backwards: where the start of the
/// segment may not be, seen from the triangle's first corner. The place that is told is w, twice.
struct ClearSegmentTriangle {
  packed::Lanes d, sizes;
  ClearTriangle face;
  packed::Vectors<packed::Lanes> corners;  ///< at w = 0, the first again in the last lane
  packed::Pair thick;                      ///< N.d of the triangle's normal N = e1 x e2
  packed::Pair length;                     ///< [length] the sum of all numbers of e1, e2 and d

  THINWALL_HOT ClearSegmentTriangle(const packed::Lanes& e1, const packed::Lanes& e2, const packed::Lanes& core)
      : d(core),
        sizes((abs(e1) + abs(e2)) + abs(core)),
        face(e1, e2),
        corners(with_last(face.corners(), packed::all(0))),
        thick(dot(yzx(face.n), d)),
        length(sum(sizes)) {}

  /// How far it reaches along n.
  THINWALL_HOT packed::Pair reach(const packed::Lanes& n) const {
    return face.reach(n) - min(dot(n, d), packed::both(0));
  }
  THINWALL_HOT packed::Pair beyond(const packed::Lanes& n, const ClearNearest& nearest) const {
    return reach(n) - dot(n, nearest.at);
  }
  /// Whether all corners are behind a place along its unit normal. Roundings may lean that by `lean`, squared, and move a corner by 2^-52 of
  /// `size` [length]. Of a prism that is nowhere thin all else is behind, too, but for 2^14 times that lean.
  THINWALL_HOT bool is_behind(const packed::Lanes& place, const packed::Lanes& normal, const packed::Pair& size,
                              const packed::Pair& lean) const {
    using packed::both;
    const auto behind = [&](const packed::Vectors<packed::Lanes>& seen) {
      const packed::Lanes over = max(dot(seen, packed::spread(normal)) - all(size * both(0x1p-52)), packed::all(0));
      return over * over <= dot(seen, seen) * all(lean);
    };
    return packed::both(all_of(length * length * length * both(0x1p-14) <= abs(thick)),
                        all_of(behind(corners - packed::spread(place)) & behind(corners - packed::spread(place + d))));
  }

  /// An end of the segment over the triangle, or the segment and an edge.
  /// Source: as ClearTriangle and ClearSegments.
  THINWALL_HOT ClearNearest nearest(const packed::Lanes& x) const {
    using packed::Lanes, packed::LanesMask, packed::Pair, packed::PairMask, packed::Vectors, packed::all, packed::both;
    const auto clamped = [](const Lanes& at) { return max(min(at, all(1)), all(0)); };
    const Vectors<Lanes> E = face.edges(), D = packed::spread(d), n = cross(E, D);
    const Vectors<Lanes> from = packed::spread(x) - face.corners();
    const Lanes leans = dot(E, D), across = clamped(dot(cross(from, E), n) / dot(n, n));
    const Lanes s = clamped((dot(E, from) + across * leans) / dot(E, E));
    const Lanes w = clamped((s * leans - dot(D, from)) / all(dot(d, d)));
    const Vectors<Lanes> gaps = (from + D * w) - E * s;
    const Lanes squares = dot(gaps, gaps);
    const LanesMask one = packed::lowest(bits(squares <= all(smallest_of(squares))));

    const ClearNearest start = face.foot(x), end = face.foot(x + d);
    const auto square_of = [&](const ClearNearest& foot) {
      return select(both(0) <= smallest_of(ClearTriangle::inwards(foot.place)), dot(foot.gap, foot.gap),
                    both(std::numeric_limits<double>::infinity()));
    };
    const Pair of_start = square_of(start), of_end = square_of(end);
    const PairMask by_end = min(of_start, of_end) < smallest_of(squares), by_start = of_start <= of_end;
    const Pair place = select(by_end, select(by_start, both(0), both(1)), sum(keep(one, w)));
    const Lanes by_edge = only(one, gaps),
                gap = select(all(by_end), select(all(by_start), start.gap, end.gap), by_edge);
    return {x - gap, gap, place};
  }
};

}  // namespace thinwall
