#pragma once
/// When the shadows of two moving shapes overlap, on one axis after another: before the last of them begins and after the
/// first of them ends, some axis separates the shapes.
/// Source: Ericson, Real-Time Collision Detection, 2005, section 5.5.8.

#include <limits>

#include <thinwall/discrete/numbers/range.hpp>

namespace thinwall {

template <Scalar S> struct SharedTime {
  S first = -std::numeric_limits<S>::infinity();  ///< [1] from when; at most 0: they overlap at the start
  S last = std::numeric_limits<S>::infinity();    ///< [1] until when; before `first`: never
  int decided_by = -1;                            ///< number of the axis that decided `first`

  /// Shadows whose middles are `distance` apart and move at `speed`, and that reach `reach` from there together.
  /// An axis of length zero is 0 / 0, which changes nothing; without speed the quotients are infinite, or 0 / 0 where the
  /// shadows touch.
  THINWALL_HOT void narrow(int axis, const S& distance, const S& speed, const S& reach) {
    using std::copysign;
    const S ahead = copysign(reach, speed);
    const S enter = (-ahead - distance) / speed, leave = (ahead - distance) / speed;
    if (enter > first) decided_by = axis;
    first = enter > first ? enter : first;
    last = leave < last ? leave : last;
  }
  /// The shadows overlap on all axes at some time >= 0.
  bool ever() const { return first <= last && last >= S(0); }
};

}  // namespace thinwall
