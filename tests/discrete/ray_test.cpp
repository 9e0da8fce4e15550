// Rays against balls and boxes, by hand.

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>
#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/triangle.hpp>

#include "support/real.hpp"

namespace thinwall::testing {
namespace {

template <class S> class Rays : public ::testing::Test {
 protected:
  const Sphere<S> ball{{0, 0, 0}, 1};
  const Aabb<S> box{{0, 0, 0}, {1, 2, 3}};

  /// Both shapes, for what must hold for either.
  template <class Check> void each_shape(const Check& check) const {
    check(ball);
    check(box);
  }
};
TYPED_TEST_SUITE(Rays, Scalars, ScalarNames);

TYPED_TEST(Rays, hit_from_outside) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    const auto hit = raycast(Ray<S>{{-5, 0, 0}, {1, 0, 0}}, shape);
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->t, S(4));
    EXPECT_EQ(hit->point, Vec3<S>(-1, 0, 0));
    EXPECT_EQ(hit->normal, Vec3<S>(-1, 0, 0));
  });
}

TYPED_TEST(Rays, t_counts_in_lengths_of_the_direction) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    EXPECT_EQ(raycast(Ray<S>{{-5, 0, 0}, {8, 0, 0}}, shape)->t, S(0.5));
    EXPECT_EQ(raycast(Ray<S>{{5, 0, 0}, {-0.5, 0, 0}}, shape)->t, S(8));
  });
}

TYPED_TEST(Rays, max_t_is_the_last_that_counts) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    EXPECT_TRUE(raycast(Ray<S>{{-5, 0, 0}, {1, 0, 0}, 4}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {1, 0, 0}, next_down(S(4))}, shape).has_value());
    EXPECT_TRUE(raycast(Ray<S>{{0, 0, 0}, {1, 0, 0}, 0}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{0, 0, 0}, {1, 0, 0}, -1}, shape).has_value());
  });
}

TYPED_TEST(Rays, a_start_inside_or_touching_hits_at_once_without_a_normal) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    for (const Vec3<S>& start : {Vec3<S>(0.25, 0, 0.5), Vec3<S>(1, 0, 0), Vec3<S>(0, 0, 0)}) {
      for (const Vec3<S>& direction : {Vec3<S>(1, 0, 0), Vec3<S>(-1, 0, 0), Vec3<S>(0, 0, 0)}) {
        const auto hit = raycast(Ray<S>{start, direction}, shape);
        ASSERT_TRUE(hit.has_value());
        EXPECT_EQ(hit->t, S(0));
        EXPECT_EQ(hit->point, start);
        EXPECT_EQ(hit->normal, Vec3<S>(0, 0, 0));
      }
    }
  });
}

TYPED_TEST(Rays, behind_and_beside_are_missed) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    EXPECT_FALSE(raycast(Ray<S>{{5, 0, 0}, {1, 0, 0}}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 4, 0}, {1, 0, 0}}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {0, 1, 0}}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {0, 0, 0}}, shape).has_value());  // no direction
  });
}

TYPED_TEST(Rays, a_ball_is_grazed_exactly) {
  using S = TypeParam;
  const auto hit = raycast(Ray<S>{{-4, 1, 0}, {8, 0, 0}}, this->ball);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->t, S(0.5));
  EXPECT_EQ(hit->normal, Vec3<S>(0, 1, 0));
  EXPECT_FALSE(raycast(Ray<S>{{-4, next_up(S(1)), 0}, {8, 0, 0}}, this->ball).has_value());
  EXPECT_TRUE(raycast(Ray<S>{{-4, next_down(S(1)), 0}, {8, 0, 0}}, this->ball).has_value());
}

TYPED_TEST(Rays, a_point_is_hit_only_head_on) {
  using S = TypeParam;
  const Sphere<S> point{{0, 0, 0}, 0};
  const auto hit = raycast(Ray<S>{{-2, -4, -6}, {1, 2, 3}}, point);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->t, S(2));
  EXPECT_FALSE(raycast(Ray<S>{{-2, -4, next_up(S(6))}, {1, 2, -3}}, point).has_value());
  EXPECT_TRUE(raycast(Ray<S>{{-2, -4, -6}, {1, 2, 3}}, Aabb<S>{{0, 0, 0}, {0, 0, 0}}).has_value());
}

