#pragma once
/// The support function of every shape, from its center, and how large the numbers are that it is made of.
/// Error: a few u of the sizes involved.

#include <algorithm>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/triangle.hpp>

namespace thinwall {

/// How far a shape reaches from its center along n, a unit vector.
template <Scalar S> S reach_along(const Sphere<S>& sphere, const Vec3<S>&) { return sphere.radius; }
template <Scalar S> S reach_along(const Aabb<S>& box, const Vec3<S>& n) { return box.half_extents.dot(n.cwiseAbs()); }
template <Scalar S> S reach_along(const Obb<S>& box, const Vec3<S>& n) {
  return box.half_extents.dot(into(box, n).cwiseAbs());
}
template <Scalar S> S reach_along(const Triangle<S>& t, const Vec3<S>& n) {
  const Vec3<S> middle = center(t);
  return std::max({n.dot(t.a - middle), n.dot(t.b - middle), n.dot(t.c - middle)});
}
template <Scalar S> S reach_along(const Capsule<S>& capsule, const Vec3<S>& n) {
  const Vec3<S> middle = center(capsule);
  return std::max(n.dot(capsule.a - middle), n.dot(capsule.b - middle)) + capsule.radius;
}

/// The size of the numbers that a shape is given in, along each axis.
template <Shape A> Vec3<typename A::Scalar> coordinate_sizes(const A& shape) {
  return center(shape).cwiseAbs() + half_widths(shape);
}

}  // namespace thinwall
