#pragma once
/// What every manifold must fulfil, and pairs of shapes drawn to have one.

#include <thinwall/capsule/capsule_manifold.hpp>

#include <gtest/gtest.h>

#include "support/contacts.hpp"
#include "support/real.hpp"
#include "support/shaker.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {

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
  return largest(
      separation_unchecked(Sphere<Wide>{center(wide) + local.template cast<Wide>(), Wide(0)}, wide).distance);
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
      const Contact<S>& c = found[i];
      EXPECT_TRUE(same(back[i], {c.local_b, c.local_a, -c.normal, c.penetration})) << i;
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
template <class A, class B> void expect_manifolds(std::size_t runs) {
  using S = typename A::Scalar;
  Shaker<S> draw(20261121);
  for (std::size_t run = 0, end = thorough(runs); run < end && !::testing::Test::HasFailure(); ++run) {
    const auto [a, b] = nearly_touching<A, B>(draw);
    SCOPED_TRACE("run " + std::to_string(run));
    expect_manifold(a, b);
  }
}

}  // namespace thinwall::testing
