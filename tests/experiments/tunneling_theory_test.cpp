#include <thinwall/experiments/tunneling_theory.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <gtest/gtest.h>

#include <thinwall/experiments/lab/random.hpp>

namespace thinwall {
namespace {

constexpr double pi = std::numbers::pi;
const RoundedBox brick = {{0.5, 1.0, 0.25}, 0.3};
const RoundedBox plate = {{0, 1.0, 0.25}, 0.3};  // no thickness
const Vec3<double> oblique = Vec3<double>(2, -3, 6) / 7;

/// How far the point is from the box itself.
double distance(const RoundedBox& box, const Vec3<double>& point) {
  return (point.cwiseAbs() - box.half_extents).cwiseMax(0.0).norm();
}

/// Where a line nearest the origin at `foot` is inside: both ends of the chord, by bisection around its closest point.
double chord(const RoundedBox& box, const Vec3<double>& foot, const Vec3<double>& direction) {
  const auto gap = [&](double t) { return distance(box, foot + t * direction) - box.radius; };
  double left = -10, right = 10;
  for (int i = 0; i < 100; ++i) {  // ternary search: the gap is convex along the line
    const double third = (right - left) / 3;
    (gap(left + third) < gap(right - third) ? right : left) += gap(left + third) < gap(right - third) ? -third : third;
  }
  const double nearest = (left + right) / 2;
  if (gap(nearest) > 0) return 0;
  const auto end = [&](double outside) {
    double inside = nearest;
    for (int i = 0; i < 60; ++i) (gap((inside + outside) / 2) <= 0 ? inside : outside) = (inside + outside) / 2;
    return inside;
  };
  return end(10) - end(-10);
}

/// Two unit vectors across the direction, turned by a radian so that a lattice of them is aligned with no face.
std::array<Vec3<double>, 2> across(const Vec3<double>& direction) {
  const Vec3<double> helper = std::abs(direction[2]) < 0.9 ? Vec3<double>(0, 0, 1) : Vec3<double>(1, 0, 0);
  const Vec3<double> u = cross<double>(direction, helper).normalized();
  const Vec3<double> v = cross<double>(direction, u);
  return {std::cos(1.0) * u + std::sin(1.0) * v, std::cos(1.0) * v - std::sin(1.0) * u};
}

/// Volume, shadow and longest chord at once, from a lattice of lines across the direction.
struct Measured {
  double volume = 0, shadow = 0, longest = 0;
};
Measured measure(const RoundedBox& box, const Vec3<double>& direction) {
  constexpr int lines = 120;
  const double reach = box.half_extents.norm() + box.radius, spacing = 2 * reach / lines;
  const auto [u, v] = across(direction);
  Measured sum;
  for (int i = 0; i < lines; ++i) {
    for (int j = 0; j < lines; ++j) {
      const double length =
          chord(box, (-reach + (i + 0.5) * spacing) * u + (-reach + (j + 0.5) * spacing) * v, direction);
      sum.volume += length * spacing * spacing;
      sum.shadow += length > 0 ? spacing * spacing : 0;
      sum.longest = std::max(sum.longest, length);
    }
  }
  return sum;
}

TEST(TunnelingTheory, misses_begin_where_the_spacing_exceeds_the_chord) {
  EXPECT_EQ(miss_probability(1, 0.5), 0);
  EXPECT_EQ(miss_probability(1, 1), 0);
  EXPECT_EQ(miss_probability(1, 4), 0.75);
  EXPECT_EQ(slab_chord(0.5, 0.25, 0.5), 2);
}

TEST(TunnelingTheory, volume_of_known_bodies) {
  EXPECT_DOUBLE_EQ(volume({{0, 0, 0}, 2}), 4 * pi / 3 * 8);
  EXPECT_DOUBLE_EQ(volume({{1, 2, 3}, 0}), 48);
  EXPECT_DOUBLE_EQ(volume({{0, 0, 3}, 2}), pi * 4 * 6 + 4 * pi / 3 * 8);  // a capsule
}

TEST(TunnelingTheory, shadow_of_known_bodies) {
  EXPECT_DOUBLE_EQ(shadow({{0, 0, 0}, 2}, oblique), pi * 4);
  EXPECT_DOUBLE_EQ(shadow({{1, 2, 3}, 0}, {1, 0, 0}), 24);
  EXPECT_DOUBLE_EQ(shadow({{1, 2, 3}, 0.5}, {0, 0, 1}), 2 * 4 + 0.5 * 12 + pi / 4);
}

TEST(TunnelingTheory, agrees_with_a_lattice_of_lines) {
  for (const RoundedBox& box : {brick, plate}) {
    for (const Vec3<double>& direction : {Vec3<double>(1, 0, 0), Vec3<double>(0.6, 0.8, 0), oblique}) {
      const Measured sum = measure(box, direction);
      EXPECT_NEAR(volume(box) / sum.volume, 1, 5e-3);
      EXPECT_NEAR(shadow(box, direction) / sum.shadow, 1, 5e-3);
      EXPECT_GE(longest_chord(box, direction), sum.longest * (1 - 1e-12));
      EXPECT_NEAR(longest_chord(box, direction) / sum.longest, 1, 1e-2);
    }
  }
}

TEST(TunnelingTheory, longest_chord_of_known_bodies) {
  EXPECT_DOUBLE_EQ(longest_chord({{0, 0, 0}, 2}, oblique), 4);
  EXPECT_DOUBLE_EQ(longest_chord(brick, {1, 0, 0}), 1.6);
  // A wide wall: every line through its middle cuts (w + 2r) / cos a.
  EXPECT_DOUBLE_EQ(longest_chord({{0.5, 50, 50}, 0.25}, {0.6, 0.8, 0}), slab_chord(1, 0.25, 0.6));
}

/// Poses at a uniform phase on lines uniform over the shadow, counted, with no formula in between.
TEST(TunnelingTheory, finite_wall_agrees_with_counting) {
  const double spacing = 2.5;
  const auto [u, v] = across(oblique);
  const double reach = brick.half_extents.norm() + brick.radius;
  std::int64_t lines = 0, missed = 0;
  for (std::uint64_t trial = 0; lines < 20000; ++trial) {
    const RandomWords words = random_words({1, 2}, trial, 0);
    const Vec3<double> foot = reach * ((2 * uniform(words[0]) - 1) * u + (2 * uniform(words[1]) - 1) * v);
    if (chord(brick, foot, oblique) <= 0) continue;
    ++lines;
    bool seen = false;
    for (int k = -4; k <= 4; ++k)
      seen |= distance(brick, foot + (k + uniform(words[2])) * spacing * oblique) <= brick.radius;
    missed += seen ? 0 : 1;
  }
  const auto theory = miss_probability(brick, oblique, spacing);
  ASSERT_TRUE(theory.has_value());
  const double n = static_cast<double>(lines);
  EXPECT_NEAR(static_cast<double>(missed) / n, *theory, 4 * std::sqrt(*theory * (1 - *theory) / n));
}

TEST(TunnelingTheory, finite_wall_is_silent_about_steps_shorter_than_its_longest_chord) {
  const double longest = longest_chord(brick, oblique);
  EXPECT_FALSE(miss_probability(brick, oblique, 0.99 * longest).has_value());
  EXPECT_TRUE(miss_probability(brick, oblique, 1.01 * longest).has_value());
  EXPECT_FALSE(center_ray_miss_probability(brick, 1.59).has_value());
}

/// A ball against a point: the ray sees nothing of positive measure, so both chances are those of a sphere and a line.
TEST(TunnelingTheory, center_ray_at_a_point_is_no_better_than_poses) {
  const RoundedBox point = {{0, 0, 0}, 1};
  EXPECT_DOUBLE_EQ(*center_ray_miss_probability(point, 4), *miss_probability(point, {1, 0, 0}, 4));
  EXPECT_DOUBLE_EQ(*center_ray_miss_probability(point, 4), 1 - 2.0 / (3 * 2));  // 1 - 2 / (3 k), k = s / 2R
  EXPECT_DOUBLE_EQ(*center_ray_miss_probability({{1, 2, 3}, 0}, 4), 0);         // a point sees all there is
}

TEST(TunnelingTheory, lateness_of_poses) {
  EXPECT_EQ(pose_lateness(1, 4).mean, 0.5);
  EXPECT_EQ(pose_lateness(1, 4).largest, 1);
  EXPECT_EQ(pose_lateness(4, 1).largest, 1);
  EXPECT_DOUBLE_EQ(pose_lateness(4, 1).deviation, 1 / std::sqrt(12.0));
}

/// The moments of min(s X, q) over a uniform X, by the midpoint rule.
TEST(TunnelingTheory, lateness_of_the_center_ray) {
  constexpr int parts = 100000;
  for (const double lead : {0.0, 0.1, 0.9, 1.5, 2.0}) {
    double mean = 0, square = 0, largest = 0;
    for (int i = 0; i < parts; ++i) {
      const double late = std::min(1.5 * (i + 0.5) / parts, lead);
      mean += late / parts;
      square += late * late / parts;
      largest = std::max(largest, late);
    }
    const Lateness theory = center_ray_lateness(lead, 1.5);
    EXPECT_NEAR(theory.mean, mean, 1e-9);
    EXPECT_NEAR(theory.deviation * theory.deviation, square - mean * mean, 1e-9);
    EXPECT_NEAR(theory.largest, largest, 1e-4);
  }
}

}  // namespace
}  // namespace thinwall
