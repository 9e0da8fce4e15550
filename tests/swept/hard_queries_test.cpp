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

TEST(HardQueries, points_that_meet_at_the_end_do_not_overlap_at_the_start) {
  const Moving point{Capsule<double>{V(0, 0, 0), V(0, 0, 0), 0}, V(0, 0.8, 0)};
  const auto at_end = time_of_impact(point, at_rest(Aabb<double>{V(0, 0.8, 0), V(0, 0, 0)}));
  EXPECT_EQ(at_end.status, ToiStatus::hit);
  EXPECT_EQ(at_end.time, 1);
  const auto capsule = at_rest(Capsule<double>{V(0x1p-50, 0, 0), V(0, 0, 0), 0});
  const auto met = time_of_impact(capsule, Moving{Sphere<double>{V(0x1p-50, 8, 256), 0}, V(-0x1p-50, -8, -256)});
  EXPECT_EQ(met.status, ToiStatus::hit);
  EXPECT_NEAR(met.time, 1, 0x1p-52);
}

TEST(HardQueries, plane_of_no_contact_settles_nothing) {  // a corner without a radius, near the end of the step
  const Moving plate{Aabb<double>{V(0x1.c808a8p-2, 2, 1), V(0.8, 0, 0)},
                     V(5, -0x1.fffffffffffffp-2, -0x1.8262126666666p-1)};
  const Moving tile{Aabb<double>{V(0x1.3ecef6ccccccdp+0, 1.5, 0x1.1f677b6666668p+1), V(7, 0, 5)}, V(5, 0, -7)};
  EXPECT_EQ(time_of_impact(plate, tile).status, ToiStatus::apart);  // they would meet at 1 + 2^-52
  const Moving slab{Aabb<double>{V(-8, 0, -3), V(8, 3, 0)}, V(-256, -1, 11)};
  const auto toi = time_of_impact(slab, at_rest(Aabb<double>{V(-256, -4, 0x1.f99999999999ap+2), V(0, 0, 0.1)}));
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_EQ(toi.time, 1);
}

TEST(HardQueries, segment_in_touch_to_rounding_has_come_in) {
  using F = Vec3<float>;
  const Moving segment{Capsule<float>{F(0.5F, -0.5F, 0x1.7e77fcp-1F), F(1, 8.5F, -0x1.ef4dap-1F), 0},
                       F(0x1.3f3cp+0F, 0x1p-4F, 256)};
  const Moving triangle{Triangle<float>{F(0x1.7fd4fp-2F, 0x1.88fcc8p+1F, 0x1.f2121p-1F),
                                        F(0x1.97fd5p+2F, 0x1.50f58ep+0F, -0x1.c37b7cp+1F),
                                        F(0x1.ae729ap+1F, 0x1.846e66p+2F, 0x1.4f2122p+3F)},
                        F(0x1.f2ecp-8F, 0.5F, 0x1.800002p+1F)};
  const auto toi = time_of_impact(segment, triangle);
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_FLOAT_EQ(toi.time, 0x1.4f367063fc983p-9F);
}

TEST(HardQueries, parallel_boxes_have_a_normal) {
  Mat3<float> axes;
  axes.col(0) << 0x1.f07c2p-1F, 0x1.f07c2p-3F, 0x1.f07c2p-6F;
  axes.col(1) << -0x1.f07c2p-3F, 0x1.e0f83ep-1F, 0x1.f07c2p-3F;
  axes.col(2) << 0x1.f07c2p-6F, -0x1.f07c2p-3F, 0x1.f07c2p-1F;
  using F = Vec3<float>;
  const Moving first{Obb<float>{F(-2, -2, -2), F(2, 4, 2), axes}, F(-2, 3, -2)};
  const Moving second{Obb<float>{F(0x1.e0f84p+0F, -0x1.07c1fp+0F, -0x1.e0f83ep+0F), F(2, 2, 2), axes}, F(-2, -2, -2)};
  const auto toi = time_of_impact(first, second);  // they touch at the start, to float's rounding of the axes
  ASSERT_NE(toi.status, ToiStatus::apart);
  EXPECT_NEAR(toi.time, 0, 1e-6);
  EXPECT_NEAR(toi.normal.norm(), 1, 1e-6);
}

TEST(HardQueries, large_triangle_is_seen_from_its_nearest_corner) {
  const Moving triangle{Triangle<double>{V(-0x1p+57, 0.7, 896), V(896, -0x1p-5, 0.7), V(0, -896, 896)},
                        V(-0.8, -0.8, -0.8)};
  const Moving sphere{Sphere<double>{V(0x1.34f71d957adbep+8, -0x1.33ea38d044248p+9, -0x1.2d23585adad07p+10), 0.8},
                      V(-0.8, 28, 1792)};
  const auto toi = time_of_impact(triangle, sphere);
  ASSERT_EQ(toi.status, ToiStatus::hit);
  EXPECT_NEAR(toi.time, 0x1.ff6795830afebp-1, 1e-14);
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
