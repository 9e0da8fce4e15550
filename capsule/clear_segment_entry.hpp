#pragma once
/// The clear cases of ray_capsule.hpp. A rounded segment is its side and the balls around its ends, so it is entered at the earliest of three
/// times; none of them waits for another, and the balls are asked side by side.
///
/// With k = p x d and w = v x d the side is met when |k + w t| = R |d|: the chord of k + w t and a ball, as in ball_entry.hpp.

#include <thinwall/discrete/clear/clear_entry.hpp>

namespace thinwall {

namespace packed {
/// Two vectors side by side.
struct Vectors {
  Pair x, y, z;
};
THINWALL_HOT Vectors side_by_side(const Vec3<double>& a, const Vec3<double>& b) {
  return {{Two{a[0], b[0]}}, {Two{a[1], b[1]}}, {Two{a[2], b[2]}}};
}
THINWALL_HOT Vectors twice(const Vec3<double>& a) { return {both(a[0]), both(a[1]), both(a[2])}; }
THINWALL_HOT Pair firsts(const Pair& a, const Pair& b) { return {__builtin_shufflevector(a.v, b.v, 0, 2)}; }
THINWALL_HOT Pair swapped(const Pair& a) { return {__builtin_shufflevector(a.v, a.v, 1, 0)}; }
/// What two components, of two vectors side by side, give to their product: twice.
THINWALL_HOT Pair minor(const Pair& a, const Pair& b) {
  const Pair products = a * swapped(b);
  return firsts(products) - seconds(products);
}
THINWALL_HOT Vectors operator-(const Vectors& a, const Vectors& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
THINWALL_HOT Pair dot(const Vectors& a, const Vectors& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
THINWALL_HOT Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
}  // namespace packed

struct ClearSegmentEntry {
  bool clear, passes;  ///< `passes`: the line clearly passes the side, which is a miss, whatever `clear` says
  packed::Pair time;   ///< [1] >= 0, twice; ClearEntry::never for a miss
  packed::Pair on;     ///< [1] the place on the segment over which it enters, in [0, 1]
};

/// First time at which p + v t is within R > 0 of the segment s * d, s in [0, 1]. `ends` is p from its start, and from its end; v and d
/// stand twice.
THINWALL_HOT ClearSegmentEntry clear_segment_entry(const packed::Vectors& ends, const packed::Vectors& v,
                                                   const packed::Vectors& d, const packed::Pair& R) {
  using packed::Pair, packed::PairMask, packed::Vectors, packed::both;
  const Pair zero = both(0), RR = R * R;
  const Vectors pv = {firsts(ends.x, v.x), firsts(ends.y, v.y), firsts(ends.z, v.z)};
  // the side, of p and of v: what is across d and what is along it
  const Vectors across = cross(pv, d);
  const Pair squares = dot(across, across), along = dot(pv, d), length = dot(d, d);
  const Pair k_k = firsts(squares), w_w = seconds(squares), RR_d = RR * length;
  const Pair k_w = across.x * swapped(across.x) + across.y * swapped(across.y) + across.z * swapped(across.z);
  const Vectors of_side = {minor(across.y, across.z), minor(across.z, across.x), minor(across.x, across.y)};  // k x w
  const Pair off = dot(of_side, of_side), reach = w_w * RR_d;
  const PairMask side_passes = reach < off * both(packed::beside_graze);
  const PairMask side_pierces = off < reach * both(packed::beside_graze);
  const Pair side = (k_k - RR_d) / (root(max(reach - off, zero)) - k_w);
  const Pair from = firsts(along), at = from + seconds(along) * side;  // along d, in squares of its length
  const PairMask side_meets = side_pierces & (k_w < zero) & (zero <= side) & (zero <= at) & (at <= length);

  // the balls around the start and the end
  const Vectors moment = cross(ends, v);
  const Pair speed = dot(v, v), square = dot(ends, ends), approach = dot(ends, v);
  const Pair ball_off = dot(moment, moment), ball_reach = speed * RR;
  const Pair ball = (square - RR) / (root(max(ball_reach - ball_off, zero)) - approach);
  const PairMask pierces = ball_off < ball_reach * both(packed::beside_graze);
  const PairMask passes = ball_reach < ball_off * both(packed::beside_graze);
  const Pair by_ball = select(pierces & (approach < zero) & (zero <= ball), ball, both(ClearEntry::never));
  const Pair earliest = min(by_ball, select(side_meets, side, both(ClearEntry::never)));
  const Pair time = min(firsts(earliest), seconds(earliest));
  const Pair on = min(max((from + seconds(along) * time) / length, zero), both(1));

  const PairMask parallel = w_w <= zero, aslant = speed * length * both(0x1p-60) <= w_w;  // else w is rounding
  const PairMask side_clear = ((side_pierces | side_passes) & aslant) | parallel;
  const PairMask outside = (RR * both(packed::more_than_rounding) < square) &
                           ((RR_d * both(packed::more_than_rounding) < k_k) | (from < zero) | (length < from));
  // seen from 2^14 R away a graze is not clear, nor is the place on a core of 2^10 R
  const PairMask in_range = (both(packed::least_square) <= min(min(length, RR), speed)) &
                            (max(max(length, square), speed) <= both(packed::most_square)) &
                            (max(length * both(0x1p8), square) <= RR * both(0x1p28)) &
                            (square * both(packed::short_path) < speed);
  return {all_of(in_range & outside & side_clear & (pierces | passes)), all_of(in_range & side_passes & aslant), time,
          on};
}

}  // namespace thinwall
