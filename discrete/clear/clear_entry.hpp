#pragma once
/// The clear cases of ball_entry.hpp and rounded_box_entry.hpp, which are nearly all: the same arithmetic, without jumps.
///
/// An entry is clear if no rounding decides it, nothing that counts over- or underflows and the start is outside. Every comparison is
/// written so that what is not a number is not clear; docs/closed_forms.md has each filter and why it suffices. Where nothing is
/// contracted into fused operations, the time of a clear entry that is not turned has the careful form's bits, but for ties.

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

// ---- What the filters compare with.

namespace packed {
/// Squares of lengths and displacements between which no product of four of them is out of range.
inline constexpr double least_square = 0x1p-120, most_square = 0x1p120;
/// Times above which no quotient has underflowed.
inline constexpr double least_time = 0x1p-900;
/// A path this part of the distance, squared, moves a time by less than 2^-14 for all roundings together.
inline constexpr double short_path = 0x1p-50;
/// Sums of lengths that slabs may have: they are compared and divided alone.
inline constexpr double most_length = 0x1p60;
/// Farther from a graze than this a time's condition, which grows near it, is below 2^10, and a dozen roundings of a moment decide nothing
/// unless it is of a path 2^40 radii off, where they are those of the coordinates.
inline constexpr double beside_graze = 1 - 0x1p-10;
/// Sums and quotients of a few terms are clear where they differ by this factor.
inline constexpr double more_than_rounding = 1 + 0x1p-44;
/// Lengths this many times what roundings move them by are told from afar, and so are the times of their planes: of two of these the earlier
/// is clear if it is before this part of the later.
inline constexpr double from_afar = 0x1p24, clearly_earlier = 1 - 0x1p-20;
/// Whether a contact comes within the step is the careful rung's to say where it comes this near the end.
inline constexpr double near_end = 0x1p-10;
}  // namespace packed

THINWALL_HOT packed::PairMask clearly_apart(const packed::Pair& a, const packed::Pair& b) {
  return b * packed::both(packed::more_than_rounding - 1) < abs(a - b);
}

/// The line p + v t and the ball around the origin whose radius squared is RR, by the moment p x v. Each number twice.
struct ClearChord {
  packed::Pair speed, toward, square;  ///< v.v, p.v (negative: it approaches) and p.p
  packed::Pair off, RR, reach;         ///< |p x v|^2, which is below v.v R^2 where the line pierces the ball
  packed::Pair half;                   ///< half the chord times |v|
  packed::Pair per_length;             ///< 1 / (v.v R): asked beside the root, not after it
  packed::Lanes moment;

  THINWALL_HOT ClearChord(const packed::Lanes& p, const packed::Lanes& v, const packed::Pair& R)
      : RR(R * R), moment(cross(p, v)) {
    const packed::Pair of_v = two_sums(v * v, p * v), of_p = two_sums(p * p, moment * moment);
    speed = firsts(of_v), toward = seconds(of_v), square = firsts(of_p), off = seconds(of_p);
    reach = speed * RR;
    half = root(max(reach - off, packed::both(0)));
    per_length = packed::both(1) / (speed * R);
  }
  THINWALL_HOT packed::PairMask in_range() const {
    using packed::both;
    return (both(packed::least_square) <= min(RR, speed)) & (max(square, speed) <= both(packed::most_square)) &
           (square * both(packed::short_path) < min(speed, RR));
  }
  THINWALL_HOT packed::PairMask pierces() const { return off < reach * packed::both(packed::beside_graze); }
  THINWALL_HOT packed::PairMask passes() const { return reach < off * packed::both(packed::beside_graze); }
  THINWALL_HOT packed::PairMask approaches() const { return toward < packed::both(0); }
  THINWALL_HOT packed::Pair time() const { return (square - RR) / (half - toward); }
  /// Unit to a few roundings: v.v R^2 is moment^2 + half^2, and the moment leans on v by no more than 2^-27 from as far as 2^25 R.
  THINWALL_HOT packed::Lanes normal(const packed::Lanes& v) const {
    return (cross(v, moment) - v * all(half)) * all(per_length);
  }
};

/// The point p + v t and the ball of radius R around the origin.
THINWALL_HOT ClearEntry clear_ball_entry(const packed::Lanes& p, const packed::Lanes& v, const packed::Pair& R) {
  using packed::both;
  const ClearChord chord(p, v, R);
  const packed::PairMask outside = chord.RR * both(packed::more_than_rounding) < chord.square;
  const packed::PairMask pierces = chord.pierces();
  return {all_of(chord.in_range() & outside & (pierces | chord.passes())),
          select(pierces & chord.approaches(), chord.time(), both(ClearEntry::never)), nearer_unit(chord.normal(v))};
}

