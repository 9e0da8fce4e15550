// A plane between moving shapes: what it proves, and that rounding only ever weakens the proof.

#include <gtest/gtest.h>
#include <thinwall/swept/methods/separating_plane.hpp>
#include <thinwall/swept/methods/tolerance.hpp>

#include "support/scalars.hpp"

namespace thinwall::testing {
namespace {

template <class S> class Plane : public ::testing::Test {
 protected:
  const Moving<Aabb<S>> wall = at_rest(Aabb<S>{{0, 0, 0}, {0.125, 8, 8}});
  const Moving<Sphere<S>> shot{{{-1, 0, 0}, 0.25}, {2, 0, 0}};
};
TYPED_TEST_SUITE(Plane, Scalars, ScalarNames);

TYPED_TEST(Plane, is_open_until_just_before_contact) {
  using S = TypeParam;
  const SeparatingPlane<S> plane = separating_plane<Sphere<S>, Aabb<S>>(this->shot, this->wall, {1, 0, 0}, S(0));
  EXPECT_TRUE(plane.gap < S(0.625) && plane.gap > S(0.625) - 512 * unit<S>());
  EXPECT_TRUE(plane.closing > S(2) && plane.closing < S(2) + 64 * unit<S>());
  EXPECT_TRUE(plane.free_until() < S(0.3125) && plane.free_until() > S(0.3125) - 512 * unit<S>());
  EXPECT_TRUE(plane.free_at(S(0)) && plane.free_at(plane.free_until() * (1 - 8 * unit<S>())));
  EXPECT_FALSE(plane.free_at(S(0.3125)));
  EXPECT_FALSE(plane.free_from(S(0)));
}

TYPED_TEST(Plane, across_any_other_direction_proves_less) {
  using S = TypeParam;
  for (const S& tilt : {S(0.03125), S(0.0625), S(1), S(-1)}) {
    const Vec3<S> n = safe_unit(Vec3<S>(1, tilt, 0));
    EXPECT_TRUE(separating_plane(this->shot, this->wall, n, S(0)).free_until() < S(0.3125)) << tilt;
  }
  EXPECT_EQ((separating_plane<Sphere<S>, Aabb<S>>(this->shot, this->wall, {0, 1, 0}, S(0)).free_until()), S(0));
  EXPECT_EQ((separating_plane<Sphere<S>, Aabb<S>>(this->shot, this->wall, {-1, 0, 0}, S(0)).free_until()), S(0));
}

TYPED_TEST(Plane, stays_open_behind_what_leaves) {
  using S = TypeParam;
  const Moving<Sphere<S>> leaving{{{-1, 0, 0}, 0.25}, {-2, 0, 0}}, through{{{-0.25, 0, 0}, 0.25}, {-2, 0, 0}};
  const auto open = separating_plane<Sphere<S>, Aabb<S>>(leaving, this->wall, {1, 0, 0}, S(0));
  EXPECT_TRUE(open.free_from(S(0)) && open.free_until() > S(1));
  const auto opening = separating_plane<Sphere<S>, Aabb<S>>(through, this->wall, {1, 0, 0}, S(0));
  EXPECT_EQ(opening.free_until(), S(0));  // in contact at the start
  EXPECT_FALSE(opening.free_from(S(0.0625)));
  EXPECT_TRUE(opening.free_from(S(0.0625) + 512 * unit<S>()));
}

TYPED_TEST(Plane, knows_how_far_every_shape_reaches) {
  using S = TypeParam;
  const Vec3<S> x(1, 0, 0), n = safe_unit(Vec3<S>(1, 1, 0));
  const S root = n[0];  // of one half
  Mat3<S> turned = Mat3<S>::Identity();
  turned.col(0) = n;
  turned.col(1) = Vec3<S>(-root, root, 0);
  const auto near = [](const S& found, const S& wanted) { return largest(S(found - wanted)) <= 16 * unit<S>(); };
  EXPECT_EQ(reach_along(Sphere<S>{{5, 0, 0}, 2}, n), S(2));
  EXPECT_TRUE(near(reach_along(Aabb<S>{{5, 0, 0}, {2, 1, 4}}, n), 3 * root));
  EXPECT_TRUE(near(reach_along(Obb<S>{{5, 0, 0}, {2, 1, 4}, turned}, n), S(2)));
  EXPECT_TRUE(near(reach_along(Obb<S>{{5, 0, 0}, {2, 1, 4}, turned}, x), 3 * root));
  EXPECT_TRUE(near(reach_along(Triangle<S>{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, x), S(2)));  // the centroid is at 1
  EXPECT_TRUE(near(reach_along<S>(Triangle<S>{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, -x), S(1)));
  EXPECT_TRUE(near(reach_along(Capsule<S>{{-1, 0, 0}, {3, 2, 0}, 0.5}, x), S(2.5)));
  EXPECT_TRUE(near(reach_along<S>(Capsule<S>{{-1, 0, 0}, {3, 2, 0}, 0.5}, -x), S(2.5)));
}

TEST(RoundedDown, is_the_largest_float_that_is_not_later) {
  const double above = 0.5 + 1e-9, below = 0.5 - 1e-9;  // nearer to 0.5 than to its neighbors
  EXPECT_EQ(rounded_down_to<float>(above), 0.5);
  EXPECT_EQ(rounded_down_to<float>(below), 0.5 - power<double>(-25));
  EXPECT_EQ(rounded_down_to<float>(0.5), 0.5);
  EXPECT_EQ(rounded_down_to<float>(0.0), 0.0);
  EXPECT_EQ(rounded_down_to<double>(above), above);
  EXPECT_EQ(rounded_down_to<float>(1e-60), 0.0);  // the smallest float is later
}

}  // namespace
}  // namespace thinwall::testing
