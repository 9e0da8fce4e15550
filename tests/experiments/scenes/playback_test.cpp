/// A scene, played: who goes through, who is told, and what is kept of it.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/scenes/comparison.hpp>
#include <thinwall/experiments/scenes/scene.hpp>

#include "experiments/scenes/scene_text.hpp"
#include "support/experiment_run.hpp"

namespace thinwall {
namespace {

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

TEST(Playback, a_hand_pushes_at_its_time) {
  const Playback playback =
      play(scene_from("scene = 'hand'\ndt = 0.5\nsteps = 4\n[[body]]\nname = 'ball'\nshape = 'sphere'\n"
                      "radius = 1\n[[push]]\nbody = 'ball'\ntime = 0.6\nvelocity = [2, 0, 0]\n"));
  EXPECT_EQ(playback.tracks[0].x, (std::vector<double>{0, 0, 0, 1, 2}));
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

TEST(Playback, a_scene_with_none_is_stepped_through) {
  const Playback playback = play(scene_from("scene = 'none'\nsteps = 2\n"));
  EXPECT_EQ(playback.rows.size(), 2U);
  EXPECT_EQ(playback.all_events + playback.all_missed, 0);
}

TEST(SceneRun, hands_over_described_tables_and_a_verdict) {
  const Outcome outcome = outcome_of(*run_of(scene_experiment(), bullet_text()));
  EXPECT_TRUE(outcome.self_test_passed);
  EXPECT_EQ(table_of(outcome, "steps").rows.size(), 6U);
  EXPECT_EQ(value_of(table_of(outcome, "events"), 0, "first"), Value(std::string("bullet")));
  EXPECT_FALSE(table_of(outcome, "plan").rows.empty());
  EXPECT_TRUE(table_of(outcome, "timings").is_timing);
  for (const Table& table : outcome.tables) {
    for (const auto& row : table.rows) ASSERT_EQ(row.size(), table.columns.size()) << table.name;
  }
  std::istringstream summary(outcome.summary);
  for (std::string line; std::getline(summary, line);) EXPECT_LE(line.size(), 100U) << line;
}

/// A policy that claims to miss nothing, and did.
TEST(SceneRun, a_broken_claim_fails_the_self_test) {
  const Scene scene = scene_from(bullet_text());
  Playback playback = play(scene);
  EXPECT_TRUE(claims_held(scene, playback));
  playback.all_missed = 1;
  EXPECT_FALSE(claims_held(scene, playback));
  playback.all_missed = 0;
  ++playback.live;  // a contact that never began
  EXPECT_FALSE(claims_held(scene, playback));
  const Scene discrete = scene_from(bullet_text("policy = 'discrete'\n"));
  EXPECT_TRUE(claims_held(discrete, play(discrete)));  // it claims nothing
}

TEST(SceneRun, traces_what_a_viewer_needs) {
  Scene scene = scene_from(bullet_text("trace_every = 4\n"));
  std::istringstream trace(trace_of(scene));
  std::vector<nlohmann::json> lines;
  for (std::string line; std::getline(trace, line);) lines.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(lines.size(), 4U);  // the bodies; steps 0, 4 and 6
  EXPECT_EQ(lines[0]["bodies"][0]["name"], "bullet");
  EXPECT_EQ(lines[0]["bodies"][0]["shape"]["type"], "sphere");
  EXPECT_EQ(lines[0]["bodies"][1]["static"], true);
  EXPECT_EQ(lines[1]["at"].size(), 1U);  // of what moves
  EXPECT_EQ(lines[3]["at"][0][0], play(scene).places[0].x);
  const Outcome outcome = outcome_of(*run_of(scene_experiment(), bullet_text("trace = true\n")));
  ASSERT_EQ(outcome.files.size(), 1U);
  EXPECT_EQ(outcome.files[0].name, "trace.jsonl");
}

/// Bits do not depend on threads, nor on what the plan leaves out.
TEST(SceneRun, threads_and_plan_change_no_bit) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3}) {
    for (const char* plan : {"lean", "full"}) {
      Settings settings = scene_settings(
          "scene = 'many'\nsteps = 20\ngravity = [0, -9, 0]\n[[body]]\nshape = 'sphere'\n"
          "radius = 0.2\nrestitution = 0.5\ncopies = [4, 4, 2]\nevery = [1, 1, 1]\n"
          "velocity_jitter = [30, 30, 30]\n[[body]]\nshape = 'box'\nmotion = 'static'\n"
          "size = [20, 0.1, 20]\nat = [0, -1, 0]\n");
      settings.assign("plan", plan);
      const std::uint64_t hash = play(read_scene(settings, {.seed = 3, .trials = {}, .threads = threads})).hash;
      if (first == 0) first = hash;
      EXPECT_EQ(hash, first) << threads << " " << plan;
    }
  }
}

}  // namespace
}  // namespace thinwall
