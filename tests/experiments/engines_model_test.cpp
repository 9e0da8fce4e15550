/// The shots that engines get and the oracle's time of contact; the chance of going through, averaged over angles; and what a flight
/// is taken for, on flights made up by hand.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <thinwall/experiments/engines/model.hpp>
#include <thinwall/experiments/tunneling_theory.hpp>

namespace thinwall {
namespace {

constexpr EngineCell meter_cell = {
    .path = 1, .step = 1.0 / 60, .radius = 0.05, .thickness = 0.01, .wall_size = 250, .angle_deg = 60, .steps = 10};

TEST(EngineShots, touch_when_the_oracle_says_so) {
  const RandomStream stream = random_stream(meter_cell, 7);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const EngineShot shot = engine_shot(meter_cell, stream, i);
    EXPECT_GT(shot.contact, 0);
    EXPECT_LE(shot.contact, 2);
    const Vec3<double> at = shot.start.position + shot.contact * shot.scene.step * shot.start.velocity;
    EXPECT_NEAR(at[0], -0.5 * shot.scene.thickness - shot.scene.radius, 1e-12) << i;
    EXPECT_LT(at.tail<2>().norm() + shot.scene.radius, shot.scene.half_side);
  }
}

TEST(EngineShots, are_spread_over_the_angles_and_the_step) {
  const RandomStream stream = random_stream(meter_cell, 7);
  double angle = 0, phase = 0, steepest = 0;
  constexpr int count = 2000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const EngineShot shot = engine_shot(meter_cell, stream, i);
    const double a = std::acos(shot.start.velocity[0] / shot.start.velocity.norm()) * 180 / std::numbers::pi;
    angle += a / count;
    steepest = std::max(steepest, a);
    phase += (shot.contact - std::floor(shot.contact)) / count;
    EXPECT_NEAR(shot.start.velocity.norm(), 60, 1e-4);
  }
  EXPECT_NEAR(angle, 30, 5 * 60 / std::sqrt(12.0 * count));  // of a uniform mean
  EXPECT_NEAR(phase, 0.5, 5 / std::sqrt(12.0 * count));
  EXPECT_GT(steepest, 59);
  EXPECT_LE(steepest, 60 + 1e-4);
}

TEST(EngineShots, are_the_same_at_a_wall_of_another_width_and_others_in_another_cell) {
  EngineCell wide = meter_cell, far = meter_cell;
  wide.wall_size = 2000;
  far.path = 2;
  const EngineShot one = engine_shot(meter_cell, random_stream(meter_cell, 7), 3);
  const EngineShot other = engine_shot(wide, random_stream(wide, 7), 3);
  EXPECT_EQ(one.start.position, other.start.position);
  EXPECT_EQ(one.start.velocity, other.start.velocity);
  EXPECT_EQ(one.contact, other.contact);
  EXPECT_EQ(other.scene.half_side, 1000);
  EXPECT_NE(random_stream(meter_cell, 7).stream, random_stream(far, 7).stream);
}

/// The same by the midpoint rule, from the formula for one angle.
double average(double depth, double spacing, double angle_deg) {
  constexpr int parts = 20000;
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double a = (i + 0.5) / parts * angle_deg * std::numbers::pi / 180;
    sum += miss_probability(slab_chord(depth, 0, std::cos(a)), spacing) / parts;
  }
  return sum;
}

TEST(EngineTheory, is_the_average_over_the_angles) {
  for (const double spacing : {0.05, 0.056, 0.1, 0.11, 1.0, 10.0}) {
    for (const double angle : {1.0, 30.0, 60.0, 89.0}) {
      EXPECT_NEAR(mean_miss_probability(0.055, spacing, angle), average(0.055, spacing, angle), 1e-6)
          << spacing << " " << angle;
    }
  }
  EXPECT_EQ(mean_miss_probability(0.055, 0.11, 0), 0.5);
  EXPECT_NEAR(mean_miss_probability(0.055, 0.11, 1e-3), 0.5, 1e-9);
  EXPECT_EQ(mean_miss_probability(0.055, 0.055, 60), 0);
}

TEST(EngineTheory, counts_both_surfaces_of_what_is_never_seen_and_half_of_what_is_seen_in_time) {
  EXPECT_EQ(unseen_theory(meter_cell, 1), mean_miss_probability(0.11, 1, 60));
  EXPECT_EQ(through_theory(meter_cell, 1), mean_miss_probability(0.055, 1, 60));
  EXPECT_EQ(through_theory(meter_cell, 4), mean_miss_probability(0.055, 0.25, 60));
  EXPECT_NEAR(through_theory(meter_cell, 1, 0.01), mean_miss_probability(0.065, 1, 60), 1e-15);
  EXPECT_NEAR(unseen_theory(meter_cell, 1, 0.01), mean_miss_probability(0.13, 1, 60), 1e-15);
}

