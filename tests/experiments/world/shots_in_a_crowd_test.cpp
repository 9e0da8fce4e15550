// The shots of thin_wall in a world: balls at a thin wall, at random speed, angle and phase. Among ten thousand other bodies
// each ends where it ends alone, to the bit, and as many go through unseen as theory says.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "experiments/world/random_world.hpp"

namespace thinwall::testing {
namespace {

constexpr std::uint32_t shot_count = 400, crowd_count = 10'000;
constexpr double lane_width = 50, thickness = 0.01, radius = 0.05, dt = 0.01;  // [m], [s]
constexpr int steps = 8;

struct Lane {
  std::vector<Body> bodies;  ///< the wall, then the ball
  double chance = 0;         ///< [1] that a look at the end of each step misses the wall
};

/// The ball begins somewhere on the way of one step, a few steps before the wall at x = 0.
Lane drawn_lane(std::uint32_t k) {
  WorldDraw draw(1000 + k);
  const double speed = draw.in(5, 100), angle = draw.in(0, 1), phase = draw.in(0, 1), y = lane_width * k;
  const double across = speed * std::cos(angle) * dt;
  const Aabb<double> wall{{0, y, 0}, {thickness / 2, lane_width / 2 - 1, 10}};
  const Sphere<double> ball{{-(2 + phase) * across - radius - thickness / 2, y, 0}, radius};
  const Vec3<double> velocity = {speed * std::cos(angle), speed * std::sin(angle), 0};
  return {.bodies = {{.id = 2 * k, .name = {}, .shape = wall, .is_static = true},
                     {.id = 2 * k + 1, .name = {}, .shape = ball, .velocity = velocity}},
          .chance = std::max(0.0, 1 - (thickness + 2 * radius) / across)};
}

/// Bodies of every shape that meet each other, and no lane.
std::vector<Body> drawn_crowd() {
  WorldDraw draw(7);
  std::vector<Body> crowd(crowd_count);
  for (std::uint32_t i = 0; i < crowd_count; ++i) {
    const Vec3<double> place = draw.vector(15, false) + Vec3<double>(0, 0, 1000);
    crowd[i].id = 2 * shot_count + i;
    crowd[i].shape = drawn_shape(draw, 5, place, false);
    crowd[i].velocity = draw.vector(5, false);
  }
  return crowd;
}

World stepped(std::vector<Body> bodies, TimePolicy policy, std::vector<bool>& seen) {
  World world(std::move(bodies), {.policy = policy, .substeps = 3, .response = false});
  for (int step = 0; step < steps; ++step) {
    world.step(dt);
    for (const Hit& hit : world.hits()) {
      if (hit.second < 2 * shot_count) seen[hit.second / 2] = true;
    }
  }
  return world;
}

class ShotsInACrowd : public ::testing::TestWithParam<TimePolicy> {};

TEST_P(ShotsInACrowd, go_through_exactly_as_alone) {
  std::vector<Body> together = drawn_crowd();
  std::vector<bool> seen_alone(shot_count), seen_together(shot_count);
  std::vector<Vec3<double>> ends;
  double expected = 0, variance = 0;
  for (std::uint32_t k = 0; k < shot_count; ++k) {
    const Lane lane = drawn_lane(k);
    together.insert(together.end(), lane.bodies.begin(), lane.bodies.end());
    expected += lane.chance;
    variance += lane.chance * (1 - lane.chance);
    ends.push_back(position(*stepped(lane.bodies, GetParam(), seen_alone).find(2 * k + 1)));
  }
  const World crowd = stepped(together, GetParam(), seen_together);
  EXPECT_GT(crowd.report().hits, 1000U);  // others do meet
  int missed = 0;
  for (std::uint32_t k = 0; k < shot_count; ++k) {
    EXPECT_EQ(seen_together[k], seen_alone[k]) << k;
    EXPECT_EQ(position(*crowd.find(2 * k + 1)), ends[k]) << k;
    EXPECT_GT(ends[k].x(), radius + thickness) << k;  // all have crossed
    missed += seen_alone[k] ? 0 : 1;
  }
  if (GetParam() == TimePolicy::discrete) {
    EXPECT_NEAR(missed, expected, 4 * std::sqrt(variance));
    EXPECT_GT(expected, shot_count / 4.0);
  } else if (GetParam() != TimePolicy::substeps) {
    EXPECT_EQ(missed, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(TimePolicies, ShotsInACrowd,
                         ::testing::Values(TimePolicy::discrete, TimePolicy::substeps, TimePolicy::clamp,
                                           TimePolicy::event_driven),
                         [](const auto& policy) { return std::string(name_of(policy.param)); });

}  // namespace
}  // namespace thinwall::testing
