/// Impacts that come in crowds, each against the answer that it must have: cases 56 to 62.
#include <thinwall/experiments/bouncing/scenarios.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/bouncing/impacts.hpp>
#include <thinwall/experiments/bouncing/policies.hpp>

namespace thinwall {
namespace {

void expect_all_passed(const std::vector<BounceScenario>& scenarios, std::size_t count) {
  EXPECT_EQ(scenarios.size(), count);
  for (const BounceScenario& s : scenarios) {
    EXPECT_TRUE(s.passed) << s.name << "\nmust: " << s.must << "\nhappened: " << s.happened;
  }
}

TEST(BounceScenarios, case_56_bounces_pile_up_and_end) {
  const std::vector<double> times = zeno_times();
  ASSERT_EQ(times.size(), 54U);
  EXPECT_EQ(times[0], 1);
  EXPECT_EQ(times[1], 2);
  EXPECT_EQ(times[2], 2.5);
  EXPECT_EQ(times[3], 2.75);
  EXPECT_EQ(times[52], 3 - 0x1p-51);
  EXPECT_EQ(times[53], 3);
  expect_all_passed(zeno_scenarios(), 1);
}

TEST(BounceScenarios, case_57_a_million_bounces_in_a_gap) { expect_all_passed(gap_scenarios(), 2); }

/// The wall closes by its own motion alone: with a wall that stands still, nothing would be gained.
TEST(BounceScenarios, a_closing_wall_gives_speed) {
  FlyingBall ball = {{{0, 0, 0}, 0.5}, {1, 0, 0}};
  std::vector<FlyingWall> walls = {{{{2, 0, 0}, {1, 8, 8}}, {-0.25, 0, 0}}};
  EXPECT_EQ(fly_between(ball, walls, 1), 1);
  EXPECT_EQ(ball.velocity.x(), -1.5);
  EXPECT_NEAR(walls[0].shape.center.x(), 1.75, 1e-15);
}

TEST(BounceScenarios, case_58_blocks_count_the_digits_of_pi) {
#if defined(__OPTIMIZE__) && !defined(THINWALL_SLOW_BUILD)  // all 31 million impacts: not where nothing is inlined
  constexpr int most = 7;
#else
  constexpr int most = 4;
#endif
  constexpr std::size_t in_double = most + 1, in_float = std::min(most, 5) + 1;
  expect_all_passed(digit_scenarios(most), in_double + in_float);
  EXPECT_EQ(count_block_impacts<double>(3).impacts, 3141);
  EXPECT_EQ(count_block_impacts<float>(3).impacts, 3141);
}

TEST(BounceScenarios, case_59_masses_far_apart) {
  const LineSpeeds<double> light = after_impact({1.0, 0.0}, 1.0, 1e16, 1.0);
  EXPECT_EQ(light.a, -1);
  EXPECT_EQ(light.b, 2e-16);
  const LineSpeeds<double> heavy = after_impact({1.0, 0.0}, 1e16, 1.0, 1.0);
  EXPECT_NEAR(heavy.a, 1, 0x1p-52);
  EXPECT_EQ(heavy.b, 2);
  const LineSpeeds<double> dead = after_impact({1.0, 0.0}, 1.0, 3.0, 0.0);  // stick together
  EXPECT_EQ(dead.a, 0.25);
  EXPECT_EQ(dead.b, 0.25);
  expect_all_passed(mass_scenarios({1, 1e4, 1e8, 1e12, 1e16}), 9);
}

TEST(BounceScenarios, case_60_of_a_cradle_the_last_move) { expect_all_passed(cradle_scenarios(), 3); }

TEST(BounceScenarios, case_61_walls_hit_at_once_turn_every_speed_in_any_order) {
  expect_all_passed(corner_scenarios(), 2);
}

/// Two times of impact of 0, one after the other; and then the ball parts, so that there is no third.
TEST(BounceScenarios, a_ball_that_touches_both_walls_bounces_twice_at_once) {
  FlyingBall ball = {{{0, 0, 0}, 0.5}, {1, 1, 0}};
  std::vector<FlyingWall> walls = {{{{1.5, 0, 0}, {1, 8, 8}}, {0, 0, 0}}, {{{0, 1.5, 0}, {8, 1, 8}}, {0, 0, 0}}};
  EXPECT_EQ(fly_between(ball, walls, 1), 2);
  EXPECT_EQ(ball.velocity, Vec3<double>(-1, -1, 0));
  EXPECT_EQ(ball.shape.center, Vec3<double>(-1, -1, 0));
}

TEST(BounceScenarios, case_62_a_ball_at_rest_stays) { expect_all_passed(rest_scenarios(), 5); }

/// Whatever the restitution, also where every speed comes back whole.
TEST(BounceScenarios, rest_is_rest_at_every_restitution) {
  for (const double e : {0.0, 0.5, 1.0}) {
    const BouncingWorld world = {9.81, e, 1.0 / 60, floor_of_depth(8)};
    BouncingBall linear = ball_at(0, 0, 0.1), arc = linear;
    for (int i = 0; i < 1000; ++i) {
      LinearToi::step(world, linear);
      ParabolaToi::step(world, arc);
    }
    for (const BouncingBall& ball : {linear, arc}) {
      EXPECT_EQ(gap_of(ball), 0) << e;
      EXPECT_EQ(ball.velocity, 0) << e;
      EXPECT_EQ(ball.bounces, 0) << e;
    }
  }
}

/// A ball that loses nearly all of its speed comes to rest on the arc, in finitely many bounces.
TEST(BounceScenarios, every_loss_ends_in_rest) {
  for (const double e : {0.0, 0.1, 0.9, 0.99}) {
    const BouncingWorld world = {9.81, e, 0.1, floor_of_depth(8)};
    BouncingBall ball = ball_at(0.5, 0, 0.1);
    for (int i = 0; i < 1000; ++i) ParabolaToi::step(world, ball);
    EXPECT_EQ(gap_of(ball), 0) << e;
    EXPECT_EQ(ball.velocity, 0) << e;
    EXPECT_LE(static_cast<double>(ball.bounces), e > 0 ? 2 - 60 * std::log(2) / std::log(e) : 1) << e;
  }
}

TEST(BounceScenarios, survive_their_line) {
  const std::vector<BounceScenario> scenarios = {{"a", "b c", "d", true}, {"e", "", "f, g", false}};
  EXPECT_EQ(bounce_scenarios_from_line(to_line(scenarios)), scenarios);
  EXPECT_EQ(bounce_scenarios_from_line(to_line(corner_scenarios())), corner_scenarios());
  EXPECT_THROW(bounce_scenarios_from_line("a~b~c"), std::runtime_error);
  EXPECT_THROW(bounce_scenarios_from_line("a~b~c~maybe"), std::runtime_error);
}

}  // namespace
}  // namespace thinwall