/// Head-on: contact at x = -1, half a step after the start; 2 m a step, steps of 1 s.
const EngineShot head_on_shot = {.scene = {.radius = 0.5, .thickness = 1, .half_side = 100, .step = 1},
                                 .start = {.position = {-2, 0, 0}, .velocity = {2, 0, 0}},
                                 .contact = 0.5};

/// At the end of 4 steps.
EngineTally judged(const Vec3<double>& position, const Vec3<double>& velocity) {
  EngineTally tally;
  judge(head_on_shot, {4, BallState{position, velocity}}, tally);
  EXPECT_EQ(tally.shots, 1);
  return tally;
}

double lateness(const EngineTally& tally) { return tally.lateness.mean().value(); }

TEST(EngineJudge, tells_in_front_from_within_and_beyond) {
  EXPECT_EQ(judged({6, 0, 0}, {2, 0, 0}).tunneled, 1);
  EXPECT_EQ(judged({6, 0, 0}, {2, 0, 0}).unseen, 1);
  const EngineTally pushed = judged({6.2, 0, 0}, {2, 0, 0});
  EXPECT_EQ(pushed.tunneled, 1);
  EXPECT_EQ(pushed.unseen, 0);
  EXPECT_EQ(judged({0.51, 0, 0}, {-2, 0, 0}).tunneled, 1);
  for (const double x : {-0.5, 0.0, 0.5}) EXPECT_EQ(judged({x, 0, 0}, {-2, 0, 0}).stuck, 1) << x;
  const EngineTally held = judged({-0.51, 0, 0}, {0, 1, 0});
  EXPECT_EQ(held.kept_in_front(), 1);
  EXPECT_EQ(held.turned, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judged({nan, 0, 0}, {-2, 0, 0}).lost, 1);
  EXPECT_EQ(judged({-2, 0, 0}, {-std::numeric_limits<double>::infinity(), 0, 0}).lost, 1);
}

TEST(EngineJudge, finds_no_lateness_in_an_exact_bounce) {
  const EngineTally tally = judged({-1 - 2 * 3.5, 0, 0}, {-2, 0, 0});
  EXPECT_EQ(tally.turned, 1);
  EXPECT_EQ(lateness(tally), 0);
  EXPECT_EQ(tally.energy.mean(), 1);
}

TEST(EngineJudge, finds_when_a_ball_turned_and_half_of_what_it_waited) {
  // Turned where it was at the end of the first step, half a step past contact.
  EXPECT_EQ(lateness(judged({0 - 2 * 3.0, 0, 0}, {-2, 0, 0})), 0.5);
  // Stopped at contact for the rest of the step.
  EXPECT_EQ(lateness(judged({-1 - 2 * 3.0, 0, 0}, {-2, 0, 0})), 0.25);
  // Turned a quarter of a step before contact, with half of its speed left.
  const EngineTally early = judged({-1.5 - 3.75, 3, 0}, {-1, 0, 0});
  EXPECT_EQ(lateness(early), -0.25);
  EXPECT_EQ(early.earliest, -0.25);
  EXPECT_EQ(early.latest, -0.25);
  EXPECT_EQ(early.least_energy, 0.25);
  EXPECT_EQ(early.most_energy, 0.25);
}

TEST(EngineJudge, measures_depth_at_the_ends_of_steps) {
  EngineTally tally;
  const BallState in = {{-0.75, 0, 0}, {2, 0, 0}}, out = {{-3, 0, 0}, {-2, 0, 0}};
  judge(head_on_shot, {in, out}, tally);
  EXPECT_EQ(tally.deepest, 0.25);
}

TEST(EngineJudge, adds_up) {
  EngineTally sum;
  sum += judged({-8, 0, 0}, {-2, 0, 0});
  sum += judged({-6, 0, 0}, {-2, 0, 0});
  sum += judged({6, 0, 0}, {2, 0, 0});
  EXPECT_EQ(sum.shots, 3);
  EXPECT_EQ(sum.turned, 2);
  EXPECT_EQ(sum.lateness.mean(), 0.25);
  EXPECT_EQ(sum.earliest, 0);
  EXPECT_EQ(sum.latest, 0.5);
}

}  // namespace
}  // namespace thinwall
