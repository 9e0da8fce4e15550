/// What a scene file may say, and what it is told when it says something else.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/scenes/scene.hpp>

#include "experiments/scenes/scene_text.hpp"

namespace thinwall {
namespace {

std::string complaint(const std::string& text) {
  try {
    scene_from(text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no complaint";
}

void expect_complaint(const std::string& text, const std::vector<std::string>& parts) {
  const std::string said = complaint(text);
  for (const std::string& part : parts) EXPECT_NE(said.find(part), std::string::npos) << said << "\nwants: " << part;
}

const std::string ball = "scene = 'a'\n[[body]]\nshape = 'sphere'\nradius = 1\n";

TEST(SceneFile, reads_every_shape) {
  const Scene scene = scene_from(R"(
scene = "shapes"
dt = 0.5
steps = 3
gravity = [0, -9.5, 0]
policy = "clamp"
[[body]]
shape = "sphere"
radius = 2
at = [1, 2, 3]
[[body]]
name = "crate"
shape = "box"
size = [2, 4, 6]
mass = 7
[[body]]
shape = "turned_box"
size = [2, 4, 6]
turn_deg = [0, 0, 90]
motion = "static"
[[body]]
shape = "capsule"
height = 6
radius = 1
axis = [0, 0, 5]
motion = "driven"
velocity = [1, 0, 0]
[[body]]
shape = "none"
)");
  ASSERT_EQ(scene.bodies.size(), 5U);
  EXPECT_EQ(std::get<Sphere<double>>(scene.bodies[0].shape).center, Vec3<double>(1, 2, 3));
  EXPECT_EQ(std::get<Aabb<double>>(scene.bodies[1].shape).half_extents, Vec3<double>(1, 2, 3));
  EXPECT_EQ(scene.bodies[1].mass, 7);
  EXPECT_EQ(scene.bodies[1].name, "crate");
  EXPECT_LT((size_of(scene.bodies[2]) - Vec3<double>(4, 2, 6)).norm(), 1e-12);  // turned by a right angle
  EXPECT_TRUE(scene.bodies[2].is_static);
  EXPECT_EQ(std::get<Capsule<double>>(scene.bodies[3].shape).b, Vec3<double>(0, 0, 2));
  EXPECT_EQ(scene.bodies[3].mass, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(scene.bodies[4].shape));
  EXPECT_EQ(scene.options.policy, TimePolicy::clamp);
  EXPECT_EQ(scene.options.gravity[1], -9.5);
  EXPECT_EQ(scene.duration(), 1.5);
}

TEST(SceneFile, copies_make_a_grid_with_ids_and_names_of_their_own) {
  const Scene scene = scene_from(
      ball + "name = 'ball'\nat = [1, 0, 0]\ncopies = [3, 2, 1]\nevery = [10, 20, 0]\n[[body]]\nshape = 'none'\n");
  ASSERT_EQ(scene.bodies.size(), 7U);
  EXPECT_EQ(box_of(scene.bodies[5]).center, Vec3<double>(21, 20, 0));
  EXPECT_EQ(scene.bodies[5].name, "ball 6");
  for (std::uint32_t i = 0; i < 7; ++i) EXPECT_EQ(scene.bodies[i].id, i + 1);
}

TEST(SceneFile, jitter_stays_within_its_widths_and_follows_the_seed) {
  const std::string text =
      ball + "copies = [20, 1, 1]\nevery = [10, 0, 0]\njitter = [1, 2, 0]\nvelocity_jitter = [0, 0, 6]\n";
  const Scene one = scene_from(text, {.seed = 1, .trials = {}}), two = scene_from(text, {.seed = 2, .trials = {}});
  const Scene again = scene_from(text, {.seed = 1, .trials = {}});
  double spread = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    const Vec3<double> at = box_of(one.bodies[i]).center - Vec3<double>(10 * static_cast<double>(i), 0, 0);
    EXPECT_LE(std::abs(at[0]), 0.5);
    EXPECT_LE(std::abs(at[1]), 1);
    EXPECT_EQ(at[2], 0);
    EXPECT_LE(std::abs(one.bodies[i].velocity[2]), 3);
    EXPECT_EQ(box_of(again.bodies[i]).center, box_of(one.bodies[i]).center);
    EXPECT_NE(box_of(two.bodies[i]).center, box_of(one.bodies[i]).center);
    spread = std::max(spread, std::abs(at[1]));
  }
  EXPECT_GT(spread, 0.5);
}

TEST(SceneFile, names_the_file_the_line_and_the_key) {
  expect_complaint(ball + "raduis = 2\n", {"my.toml:5: key 'body.raduis': unknown key; did you mean 'radius'?"});
  expect_complaint(ball + "mass = 0\n", {"my.toml:5: key 'body.mass': 0 is not allowed", "[kg]"});
  expect_complaint(ball + "velocity = [inf, 0, 0]\n",
                   {"my.toml:5: key 'body.velocity'", "a list of 3 numbers", "[m/s]"});
  expect_complaint(ball + "velocity = [1, 2]\n", {"key 'body.velocity'", "a list of 3 numbers"});
  expect_complaint(ball + "at = [nan, 0, 0]\n", {"key 'body.at'"});
  expect_complaint(ball + "restitution = 1.5\n", {"key 'body.restitution': 1.5 is not allowed"});
  expect_complaint(ball + "size = [1, 1, 1]\n", {"key 'body.size'", "it is not of shape 'sphere'"});
  expect_complaint(ball + "motion = 'static'\nvelocity = [1, 0, 0]\n", {"key 'body.velocity'", "the body is static"});
  expect_complaint(ball + "motion = 'driven'\nmass = 2\n", {"key 'body.mass'", "the body is driven"});
  expect_complaint(ball + "copies = [1.5, 1, 1]\n", {"key 'body.copies'", "three whole numbers"});
  expect_complaint(ball + "copies = [1000, 1000, 10]\n", {"key 'body.copies'", "at most 2000000 bodies"});
  expect_complaint("scene = 'a'\n[[body]]\nradius = 1\n", {"my.toml:2: key 'body.shape': missing"});
  expect_complaint("scene = 'a'\n[[body]]\nshape = 'sphere'\n", {"my.toml:2: key 'body.radius': missing"});
  expect_complaint("scene = 'a'\n[[body]]\nshape = 'shpere'\n", {"key 'body.shape'", "did you mean 'sphere'?"});
  expect_complaint("scene = 'a'\n[[body]]\nshape = 'capsule'\nradius = 1\nheight = 1\n",
                   {"key 'body.height': 1 is not allowed", "at least twice the radius"});
  expect_complaint("scene = 'a'\n[body]\nshape = 'none'\n", {"key 'body'", "[[body]]"});
  expect_complaint("scene = 'a b'\n", {"key 'scene'", "letters, digits"});
  expect_complaint("scene = 'a'\npolicy = 'sweep'\n", {"key 'policy'", "event_driven"});
  expect_complaint("scene = 'a'\ndt = 0\n", {"key 'dt': 0 is not allowed", "[s]"});
  expect_complaint("scene = 'a'\nsteps = 0\n", {"key 'steps'"});
  expect_complaint("scene = 'a'\nplan = 'fat'\n", {"key 'plan'", "lean, full"});
}

TEST(SceneFile, bounds_every_number_by_its_key) {
  const std::string scene = "scene = 'a'\n[[body]]\nshape = 'capsule'\nname = 'x'\n";
  const std::string sizes = "radius = 1\nheight = 2\n", push = sizes + "[[push]]\nbody = 'x'\n";
  for (const char* bad : {"nan", "inf", "-inf", "1e300", "-1e300", "4294967296", "-1"}) {
    const bool whole = bad == std::string("4294967296");
    const auto refuses = [&](const std::string& text, const std::string& key) {
      expect_complaint(text, {"my.toml:", "key '" + key + "': "});
    };
    const auto three = [&](const std::string& key) { return fmt::format("{} = [0, {}, 0]\n", key, bad); };
    const auto one = [&](const std::string& key) { return fmt::format("{} = {}\n", key, bad); };
    const auto list = [&](const std::string& key) { return fmt::format("[compare]\n{} = [{}]\n", key, bad); };
    if (!whole) {
      refuses(scene + one("radius") + "height = 2\n", "body.radius");
      refuses(scene + one("height") + "radius = 1\n", "body.height");
      refuses(scene + one("mass") + sizes, "body.mass");
      refuses(scene + one("restitution") + sizes, "body.restitution");
      refuses(scene + three("jitter") + sizes, "body.jitter");
      refuses(scene + three("velocity_jitter") + sizes, "body.velocity_jitter");
      refuses(one("correction") + scene + sizes, "correction");
      refuses(one("dt") + scene + sizes, "dt");
      refuses(scene + sizes + list("dt"), "compare.dt");
    }
    refuses(scene + one("id") + sizes, "body.id");
    refuses(scene + one("group") + sizes, "body.group");
    refuses(scene + one("mask") + sizes, "body.mask");
    refuses(scene + three("copies") + sizes, "body.copies");
    for (const char* count : {"steps", "substeps", "max_events", "contact_rounds", "end_after", "trace_every"})
      refuses(one(count) + scene + sizes, count);
    refuses(scene + sizes + "[compare]\n" + one("finer"), "compare.finer");
    refuses(scene + sizes + "[compare]\n" + one("repeats"), "compare.repeats");
    if (whole || bad == std::string("-1")) continue;  // a length, a speed and the like
    for (const char* key : {"at", "axis", "velocity", "every"}) {
      refuses(scene + three(key) + sizes, std::string("body.") + key);
    }
    refuses(scene + one("gravity_scale") + sizes, "body.gravity_scale");
    refuses(three("gravity") + scene + sizes, "gravity");
    refuses(scene + push + three("velocity"), "push.velocity");
  }
  expect_complaint(scene + sizes + "velocity = [1e300, 0, 0]\n", {">= -1e+30 and <= 1e+30 [m/s]"});
  expect_complaint(scene + sizes + "mass = 1e308\n", {">= 1e-30 and <= 1e+30 [kg]"});
}

/// At the ends of those ranges the longest step leaves numbers that a result can hold.
TEST(SceneFile, what_it_lets_in_can_be_stepped_and_kept) {
  const Scene scene = scene_from(R"(
scene = "ends"
dt = 1e6
steps = 3
gravity = [1e30, -1e30, 1e30]
[[body]]
shape = "sphere"
radius = 1e30
mass = 1e30
gravity_scale = 1e30
velocity = [1e30, 1e30, -1e30]
[[body]]
shape = "sphere"
radius = 1e-30
at = [1e30, 1e30, 1e30]
mass = 1e-30
gravity_scale = -1e30
restitution = 1
velocity = [-1e30, 1e30, -1e30]
)");
  const Playback playback = play(scene);
  EXPECT_TRUE(std::isfinite(playback.energy) && std::isfinite(playback.rows.back().energy));
  EXPECT_EQ(from_text<Playback>(to_text(playback)).rows.back().energy, playback.rows.back().energy);
}

TEST(SceneFile, an_axis_may_be_of_any_length) {
  const Scene scene =
      scene_from("scene = 'a'\n[[body]]\nshape = 'capsule'\nradius = 1\nheight = 6\naxis = [0, 3e-200, 4e-200]\n");
  EXPECT_LT((std::get<Capsule<double>>(scene.bodies[0].shape).b - Vec3<double>(0, 1.2, 1.6)).norm(), 1e-15);
}

TEST(SceneFile, ids_are_free_and_end_somewhere) {
  const std::string none = "[[body]]\nshape = 'none'\n";
  expect_complaint(ball + "id = 4\nname = 'one'\n" + none + "id = 4\n",
                   {"my.toml:9: key 'body.id': 4 is not allowed; a body before it has id 4"});
  expect_complaint(ball + "id = 4\n" + none + "id = 2\ncopies = [5, 1, 1]\n", {"a body before it has id 4"});
  expect_complaint(ball + "id = 4294967295\n", {"no complaint"});
  expect_complaint(ball + "id = 4294967295\n" + none,
                   {"my.toml:6: key 'body.id', left at its default: 0 is not allowed"});
  expect_complaint(ball + "id = 4294967295\ncopies = [2, 1, 1]\n", {"my.toml:5: key 'body.id': 4294967295", "takes 2"});
  const Scene scene = scene_from(ball + "id = 5\n" + none + "id = 4\n" + none + "copies = [2, 1, 1]\n" + none);
  std::vector<std::uint32_t> ids;
  for (const Body& body : scene.bodies) ids.push_back(body.id);
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{5, 4, 6, 7, 8})) << "the next that are free";
}

/// Two keys that do not go together: the one to blame may be the one that was not written.
TEST(SceneFile, names_the_users_file_where_a_default_does_not_fit) {
  expect_complaint("trace = true\nsteps = 100000\n" + ball + "copies = [100, 1, 1]\n",
                   {"my.toml:1: key 'trace_every', left at its default: 1 is not allowed"});
  expect_complaint(ball + "mask = -1\n", {"my.toml:5: key 'body.mask': -1 is not allowed"});
}

TEST(SceneFile, refuses_a_name_that_cannot_be_shown) {
  for (const char* bad : {R"(\n)", R"(\u001B[2J)", R"(\u007F)", R"(\u009B2J)", R"(\uFFFE)", R"(\uFFFF)"}) {
    expect_complaint(ball + "name = \"" + bad + "\"\n", {"my.toml:5: key 'body.name'", "a text of one line"});
  }
  for (const char* good : {"'", "\\\"", "]]>", "`", "\u00b5", "\U0001f3b1"}) {
    expect_complaint(ball + "name = \"" + good + "\"\n", {"no complaint"});
  }
}

TEST(SceneFile, names_what_is_not_there) {
  expect_complaint(ball + "[[body]]\nshape = 'none'\n\n", {"no complaint"});
  expect_complaint("broad_phase = 'octree'\n" + ball,
                   {"my.toml:1: key 'broad_phase': 'octree' is not allowed", "r_tree"});
}

TEST(SceneFile, pushes_name_a_body_that_moves) {
  const std::string named = ball + "name = 'left'\n";
  const Scene scene = scene_from(named + "[[push]]\nbody = 'left'\ntime = 2\nvelocity = [1, 0, 0]\n");
  ASSERT_EQ(scene.pushes.size(), 1U);
  EXPECT_EQ(scene.pushes[0].id, 1U);
  expect_complaint(named + "[[push]]\nbody = 'lfet'\n", {"key 'push.body'", "did you mean 'left'?"});
  expect_complaint(named + "[[push]]\ntime = 1\n", {"key 'push.body': missing"});
  expect_complaint(named + "[[push]]\nbody = 'left'\ntime = -1\n", {"key 'push.time'"});
  const std::string twin = "[[body]]\nshape = 'none'\nname = 'left'\n", left = "[[push]]\nbody = 'left'\n";
  expect_complaint(named + twin + left, {"key 'push.body': 'left' is not allowed", "one moving body alone"});
  expect_complaint(named + twin + "motion = 'static'\n" + left, {"no complaint"});  // what is static is never pushed
}

TEST(SceneFile, bounds_a_trace) {
  expect_complaint("trace = true\nsteps = 100000\n" + ball + "copies = [100, 1, 1]\n",
                   {"key 'trace_every'", "positions"});
}

TEST(SceneFile, steps_are_the_trials_of_the_command_line) {
  EXPECT_EQ(scene_from(ball, {.seed = 0, .trials = 7}).steps, 7);
}

}  // namespace
}  // namespace thinwall
