#pragma once
/// When the shadows of two moving shapes overlap, on one axis after another: before the last of them begins and after the
/// first of them ends, some axis separates the shapes.
/// Source: Ericson, Real-Time Collision Detection, 2005, section 5.5.8.

#include <algorithm>
#include <limits>

#include <thinwall/discrete/numbers/range.hpp>

namespace thinwall {

/// Several axes tell the same time where they are normal to one flat face, each by roundings of its own. So shadows count as overlapping while
/// they do but for `noise`: but not those that are left at the start; and in the last scalar only those that reach hardly farther than it, as
/// those of level faces without thickness do. All others would be met too soon by it.
template <Scalar S> struct SharedTime {
  /// `size` [length] is at least the sum of all lengths that go into a shadow on any axis; not of the path, of which no more than three times
  /// that lies between the start and a contact. Where a wider scalar has the last word, noise is what leaves it to that; else what level faces
  /// take to be met, 2 u.
  explicit SharedTime(const S& size) : noise(S(has_wider<S> ? 8 : 1) * std::numeric_limits<S>::epsilon() * size) {}

  S noise;                                        ///< [length] what roundings move a shadow by, at most
  S first = -std::numeric_limits<S>::infinity();  ///< [1] from when; at most 0: they overlap at the start
  S last = std::numeric_limits<S>::infinity();    ///< [1] until when; before `first`: never, but for noise
  S second = first;                               ///< [1] from when but for that axis
  int decided_by = -1;                            ///< number of the axis that decided `first`
  S earliest = first, latest = last;              ///< [1] the same of shadows that reach farther by noise
  S surely_first = first, surely_last = last;     ///< [1] the same of shadows that reach less far

  /// Shadows whose middles are `distance` apart and move at `speed`, and that reach `reach` from there together, on an axis the sizes of
  /// whose components add up to `weight`.
  /// An axis of length zero is 0 / 0, which changes nothing; without speed the quotients are infinite, or 0 / 0 where the
  /// shadows touch: then plain numbers decide, as nothing tells when they would.
  void narrow(int axis, const S& distance, const S& speed, const S& reach, const S& weight = S(1)) {
    using std::copysign;
    const S side = copysign(S(1), speed);
    const auto at = [&](const S& ahead) { return S((side * ahead - distance) / speed); };
    const S enter = at(S(-reach)), leave = at(reach), off = noise * weight;
    const bool counts = has_wider<S> || reach <= 4 * off;
    const S wider = speed == S(0) || !counts ? reach : S(reach + off);
    if (enter > first) decided_by = axis;
    second = enter > first ? first : enter > second ? enter : second;
    first = enter > first ? enter : first;
    last = leave < last ? leave : last;
    earliest = std::max(earliest, at(S(-wider)));
    latest = std::min(latest, at(wider));
    surely_first = std::max(surely_first, at(S(off - reach)));
    surely_last = std::min(surely_last, at(S(reach - off)));
  }
  /// The shadows overlap on all axes at some time >= 0, but for noise.
  bool ever() const { return earliest <= latest && latest >= S(0) && (first >= S(0) || last >= S(0)); }
  /// Noise may decide whether they ever do.
  bool close() const { return earliest <= latest && !(surely_first <= surely_last); }
  /// When they first do.
  S time() const { return std::max(S(0), std::min(first, latest)); }
};

}  // namespace thinwall
