#pragma once
/// A shape and its straight motion over one step.

#include <thinwall/discrete/shape.hpp>

namespace thinwall {

/// The shape at time 0, and how far it travels by time 1, without turning.
template <class Shape> struct Moving {
  Shape shape;
  Vec3<typename Shape::Scalar> displacement;  ///< [length] velocity * dt
};
template <class Shape> Moving(Shape, Vec3<typename Shape::Scalar>) -> Moving<Shape>;

template <Shape A> Moving<A> at_rest(const A& shape) { return {shape, Vec3<typename A::Scalar>::Zero()}; }

/// The shape at `time` [1] in [0, 1].
template <Shape A> A pose_at(const Moving<A>& m, const typename A::Scalar& time) {
  return moved(m.shape, Vec3<typename A::Scalar>(m.displacement * time));
}

template <Shape A> typename A::Scalar magnitude(const Moving<A>& m) {
  return magnitude(m.shape) + m.displacement.cwiseAbs().sum();
}
template <Shape A> typename A::Scalar extent(const Moving<A>& m) {
  return extent(m.shape) + m.displacement.cwiseAbs().sum();
}
template <Shape A> bool has_valid_sizes(const Moving<A>& m) { return has_valid_sizes(m.shape); }
template <Shape A> bool has_valid_axes(const Moving<A>& m) { return has_valid_axes(m.shape); }
template <Shape A> bool valid(const Moving<A>& m) { return valid(m.shape) && is_finite(m.displacement); }
template <Shape A> Moving<A> scaled(const Moving<A>& m, int e) {
  return {scaled(m.shape, e), times_power_of_two(m.displacement, e)};
}
template <Scalar T, Shape A> auto cast(const Moving<A>& m) {
  return Moving<decltype(cast<T>(m.shape))>{cast<T>(m.shape), m.displacement.template cast<T>()};
}
template <Scalar W, Shape A> auto widened(const Moving<A>& m) {
  return Moving{widened<W>(m.shape), Vec3<W>(m.displacement.template cast<W>())};
}

}  // namespace thinwall
