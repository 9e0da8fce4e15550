// Worlds whose bodies turn, held against what a sheet of paper gives: angles, angular velocities after a blow, and what is conserved.

#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <thinwall/experiments/world.hpp>
#include <thinwall/experiments/world/pairs.hpp>

#include "experiments/world/random_world.hpp"
#include "support/said.hpp"

namespace thinwall::testing {
namespace {

constexpr double immovable = std::numeric_limits<double>::infinity();

Body body_of(std::uint32_t id, const AnyShape& shape, double mass = 1) {
  return {.id = id, .name = {}, .shape = shape, .mass = mass, .restitution = 1};
}

Body spinning_body(std::uint32_t id, const AnyShape& shape, const Vec3<double>& angular_velocity, double mass = 1) {
  Body body = body_of(id, shape, mass);
  body.turns = true;
  body.angular_velocity = angular_velocity;
  return body;
}

Body fixed(Body body) {
  body.is_static = true;
  return body;
}

Capsule<double> rod_along_x(double half_core, double radius) { return {{-half_core, 0, 0}, {half_core, 0, 0}, radius}; }

/// [m^2] The squared radius of gyration about z of a capsule along x, slice by slice: not the formula that is judged.
double gyration_of_rod(double half_core, double radius, bool about_x) {
  constexpr int slices = 400'000;
  const double end = half_core + radius, width = 2 * end / slices;
  double mass = 0, sum = 0;
  for (int k = 0; k < slices; ++k) {
    const double x = -end + (k + 0.5) * width, beyond = std::max(0.0, std::abs(x) - half_core);
    const double square = radius * radius - beyond * beyond;  // of the slice's radius
    mass += square;
    sum += square * (about_x ? square / 2 : square / 4 + x * x);
  }
  return sum / mass;
}

TEST(Spin, inertia_is_that_of_the_solid) {
  const Gyration rod = gyration_of(rod_along_x(0.7, 0.2));
  EXPECT_NEAR(rod.squares[0], gyration_of_rod(0.7, 0.2, false), 1e-9);
  EXPECT_NEAR(rod.squares[1], gyration_of_rod(0.7, 0.2, false), 1e-9);
  EXPECT_NEAR(rod.squares[2], gyration_of_rod(0.7, 0.2, true), 1e-9);
  EXPECT_NEAR(std::abs(rod.axes.col(2).x()), 1, 1e-15);
  EXPECT_NEAR(rod.axes.determinant(), 1, 1e-15);
  const Gyration box = gyration_of(Obb<double>{{0, 0, 0}, {1, 2, 3}, Mat3<double>::Identity()});
  EXPECT_LT((box.squares - Vec3<double>(13.0 / 3, 10.0 / 3, 5.0 / 3)).norm(), 1e-15);
  const Gyration needle = gyration_of(Obb<double>{{0, 0, 0}, {1e-9, 1e-9, 1}, Mat3<double>::Identity()});
  EXPECT_NEAR(needle.squares[2] / 1e-18, 2.0 / 3, 1e-15);
  EXPECT_EQ(gyration_of(Sphere<double>{{0, 0, 0}, 5}).squares, Vec3<double>(10, 10, 10));
  const Mat3<double> thin = inverse_inertia(rod_along_x(1, 0), 1);  // no extent about its own axis
  EXPECT_EQ(thin(0, 0), 0);
  EXPECT_NEAR(thin(1, 1), 3, 1e-15);
}

TEST(Spin, a_body_that_nothing_touches_turns_by_its_rate_and_stays_true) {
  for (const TimePolicy policy : all_policies) {
    const Vec3<double> rate(0.3, -0.5, 0.9);
    const Body rod = spinning_body(1, rod_along_x(1, 0.1), rate),
               box = spinning_body(2, Obb<double>{{9, 0, 0}, {1, 2, 3}, Mat3<double>::Identity()}, rate);
    World world({rod, box}, {.policy = policy, .substeps = 3});
    const double energy = world.energy();
    for (int k = 0; k < 1000; ++k) world.step(0.01);
    const Mat3<double> turn = Eigen::AngleAxisd(10 * rate.norm(), rate.normalized()).toRotationMatrix();
    const auto& turned_rod = std::get<Capsule<double>>(world.find(1)->shape);
    const auto& turned_box = std::get<Obb<double>>(world.find(2)->shape);
    EXPECT_LT((turned_rod.b - turn.col(0)).norm(), 1e-12) << name_of(policy);
    EXPECT_NEAR((turned_rod.b - turned_rod.a).norm(), 2, 1e-13);
    EXPECT_LT((turned_box.axes - turn).norm(), 1e-12) << name_of(policy);
    EXPECT_LT((turned_box.axes.transpose() * turned_box.axes - Mat3<double>::Identity()).norm(), 1e-15);
    EXPECT_NEAR(world.energy() / energy, 1, 1e-12);
    EXPECT_EQ(world.find(2)->angular_velocity, rate);
  }
}

/// A ball flies along y at a rod at rest along x, and hits it at `arm` from its center: 1/m + 1/M + arm^2/I.
TEST(Spin, a_rod_struck_by_a_ball_turns_as_the_arm_says) {
  const double half_core = 0.7, radius = 0.2, rod_mass = 3, ball_mass = 0.5, speed = 8, ball_radius = 0.1;
  const double inertia = rod_mass * gyration_of_rod(half_core, radius, false);
  for (const TimePolicy policy : swept_policies) {
    for (const double arm : {0.0, 0.35, -0.7}) {
      Body ball = body_of(2, Sphere<double>{{arm, -2.3, 0}, ball_radius}, ball_mass);
      ball.velocity = {0, speed, 0};
      World world({spinning_body(1, rod_along_x(half_core, radius), {0, 0, 0}, rod_mass), ball}, {.policy = policy});
      world.step(0.3);  // they meet after 2 m: at 0.25 s
      const double impulse = 2 * speed / (1 / rod_mass + 1 / ball_mass + arm * arm / inertia);
      ASSERT_EQ(world.hits().size(), 1U);
      EXPECT_NEAR(world.hits()[0].time, 0.25, 1e-12);
      EXPECT_NEAR(world.find(2)->velocity.y(), speed - impulse / ball_mass, 1e-8) << arm;
      EXPECT_NEAR(world.find(1)->velocity.y(), impulse / rod_mass, 1e-8) << arm;
      EXPECT_NEAR(world.find(1)->angular_velocity.z(), impulse * arm / inertia, 1e-8) << arm;
      EXPECT_LT(world.find(1)->angular_velocity.head<2>().norm(), 1e-12);
      EXPECT_NEAR(world.energy(), ball_mass * speed * speed / 2, 1e-12);
      const double momentum = ball_mass * world.find(2)->velocity.y() + rod_mass * world.find(1)->velocity.y();
      EXPECT_NEAR(momentum, ball_mass * speed, 1e-14);
      const double about_start = ball_mass * position(*world.find(2)).x() * world.find(2)->velocity.y() +
                                 inertia * world.find(1)->angular_velocity.z();
      EXPECT_NEAR(about_start, ball_mass * arm * speed, 1e-8);  // the numeric inertia's digits
    }
  }
}

/// On a wide floor a box lands flat, far from the floor's middle: it meets it under its own, whichever of the two is first.
TEST(Spin, a_box_that_lands_flat_is_thrown_back_as_it_came) {
  for (const TimePolicy policy : {TimePolicy::discrete, TimePolicy::clamp, TimePolicy::event_driven}) {
    for (const std::uint32_t id_of_floor : {0U, 9U}) {
      const Obb<double> cube{{0, 0.505, 0}, {0.5, 0.5, 0.5}, Mat3<double>::Identity()};
      Body box = spinning_body(5, cube, {0, 0, 0});
      box.velocity = {0, -1, 0};
      World world({fixed(body_of(id_of_floor, Aabb<double>{{40, -0.5, 0}, {60, 0.5, 60}})), box}, {.policy = policy});
      for (int k = 0; k < 3; ++k) {
        world.step(0.01);
        for (const Hit& hit : world.hits()) EXPECT_LT((hit.point - Vec3<double>(0, 0, 0)).norm(), 0.01);
      }
      EXPECT_NEAR(world.find(5)->velocity.y(), 1, 1e-9) << name_of(policy) << ", floor " << id_of_floor;
      EXPECT_LT(world.find(5)->angular_velocity.norm(), 1e-9);
    }
  }
}

/// The tip of a rod that spins about z comes to a wall above: half_core sin(angle) + radius is its distance.
TEST(Spin, a_rod_that_spins_meets_a_wall_at_its_angle_and_is_thrown_back) {
  const double half_core = 0.75, radius = 0.125, mass = 2, rate = 4, distance = 0.5;
  const double angle = std::asin((distance - radius) / half_core), arm = half_core * std::cos(angle);
  const double inertia = mass * gyration_of_rod(half_core, radius, false);
  const double impulse = 2 * rate * arm / (1 / mass + arm * arm / inertia);
  for (const TimePolicy policy : swept_policies) {
    World world({spinning_body(1, rod_along_x(half_core, radius), {0, 0, rate}, mass),
                 fixed(body_of(2, Aabb<double>{{0, distance + 1, 0}, {5, 1, 5}}))},
                {.policy = policy});
    world.step(1.01 * angle / rate);
    ASSERT_EQ(world.hits().size(), 1U) << name_of(policy);
    EXPECT_NEAR(world.hits()[0].time, angle / rate, 1e-11);
    EXPECT_LE(world.hits()[0].time, angle / rate) << "never late";
    EXPECT_LT((world.hits()[0].point - Vec3<double>(arm, distance, 0)).norm(), 1e-10);
    EXPECT_NEAR(world.find(1)->velocity.y(), -impulse / mass, 1e-8);
    EXPECT_NEAR(world.find(1)->angular_velocity.z(), rate - impulse * arm / inertia, 1e-8);
    EXPECT_NEAR(world.energy(), inertia * rate * rate / 2, 1e-8);
  }
}

/// Its axis passes the post's center at the distance of both radii: rho sin(phi - angle).
TEST(Spin, a_blade_meets_a_post_at_its_angle_and_a_discrete_one_goes_through) {
  const double half_core = 1, radius = 0.02, post_radius = 0.03, rho = 0.6, phi = 1.2, rate = 100;
  const Vec3<double> place(rho * std::cos(phi), rho * std::sin(phi), 0);
  const double angle = phi - std::asin((radius + post_radius) / rho);
  Body blade = spinning_body(1, rod_along_x(half_core, radius), {0, 0, rate});
  blade.mass = immovable;
  const Body post =
      body_of(2, Capsule<double>{place - Vec3<double>(0, 0, 1), place + Vec3<double>(0, 0, 1), post_radius});
  const double dt = 0.021;  // 2.1 rad a step: past the post
  for (const TimePolicy policy : all_policies) {
    for (const bool is_free : {false, true}) {
      const WorldOptions options = {.policy = policy, .substeps = 2};  // 1.05 rad: still before it
      World world({blade, is_free ? post : fixed(post)}, options);
      world.step(dt);
      ASSERT_EQ(world.hits().size(), sweeps(policy) ? 1U : 0U) << name_of(policy);
      EXPECT_EQ(world.find(1)->angular_velocity, Vec3<double>(0, 0, rate));
      if (!sweeps(policy)) continue;
      EXPECT_NEAR(world.hits()[0].time, angle / rate, 1e-12) << name_of(policy);
      EXPECT_LE(world.hits()[0].time, angle / rate) << "never late";
      if (!is_free) continue;
      const double reach = rho * std::cos(std::asin((radius + post_radius) / rho));  // along the blade, to the post
      EXPECT_NEAR(world.find(2)->velocity.norm(), 2 * rate * reach, 1e-6) << "a wall that moves gives twice its speed";
    }
  }
}

/// Linear and angular momentum and energy, of two boxes or rods that meet anyhow: clamped they stand where they met.
TEST(Spin, a_collision_keeps_momentum_angular_momentum_and_energy) {
  int met = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    WorldDraw draw(seed);
    std::vector<Body> bodies;
    for (std::uint32_t id = 0; id < 2; ++id) {
      const Vec3<double> place = draw.vector(1.5, false) + Vec3<double>(id * 4.0, 0, 0);
      const Vec3<double> size = Vec3<double>::Constant(0.1) + draw.vector(1, false).cwiseAbs(),
                         arm = draw.vector(1, false);
      AnyShape shape = Obb<double>{place, size, drawn_axes(draw)};
      if (draw.pick(2) == 0) shape = Capsule<double>{place - arm, place + arm, 0.2};
      bodies.push_back(spinning_body(id, shape, draw.vector(3, false), draw.in(0.1, 10)));
      bodies.back().velocity = draw.vector(3, false) + Vec3<double>(id == 0 ? 5.0 : -5.0, 0, 0);
    }
    World world(bodies, {.policy = TimePolicy::clamp});
    const double energy = world.energy();
    world.step(1);
    if (world.hits().size() != 1 || world.hits()[0].at_start) continue;
    ++met;
    Vec3<double> momentum = Vec3<double>::Zero(), angular = Vec3<double>::Zero();
    for (const Body& before : bodies) {
      const Body& after = *world.find(before.id);
      const Gyration of = gyration_of(after.shape);
      const Mat3<double> inertia = after.mass * (of.axes * of.squares.asDiagonal() * of.axes.transpose());
      const Vec3<double> gained = after.mass * (after.velocity - before.velocity);
      momentum += gained;
      angular += position(after).cross(gained) + inertia * (after.angular_velocity - before.angular_velocity);
    }
    EXPECT_LT(momentum.norm(), 1e-12) << seed;
    EXPECT_LT(angular.norm(), 1e-11) << seed;
    EXPECT_NEAR(world.energy() / energy, 1, 1e-12) << seed;
  }
  EXPECT_GT(met, 100);
}

/// The ends of a rod that falls nearly flat: the first is thrown back, which drives the second down at nearly twice the speed, and that the
/// first again; blow by blow.
TEST(Spin, a_rod_that_falls_nearly_flat_slaps_three_times) {
  Body rod = spinning_body(1, Capsule<double>{{-1, 0.5, 0}, {1, 0.5 + 1e-3, 0}, 0.1}, {0, 0, 0});
  rod.velocity = {0, -10, 0};
  World world({rod, fixed(body_of(2, Aabb<double>{{0, -1, 0}, {5, 1, 5}}))}, {});
  const double energy = world.energy();
  world.step(0.1);
  ASSERT_EQ(world.hits().size(), 3U);
  EXPECT_LT(world.hits()[0].point.x(), -0.9);
  EXPECT_GT(world.hits()[1].point.x(), 0.9);
  EXPECT_LT(world.hits()[2].point.x(), -0.9);
  EXPECT_NEAR(world.hits()[0].time, 0.04, 1e-12);
  EXPECT_LT(world.hits()[1].time, 0.0402);
  EXPECT_NEAR(world.energy() / energy, 1, 1e-12);
  const double square = gyration_of_rod(1, 0.1, false);
  double velocity = -10, rate = 0;
  for (const double end : {-1, 1, -1}) {
    const double impulse = -2 * (velocity + rate * end) / (1 + 1 / square);
    velocity += impulse;
    rate += end * impulse / square;
  }
  EXPECT_NEAR(world.find(1)->velocity.y(), velocity, 1e-4);
  EXPECT_NEAR(world.find(1)->angular_velocity.z(), rate, 1e-3);
}

// ---- What a plan leaves out, and how the work is done.

TEST(Spin, of_a_ball_changes_nothing_and_is_left_out) {
  std::vector<Body> bodies = {body_of(1, Sphere<double>{{0, 0, 0}, 0.5}), body_of(2, Sphere<double>{{3, 0.4, 0}, 0.5}),
                              fixed(body_of(3, Obb<double>{{-3, 0, 0}, {1, 5, 5}, Mat3<double>::Identity()}))};
  bodies[0].velocity = {5, 0, 0};
  const auto run = [&](const Vec3<double>& rate, const WorldOptions& options) {
    std::vector<Body> all = bodies;
    for (Body& body : all) {
      body.turns = rate != Vec3<double>::Zero() && !body.is_static;
      if (body.turns) body.angular_velocity = rate;
    }
    World world(all, options);
    std::vector<Vec3<double>> places;
    for (int k = 0; k < 40; ++k) {
      world.step(0.1);
      for (const Body& body : world.bodies()) places.insert(places.end(), {position(body), body.velocity});
    }
    return places;
  };
  WorldOptions kept, full;
  kept.keep = {"spin"};
  full.full_plan = true;
  const auto without = run({0, 0, 0}, {});
  for (const WorldOptions& options : {WorldOptions{}, kept, full}) EXPECT_EQ(run({70, -8, 900}, options), without);
  for (Body& body : bodies) body.turns = true;
  const std::string text = to_text(plan(std::vector{bodies[0], bodies[1]}, {}));
  EXPECT_TRUE(holds(text, "omit  spin                      2 balls look the same whichever way up"));
  EXPECT_FALSE(holds(to_text(plan(std::vector{fixed(body_of(3, Sphere<double>{{0, 0, 0}, 1}))}, {})), "spin"))
      << "where nothing turns a plan does not speak of it";
}

// ---- Bad input.

TEST(Spin, names_what_cannot_turn) {
  const auto refuse = [](const std::string& expected, const std::function<void(Body&)>& spoil) {
    Body body = spinning_body(3, rod_along_x(1, 0.1), {0, 0, 1});
    body.name = "rod";
    spoil(body);
    EXPECT_EQ(error_of<WorldError>([&] { World({body}, {}); }), "rod (id 3): " + expected);
  };
  refuse("an aabb does not turn: write obb", [](Body& b) { b.shape = Aabb<double>{{0, 0, 0}, {1, 1, 1}}; });
  refuse("it has no shape, so that it cannot turn", [](Body& b) { b.shape = std::monostate{}; });
  refuse("it does not turn, so that its angular velocity must be zero", [](Body& b) { b.turns = false; });
  refuse("it is static, so that its angular velocity must be zero", [](Body& b) { b.is_static = true; });
  refuse("its angular velocity must be finite", [](Body& b) { b.angular_velocity.x() = immovable; });
  refuse("its angular velocity must be finite", [](Body& b) { b.angular_velocity.x() = std::nan(""); });
  refuse("its moment of inertia is so small that its inverse is not finite", [](Body& b) {
    b.shape = rod_along_x(1e-80, 0);
    b.mass = 1e-200;
  });
}

/// Two thin rods come together at a sine of a tenth: the plane between them proves nothing before the gap is closed to rounding.
TEST(Spin, wires_that_meet_at_a_small_angle_bounce) {
  const Body one = spinning_body(1, Capsule<double>{{-0.5, 0, 0}, {0.5, 0, 0}, 1e-3}, {0, 0.001, 0});
  Body other = spinning_body(2, Capsule<double>{{-0.5, -0.05, 0.004}, {0.5, 0.05, 0.004}, 1e-3}, {0.0005, 0, -0.001});
  other.velocity = {0.003, 0.001, -0.01};
  World world({one, other}, {});
  for (int k = 0; k < 60; ++k) world.step(1.0 / 60);
  EXPECT_LT(world.bodies()[0].velocity.z(), 0);
}

/// A rod lies a picometer above the floor, and a ball drives it down: within the instant the sweeps differ in what they call the start.
TEST(Spin, a_contact_within_the_first_instant_is_told) {
  Body rod = spinning_body(1, Capsule<double>{{-0.4, 0.100000000001, 0}, {0.4, 0.100000000001, 0}, 0.1}, {0.001, 0, 0});
  Body shot = body_of(2, Sphere<double>{{0, 0.3, 0}, 0.1});
  shot.velocity = {0, -1000, 0};
  World world({rod, shot, fixed(body_of(3, Aabb<double>{{0, -0.5, 0}, {2.5, 0.5, 2.5}}))}, {});
  world.step(0.0166);
  bool told = false;
  for (const Hit& hit : world.hits()) told = told || (hit.first == 1 && hit.second == 3);
  EXPECT_TRUE(told);
}

/// What a full plan asks and then drops changes nothing, whatever the answer.
TEST(Spin, two_that_may_not_meet_may_turn_as_far_as_they_like) {
  const Body rod = spinning_body(1, rod_along_x(1, 0.1), {1e10, 0, 1e10});
  Body ball = fixed(body_of(2, Sphere<double>{{0.35, 0, 0.35}, 0.01}));  // within the cone that the rod turns along
  const auto said = [&](bool full) {
    World world({rod, ball}, {.full_plan = full});
    return error_of<TurnsTooFar>([&] { world.step(1); });
  };
  EXPECT_NE(said(true), "");
  ball.mask = 0;
  for (const bool full : {false, true}) EXPECT_EQ(said(full), "") << full;
}

/// A million turns a step: nothing can be told of it, and it is said so.
TEST(Spin, names_two_that_turn_too_far_and_changes_nothing) {
  const Body rod = spinning_body(1, rod_along_x(1, 0.1), {0, 0, 1e13});
  World world({rod, fixed(body_of(2, Sphere<double>{{0, 1.05, 0.1}, 0.01}))}, {});
  const std::uint64_t before = world.state_hash();
  const std::string said = error_of<TurnsTooFar>([&] { world.step(1); });
  if (said.empty()) {
    EXPECT_FALSE(world.hits().empty()) << "or it is taken for a hit, which it is";
    return;
  }
  EXPECT_EQ(
      said,
      "nothing can be proven of when body (id 1) meets body (id 2): they turn too far in a step; take shorter ones");
  EXPECT_EQ(world.state_hash(), before);
}

}  // namespace
}  // namespace thinwall::testing
