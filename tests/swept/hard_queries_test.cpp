/// Queries that once got a wrong answer, found by feeding raw numbers to every pair.

#include <gtest/gtest.h>

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {
namespace {

using V = Vec3<double>;

TEST(HardQueries, nothing_overlaps_from_far_away_however_coarse_the_times) {
  const Moving capsule{Capsule<double>{V(-0.8, -0.8, -0.8), V(-0.6, -0.8, -0.8), 0.8}, V(4, 2, 3)};
  const Moving sphere{Sphere<double>{V(10.2, -0x1p+57, 2.1), 1.2}, V(-7, 0x1p+57, 0.09)};
  const auto toi = time_of_impact(capsule, sphere);
  EXPECT_NE(toi.status, ToiStatus::overlapping);
  EXPECT_GT(toi.time, 0.999);
}

TEST(HardQueries, small_triangle_and_far_sphere) {
  using F = Vec3<float>;
  const Triangle<float> triangle{F(-0x1.99999ap-1F, -0x1.266666p+2F, -0x1.99999ap-1F),
                                 F(0x1.99999ap-1F, -0x1.99999ap-1F, 0x1.4p+2F), F(0x1.266666p+2F, -1, -0x1.acccccp+2F)};
  const Sphere<float> sphere{F(-0x1.7ffff8p+1F, 0x1p+53F, -4), 0x1.99999ap-1F};
  const auto apart = separation(triangle, sphere);
  EXPECT_FLOAT_EQ(apart.distance, 0x1p+53F);
  EXPECT_FLOAT_EQ(apart.normal[1], 1);
}

TEST(HardQueries, far_path_at_any_scale_gives_the_same_bits) {
  const Moving triangle{Triangle<double>{V(2, -5, 4), V(-4, -0x1p-24, 1.456), V(-7, -3.818, -32)},
                        V(-0.818, 510, 9.25)};
  const Moving sphere{Sphere<double>{V(-3.818, 512, 0), 2.5}, V(0x1p-24, -4.9, 0x1p-24)};
  const auto toi = time_of_impact(triangle, sphere);
  ASSERT_EQ(toi.status, ToiStatus::hit);
  for (const int e : {-700, -500, 500, 700})
    EXPECT_EQ(time_of_impact(scaled(triangle, e), scaled(sphere, e)).time, toi.time);
}

TEST(HardQueries, long_segment_almost_along_an_edge) {
  const Moving capsule{Capsule<double>{V(1, -0x1p+31, 0x1.fffffep-1), V(0, 2, 3), 0x1.000002p+0},
                       V(0x1.602p+2, 0x1p+30, -0x1.6cccccp+3)};
  const Moving box{Aabb<double>{V(0x1.802p+2, -2, -0x1.2cccccp+3), V(1, 3, 2)}, V(0, 0, 0)};
  const double at_50_digits = 0x1.87c07d7f53c46p-1;
  EXPECT_NEAR(time_of_impact(capsule, box).time, at_50_digits, 1e-15);
  EXPECT_NEAR(time_of_impact(capsule, Moving{to_obb(box.shape), box.displacement}).time, at_50_digits, 1e-15);
}

TEST(HardQueries, ray_from_inside_an_enormous_sphere_stays_at_its_origin) {
  using F = Vec3<float>;
  const Ray<float> ray{F(0x1.8008p-136F, -0x1.1414bp-65F, 0x1.2a85d4p-94F), F(0x1p+125F, 0, 0), 1};
  const auto hit = raycast(ray, Sphere<float>{F(0, 0x1.544214p+14F, 0), 0x1.debf28p+122F});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 0);
  EXPECT_EQ(hit->point, ray.origin);
}

}  // namespace
}  // namespace thinwall
