/// One bounce at a time against the polynomial of its phase, the formulas by which the ball flies, and impacts that come in crowds, each
/// against the answer that it must have.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "experiments/bouncing_run.hpp"

namespace thinwall {
namespace {

BounceCell drop(double step, double restitution) { return {9.81, 1, 0.1, step, restitution}; }

/// Case 55. Not on average: every bounce lies on the polynomial, to rounding.
TEST(BounceTheory, every_bounce_is_what_theory_says_at_its_phase) {
  for (const BouncePolicy& policy : all_bounce_policies()) {
    for (const double step : {0.1, 1.0 / 60, 0.002}) {
      for (const double e : {0.0, 0.3, 0.9, 1.0}) {
        const BounceCell cell = drop(step, e);
        const BounceTheory theory = bounce_theory(policy.name, delta(cell), e);
        for (const double phase : {1e-6, 0.1, 0.25, 0.5, 0.77, 1 - 1e-6}) {
          ASSERT_NEAR(policy.error_at(cell, phase), theory.at(1 - 2 * phase), rounding_of(cell))
              << policy.name << " " << bounce_factors().key(cell) << " phase " << phase;
        }
      }
    }
  }
}

/// Case 55: the means in g h / V, and the deviation of the linear split.
TEST(BounceTheory, means_for_short_steps_without_loss) {
  EXPECT_EQ(bounce_theory("project_flip", 0, 1).mean(), -1);
  EXPECT_EQ(bounce_theory("flip_only", 0, 1).mean(), -2);
  EXPECT_EQ(bounce_theory("linear_toi", 0, 1).mean(), 0);
  EXPECT_EQ(bounce_theory("exact_project", 0, 1).mean(), 1);
  EXPECT_EQ(bounce_theory("parabola_toi", 0, 1).mean(), 0);
  EXPECT_NEAR(bounce_theory("linear_toi", 0, 1).sigma(), 2 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(bounce_theory("project_flip", 0, 1).rms(), 2 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(bounce_theory("linear_toi", 0.3, 1).mean(), 2 * 0.3 / 3, 1e-15);  // the split is of second order
  for (const BouncePolicy& policy : all_bounce_policies()) {
    EXPECT_EQ(bounce_theory(policy.name, 0, 1).mean(), policy.drift) << policy.name;
  }
  EXPECT_THROW(bounce_theory("none", 0, 1), std::logic_error);
}

/// Case 55: the exact arc keeps its energy.
TEST(BounceTheory, the_split_arc_keeps_its_energy) {
  const BouncePolicy arc = bounce_policy("parabola_toi");
  for (const double step : {1.0 / 15, 1.0 / 60, 1.0 / 240}) {
    for (const double phase : {0.01, 0.5, 0.99}) EXPECT_LE(std::abs(arc.error_at(drop(step, 1), phase)), 1e-11);
  }
}

TEST(BounceTheory, moments_are_those_of_a_uniform_phase) {
  const BounceTheory theory = {0.3, -1.2, 0.7};
  constexpr int count = 4000;
  double sum = 0, squares = 0, fourths = 0;
  for (int i = 0; i < count; ++i) {
    const double off = theory.at(2 * (i + 0.5) / count - 1) - theory.mean();
    sum += off;
    squares += off * off;
    fourths += off * off * off * off;
  }
  EXPECT_NEAR(sum / count, 0, 1e-6);
  EXPECT_NEAR(squares / count, theory.sigma() * theory.sigma(), 1e-6);
  EXPECT_NEAR(fourths / count / std::pow(theory.sigma(), 4), theory.kurtosis(), 1e-5);
  EXPECT_NEAR((BounceTheory{0, 1, 0}.kurtosis()), 1.8, 1e-14);
}

TEST(BounceArc, lands_where_the_quadratic_has_its_root) {
  EXPECT_EQ(landing_time(1, 0, 2), 1);
  EXPECT_EQ(landing_time(0, 3, 2), 3);
  EXPECT_EQ(landing_time(0, 0, 2), 0);
  EXPECT_EQ(landing_time(0, -3, 2), 0);
  EXPECT_EQ(landing_time(1, 1e9, 2), 1e9);
  // Where the textbook's root (speed - |velocity|) / g has no digit left: a fall of 1e-12 m at 1e8 m/s.
  EXPECT_DOUBLE_EQ(landing_time(1e-12, -1e8, 2), 1e-20);
  for (const double v : {-3.0, -0.1, 0.1, 7.0}) {
    const double t = landing_time(0.7, v, 9.81);
    EXPECT_NEAR(0.7 + t * (v - 9.81 * t / 2), 0, 1e-14) << v;
  }
}

/// A step on the arc holds as many bounces as it can, and ends on time.
TEST(BounceArc, follows_many_bounces_in_one_step) {
  const BouncingWorld world = {2, 1, 7.5, floor_of_depth(512)};  // flights of 2 s after the first impact at 1 s
  BouncingBall ball = ball_at(1, 0, 0.5);
  ParabolaToi::step(world, ball);
  EXPECT_EQ(ball.bounces, 4);  // at 1, 3, 5 and 7 s
  EXPECT_EQ(ball.time, 7.5);
  EXPECT_EQ(gap_of(ball), 0.75);  // 0.5 s after the last
  EXPECT_EQ(ball.velocity, 1);
}

TEST(BounceArc, ends_a_step_on_the_floor) {
  const BouncingWorld world = {2, 1, 1, floor_of_depth(8)};
  BouncingBall ball = ball_at(1, 0, 0.5);
  ParabolaToi::step(world, ball);
  EXPECT_EQ(gap_of(ball), 0);
  EXPECT_EQ(ball.bounces, 1);
  ParabolaToi::step(world, ball);
  EXPECT_EQ(gap_of(ball), 1);
  EXPECT_EQ(ball.bounces, 1);
}

/// Locked phases: a run of project_flip that does not start on the drop loses 1 + 1 in two bounces, whatever its phase.
TEST(BounceLongRun, two_bounces_of_project_flip_lose_twice_the_mean) {
  const BounceCell cell = drop(1.0 / 240, 1);
  const double first_speed = 1 - delta(cell), d = delta(cell);
  for (const double elapsed : {0.2, 0.4, 0.7}) {
    const std::vector<double> energies = bounce_policy("project_flip").energies(cell, elapsed, 21);
    ASSERT_EQ(energies.size(), 21U);
    for (std::size_t n = 2; n < energies.size(); n += 2) {
      EXPECT_NEAR(std::sqrt(energies[n]), std::sqrt(energies[0]) - static_cast<double>(n) * d / 2, 1e-12) << elapsed;
    }
    EXPECT_GT(std::sqrt(energies[0]), first_speed);
  }
}

// Crowds: cases 56 to 62.

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

}  // namespace
}  // namespace thinwall
