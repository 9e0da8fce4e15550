#pragma once
/// The clear cases of capsule_box_entry.hpp: when a moving point first comes within R of the sums of a segment and a box, part by part.
///
/// A guess, and a proof. Slabs that the core lies in, rounded, say when the point may be near it first, and near which part; the ball around
/// that, extended without end, says when it is entered. There a place of the core is proven the nearest: the box's point is the nearest to the
/// segment's by its coordinates, and that of the segment as the slope of their gap n along it vanishes, or points out of its end. A hit is
/// proven where the gap is R to a few roundings and closes, and a plane has parted the two at the start: the distance to a convex core is
/// convex. Its time is a step of Newton's method from there, of which what the gap is off R counts by its square. Else the plane
/// across the gap, which has the core behind it, shows how long before or after there is no contact, n.(p + v t) > reach(n) + R |n|: a miss is
/// proven once these times leave none of the step; and the next guess is the place that is nearest there.

#include <thinwall/capsule/clear_segment_box.hpp>
#include <thinwall/discrete/clear/clear_entry.hpp>

namespace thinwall {

struct ClearWalk {
  bool clear = false;
  packed::Pair time = packed::both(ClearEntry::never);  ///< [1] `never` for a miss
  packed::Lanes normal{};                               ///< unit, out of the core
  ClearNearest nearest{};                               ///< at that time
  packed::Pair closing{}, noise{};                      ///< [length] by the step, and what roundings move a place by
  int rounds = 1;
};

/// The place on the core where no part was known to be nearest.
THINWALL_COLD inline packed::Pair place_afresh(const ClearSegmentBox& core, const packed::Lanes& x) {
  return core.place(x);
}

/// The point p + v t within a step and a segment's and a box's core rounded by R.
THINWALL_HOT ClearWalk clear_walk(const ClearSegmentBox& core, const packed::Lanes& p, const packed::Pair& R) {
  using packed::Lanes, packed::Pair, packed::PairMask, packed::both, packed::all;
  constexpr int most_rounds = 8;
  const Lanes& v = core.v;
  const Pair RR = R * R, speed = dot(v, v), size = sum((abs(p) + abs(v)) + core.sizes);
  const Pair touch = R * (R * both(0x1p-48) + size * both(0x1p-51)), per_R = both(1) / R;
  ClearWalk walk;
  walk.noise = size * both(0x1p-46);
  const bool in_range = all_of((size * both(0x1p-14) <= R) & (size * size * both(0x1p-100) <= speed) &
                               (size <= both(packed::most_length)) & (both(1 / packed::most_length) <= size));
  ClearStretch stretch(both(1 + 0x1p-9));
  Pair s = core.narrow(stretch, p, R, walk.noise), free = stretch.free, last = stretch.last;
  if (all_of(last < free)) {
    walk.clear = in_range;
    return walk;
  }
  Pair now = free;
  for (; in_range && walk.rounds <= most_rounds; ++walk.rounds) {
    const ClearSegmentBox::Aim aim = core.aim(p + v * all(now), s, RR);
    const Pair next = min(max(now + aim.time, free), last);
    if (walk.rounds > 1 && bits((next < now) | (now < next)) == 0U) break;
    now = next;
    const Lanes place = p + v * all(now);
    ClearNearest nearest = core.nearest_to(place, aim.s);
    if (!core.is_nearest(nearest, walk.noise)) [[unlikely]]
      nearest = core.nearest_to(place, place_afresh(core, place));
    const Lanes& n = nearest.gap;
    const Pair of_n = two_sums(n * n, n * v), square = firsts(of_n), along = seconds(of_n), off = square - RR;
    const Pair closing = both(0) - along, beyond = core.beyond(n, nearest);
    if (all_of(abs(off) <= touch)) [[likely]] {
      walk.time = max(now + off * both(0.5) / closing, both(0));
      walk.clear = all_of((both(0) < closing) & (speed * square * both(0x1p-16) < along * along) &
                          (beyond <= size * R * both(0x1p-34)) & (beyond + size * walk.noise < closing * walk.time));
      walk.normal = nearer_unit(n * all(per_R), square * (per_R * per_R));
      walk.closing = closing * per_R;
      walk.nearest = nearest;
      return walk;
    }
    if (all_of((now <= both(0)) & (square < RR))) break;   // it starts within R
    const Pair length = (square * per_R + R) * both(0.5);  // or more, by all that it is not R
    const Pair parted = (dot(n, p - nearest.at) - (beyond + R * length) - walk.noise * length) / abs(along);
    const PairMask wide = RR * both(0x1p-80) <= square, closes = along < both(0);
    free = max(select(wide & closes, parted, free), free);
    last = min(select(wide & (both(0) <= along), both(0) - parted, last), last);
    if (all_of(last < free)) {
      walk.clear = true;
      return walk;
    }
    s = nearest.place;
  }
  return walk;
}

}  // namespace thinwall