/// The unit vector along an axis, against the motion v.
THINWALL_HOT packed::Lanes clear_face_normal(const packed::LanesMask& axis, const packed::Lanes& v) {
  return keep(axis, against(packed::all(1), v));
}

/// When p + v t is in the box [-h, h] widened by R >= 0, as if it moved downwards on every axis; not later than `until`.
struct ClearSlabs {
  packed::Lanes P, W;          ///< the place and the speed so seen
  packed::Lanes low, high;     ///< how far it is to where the slabs begin and end, not widened
  packed::Lanes size, extent;  ///< [length] of place and box on an axis, and with the path
  packed::Lanes enter, leave;  ///< [1] when it is in the widened slabs
  packed::Pair first, last;    ///< [1] when it is in all of them: last < first, never
  packed::Pair time;           ///< [1] `first`, or `never`
  packed::LanesMask in_range;

  THINWALL_HOT ClearSlabs(const packed::Lanes& p, const packed::Lanes& v, const packed::Lanes& h,
                          const packed::Lanes& R, double until)
      : P(against(p, v)),
        W(abs(v)),
        low(P - h),
        high(P + h),
        size(abs(p) + h),
        extent(size + W),
        enter(max((low - R) / W, packed::all(0))),
        leave(min((high + R) / W, packed::all(until))),
        first(largest_of(enter)),
        last(smallest_of(leave)),
        time(select(last < first, packed::both(ClearEntry::never), first)),
        in_range((extent <= packed::all(packed::most_length)) & (packed::all(0) <= h)) {}
  /// Which of `first` and `last` comes first, as bits: 1 where they pass by each other, 2 where it enters, which then is of a start outside if
  /// nothing is widened; 0 if that is not clear.
  THINWALL_HOT unsigned order() const {
    using packed::both;
    const packed::Pair ends = firsts(last, first), least = both(packed::least_time);
    return bits((ends * both(packed::more_than_rounding) + least < swapped(ends)) & (least < firsts(both(1), first)));
  }
  /// Whether it enters, and by which axis, where nothing is widened; clear if it does not, or the axis is one and no rounding of its time, told
  /// for another's, is more than that one's own.
  struct Last {
    bool clear, meets;
    packed::LanesMask axis;
  };
  THINWALL_HOT Last last_entered() const {
    using packed::all, packed::both;
    const packed::LanesMask late = all(first * both(packed::clearly_earlier)) <= enter;
    const unsigned axes = bits(late), sure = bits(late & (size * all(0x1p-28) <= low)), verdict = order();
    const unsigned by_one = packed::is_one_axis(axes) & static_cast<unsigned>(axes == sure);
    return {(verdict & (1U | by_one << 1U)) != 0U, verdict == 2U, late};
  }
};

/// Whether a path is in a box's slabs at one time, where every length is off by up to `noise` > 0, as it is once p and v have been turned:
/// at one, at none, or neither is clear. It enters slab i before it leaves slab j if near_i W_j < far_j W_i; nothing is divided. Of a
/// start outside on some axis: a slab that has been left by then is out of order with that axis.
struct ClearOrder {
  bool meets, misses;

  THINWALL_HOT ClearOrder(const packed::Lanes& near, const packed::Lanes& far, const packed::Lanes& speed,
                          const packed::Lanes& noise, double until) {
    using packed::Lanes, packed::LanesMask, packed::all;
    const Lanes W = max(speed, all(least_speed)), end = min(all(until), all(most_time)) * W, next = yzx(W);
    const Lanes near_least = near - noise, near_most = near + noise, far_least = far - noise, far_most = far + noise;
    const LanesMask in_order = (near_most * next < yzx(far_least) * W) & (yzx(near_most) * W < far_least * next);
    const LanesMask apart = (yzx(far_most) * W < near_least * next) | (far_most * next < yzx(near_least) * W);
    meets = all_of(in_order & (near_most < end));
    misses = any_of(apart | (end < near_least) | (far_most < all(0)));
  }
  /// What moves less stays where it is: their product is no length.
  static constexpr double least_speed = 0x1p-1000, most_time = 0x1p800;
  /// What moves by as much on some axis is past all lengths by that time.
  static constexpr double least_motion = 0x1p-700;
};

/// What roundings move a place of a path past a box by, at most: those of turning it into the box's axes, three a component, too.
THINWALL_HOT packed::Lanes clear_noise(const packed::Lanes& p, const packed::Lanes& h) {
  return all(sum(abs(p) + h) * packed::both(0x1p-48));
}

