#pragma once
/// The clear cases of segment_box.hpp: what of a segment is nearest to a box, without a jump.

#include <thinwall/discrete/clear/clear_nearest.hpp>
#include <thinwall/discrete/clear/vectors.hpp>

namespace thinwall {

/// The sums of the box [-h, h] and the segment { -s d }, s in [0, 1]: seen from the box's center the segment starts where the place is.
/// Of the points of contact it says the box's. The squared distance from the box along the segment is convex, and a parabola between
/// the places where the segment crosses the planes of the faces: its slope at those shows in which of them it is least.
struct ClearSegmentBox {
  packed::Lanes d, h, v, sizes;

  THINWALL_HOT ClearSegmentBox(const packed::Lanes& core, const packed::Lanes& half, const packed::Lanes& motion)
      : d(core), h(half), v(motion), sizes(abs(core) + half) {}

  /// How far it reaches along a gap n, times its length, beyond the place that the gap is of: on the segment, as the box's point is its own.
  THINWALL_HOT packed::Pair beyond(const packed::Lanes& n, const ClearNearest& nearest) const {
    const packed::Pair slope = dot(n, d), on = slope * nearest.place;
    return max(on, on - slope);
  }

  /// The slabs across each face, and across each of the box's axes and the segment: where an edge is met, or passed. Returns the place
  /// that the one entered last names, seen along it: across a face the end that comes first; across an edge what is nearest to it. All
  /// but one in thirty of the contacts of a capsule are with the part that is nearest then.
  THINWALL_HOT packed::Pair narrow(ClearStretch& stretch, const packed::Lanes& p, const packed::Pair& R,
                                   const packed::Pair& noise) const {
    using packed::Lanes, packed::all;
    const Lanes a = abs(d), zero = all(0), half = all(0.5);
    const Lanes by_face = stretch.narrow(p + d * half, v, (h + a * half) + all(R), all(noise));
    if (all_of(stretch.last < stretch.free)) return stretch.free;  // never: most misses
    // Of each edge, in the order of turned_cross(), a and b of d are across it. Their length from above, by at most 2 %, waits for no root: by
    // the lines through three places of the circle, 22.5 degrees apart.
    const Lanes b = yzx(a), more = max(a, b), less = min(a, b), across = turned_cross(v, d);
    const Lanes length = max(more + less * all(0.1989124), more * all(0.8477591) + less * all(0.5664545)) +
                         all(ClearStretch::least_length);
    const Lanes by_edge =
        stretch.narrow(turned_cross(p, d), across, (h * b + yzx(h) * a) + length * all(R), (a + b) * all(noise));
    const Lanes hd = h * d, pd = d * p, vd = d * v;
    const Lanes corner = against(against(yzx(hd), d) - against(hd, yzx(d)), across);
    const Lanes along = (corner - (pd + yzx(pd))) - (vd + yzx(vd)) * by_edge;
    const Lanes on_edge = max(min(along / (a * a + b * b), all(1)), zero), on_face = keep(zero < vd, all(1));
    const Lanes first = all(stretch.free);
    return largest_of(max(keep(first <= by_edge, on_edge), keep(first <= by_face, on_face)));
  }

  /// When a place p + v t enters the ball around the part of the box that is nearest to the segment's point s then, that part extended without
  /// end; or comes nearest to it, if it passes. Of a side, also where on the segment that is.
  struct Aim {
    packed::Pair time, s;
  };
  THINWALL_HOT Aim aim(const packed::Lanes& x, const packed::Pair& s, const packed::Pair& RR) const {
    using packed::Lanes, packed::Pair, packed::PairMask, packed::all, packed::both;
    const Lanes there = x + d * all(s);
    const packed::LanesMask outside = h < abs(there);
    const Lanes gap = keep(outside, there + against(h, there)), out_d = keep(outside, d), out_v = keep(outside, v);
    const Pair of_d = two_sums(out_d * out_d, out_d * out_v), of_n = two_sums(gap * gap, gap * v);
    const Pair of_v = two_sums(out_v * out_v, out_d * gap), dd = firsts(of_d);
    const PairMask side = (both(0) < s) & (s < both(1)) & (both(0) < dd);
    // What is left of each across d.
    const Pair per_d = keep(side, both(1) / dd), vd = seconds(of_d), nd = seconds(of_v);
    const Pair speed = firsts(of_v) - vd * vd * per_d, along = seconds(of_n) - nd * vd * per_d;
    const Pair within = firsts(of_n) - nd * nd * per_d - RR;
    const Pair chord = along * along - speed * within, half = root(max(chord, both(0)));
    const PairMask enters = (along < both(0)) & (both(0) < chord);
    const Pair time = select(enters, within, both(0) - (along + half)) / select(enters, half - along, speed);
    return {time, clear_clamp(s - (nd + vd * time) * per_d)};
  }

