/// Hitscan's theory without any shot: limits that have a formula of their own.
#include <thinwall/experiments/hitscan/theory.hpp>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <thinwall/experiments/hitscan/shadow.hpp>

#include "experiments/hitscan_run.hpp"

namespace thinwall {
namespace {

TEST(HitscanShadow, of_a_straight_path_is_as_wide_as_the_ball_seen_along_it) {
  const Places level = shadow({{0, 3, 20, 3}}, 10, 2);
  ASSERT_EQ(level.size(), 1U);
  EXPECT_DOUBLE_EQ(level[0].lower, 1);
  EXPECT_DOUBLE_EQ(level[0].upper, 5);
  const Places steep = shadow({{0, 0, 20, 40}}, 10, 2);  // slope 2: 20 at the range, and sqrt(5) times as wide
  ASSERT_EQ(steep.size(), 1U);
  EXPECT_DOUBLE_EQ(steep[0].lower, 20 - 2 * std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(steep[0].upper, 20 + 2 * std::sqrt(5.0));
}

TEST(HitscanShadow, of_pieces_is_what_some_of_them_reach) {
  EXPECT_TRUE(shadow({{0, 0, 7, 0}}, 10, 2).empty());  // ends before the ball
  const Places end = shadow({{0, 0, 9, 0}}, 10, 2);    // stops on the near side of it
  ASSERT_EQ(end.size(), 1U);
  EXPECT_DOUBLE_EQ(end[0].upper, std::sqrt(3.0));
  const Places apart = shadow({{0, 0, 20, 0}, {0, 5, 20, 5}}, 10, 2);
  EXPECT_EQ(apart.size(), 2U);
  EXPECT_DOUBLE_EQ(length(apart), 8);
  const Places merged = shadow({{0, 3, 20, 3}, {0, 0, 20, 0}}, 10, 2);
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_DOUBLE_EQ(length(merged), 7);
  EXPECT_DOUBLE_EQ(length(common(apart, merged)), 4 + 2);
}

TEST(HitscanShadow, lens_has_its_limits) {
  const double pi = std::numbers::pi;
  EXPECT_EQ(lens_area(1, 2, 3), 0);
  EXPECT_DOUBLE_EQ(lens_area(1, 2, 1), pi);
  EXPECT_DOUBLE_EQ(lens_area(2, 1, 0), pi);
  EXPECT_DOUBLE_EQ(lens_area(1, 1, 1), 2 * pi / 3 - std::sqrt(3.0) / 2);
  // A disc of radius 1 whose center is on the rim of one of radius sqrt(2) a right angle wide.
  EXPECT_NEAR(lens_area(1, std::sqrt(2.0), 1), pi / 2 + (pi / 4 * 2 - 1), 1e-14);
  EXPECT_DOUBLE_EQ(lens_area(1, 2, 2.5), lens_area(2, 1, 2.5));
}

TEST(HitscanTheory, is_a_lens_in_flat_fire) {
  for (const double radius : {0.0, 0.004, 0.02}) {
    for (const double range : {10.0, 100.0, 200.0}) {
      const HitscanCell c = some_shot(range, 1000, radius);
      const HitscanExpected e = expected_of(hitscan_ray, c);
      const double off = deflection(c);
      EXPECT_NEAR(e.missed / e.touch, flat_missed(c.target, radius, off), 1e-4) << key(c);
      EXPECT_NEAR(e.false_hits / e.reported, flat_false(c.target, radius, off), 1e-4) << key(c);
      EXPECT_NEAR(e.touch / e.reported, std::pow(reach(c) / c.target, 2), 1e-4) << key(c);
    }
  }
}

/// Down a slope of a, the ball's shadow is sqrt(1 + a^2) times as wide.
TEST(HitscanTheory, sees_how_steeply_the_bullet_comes_down) {
  const HitscanCell c = {100, 30, 0.02, 0, 0, 1.0 / 60, 0.15, 9.81, 1.25};
  const double slope = 9.81 * (100.0 / 30) / 30;
  const HitscanExpected e = expected_of(hitscan_ray, c);
  EXPECT_NEAR(e.touch / e.reported, std::pow(reach(c) / c.target, 2) * std::hypot(1, slope), 1e-3);
  EXPECT_GT(slope, 1);
}

TEST(HitscanTheory, nothing_is_wrong_where_nothing_pulls) {
  HitscanCell c = some_shot(30, 100, 0);
  c.gravity = 0;
  c.wind = 0;
  for (const HitscanRule& rule : {hitscan_ray, hitscan_ball, next_frame, swept_steps}) {
    const HitscanExpected e = expected_of(rule, c);
    EXPECT_NEAR(e.missed, 0, 1e-12) << rule.name;
    EXPECT_NEAR(e.false_hits, 0, 1e-12) << rule.name;
    EXPECT_EQ(e.path_error_most, 0) << rule.name;
  }
}

/// Seen from the start of a step the bullet falls a h^2 / 2 in it: a third of that on average, a sixth from the chord.
TEST(HitscanTheory, path_errors_without_drag_have_formulas) {
  HitscanCell c = some_shot(30, 100, 0);
  c.drag = 0;
  const double fall = 9.81 * c.step * c.step;
  const auto ray = expected_of(hitscan_ray, c), tangent = expected_of(next_frame, c),
             chord = expected_of(swept_steps, c);
  EXPECT_NEAR(ray.path_error.mean, 9.81 * 0.3 * 0.3 / 2, 1e-12);
  EXPECT_EQ(ray.path_error.sigma, 0);
  EXPECT_NEAR(tangent.path_error.mean, fall / 6, 1e-5 * fall);
  EXPECT_NEAR(tangent.path_error.sigma, fall / std::sqrt(45.0), 1e-5 * fall);
  EXPECT_NEAR(tangent.path_error_most, fall / 2, 1e-12 * fall);
  EXPECT_NEAR(chord.path_error.mean, fall / 12, 1e-5 * fall);
  EXPECT_NEAR(chord.path_error.sigma, fall / std::sqrt(720.0), 1e-5 * fall);
  EXPECT_NEAR(chord.path_error_most, fall / 8, 1e-12 * fall);
}

/// Two equal discs little apart: what the one has and the other has not is 2 / (pi R) of that distance. Wherever in a
/// step the target is: few steps are flown.
TEST(HitscanTheory, steps_miss_by_their_path_error) {
  for (const double range : {50.0, 57.0, 63.0, 77.0, 100.0}) {
    const HitscanCell c = some_shot(range, 1000, 0);
    for (const HitscanRule& rule : {next_frame, swept_steps}) {
      const HitscanExpected e = expected_of(rule, c);
      const double share = 2 / std::numbers::pi * e.path_error.mean / c.target;
      EXPECT_NEAR(e.missed / e.touch, share, 0.01 * share) << rule.name << " " << range;
      EXPECT_NEAR(e.false_hits / e.reported, share, 0.01 * share) << rule.name << " " << range;
    }
  }
}

TEST(HitscanTheory, a_point_is_reported_half_a_step_late_and_a_ball_later) {
  HitscanCell c = some_shot(100, 1000, 0);
  c.drag = 0;
  const auto point = expected_of(next_frame, c).lateness;
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->mean / c.step, 0.5, 1e-3);
  EXPECT_NEAR(point->sigma / c.step, 1 / std::sqrt(12.0), 1e-3);
  // Mean chord to the center's entry less that to the ball's, over a disc: (2 / 3) (R^3 - (R^2 - T^2)^(3/2)) / T^2 - 2 T / 3.
  c.radius = 0.1;
  const double t = c.target, r = reach(c);
  const double ahead = 2.0 / 3 * (r * r * r - std::pow(r * r - t * t, 1.5)) / (t * t) - 2.0 / 3 * t;
  EXPECT_NEAR(expected_of(next_frame, c).lateness->mean - point->mean, ahead / c.speed, 0.01 * ahead / c.speed);
  EXPECT_FALSE(expected_of(swept_steps, c).lateness);
}

TEST(HitscanTheory, finds_the_range_of_a_share) {
  const HitscanCell c = some_shot(10, 300, 0);
  for (const double share : {0.05, 0.5}) {
    const auto range = range_of_missed(c, share);
    ASSERT_TRUE(range);
    EXPECT_NEAR(flat_missed(c.target, 0, at_distance(arc_of<double>(c), *range).s), share, 1e-9);
  }
  HitscanCell weightless = c;
  weightless.gravity = 0;
  weightless.wind = 0;
  EXPECT_FALSE(range_of_missed(weightless, 0.5));
  HitscanCell slow = c;
  slow.drag = 100;  // comes to rest within 3 m, after falling little
  EXPECT_FALSE(range_of_missed(slow, 0.5));
}

}  // namespace
}  // namespace thinwall
