#pragma once
/// The library's shapes as the oracle sees them: inputs lifted without rounding; and the same scene elsewhere.

#include <cmath>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/swept/moving.hpp>

#include "support/pair.hpp"

namespace thinwall::oracle {

template <class S> Body body(const Sphere<S>& s) {
  Body b;
  b.center = lift_vector(s.center);
  b.radius = lift(s.radius);
  return b;
}

template <class S> Body body(const Aabb<S>& box) {
  Body b;
  b.center = lift_vector(box.center);
  b.core.box = lift_vector(box.half_extents);
  return b;
}

template <class S> Body body(const Capsule<S>& c) {
  Body b;
  const Vector first = lift_vector(c.a), second = lift_vector(c.b);
  b.center = Real(0.5) * (first + second);
  b.core.generators = {Real(0.5) * (second - first)};
  b.radius = lift(c.radius);
  return b;
}

template <class Shape> Body body(const Moving<Shape>& moving) {
  Body b = body(moving.shape);
  b.displacement = lift_vector(moving.displacement);
  return b;
}

template <class A, class B> Pair pair(const A& a, const B& b) { return {body(a), body(b), 0}; }

}  // namespace thinwall::oracle

// ---- The same scene elsewhere, and whether the scalar held the result exactly.

namespace thinwall::testing {

template <class S> S times_power(const S& x, int exponent) {
  using std::ldexp;
  return ldexp(x, exponent);
}
template <class S> Vec3<S> times_power(const Vec3<S>& v, int exponent) {
  return {times_power(v[0], exponent), times_power(v[1], exponent), times_power(v[2], exponent)};
}

template <Shape A> A translated(const A& shape, const Vec3<typename A::Scalar>& by) { return moved(shape, by); }
template <Shape A> Moving<A> translated(const Moving<A>& m, const Vec3<typename A::Scalar>& by) {
  return {moved(m.shape, by), m.displacement};
}

/// True if two bodies are equal but for a factor 2^exponent and an offset: nothing was rounded on the way.
inline bool same_body(const oracle::Body& to, const oracle::Body& from, int exponent, const oracle::Vector& by = {}) {
  const auto grown = [&](const oracle::Vector& v) { return oracle::Real(ldexp(oracle::Real(1), exponent)) * v; };
  if (to.center != grown(from.center) + by || to.displacement != grown(from.displacement)) return false;
  if (to.radius != ldexp(from.radius, exponent) || to.core.box != grown(from.core.box)) return false;
  for (std::size_t i = 0; i < from.core.generators.size(); ++i)
    if (to.core.generators[i] != grown(from.core.generators[i])) return false;
  return true;
}

}  // namespace thinwall::testing
