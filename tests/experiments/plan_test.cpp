/// The experiment plan: its scenes, its verdicts and its words, never its times.

#include <algorithm>

#include <gtest/gtest.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/plan/model.hpp>
#include <thinwall/experiments/world.hpp>

#include "support/experiment_run.hpp"
#include "support/reply.hpp"

namespace thinwall {
namespace {

/// The races of few steps, scene by scene.
const std::vector<PlanRace>& few_races() {
  static const std::vector<PlanRace> all = [] {
    std::vector<PlanRace> races;
    for (const std::string_view name : plan_scene_names)
      races.push_back(race_plans(make_plan_scene(name, 60, 5), {.steps = 8, .rounds = 2, .gate = 0.5}));
    return races;
  }();
  return all;
}

TEST(Plan, takes_back_each_omission_alone_and_changes_no_bit) {
  for (const PlanRace& race : few_races()) {
    EXPECT_TRUE(is_right(race)) << race.scene;
    for (const Way& way : race.ways) {
      if (way.name == gate_way) continue;
      EXPECT_EQ(way.outcome, race.ways.front().outcome) << race.scene << ": " << way.name;
      EXPECT_GE(way.sweeps, race.ways.front().sweeps) << race.scene << ": " << way.name;
      EXPECT_EQ(way.milliseconds.size(), 2U);
    }
  }
}

TEST(Plan, has_scenes_that_need_everything_something_and_nothing) {
  const std::vector<PlanRace>& races = few_races();
  const auto find = [&](std::size_t k, std::string_view what) {
    return std::ranges::find(races[k].ways, what, &Way::name);
  };
  const auto omits = [&](std::size_t k, std::string_view what) { return find(k, what) != races[k].ways.end(); };
  ASSERT_EQ(plan_scene_names[0], "crowd");
  EXPECT_FALSE(omits(0, "static pairs") || omits(0, "response") || omits(0, "kernels of absent shapes"));
  ASSERT_EQ(plan_scene_names[2], "town");
  EXPECT_TRUE(omits(2, "static pairs") && omits(2, "masked pairs") && omits(2, "kernels of absent shapes"));
  EXPECT_FALSE(omits(2, "response") || omits(2, "events") || omits(2, "contacts"));
  EXPECT_TRUE(omits(3, "response") && omits(4, "events") && omits(5, "contacts"));
  for (const std::size_t k : {0U, 2U, 3U, 4U}) EXPECT_GT(races[k].ways.front().hits, 0) << k;
  const PlanRace& town = races[2];
  for (const std::string_view what : {std::string_view("static pairs"), std::string_view("masked pairs"),
                                      std::string_view("pairs of disjoint boxes"), full_way}) {
    ASSERT_TRUE(omits(2, what)) << what;
    EXPECT_GT(find(2, what)->sweeps, town.ways.front().sweeps) << what;
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
  EXPECT_EQ(whats, std::vector<std::string>(omission_names.begin(), omission_names.end()));
  WorldOptions options;
  options.keep = {"static bodies"};
  EXPECT_THROW(World({}, options), WorldError);
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
    EXPECT_EQ(tally.late > 0, gate > 3);
    EXPECT_LT(tally.late, 1) << "a step";
  }
}

TEST(PlanGate, self_test_fails_a_wrong_count_an_early_meeting_and_a_miss_without_it) {
  std::vector<GateRow> rows;
  for (const GateTarget target : {GateTarget::wall, GateTarget::ball}) {
    const GateCell cell{target, 3, 4, 400};
    rows.push_back({cell, shoot_at_gate(cell, 1, 5)});
  }
  const auto is_right_with = [&](std::size_t row, std::int64_t GateTally::*count, std::int64_t made_up) {
    std::vector<GateRow> changed = rows;
    changed[row].tally.*count = made_up;
    return gate_is_right(changed);
  };
  EXPECT_TRUE(gate_is_right(rows));
  std::vector<GateRow> again = rows;  // the same shots at a wider gate are no more evidence
  again.push_back(rows[0]);
  again.back().cell.gate = 5;
  EXPECT_EQ(gate_self_test(again)[0].judged_cells, 1);
  EXPECT_FALSE(is_right_with(0, &GateTally::missed, 0));  // of 400, where 120 are due
  EXPECT_FALSE(is_right_with(0, &GateTally::early, 1));
  EXPECT_FALSE(is_right_with(1, &GateTally::missed_swept, 1));
}

TEST(Plan, self_test_fails_a_bit_that_differs_and_a_pair_that_passes_unseen) {
  const auto is_right_with = [](const auto& spoil) {
    PlanRace race = few_races()[2];
    spoil(race);
    return is_right(race);
  };
  EXPECT_FALSE(is_right_with([](PlanRace& race) { race.ways[1].outcome ^= 1; }));
  EXPECT_FALSE(is_right_with([](PlanRace& race) { race.ways[1].repeated_alike = false; }));
  EXPECT_FALSE(is_right_with([](PlanRace& race) { race.ways[0].tunneled = 1; }));
  EXPECT_TRUE(is_right_with([](PlanRace& race) { race.ways.back().outcome ^= 1; }));  // the gate's may differ
}

/// Whatever a unit of the run finds decides: the last one here is made up.
TEST(Plan, says_of_a_whole_run_what_its_units_found) {
  const auto run = run_of(plan_experiment(),
                          "scene = [\"town\"]\ncount = 60\nsteps = 8\nrounds = 1\nshots = 300\n"
                          "shot_path = [3]\nshot_gate = [4]");
  std::vector<std::string> results = results_of(run->units());
  ASSERT_EQ(results.size(), 3U);
  const std::vector<double> seconds(results.size(), 1);
  const Outcome right = run->finish(results, seconds);
  EXPECT_TRUE(right.self_test_passed);
  EXPECT_TRUE(holds(right.answer, "No omission changes a bit"));
  auto tally = from_text<GateTally>(results[2]);
  tally.early = 1;
  EXPECT_FALSE(run->finish({results[0], results[1], to_text(tally)}, seconds).self_test_passed);
  auto race = from_text<PlanRace>(results[0]);
  race.ways[1].outcome ^= 1;
  const Outcome wrong = run->finish({to_text(race), results[1], results[2]}, seconds);
  EXPECT_FALSE(wrong.self_test_passed);
  EXPECT_EQ(wrong.answer.find("1 of"), 0U) << wrong.answer;
  EXPECT_EQ(value_of(table_of(wrong, "ways"), 1, "same_as_plan"), Value(false));
}

TEST(Plan, is_an_experiment_after_run_and_a_command_alone) {
  const auto call = [](const Words& words) { return call_program(words, {plan_experiment()}); };
  EXPECT_EQ(refusal(call({"run", "plan", "--trace"})), "--trace: only a scene has a trace\n");  // it was found
  EXPECT_EQ(refusal(call({"plan", "no_such_file.toml"})),
            "no_such_file.toml: there is no such file; the TOML file of an experiment or a scene is needed\n");
}

TEST(Plan, refuses_a_path_that_is_a_gate) {
  expect_refusals(plan_experiment(), {{"shot_path = [2]\nshot_gate = [2]", "any but 2, which is a gate"}});
}

}  // namespace
}  // namespace thinwall
