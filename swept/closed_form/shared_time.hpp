#pragma once
/// When the shadows of two moving shapes overlap, on one axis after another: before the last of them begins and after the
/// first of them ends, some axis separates the shapes.
/// Source: Ericson, Real-Time Collision Detection, 2005, section 5.5.8.

#include <algorithm>
#include <limits>

#include <thinwall/discrete/numbers/range.hpp>

namespace thinwall {

template <Scalar S> struct SharedTime {
  S first = -std::numeric_limits<S>::infinity();  ///< [1] from when; at most 0: they overlap at the start
  S last = std::numeric_limits<S>::infinity();    ///< [1] until when; before `first`: never
  S second = first;                               ///< [1] from when but for that axis
  int decided_by = -1;                            ///< number of the axis that decided `first`
  S first_leave = last, last_enter = first;       ///< the other ends of the intervals that decided them

  /// Shadows whose middles are `distance` apart and move at `speed`, and that reach `reach` from there together.
  /// An axis of length zero is 0 / 0, which changes nothing; without speed the quotients are infinite, or 0 / 0 where the
  /// shadows touch.
  void narrow(int axis, const S& distance, const S& speed, const S& reach) {
    using std::copysign;
    const S ahead = copysign(reach, speed);
    const S enter = (-ahead - distance) / speed, leave = (ahead - distance) / speed;
    if (enter > first) decided_by = axis;
    second = enter > first ? first : enter > second ? enter : second;
    first_leave = enter > first ? leave : first_leave;
    first = enter > first ? enter : first;
    last_enter = leave < last ? enter : last_enter;
    last = leave < last ? leave : last;
  }
  /// The shadows overlap on all axes at some time >= 0.
  bool ever() const { return first <= last && last >= S(0); }
  /// A few roundings of the lengths may decide whether they ever do: the ends of an axis's interval, the farther one, are those
  /// lengths over its speed.
  bool close() const {
    const S first_size = std::max(largest(first), largest(first_leave)),
            last_size = std::max(largest(last), largest(last_enter));
    const S noise = 8 * std::numeric_limits<S>::epsilon() * (first_size + last_size);
    return is_finite(noise) && largest(S(last - first)) <= noise;
  }
};

}  // namespace thinwall
