#pragma once
/// The clear cases of ray_capsule.hpp. A rounded segment is its side and the balls around its ends, so it is entered at the earliest of three
/// times; none of them waits for another, and the balls are asked side by side.
///
/// With k = p x d and w = v x d the side is met when |k + w t| = R |d|: the chord of k + w t and a ball, as in ball_entry.hpp.

#include <thinwall/discrete/clear/clear_entry.hpp>
#include <thinwall/discrete/clear/vectors.hpp>

namespace thinwall {

/// The line p + v t and the infinite side of the segment s * d rounded by R, and what else is known of the three before any root. `ends` is
/// p from the segment's start, and from its end; v and d stand twice, as all numbers do but `square`, `approach` and `along`.
struct ClearSide {
  packed::Pair length, speed, square, approach;  ///< d.d, v.v, and of each end p.p and p.v
  packed::Pair along;                            ///< p.d, from the start, and v.d
  packed::Pair k_k, w_w, k_w, R, RR, RR_d;       ///< of k = p x d and w = v x d; R, R^2 and R^2 d.d
  packed::Pair off, reach;                       ///< (p.w)^2, which is below w.w R^2 where the line pierces the side

  THINWALL_HOT ClearSide(const packed::Vectors<packed::Pair>& ends, const packed::Vectors<packed::Pair>& v,
                         const packed::Vectors<packed::Pair>& d, const packed::Pair& radius)
      : length(dot(d, d)),
        speed(dot(v, v)),
        square(dot(ends, ends)),
        approach(dot(ends, v)),
        R(radius),
        RR(R * R),
        RR_d(RR * length) {
    using Vectors = packed::Vectors<packed::Pair>;
    const Vectors pv = {firsts(ends.x, v.x), firsts(ends.y, v.y), firsts(ends.z, v.z)}, across = cross(pv, d);
    const Vectors w = {seconds(across.x), seconds(across.y), seconds(across.z)};
    const Vectors k = {firsts(across.x), firsts(across.y), firsts(across.z)};
    const packed::Pair squares = dot(across, across), beside = dot(k, v);
    along = dot(pv, d), k_w = firsts(dot(across, w)), k_k = firsts(squares), w_w = seconds(squares);
    off = beside * beside, reach = w_w * RR;
  }
  THINWALL_HOT packed::PairMask pierces() const { return off < reach * packed::both(packed::beside_graze); }
  THINWALL_HOT packed::PairMask passes() const { return reach < off * packed::both(packed::beside_graze); }
  THINWALL_HOT packed::PairMask in_range() const {
    using packed::both;
    // seen from 2^14 R away a graze is not clear, nor is the place on a core of 2^10 R
    return (both(packed::least_square) <= min(min(length, RR), speed)) & (largest() <= both(packed::most_square)) &
           (max(length * both(0x1p8), square) <= RR * both(0x1p28)) & (square * both(packed::short_path) < speed);
  }
  /// Else w is rounding, or the time more uncertain than what the end of a step is clear by; or the path is all but along the segment, and
  /// what rounding leans w along it counts by the way to its end.
  THINWALL_HOT packed::PairMask aslant() const {
    using packed::both;
    return max(largest() * both(0x1p-50), speed) * length * both(0x1p-10) <= w_w;
  }
  /// Pierced, and at a time that roundings of w hardly move. They lean it along the segment, which moves the line by u |p| over the sine of
  /// the path and the segment; of that counts the normal's share along w, sqrt(off / reach). That share is at most 8 times the sine.
  THINWALL_HOT packed::PairMask is_steady() const {
    return pierces() & (off * (speed * length) * packed::both(0x1p-6) <= reach * w_w);
  }
  THINWALL_HOT packed::Pair largest() const { return max(max(length, square), speed); }
};

struct ClearSegmentEntry {
  packed::PairMask clear;
  packed::Pair time;  ///< [1] >= 0, twice; ClearEntry::never for a miss
  packed::Pair on;    ///< [1] the place on the segment over which it enters, in [0, 1]
};

/// First time at which p + v t is within R > 0 of the segment s * d, s in [0, 1].
THINWALL_HOT ClearSegmentEntry clear_segment_entry(const ClearSide& line, const packed::Vectors<packed::Pair>& ends,
                                                   const packed::Vectors<packed::Pair>& v) {
  using packed::Pair, packed::PairMask, packed::both;
  const Pair zero = both(0), length = line.length;
  const Pair half_side = root(max((line.reach - line.off) * length, zero));
  const Pair quotients = firsts(line.k_k - line.RR_d, both(1)) / firsts(half_side - line.k_w, length);
  const Pair side = firsts(quotients), from = firsts(line.along), by = seconds(line.along), at = from + by * side;
  const PairMask side_meets = line.pierces() & (line.k_w < zero) & (zero <= side) & (zero <= at) & (at <= length);

  // the balls around the start and the end
  const auto moment = cross(ends, v);
  const Pair off = dot(moment, moment), reach = line.speed * line.RR;
  const Pair ball = (line.square - line.RR) / (root(max(reach - off, zero)) - line.approach);
  const PairMask pierces = off < reach * both(packed::beside_graze);
  const PairMask passes = reach < off * both(packed::beside_graze);
  const Pair by_ball = select(pierces & (line.approach < zero) & (zero <= ball), ball, both(ClearEntry::never));
  const Pair earliest = min(by_ball, select(side_meets, side, both(ClearEntry::never)));
  const Pair time = min(firsts(earliest), seconds(earliest));
  const Pair on = min(max((from + by * time) * seconds(quotients), zero), both(1));

  const PairMask side_clear = ((line.is_steady() | line.passes()) & line.aslant()) | (line.w_w <= zero);
  const PairMask outside =
      (line.RR * both(packed::more_than_rounding) < line.square) &
      ((line.RR_d * both(packed::more_than_rounding) < line.k_k) | (from < zero) | (length < from));
  return {line.in_range() & outside & side_clear & (pierces | passes), time, on};
}

/// The unit vector along `gap`, from the segment to where it is entered: clear if that is R long, as it is but for roundings.
struct ClearSegmentNormal {
  packed::PairMask clear;
  packed::Lanes normal;

  THINWALL_HOT ClearSegmentNormal(const ClearSegmentEntry& entry, const ClearSide& line, const packed::Lanes& gap) {
    using packed::both;
    const packed::Lanes about = gap * all(both(1) / line.R);
    const packed::Pair square = dot(about, about);
    clear = (abs(square - both(1)) <= both(0x1p-28)) | (both(ClearEntry::never) <= entry.time);
    normal = nearer_unit(about, square);
  }
};

}  // namespace thinwall
