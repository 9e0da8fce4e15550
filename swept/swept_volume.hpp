#pragma once
/// What a moving shape covers in one step: exactly, or as a box for the broad phase.

#include <limits>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall {

/// All points the sphere covers during the step: a capsule, exact but for the rounding of its far end.
template <Scalar S> Capsule<S> swept_volume(const Moving<Sphere<S>>& m) {
  return {m.shape.center, m.shape.center + m.displacement, m.shape.radius};
}

/// A box that contains the shape at every time of the step, rounded outward: wider than the tightest one by at most a
/// dozen units in the last place of the coordinates involved.
template <Shape A> Aabb<typename A::Scalar> swept_bounds(const Moving<A>& m) {
  using S = typename A::Scalar;
  const Vec3<S> half_path = m.displacement / S(2);
  const Vec3<S> middle = center(m.shape) + half_path;
  const Vec3<S> half = half_widths(m.shape) + half_path.cwiseAbs();
  const S slack = 4 * std::numeric_limits<S>::epsilon();
  const Vec3<S> outward = (center(m.shape).cwiseAbs() + half) * slack;
  return {middle, half + outward + Vec3<S>::Constant(4 * std::numeric_limits<S>::denorm_min())};
}

}  // namespace thinwall
