#pragma once
/// Shapes of every kind, drawn to touch in more than a point: on a lattice, turned by eighths, or all but aligned.

#include <random>

#include <Eigen/Geometry>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/queries.hpp>
#include <thinwall/discrete/type_list.hpp>
#include <thinwall/swept/moving.hpp>

#include "support/real.hpp"

namespace thinwall::testing {

/// Turns the axis u towards the axis v, by an angle of this cosine and sine.
template <class S> Mat3<S> turn_in_plane(int u, int v, const S& cosine, const S& sine) {
  Mat3<S> turn = Mat3<S>::Identity();
  turn(u, u) = turn(v, v) = cosine;
  turn(u, v) = -sine;
  turn(v, u) = sine;
  return turn;
}

/// How coordinates are drawn: on a lattice of halves, anyhow, down to 2^-30 and up to 2^30; or now on the lattice, now anyhow.
enum class Style { mixed, lattice, plain, decades };

/// Draws the same numbers in every run.
template <class S> class Shaker {
 public:
  explicit Shaker(unsigned seed, Style style = Style::mixed) : style_(style), engine_(seed) {}

  Style style() const { return style_; }

  int pick(int low, int high) { return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1)); }
  S plain() { return S(static_cast<double>(engine_()) / 2147483648.0 - 1.0); }
  /// Of any direction, coordinates in [-1, 1); and axes turned anyhow.
  Vec3<S> plain_vector() { return {plain(), plain(), plain()}; }
  Mat3<S> plain_axes() {
    Mat3<S> axes;
    axes.col(0) = safe_unit(plain_vector());
    axes.col(1) = safe_unit(thinwall::cross<S>(axes.col(0), plain_vector()));
    axes.col(2) = thinwall::cross<S>(axes.col(0), axes.col(1));
    return axes;
  }
  /// Those of a quaternion, which are off right angles by several times as many roundings as those of which one is made across the others.
  Mat3<S> quaternion_axes() {
    using std::sqrt;
    const S w = plain(), x = plain(), y = plain(), z = plain(), length = sqrt(w * w + x * x + y * y + z * z);
    return Eigen::Quaternion<S>(w / length, x / length, y / length, z / length).toRotationMatrix();
  }
  S coordinate() {
    if (style_ == Style::lattice || (style_ == Style::mixed && pick(0, 1) == 0)) return S(pick(-4, 4)) / S(2);
    const S scale = power<S>(style_ == Style::decades ? pick(-30, 30) : 1);
    return S(scale * plain());
  }
  Vec3<S> vector() { return {coordinate(), coordinate(), coordinate()}; }
  Vec3<S> sizes() { return vector().cwiseAbs(); }

  /// A turn about one axis or a few: by eighths, by next to nothing, or by any angle.
  Mat3<S> axes() {
    Mat3<S> all = Mat3<S>::Identity();
    for (int turns = pick(0, 2); turns >= 0; --turns) {
      using std::cos, std::sin, std::sqrt;
      const int way = pick(0, 3);
      const S tiny = power<S>(-pick(4, 2 * std::numeric_limits<S>::digits));
      const S angle = way == 0 ? S(0) : way == 1 ? tiny : S(2 * plain());
      const S root = S(1) / S(sqrt(S(2)));
      const S c = way == 3 ? root : S(cos(angle)), s = way == 3 ? root : S(sin(angle));
      const int u = pick(0, 2);
      all = (all * turn_in_plane(u, (u + 1) % 3, c, s)).eval();
    }
    return all;
  }

 private:
  Style style_;
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

// ---- Any two shapes in motion, drawn to go wrong: on a lattice or decades apart in size, aimed at each other, fast, far from
// the origin, moved until they all but touch at the start or the end, and turned until they all but graze.

template <class A, class B> struct Motion {
  Moving<A> a;
  Moving<B> b;
};

/// Moves B until the two touch at `time`, to rounding; returns the normal there.
template <class A, class B, class S> Vec3<S> bring_together(Motion<A, B>& motion, const S& time) {
  const Separation<S> there = separation(pose_at(motion.a, time), pose_at(motion.b, time));
  motion.b.shape = moved<S>(motion.b.shape, there.normal * -there.distance);
  return there.normal;
}

/// Turns the motion of A until it runs past B at `time`, the pose there kept.
template <class A, class B, class S> void make_graze(Motion<A, B>& motion, const S& time, const Vec3<S>& normal) {
  const Vec3<S> closing = normal * normal.dot(motion.a.displacement - motion.b.displacement);
  motion.a.shape = moved<S>(motion.a.shape, closing * time);
  motion.a.displacement -= closing;
}

template <class A, class B, class S> Motion<A, B> drawn_motion(Shaker<S>& draw) {
  Motion<A, B> motion{at_rest(drawn(draw, TypeTag<A>{})), at_rest(drawn(draw, TypeTag<B>{}))};
  const int size = draw.style() == Style::mixed && draw.pick(0, 3) == 0 ? draw.pick(-20, 20) : 0;
  motion.a.shape = scaled(moved<S>(motion.a.shape, -center(motion.a.shape)), size);
  motion.a.shape = moved<S>(motion.a.shape, draw.vector() * power<S>(draw.pick(0, 2) + std::max(0, size)));
  if (draw.pick(0, 1) == 0) motion.b.displacement = draw.vector();
  motion.a.displacement = draw.vector() * power<S>(std::max(0, size) - draw.pick(0, 2));
  if (draw.pick(0, 3) != 0) {  // where B will be
    const Vec3<S> towards = center(motion.b.shape) + motion.b.displacement - center(motion.a.shape);
    motion.a.displacement += towards * (S(draw.pick(1, 8)) / S(4));
  }
  const int speed = draw.pick(0, 9);
  if (speed == 0) motion.a.displacement *= power<S>(10);
  if (speed == 1) motion.a.displacement *= power<S>(-10);
  if (speed == 2) motion.a.displacement[draw.pick(0, 2)] = S(0);
  if (draw.pick(0, 4) == 0) {
    const Vec3<S> offset = draw.vector() * power<S>(draw.pick(4, 20));
    motion.a.shape = moved(motion.a.shape, offset);
    motion.b.shape = moved(motion.b.shape, offset);
  }
  const S time = S(draw.pick(0, 64)) / S(64);
  switch (draw.pick(0, 9)) {
    case 0: bring_together(motion, S(0)); break;
    case 1: bring_together(motion, S(1)); break;
    case 2:
    case 3: make_graze(motion, time, bring_together(motion, time)); break;
    case 4:
      make_graze(motion, time, bring_together(motion, time));
      motion.a.displacement += draw.vector() * power<S>(-draw.pick(4, std::numeric_limits<S>::digits));
      break;
    default: break;
  }
  return motion;
}

}  // namespace thinwall::testing
