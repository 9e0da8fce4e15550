#pragma once
/// Distance and depth of a point in a zonotope.
///
/// The cores of all shapes here (point, segment, box) are zonotopes, and so is the Minkowski sum of two cores: the
/// separation of two shapes is the distance of one point to one zonotope, less the sum of the radii.

#include <cstddef>
#include <vector>

#include "support/faces.hpp"

namespace thinwall::oracle {

/// All sums of s_i g_i with |s_i| <= 1, about the origin: a box along the axes and any number of other generators.
struct Zonotope {
  Vector box{};                      ///< [length] >= 0: half extents along x, y, z
  std::vector<Vector> generators{};  ///< [length] half edges in any direction
};

/// Every generator, those of the box first; parallel ones are added up, and those of length zero left out.
inline std::vector<Vector> all_generators(const Zonotope& z) {
  std::vector<Vector> all;
  const auto add = [&](const Vector& g) {
    if (dot(g, g) == 0) return;
    for (Vector& other : all) {
      const Vector across = cross(other, g);
      if (dot(across, across) != 0) continue;
      other = dot(other, g) > 0 ? other + g : other - g;
      return;
    }
    all.push_back(g);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    Vector edge{};
    edge[i] = z.box[i];
    add(edge);
  }
  for (const Vector& g : z.generators) add(g);
  return all;
}

/// How far the zonotope reaches along `direction`.
inline Real support(const Zonotope& z, const Vector& direction) {
  Real reach = 0;
  for (const Vector& g : all_generators(z)) reach += abs(dot(g, direction));
  return reach;
}

/// The point of the zonotope nearest to `p`; for a box, each coordinate is clamped.
inline Vector nearest(const Zonotope& z, const Vector& p) {
  if (!z.generators.empty()) return nearest_of_any(all_generators(z), p);
  Vector q = p;
  for (std::size_t i = 0; i < 3; ++i) {
    if (q[i] > z.box[i]) q[i] = z.box[i];
    if (q[i] < -z.box[i]) q[i] = -z.box[i];
  }
  return q;
}

/// A signed distance and the direction in which it grows.
struct Depth {
  Real distance = 0;  ///< [length] below zero inside
  Vector normal{1, 0, 0};
};

/// The least translation that takes an inner point `p` out, over the normals of all faces. A zonotope without
/// volume has no inside: the depth is zero.
inline Depth depth_inside(const Zonotope& z, const Vector& p) {
  const std::vector<Vector> generators = all_generators(z);
  Depth best;
  bool found = false;
  for (std::size_t i = 0; i < generators.size(); ++i) {
    for (std::size_t j = i + 1; j < generators.size(); ++j) {
      const Vector axis = cross(generators[i], generators[j]);
      if (dot(axis, axis) == 0) continue;
      const Vector unit = Real((dot(axis, p) < 0 ? -1 : 1) / length(axis)) * axis;
      const Real distance = dot(unit, p) - support(z, unit);
      if (found && distance <= best.distance) continue;
      found = true;
      best = {distance, unit};
    }
  }
  return best;
}

}  // namespace thinwall::oracle
