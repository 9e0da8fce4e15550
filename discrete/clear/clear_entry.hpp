#pragma once
/// The clear cases of ball_entry.hpp and rounded_box_entry.hpp, which are nearly all: the same arithmetic, without jumps.
///
/// An entry is clear if no rounding decides it, no product over- or underflows and the start is outside. Every comparison is written
/// so that what is not a number is not clear; docs/closed_forms.md has each filter and why it suffices. Where nothing is contracted
/// into fused operations, a clear entry has the careful form's bits.

#include <thinwall/discrete/clear/lanes.hpp>

namespace thinwall {

/// When a moving point enters a body.
struct ClearEntry {
  static constexpr double never = 0x1p1000;

  bool clear;
  packed::Pair time;     ///< [1] >= 0, twice; `never` for a miss
  packed::Lanes normal;  ///< unit, out of the body; of no meaning for a miss
  int rounds = 1;        ///< how many closed forms were solved, as the careful form counts
};

/// Squares of lengths and displacements between which no product of four of them is out of range.
inline constexpr double least_square = 0x1p-120, most_square = 0x1p120;
/// A path this part of the distance, squared, moves a time by less than 2^-14 for all roundings together.
inline constexpr double short_path = 0x1p-50;
/// Sums of lengths that slabs may have: they are compared and divided alone.
inline constexpr double most_length = 0x1p60;
/// A sum of squares is a dozen roundings off; where two differ by this factor, which is larger is clear, and a time's condition, which
/// grows near a graze, is below 2^10.
inline constexpr double beside_graze = 1 - 0x1p-10;
/// Sums and quotients of a few terms are clear where they differ by this factor.
inline constexpr double more_than_rounding = 1 + 0x1p-44;
THINWALL_HOT packed::PairMask clearly_apart(const packed::Pair& a, const packed::Pair& b) {
  return (a * packed::both(more_than_rounding) < b) | (b * packed::both(more_than_rounding) < a);
}

/// The line p + v t and the ball of radius R around the origin, by the moment p x v. Each number twice.
struct ClearChord {
  packed::Pair speed, toward, square, off, RR, reach, half;
  packed::Lanes moment;

  THINWALL_HOT ClearChord(const packed::Lanes& p, const packed::Lanes& v, const packed::Pair& R)
      : RR(R * R), moment(cross(p, v)) {
    const packed::Pair of_v = two_sums(v * v, p * v), of_p = two_sums(p * p, moment * moment);
    speed = firsts(of_v), toward = seconds(of_v), square = firsts(of_p), off = seconds(of_p);
    reach = speed * RR;
    half = root(max(reach - off, packed::both(0)));
  }
  THINWALL_HOT packed::PairMask in_range() const {
    using packed::both;
    return (both(least_square) <= min(RR, speed)) & (max(square, speed) <= both(most_square)) &
           (square * both(short_path) < speed);
  }
  THINWALL_HOT packed::PairMask pierces() const { return off < reach * packed::both(beside_graze); }
  THINWALL_HOT packed::PairMask passes() const { return reach < off * packed::both(beside_graze); }
  THINWALL_HOT packed::PairMask approaches() const { return toward < packed::both(0); }
  THINWALL_HOT packed::Pair time() const { return (square - RR) / (half - toward); }
  THINWALL_HOT packed::Lanes normal(const packed::Lanes& v) const { return unit(cross(v, moment) - v * all(half)); }
};

/// The point p + v t and the ball of radius R around the origin.
THINWALL_HOT ClearEntry clear_ball_entry(const packed::Lanes& p, const packed::Lanes& v, const packed::Pair& R) {
  using packed::both;
  const ClearChord chord(p, v, R);
  const packed::PairMask outside = chord.RR * both(more_than_rounding) < chord.square;
  const packed::PairMask pierces = chord.pierces();
  return {all_of(chord.in_range() & outside & (pierces | chord.passes())),
          select(pierces & chord.approaches(), chord.time(), both(ClearEntry::never)), chord.normal(v)};
}

/// The unit vector along the lowest axis of those whose bits are set, against the motion v.
THINWALL_HOT packed::Lanes clear_face_normal(unsigned axes, const packed::Lanes& v) {
  return keep(packed::lowest(axes), against(packed::all(1), v));
}

/// When p + v t is in the box [-h, h] widened by R, as if it moved downwards on every axis; not later than `until`.
struct ClearSlabs {
  packed::Lanes P, W, low, high, enter, leave;
  packed::Pair first, last;
  bool clear;  ///< which of the two is first, and that the start is outside