/// The point p + v t and the box [-h, h] rounded by R, which is 2^20 times the noise or more; `turned` if p and v were, and the normal is
/// to be: that is made unit to a rounding afterwards. Where the widened slabs are first shared the point is beside a face, which it meets
/// then, or beside an edge or a corner, whose ball it meets, or passes, or leaves for the next part. The squared distance is convex: what
/// passes a part while beside it is nowhere nearer.
template <bool turned>
THINWALL_HOT ClearEntry clear_box_entry(const packed::Lanes& p, const packed::Lanes& v, const packed::Lanes& h,
                                        const packed::Pair& R) {
  using packed::Lanes, packed::LanesMask, packed::Pair, packed::PairMask, packed::all, packed::both;
  const ClearSlabs slabs(p, v, h, all(R), ClearEntry::never);
  const Lanes X = slabs.P - all(slabs.first) * slabs.W;
  const Lanes noise = turned ? clear_noise(p, h) : slabs.extent * all(0x1p-48);
  const Lanes near = slabs.low - all(R), far = slabs.high + all(R), margin = noise * all(packed::from_afar);
  const LanesMask off = h < abs(X);
  const unsigned misses = bits(slabs.last < slabs.first) & 1U, axes = bits(off) & (misses - 1U);
  const LanesMask is_round = max(noise * all(0x1p20), all(1 / packed::most_length)) <= all(R);

  // Where the start is this far from where each slab begins and ends, no time is off by more than 2^-24 of itself: not until a slab has been
  // left, and then by no more than keeps it later.
  const Pair almost = both(packed::clearly_earlier);
  const PairMask apart =
      (slabs.last < slabs.first * almost) | ((both(0) < slabs.first) & (slabs.first < slabs.last * almost));
  bool clear = both(all_of(margin <= min(abs(near), abs(far))), all_of(apart));
  if (!clear) [[unlikely]] {
    const ClearOrder order(near, far, slabs.W, noise, ClearEntry::never);
    const Lanes touch = turned ? all(R) + noise + noise : all(R * both(packed::more_than_rounding));
    clear = both(any_of(touch < abs(p) - h), turned ? packed::either(order.meets, order.misses) : slabs.order() != 0U);
  }
  ClearEntry entry{both(clear, all_of(slabs.in_range & is_round)), slabs.time, clear_face_normal(off, v)};
  if ((axes & (axes - 1)) == 0) {
    // A miss; or well beside a face; or beside it, and on one side of the step's end, while it is off.
    const LanesMask well_beside = margin <= select(off, near, h - abs(X));
    if ((misses | static_cast<unsigned>(all_of(well_beside))) != 0) [[likely]]
      return entry;
    const Pair its = two_sums(keep(off, slabs.W), keep(off, noise));
    const LanesMask beside = all(seconds(its)) * slabs.W <= all(firsts(its)) * ((h - noise) - abs(X));
    const PairMask in_time = seconds(its) < firsts(its) * abs(slabs.first - both(1));
    entry.clear = both(entry.clear, both((bits(beside) | axes) == 7U, all_of(in_time)));
    return entry;
  }
  const Lanes enter = slabs.low / slabs.W, leave = min(slabs.high / slabs.W, all(ClearEntry::never));
  const PairMask fine = largest_of(noise) * both(0x1p32) < R;
  Pair now = slabs.first;
  for (int part = 0; part < 4; ++part) {
    const LanesMask before = all(now) < enter, beyond = leave <= all(now), outside = before | beyond;
    const Pair next = smallest_of(select(before, enter, select(beyond, all(ClearEntry::never), leave)));
    const Lanes q = keep(outside, select(before, slabs.low, slabs.high)), w = keep(outside, all(0) - slabs.W);
    const ClearChord chord(q, w, R);
    ++entry.rounds;
    const Pair root = chord.time();
    const PairMask ahead = chord.pierces() & chord.approaches() & (now * chord.speed <= chord.half - chord.toward);
    // when a turned part is left is off by roundings
    const Pair at_least = turned ? next * almost : next, at_most = turned ? root * almost : root;
    const PairMask meets = ahead & (root <= at_least), stays_out = chord.passes() | (ahead & (next < at_most));
    // by then the point recedes; or as good as, within a rounding of a distance of at most 2^16 R
    const PairMask turns =
        (both(0) < next * chord.speed + chord.toward * both(packed::more_than_rounding)) |
        ((both(0) <= next * chord.speed + chord.toward * both(2 - packed::more_than_rounding)) & fine);
    PairMask passes = stays_out & chord.passes() & turns;
    if (!turned) passes = passes | (stays_out & (slabs.last < next));
    const PairMask decided = (meets | passes) & chord.in_range();
    if (all_of(decided)) {
      entry.time = select(meets, max(root, now), both(ClearEntry::never));
      const Lanes normal = chord.normal(w);
      entry.normal = against(turned ? normal : nearer_unit(normal), v);
      return entry;
    }
    if (!all_of(stays_out)) break;
    now = next;
  }
  entry.clear = false;
  return entry;
}

}  // namespace thinwall
