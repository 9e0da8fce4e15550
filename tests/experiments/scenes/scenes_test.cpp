/// What a scene file may say, and what it is told when it says something else.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/compare/compare.hpp>
#include <thinwall/experiments/scenes/scene.hpp>

#include "experiments/scenes/scene_text.hpp"
#include "support/experiment_run.hpp"
#include "support/program.hpp"

namespace thinwall {

namespace {

void expect_complaint(const std::string& text, const std::vector<std::string>& parts) {
  const std::string said = error_of<UsageError>([&] { scene_from(text); });
  for (const std::string& part : parts) EXPECT_TRUE(holds(said, part));
}

std::vector<nlohmann::json> json_lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<nlohmann::json> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
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
axis = [0, 0, 5e-200]
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
  expect_complaint("broad_phase = 'octree'\n" + ball,
                   {"my.toml:1: key 'broad_phase': 'octree' is not allowed", "r_tree"});
  // Two keys that do not go together: the one to blame may be the one that was not written.
  expect_complaint("trace = true\nsteps = 100000\n" + ball + "copies = [100, 1, 1]\n",
                   {"my.toml:1: key 'trace_every', left at its default: 1 is not allowed", "positions"});
}

TEST(SceneFile, says_what_turns_and_what_cannot) {
  const std::string rod = "scene = 'a'\n[[body]]\nshape = 'capsule'\nradius = 1\nheight = 6\n";
  const Scene scene =
      scene_from(rod + "angular_velocity = [0, 0, 3]\n" + "[[body]]\nshape = 'sphere'\nradius = 1\nturns = true\n" +
                 "[[body]]\nshape = 'sphere'\nradius = 1\n");
  EXPECT_TRUE(scene.bodies[0].turns);
  EXPECT_EQ(scene.bodies[0].angular_velocity, Vec3<double>(0, 0, 3));
  EXPECT_TRUE(scene.bodies[1].turns);
  EXPECT_FALSE(scene.bodies[2].turns);
  const std::string box = "scene = 'a'\n[[body]]\nshape = 'box'\nsize = [1, 1, 1]\n",
                    spins = "angular_velocity = [0, 0, 9]\n";
  expect_complaint(box + spins, {"my.toml:5: key 'body.angular_velocity': [0,0,9] is not allowed",
                                 "a box does not turn: write turned_box"});
  expect_complaint(box + "turns = true\n", {"my.toml:5: key 'body.turns'", "a box does not turn: write turned_box"});
  expect_complaint("scene = 'a'\n[[body]]\nshape = 'none'\n" + spins,
                   {"key 'body.angular_velocity'", "shape 'none' does not turn"});
  expect_complaint(rod + "motion = 'static'\n" + spins, {"key 'body.angular_velocity'", "zero: the body is static"});
  expect_complaint(rod + "turns = false\n" + spins, {"key 'body.turns'", "true: the body has an angular velocity"});
  expect_complaint(rod + "angular_velocity = [0, 2e6, 0]\n",
                   {"key 'body.angular_velocity'", ">= -1000000 and <= 1000000 [rad/s]"});
  expect_complaint(rod + "angular_velocty = [0, 2, 0]\n", {"did you mean 'angular_velocity'?"});
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
    for (const char* key : {"at", "axis", "velocity", "angular_velocity", "every"}) {
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

TEST(SceneFile, ids_are_free_and_end_somewhere) {
  const std::string none = "[[body]]\nshape = 'none'\n";
  expect_complaint(ball + "id = 4\nname = 'one'\n" + none + "id = 4\n",
                   {"my.toml:9: key 'body.id': 4 is not allowed; a body before it has id 4"});
  expect_complaint(ball + "id = 4\n" + none + "id = 2\ncopies = [5, 1, 1]\n", {"a body before it has id 4"});
  EXPECT_NO_THROW(scene_from(ball + "id = 4294967295\n"));
  expect_complaint(ball + "id = 4294967295\n" + none,
                   {"my.toml:6: key 'body.id', left at its default: 0 is not allowed"});
  expect_complaint(ball + "id = 4294967295\ncopies = [2, 1, 1]\n", {"my.toml:5: key 'body.id': 4294967295", "takes 2"});
  const Scene scene = scene_from(ball + "id = 5\n" + none + "id = 4\n" + none + "copies = [2, 1, 1]\n" + none);
  std::vector<std::uint32_t> ids;
  for (const Body& body : scene.bodies) ids.push_back(body.id);
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{5, 4, 6, 7, 8})) << "the next that are free";
}

TEST(SceneFile, refuses_a_name_that_cannot_be_shown) {
  for (const char* bad : {R"(\n)", R"(\u001B[2J)", R"(\u007F)", R"(\u009B2J)", R"(\uFFFE)", R"(\uFFFF)"}) {
    expect_complaint(ball + "name = \"" + bad + "\"\n", {"my.toml:5: key 'body.name'", "a text of one line"});
  }
  for (const char* good : {"'", "\\\"", "]]>", "`", "\u00b5", "\U0001f3b1"}) {
    EXPECT_NO_THROW(scene_from(ball + "name = \"" + good + "\"\n"));
  }
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
  EXPECT_NO_THROW(scene_from(named + twin + "motion = 'static'\n" + left));  // what is static is never pushed
}

TEST(SceneFile, steps_are_the_trials_of_the_command_line) {
  EXPECT_EQ(scene_from(ball, {.seed = 0, .trials = 7}).steps, 7);
  EXPECT_EQ(error_of<UsageError>([] { scene_from(ball, {.seed = 0, .trials = 1'000'001}); }),
            "--trials: 1000001 is not allowed; of a scene, its steps: a whole number from 1 to 1000000");
}

// ---- A scene, played: who goes through, who is told, and what is kept of it.

/// The failure is specified too: a step of 2/3 m, a wall of 1 cm.
TEST(Playback, a_discrete_step_goes_through_the_wall_and_the_referee_sees_it) {
  const Playback playback = play(scene_from(bullet_text("policy = 'discrete'\n")));
  EXPECT_EQ(playback.all_missed, 1);
  ASSERT_EQ(playback.missed.size(), 1U);
  EXPECT_NEAR(playback.missed[0].time, (1 - 0.025) / 40, 1e-12);
  EXPECT_EQ(playback.missed[0].first, 1U);
  EXPECT_EQ(playback.missed[0].second, 2U);
  EXPECT_EQ(playback.all_events, 0);
  EXPECT_EQ(playback.rows[1].tunneled, 1);
  EXPECT_GT(playback.places[0].x, 1);
}

/// A ball that a pose shows in the wall, before its middle, behind it, or in it and on its way out from the start.
TEST(Playback, what_a_pose_shows_behind_the_middle_is_pushed_through) {
  struct Case {
    double from, velocity;
    bool through;
  };
  for (const char* policy : {"policy = 'discrete'\n", "policy = 'substeps'\nsubsteps = 2\n"}) {
    for (const Case& c : {Case{-0.5, 29.4, false},
                          {-0.5, 30.6, true},
                          {0.5, -30.6, true},
                          {0.5, -29.4, false},
                          {0.02, 0.12, false},
                          {-0.02, -0.12, false},
                          {0.02, -0.12, false}}) {
      const Playback playback = play(scene_from(fmt::format(
          "scene = 'pose'\nsteps = 3\ncorrection = 0.5\n{}dt = 0.016666666666666666\n[[body]]\nshape = 'sphere'\nradius = 0.02\n"
          "restitution = 1\nat = [{}, 0, 0]\nvelocity = [{}, 0, 0]\n[[body]]\nshape = 'box'\nsize = [0.01, 2, 2]\nmotion = 'static'\n",
          policy, c.from, c.velocity)));
      EXPECT_EQ(playback.sums().counts.pushed_through, c.through ? 1 : 0) << policy << c.from << " at " << c.velocity;
      EXPECT_EQ(playback.places[0].x * c.from < 0, c.through) << policy << c.from << " at " << c.velocity;
      EXPECT_EQ(playback.all_missed, 0);
    }
  }
}

/// To and fro, 400 m at 60 m/s, which is more than 50 diagonals of the picture, and less than one at 0.1 m/s.
TEST(Playback, ways_are_drawn_until_they_cover_each_other) {
  const std::string wall = "[[body]]\nshape = 'box'\nsize = [0.1, 1, 1]\nmotion = 'static'\nat = [";
  const std::string flies =
      "scene = 'room'\nsteps = 400\n[[body]]\nshape = 'sphere'\nradius = 0.05\nrestitution = 1\nvelocity = ";
  const std::string room = wall + "-0.5, 0, 0]\n" + wall + "0.5, 0, 0]\n";
  const auto drawn = [](const std::string& text) { return outcome_of(scene_experiment(), text).figures[0]; };
  const Figure all = drawn(flies + "[0.1, 0, 0]\n" + room), part = drawn(flies + "[60, 0, 0]\n" + room);
  EXPECT_EQ(all.panels[0].series.back().x.size(), 401U);
  EXPECT_FALSE(holds(all.caption, "until"));
  EXPECT_GE(part.panels[0].series.back().x.size(), 20U);
  EXPECT_LT(part.panels[0].series.back().x.size(), 401U);
  EXPECT_TRUE(holds(part.caption, ", until "));
}

TEST(Playback, what_looks_at_all_of_the_motion_stops_at_it) {
  for (const char* policy : {"clamp", "event_driven"}) {
    const Playback playback = play(scene_from(bullet_text(std::string("policy = '") + policy + "'\n")));
    EXPECT_EQ(playback.all_missed, 0) << policy;
    ASSERT_FALSE(playback.events.empty()) << policy;
    EXPECT_NEAR(playback.events[0].time, (1 - 0.025) / 40, 1e-12) << policy;
    EXPECT_LT(playback.places[0].x, 0) << policy;
    EXPECT_NEAR(playback.rows.back().energy, playback.energy, 1e-9) << policy;
  }
}

TEST(Playback, the_referee_leaves_alone_what_passes_beside) {
  const std::string text =
      "scene = 'beside'\nsteps = 3\npolicy = 'discrete'\n[[body]]\nshape = 'sphere'\nradius = 0.5\n"
      "at = [-1, 1.51, 0]\nvelocity = [90, 0, 0]\n[[body]]\nshape = 'sphere'\nradius = 1\n";
  EXPECT_EQ(play(scene_from(text)).all_missed, 0);
  EXPECT_EQ(play(scene_from(text + "at = [0, 0.02, 0]\n")).all_missed, 1);
  EXPECT_EQ(play(scene_from(text + "at = [0, 0.02, 0]\nmask = 2\n")).all_missed, 0);  // they may not meet
}

/// They pass flush: 3.1 - 2.3 is more than 0.8 by three roundings, and neither comes nearer.
TEST(Playback, the_referee_takes_no_rounding_for_a_contact) {
  const std::string text =
      "scene = 'flush'\ndt = 0.1\nsteps = 3\n[[body]]\nshape = 'sphere'\nradius = 0.5\nat = [-0.5, 3.1, 0]\n"
      "velocity = [10, 10, 0]\n[[body]]\nshape = 'sphere'\nradius = 0.3\nat = [0, 2.3, 0]\nvelocity = [0, 10, 0]\n";
  EXPECT_EQ(play(scene_from(text)).all_missed, 0);
}

/// Arrows that a board stops come to lie on each other and fall together, apart by a rounding or touching by one.
TEST(Playback, what_lies_on_another_does_not_go_through_it) {
  const std::string text =
      "scene = 'pile'\npolicy = 'discrete'\ndt = 0.001\nsteps = 800\ngravity = [0, 0, -9.81]\n"
      "[[body]]\nname = 'arrow'\nshape = 'capsule'\nradius = 0.005\nheight = 0.6\naxis = [1, 0, 0]\nat = [-5, 0, 1]\n"
      "velocity = [60, 0, 0]\ncopies = [1, 4, 3]\nevery = [0, 0.2, 0.2]\njitter = [0.5, 0, 0]\n"
      "[[body]]\nname = 'board'\nshape = 'box'\nmotion = 'static'\nsize = [0.02, 4, 4]\nat = [0, 0, 1]\n"
      "[[push]]\ntime = 0.2\nbody = 'arrow 1'\nvelocity = [2, 0, 0]\n";
  EXPECT_EQ(play(scene_from(text)).all_missed, 0);
}

TEST(Playback, keeps_the_earliest_events) {
  const Playback playback = play(scene_from(
      "scene = 'many'\ndt = 1\nsteps = 1\nresponse = false\n[[body]]\nshape = 'sphere'\nradius = 0.1\n"
      "at = [0, -5500, 0]\nvelocity = [20000, 0, 0]\ncopies = [1, 11000, 1]\nevery = [0, 1, 0]\n[[body]]\nshape = 'turned_box'\n"
      "size = [0.5, 20000, 1]\nturn_deg = [0, 0, 30]\nat = [10000, 0, 0]\nmotion = 'static'\n"));
  EXPECT_EQ(playback.all_events, 11'000);
  ASSERT_EQ(playback.events.size(), 10'000U);
  EXPECT_EQ(playback.events.front().first, 11'000U);  // the highest meets the leaning wall first
}

TEST(Playback, a_hand_pushes_at_its_time) {
  const Playback playback =
      play(scene_from("scene = 'hand'\ndt = 0.3\nsteps = 5\n[[body]]\nname = 'ball'\nshape = 'sphere'\n"
                      "radius = 1\n[[push]]\nbody = 'ball'\ntime = 0.9\nvelocity = [10, 0, 0]\n"));
  ASSERT_LT(3 * 0.3, 0.9) << "to rounding";
  EXPECT_EQ(playback.tracks[0].x, (std::vector<double>{0, 0, 0, 0, 3, 6}));
}

TEST(Playback, survives_its_line) {
  const Playback playback = play(scene_from(bullet_text()));
  const auto again = from_text<Playback>(to_text(playback));
  EXPECT_EQ(to_text(again), to_text(playback));
  EXPECT_EQ(again.hash, playback.hash);
  EXPECT_EQ(again.events, playback.events);
  EXPECT_EQ(again.rows.back().energy, playback.rows.back().energy);
  EXPECT_EQ(again.places.front().x, playback.places.front().x);
}

/// The wall that the bullet goes through unseen is one that another ball touches in the same step.
TEST(Playback, sees_who_passes_what_another_touches) {
  const Playback playback =
      play(scene_from(bullet_text("policy = 'discrete'\n") +
                      "[[body]]\nshape = 'sphere'\nradius = 0.02\nat = [0, 0.5, 0]\nmotion = 'driven'\n"));
  EXPECT_EQ(playback.sums().counts.hits, 6);
  EXPECT_EQ(playback.all_missed, 1);
}

TEST(Playback, a_scene_with_none_is_stepped_through) {
  const Playback playback = play(scene_from("scene = 'none'\nsteps = 2\n"));
  EXPECT_EQ(playback.rows.size(), 2U);
  EXPECT_EQ(playback.all_events + playback.all_missed, 0);
}

TEST(SceneRun, hands_over_described_tables_and_a_verdict) {
  const Outcome outcome = outcome_of(scene_experiment(), bullet_text());
  EXPECT_TRUE(outcome.self_test_passed);
  EXPECT_EQ(table_of(outcome, "steps").rows.size(), 6U);
  EXPECT_EQ(value_of(table_of(outcome, "events"), 0, "first"), Value(std::string("bullet")));
  EXPECT_FALSE(table_of(outcome, "plan").rows.empty());
  EXPECT_TRUE(table_of(outcome, "timings").is_timing);
  expect_readable(outcome);
}

/// 42 balls through 150 walls, in 2100 steps: more than is kept of bodies, of steps and of events.
TEST(SceneRun, says_what_it_left_out) {
  const Outcome outcome = outcome_of(
      scene_experiment(),
      "scene = 'many'\nsteps = 2100\nresponse = false\n[[body]]\nshape = 'sphere'\nradius = 0.02\nat = [-0.5, -21, 0]\n"
      "velocity = [5, 0, 0]\ncopies = [1, 42, 1]\nevery = [0, 1, 0]\n[[body]]\nshape = 'box'\nmotion = 'static'\n"
      "size = [0.1, 50, 1]\ncopies = [150, 1, 1]\nevery = [1, 0, 0]\n");
  EXPECT_EQ(table_of(outcome, "events").rows.size(), 10'000U);
  EXPECT_TRUE(holds(outcome.summary, " 9,988 more in data/events.csv\n"));
  EXPECT_TRUE(holds(outcome.summary, " 2,600 after them in no file\n"));
  EXPECT_EQ(outcome.figures[0].title, "Where the bodies were every 2 steps");
  EXPECT_TRUE(outcome.figures[0].caption.starts_with(
      "The center of 40 of the 42 bodies that move, evenly spread, every 2 steps; "));
}

/// 500 boxes far from where anything moves, and then the wall, which is drawn all the same.
TEST(SceneRun, what_lies_outside_the_picture_takes_no_outline) {
  const std::string far =
      "[[body]]\nshape = 'box'\nmotion = 'static'\nat = [0, 100, 0]\nsize = [1, 1, 1]\ncopies = [500, 1, 1]\n"
      "every = [2, 0, 0]\n";
  std::string text = bullet_text();
  text.insert(text.find("[[body]]"), far);
  const Outcome with = outcome_of(scene_experiment(), text), without = outcome_of(scene_experiment(), bullet_text());
  EXPECT_EQ(with.figures[0].panels[0].series[0].x, without.figures[0].panels[0].series[0].x);
  EXPECT_TRUE(holds(with.figures[0].caption, "; what stays, as the box that holds it"));
  const Outcome alone = outcome_of(scene_experiment(), ball);
  EXPECT_TRUE(alone.figures[0].caption.ends_with("at the end of each step.")) << "nothing stays";
  for (const Panel& panel : alone.figures[1].panels) {
    for (const Series& series : panel.series) EXPECT_EQ(series.x.front(), 0) << series.label;
  }
}

/// A policy that claims to miss nothing, and did.
TEST(SceneRun, a_broken_claim_fails_the_self_test) {
  const Scene scene = scene_from(bullet_text());
  Playback playback = play(scene);
  EXPECT_TRUE(claims_held(scene, playback));
  playback.all_missed = 1;
  EXPECT_FALSE(claims_held(scene, playback));
  EXPECT_FALSE(run_of(scene_experiment(), bullet_text())->finish({to_text(playback)}, {1}).self_test_passed);
  playback.all_missed = 0;
  ++playback.live;  // a contact that never began
  EXPECT_FALSE(claims_held(scene, playback));
  const Scene discrete = scene_from(bullet_text("policy = 'discrete'\n"));
  EXPECT_TRUE(claims_held(discrete, play(discrete)));  // it claims nothing
}

TEST(SceneRun, traces_what_a_viewer_needs) {
  const Scene scene = scene_from(bullet_text("trace_every = 4\n"));
  const std::vector<nlohmann::json> lines = json_lines(trace_of(scene));
  ASSERT_EQ(lines.size(), 4U);  // the bodies; steps 0, 4 and 6
  EXPECT_EQ(lines[0]["bodies"][0]["name"], "bullet");
  EXPECT_EQ(lines[0]["bodies"][0]["shape"]["type"], "sphere");
  EXPECT_EQ(lines[0]["bodies"][1]["static"], true);
  EXPECT_EQ(lines[1]["at"].size(), 1U);  // of what moves
  EXPECT_EQ(lines[3]["at"][0][0], play(scene).places[0].x);
  const Outcome outcome = outcome_of(scene_experiment(), bullet_text("trace = true\n"));
  ASSERT_EQ(outcome.files.size(), 1U);
  EXPECT_EQ(outcome.files[0].name, "trace.jsonl");
}

/// A quarter turn in two steps; a trace of what does not turn has no such key.
TEST(SceneRun, traces_how_bodies_turn) {
  const std::string text =
      "scene = 'turns'\ndt = 0.5\nsteps = 2\n[[body]]\nshape = 'capsule'\nradius = 1\nheight = 6\naxis = [1, 0, 0]\n"
      "angular_velocity = [0, 0, 1.5707963267948966]\n[[body]]\nshape = 'turned_box'\nsize = [1, 1, 1]\nat = [9, 0, 0]\nturns = true\n"
      "[[body]]\nshape = 'sphere'\nradius = 1\nat = [0, 0, 9]\nangular_velocity = [0, 5, 0]\n";
  const std::vector<nlohmann::json> lines = json_lines(trace_of(scene_from(text)));
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[1]["turning"][0]["half_core"], nlohmann::json({2.0, 0.0, 0.0}));
  const nlohmann::json& rod = lines[3]["turning"][0];
  EXPECT_EQ(rod["id"], 1);
  EXPECT_NEAR(rod["half_core"][1].get<double>(), 2, 1e-12);
  EXPECT_EQ(rod["angular_velocity"][2], 1.5707963267948966);
  EXPECT_EQ(lines[3]["turning"][1]["axes"].size(), 3U);
  EXPECT_EQ(lines[3]["turning"][2]["angular_velocity"][1], 5);
  EXPECT_FALSE(holds(trace_of(scene_from(bullet_text())), "turning"));
}

// ---- The scenes that come with the program: each is read, and gives the same bits whatever its plan leaves out.

std::vector<std::filesystem::path> shipped() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(THINWALL_SCENES)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The scene, short, and of the many alike only some: a test is not a benchmark.
Scene shortened(const std::filesystem::path& file, const std::string& plan) {
  Settings settings = scene_settings(read_text(file));
  settings.assign("plan", plan);
  Scene scene = read_scene(settings, {.seed = 1, .trials = 40});
  std::vector<Body> few;
  for (const Body& body : scene.bodies) {
    if (body.is_static || few.size() < 120) few.push_back(body);
  }
  scene.bodies = few;
  return scene;
}

TEST(ShippedScenes, are_eleven_with_names_of_their_files) {
  std::set<std::string> names;
  for (const auto& file : shipped()) {
    const Scene scene = read_scene(scene_settings(read_text(file)), {});
    EXPECT_EQ(scene.name, file.stem()) << file;
    names.insert(scene.name);
    if (scene.name == "rain") {
      EXPECT_EQ(scene.bodies.size(), 100'001U);
    }
    EXPECT_NO_THROW(read_comparison(scene_settings(read_text(file)), {})) << file;
  }
  EXPECT_EQ(names.size(), 11U);
  EXPECT_TRUE(names.contains("rain"));
}

TEST(ShippedScenes, give_the_same_bits_lean_or_full_and_let_nothing_through) {
  for (const auto& file : shipped()) {
    const Playback lean = play(shortened(file, "lean")), full = play(shortened(file, "full"));
    EXPECT_EQ(lean.hash, full.hash) << file;
    EXPECT_EQ(lean.events, full.events) << file;
    EXPECT_EQ(lean.all_missed, 0) << file;
    EXPECT_EQ(full.all_missed, 0) << file;
  }
}

/// Twenty discrete steps of a room of thin walls, or of bullets: something gets through.
TEST(ShippedScenes, let_things_through_when_discrete) {
  for (const char* name : {"thin_wall_gallery", "bullet_against_bullet", "spinning_rods", "propeller"}) {
    Scene scene = shortened(fmt::format("{}/{}.toml", THINWALL_SCENES, name), "lean");
    scene.options.policy = TimePolicy::discrete;
    EXPECT_GT(play(scene).all_missed, 0) << name;
  }
}

}  // namespace

}  // namespace thinwall