  /// The box's point that is nearest to the segment's point s, and the gap.
  THINWALL_HOT ClearNearest nearest_to(const packed::Lanes& x, const packed::Pair& s) const {
    const packed::Lanes along = d * all(s), moved = x + along, on = held_within(moved, h);
    return {on - along, moved - on, s};
  }

  /// Whether that is nearest of all, where places are off by `noise`: the slope of the gap along the segment vanishes, for what of d is across
  /// the parts; or it points out of an end. Not known where all of a stretch is as near.
  THINWALL_HOT bool is_nearest(const ClearNearest& nearest, const packed::Pair& noise) const {
    using packed::Lanes, packed::Pair, packed::all, packed::both;
    const Lanes &n = nearest.gap, dd = d * d;
    const Pair of_d = two_sums(n * d, keep(all(noise) < abs(n), dd)), slope = firsts(of_d), on = slope * nearest.place;
    const Pair off = slope * slope, square = noise * noise * both(0x1p-6), beyond = max(on, on - slope);
    return all_of((off < seconds(of_d) * square) | ((sum(dd) * square < off) & (beyond <= both(0))));
  }

  /// The place on the segment that is nearest to the box; of a stretch that is all as near the middle.
  THINWALL_HOT packed::Pair place(const packed::Lanes& x) const {
    using packed::Lanes, packed::Pair, packed::all, packed::both;
    const Lanes none = all(0), one = all(1), back = none - h, per_d = one / d;
    const Lanes in = max(min((back - x) * per_d, one), none), out = max(min((h - x) * per_d, one), none);
    const packed::Vectors<Lanes> X = spread(x), D = spread(d), H = spread(h);
    const Lanes slope_in = slope(X, D, H, in), slope_out = slope(X, D, H, out);
    const Pair low = largest_of(max(keep(slope_in <= none, in), keep(slope_out <= none, out)));
    const Pair high = smallest_of(min(select(none <= slope_in, in, one), select(none <= slope_out, out, one)));
    const Pair between = (low + high) * both(0.5);  // of a stretch that is all as near, where low is beyond high
    const Lanes there = x + d * all(between), out_d = keep(h < abs(there), d);
    const Pair of_d = two_sums(out_d * out_d, out_d * (x + against(h, there))), dd = firsts(of_d);
    return select(dd <= both(0), between, min(max((both(0) - seconds(of_d)) / dd, low), high));
  }
  THINWALL_HOT ClearNearest nearest(const packed::Lanes& x) const { return nearest_to(x, place(x)); }

 private:
  using Components = packed::Vectors<packed::Lanes>;
  /// Of the squared distance, halved, at three places on the segment that starts at X. Where it crosses the plane of a face, that face's
  /// axis has no part in it, to the bit: what is level stays so.
  THINWALL_HOT static packed::Lanes slope(const Components& X, const Components& D, const Components& H,
                                          const packed::Lanes& s) {
    using packed::all, packed::mask;
    const packed::LanesMask at_end = (s <= all(0)) | (all(1) <= s);
    return (keep(at_end | mask(false, true, true), slope_of(X.x, D.x, H.x, s)) +
            keep(at_end | mask(true, false, true), slope_of(X.y, D.y, H.y, s))) +
           keep(at_end | mask(true, true, false), slope_of(X.z, D.z, H.z, s));
  }
  THINWALL_HOT static packed::Lanes slope_of(const packed::Lanes& from, const packed::Lanes& along,
                                             const packed::Lanes& half, const packed::Lanes& s) {
    const packed::Lanes at = from + s * along;
    return along * (at - held_within(at, half));
  }
};

}  // namespace thinwall
