#pragma once
/// The point of a convex polytope that is nearest to the origin, from its support function alone. It knows nothing of
/// spheres, boxes or capsules: this is what makes it an oracle for code that is all about them.
///
/// Source: Wolfe, "Finding the nearest point in a polytope", Mathematical Programming 11, 1976. Exact in finitely many
/// steps, but for rounding; at 50 digits rounding is out of sight of a double.

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace thinwall::oracle {

template <class R> using Vec = std::array<R, 3>;

template <class R> R dot(const Vec<R>& a, const Vec<R>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
template <class R> Vec<R> combination(const R& s, const Vec<R>& a, const R& t, const Vec<R>& b) {
  return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
}

/// Up to four points and the weights that make the nearest point so far of them.
template <class R> struct Corral {
  std::array<Vec<R>, 5> points{};
  std::array<R, 5> weights{};
  std::size_t size = 0;

  Vec<R> point(const std::array<R, 5>& by) const {
    Vec<R> sum{};
    for (std::size_t i = 0; i < size; ++i) sum = combination(R(1), sum, by[i], points[i]);
    return sum;
  }
  void drop(std::size_t i) {
    for (; i + 1 < size; ++i) {
      points[i] = points[i + 1];
      weights[i] = weights[i + 1];
    }
    --size;
  }

  /// The weights, of any sign, of the point nearest to the origin on the flat through all points: with one of them as the
  /// base, a small system of normal equations.
  std::array<R, 5> flat_weights() const {
    const std::size_t n = size - 1;
    std::array<std::array<R, 5>, 4> rows{};
    std::array<Vec<R>, 4> edges{};
    for (std::size_t i = 0; i < n; ++i) edges[i] = combination(R(1), points[i + 1], R(-1), points[0]);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) rows[i][j] = dot(edges[i], edges[j]);
      rows[i][4] = -dot(edges[i], points[0]);
    }
    for (std::size_t column = 0; column < n; ++column) {
      std::size_t pivot = column;
      for (std::size_t i = column + 1; i < n; ++i) {
        if (abs_of(rows[i][column]) > abs_of(rows[pivot][column])) pivot = i;
      }
      std::swap(rows[pivot], rows[column]);
      if (rows[column][column] == 0) continue;
      for (std::size_t i = 0; i < n; ++i) {
        if (i == column) continue;
        const R factor = rows[i][column] / rows[column][column];
        for (std::size_t j = column; j < 5; ++j) rows[i][j] -= factor * rows[column][j];
      }
    }
    std::array<R, 5> result{};
    result[0] = 1;
    for (std::size_t i = 0; i < n; ++i) {
      if (rows[i][i] != 0) result[i + 1] = rows[i][4] / rows[i][i];
      result[0] -= result[i + 1];
    }
    return result;
  }

  static R abs_of(const R& x) { return x < 0 ? R(-x) : x; }
};

/// `support(n)` is a point of the polytope farthest along n; `tolerance` [1] the relative gap at which to stop.
template <class R, class Support> Vec<R> nearest_to_origin(const Support& support, const R& tolerance) {
  using std::sqrt;
  Corral<R> corral;
  corral.points[0] = support(Vec<R>{R(1), R(0), R(0)});
  corral.weights[0] = 1;
  corral.size = 1;
  Vec<R> x = corral.points[0];
  R largest = dot(x, x);
  for (int round = 0; round < 200; ++round) {
    const Vec<R> q = support(Vec<R>{R(-x[0]), R(-x[1]), R(-x[2])});
    const R q_square = dot(q, q);
    if (q_square > largest) largest = q_square;
    const R x_square = dot(x, x);
    const R noise = 64 * std::numeric_limits<R>::epsilon() * sqrt(x_square * largest);  // of the next line's difference
    if (x_square - dot(x, q) <= tolerance * x_square + noise || x_square <= tolerance * tolerance * largest) break;
    corral.points[corral.size] = q;
    corral.weights[corral.size] = 0;
    ++corral.size;
    for (int inner = 0; inner < 8; ++inner) {
      const std::array<R, 5> target = corral.flat_weights();
      R step = 1;
      std::size_t blocking = corral.size;
      for (std::size_t i = 0; i < corral.size; ++i) {
        if (target[i] > 0) continue;
        const R reach = corral.weights[i] / (corral.weights[i] - target[i]);
        if (corral.weights[i] == target[i] || reach < step || blocking == corral.size) {
          step = corral.weights[i] == target[i] ? R(0) : reach;
          blocking = i;
        }
      }
      for (std::size_t i = 0; i < corral.size; ++i) corral.weights[i] += step * (target[i] - corral.weights[i]);
      if (blocking == corral.size) break;
      corral.drop(blocking);
    }
    const Vec<R> next = corral.point(corral.weights);
    if (!(dot(next, next) < x_square)) break;
    x = next;
    if (corral.size == 4) break;  // a tetrahedron around the origin
  }
  return x;
}

}  // namespace thinwall::oracle
