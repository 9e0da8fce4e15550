/// One bounce at a time against the polynomial of its phase, and the formulas by which the ball flies.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/bouncing/policies.hpp>

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
              << policy.name << " " << key(cell) << " phase " << phase;
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

TEST(BounceLongRun, survives_its_line) {
  const std::vector<LongRunPoint> points = {{1, 8, 1.0 / 3, 1e-300}, {2, 8, -0.1, 0}};
  EXPECT_EQ(long_run_from_line(to_line(points)), points);
  EXPECT_EQ(long_run_from_line(to_line(std::vector<LongRunPoint>{})), std::vector<LongRunPoint>{});
  EXPECT_THROW(long_run_from_line("2 1 2"), std::runtime_error);
  EXPECT_THROW(long_run_from_line(to_line(points) + " 4"), std::runtime_error);
}

}  // namespace
}  // namespace thinwall
