/// The shots that engines get, and the oracle's time of contact.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <thinwall/experiments/engines/shots.hpp>

#include "experiments/engines/engines_run.hpp"

namespace thinwall {
namespace {

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

}  // namespace
}  // namespace thinwall
