#pragma once
/// Two convex bodies that each translate, and their signed separation at any time: the distance and depth of a point in a zonotope.
///
/// The cores of all shapes here (point, segment, box) are zonotopes, and so is the Minkowski sum of two cores: the
/// separation of two shapes is the distance of one point to one zonotope, less the sum of the radii.

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "support/real.hpp"

namespace thinwall::oracle {

// ---- The nearest point is a least-squares problem whose factors are bounded by one. A face is named by which factors are at -1, at +1
// and free. A few steps in double guess the face; the point on it is then found, and proven nearest, at full precision. Where the proof
// fails, every face is tried.

/// The factors of up to three edges whose sum comes nearest to `target` (normal equations, pivoted elimination).
/// False if the edges are dependent: then a smaller set of edges spans the same face.
inline bool least_squares(const std::vector<Vector>& edges, const Vector& target, std::vector<Real>& factors) {
  const std::size_t n = edges.size();
  std::vector<std::vector<Real>> rows(n, std::vector<Real>(n + 1));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) rows[i][j] = dot(edges[i], edges[j]);
    rows[i][n] = dot(edges[i], target);
  }
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    for (std::size_t i = column + 1; i < n; ++i)
      if (abs(rows[i][column]) > abs(rows[pivot][column])) pivot = i;
    if (rows[pivot][column] == 0) return false;
    std::swap(rows[pivot], rows[column]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == column) continue;
      const Real factor = rows[i][column] / rows[column][column];
      for (std::size_t j = column; j <= n; ++j) rows[i][j] -= factor * rows[column][j];
    }
  }
  factors.resize(n);
  for (std::size_t i = 0; i < n; ++i) factors[i] = rows[i][n] / rows[i][i];
  return true;
}

/// Tries every face: each generator is at -1, at +1, or free, at most three of them free.
class FaceSearch {
 public:
  FaceSearch(const std::vector<Vector>& generators, const Vector& point) : generators_(generators), point_(point) {
    visit(0, Vector{});
  }
  const Vector& nearest() const { return best_; }

 private:
  void visit(std::size_t index, const Vector& fixed) {
    if (index == generators_.size()) return try_face(fixed);
    const Vector& g = generators_[index];
    visit(index + 1, fixed - g);
    visit(index + 1, fixed + g);
    if (free_.size() == 3) return;
    free_.push_back(g);
    visit(index + 1, fixed);
    free_.pop_back();
  }

  // A factor beyond its range is clamped. The point found then lies in the zonotope all the same, if not nearest:
  // a face that does not hold the answer can never spoil it.
  void try_face(const Vector& fixed) {
    if (!least_squares(free_, point_ - fixed, factors_)) return;
    Vector candidate = fixed;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const Real factor = factors_[i] > 1 ? Real(1) : factors_[i] < -1 ? Real(-1) : factors_[i];
      candidate = candidate + factor * free_[i];
    }
    const Vector gap = point_ - candidate;
    const Real square = dot(gap, gap);
    if (found_ && square >= best_square_) return;
    found_ = true;
    best_ = candidate;
    best_square_ = square;
  }

  const std::vector<Vector>& generators_;
  Vector point_;
  std::vector<Vector> free_{};
  std::vector<Real> factors_{};
  bool found_ = false;
  Vector best_{};
  Real best_square_ = 0;
};

/// Factors near the best ones: each in turn is set to its best value, all in double and relative to the largest number.
inline std::vector<double> guess_factors(const std::vector<Vector>& generators, const Vector& point) {
  Real size = length(point);
  for (const Vector& g : generators) size = std::max(size, length(g));
  const auto shrink = [&](const Vector& v) {
    const Vector small = Real(1 / size) * v;
    return Triple<double>{
        {small[0].convert_to<double>(), small[1].convert_to<double>(), small[2].convert_to<double>()}};
  };
  std::vector<Triple<double>> edges;
  for (const Vector& g : generators) edges.push_back(shrink(g));
  Triple<double> rest = shrink(point);
  std::vector<double> factors(generators.size());
  for (int sweep = 0; sweep < 200; ++sweep) {
    double change = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const double square = dot(edges[i], edges[i]);
      if (square == 0) continue;
      const double best = std::min(1.0, std::max(-1.0, factors[i] + dot(edges[i], rest) / square));
      rest = rest - (best - factors[i]) * edges[i];
      change = std::max(change, std::abs(best - factors[i]));
      factors[i] = best;
    }
    if (change < 1e-15) break;
  }
  return factors;
}

/// True if `g` is no sum of multiples of the (at most three) edges.
inline bool is_independent(const std::vector<Vector>& edges, const Vector& g) {
  if (edges.empty()) return true;
  if (edges.size() == 1) return cross(edges[0], g) != Vector{};
  return edges.size() == 2 && dot(cross(edges[0], edges[1]), g) != 0;
}

/// The nearest point if it lies on the guessed face. Proof: what is left is perpendicular to the free generators and
/// points away from the face along the others, which is the condition for the minimum of a convex function.
inline bool nearest_on_guess(const std::vector<Vector>& generators, const Vector& point, Vector& nearest) {
  const std::vector<double> guess = guess_factors(generators, point);
  std::vector<Vector> free;
  Vector fixed{};
  Real size = length(point);
  for (std::size_t i = 0; i < generators.size(); ++i) {
    size += length(generators[i]);
    if (std::abs(guess[i]) < 1 && is_independent(free, generators[i]))
      free.push_back(generators[i]);
    else
      fixed = fixed + Real(guess[i]) * generators[i];
  }
  std::vector<Real> factors;
  if (!least_squares(free, point - fixed, factors)) return false;
  nearest = fixed;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (abs(factors[i]) > 1) return false;
    nearest = nearest + factors[i] * free[i];
  }
  const Vector rest = point - nearest;
  for (std::size_t i = 0; i < generators.size(); ++i) {
    const Real along = dot(generators[i], rest), none = ldexp(length(generators[i]) * size, -325);
    if (guess[i] == 1 ? along < -none : guess[i] == -1 ? along > none : abs(along) > none) return false;
  }
  return true;
}

inline Vector nearest_of_any(const std::vector<Vector>& generators, const Vector& point) {
  Vector nearest;
  if (nearest_on_guess(generators, point, nearest)) return nearest;
  return FaceSearch(generators, point).nearest();
}

// ---- A zonotope.

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

// ---- Two bodies.

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
