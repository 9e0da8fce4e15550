// Two balls at one instant, by hand.

#include <gtest/gtest.h>
#include <thinwall/discrete/sphere.hpp>

#include "support/scalars.hpp"

namespace thinwall::testing {
namespace {

template <class S> class SphereSphere : public ::testing::Test {
 protected:
  using Vec = Vec3<S>;
  const Sphere<S> ball{{0, 0, 0}, 1};
};
TYPED_TEST_SUITE(SphereSphere, Scalars, ScalarNames);

TYPED_TEST(SphereSphere, touching_counts_and_one_ulp_decides) {
  using S = TypeParam;
  EXPECT_TRUE(overlaps(this->ball, Sphere<S>{{2, 0, 0}, 1}));
  EXPECT_TRUE(overlaps(this->ball, Sphere<S>{{next_down(S(2)), 0, 0}, 1}));
  EXPECT_FALSE(overlaps(this->ball, Sphere<S>{{next_up(S(2)), 0, 0}, 1}));
  EXPECT_TRUE(overlaps(Sphere<S>{{0, 0, 0}, 2}, Sphere<S>{{3, 4, 0}, 3}));  // 3-4-5
}

TYPED_TEST(SphereSphere, contact_of_a_touch_has_no_depth) {
  using S = TypeParam;
  const auto touch = contact(this->ball, Sphere<S>{{2, 0, 0}, 1});
  ASSERT_TRUE(touch.has_value());
  EXPECT_EQ(touch->penetration, S(0));
  EXPECT_EQ(touch->normal, Vec3<S>(1, 0, 0));
}

TYPED_TEST(SphereSphere, contact_points_are_relative_to_the_centers) {
  using S = TypeParam;
  const auto found = contact(Sphere<S>{{8, 16, -4}, 1}, Sphere<S>{{8, 17.5, -4}, 2});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->normal, Vec3<S>(0, 1, 0));
  EXPECT_EQ(found->penetration, S(1.5));
  EXPECT_EQ(found->local_a, Vec3<S>(0, 1, 0));
  EXPECT_EQ(found->local_b, Vec3<S>(0, -2, 0));
}

TYPED_TEST(SphereSphere, apart_has_a_distance_and_no_contact) {
  using S = TypeParam;
  const Sphere<S> other{{3, 0, 4}, 2};
  EXPECT_FALSE(contact(this->ball, other).has_value());
  const Separation<S> gap = separation(this->ball, other);
  EXPECT_EQ(gap.distance, S(2));
  EXPECT_EQ(gap.normal, Vec3<S>(S(3) / S(5), 0, S(4) / S(5)));
  EXPECT_TRUE(((gap.point_b - gap.point_a) - gap.normal * gap.distance).norm() <= 8 * unit<S>());
}

TYPED_TEST(SphereSphere, coincident_centers_part_along_x_whichever_way_round) {
  using S = TypeParam;
  const Sphere<S> small{{0, 0, 0}, 0.25};
  for (const auto& found : {contact(this->ball, small), contact(small, this->ball)}) {
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->normal, Vec3<S>(1, 0, 0));
    EXPECT_EQ(found->penetration, S(1.25));
  }
  EXPECT_EQ(separation(this->ball, small).distance, S(-1.25));
  EXPECT_EQ(separation(this->ball, small).normal, Vec3<S>(1, 0, 0));
}

TYPED_TEST(SphereSphere, points) {
  using S = TypeParam;
  const Sphere<S> point{{1, 2, 3}, 0};
  EXPECT_TRUE(overlaps(point, point));
  ASSERT_TRUE(contact(point, point).has_value());
  EXPECT_EQ(contact(point, point)->penetration, S(0));
  EXPECT_EQ(contact(point, point)->normal, Vec3<S>(1, 0, 0));
  EXPECT_FALSE(overlaps(point, Sphere<S>{{1, 2, next_up(S(3))}, 0}));
  const S least = std::numeric_limits<S>::min();
  EXPECT_FALSE(overlaps(Sphere<S>{{0, 0, 0}, 0}, Sphere<S>{{least, 0, 0}, 0}));
  EXPECT_TRUE(overlaps(Sphere<S>{{0, 0, 0}, 0}, Sphere<S>{{least, 0, 0}, least}));
}

TYPED_TEST(SphereSphere, one_within_the_other) {
  using S = TypeParam;
  const auto found = contact(Sphere<S>{{0, 0, 0}, 8}, Sphere<S>{{0, 0, 1}, 1});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->penetration, S(8));
  EXPECT_EQ(found->normal, Vec3<S>(0, 0, 1));
}

TYPED_TEST(SphereSphere, validity) {
  using S = TypeParam;
  EXPECT_TRUE(valid(this->ball));
  EXPECT_TRUE(valid(Sphere<S>{{0, 0, 0}, 0}));
  for (const S& bad : {nan<S>(), infinity<S>(), S(-infinity<S>())}) {
    EXPECT_FALSE(valid(Sphere<S>{{0, bad, 0}, 1}));
    EXPECT_FALSE(valid(Sphere<S>{{0, 0, 0}, bad}));
  }
  EXPECT_FALSE(valid(Sphere<S>{{0, 0, 0}, -1}));
}

TYPED_TEST(SphereSphere, nan_is_no_contact) {
  using S = TypeParam;
  for (const Sphere<S>& bad : {Sphere<S>{{nan<S>(), 0, 0}, 1}, Sphere<S>{{0, 0, 0}, nan<S>()}}) {
    EXPECT_FALSE(overlaps(this->ball, bad));
    EXPECT_FALSE(overlaps(bad, this->ball));
    EXPECT_FALSE(contact(this->ball, bad).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-4, 0, 0}, {1, 0, 0}}, bad).has_value());
    EXPECT_NE(separation(this->ball, bad).distance, separation(this->ball, bad).distance);
  }
}

}  // namespace
}  // namespace thinwall::testing
