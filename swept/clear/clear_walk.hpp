#pragma once
/// The clear cases of core_entry.hpp: when a moving point first comes within R of a convex core, part by part.
///
/// A guess, and a proof. Slabs that the core lies in, rounded, say when the point may be near it first: where it meets a face or a side, that is
/// when. Else the chord of the part that is nearest then, extended without end, says when that is entered; there the nearest part is asked for
/// again. Each time the plane across the gap n, which has the core behind it, shows how long before or after
/// there is no contact: n.(p + v t) > reach(n) + R |n|. A miss is proven once these times leave none of the step. A hit is proven where the gap
/// is R to a few roundings and closes, and a plane has parted the two at the start: the distance to a convex core is convex. Its time is
/// the plane's own, (n.(p - at) - R |n|) / -n.v, of which what the gap is off R counts by its square.

#include <thinwall/discrete/clear/clear_entry.hpp>
#include <thinwall/discrete/clear/clear_nearest.hpp>

namespace thinwall {

struct ClearWalk {
  bool clear = false;
  packed::Pair time = packed::both(ClearEntry::never);  ///< [1] `never` for a miss
  packed::Lanes normal{};                               ///< unit, out of the core
  ClearNearest nearest{};                               ///< at that time
  packed::Pair closing{}, noise{};                      ///< [length] by the step, and what roundings move a place by
  int rounds = 1;
};

/// The point p + v t within a step and a core rounded by R. The core has bounds, low() and high(), and more slabs, narrow(); the part(x) that is
/// nearest, of which is_still(x) tells whether that is of another place too; how far it reaches along a vector, reach(n), times its length;
/// and `sizes`, whose sum is no less than that of what its numbers come of.
template <class Core>
THINWALL_HOT ClearWalk clear_walk(const Core& core, const packed::Lanes& p, const packed::Lanes& v,
                                  const packed::Pair& R) {
  using packed::Lanes, packed::Pair, packed::both, packed::all;
  constexpr int most_rounds = 8;
  const Pair until = both(1 + 0x1p-9), RR = R * R, speed = dot(v, v), size = sum((abs(p) + abs(v)) + core.sizes);
  const Pair touch = R * (R * both(0x1p-48) + size * both(0x1p-51));
  ClearWalk walk;
  walk.noise = size * both(0x1p-46);
  const bool in_range = all_of((size * both(0x1p-14) <= R) & (size * size * both(0x1p-100) <= speed) &
                               (size <= both(packed::most_length)) & (both(1 / packed::most_length) <= size));
  const Lanes low = core.low(), high = core.high(), middle = (low + high) * all(0.5);
  ClearStretch stretch(until);
  stretch.narrow(p - middle, v, (high - middle) + all(R), all(walk.noise));
  core.narrow(stretch, p, R, walk.noise);
  Pair free = stretch.free, last = stretch.last;
  if (all_of(last < free)) {
    walk.clear = in_range;
    return walk;
  }
  Pair now = min(stretch.first, last);
  typename Core::Part part;
  for (; in_range && walk.rounds <= most_rounds; ++walk.rounds) {
    const Lanes place = p + v * all(now);
    if (walk.rounds == 1 || !core.is_still(place, part)) part = core.part(place);
    const ClearNearest& nearest = part.nearest;
    const Lanes& n = nearest.gap;
    const Pair of_n = two_sums(n * n, n * v), of_p = two_sums(n * p, n * nearest.at), reach = core.reach(n);
    const Pair square = firsts(of_n), along = seconds(of_n), length = root(square);
    const Pair parted = (firsts(of_p) - (reach + R * length) - walk.noise * length) / abs(along);
    const packed::PairMask wide = RR * both(0x1p-80) <= square, closes = along < both(0);
    free = max(select(wide & closes, parted, free), free);
    last = min(select(wide & (both(0) <= along), both(0) - parted, last), last);
    if (all_of(last < free)) {
      walk.clear = true;
      return walk;
    }
    if (all_of(abs(square - RR) <= touch)) {
      const packed::PairMask steep = closes & (speed * square * both(0x1p-16) < along * along);
      const packed::PairMask behind = reach - seconds(of_p) <= size * length * both(0x1p-34);
      walk.clear = all_of((both(0) < free) & steep & behind);
      walk.time = max((firsts(of_p) - (seconds(of_p) + R * length)) / (both(0) - along), both(0));
      walk.normal = n / all(length);
      walk.closing = (both(0) - along) / length;
      walk.nearest = nearest;
      return walk;
    }
    const Pair chord = along * along - nearest.speed * (square - RR), half = root(max(chord, both(0)));
    const packed::PairMask enters = closes & (both(0) < chord);
    const Pair by = select(enters, square - RR, both(0) - (along + half)) / select(enters, half - along, nearest.speed);
    const Pair next = min(max(now + by, free), last);
    if (bits((next < now) | (now < next)) == 0U) break;
    now = next;
  }
  return walk;
}

}  // namespace thinwall
