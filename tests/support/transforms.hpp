#pragma once
/// The same scene elsewhere: translated, mirrored; and whether the scalar held the result exactly.

#include <cmath>

#include "support/bodies.hpp"
#include "support/real.hpp"

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

/// x, y, z become -y, z, -x: a mirror and a change of axes at once.
template <class S> Vec3<S> mirrored(const Vec3<S>& v) { return {S(-v[1]), v[2], S(-v[0])}; }
template <class S> Sphere<S> mirrored(const Sphere<S>& s) { return {mirrored(s.center), s.radius}; }
template <class S> Aabb<S> mirrored(const Aabb<S>& b) {
  return {mirrored(b.center), mirrored(b.half_extents).cwiseAbs()};
}
template <class S> Capsule<S> mirrored(const Capsule<S>& c) { return {mirrored(c.a), mirrored(c.b), c.radius}; }

template <class Shape> Moving<Shape> mirrored(const Moving<Shape>& m) {
  return {mirrored(m.shape), mirrored(m.displacement)};
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
