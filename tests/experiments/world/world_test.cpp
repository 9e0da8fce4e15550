// What a world does and sees, on scenes whose outcome is known; and what it refuses.

#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <tuple>

#include <gtest/gtest.h>

#include <thinwall/discrete/broad_phase/proxy.hpp>

#include "experiments/world/random_world.hpp"
#include "support/said.hpp"

namespace thinwall::testing {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Body ball(std::uint32_t id, const Vec3<double>& place, const Vec3<double>& velocity, double radius = 0.5) {
  return {.id = id, .name = {}, .shape = Sphere<double>{place, radius}, .velocity = velocity, .restitution = 1};
}

Body wall(std::uint32_t id, const Vec3<double>& place, const Vec3<double>& half) {
  return {.id = id, .name = {}, .shape = Aabb<double>{place, half}, .is_static = true};
}

double x_of(const World& world, std::uint32_t id) { return position(*world.find(id)).x(); }
double vx_of(const World& world, std::uint32_t id) { return world.find(id)->velocity.x(); }

std::string kinds(const World& world) {
  std::string text;
  for (const CollisionEvent& event : world.events().events()) text += "bse"[static_cast<int>(event.kind)];
  return text;
}

TEST(World, looks_at_the_end_of_a_step_and_lets_a_bullet_through_or_sweeps_and_does_not) {
  for (const TimePolicy policy : all_policies) {
    World world({ball(1, {0.25, 0, 0}, {100, 0, 0}, 0.01), wall(2, {5, 0, 0}, {0.001, 4, 4})}, {.policy = policy});
    world.step(0.1);
    EXPECT_EQ(x_of(world, 1) > 5, !sweeps(policy)) << name_of(policy);
    EXPECT_EQ(vx_of(world, 1), sweeps(policy) ? -100 : 100) << name_of(policy);
    EXPECT_EQ(kinds(world), sweeps(policy) ? "b" : "");
    if (!sweeps(policy)) continue;
    ASSERT_EQ(world.hits().size(), 1U);
    EXPECT_NEAR(world.hits()[0].time, (5 - 0.001 - 0.01 - 0.25) / 100, 1e-16);
    EXPECT_EQ(world.hits()[0].normal, Vec3<double>(1, 0, 0));
    const double touching = 5 - 0.001 - 0.01, way_back = 10 - (touching - 0.25);
    EXPECT_NEAR(x_of(world, 1), policy == TimePolicy::clamp ? touching : touching - way_back, 1e-14);
  }
}

TEST(World, substeps_catch_what_their_poses_catch) {
  const WorldOptions options = {.policy = TimePolicy::substeps, .substeps = 4};  // poses at x = 2.5, 5, ...
  World world({ball(1, {0, 0, 0}, {100, 0, 0}, 0.01), wall(2, {5.005, 0, 0}, {0.001, 4, 4})}, options);
  world.step(0.1);
  EXPECT_LT(vx_of(world, 1), 0);
  ASSERT_EQ(world.hits().size(), 1U);
  EXPECT_EQ(world.hits()[0].time, 0.05);
}

TEST(World, masses_of_one_to_ten_to_the_sixteen_bounce_without_loss) {
  Body heavy = ball(2, {4, 0, 0}, {0, 0, 0});
  heavy.mass = 1e16;
  World world({ball(1, {0, 0, 0}, {1, 0, 0}), heavy}, {.policy = TimePolicy::event_driven});
  world.step(4);
  EXPECT_EQ(vx_of(world, 1), -1);
  EXPECT_EQ(vx_of(world, 2), 2e-16);
  World equal({ball(1, {-100, 0, 0}, {1000, 0, 0}), ball(2, {60, 0, 0}, {-600, 0, 0})}, {.policy = TimePolicy::clamp});
  equal.step(1);
  EXPECT_EQ(vx_of(equal, 1), -600);
  EXPECT_EQ(vx_of(equal, 2), 1000);
}

TEST(World, only_the_last_ball_of_a_cradle_leaves) {
  std::vector<Body> bodies;
  for (std::uint32_t id = 1; id <= 5; ++id) bodies.push_back(ball(id, {id * 1.0, 0, 0}, {0, 0, 0}));
  bodies.push_back(ball(0, {-3, 0, 0}, {8, 0, 0}));
  World world(bodies, {.policy = TimePolicy::event_driven});
  world.step(1);
  for (std::uint32_t id = 0; id < 5; ++id) EXPECT_EQ(vx_of(world, id), 0) << id;
  EXPECT_EQ(vx_of(world, 5), 8);
}

TEST(World, a_ball_between_two_walls_bounces_within_one_step_and_never_leaves) {
  WorldOptions options = {.policy = TimePolicy::event_driven, .max_events = 1000};
  World world({wall(1, {-2, 0, 0}, {1, 1, 1}), wall(2, {2, 0, 0}, {1, 1, 1}), ball(3, {0.25, 0, 0}, {64, 0, 0}, 0.5)},
              options);
  world.step(1);  // 64 m in a gap of 1 m
  EXPECT_EQ(world.report().impulses, 64);
  EXPECT_EQ(x_of(world, 3), 0.25);  // an even number of walls: back on the same course
  EXPECT_EQ(vx_of(world, 3), 64);
  EXPECT_EQ(world.report().waiting, 0);
  options.max_events = 5;  // bounded: it waits at the last wall, and goes on in the next step
  World bounded({wall(1, {-2, 0, 0}, {1, 1, 1}), wall(2, {2, 0, 0}, {1, 1, 1}), ball(3, {0.25, 0, 0}, {64, 0, 0}, 0.5)},
                options);
  bounded.step(1);
  EXPECT_EQ(bounded.report().impulses, 5);
  EXPECT_EQ(bounded.report().waiting, 1);
  EXPECT_EQ(x_of(bounded, 3), 0.5);
  EXPECT_EQ(vx_of(bounded, 3), -64);
}

TEST(World, two_walls_hit_at_once_turn_both_components) {
  World world({wall(1, {3, 0, 0}, {1, 9, 9}), wall(2, {0, 3, 0}, {9, 1, 9}), ball(3, {0, 0, 0}, {6, 6, 0}, 0.5)},
              {.policy = TimePolicy::event_driven});
  world.step(0.5);
  EXPECT_EQ(world.find(3)->velocity, Vec3<double>(-6, -6, 0));
}

TEST(World, a_body_at_rest_stays_where_it_is) {
  for (const TimePolicy policy : all_policies) {
    Body rests = ball(1, {0, 0.5, 0}, {0, 0, 0});
    rests.restitution = 0;
    World world({rests, wall(2, {0, -1, 0}, {5, 1, 5})}, {.gravity = {0, -9.81, 0}, .policy = policy});
    for (int k = 0; k < 3000; ++k) world.step(1.0 / 60);
    const double y = position(*world.find(1)).y();
    EXPECT_LE(std::abs(y - 0.5), sweeps(policy) ? 0 : 1e-15) << name_of(policy);
    EXPECT_EQ(kinds(world), "s");
    EXPECT_EQ(world.events().live(), 1U);
  }
}

TEST(World, a_clamped_body_slides_on_what_it_rests_on) {
  Body slides = ball(1, {0, 0.5, 0}, {3, 0, 0});
  slides.restitution = 0;
  World world({slides, wall(2, {0, -1, 0}, {50, 1, 5})}, {.gravity = {0, -8, 0}, .policy = TimePolicy::clamp});
  for (int k = 0; k < 8; ++k) world.step(0.125);
  EXPECT_EQ(x_of(world, 1), 3);
}

/// [m] Boxes of a cubic meter on a floor, one on the other, all at `velocity` along x; the top one of mass `top`.
std::vector<Body> stack(std::uint32_t boxes, double velocity, double top = 1) {
  std::vector<Body> bodies = {wall(1, {0, -0.5, 0}, {20, 0.5, 20})};
  for (std::uint32_t k = 0; k < boxes; ++k) {
    Body box = wall(k + 2, {0, 0.5 + k, 0}, {0.5, 0.5, 0.5});
    box.is_static = false;
    box.velocity = {velocity, 0, 0};
    bodies.push_back(box);
  }
  bodies.back().mass = top;
  return bodies;
}

/// A tower is as soft as its contact rounds are few; it slides whatever they are.
TEST(World, what_rests_on_what_rests_is_free_to_slide) {
  for (const TimePolicy policy : {TimePolicy::clamp, TimePolicy::event_driven}) {
    for (const auto& [boxes, rounds, soft] : {std::tuple(2U, 8, 1e-4), {3U, 8, 0.01}, {8U, 256, 1e-4}}) {
      World world(stack(boxes, 2), {.gravity = {0, -10, 0}, .policy = policy, .contact_rounds = rounds});
      const double before = world.energy();
      for (int k = 0; k < 60; ++k) world.step(1.0 / 60);
      for (std::uint32_t k = 0; k < boxes; ++k) {
        EXPECT_NEAR(x_of(world, k + 2), 2, 1e-12) << name_of(policy) << " " << boxes << " " << k;
        EXPECT_NEAR(position(*world.find(k + 2)).y(), 0.5 + k, soft) << name_of(policy) << " " << boxes << " " << k;
      }
      EXPECT_LE(world.energy(), before * (1 + 1e-12)) << name_of(policy) << " " << boxes;
    }
  }
}

/// A thousand kilograms on one: more than the impulses of a step can carry.
TEST(World, what_cannot_move_gains_no_speed) {
  for (const TimePolicy policy : {TimePolicy::clamp, TimePolicy::event_driven}) {
    World world(stack(2, 0, 1000), {.gravity = {0, -10, 0}, .policy = policy});
    const double before = world.energy();
    for (int k = 0; k < 300; ++k) world.step(1.0 / 60);
    EXPECT_LE(world.energy(), before * (1 + 1e-3)) << name_of(policy);
    EXPECT_NEAR(position(*world.find(3)).y(), 1.5, 0.1) << name_of(policy);
  }
}

TEST(World, the_larger_restitution_counts_and_a_fall_bounces_to_its_square) {
  Body drops = ball(1, {0, 1.5, 0}, {0, 0, 0});
  drops.restitution = 0.25;
  Body floor = wall(2, {0, -1, 0}, {5, 1, 5});
  floor.restitution = 0.5;
  World world({drops, floor}, {.gravity = {0, -10, 0}, .policy = TimePolicy::event_driven});
  double highest = 0;
  bool has_bounced = false;
  for (int k = 0; k < 9000; ++k) {
    world.step(1e-4);
    has_bounced = has_bounced || !world.hits().empty();
    if (has_bounced) highest = std::max(highest, position(*world.find(1)).y() - 0.5);
  }
  EXPECT_NEAR(highest, 0.25, 1e-3);
}

TEST(World, energy_and_momentum_stay_where_nothing_is_lost) {
  std::vector<Body> bodies;
  for (std::uint32_t id = 0; id < 27; ++id) {
    const double x = id % 3, y = id / 3 % 3, z = id / 9;  // NOLINT(bugprone-integer-division): places on a lattice
    bodies.push_back(ball(id, {2 * x, 2 * y, 2 * z}, {7 - 5 * y, 3 * z - 2 * x, 4 * x - 3}, 0.4));
    bodies.back().mass = 1 + id % 4;
  }
  World world(bodies, {.policy = TimePolicy::event_driven, .max_events = 100});
  const double before = world.energy();
  const auto momentum = [&] {
    Vec3<double> sum = Vec3<double>::Zero();
    for (const Body& body : world.bodies()) sum += body.velocity * body.mass;
    return sum;
  };
  const Vec3<double> start = momentum();
  std::int64_t impulses = 0;
  for (int k = 0; k < 20; ++k) impulses += world.step(0.1).impulses;
  EXPECT_GT(impulses, 5);
  EXPECT_NEAR(world.energy() / before, 1, 1e-13);
  EXPECT_LT((momentum() - start).norm(), 1e-11);
}

TEST(World, overlapping_and_nested_bodies_are_in_contact_at_once_and_are_parted) {
  for (const TimePolicy policy : all_policies) {
    World world({ball(1, {0, 0, 0}, {0, 0, 0}), ball(2, {0, 0, 0}, {0, 0, 0}, 0.1), ball(3, {0.9, 0, 0}, {0, 0, 0})},
                {.policy = policy});
    world.step(0.01);
    EXPECT_EQ(kinds(world).substr(0, 2), "bb") << name_of(policy);
    for (int k = 0; k < 40; ++k) world.step(0.01);
    EXPECT_LE(x_of(world, 1) + 0.6, x_of(world, 2) + 1e-9) << name_of(policy);  // coincident centers part along +x
  }
}

TEST(World, what_has_no_finite_mass_moves_on_whatever_it_meets) {
  Body piston = ball(1, {0, 0, 0}, {10, 0, 0});
  piston.mass = infinite;
  Body pushed = ball(2, {5, 0, 0}, {0, 0, 0});
  pushed.gravity_scale = 0;
  World world({piston, pushed}, {.gravity = {0, -9.81, 0}, .policy = TimePolicy::event_driven});
  world.step(1);
  EXPECT_EQ(position(*world.find(1)), Vec3<double>(10, 0, 0));
  EXPECT_EQ(world.find(2)->velocity, Vec3<double>(20, 0, 0));
  EXPECT_TRUE(is_finite(world.energy()));
}

TEST(World, without_response_bodies_pass_and_every_meeting_is_told) {
  World world(
      {ball(1, {0, 0, 0}, {100, 0, 0}, 0.01), wall(2, {5, 0, 0}, {0.001, 4, 4}), wall(3, {7, 0, 0}, {0.5, 4, 4})},
      {.policy = TimePolicy::event_driven, .response = false});
  world.step(0.1);
  EXPECT_EQ(x_of(world, 1), 10);
  EXPECT_EQ(kinds(world), "bb");
  EXPECT_LT(world.hits().at(0).time, world.hits().at(1).time);
  world.step(0.1);
  EXPECT_EQ(kinds(world), "ee");
}

TEST(World, a_gate_misses_what_moves_less_than_its_part_of_the_size) {
  World world({ball(1, {0, 0, 0}, {1, 0, 0}), wall(2, {1, 0, 0}, {0.3, 4, 4})},
              {.policy = TimePolicy::event_driven, .gate = 0.5});
  world.step(0.24);  // 0.24 m of 0.5 m: not swept, though they meet after 0.2 m
  EXPECT_EQ(kinds(world), "");
  EXPECT_EQ(world.report().gated, 1);
  world.step(0.24);
  EXPECT_EQ(kinds(world), "b");
  EXPECT_LT(vx_of(world, 1), 0);
}

TEST(World, masks_and_missing_shapes_meet_nobody) {
  Body ghost = ball(3, {0, 0, 0}, {0, 0, 0});
  ghost.shape = std::monostate{};
  Body other = ball(2, {0, 0, 0}, {0, 0, 0});
  other.group = 4;
  Body blind = ball(1, {0, 0, 0}, {0, 0, 0});
  blind.mask = 3;
  World world({blind, other, ghost}, {.policy = TimePolicy::event_driven});
  world.step(1);
  EXPECT_EQ(world.report().pairs, 0);
  EXPECT_EQ(kinds(world), "");
}

TEST(World, a_listener_may_remove_what_it_hears_of_and_must_not_step) {
  Body bullet = ball(1, {0, 0, 0}, {100, 0, 0}, 0.01);
  bullet.name = "bullet";
  Body target = wall(2, {5, 0, 0}, {0.001, 4, 4});
  target.name = "wall";
  World world({bullet, target}, {.policy = TimePolicy::event_driven});
  std::string log;
  world.events().listen([&](const CollisionEvent& event) {
    log += world.events().to_text(event) + "; ";
    EXPECT_THROW(world.step(1), WorldError);
    if (event.kind == CollisionEventKind::begin) world.remove(event.first);
  });
  world.step(0.1);
  EXPECT_EQ(log, "0.04989 s: bullet meets wall; 0.1 s: bullet leaves wall (removed); ");
  EXPECT_EQ(world.bodies().size(), 1U);
  world.step(0.1);
  EXPECT_EQ(kinds(world), "");
}

TEST(World, a_listener_that_hears_of_a_removal_must_not_step) {
  World world({ball(1, {0, 0, 0}, {0, 0, 0}), ball(2, {1, 0, 0}, {0, 0, 0}), ball(3, {-1, 0, 0}, {0, 0, 0})}, {});
  world.step(1);
  std::string heard;
  world.events().listen([&](const CollisionEvent& event) {
    EXPECT_THROW(world.step(1), WorldError);
    heard += world.events().to_text(event) + "; ";
  });
  world.remove(1);
  EXPECT_EQ(std::count(heard.begin(), heard.end(), ';'), 2) << heard;
  world.step(1);
}

TEST(World, hands_move_bodies_between_steps) {
  World world({ball(1, {0, 0, 0}, {0, 0, 0}), wall(2, {9, 0, 0}, {1, 1, 1})}, {.policy = TimePolicy::event_driven});
  world.step(1);
  world.move(2, {-8.25, 0, 0});  // onto the ball: what is kept of bodies at rest is renewed
  world.step(1);
  EXPECT_EQ(kinds(world), "b");
  world.set_velocity(1, {-3, 0, 0});
  world.step(1);
  EXPECT_LT(x_of(world, 1), -2.9);
  EXPECT_THROW(world.set_velocity(2, {1, 0, 0}), WorldError);
  EXPECT_THROW(world.move(1, {infinite, 0, 0}), WorldError);
  EXPECT_THROW(world.remove(3), WorldError);
}

TEST(World, time_does_not_drift) {
  World world({}, {.policy = TimePolicy::event_driven});
  for (int k = 0; k < 1000000; ++k) world.step(0.1);
  EXPECT_EQ(world.time(), 1000000 * 0.1);
  EXPECT_EQ(world.report().step, 1000000U);
}

// ---- What it sees does not depend on what it does about it: every pair at the time that a sheet of paper gives.

constexpr double dt = 0.02;
constexpr int steps = 5, substeps = 4;
enum class Motion { fixed, driven, free };
constexpr const char* motion_names[] = {"static", "driven", "free"};

Body ball(std::uint32_t id, Motion motion, const Vec3<double>& place, const Vec3<double>& velocity) {
  Body body = ball(id, place, velocity, 0.125);
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
          World world(encounter.bodies(),
                      {.policy = policy, .substeps = substeps, .response = response, .full_plan = full_plan});
          std::optional<double> seen;
          for (int step = 0; step < steps; ++step) {
            world.step(dt);
            if (!world.hits().empty() && !seen) seen = world.hits().front().time;
            EXPECT_TRUE(response || world.report().impulses == 0) << "of an answer that nobody asked for";
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
        World world(bodies, {.policy = policy, .response = response, .full_plan = full_plan});
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
    World world(
        {ball(1, Motion::free, {0, 0, 0}, {10, 0, 0}), ball(2, Motion::driven, {0.725, -4, 0}, {0, 10, 0}), post},
        {.policy = policy, .max_events = 1});
    world.step(1);
    ASSERT_EQ(world.hits().size(), 2U) << name_of(policy);
    EXPECT_NEAR(world.hits()[0].time, 0.0875, 1e-15);
    EXPECT_EQ(world.hits()[1].second, 2U);
    EXPECT_NEAR(world.hits()[1].time, 0.38, 1e-15);  // 0.15 m beside its center: 0.2 m before it
    EXPECT_EQ(world.report().impulses, 1) << "it waits: what passes gives it none before the next step";
  }
}

/// The bounce off the first must not hide the second, which it no longer approaches.
TEST(SeenContacts, of_one_instant_are_all_told) {
  for (const TimePolicy policy : swept_policies) {
    std::vector<Body> bodies = {ball(3, Motion::free, {0, 1.125, 0}, {0, -2, 0})};
    for (const std::uint32_t id : {1U, 2U, 4U})  // of a floor
      bodies.push_back(wall(id, {id == 1 ? -1.0 : id == 2 ? 1.0 : 0.0, -1, id == 4 ? -2.0 : 0.0}, {1, 1, 1}));
    World world(bodies, {.policy = policy});
    world.step(1);
    ASSERT_EQ(world.hits().size(), 2U) << name_of(policy);
    for (const Hit& hit : world.hits()) EXPECT_EQ(hit.time, 0.5);
    EXPECT_EQ(world.report().impulses, 1);
  }
}

// ---- Bad input is refused by name, and a step that fails changes nothing; worlds large enough for threads to share.

Body bullet() { return {.id = 3, .name = "bullet", .shape = Sphere<double>{{0, 0, 0}, 0.5}}; }

TEST(WorldInput, names_the_body_and_what_is_allowed) {
  const auto refuse = [](const std::string& expected, const std::function<void(Body&)>& spoil) {
    Body body = bullet();
    spoil(body);
    EXPECT_EQ(error_of<WorldError>([&] { World({body}, {}); }), "bullet (id 3): " + expected);
  };
  refuse("its mass must be > 0; infinite for a body that nothing moves", [](Body& b) { b.mass = 0; });
  refuse("its mass must be > 0; infinite for a body that nothing moves", [](Body& b) { b.mass = nan; });
  refuse("its mass is so small that 1 / mass is not finite", [](Body& b) { b.mass = 1e-310; });
  refuse("its velocity must be finite", [](Body& b) { b.velocity = {0, infinite, 0}; });
  refuse("its velocity must be finite", [](Body& b) { b.velocity = {nan, 0, 0}; });
  refuse("its restitution must be in [0, 1]", [](Body& b) { b.restitution = 1.5; });
  refuse("its gravity scale must be finite", [](Body& b) { b.gravity_scale = nan; });
  refuse("its shape must have finite numbers only", [](Body& b) { b.shape = Sphere<double>{{nan, 0, 0}, 1}; });
  refuse("the sizes of its shape must be >= 0", [](Body& b) { b.shape = Sphere<double>{{0, 0, 0}, -1}; });
  refuse("the axes of its box must be unit vectors at right angles", [](Body& b) {
    b.shape = Obb<double>{{0, 0, 0}, {1, 1, 1}, Mat3<double>::Ones()};
  });
  refuse("its place is out of the range of coordinates", [](Body& b) { b.shape = Sphere<double>{{1e307, 0, 0}, 1}; });
  refuse("it is static, so that its velocity must be zero", [](Body& b) {
    b.is_static = true;
    b.velocity = {1, 0, 0};
  });
  Body twin = bullet();
  twin.name = "";
  EXPECT_EQ(error_of<WorldError>([&] { World({bullet(), twin}, {}); }), "bullet (id 3) and body (id 3) share one id");
}

TEST(WorldInput, names_the_option_and_what_is_allowed) {
  const auto refuse = [](const std::string& expected, const std::function<void(WorldOptions&)>& spoil) {
    WorldOptions options;
    spoil(options);
    EXPECT_EQ(error_of<WorldError>([&] { World({}, options); }).substr(0, expected.size()), expected);
  };
  refuse("world: gravity must be finite", [](WorldOptions& o) { o.gravity = {0, nan, 0}; });
  refuse("world: substeps must be >= 1", [](WorldOptions& o) { o.substeps = 0; });
  refuse("world: max_events must be >= 1", [](WorldOptions& o) { o.max_events = 0; });
  refuse("world: contact_rounds must be >= 0", [](WorldOptions& o) { o.contact_rounds = -1; });
  refuse("world: correction must be in [0, 1]", [](WorldOptions& o) { o.correction = nan; });
  refuse("world: end_after must be >= 1", [](WorldOptions& o) { o.end_after = 0; });
  refuse("world: gate must be finite and >= 0; 0 is off", [](WorldOptions& o) { o.gate = -1; });
  refuse("world: threads must be >= 1", [](WorldOptions& o) { o.threads = 0; });
  refuse("world: max_pairs must be >= 1", [](WorldOptions& o) { o.max_pairs = 0; });
  refuse("world: there is no broad phase 'octree'; there are: auto, all_pairs",
         [](WorldOptions& o) { o.broad_phase = "octree"; });
}

TEST(WorldInput, refuses_a_step_that_is_none) {
  World world({bullet()}, {});
  for (const double bad : {0.0, -1.0, nan, infinite}) {
    EXPECT_EQ(error_of<WorldError>([&] { world.step(bad); }), "world: a step must be > 0 s and finite");
  }
  EXPECT_EQ(world.report().step, 0U);
}

TEST(WorldInput, an_empty_world_steps_and_nothing_happens) {
  for (const bool full : {false, true}) {
    World world({}, {.full_plan = full});
    EXPECT_EQ(world.step(1).hits, 0U);
    EXPECT_EQ(world.energy(), 0);
    EXPECT_EQ(world.find(1), nullptr);
    EXPECT_TRUE(holds(to_text(world.plan()), "plan"));
  }
}

TEST(WorldInput, stops_when_pairs_explode_and_changes_nothing) {
  std::vector<Body> heap;
  for (std::uint32_t id = 0; id < 3000; ++id) {
    heap.push_back(bullet());
    heap.back().id = id;
    heap.back().velocity = {1, 0, 0};
  }
  World world(heap, {.max_pairs = 100000});
  const std::uint64_t before = world.state_hash();
  EXPECT_THROW(world.step(1), TooManyPairs);
  EXPECT_EQ(world.state_hash(), before);
  EXPECT_EQ(world.time(), 0);
  EXPECT_EQ(world.report().step, 0U);
  while (world.bodies().size() > 10) world.remove(world.bodies().back().id);
  EXPECT_GT(world.step(1).hits, 0U);
}

TEST(WorldInput, names_the_body_that_leaves_the_world_and_changes_nothing) {
  for (const bool has_wall : {false, true}) {
    Body body = bullet();
    body.velocity = {1e300, 0, 0};
    World world(has_wall ? std::vector{body, wall(9, {-9, 0, 0}, {1, 1, 1})} : std::vector{body}, {});
    world.step(1);
    const std::uint64_t before = world.state_hash();
    EXPECT_EQ(error_of<LeftTheWorld>([&] { world.step(1e7); }).substr(0, 45),
              "bullet (id 3) left the representable world: i");
    EXPECT_EQ(world.state_hash(), before);
    EXPECT_EQ(world.time(), 1);
    world.set_velocity(3, {-1, 0, 0});
    world.step(1);  // goes on
    EXPECT_EQ(world.time(), 2);
  }
}

/// A crowd with blocks of pairs for threads to share, and with more changes of course than are searched one by one.
TEST(WorldInput, one_two_and_three_threads_and_the_full_plan_leave_one_state) {
  for (const TimePolicy policy : {TimePolicy::discrete, TimePolicy::event_driven}) {
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 3, 0}) {  // 0: one, and nothing omitted
      WorldDraw draw(11);
      std::vector<Body> bodies;
      for (std::uint32_t id = 0; id < 500; ++id) {
        Body body = bullet();
        body.id = id;
        const Vec3<double> place = draw.vector(3, false);
        body.shape = drawn_shape(draw, 5, place, false);
        body.velocity = draw.vector(9, false);
        body.restitution = 0.5;
        bodies.push_back(body);
      }
      World world(bodies,
                  {.policy = policy, .max_events = 4, .full_plan = threads == 0, .threads = std::max(1, threads)});
      EXPECT_GT(world.step(0.02).pairs, 2048U);
      world.step(0.02);
      hashes.push_back(world.state_hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
    EXPECT_EQ(hashes[0], hashes[3]);
  }
}

TEST(WorldPlan, says_what_it_omits_and_why) {
  Body wall = bullet();
  wall.id = 4;
  wall.is_static = true;
  Body other = wall;
  other.id = 5;
  WorldOptions options = {.response = false, .events = false};
  const Plan planned = plan(std::vector{bullet(), wall, other}, options);
  EXPECT_FALSE(planned.contacts);
  EXPECT_TRUE(planned.sphere_aabb);
  EXPECT_EQ(planned.broad_phase, "all_pairs");
  const std::string text = to_text(planned);
  EXPECT_TRUE(holds(text, "omit  contacts"));
  EXPECT_TRUE(holds(text, "omit  static pairs"));
  EXPECT_TRUE(holds(text, "keep  masked pairs"));
  options.full_plan = true;
  const Plan full = plan(std::vector{bullet(), wall, other}, options);
  EXPECT_TRUE(full.full && full.contacts && full.response && full.events && full.all_bounds && full.resting_bounds);
  EXPECT_FALSE(full.sphere_aabb);
  for (const PlanLine& line : full.lines) EXPECT_FALSE(line.omitted) << line.what;
  Body masked = bullet();
  masked.mask = 2;
  EXPECT_TRUE(holds(to_text(plan(std::vector{masked, wall}, {})), "omit  masked pairs"));
}

TEST(WorldPlan, a_scene_that_nobody_watches_only_moves) {
  Body body = bullet();
  body.velocity = {8, 0, 0};
  World world({body}, {.response = false, .events = false});
  EXPECT_EQ(world.step(0.25).sweeps, 0U);
  EXPECT_EQ(position(world.bodies()[0]).x(), 2);
}

}  // namespace
}  // namespace thinwall::testing
