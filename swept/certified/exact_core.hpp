#pragma once
/// A question about two moving shapes without a rounding: their relative core as sums of products of the input's doubles.
///
/// Seen from B, A's core moves by v; the shapes touch by time t where the polytope
///   K(t) = { start + sum of [0, 1] edge + [0, t] v },  start and edges from core(A) - core(B),
/// comes within the sum of the radii of the origin. K grows with t: "touched by t" is monotone.

#include <array>
#include <cstddef>

#include <thinwall/swept/certified/certified_toi.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall {

/// x * y * 2^shift, exactly.
struct ExactTerm {
  double x = 0, y = 1;
  int shift = 0;
};

/// A coordinate: at most the center and three half axes of each of two boxes.
struct ExactSum {
  static constexpr std::size_t most = 8;
  std::array<ExactTerm, most> terms{};
  std::size_t count = 0;

  void add(double x, double y = 1, int shift = 0) {
    if (x != 0 && y != 0) terms[count++] = {x, y, shift};
  }
};

using ExactPoint = std::array<ExactSum, 3>;

struct ExactCore {
  std::array<ExactPoint, 3> starts{};  ///< one, or the corners of a triangle
  std::array<ExactPoint, 6> edges{};
  std::size_t start_count = 1, edge_count = 0;
  ExactPoint velocity{};  ///< of A seen from B, over the step
  ExactSum reach{};       ///< the sum of both radii
};

inline void add_point(ExactPoint& point, const Vec3<double>& x, double sign) {
  for (int i = 0; i < 3; ++i) point[static_cast<std::size_t>(i)].add(sign * x[i]);
}

/// The half axes -g ... g as the start -g and the edge 2 g, where g = half * axis.
inline void add_half_axis(ExactCore& query, double half, const Vec3<double>& axis) {
  ExactPoint& edge = query.edges[query.edge_count++];
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    query.starts[0][k].add(-half, axis[i]);
    edge[k].add(half, axis[i], 1);
  }
}

// The core of A (sign 1) or of B mirrored (sign -1), and its radius.
inline void add_core(ExactCore& query, const Sphere<double>& sphere, double sign) {
  for (std::size_t i = 0; i < query.start_count; ++i) add_point(query.starts[i], sphere.center, sign);
  query.reach.add(sphere.radius);
}
inline void add_core(ExactCore& query, const Aabb<double>& box, double sign) {
  add_point(query.starts[0], box.center, sign);
  for (int i = 0; i < 3; ++i) add_half_axis(query, box.half_extents[i], axis_vector<double>(i));
}
inline void add_core(ExactCore& query, const Obb<double>& box, double sign) {
  add_point(query.starts[0], box.center, sign);
  for (int i = 0; i < 3; ++i) add_half_axis(query, box.half_extents[i], box.axes.col(i));
}
inline void add_core(ExactCore& query, const Capsule<double>& capsule, double sign) {
  add_point(query.starts[0], capsule.a, sign);
  ExactPoint& edge = query.edges[query.edge_count++];
  add_point(edge, capsule.b, sign);
  add_point(edge, capsule.a, -sign);
  query.reach.add(capsule.radius);
}
inline void add_core(ExactCore& query, const Triangle<double>& t, double sign) {
  query.start_count = 3;
  add_point(query.starts[0], t.a, sign);
  add_point(query.starts[1], t.b, sign);
  add_point(query.starts[2], t.c, sign);
}

/// Requires the shape of later rank first: a triangle before the sphere.
template <Shape A, Shape B> ExactCore exact_core(const Moving<A>& a, const Moving<B>& b) {
  static_assert(A::rank >= B::rank);
  ExactCore query;
  add_core(query, a.shape, 1);
  add_core(query, b.shape, -1);
  add_point(query.velocity, a.displacement, 1);
  add_point(query.velocity, b.displacement, -1);
  return query;
}

}  // namespace thinwall
