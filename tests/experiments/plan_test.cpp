/// The experiment plan: its scenes, its verdicts and its words, never its times.

#include <sstream>

#include <gtest/gtest.h>

#include <thinwall/experiments/program/program.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/world.hpp>

#include "experiments/plan_run.hpp"
#include "experiments/world/random_world.hpp"

namespace thinwall {
namespace {

TEST(Plan, takes_back_each_omission_alone_and_changes_no_bit) {
  for (const PlanRace& race : few_results().races) {
    EXPECT_TRUE(is_right(race)) << race.scene;
    for (const Way& way : race.ways) {
      if (way.name == gate_way) continue;
      EXPECT_EQ(way.outcome, race.ways.front().outcome) << race.scene << ": " << way.name;
      EXPECT_GE(way.sweeps, race.ways.front().sweeps) << race.scene << ": " << way.name;
      EXPECT_EQ(way.milliseconds.size(), 2U);
    }
    const PlanRace again = plan_race_from_line(to_line(race));
    EXPECT_EQ(to_line(again), to_line(race));
  }
}

TEST(Plan, has_scenes_that_need_everything_something_and_nothing) {
  const PlanResults results = few_results();
  const auto omits = [&](std::size_t k, const char* what) { return way_named(results.races[k], what) != nullptr; };
  ASSERT_EQ(plan_scene_names()[0], "crowd");
  EXPECT_FALSE(omits(0, "static pairs") || omits(0, "response") || omits(0, "kernels of absent shapes"));
  ASSERT_EQ(plan_scene_names()[2], "town");
  EXPECT_TRUE(omits(2, "static pairs") && omits(2, "masked pairs") && omits(2, "kernels of absent shapes"));
  EXPECT_FALSE(omits(2, "response") || omits(2, "events") || omits(2, "contacts"));
  EXPECT_TRUE(omits(3, "response") && omits(4, "events") && omits(5, "contacts"));
  for (const std::size_t k : {0U, 2U, 3U, 4U}) EXPECT_GT(results.races[k].ways.front().hits, 0) << k;
  const PlanRace& town = results.races[2];
  for (const char* const what : {"static pairs", "masked pairs", "pairs of disjoint boxes", full_way}) {
    EXPECT_GT(way_named(town, what)->sweeps, town.ways.front().sweeps) << what;
  }
}

TEST(Plan, can_keep_whatever_it_could_omit_and_nothing_else) {
  const PlanScene scene = make_plan_scene("unasked", 40, 1);
  std::vector<std::string> whats;
  const Plan lean = plan(scene.bodies, scene.options);
  for (const PlanLine& line : lean.lines) {
    whats.push_back(line.what);
    WorldOptions kept = scene.options;
    kept.keep = {line.what};
    const Plan keeping = plan(scene.bodies, kept);
    for (const PlanLine& other : keeping.lines) {
      EXPECT_EQ(other.omitted, other.what != line.what) << line.what << " kept: " << other.what;
    }
  }
  const auto names = omission_names();
  EXPECT_EQ(whats, std::vector<std::string>(names.begin(), names.end()));
  WorldOptions options;
  options.keep = {"static bodies"};
  EXPECT_THROW(World({}, options), WorldError);
}

/// Random worlds of all shapes, policies and masks.
TEST(Plan, of_any_world_gives_the_same_bits_with_any_single_omission_taken_back) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const testing::DrawnWorld drawn = testing::drawn_world(seed);
    if (!drawn.options.response && !drawn.options.events) continue;  // hits that nobody asked for may differ
    const auto names = omission_names();
    WorldOptions kept = drawn.options;
    kept.keep = {std::string(names[seed % names.size()])};
    World world(drawn.bodies, drawn.options), other(drawn.bodies, kept);
    for (int k = 0; k < drawn.steps; ++k) {
      world.step(drawn.dt);
      other.step(drawn.dt);
      ASSERT_EQ(world.state_hash(), other.state_hash()) << "seed " << seed << ", kept: " << kept.keep[0];
      ASSERT_EQ(world.events().events(), other.events().events()) << "seed " << seed;
      ASSERT_EQ(world.hits().size(), other.hits().size()) << "seed " << seed;
      for (std::size_t i = 0; i < world.hits().size(); ++i) {
        ASSERT_EQ(world.hits()[i].time, other.hits()[i].time) << "seed " << seed;
        ASSERT_EQ(world.hits()[i].point, other.hits()[i].point) << "seed " << seed;
      }
    }
  }
}