TYPED_TEST(Rays, a_point_of_a_turned_box_is_hit_at_every_size) {
  using S = TypeParam;
  Mat3<S> turn;
  turn << S(0.8), S(-0.6), 0, S(0.6), S(0.8), 0, 0, 0, 1;
  const Obb<S> point{{0, 0, 0}, {0, 0, 0}, turn};
  const auto here = raycast(Ray<S>{{0, -8, 0}, {0, 8, 0}}, point);
  ASSERT_TRUE(here.has_value());
  EXPECT_EQ(here->t, S(1));
  const int least = std::max(-20'000, std::numeric_limits<S>::min_exponent - std::numeric_limits<S>::digits);
  for (int e = least; e < 0; e += 7) {
    const auto hit = raycast(Ray<S>{{0, -power<S>(e + 3), 0}, {0, power<S>(e + 3), 0}}, point);
    ASSERT_TRUE(hit.has_value()) << e;
    EXPECT_EQ(hit->t, here->t) << e;
    EXPECT_EQ(hit->normal, here->normal) << e;
  }
}

TYPED_TEST(Rays, parallel_to_a_slab) {
  using S = TypeParam;
  EXPECT_TRUE(raycast(Ray<S>{{-5, 2, 0}, {1, 0, 0}}, this->box).has_value());   // along the face: closed
  EXPECT_TRUE(raycast(Ray<S>{{-5, -2, 3}, {1, 0, 0}}, this->box).has_value());  // along the edge
  EXPECT_FALSE(raycast(Ray<S>{{-5, next_up(S(2)), 0}, {1, 0, 0}}, this->box).has_value());
  EXPECT_FALSE(raycast(Ray<S>{{-5, 0, -next_up(S(3))}, {1, 0, 0}}, this->box).has_value());
  EXPECT_TRUE(raycast(Ray<S>{{-5, S(-S(0)), 0}, {1, S(-S(0)), 0}}, this->box).has_value());  // negative zeros
}

TYPED_TEST(Rays, through_an_edge_and_a_corner) {
  using S = TypeParam;
  const auto edge = raycast(Ray<S>{{-3, 0, 0}, {1, 1, 0}}, this->box);
  ASSERT_TRUE(edge.has_value());
  EXPECT_EQ(edge->t, S(2));
  const auto corner = raycast(Ray<S>{{-3, -4, 5}, {2, 2, -2}}, this->box);  // meets (-1, -2, 3) and goes in
  ASSERT_TRUE(corner.has_value());
  EXPECT_EQ(corner->t, S(1));
  EXPECT_EQ(corner->point, Vec3<S>(-1, -2, 3));
  EXPECT_TRUE(raycast(Ray<S>{{-2, 1, 0}, {1, 1, 0}}, this->box).has_value());  // grazes the edge at (-1, 2)
  EXPECT_FALSE(raycast(Ray<S>{{-2, next_up(S(1)), 0}, {1, 1, 0}}, this->box).has_value());
}

TYPED_TEST(Rays, a_plate_is_hit_on_either_side) {
  using S = TypeParam;
  const Aabb<S> plate{{1, 0, 0}, {0, 8, 8}};
  EXPECT_EQ(raycast(Ray<S>{{0, 0, 0}, {2, 0, 0}}, plate)->t, S(0.5));
  EXPECT_EQ(raycast(Ray<S>{{0, 0, 0}, {2, 0, 0}}, plate)->normal, Vec3<S>(-1, 0, 0));
  EXPECT_EQ(raycast(Ray<S>{{2, 0, 0}, {-2, 0, 0}}, plate)->normal, Vec3<S>(1, 0, 0));
  EXPECT_TRUE(raycast(Ray<S>{{1, -10, 0}, {0, 1, 0}}, plate).has_value());  // within its plane
  EXPECT_TRUE(raycast(Ray<S>{{0, S(1) / S(3), 0}, {S(1) / S(7), S(1) / S(11), 0}}, plate).has_value());  // inexact
}

TYPED_TEST(Rays, a_plate_is_met_on_its_edge_however_late_the_ray_ends) {
  using S = TypeParam;
  const Triangle<S> plate{{-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}};
  for (int exponent = 0; exponent < std::numeric_limits<S>::max_exponent && exponent < 20000; exponent += 7) {
    const auto hit = raycast(Ray<S>{{S(0.5), S(0.5), -5}, {0, 0, 8}, power<S>(exponent)}, plate);
    ASSERT_TRUE(hit.has_value()) << exponent;
    EXPECT_EQ(hit->t, S(0.625));
  }
}

TYPED_TEST(Rays, not_a_number) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    EXPECT_FALSE(raycast(Ray<S>{{nan<S>(), 0, 0}, {1, 0, 0}}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {1, nan<S>(), 0}}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {1, 0, 0}, nan<S>()}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {infinity<S>(), 0, 0}}, shape).has_value());
  });
}

}  // namespace
}  // namespace thinwall::testing
