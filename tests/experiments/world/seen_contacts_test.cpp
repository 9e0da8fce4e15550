// What a world sees does not depend on what it does about it: every pair at the time that a sheet of paper gives.

#include <cmath>
#include <map>
#include <optional>

#include <gtest/gtest.h>

#include "experiments/world/random_world.hpp"

namespace thinwall::testing {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double dt = 0.02;
constexpr int steps = 5, substeps = 4;
enum class Motion { fixed, driven, free };
constexpr const char* motion_names[] = {"static", "driven", "free"};

Body ball(std::uint32_t id, Motion motion, const Vec3<double>& place, const Vec3<double>& velocity) {
  Body body;
  body.id = id;
  body.shape = Sphere<double>{place, 0.125};
  body.velocity = velocity;
  body.restitution = 1;
  body.is_static = motion == Motion::fixed;
  if (motion != Motion::free) body.mass = infinite;
  return body;
}

/// Two balls on the x axis, as far as `gap` [m] from center to center, that close it at `speed` [m/s].
struct Encounter {
  Motion first, second;
  double gap, speed;
  std::vector<Body> bodies() const {
    const double first_speed = second == Motion::fixed ? speed : first == Motion::fixed ? 0 : speed / 4;
    return {ball(1, first, {-gap / 2, 0, 0}, {first_speed, 0, 0}),
            ball(2, second, {gap / 2, 0, 0}, {first_speed - speed, 0, 0})};
  }
  std::string text() const {
    return std::string(motion_names[static_cast<int>(first)]) + " and " + motion_names[static_cast<int>(second)] +
           " at " + std::to_string(speed) + " m/s";
  }
  /// [s] When the two first touch on their straight paths.
  double touch() const { return (gap - 0.25) / speed; }
  /// [s] The first of the poses at which they touch or overlap, if there is one.
  std::optional<double> first_pose(double part) const {
    for (int k = 1; k * part <= steps * dt; ++k) {
      if (std::abs(gap - speed * k * part) <= 0.25) return k * part;
    }
    return std::nullopt;
  }
  std::optional<double> seen_by(TimePolicy policy) const {
    if (policy == TimePolicy::discrete) return first_pose(dt);
    if (policy == TimePolicy::substeps) return first_pose(dt / substeps);
    return touch() <= steps * dt ? std::optional(touch()) : std::nullopt;
  }
};

std::vector<Encounter> encounters() {
  std::vector<Encounter> all;
  for (const Motion first : {Motion::fixed, Motion::driven, Motion::free}) {
    for (const Motion second : {Motion::fixed, Motion::driven, Motion::free}) {
      if (first == Motion::fixed && second == Motion::fixed) continue;
      for (const double speed : {11.0, 150.0, 1000.0}) all.push_back({first, second, 0.9375, speed});
      all.push_back({first, second, 15.0, 1000.0});
    }
  }
  return all;
}

TEST(SeenContacts, are_told_at_their_time_whatever_follows_from_them) {
  for (const TimePolicy policy : all_policies) {
    for (const Encounter& encounter : encounters()) {
      for (const bool response : {true, false}) {
        for (const bool full_plan : {true, false}) {
          const WorldOptions options = {
              .policy = policy, .substeps = substeps, .response = response, .full_plan = full_plan};
          World world(encounter.bodies(), options);
          std::optional<double> seen;
          for (int step = 0; step < steps; ++step) {
            world.step(dt);
            if (!world.hits().empty() && !seen) seen = world.hits().front().time;
          }
          const std::string where = std::string(name_of(policy)) + ": " + encounter.text() +
                                    (response ? ", response" : "") + (full_plan ? ", full plan" : "");
          const std::optional<double> expected = encounter.seen_by(policy);
          ASSERT_EQ(seen.has_value(), expected.has_value()) << where;
          if (expected) {
            EXPECT_NEAR(*seen, *expected, 1e-15) << where;
          }
        }
      }
    }
  }
}

/// The same pairs in one world, on lines of their own: what a plan leaves out is none of them.
TEST(SeenContacts, are_the_same_with_and_without_a_plan_and_an_answer) {
  std::vector<Body> bodies;
  std::map<std::uint32_t, double> expected;  // by the id of the first of a pair
  double height = 0;
  for (const Encounter& encounter : encounters()) {
    for (Body body : encounter.bodies()) {
      body.id += 2 * static_cast<std::uint32_t>(expected.size());
      std::get<Sphere<double>>(body.shape).center.y() = height;
      bodies.push_back(body);
    }
    height += 1;
    expected[bodies[bodies.size() - 2].id] = encounter.touch();
  }
  for (const TimePolicy policy : swept_policies) {
    for (const bool response : {true, false}) {
      for (const bool full_plan : {true, false}) {
        const WorldOptions options = {.policy = policy, .response = response, .full_plan = full_plan};
        World world(bodies, options);
        world.step(steps * dt);
        std::map<std::uint32_t, double> seen;
        for (const Hit& hit : world.hits()) {
          EXPECT_EQ(hit.second, hit.first + 1);
          EXPECT_TRUE(seen.emplace(hit.first, hit.time).second) << hit.first << " is told twice";
        }
        ASSERT_EQ(seen.size(), expected.size());
        for (const auto& [first, time] : expected) EXPECT_NEAR(seen.at(first), time, 1e-15) << first;
      }
    }
  }
}

/// It is stopped by a post at 0.0875 s; what nothing stops comes by at 0.38 s, and is gone at the end of the step.
TEST(SeenContacts, of_a_body_that_waits_are_told_too) {
  const Body post = ball(3, Motion::fixed, {1.125, 0, 0}, {0, 0, 0});
  for (const TimePolicy policy : swept_policies) {
    const WorldOptions options = {.policy = policy, .max_events = 1};
    World world(
        {ball(1, Motion::free, {0, 0, 0}, {10, 0, 0}), ball(2, Motion::driven, {0.725, -4, 0}, {0, 10, 0}), post},
        options);
    world.step(1);
    ASSERT_EQ(world.hits().size(), 2U) << name_of(policy);
    EXPECT_NEAR(world.hits()[0].time, 0.0875, 1e-15);
    EXPECT_EQ(world.hits()[1].second, 2U);
    EXPECT_NEAR(world.hits()[1].time, 0.38, 1e-15);  // 0.15 m beside its center: 0.2 m before it
    EXPECT_EQ(world.report().impulses, 1U) << "it waits: what passes gives it none before the next step";
  }
}

/// The bounce off the first must not hide the second, which it no longer approaches.
TEST(SeenContacts, of_one_instant_are_all_told) {
  for (const TimePolicy policy : swept_policies) {
    std::vector<Body> bodies = {ball(3, Motion::free, {0, 1.125, 0}, {0, -2, 0})};
    for (const std::uint32_t id : {1U, 2U, 4U}) {  // of a floor
      Body tile = ball(id, Motion::fixed, {0, 0, 0}, {0, 0, 0});
      tile.shape = Aabb<double>{{id == 1 ? -1.0 : id == 2 ? 1.0 : 0.0, -1, id == 4 ? -2.0 : 0.0}, {1, 1, 1}};
      bodies.push_back(tile);
    }
    World world(bodies, {.policy = policy});
    world.step(1);
    ASSERT_EQ(world.hits().size(), 2U) << name_of(policy);
    for (const Hit& hit : world.hits()) EXPECT_EQ(hit.time, 0.5);
    EXPECT_EQ(world.report().impulses, 1U);
  }
}

}  // namespace
}  // namespace thinwall::testing
