#pragma once
/// Vectors side by side, by component: what is asked of two or three at once.

#include <thinwall/discrete/clear/lanes.hpp>

namespace thinwall::packed {

/// Two vectors in pairs, or three in lanes.
template <class Pack> struct Vectors {
  Pack x, y, z;

  THINWALL_HOT friend Vectors operator+(const Vectors& a, const Vectors& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  THINWALL_HOT friend Vectors operator-(const Vectors& a, const Vectors& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  THINWALL_HOT friend Vectors operator*(const Vectors& a, const Pack& s) { return {a.x * s, a.y * s, a.z * s}; }
  THINWALL_HOT friend Vectors abs(const Vectors& a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
  THINWALL_HOT friend Pack dot(const Vectors& a, const Vectors& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
  THINWALL_HOT friend Vectors cross(const Vectors& a, const Vectors& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

/// One vector, thrice: dot(transposed(a, b, c), spread(v)) is a.v, b.v and c.v, with the bits of dot().
#ifdef __AVX__
THINWALL_HOT Vectors<Lanes> spread(const Lanes& v) {
  return {{__builtin_shufflevector(v.v, v.v, 0, 0, 0, 0)},
          {__builtin_shufflevector(v.v, v.v, 1, 1, 1, 1)},
          {__builtin_shufflevector(v.v, v.v, 2, 2, 2, 2)}};
}
THINWALL_HOT Vectors<Lanes> spread(const double* v) { return {all(v[0]), all(v[1]), all(v[2])}; }
THINWALL_HOT Vectors<Lanes> transposed(const Lanes& a, const Lanes& b, const Lanes& c) {
  const auto even = __builtin_shufflevector(a.v, b.v, 0, 4, 2, 6), odd = __builtin_shufflevector(a.v, b.v, 1, 5, 3, 7);
  const auto next = __builtin_shufflevector(c.v, c.v, 1, 1, 3, 3);
  return {{__builtin_shufflevector(even, c.v, 0, 1, 4, 4)},
          {__builtin_shufflevector(odd, next, 0, 1, 4, 5)},
          {__builtin_shufflevector(even, c.v, 2, 3, 6, 7)}};
}
#else
THINWALL_HOT Vectors<Lanes> spread(const Lanes& v) {
  return {all(firsts(xy_of(v))), all(seconds(xy_of(v))), all(zz_of(v))};
}
THINWALL_HOT Vectors<Lanes> spread(const double* v) { return spread(lanes(v)); }
THINWALL_HOT Vectors<Lanes> transposed(const Lanes& a, const Lanes& b, const Lanes& c) {
  return {lanes(firsts(xy_of(a), xy_of(b)), firsts(xy_of(c))), lanes(seconds(xy_of(a), xy_of(b)), seconds(xy_of(c))),
          lanes(firsts(zz_of(a), zz_of(b)), zz_of(c))};
}
#endif
THINWALL_HOT Vectors<Lanes> spread(const Vec3<double>& v) { return spread(v.data()); }
/// The one of the lane that is kept.
THINWALL_HOT Lanes only(const LanesMask& one, const Vectors<Lanes>& of) {
  return lanes(two_sums(keep(one, of.x), keep(one, of.y)), sum(keep(one, of.z)));
}

/// Four vectors, of three and the last.
THINWALL_HOT Vectors<Lanes> with_last(const Vectors<Lanes>& three, const Lanes& last) {
  const auto fourth = [](const Lanes& of, const Pair& its) { return lanes(xy_of(of), firsts(zz_of(of), its)); };
  return {fourth(three.x, xy_of(last)), fourth(three.y, swapped(xy_of(last))), fourth(three.z, zz_of(last))};
}

/// One vector, twice; or two.
THINWALL_HOT Vectors<Pair> twice(const Vec3<double>& a) { return {both(a[0]), both(a[1]), both(a[2])}; }
THINWALL_HOT Vectors<Pair> side_by_side(const Vec3<double>& a, const Vec3<double>& b) {
  return {pair(a[0], b[0]), pair(a[1], b[1]), pair(a[2], b[2])};
}

}  // namespace thinwall::packed
