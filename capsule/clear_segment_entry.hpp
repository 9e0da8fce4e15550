#pragma once
/// The clear cases of ray_capsule.hpp: the side of a rounded segment, or the cap beyond which the side is met, without a jump.
///
/// With k = p x d and w = v x d the side is met when |k + w t| = R |d|: the chord of k + w t and a ball, as in ball_entry.hpp.

#include <thinwall/discrete/clear/clear_entry.hpp>

namespace thinwall {

struct ClearSegmentEntry {
  ClearEntry entry;
  packed::Pair on;  ///< [1] the place on the segment over which it enters, in [0, 1]
};

/// First time at which p + v t is within R > 0 of the segment s * d, s in [0, 1].
THINWALL_HOT ClearSegmentEntry clear_segment_entry(const packed::Lanes& p, const packed::Lanes& v,
                                                   const packed::Lanes& d, const packed::Pair& R) {
  using packed::Lanes, packed::Pair, packed::PairMask, packed::both, packed::all;
  const Pair along = two_sums(p * d, v * d), length = dot(d, d), RR = R * R;
  const ClearChord side(cross(p, d), cross(v, d), RR * length);
  const Pair at = firsts(along) + seconds(along) * side.time();  // along d, in squares of its length
  const PairMask beside = side.RR * both(packed::more_than_rounding) < side.square,
                 within = side.square * both(packed::more_than_rounding) < side.RR;
  const PairMask on_core = (both(0) <= at) & (at <= length), meets = beside & side.pierces() & side.approaches();
  // the cap
  const PairMask far_end = length < both(2) * select(within, firsts(along), at);
  const ClearChord cap(p - all(keep(far_end, both(1))) * d, v, RR);
  const PairMask cap_meets = cap.pierces() & cap.approaches();
  const PairMask cap_clear = (cap.pierces() | cap.passes()) & (RR * both(packed::more_than_rounding) < cap.square);
  const PairMask beyond = (firsts(along) < both(0)) | (length < firsts(along));

  const PairMask parallel = side.speed <= both(0);
  const PairMask misses_side = beside & (side.passes() | parallel | (side.pierces() & (both(0) <= side.toward)));
  const PairMask asks_cap = (within & beyond) | (meets & ((at < both(0)) | (length < at)));
  // seen from 2^14 R away a graze is not clear, nor is the place on a core of 2^10 R
  const PairMask in_range = cap.in_range() & (both(packed::least_square) <= length) & (length * both(0x1p-20) <= RR) &
                            (dot(p, p) * both(0x1p-28) <= RR) &
                            ((cap.speed * length * both(0x1p-60) <= side.speed) | parallel);
  const Pair time =
      select(meets & on_core, side.time(), select(asks_cap & cap_meets, cap.time(), both(ClearEntry::never)));
  const Pair on = max(min((firsts(along) + seconds(along) * time) / length, both(1)), both(0));
  const bool clear = all_of(in_range & (misses_side | (meets & on_core) | (asks_cap & cap_clear)));
  return {{clear, time, unit((p - d * all(on)) + v * all(time))}, on};
}

}  // namespace thinwall
