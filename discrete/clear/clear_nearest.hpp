#pragma once
/// What of a convex core is nearest to a place: what the clear rung walks by (swept/clear/clear_walk.hpp), and asks for contacts.

#include <thinwall/discrete/clear/clear_answers.hpp>

namespace thinwall {

/// The point of a core that is nearest to a place, which moves.
struct ClearNearest {
  packed::Lanes at;    ///< the point
  packed::Lanes gap;   ///< from there to the place
  packed::Pair place;  ///< [1] where on the segment, of a core that is made of one; or on each of two
};

/// When a path may be near a core: within all slabs that have been asked.
struct ClearStretch {
  /// What an axis's length is taken to be more: where products of it would be lost the slab is too wide, not too narrow.
  static constexpr double least_length = 0x1p-480;

  packed::Pair free, last;  ///< [1] before and after these there is no contact

  THINWALL_HOT explicit ClearStretch(const packed::Pair& until) : free(packed::both(0)), last(until) {}

  /// To when places p + v t, each a number, are within `reach`, or within `noise` of it. One that is, and does not move, tells nothing.
  /// Returns when each enters.
  THINWALL_HOT packed::Lanes narrow(const packed::Lanes& p, const packed::Lanes& v, const packed::Lanes& reach,
                                    const packed::Lanes& noise) {
    using packed::Lanes, packed::all;
    const Lanes P = against(p, v), per_v = all(1) / abs(v), wide = reach + noise;
    const Lanes entered = max((P - wide) * per_v, all(0));
    free = max(free, largest_of(entered));
    last = min(last, smallest_of(min((P + wide) * per_v, all(last))));
    return entered;
  }
};

/// The number between 0 and 1 that is nearest to x; 0 or 1 for what is not a number.
THINWALL_HOT packed::Pair clear_clamp(const packed::Pair& x) { return max(min(x, packed::both(1)), packed::both(0)); }

/// Bodies whose cores are as a point at x and `core` are, R round together; `nearest` of that. The normal is out of the core.
template <class Core>
THINWALL_HOT ClearContact clear_core_contact(const Core& core, const ClearNearest& nearest, const packed::Lanes& x,
                                             double r, double s) {
  using packed::Pair, packed::both, packed::all;
  const packed::Lanes& n = nearest.gap;
  const Pair size = sum(abs(x) + core.sizes) + both(r + s), length = root(dot(n, n)), between = both(r + s) - length;
  const packed::PairMask in_range =
      (size <= both(packed::most_length)) & (both(1 / packed::most_length) <= size) & (both(0) <= packed::pair(r, s));
  const packed::PairMask wide = size * both(0x1p-20) <= length, decided = size * both(0x1p-46) < abs(between);
  const packed::PairMask behind = core.beyond(n, nearest) <= size * length * both(0x1p-40);
  return {all_of(in_range & wide & decided & behind),
          all_of(both(0) < between),
          packed::Lanes{},
          packed::Lanes{},
          n / all(length),
          between};
}

}  // namespace thinwall
