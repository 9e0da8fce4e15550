#pragma once
/// A plane between two moving shapes, and for how long it parts them: the proof behind every method that is never late.
///
/// Across a fixed direction n the gap between the shadows of two translating shapes is linear in time. Where it exceeds
/// the minimal separation the shapes are apart, whatever n is: a poor normal makes a weak proof, never a wrong one. Both
/// numbers are rounded outward, so that the proof holds for the shapes as given, not for their rounded poses.
///
/// Source: derived in docs/methods.md.

#include <algorithm>
#include <limits>

#include <thinwall/swept/reach_along.hpp>
#include <thinwall/swept/serves.hpp>

namespace thinwall {

/// The gap across the plane at time t, less the minimal separation, is at least gap - closing * t.
template <Scalar S> struct SeparatingPlane {
  S gap = 0;      ///< [length] at the start, rounded down; <= 0: it does not part the shapes there
  S closing = 0;  ///< [length] per step, rounded up; <= 0: it never shrinks

  /// True if the shapes are apart at `time`. So they are between two times at which they are.
  bool free_at(const S& time) const {
    const S closed = closing * time;
    return gap > closed + largest(closed) * (2 * std::numeric_limits<S>::epsilon());
  }

  /// True if the shapes are apart at `time` and ever after.
  bool free_from(const S& time) const { return closing <= S(0) && free_at(time); }

  /// Nothing touches before this time >= 0, which may lie far beyond the step.
  S free_until() const {
    if (!(gap > S(0))) return S(0);
    if (closing <= S(0)) return std::numeric_limits<S>::infinity();
    const S time = gap / closing;
    if (time > S(2)) return time;
    const S slack = time * (2 * std::numeric_limits<S>::epsilon()) + std::numeric_limits<S>::denorm_min();
    return std::max(S(0), S(time - slack));
  }
};

/// The plane across the unit vector n, from A towards B.
template <Shape A, Shape B>
SeparatingPlane<typename A::Scalar> separating_plane(const Moving<A>& a, const Moving<B>& b,
                                                     const Vec3<typename A::Scalar>& n,
                                                     const typename A::Scalar& min_separation) {
  using S = typename A::Scalar;
  constexpr int tiny = 64;  // products of the smallest lengths vanish: a few dozen of them, each by one unit at most
  const S u = std::numeric_limits<S>::epsilon() / 2, least = tiny * std::numeric_limits<S>::denorm_min();
  const Vec3<S> path = relative_displacement(a, b);
  const S between = n.dot(center(b.shape) - center(a.shape));
  const S reach = reach_along(a.shape, n) + reach_along<S>(b.shape, -n) + min_separation;
  const Vec3<S> weight = n.cwiseAbs();
  const S size = weight.dot(coordinate_sizes(a.shape) + coordinate_sizes(b.shape)) + min_separation;
  SeparatingPlane<S> plane;
  plane.gap = (between - reach) - (16 * u * size + least);
  plane.closing = n.dot(path) + (8 * u * weight.dot(path.cwiseAbs()) + least);
  return plane;
}

/// Where closest points found at one time lie after another `elapsed` [1] of the step: the middle of the two.
template <Scalar S, class A, class B>
Vec3<S> middle_after(const Moving<A>& a, const Moving<B>& b, const Separation<S>& closest, const S& elapsed) {
  return ((closest.point_a + a.displacement * elapsed) + (closest.point_b + b.displacement * elapsed)) / S(2);
}

}  // namespace thinwall
