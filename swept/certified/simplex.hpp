#pragma once
/// The simplex of the algorithm of Gilbert, Johnson and Keerthi (GJK), without a division: in integers it is exact.
///
/// The nearest face is found by its optimality condition (docs/certified.md): the foot of the origin lies inside the face, and
/// no other corner lies below the face along the way to that foot. One face alone has both.

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace thinwall {

template <class Number> using Triple = std::array<Number, 3>;

template <class Number> Number dot(const Triple<Number>& a, const Triple<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number> Triple<Number> cross(const Triple<Number>& a, const Triple<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class Number> Triple<Number> difference(const Triple<Number>& a, const Triple<Number>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class Number> struct Simplex {
  using Point = Triple<Number>;

  std::array<Point, 4> corners;
  std::size_t count = 0;
  Point normal;  ///< a multiple >= 0 of the point nearest to the origin; zero if that is the origin
  Number level;  ///< normal . x on the nearest face: its length times the distance

  explicit Simplex(const Point& corner) : normal(corner), level(dot(corner, corner)) { corners[count++] = corner; }

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
  /// What rounding may make of a tie between two corners along n; in integers, nothing.
  static Number tie(const Point& n, const Point& a, const Point& b) {
    if constexpr (std::is_floating_point_v<Number>) {
      using std::abs;
      Number sum = 0;
      for (std::size_t i = 0; i < 3; ++i) sum += abs(n[i]) * (abs(a[i]) + abs(b[i]));
      return 16 * std::numeric_limits<Number>::epsilon() * sum;
    } else {
      return 0;
    }
  }

  /// The face nearest to the origin is the one on whose inside the point along n lies, with no corner below its level.
  bool keeps(const Point& n, const std::array<std::size_t, 3>& face, std::size_t size) {
    const Number at = dot(n, corners[face[0]]);
    for (std::size_t i = 0; i < count; ++i) {
      if (i == face[0] || i == face[1] || i == face[2]) continue;
      if (dot(n, corners[i]) < at - tie(n, corners[face[0]], corners[i])) return false;
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
    const Point &a = corners[i], &b = corners[j], ab = difference(b, a);
    const Number along = -dot(a, ab);
    if (along <= 0 || dot(b, ab) <= 0) return false;
    const Number square = dot(ab, ab);
    const Point n = {a[0] * square + ab[0] * along, a[1] * square + ab[1] * along, a[2] * square + ab[2] * along};
    return keeps(n, {i, j, j}, 2);
  }

  bool nearest_to_face(std::size_t i, std::size_t j, std::size_t k) {
    const Point &a = corners[i], &b = corners[j], &c = corners[k];
    Point n = cross(difference(b, a), difference(c, a));
    if (dot(cross(b, c), n) <= 0 || dot(cross(c, a), n) <= 0 || dot(cross(a, b), n) <= 0) return false;
    if (dot(n, a) < 0) n = {-n[0], -n[1], -n[2]};
    if (dot(n, a) == 0) n = {0, 0, 0};  // the origin lies on the face
    return keeps(n, {i, j, k}, 3);
  }
};

}  // namespace thinwall
