// What the fuzz target found in the closed forms, each input reduced. Expected times are those of the oracle at 50 digits.

#include <cmath>

#include <gtest/gtest.h>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall::testing {
namespace {

/// Contact at the end of a step is not contact at its start.
TEST(Fuzzed, point_capsule_meets_a_point_box_at_the_end) {
  const Moving capsule{Capsule<double>{{0, 0, 0}, {0, 0, 0}, 0}, {0, 0.8, 0}};
  const auto toi = time_of_impact(capsule, at_rest(Aabb<double>{{0, 0.8, 0}, {0, 0, 0}}));
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_EQ(toi.time, 1);
}
TEST(Fuzzed, tiny_capsule_is_met_at_the_end) {
  const auto capsule = at_rest(Capsule<double>{{0x1p-50, 0, 0}, {0, 0, 0}, 0});
  const auto toi = time_of_impact(capsule, Moving{Sphere<double>{{0x1p-50, 8, 256}, 0}, {-0x1p-50, -8, -256}});
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_NEAR(toi.time, 1, 0x1p-52);
}
TEST(Fuzzed, sphere_from_far_off_does_not_overlap_a_capsule_at_the_start) {
  const Moving capsule{Capsule<float>{{-0.8F, -0.8F, -0.8F}, {-0.6F, -0.8F, -0.8F}, 0.8F}, {4, 2, 3}};
  const Moving sphere{Sphere<float>{{0x1.466666p+3F, -0x1p+57F, 0x1.0ea43p+1F}, 1.2F}, {-7, 0x1p+57F, 0x1.5ead6p-4F}};
  EXPECT_NE(time_of_impact(capsule, sphere).status, ToiStatus::overlapping);
}

TEST(Fuzzed, triangle_and_a_far_sphere_are_a_number_apart) {
  const Triangle<float> triangle{{-0.8F, -4.6F, -0.8F}, {0.8F, -0.8F, 5}, {4.6F, -1, -6.7F}};
  const Separation<float> gap = separation(triangle, Sphere<float>{{-3, 0x1p+53F, -4}, 0.8F});
  EXPECT_NEAR(gap.distance, 0x1p+53F, 0x1p+31F);
  EXPECT_NEAR(gap.normal[1], 1, 1e-6);
}

/// A core 2^31 long that moves almost along itself.
TEST(Fuzzed, long_capsule_slides_into_a_box) {
  const Moving capsule{Capsule<double>{{1, -0x1p+31, 0x1.fffffep-1}, {0, 2, 3}, 0x1.000002p+0},
                       {0x1.602p+2, 0x1p+30, -0x1.6cccccp+3}};
  const auto box = at_rest(Aabb<double>{{0x1.802p+2, -2, -0x1.2cccccp+3}, {1, 3, 2}});
  EXPECT_NEAR(time_of_impact(capsule, box).time, 0x1.87c07d7f53c46p-1, 1e-6);
}

/// Lengths times 2^k change no bit of the time.
TEST(Fuzzed, a_path_from_far_off_scales) {
  const Moving triangle{Triangle<double>{{2, -5, 4}, {-4, -0x1p-24, 0x1.7544dp-3}, {-7, -0x1.e8abb3p+1, -32}},
                        {-0x1.a2aec9ffffffcp-1, 0x1.fe0a0c1144444p+8, 0x1.28b8f9b555555p+3}};
  const Moving sphere{Sphere<double>{{-0x1.e8abb2fffffffp+1, 512, 0}, 2.5}, {0x1p-24, -0x1.399999999999ap+2, 0x1p-24}};
  EXPECT_EQ(time_of_impact(scaled(triangle, 700), scaled(sphere, 700)).time, time_of_impact(triangle, sphere).time);
}

}  // namespace
}  // namespace thinwall::testing
