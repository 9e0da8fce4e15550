/// What a flight is taken for, on flights made up by hand.
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include <thinwall/experiments/engines/fly.hpp>

#include "experiments/engines/engines_run.hpp"

namespace thinwall {
namespace {

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

double lateness(const EngineTally& tally) { return std::ldexp(static_cast<double>(tally.lateness), -32); }

TEST(EngineJudge, tells_in_front_from_within_and_beyond) {
  EXPECT_EQ(judged({6, 0, 0}, {2, 0, 0}).tunneled, 1);
  EXPECT_EQ(judged({6, 0, 0}, {2, 0, 0}).unseen, 1);
  const EngineTally pushed = judged({6.2, 0, 0}, {2, 0, 0});
  EXPECT_EQ(pushed.tunneled, 1);
  EXPECT_EQ(pushed.unseen, 0);
  EXPECT_EQ(judged({0.51, 0, 0}, {-2, 0, 0}).tunneled, 1);
  for (const double x : {-0.5, 0.0, 0.5}) EXPECT_EQ(judged({x, 0, 0}, {-2, 0, 0}).stuck, 1) << x;
  const EngineTally held = judged({-0.51, 0, 0}, {0, 1, 0});
  EXPECT_EQ(held.kept(), 1);
  EXPECT_EQ(held.turned, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judged({nan, 0, 0}, {-2, 0, 0}).lost, 1);
  EXPECT_EQ(judged({-2, 0, 0}, {-std::numeric_limits<double>::infinity(), 0, 0}).lost, 1);
}

TEST(EngineJudge, finds_no_lateness_in_an_exact_bounce) {
  const EngineTally tally = judged({-1 - 2 * 3.5, 0, 0}, {-2, 0, 0});
  EXPECT_EQ(tally.turned, 1);
  EXPECT_EQ(lateness(tally), 0);
  EXPECT_EQ(std::ldexp(static_cast<double>(tally.energy), -32), 1);
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

TEST(EngineTally, adds_up_and_survives_its_line) {
  EngineTally sum;
  EXPECT_EQ(to_line(engine_tally_from_line(to_line(sum))), to_line(sum));
  sum += judged({-8, 0, 0}, {-2, 0, 0});
  sum += judged({-6, 0, 0}, {-2, 0, 0});
  sum += judged({6, 0, 0}, {2, 0, 0});
  EXPECT_EQ(sum.shots, 3);
  EXPECT_EQ(sum.turned, 2);
  EXPECT_EQ(lateness(sum), 0.5);
  EXPECT_EQ(sum.earliest, 0);
  EXPECT_EQ(sum.latest, 0.5);
  sum.seconds = 1.0 / 3;
  const std::string line = to_line(sum);
  EXPECT_EQ(to_line(engine_tally_from_line(line)), line);
  EXPECT_THROW(engine_tally_from_line("1 2 3"), std::runtime_error);
  EXPECT_THROW(engine_tally_from_line(line + " 4"), std::runtime_error);
}

TEST(EngineVolleys, hold_every_shot_once) {
  std::int64_t next = 0;
  for (const EngineVolley& volley : engine_volleys(2345)) {
    EXPECT_EQ(volley.first, next);
    EXPECT_LE(volley.shots, most_shots_an_engine_volley);
    next += volley.shots;
  }
  EXPECT_EQ(next, 2345);
}

}  // namespace
}  // namespace thinwall
