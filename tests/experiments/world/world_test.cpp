// What a world does, on scenes whose outcome is known.

#include <cmath>

#include <gtest/gtest.h>

#include "experiments/world/random_world.hpp"

namespace thinwall::testing {
namespace {

constexpr double immovable = std::numeric_limits<double>::infinity();

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

TEST(World, two_fast_bodies_meet_like_any_other_pair) {
  for (const TimePolicy policy : swept_policies) {
    World world({ball(1, {-100, 0, 0}, {1000, 0, 0}), ball(2, {60, 0, 0}, {-600, 0, 0})}, {.policy = policy});
    world.step(1);
    EXPECT_EQ(vx_of(world, 1), -600);
    EXPECT_EQ(vx_of(world, 2), 1000);
    EXPECT_NEAR(world.hits().at(0).time, 159.0 / 1600, 1e-15);
    EXPECT_LT(x_of(world, 1), x_of(world, 2));
  }
  World discrete({ball(1, {-100, 0, 0}, {1000, 0, 0}), ball(2, {60, 0, 0}, {-600, 0, 0})},
                 {.policy = TimePolicy::discrete});
  discrete.step(1);
  EXPECT_EQ(vx_of(discrete, 1), 1000);  // they passed through each other
}

TEST(World, masses_of_one_to_ten_to_the_sixteen_bounce_without_loss) {
  Body heavy = ball(2, {4, 0, 0}, {0, 0, 0});
  heavy.mass = 1e16;
  World world({ball(1, {0, 0, 0}, {1, 0, 0}), heavy}, {.policy = TimePolicy::event_driven});
  world.step(4);
  EXPECT_EQ(vx_of(world, 1), -1);
  EXPECT_EQ(vx_of(world, 2), 2e-16);
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
  EXPECT_EQ(world.report().impulses, 64U);
  EXPECT_EQ(x_of(world, 3), 0.25);  // an even number of walls: back on the same course
  EXPECT_EQ(vx_of(world, 3), 64);
  EXPECT_EQ(world.report().waiting, 0U);
  options.max_events = 5;  // bounded: it waits at the last wall, and goes on in the next step
  World bounded({wall(1, {-2, 0, 0}, {1, 1, 1}), wall(2, {2, 0, 0}, {1, 1, 1}), ball(3, {0.25, 0, 0}, {64, 0, 0}, 0.5)},
                options);
  bounded.step(1);
  EXPECT_EQ(bounded.report().impulses, 5U);
  EXPECT_EQ(bounded.report().waiting, 1U);
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
    const WorldOptions options = {.gravity = {0, -9.81, 0}, .policy = policy};
    Body rests = ball(1, {0, 0.5, 0}, {0, 0, 0});
    rests.restitution = 0;
    World world({rests, wall(2, {0, -1, 0}, {5, 1, 5})}, options);
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
  const WorldOptions options = {.gravity = {0, -8, 0}, .policy = TimePolicy::clamp};
  World world({slides, wall(2, {0, -1, 0}, {50, 1, 5})}, options);
  for (int k = 0; k < 8; ++k) world.step(0.125);
  EXPECT_EQ(x_of(world, 1), 3);
}

TEST(World, the_larger_restitution_counts_and_a_fall_bounces_to_its_square) {
  const WorldOptions options = {.gravity = {0, -10, 0}, .policy = TimePolicy::event_driven};
  Body drops = ball(1, {0, 1.5, 0}, {0, 0, 0});
  drops.restitution = 0.25;
  Body floor = wall(2, {0, -1, 0}, {5, 1, 5});
  floor.restitution = 0.5;
  World world({drops, floor}, options);
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
  const WorldOptions options = {.policy = TimePolicy::event_driven, .max_events = 100};
  World world(bodies, options);
  const double before = world.energy();
  const auto momentum = [&] {
    Vec3<double> sum = Vec3<double>::Zero();
    for (const Body& body : world.bodies()) sum += body.velocity * body.mass;
    return sum;
  };
  const Vec3<double> start = momentum();
  std::size_t impulses = 0;
  for (int k = 0; k < 20; ++k) impulses += world.step(0.1).impulses;
  EXPECT_GT(impulses, 5U);
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
  piston.mass = immovable;
  const WorldOptions options = {.gravity = {0, -9.81, 0}, .policy = TimePolicy::event_driven};
  Body pushed = ball(2, {5, 0, 0}, {0, 0, 0});
  pushed.gravity_scale = 0;
  World world({piston, pushed}, options);
  world.step(1);
  EXPECT_EQ(position(*world.find(1)), Vec3<double>(10, 0, 0));
  EXPECT_EQ(world.find(2)->velocity, Vec3<double>(20, 0, 0));
  EXPECT_TRUE(is_finite(world.energy()));
}

TEST(World, without_response_bodies_pass_and_every_meeting_is_told) {
  const WorldOptions options = {.policy = TimePolicy::event_driven, .response = false};
  World world(
      {ball(1, {0, 0, 0}, {100, 0, 0}, 0.01), wall(2, {5, 0, 0}, {0.001, 4, 4}), wall(3, {7, 0, 0}, {0.5, 4, 4})},
      options);
  world.step(0.1);
  EXPECT_EQ(x_of(world, 1), 10);
  EXPECT_EQ(kinds(world), "bb");
  EXPECT_LT(world.hits().at(0).time, world.hits().at(1).time);
  world.step(0.1);
  EXPECT_EQ(kinds(world), "ee");
}

TEST(World, a_gate_misses_what_moves_less_than_its_part_of_the_size) {
  const WorldOptions options = {.policy = TimePolicy::event_driven, .gate = 0.5};
  World world({ball(1, {0, 0, 0}, {1, 0, 0}), wall(2, {1, 0, 0}, {0.3, 4, 4})}, options);
  world.step(0.24);  // 0.24 m of 0.5 m: not swept, though they meet after 0.2 m
  EXPECT_EQ(kinds(world), "");
  EXPECT_EQ(world.report().gated, 1U);
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
  EXPECT_EQ(world.report().pairs, 0U);
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
  EXPECT_THROW(world.move(1, {immovable, 0, 0}), WorldError);
  EXPECT_THROW(world.remove(3), WorldError);
}

TEST(World, time_does_not_drift) {
  World world({}, {.policy = TimePolicy::event_driven});
  for (int k = 0; k < 1000000; ++k) world.step(0.1);
  EXPECT_EQ(world.time(), 1000000 * 0.1);
  EXPECT_EQ(world.report().step, 1000000U);
}

}  // namespace
}  // namespace thinwall::testing
