// Bad input is refused by name, and a step that fails changes nothing; worlds large enough for threads to share.

#include <functional>

#include <gtest/gtest.h>

#include <thinwall/discrete/broad_phase/proxy.hpp>
#include <thinwall/experiments/world/pairs.hpp>

#include "experiments/world/random_world.hpp"
#include "support/said.hpp"

namespace thinwall::testing {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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
  for (const double dt : {0.0, -1.0, nan, infinite}) {
    EXPECT_EQ(error_of<WorldError>([&] { world.step(dt); }), "world: a step must be > 0 s and finite");
  }
  EXPECT_EQ(world.report().step, 0U);
}

TEST(WorldInput, an_empty_world_steps_and_nothing_happens) {
  for (const bool full : {false, true}) {
    const WorldOptions options = {.full_plan = full};
    World world({}, options);
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
  const WorldOptions options = {.max_pairs = 100000};
  World world(heap, options);
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
    Body wall = bullet();
    wall.id = 9;
    wall.is_static = true;
    wall.shape = Aabb<double>{{-9, 0, 0}, {1, 1, 1}};
    World world(has_wall ? std::vector{body, wall} : std::vector{body}, {});
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
      const WorldOptions options = {
          .policy = policy, .max_events = 4, .full_plan = threads == 0, .threads = std::max(1, threads)};
      World world(bodies, options);
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
  const WorldOptions options = {.response = false, .events = false};
  Body body = bullet();
  body.velocity = {8, 0, 0};
  World world({body}, options);
  EXPECT_EQ(world.step(0.25).sweeps, 0U);
  EXPECT_EQ(position(world.bodies()[0]).x(), 2);
}

}  // namespace
}  // namespace thinwall::testing
