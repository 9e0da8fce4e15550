#pragma once
/// Asks the C++ library row by row, for tests of the Python package:
///
///   row_by_row QUERY SCALAR KIND_A KIND_B ROWS [METHOD] <rows of A, then rows of B, as their numbers lie in memory  >answers, without gaps
///
/// It shares no code with python/src: another reader of rows, and the front doors with A and B in the order that is given.

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <thinwall/swept/compiled.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/turning.hpp>

namespace thinwall::row_by_row {

struct Task {
  std::string query, kind_a, kind_b, method;
  std::size_t rows = 0;
};

template <class T> void put(const T& value) { std::fwrite(&value, sizeof value, 1, stdout); }
template <Scalar S> void put(const Vec3<S>& v) { std::fwrite(v.data(), sizeof(S), 3, stdout); }

template <Scalar S> Vec3<S> vector(const S* x) { return {x[0], x[1], x[2]}; }

template <class A> struct Known;
template <Scalar S> struct Known<Sphere<S>> {
  static constexpr const char* name = "Sphere";
  static constexpr int size = 4;
  static Sphere<S> of(const S* x) { return {vector(x), x[3]}; }
};
template <Scalar S> struct Known<Aabb<S>> {
  static constexpr const char* name = "Aabb";
  static constexpr int size = 6;
  static Aabb<S> of(const S* x) { return {vector(x), vector(x + 3)}; }
};
template <Scalar S> struct Known<Obb<S>> {
  static constexpr const char* name = "Obb";
  static constexpr int size = 15;
  static Obb<S> of(const S* x) {
    Mat3<S> axes;
    axes << x[6], x[7], x[8], x[9], x[10], x[11], x[12], x[13], x[14];  // row by row, as NumPy's
    return {vector(x), vector(x + 3), axes};
  }
};
template <Scalar S> struct Known<Triangle<S>> {
  static constexpr const char* name = "Triangle";
  static constexpr int size = 9;
  static Triangle<S> of(const S* x) { return {vector(x), vector(x + 3), vector(x + 6)}; }
};
template <Scalar S> struct Known<Capsule<S>> {
  static constexpr const char* name = "Capsule";
  static constexpr int size = 7;
  static Capsule<S> of(const S* x) { return {vector(x), vector(x + 3), x[6]}; }
};
template <Scalar S> struct Known<Ray<S>> {
  static constexpr const char* name = "Ray";
  static constexpr int size = 7;
  static Ray<S> of(const S* x) { return {vector(x), vector(x + 3), x[6]}; }
};

/// A shape and the numbers of its motion, which not every query reads.
template <class A> struct Body {
  using S = typename A::Scalar;
  A shape;
  Vec3<S> displacement, rotation;
};
template <Scalar S> struct Body<Ray<S>> {
  Ray<S> shape;
};

/// Reads ROWS bodies: the shape's numbers, 3 of its displacement, 3 of its rotation; of a ray its own alone.
template <class A, class S> std::vector<Body<A>> read_bodies(std::size_t rows) {
  constexpr bool moves = !std::is_same_v<A, Ray<S>>;
  constexpr std::size_t size = Known<A>::size + (moves ? 6 : 0);
  std::vector<Body<A>> bodies;
  S x[size];
  for (std::size_t i = 0; i < rows; ++i) {
    if (std::fread(x, sizeof(S), size, stdin) != size) std::exit(3);
    if constexpr (moves) {
      bodies.push_back({Known<A>::of(x), vector(x + size - 6), vector(x + size - 3)});
    } else {
      bodies.push_back({Known<A>::of(x)});
    }
  }
  return bodies;
}

/// Calls ask(a, b) for every row of the two kinds, if the query is asked of such a pair (`Asked<A, B>::value`).
template <class A, class B, class S, class Ask> bool each_row(const Task& task, const Ask& ask) {
  if (task.kind_a != Known<A>::name || task.kind_b != Known<B>::name) return false;
  const auto a = read_bodies<A, S>(task.rows);
  const auto b = read_bodies<B, S>(task.rows);
  for (std::size_t i = 0; i < task.rows; ++i) ask(a[i], b[i]);
  return true;
}

template <Scalar S> void put(const Toi<S>& toi) {
  put(toi.status);
  put(toi.evaluations);
  put(toi.time);
  put(toi.normal);
  put(toi.point);
}

template <class S> bool at_rest(const Task& task);
template <class S> bool in_time(const Task& task);
template <class S> bool by_method(const Task& task);
bool certified(const Task& task);

}  // namespace thinwall::row_by_row
