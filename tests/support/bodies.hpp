#pragma once
/// The library's shapes as the oracle sees them: inputs lifted without rounding.

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
