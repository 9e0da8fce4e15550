#pragma once
/// A shape that flies straight and spins at a constant rate over one step.

#include <algorithm>
#include <limits>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/triangle.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall {

/// A box along the axes is one along other axes once it has turned.
template <class Shape> inline constexpr bool stays_along_the_axes = false;
template <Scalar S> inline constexpr bool stays_along_the_axes<Aabb<S>> = true;

/// The shape at time 0, how far its center travels by time 1, and how far it turns about it.
template <class Shape> struct Turning {
  static_assert(!stays_along_the_axes<Shape>, "an Aabb that turns is an Obb: write Turning{to_obb(box), ...}");
  using Scalar = typename Shape::Scalar;

  Shape shape;
  Vec3<Scalar> displacement;  ///< [length] velocity * dt
  Vec3<Scalar>
      rotation;  ///< [rad] axis times angle, about center(shape): angular velocity * dt. Any angle, many turns too
};
template <class Shape> Turning(Shape, Vec3<typename Shape::Scalar>, Vec3<typename Shape::Scalar>) -> Turning<Shape>;

/// What does not turn, in the same question with what does; a box along the axes becomes one that could.
template <Shape A> Turning<A> without_spin(const Moving<A>& m) {
  return {m.shape, m.displacement, Vec3<typename A::Scalar>::Zero()};
}
template <Scalar S> Turning<Obb<S>> without_spin(const Moving<Aabb<S>>& m) {
  return {to_obb(m.shape), m.displacement, Vec3<S>::Zero()};
}
template <Shape A> const Turning<A>& without_spin(const Turning<A>& m) { return m; }

/// The matrix that turns by `angle` [rad] about `axis`, a unit vector. Rodrigues' formula.
/// Error: a few u, and what the angle is off by. Degenerate: an angle of 0 is the identity, to the bit.
template <Scalar S> Mat3<S> rotation_about(const Vec3<S>& axis, const S& angle) {
  using std::cos, std::sin;
  const S c = cos(angle), rest = S(1) - c;
  const Vec3<S> s = axis * S(sin(angle));
  Mat3<S> turn = axis * (axis * rest).transpose();
  turn.diagonal().array() += c;
  turn(0, 1) -= s[2];
  turn(0, 2) += s[1];
  turn(1, 0) += s[2];
  turn(1, 2) -= s[0];
  turn(2, 0) -= s[1];
  turn(2, 1) += s[0];
  return turn;
}

/// The shape turned about its own center.
template <Scalar S> Sphere<S> turned(const Sphere<S>& sphere, const Mat3<S>&) { return sphere; }
template <Scalar S> Obb<S> turned(const Obb<S>& box, const Mat3<S>& turn) {
  return {box.center, box.half_extents, Mat3<S>(turn * box.axes)};
}
template <Scalar S> Capsule<S> turned(const Capsule<S>& capsule, const Mat3<S>& turn) {
  const Vec3<S> middle = center(capsule), half = turn * Vec3<S>((capsule.b - capsule.a) / S(2));
  return {middle - half, middle + half, capsule.radius};
}
template <Scalar S> Triangle<S> turned(const Triangle<S>& t, const Mat3<S>& turn) {
  const Vec3<S> middle = center(t);
  const auto corner = [&](const Vec3<S>& c) { return Vec3<S>(middle + turn * (c - middle)); };
  return {corner(t.a), corner(t.b), corner(t.c)};
}

/// The shape at `time` [1] in [0, 1], having turned by `turn` until then.
template <Shape A> A posed(const Turning<A>& m, const Mat3<typename A::Scalar>& turn, const typename A::Scalar& time) {
  using S = typename A::Scalar;
  const Vec3<S> by = m.displacement * time;
  return moved(m.rotation == Vec3<S>::Zero() ? m.shape : turned(m.shape, turn), by);
}

/// The shape at `time` [1] in [0, 1]. Error: a few u of the coordinates, and u of the angle times the size.
template <Shape A> A pose_at(const Turning<A>& m, const typename A::Scalar& time) {
  using S = typename A::Scalar;
  const S angle = std::min(safe_norm(m.rotation), std::numeric_limits<S>::max());  // so many turns are any angle
  return posed(m, rotation_about<S>(safe_unit(m.rotation), angle * time), time);
}

template <Shape A> typename A::Scalar magnitude(const Turning<A>& m) {
  return magnitude(m.shape) + m.displacement.cwiseAbs().sum();
}
template <Shape A> typename A::Scalar extent(const Turning<A>& m) {
  return extent(m.shape) + m.displacement.cwiseAbs().sum();
}
template <Shape A> bool has_valid_sizes(const Turning<A>& m) { return has_valid_sizes(m.shape); }
template <Shape A> bool has_valid_axes(const Turning<A>& m) { return has_valid_axes(m.shape); }
template <Shape A> bool valid(const Turning<A>& m) {
  return valid(m.shape) && is_finite(m.displacement) && is_finite(m.rotation);
}
template <Shape A> Turning<A> scaled(const Turning<A>& m, int e) {
  return {scaled(m.shape, e), times_power_of_two(m.displacement, e), m.rotation};
}
template <Scalar T, Shape A> auto cast(const Turning<A>& m) {
  return Turning<decltype(cast<T>(m.shape))>{cast<T>(m.shape), m.displacement.template cast<T>(),
                                             m.rotation.template cast<T>()};
}

}  // namespace thinwall