  THINWALL_HOT ClearSlabs(const packed::Lanes& p, const packed::Lanes& v, const packed::Lanes& h,
                          const packed::Lanes& R, double until)
      : P(against(p, v)),
        W(abs(v)),
        low(P - h),
        high(P + h),
        enter(max((low - R) / W, packed::all(0))),
        leave(min((high + R) / W, packed::all(until))),
        first(largest_of(enter)),
        last(smallest_of(leave)) {
    using packed::all, packed::both;
    const packed::LanesMask in_range = (abs(p) + W + h <= all(most_length)) & (all(0) <= h) & (all(0) <= R);
    const packed::LanesMask outside = R * all(more_than_rounding) < abs(p) - h;
    const packed::PairMask apart = abs(last) * both(more_than_rounding - 1) < abs(first - last);
    clear = both(both(all_of(in_range), any_of(outside)), all_of(apart));
  }

  /// The same where every length is off by up to `noise` > 0, as it is once p and v have been turned.
  THINWALL_HOT bool clear_of(const packed::Lanes& R, const packed::Lanes& noise) const {
    using packed::both;
    const packed::Lanes off = noise / W;
    const packed::PairMask shared = largest_of(enter + off) < smallest_of(leave - off);
    const packed::PairMask never_shared = smallest_of(leave + off) < largest_of(enter - off);
    const packed::LanesMask outside = R + noise + noise < abs(P) - (high - P);
    return both(both(clear, any_of(outside)), both(all_of(packed::all(0) < W), all_of(shared | never_shared)));
  }
};

/// The point p + v t and the box [-h, h] rounded by R > 0. Where the widened slabs are first shared the point is beside a face, which
/// it meets then, or beside an edge or a corner, whose ball it meets, or passes, or leaves for the next part. The squared distance is
/// convex: what passes a part while beside it is nowhere nearer.
/// `turned`: p and v were, and every length is off by up to `noise`, which is at most 2^-20 of R where the box is not met on a face.
template <bool turned = false>
THINWALL_HOT ClearEntry clear_box_entry(const packed::Lanes& p, const packed::Lanes& v, const packed::Lanes& h,
                                        const packed::Pair& R, const packed::Lanes& noise = packed::all(0)) {
  using packed::Lanes, packed::LanesMask, packed::Pair, packed::PairMask, packed::all, packed::both;
  const ClearSlabs slabs(p, v, h, all(R), ClearEntry::never);
  const PairMask misses = slabs.last < slabs.first;
  const Lanes X = slabs.P - all(slabs.first) * slabs.W;
  const unsigned axes = bits((all(slabs.first) < all(slabs.last)) & (h < abs(X)));
  const bool clear = turned ? slabs.clear_of(all(R), noise) : slabs.clear;
  ClearEntry entry{both(clear, both(all_of(both(1 / most_length) <= R), (axes | bits(misses)) != 0)),
                   select(misses, both(ClearEntry::never), slabs.first), clear_face_normal(axes, v)};
  if ((axes & (axes - 1)) == 0) return entry;  // beside a face, or a miss
  const Lanes enter = slabs.low / slabs.W, leave = slabs.high / slabs.W;
  Pair now = slabs.first;
  for (int part = 0; part < 4; ++part) {
    const LanesMask before = all(now) < enter, beyond = leave <= all(now), outside = before | beyond;
    const Pair next = smallest_of(select(before, enter, select(beyond, all(ClearEntry::never), leave)));
    const Lanes q = keep(outside, select(before, slabs.low, slabs.high)), w = keep(outside, all(0) - slabs.W);
    const ClearChord chord(q, w, R);
    ++entry.rounds;
    const Pair root = chord.time();
    const PairMask ahead = chord.pierces() & chord.approaches() & (now * chord.speed <= chord.half - chord.toward);
    const PairMask meets = ahead & (root <= next), stays_out = chord.passes() | (ahead & (next < root));
    const PairMask turns = both(0) < next * chord.speed + chord.toward * both(more_than_rounding);
    PairMask passes = stays_out & chord.passes() & turns;
    if (!turned) passes = passes | (stays_out & (slabs.last < next));
    const PairMask decided = (meets | passes) & chord.in_range();
    if (all_of(decided)) {
      if (turned) entry.clear = both(entry.clear, all_of(noise * all(0x1p20) < all(R)));
      entry.time = select(meets, max(root, now), both(ClearEntry::never));
      entry.normal = against(chord.normal(w), v);
      return entry;
    }
    if (!all_of(stays_out)) break;
    now = next;
  }
  entry.clear = false;
  return entry;
}

}  // namespace thinwall
