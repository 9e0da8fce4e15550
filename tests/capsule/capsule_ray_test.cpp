// Rays against the capsule, by hand.

#include <gtest/gtest.h>
#include <thinwall/capsule/capsule.hpp>

#include "support/real.hpp"

namespace thinwall::testing {
namespace {

template <class S> class CapsuleRays : public ::testing::Test {
 protected:
  const Capsule<S> rod{{-2, 0, 0}, {2, 0, 0}, 0.5};
};
TYPED_TEST_SUITE(CapsuleRays, Scalars, ScalarNames);

TYPED_TEST(CapsuleRays, hit_the_side) {
  using S = TypeParam;
  const auto hit = raycast(Ray<S>{{1, 4, 0}, {0, -7, 0}}, this->rod);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->t, S(0.5));
  EXPECT_EQ(hit->point, Vec3<S>(1, 0.5, 0));
  EXPECT_EQ(hit->normal, Vec3<S>(0, 1, 0));
}

TYPED_TEST(CapsuleRays, parallel_to_the_axis_hits_a_cap) {
  using S = TypeParam;
  const auto middle = raycast(Ray<S>{{-5, 0, 0}, {1, 0, 0}}, this->rod);
  ASSERT_TRUE(middle.has_value());
  EXPECT_EQ(middle->t, S(2.5));
  EXPECT_EQ(middle->normal, Vec3<S>(-1, 0, 0));
  EXPECT_EQ(raycast(Ray<S>{{5, 0.5, 0}, {-1, 0, 0}}, this->rod)->t, S(3));  // grazes the side from end to end
  EXPECT_FALSE(raycast(Ray<S>{{5, next_up(S(0.5)), 0}, {-1, 0, 0}}, this->rod).has_value());
}

TYPED_TEST(CapsuleRays, inside_and_touching_hit_at_once) {
  using S = TypeParam;
  for (const Vec3<S>& start : {Vec3<S>(0, 0, 0), Vec3<S>(1, 0.25, 0), Vec3<S>(2.5, 0, 0), Vec3<S>(0, 0.5, 0)}) {
    const auto hit = raycast(Ray<S>{start, {0, 1, 0}}, this->rod);
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->t, S(0));
    EXPECT_EQ(hit->normal, Vec3<S>(0, 0, 0));
    EXPECT_EQ(hit->point, start);
  }
  EXPECT_TRUE(raycast(Ray<S>{{1, 0, 0}, {0, 0, 0}}, this->rod).has_value());
  EXPECT_FALSE(raycast(Ray<S>{{1, 1, 0}, {0, 0, 0}}, this->rod).has_value());
}

TYPED_TEST(CapsuleRays, in_the_cylinder_beyond_an_end_only_the_cap_can_be_hit) {
  using S = TypeParam;
  EXPECT_EQ(raycast(Ray<S>{{4, 0.25, 0}, {-2, 0, 0}}, this->rod)->normal[2], S(0));
  EXPECT_FALSE(raycast(Ray<S>{{4, 0.25, 0}, {0, 1, 0}}, this->rod).has_value());
  EXPECT_FALSE(raycast(Ray<S>{{4, 0, 0}, {1, 0, 0}}, this->rod).has_value());
  EXPECT_FALSE(raycast(Ray<S>{{2.5, 4, 0}, {0.125, -4, 0}}, this->rod).has_value());  // passes the cap
}

TYPED_TEST(CapsuleRays, max_t) {
  using S = TypeParam;
  EXPECT_TRUE(raycast(Ray<S>{{1, 4.5, 0}, {0, -8, 0}, 0.5}, this->rod).has_value());
  EXPECT_FALSE(raycast(Ray<S>{{1, 4.5, 0}, {0, -8, 0}, next_down(S(0.5))}, this->rod).has_value());
}

TYPED_TEST(CapsuleRays, without_length_it_is_a_ball) {
  using S = TypeParam;
  const Capsule<S> capsule{{1, 0, 0}, {1, 0, 0}, 1};
  const Sphere<S> ball{{1, 0, 0}, 1};
  const Ray<S> ray{{-4, 0.25, 0.5}, {1, 0.0625, 0}};
  ASSERT_TRUE(raycast(ray, capsule).has_value());
  EXPECT_EQ(raycast(ray, capsule)->t, raycast(ray, ball)->t);
  EXPECT_EQ(raycast(ray, capsule)->normal, raycast(ray, ball)->normal);
}

TYPED_TEST(CapsuleRays, a_start_within_a_rounding_of_the_side_is_no_miss) {
  using S = TypeParam;
  for (int i = 0; i < 200; ++i) {  // on the side of a slanted capsule, as near as the scalar can say
    const Vec3<S> axis(S(3) / S(7), S(i + 1) / S(11), S(5) / S(13));
    const Vec3<S> across = cross(axis, Vec3<S>(0, 0, 1)).normalized();
    const Capsule<S> capsule{-axis, axis, S(1) / S(3)};
    const Vec3<S> start = axis * (S(i % 9 - 4) / S(5)) + across * capsule.radius;
    const auto hit = raycast(Ray<S>{start, Vec3<S>(-across)}, capsule);
    ASSERT_TRUE(hit.has_value()) << i;
    EXPECT_TRUE(hit->t <= 64 * unit<S>() * (S(1) + axis.norm())) << i << " " << hit->t;
  }
}

}  // namespace
}  // namespace thinwall::testing
