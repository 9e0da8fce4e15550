#pragma once
/// What every manifold must fulfil, and shapes drawn to have one: faces flush or all but, on a lattice or turned at
/// will.

#include <thinwall/capsule/capsule_manifold.hpp>

#include <random>

#include <gtest/gtest.h>

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
  const Vec3<S> start = draw.vector(), along = draw.axes() * Vec3<S>(0, draw.coordinate(), 0);
  return {start, start + along, draw.sizes()[0]};
}

/// Two shapes, most of them moved until they are a little in each other, some until they just touch.
template <class A, class B> std::pair<A, B> nearly_touching(Shaker<typename A::Scalar>& draw) {
  using S = typename A::Scalar;
  const A a = drawn(draw, TypeTag<A>{});
  const B b = drawn(draw, TypeTag<B>{});
  const Separation<S> gap = separation(a, b);
  const S depth = draw.pick(0, 2) == 0 ? S(0) : S(draw.coordinate() / S(16));
  return {a, draw.pick(0, 5) == 0 ? b : moved(b, Vec3<S>(gap.normal * (-gap.distance - depth)))};
}

/// How far a point of the surface, given as in a contact, is from the surface.
template <class A> Wide off_surface(const A& shape, const Vec3<typename A::Scalar>& local) {
  const auto wide = cast<Wide>(shape);
  return largest(separation(Sphere<Wide>{center(wide) + local.template cast<Wide>(), Wide(0)}, wide).distance);
}

/// The manifold of two shapes is empty exactly where they are apart, and else a set of real points as deep as contact()
/// says, in either order.
template <class A, class B> void expect_manifold(const A& a, const B& b) {
  using S = typename A::Scalar;
  const Manifold<S> found = manifold(a, b);
  ASSERT_EQ(found.empty(), !overlaps(a, b));
  if (found.empty()) return;
  ASSERT_LE(found.size(), std::size_t{4});
  const Wide size(S(magnitude(a) + magnitude(b)));
  const Wide allowed = 64 * Wide(unit<S>()) * size;
  const S turned = largest<S>(found[0].normal - contact(a, b)->normal);
  EXPECT_LE(turned, 2 * parallel_sine<S>());
  EXPECT_LE(largest(Wide(Wide(found[0].penetration) - Wide(contact(a, b)->penetration))),
            allowed + 8 * Wide(turned) * size);
  if constexpr (!std::is_same_v<A, B>) {
    const Manifold<S> back = manifold(b, a);
    ASSERT_EQ(back.size(), found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(back[i].local_a, found[i].local_b);
      EXPECT_EQ(back[i].local_b, found[i].local_a);
      EXPECT_EQ(back[i].normal, -found[i].normal);
      EXPECT_EQ(back[i].penetration, found[i].penetration);
    }
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Contact<S>& c = found[i];
    EXPECT_GE(c.penetration, S(0));
    EXPECT_LE(c.penetration, found[0].penetration);
    EXPECT_EQ(c.normal, found[0].normal);
    EXPECT_LE(largest(Wide(c.normal.template cast<Wide>().squaredNorm() - 1)), 64 * Wide(unit<S>()));
    EXPECT_LE(off_surface(a, c.local_a), allowed);
    EXPECT_LE(off_surface(b, c.local_b), allowed);
    const Vec3<Wide> from_a_to_b = (center(cast<Wide>(b)) + c.local_b.template cast<Wide>()) -
                                   (center(cast<Wide>(a)) + c.local_a.template cast<Wide>());
    const bool skew = std::is_same_v<A, B> && std::is_same_v<A, Capsule<S>> && found.size() == 2;
    EXPECT_LE(largest<Wide>(from_a_to_b + c.normal.template cast<Wide>() * Wide(c.penetration)),
              skew ? Wide(parallel_sine<S>()) * size : allowed);
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(c.local_b, found[k].local_b);
  }
}

/// Many pairs of two types of shape; stops at the first that fails.
template <class A, class B> void expect_manifolds(int runs) {
  using S = typename A::Scalar;
  Shaker<S> draw(20261121);
  int points[5] = {};
  for (int run = 0; run < runs && !::testing::Test::HasFailure(); ++run) {
    const auto [a, b] = nearly_touching<A, B>(draw);
    SCOPED_TRACE("run " + std::to_string(run));
    expect_manifold(a, b);
    ++points[manifold(a, b).size()];
  }
  for (std::size_t n = 0; n < 5; ++n) ::testing::Test::RecordProperty("points_" + std::to_string(n), points[n]);
}

}  // namespace thinwall::testing
