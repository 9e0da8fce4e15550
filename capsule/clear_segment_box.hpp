#pragma once
/// The clear cases of segment_box.hpp: what of a segment is nearest to a box, without a jump.

#include <thinwall/discrete/clear/clear_nearest.hpp>
#include <thinwall/discrete/clear/vectors.hpp>

namespace thinwall {

/// The sums of the box [-h, h] and the segment { -s d }, s in [0, 1]: seen from the box's center the segment starts where the place is.
/// Of the points of contact it says the box's. The squared distance from the box along the segment is convex, and a parabola between
/// the places where the segment crosses the planes of the faces: its slope at those shows in which of them it is least.
struct ClearSegmentBox {
  packed::Lanes d, h, v, per_d, sizes;

  THINWALL_HOT ClearSegmentBox(const packed::Lanes& core, const packed::Lanes& half, const packed::Lanes& motion)
      : d(core),
        h(half),
        v(motion),
        per_d(packed::all(1) / core),
        sizes(abs(core) + half),
        D(spread(core)),
        H(spread(half)) {}

  THINWALL_HOT packed::Lanes low() const { return packed::all(0) - h - max(d, packed::all(0)); }
  THINWALL_HOT packed::Lanes high() const { return h - min(d, packed::all(0)); }
  THINWALL_HOT packed::Pair reach(const packed::Lanes& n) const {
    const packed::Pair both = two_sums(abs(n) * h, n * d);
    return firsts(both) - min(seconds(both), packed::both(0));
  }

  THINWALL_HOT packed::Pair beyond(const packed::Lanes& n, const ClearNearest& nearest) const {
    return reach(n) - dot(n, nearest.at);
  }

  /// The slabs across each of the box's axes and the segment: where an edge is met, or passed.
  THINWALL_HOT void narrow(ClearStretch& stretch, const packed::Lanes& p, const packed::Pair& R,
                           const packed::Pair& noise) const {
    const packed::Lanes a = abs(d), b = yzx(a);  // in the order of turned_cross()
    const packed::Lanes length = root(a * a + b * b + packed::all(ClearStretch::least_square));
    stretch.narrow(turned_cross(p, d), turned_cross(v, d), (h * b + yzx(h) * a) + length * packed::all(R),
                   (a + b) * packed::all(noise));
  }

  /// Which part it is of: the faces it is outside of, turned towards the box, and whether it is on the segment's side.
  struct Part {
    ClearNearest nearest;
    packed::LanesMask outside;
    packed::Lanes faces;
    packed::Pair dd;
    packed::PairMask side;
  };

  THINWALL_HOT Part part(const packed::Lanes& x) const {
    using packed::Lanes, packed::LanesMask, packed::Pair, packed::PairMask, packed::all, packed::both;
    const Lanes none = all(0), one = all(1), back = none - h;
    const Lanes in = max(min((back - x) * per_d, one), none), out = max(min((h - x) * per_d, one), none);
    const packed::Vectors<Lanes> X = spread(x);
    const Lanes slope_in = slope(X, in), slope_out = slope(X, out);
    const Pair low = largest_of(max(keep(slope_in <= none, in), keep(slope_out <= none, out)));
    const Pair high = smallest_of(min(select(none <= slope_in, in, one), select(none <= slope_out, out, one)));
    const Pair between = (low + high) * both(0.5);  // of a stretch that is all as near, where low is beyond high
    const Lanes there = x + d * all(between);
    const LanesMask outside = h < abs(there);
    const Lanes out_d = keep(outside, d), out_v = keep(outside, v), faces = against(h, there);
    const Pair of_d = two_sums(out_d * out_d, out_d * (x + faces)), of_v = two_sums(out_v * out_v, out_v * out_d);
    const Pair dd = firsts(of_d);
    const Pair least = min(max((both(0) - seconds(of_d)) / dd, low), high);
    const PairMask level = dd <= both(0);
    const Pair s = select(level, between, least);
    const PairMask side = (both(0) < s) & (s < both(1)) & (both(0) < dd);
    const Lanes moved = x + d * all(s), on = held_within(moved, h);
    const Pair speed = firsts(of_v) - keep(side, seconds(of_v) * seconds(of_v) / dd);
    return {{on - d * all(s), moved - on, speed, s}, outside, faces, dd, side};
  }
  /// Whether at another place it is of the same part still, and then where: the part's own place is in it, and none beside it is nearer. The
  /// distance is convex along the segment.
  THINWALL_HOT bool is_still(const packed::Lanes& x, Part& part) const {
    using packed::Lanes, packed::LanesMask, packed::Pair, packed::PairMask, packed::all, packed::both;
    const Pair along = dot(keep(part.outside, d), x + part.faces);
    const Pair s = select(part.side, (both(0) - along) / part.dd, part.nearest.place);
    const Lanes moved = x + d * all(s), on = held_within(moved, h), gap = moved - on;
    const Pair slope = dot(gap, d);
    const LanesMask faces = (part.outside & (h < abs(moved)) & (moved * part.faces < all(0)));
    const PairMask beside = part.side & (both(0) < s) & (s < both(1));
    const Pair end = part.nearest.place, inwards = select(end <= both(0), slope, both(0) - slope);
    const PairMask at_end = ((end <= both(0)) | (both(1) <= end)) & (both(0) < inwards);
    const bool same_faces = packed::both(bits(faces) == bits(part.outside), bits(h < abs(moved)) == bits(part.outside));
    part.nearest.at = on - d * all(s), part.nearest.gap = gap, part.nearest.place = s;
    return all_of(at_end | beside) && (same_faces || all_of(at_end));
  }

 private:
  /// Of the squared distance, halved, at three places on the segment that starts at X. Where it crosses the plane of a face, that face's
  /// axis has no part in it, to the bit: what is level stays so.
  THINWALL_HOT packed::Lanes slope(const packed::Vectors<packed::Lanes>& X, const packed::Lanes& s) const {
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

  packed::Vectors<packed::Lanes> D, H;
};

}  // namespace thinwall
