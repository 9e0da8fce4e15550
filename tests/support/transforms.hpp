#pragma once
/// The same scene elsewhere: translated, resized, mirrored; and whether the scalar held the result exactly.

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

// Lengths times 2^exponent.
template <class S> Sphere<S> resized(const Sphere<S>& s, int k) {
  return {times_power(s.center, k), times_power(s.radius, k)};
}
template <class S> Aabb<S> resized(const Aabb<S>& b, int k) {
  return {times_power(b.center, k), times_power(b.half_extents, k)};
}
template <class S> Capsule<S> resized(const Capsule<S>& c, int k) {
  return {times_power(c.a, k), times_power(c.b, k), times_power(c.radius, k)};
}

// Moved by an offset.
template <class S> Sphere<S> translated(const Sphere<S>& s, const Vec3<S>& by) {
  return {Vec3<S>(s.center + by), s.radius};
}
template <class S> Aabb<S> translated(const Aabb<S>& b, const Vec3<S>& by) {
  return {Vec3<S>(b.center + by), b.half_extents};
}
template <class S> Capsule<S> translated(const Capsule<S>& c, const Vec3<S>& by) {
  return {Vec3<S>(c.a + by), Vec3<S>(c.b + by), c.radius};
}

/// x, y, z become -y, z, -x: a mirror and a change of axes at once.
template <class S> Vec3<S> mirrored(const Vec3<S>& v) { return {S(-v[1]), v[2], S(-v[0])}; }
template <class S> Sphere<S> mirrored(const Sphere<S>& s) { return {mirrored(s.center), s.radius}; }
template <class S> Aabb<S> mirrored(const Aabb<S>& b) {
  return {mirrored(b.center), mirrored(b.half_extents).cwiseAbs()};
}
template <class S> Capsule<S> mirrored(const Capsule<S>& c) { return {mirrored(c.a), mirrored(c.b), c.radius}; }

template <class Shape> Moving<Shape> resized(const Moving<Shape>& m, int k) {
  return {resized(m.shape, k), times_power(m.displacement, k)};
}
template <class Shape, class S> Moving<Shape> translated(const Moving<Shape>& m, const Vec3<S>& by) {
  return {translated(m.shape, by), m.displacement};
}
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