TEST(PlanGate, misses_what_theory_says) {
  EXPECT_EQ(missed_by_gate({GateTarget::wall, 4.2, 4, 1}), 0);  // swept
  EXPECT_DOUBLE_EQ(missed_by_gate({GateTarget::wall, 4.2, 5, 1}), 0.5);
  EXPECT_EQ(missed_by_gate({GateTarget::wall, 2, 5, 1}), 0);
  EXPECT_DOUBLE_EQ(missed_by_gate({GateTarget::ball, 4, 5, 1}), 1.0 / 3);
  EXPECT_DOUBLE_EQ(missed_by_gate({GateTarget::ball, 8, 9, 1}), 2.0 / 3);
}

TEST(PlanGate, shots_are_all_seen_without_it_and_never_told_early) {
  for (const double gate : {0.5, 4.0}) {
    const GateTally tally = shoot_at_gate({GateTarget::wall, 3, gate, 500}, 1, 3);
    EXPECT_EQ(tally.missed_swept, 0);
    EXPECT_EQ(tally.early, 0);
    EXPECT_EQ(tally.missed > 0, gate > 3);
    EXPECT_EQ(tally.gated > 0, gate > 3);
    EXPECT_EQ(to_line(gate_tally_from_line(to_line(tally))), to_line(tally));
  }
}

TEST(Plan, self_test_fails_a_bit_that_differs_a_wrong_count_and_an_early_meeting) {
  const PlanResults right = few_results();
  EXPECT_TRUE(all_right(right));
  PlanResults wrong = right;
  wrong.races[2].ways[1].outcome ^= 1;
  EXPECT_FALSE(all_right(wrong));
  EXPECT_NE(plan_answer(wrong).find("1 of"), std::string::npos);
  wrong = right;
  wrong.races[2].ways[1].repeated_alike = false;
  EXPECT_FALSE(all_right(wrong));
  wrong = right;
  wrong.races[0].ways.back().outcome ^= 1;  // the gate's may differ
  EXPECT_TRUE(all_right(wrong));
  wrong.shots[0].tally.missed = 0;  // of 400, where 120 are due
  EXPECT_FALSE(all_right(wrong));
  wrong = right;
  wrong.shots[0].tally.early = 1;
  EXPECT_FALSE(all_right(wrong));
  wrong = right;
  wrong.shots[1].tally.missed_swept = 1;
  EXPECT_FALSE(all_right(wrong));
}

TEST(Plan, says_the_same_of_outcomes_in_every_run_and_fits_the_terminal) {
  const Outcome first = outcome_of(*plan_run(few_steps)), second = outcome_of(*plan_run(few_steps));
  EXPECT_TRUE(first.self_test_passed) << first.summary;
  for (const char* const name : {"ways", "gate"}) {
    EXPECT_EQ(table_of(first, name).rows, table_of(second, name).rows);
    EXPECT_FALSE(table_of(first, name).is_timing);
  }
  for (const Table& t : first.tables) {
    for (const auto& row : t.rows) EXPECT_EQ(row.size(), t.columns.size()) << t.name;
  }
  EXPECT_TRUE(table_of(first, "savings").is_timing);
  EXPECT_NE(first.answer.find("No omission changes a bit"), std::string::npos);
  std::istringstream text(first.summary);
  for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 100U) << line;
}

TEST(Plan, is_an_experiment_after_run_and_a_command_alone) {
  const std::vector<Experiment> experiments = {plan_experiment()};
  std::ostringstream out, err;
  EXPECT_EQ(run_program({"thinwall", "run", "plan", "--trace"}, experiments, out, err), 2);  // the experiment was found
  EXPECT_EQ(run_program({"thinwall", "plan", "no_such_file.toml"}, experiments, out, err), 2);
  EXPECT_EQ(err.str(), "--trace: only a scene has a trace\nno_such_file.toml: there is no such file\n");
}

TEST(Plan, refuses_what_is_no_line_of_it) {
  EXPECT_THROW(plan_race_from_line("nonsense"), std::runtime_error);
  EXPECT_THROW(plan_race_from_line("{}"), std::runtime_error);
  EXPECT_THROW(gate_tally_from_line("[1, 2]"), std::runtime_error);
}

TEST(Plan, names_the_setting_that_is_out_of_range) {
  for (const auto& [key, text] : {std::pair{"scene", "scene = [\"village\"]"},
                                  {"count", "count = 1"},
                                  {"steps", "steps = 0"},
                                  {"rounds", "rounds = 0"},
                                  {"gate", "gate = 0"},
                                  {"shots", "shots = 0"},
                                  {"shot_path", "shot_path = [0]"},
                                  {"shot_gate", "shot_gate = [-1]"},
                                  {"shot_path", "shot_path = [2]\nshot_gate = [2]"}}) {
    try {
      plan_run(text);
      FAIL() << text;
    } catch (const UsageError& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find(key), std::string::npos) << text << ": " << said;
      EXPECT_EQ(said.find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace thinwall
