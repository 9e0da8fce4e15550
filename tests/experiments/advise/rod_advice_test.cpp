/// Advice on a rod that spins: the theory of docs/spinning_rod.md in a wish's own units, and what is refused.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/spinning_rod/methods.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "support/reply.hpp"

namespace thinwall {
namespace {

/// 0.6 m end to end, half a meter of core and 5 cm around, at a wall of 5 cm; a step of s m, 90 deg in it.
Wish tumbling(double s) {
  Wish wish;
  wish.cell = {.speed = 10 * s,
               .step = 0.1,
               .radius = 0.05,
               .thickness = 0.05,
               .angle_deg = 0,
               .wall = Wall::infinite,
               .wall_size = 0};
  wish.rod = TumblingRod{0.6, 900};
  return wish;
}

double chance(const Wish& wish, const std::string& method) {
  for (const Candidate& c : rod_candidates(wish))
    if (c.name == method) return c.theory(wish.cell).probability.value_or(-1);
  return -2;
}

TEST(RodAdvice, long_steps_see_the_mean_width_alone) {
  Wish wish = tumbling(2);  // 1 - (w + 2 r + 2 c / pi) / s
  const double expected = 1 - (0.15 + 1 / std::numbers::pi) / 2;
  EXPECT_NEAR(chance(wish, "end_of_step"), expected, 1e-12);
  wish.rod->spin = 0;
  EXPECT_NEAR(chance(wish, "end_of_step"), expected, 1e-12) << "spin drops out";
  wish.cell.angle_deg = 60;  // half as far along the normal
  EXPECT_NEAR(chance(wish, "end_of_step"), 1 - (0.15 + 1 / std::numbers::pi), 1e-12);
}

TEST(RodAdvice, spin_shields_on_short_steps) {
  Wish wish = tumbling(0.39);  // w + 2 r + c sin(90 deg) / 2 = 0.4
  EXPECT_EQ(chance(wish, "end_of_step"), 0);
  wish.rod->spin = 0;
  EXPECT_GT(chance(wish, "end_of_step"), 0.05);
  for (const char* method : {"linear_sweep", "speculative", "conservative_advancement", "certified"})
    EXPECT_EQ(chance(wish, method), 0) << method;
}

/// What is advised by formula is what the rod's own flights do.
TEST(RodAdvice, agrees_with_flights) {
  const Wish wish = tumbling(0.8);
  const RodFlight flight = {
      .half_length = 0.25, .radius = 0.05, .thickness = 0.05, .tilt_deg = 90, .spin_deg = 90, .step_ratio = 0.8 / 0.65};
  const std::vector<std::string> names = {"end_of_step"};
  const RodTally tally = fly(flight, rod_methods(names, {})[0], 20'000, 5);
  const double p = chance(wish, "end_of_step");
  EXPECT_NEAR(static_cast<double>(tally.tunneled) / 20'000, p, 4 * std::sqrt(p * (1 - p) / 20'000));
}

TEST(RodAdvice, steps_are_before_the_wall_and_at_it) {
  const Wish wish = tumbling(0.8);
  for (const RodStep& step : rod_steps(wish, 100, 0))
    EXPECT_EQ(time_of_impact(step.rod, step.wall).status, ToiStatus::hit);
  for (const RodStep& step : rod_steps(wish, 100, 1))
    EXPECT_EQ(time_of_impact(step.rod, step.wall).status, ToiStatus::apart);
}

/// [s] A longest step does at any spin, and at the spin of the wish all the more.
TEST(RodAdvice, the_longest_step_is_safe_at_any_spin) {
  Wish wish = tumbling(0.8);
  wish.miss = 0.1;
  for (const Candidate& c : rod_candidates(wish)) {
    const auto longest = longest_step(wish, c.at_any_spin);
    ASSERT_TRUE(longest) << c.name;
    if (*longest == allowed_step.upper) continue;
    for (const double spin : {0.0, 300.0, 900.0, 2000.0}) {
      Wish other = wish;
      other.rod->spin = spin;
      other.cell.step = *longest;
      EXPECT_LE(chance(other, c.name), 0.1 + 1e-12) << c.name << " " << spin;
    }
  }
}

TEST(RodAdvice, is_asked_for_by_length_and_spin) {
  const Words question = {"advise", "--speed", "20", "--radius", "0.05", "--thickness", "0.05", "--fps", "10"};
  const Reply reply = call_program(joined(question, {"--length", "0.6", "--spin", "900", "--json"}));
  EXPECT_EQ(reply.status, 0) << reply.err;
  const auto json = nlohmann::json::parse(reply.out);
  EXPECT_EQ(json["length_m"], 0.6);
  EXPECT_EQ(json["spin_deg_s"], 900);
  EXPECT_NEAR(json["contact_m"], 0.15 + 1 / std::numbers::pi, 1e-12);
  EXPECT_EQ(json["methods"].size(), 8U);
  const auto refused = [&](const Words& more, const std::string& why) {
    EXPECT_EQ(refusal(call_program(joined(question, more))), why + "\n");
  };
  refused({"--spin", "3"}, "--spin: a ball looks the same however it spins; of a rod, give --length [m] too");
  refused({"--length", "0.1"},
          "--length: a rod 0.1 m long, end to end, is no longer than it is wide, 0.1 m; without --length it is a ball");
  refused({"--length", "1", "--spin", "-1"}, "--spin: '-1' is not allowed; a number >= 0 and <= 1000000000 [deg/s]");
  refused({"--length", "inf"}, "--length: 'inf' is not allowed; a number > 0 and <= 1000 [m]");
  refused({"--length", "1", "--spin", "1e6"}, "--spin 1000000: in a step of 0.1 s that is 278 turns; at most 100");
  refused({"--length", "1", "--toml", "-"},
          "--toml: thin_wall fires balls; rods are fired by thinwall run spinning_rod");
}

}  // namespace
}  // namespace thinwall
