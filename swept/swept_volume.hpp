#pragma once
/// What a moving shape covers in one step: exactly, as tightly as a box can, or loosely (docs/swept_volumes.md).
/// Requires coordinates whose sums do not overflow.

#include <limits>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/directions.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall {

/// All points the sphere covers during the step: a capsule, exact but for the rounding of its far end.
template <Scalar S> Capsule<S> swept_volume(const Moving<Sphere<S>>& m) {
  return {m.shape.center, m.shape.center + m.displacement, m.shape.radius};
}

/// The oriented box of least volume that contains the axis-aligned box during the whole step and has one axis along the
/// motion. Seen along the motion the box is a hexagon, and the rectangle of least area around it has a side along one
/// of the hexagon's: along the shadow of one of the three edges. All three are tried.
/// Error: contains the moving box to rounding, a few u of the coordinates involved.
/// Degenerate: motion along an axis gives the exact box, axis-aligned; no motion the box itself; of rectangles of equal
/// area the one along the edge of lowest axis.
/// Source: derived in docs/swept_volumes.md.
template <Scalar S> Obb<S> swept_volume(const Moving<Aabb<S>>& m) {
  const Vec3<S>&h = m.shape.half_extents, half_path = m.displacement / S(2);
  const Vec3<S> middle = m.shape.center + half_path;
  const Vec3<S> along = safe_unit(m.displacement);  // what vanishes beside the rest is no direction
  if (axis_along(along, S(0)) >= 0) return {middle, h + half_path.cwiseAbs(), Mat3<S>::Identity()};
  const Vec3<S> sizes = times_power_of_two(h, -binary_exponent(largest(h)));  // their products stay in range
  Obb<S> box{middle, h, Mat3<S>::Identity()};
  S least = std::numeric_limits<S>::infinity();
  for (int edge = 0; edge < 3; ++edge) {
    const Vec3<S> across_edge = safe_unit(cross(along, axis_vector<S>(edge)));  // the motion is along no edge
    const Vec3<S> along_edge = cross(across_edge, along);
    const S area = sizes.dot(along_edge.cwiseAbs()) * sizes.dot(across_edge.cwiseAbs());
    if (!(area < least)) continue;
    least = area;
    box.axes << along, along_edge, across_edge;
  }
  box.half_extents = box.axes.cwiseAbs().transpose() * h;
  box.half_extents[0] += safe_norm(half_path);
  return box;
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

/// A triangle's center is not the middle of the box around it.
template <Scalar S> Aabb<S> swept_bounds(const Moving<Triangle<S>>& m) {
  const Triangle<S>& t = m.shape;
  const Vec3<S> low = t.a.cwiseMin(t.b).cwiseMin(t.c) / S(2), high = t.a.cwiseMax(t.b).cwiseMax(t.c) / S(2);
  return swept_bounds(Moving<Aabb<S>>{{low + high, high - low}, m.displacement});
}

/// The naive bound: a ball around the whole path, rounded outward. Mostly empty when the path is long.
template <Scalar S> Sphere<S> enclosing_sphere(const Moving<Sphere<S>>& m) {
  const Vec3<S> half_path = m.displacement / S(2);
  const Vec3<S> middle = m.shape.center + half_path;
  const S radius = m.shape.radius + safe_norm(half_path);
  const S slack = 8 * std::numeric_limits<S>::epsilon() * (m.shape.center.cwiseAbs().sum() + radius);
  return {middle, radius + slack + 8 * std::numeric_limits<S>::denorm_min()};
}

/// The naive bound: the axis-aligned box around both ends of the path, rounded outward.
template <Scalar S> Aabb<S> enclosing_aabb(const Moving<Aabb<S>>& m) { return swept_bounds(m); }

}  // namespace thinwall
