#pragma once
/// The clear cases of boxes_entry.hpp: fifteen axes, in five groups of three lanes.
///
/// On each axis the times between which the shadows overlap are known within bounds, by the noise of the numbers they come of. A miss
/// is one beyond all bounds. Of a hit the bounds say which axis is the last to be shared, and nothing comes near it but what is the same but
/// for roundings, as where boxes lie level; its time is computed once more, by division, from the axis itself.

#include <thinwall/discrete/obb.hpp>

namespace thinwall {

/// When the shadows on three axes begin and cease to overlap, at the earliest and at the latest.
struct ClearTimes {
  packed::Lanes in_least, in_most, out_least, out_most;

  /// Of middles c apart that move by w, and reach e together, all up to `noise`.
  THINWALL_HOT static ClearTimes of(const packed::Lanes& c, const packed::Lanes& w, const packed::Lanes& e,
                                    const packed::Lanes& noise) {
    const packed::Lanes C = against(c, w), rate = packed::all(1) / abs(w), wide = e + noise, narrow = e - noise;
    return {(C - wide) * rate, (C - narrow) * rate, (C + narrow) * rate, (C + wide) * rate};
  }
  /// An axis of a that has no length, 0 / 0, is passed over.
  THINWALL_HOT friend ClearTimes shared(const ClearTimes& a, const ClearTimes& b) {
    return {max(a.in_least, b.in_least), max(a.in_most, b.in_most), min(a.out_least, b.out_least),
            min(a.out_most, b.out_most)};
  }
};

/// The box a at rest and the box b, `between` away from it and moving by v. Its normal is from a to b.
struct ClearBoxes {
  bool clear;
  packed::Pair time;             ///< [1] `never` for a miss
  packed::Lanes normal, from_a;  ///< where they touch, from the center of a

  /// `rows` are those of ClearBoxAxes.
  template <class FrameA>
  THINWALL_HOT ClearBoxes(const FrameA& of_a, const packed::Lanes& ha, const ClearFrame& of_b, const packed::Lanes& hb,
                          const packed::Vectors<packed::Lanes>& rows, const packed::Lanes& between,
                          const packed::Lanes& v) {
    using packed::Lanes, packed::LanesMask, packed::Pair, packed::all, packed::both, packed::lanes;
    const Lanes zero = all(0), size = all(sum((abs(between) + abs(v)) + (ha + hb)));
    const ClearBoxAxes boxes{rows, ha, hb, size * all(0x1p-46)};
    const LanesMask in_range = (size <= all(packed::most_length)) & (all(1 / packed::most_length) <= size) &
                               (zero <= min(ha, hb)) & boxes.in_range() & of_a.clear() & of_b.clear();

    const packed::Vectors<Lanes> D = spread(of_a.into(between)), V = spread(of_a.into(v));
    const Lanes until = all(1 + 0x1p-9);
    ClearTimes times{zero, all(-ClearEntry::never), until,
                     until};  // in_most may be before the start: then they overlap
    Lanes entered[5];
    int group = 0;
    const auto visit = [&](const auto& along, const Lanes& reach, const Lanes& noise, const Lanes&) {
      const ClearTimes of_axes = ClearTimes::of(along(D), along(V), reach, noise);
      times = shared(of_axes, times);
      entered[group++] = of_axes.in_most;
    };
    clear = all_of(in_range), time = both(ClearEntry::never), normal = from_a = zero;
    boxes.each_group_of_faces(visit);  // they tell most misses
    if (all_of(smallest_of(times.out_most) < largest_of(times.in_least))) return;
    boxes.each_group_of_products(visit);
    const Pair first = largest_of(times.in_least), last = smallest_of(times.out_most);
    const Pair first_most = largest_of(times.in_most), last_least = smallest_of(times.out_least);
    if (all_of(last < first)) return;

    const Lanes near = all(first);
    unsigned last_ones = 0;
    for (unsigned i = 0; i < 5; ++i) last_ones |= bits(near <= entered[i]) << 3U * i;
    const unsigned axes = boxes.one_axis_of(last_ones);
    const bool lies_level = axes != last_ones, meets = all_of((first_most <= last_least) & (both(0) < first));
    const ClearAxis& k = ClearAxis::of(axes);

    // Once more along its normal n, across two edges: an axis leans to its face by roundings, which count by all of the face. f and g are
    // n in the axes of a and b.
    const LanesMask is_own = zero < all(k.own), is_its = zero < all(k.its);
    const LanesMask along_a = packed::lowest(k.edge_a), along_b = packed::lowest(k.edge_b);
    const Lanes edge_a = select(is_its, of_b.axis(k.first), of_a.axis(k.first));
    const Lanes edge_b = select(is_own, of_a.axis(k.second), of_b.axis(k.second)), n = cross(edge_a, edge_b);
    const Lanes f = of_a.into(n), g = of_b.into(n);
    const Pair cw = two_sums(n * between, n * v), nn = dot(n, n), c = firsts(cw);
    time = (abs(c) - (dot(ha, abs(f)) + dot(hb, abs(g)))) / abs(seconds(cw));
    const Lanes side = select(all(c) < zero, all(-1), all(1)), level = size * all(0x1p-40);
    normal = n * side / all(root(nn));

    // where: a corner of the one on the other's face, or where two edges are nearest
    const Lanes to_a = select(along_a, zero, against(zero - ha, f * side)),
                to_b = select(along_b, zero, against(zero - hb, g * side));
    const Lanes corner_b = (between + v * all(time)) - of_b.out_of(to_b);
    const Lanes corner_a = of_a.out_of(to_a), gap = corner_a - corner_b;
    const Lanes on_edge =
        edge_a * all(dot(n, cross(edge_b, gap)) / nn);  // products of which lose less where edges are all but parallel
    from_a = select(is_own, corner_b, select(is_its, corner_a, corner_a + on_edge));
    const LanesMask one_corner =
        ((level < ha * abs(f)) | along_a | is_own) & ((level < hb * abs(g)) | along_b | is_its);
    bool one_place = all_of(one_corner);
    if (lies_level) [[unlikely]] {  // to less than what rounds them along n; else their edges may be met after a's face
      const auto lean = [](const Lanes& half, const Lanes& along) {
        return dot(half, keep(abs(along) <= all(0x1p-20), abs(along)));
      };
      const Pair sizes = dot(ha, of_a.sizes_along(n)) + dot(hb, of_b.sizes_along(n));
      one_place = all_of((lean(ha, f) + lean(hb, g)) * both(0x1p53) <= sizes);
      const BoxPoints<double> points = points_on_level_face(boxes, of_a.into(between + v * all(time)), k.a);
      from_a = of_a.out_of(lanes(points.on_a));
    }
    clear = both(both(clear, both(k.alone, meets)), both(one_place, all_of(both(0x1p-20) <= nn)));
  }
};

}  // namespace thinwall
