#pragma once
/// What of a convex core is nearest to a place: what the clear rung walks by (swept/clear/clear_walk.hpp), and asks for contacts.

#include <thinwall/discrete/clear/lanes.hpp>

namespace thinwall {

/// The point of a core that is nearest to a place, which moves.
struct ClearNearest {
  packed::Lanes at;   ///< the point
  packed::Lanes gap;  ///< from there to the place
  packed::Pair
      speed;  ///< the square of what of the motion is at right angles to the part (corner, edge, face) that it is of
  packed::Pair place;  ///< [1] where on the segment, of a core that is made of one
  bool one = true;     ///< no other point is as near, and which it is no rounding decides
};

/// The number between 0 and 1 that is nearest to x; 0 or 1 for what is not a number.
THINWALL_HOT packed::Pair clear_clamp(const packed::Pair& x) { return max(min(x, packed::both(1)), packed::both(0)); }

}  // namespace thinwall
