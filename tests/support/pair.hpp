#pragma once
/// Two convex bodies that each translate, and their signed separation at any time.

#include "support/zonotope.hpp"

namespace thinwall::oracle {

/// A rounded zonotope in straight motion: all points within `radius` of `center + t * displacement + core`.
struct Body {
  Vector center{};
  Zonotope core{};
  Real radius = 0;        ///< [length] >= 0
  Vector displacement{};  ///< [length] over the step
};

/// Two bodies and the gap that counts as contact.
struct Pair {
  Body a, b;
  Real min_separation = 0;  ///< [length] >= 0

  /// The centers touch the Minkowski sum of the cores within this distance when the bodies touch.
  Real reach() const { return a.radius + b.radius + min_separation; }

  /// From the center of A to that of B.
  Vector offset(const Real& time) const { return (b.center - a.center) + time * (b.displacement - a.displacement); }
  Vector relative_displacement() const { return b.displacement - a.displacement; }

  /// The Minkowski sum of the two cores (they are symmetric, so it is the difference as well).
  Zonotope core() const {
    Zonotope sum{a.core.box + b.core.box, a.core.generators};
    sum.generators.insert(sum.generators.end(), b.core.generators.begin(), b.core.generators.end());
    return sum;
  }
};

/// Half the size of the core's bounding box.
inline Vector half_size(const Zonotope& z) {
  Vector half = z.box;
  for (const Vector& g : z.generators) half = half + magnitude(g);
  return half;
}

/// The size of the numbers that a computation at `time` must add, along each axis.
inline Vector sizes(const Pair& pair, const Real& time) {
  return magnitude(pair.a.center) + magnitude(pair.b.center) + half_size(pair.a.core) + half_size(pair.b.core) +
         time * (magnitude(pair.a.displacement) + magnitude(pair.b.displacement));
}

/// The same seen along the contact normal, radii included: the roundoff of the inputs moves the gap by u times this.
inline Real scale(const Pair& pair, const Real& time, const Vector& normal) {
  return dot(magnitude(normal), sizes(pair, time)) + pair.reach();
}

/// What lies between the two bodies at one time.
struct Gap {
  Real core = 0;           ///< [length] between the cores; below zero: how deep they are in each other
  Real separation = 0;     ///< [length] between the surfaces: core less the sum of the radii
  Vector normal{1, 0, 0};  ///< unit, from A to B
};

/// Oblique cores meet only to the last digits of a Real: nearer than this, relative to their size, they touch.
inline Real noise(const Zonotope& core, const Vector& offset) {
  if (core.generators.empty()) return 0;  // clamping is exact
  return ldexp(length(offset) + length(half_size(core)), -270);
}

inline Gap gap(const Pair& pair, const Real& time) {
  const Zonotope core = pair.core();
  const Vector offset = pair.offset(time);
  const Vector across = offset - nearest(core, offset);
  const Real distance = length(across);
  if (distance > noise(core, offset)) return {distance, distance - pair.reach(), Real(1 / distance) * across};
  const Depth inside = depth_inside(core, offset);
  return {inside.distance, inside.distance - pair.reach(), inside.normal};
}

/// The separation along one direction: at most gap().separation, and equal to it for the right normal.
inline Real separation_along(const Pair& pair, const Real& time, const Vector& normal) {
  return dot(normal, pair.offset(time)) - support(pair.core(), normal) - pair.reach();
}

/// True if the bodies share a point at `time`, touching included. No square root: boxes and points are exact.
inline bool touching(const Pair& pair, const Real& time) {
  const Zonotope core = pair.core();
  const Vector offset = pair.offset(time);
  const Vector across = offset - nearest(core, offset);
  const Real reach = pair.reach() + noise(core, offset);
  return dot(across, across) <= reach * reach;
}

}  // namespace thinwall::oracle
