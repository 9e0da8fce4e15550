#pragma once
/// Shapes of every kind, drawn to touch in more than a point: on a lattice, turned by eighths, or all but aligned.

#include <random>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/type_list.hpp>

#include "support/scalars.hpp"

namespace thinwall::testing {

/// Draws the same numbers in every run.
template <class S> class Shaker {
 public:
  explicit Shaker(unsigned seed) : engine_(seed) {}

  int pick(int low, int high) { return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1)); }
  S plain() { return S(static_cast<double>(engine_()) / 2147483648.0 - 1.0); }
  S coordinate() { return lattice() ? S(pick(-4, 4)) / S(2) : S(2 * plain()); }
  Vec3<S> vector() { return {coordinate(), coordinate(), coordinate()}; }
  Vec3<S> sizes() { return vector().cwiseAbs(); }

  /// A turn about one axis or a few: by eighths, by next to nothing, or by any angle.
  Mat3<S> axes() {
    Mat3<S> all = Mat3<S>::Identity();
    for (int turns = pick(0, 2); turns >= 0; --turns) {
      using std::cos, std::sin;
      const int way = pick(0, 3);
      const S tiny = power<S>(-pick(4, 2 * std::numeric_limits<S>::digits));
      const S angle = way == 0 ? S(0) : way == 1 ? tiny : S(2 * plain());
      const S root = S(1) / sqrt_of(S(2));
      const S c = way == 3 ? root : S(cos(angle)), s = way == 3 ? root : S(sin(angle));
      const int u = pick(0, 2), v = (u + 1) % 3;
      Mat3<S> turn = Mat3<S>::Identity();
      turn(u, u) = turn(v, v) = c;
      turn(u, v) = -s;
      turn(v, u) = s;
      all = (all * turn).eval();
    }
    return all;
  }

 private:
  bool lattice() { return pick(0, 1) == 0; }
  static S sqrt_of(const S& x) {
    using std::sqrt;
    return sqrt(x);
  }
  std::mt19937 engine_;
};

template <class S> Sphere<S> drawn(Shaker<S>& draw, TypeTag<Sphere<S>>) { return {draw.vector(), draw.sizes()[0]}; }
template <class S> Aabb<S> drawn(Shaker<S>& draw, TypeTag<Aabb<S>>) { return {draw.vector(), draw.sizes()}; }
template <class S> Obb<S> drawn(Shaker<S>& draw, TypeTag<Obb<S>>) { return {draw.vector(), draw.sizes(), draw.axes()}; }
template <class S> Triangle<S> drawn(Shaker<S>& draw, TypeTag<Triangle<S>>) {
  Triangle<S> t{draw.vector(), draw.vector(), draw.vector()};
  if (draw.pick(0, 1) == 0) t.a[2] = t.b[2] = t.c[2];
  return t;
}
template <class S> Capsule<S> drawn(Shaker<S>& draw, TypeTag<Capsule<S>>) {
  const Vec3<S> start = draw.vector();
  const Mat3<S> axes = draw.axes();
  const Vec3<S> along =
      axes.col(1) * draw.coordinate();  // one draw a statement: compilers order arguments as they like
  return {start, start + along, draw.sizes()[0]};
}

}  // namespace thinwall::testing
