#pragma once
/// Is the origin within reach of a convex polytope? The algorithm of Gilbert, Johnson and Keerthi (GJK) in integers.
///
/// It keeps a simplex of corners and the direction n of its point nearest to the origin, a multiple of it, so that nothing
/// is divided. Each round asks for the corner lowest along n:
///   - the simplex is within reach: touching;
///   - the corner's plane is beyond reach: apart, and that plane proves it;
///   - else the corner joins, and only the face nearest to the origin stays.
/// Every sign is exact, so the distance falls in each round, no simplex comes twice, no four corners lie in one plane, and it
/// ends. No tolerance, no limit of rounds.
/// Source: Gilbert, Johnson, Keerthi 1988; the choice of the face by its optimality condition is derived in
/// docs/certified.md.

#include <thinwall/swept/certified/integer_polytope.hpp>

namespace thinwall {

template <class Integer> struct IntegerSimplex {
  using Point = IntegerVec<Integer>;

  std::array<Point, 4> corners;
  std::size_t count = 0;
  Point normal;   ///< a multiple >= 0 of the point nearest to the origin; zero if that is the origin
  Integer level;  ///< normal . x on the nearest face: its length times the distance

  explicit IntegerSimplex(const Point& corner) : normal(corner), level(dot(corner, corner)) {
    corners[count++] = corner;
  }

  /// Adds a corner below the level and keeps the face nearest to the origin; false if the origin is inside.
  bool add(const Point& corner) {
    corners[count++] = corner;
    const std::size_t last = count - 1;
    if (keeps(corner, {last, last, last}, 1)) return true;
    for (std::size_t i = 0; i < last; ++i) {
      if (nearest_to_edge(last, i)) return true;
    }
    for (std::size_t i = 0; i < last; ++i) {
      for (std::size_t j = i + 1; j < last; ++j) {
        if (nearest_to_face(last, i, j)) return true;
      }
    }
    return false;
  }

 private:
  /// The face nearest to the origin is the one on whose inside the point along n lies, with no corner below its level.
  bool keeps(const Point& n, const std::array<std::size_t, 3>& face, std::size_t size) {
    const Integer at = dot(n, corners[face[0]]);
    for (std::size_t i = 0; i < count; ++i) {
      if (i != face[0] && i != face[1] && i != face[2] && dot(n, corners[i]) < at) return false;
    }
    std::array<Point, 3> kept;
    for (std::size_t i = 0; i < size; ++i) kept[i] = corners[face[i]];
    for (std::size_t i = 0; i < size; ++i) corners[i] = kept[i];
    count = size;
    normal = n;
    level = at;
    return true;
  }

  bool nearest_to_edge(std::size_t i, std::size_t j) {
    const Point &a = corners[i], &b = corners[j], ab = b - a;
    const Integer along = -dot(a, ab);
    if (along <= 0 || dot(b, ab) <= 0) return false;
    const Integer square = dot(ab, ab);
    const Point n = {a[0] * square + ab[0] * along, a[1] * square + ab[1] * along, a[2] * square + ab[2] * along};
    return keeps(n, {i, j, j}, 2);
  }

  bool nearest_to_face(std::size_t i, std::size_t j, std::size_t k) {
    const Point &a = corners[i], &b = corners[j], &c = corners[k];
    Point n = cross<Integer>(b - a, c - a);
    if (dot<Integer>(cross(b, c), n) <= 0 || dot<Integer>(cross(c, a), n) <= 0 || dot<Integer>(cross(a, b), n) <= 0)
      return false;
    if (dot(n, a) < 0) n = {-n[0], -n[1], -n[2]};
    if (dot(n, a) == 0) n = {0, 0, 0};  // the origin lies on the face
    return keeps(n, {i, j, k}, 3);
  }
};

/// True if the polytope and the ball of its reach about the origin share a point.
template <class Integer> bool touches_origin(const IntegerPolytope<Integer>& polytope) {
  IntegerSimplex<Integer> simplex(polytope.starts[0]);
  const Integer reach_square = polytope.reach * polytope.reach;
  while (true) {
    const Integer limit = reach_square * dot(simplex.normal, simplex.normal);
    if (simplex.level * simplex.level <= limit) return true;
    const IntegerVec<Integer> corner = polytope.lowest_along(simplex.normal);
    const Integer level = dot(simplex.normal, corner);
    if (level > 0 && level * level > limit) return false;
    if (!simplex.add(corner)) return true;
  }
}

}  // namespace thinwall
