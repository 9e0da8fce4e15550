/// The stages that engines play: what is right on each, on flights made up by hand and in our world, and what passes where only poses are
/// looked at.

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/engines/stages.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/random.hpp>

#include "support/experiment_run.hpp"
#include "support/said.hpp"

namespace thinwall {

namespace {

constexpr StageSize meter = {.path = 1, .step = 1.0 / 60, .radius = 0.05, .thickness = 0.01};

const StageKind& stage_called(std::string_view name) {
  return *std::ranges::find(stage_kinds(), name, &StageKind::name);
}

EnginePlan stage_plan(const std::string& text, std::int64_t shots) {
  const std::string shown = text + "\npath = [1]\nwall_size = [250]";
  return make_engine_plan(Settings(shown, "test.toml", engines_experiment().default_toml),
                          {.seed = 1, .trials = shots});
}

std::vector<StageRow> played(const EnginePlan& plan) {
  std::vector<StageRow> rows = stage_rows(plan);
  for (StageRow& row : rows) row.tally = play(row, 0, plan.stage_shots, plan.seed);
  return rows;
}

/// Where bodies that meet nothing are at the end of each step.
EngineFlights::Flight straight(const StageShot& shot, const StageSize& size, std::int64_t steps) {
  EngineFlights::Flight flight;
  std::vector<BodyState> at = shot.start;
  for (std::int64_t i = 0; i < steps; ++i) {
    for (BodyState& body : at) body.position += size.step * body.velocity;
    flight.push_back(at);
  }
  return flight;
}

TEST(EngineStages, tell_who_passes_from_who_flies_away) {
  for (const StageKind& kind : stage_kinds()) {
    for (std::uint64_t i = 0; i < 200; ++i) {
      const StageShot shot = kind.shot(meter, random_words({3, 4}, i, 0));
      EXPECT_EQ(shot.start.size(), kind.stage(meter).moving.size()) << kind.name;
      StageTally tally;
      EngineFlights::Flight flight = straight(shot, meter, kind.steps);
      judge(kind, shot, flight, tally);
      EXPECT_EQ(tally.passed, kind.name == "near_miss" ? 0 : 1) << kind.name << " " << i;
      EXPECT_EQ(tally.disturbed, 0) << kind.name << " " << i;

      StageTally turned;  // where it was, with the velocity that is right
      flight = {shot.start};
      if (shot.velocity) flight.back().front().velocity = *shot.velocity;
      judge(kind, shot, flight, turned);
      EXPECT_EQ(turned.passed + turned.disturbed + turned.lost, 0) << kind.name << " " << i;
      EXPECT_EQ(turned.most_error, shot.velocity ? 0 : no_most) << kind.name << " " << i;
    }
  }
}

TEST(EngineStages, count_what_is_off_by_more_than_a_hundredth) {
  const StageKind& kind = stage_called("near_miss");
  const StageShot shot = kind.shot(meter, random_words({3, 4}, 0, 0));
  const auto off_by = [&](double share) {
    StageTally tally;
    EngineFlights::Flight flight = {shot.start};
    flight.back().front().velocity[1] += share * shot.velocity->norm();
    judge(kind, shot, flight, tally);
    return tally;
  };
  EXPECT_EQ(off_by(0.009).disturbed, 0);
  EXPECT_EQ(off_by(0.011).disturbed, 1);
  EXPECT_NEAR(off_by(0.5).most_error, 0.5, 1e-12);
  const StageTally lost = off_by(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(lost.lost, 1);
  EXPECT_EQ(lost.disturbed, 0);
}

TEST(EngineStages, along_a_wall_count_what_is_lost_along_it) {
  const StageKind& kind = stage_called("tiles");
  const StageShot shot = kind.shot(meter, random_words({3, 4}, 0, 0));
  StageTally tally;
  EngineFlights::Flight flight = {shot.start};
  flight.back().front().velocity = {0, shot.velocity->y(), 0};  // stopped by the wall, not along it
  judge(kind, shot, flight, tally);
  EXPECT_EQ(tally.disturbed, 0);
  flight.back().front().velocity[1] += 0.02 * shot.velocity->norm();
  judge(kind, shot, flight, tally);
  EXPECT_EQ(tally.disturbed, 1);
}

TEST(EngineStages, are_played_without_fault_by_ours_where_it_sweeps_and_to_theory_where_it_looks_at_poses) {
  const EnginePlan plan = stage_plan("engine = ['thinwall']", 500);
  std::vector<StageRow> rows = played(plan);
  EXPECT_EQ(rows.size(), 4U * 7) << "four modes; no mesh";
  EXPECT_TRUE(all_passed(self_test(own_counts(rows))));
  std::int64_t passed = 0;
  for (const StageRow& row : rows) {
    EXPECT_EQ(row.tally.shots, 500);
    EXPECT_EQ(row.tally.lost, 0);
    if (row.setup->mode.name == "discrete") passed += row.tally.passed;
  }
  EXPECT_GT(passed, 1000) << "the foil lets bodies pass";
  for (StageRow& row : rows) {
    if (row.setup->mode.exact && row.kind->name == "near_miss") row.tally.disturbed = 1;
  }
  EXPECT_FALSE(all_passed(self_test(own_counts(rows)))) << "one that is disturbed is too many";
}

TEST(EngineStages, follow_theory_in_npm_engines_that_look_at_poses) {
  std::string missing;
  std::vector<CellCount> counts;
  for (const Engine& engine : npm_engines()) {
    if (!engine.is_there()) missing += " " + engine.called;
    if (!engine.is_there() || engine.name == "mujoco") continue;  // its contacts are springs, which give way
    const EnginePlan plan = stage_plan("engine = ['" + engine.name + "']\nstage = ['head_on', 'crossing']", 200);
    for (const StageRow& row : played(plan)) {
      EXPECT_EQ(row.tally.unanswered, 0) << row.setup->label();
      if (row.theory) counts.push_back({row.setup->label(), "float", row.tally.shots, row.tally.passed, *row.theory});
    }
  }
  if (!missing.empty()) GTEST_SKIP() << "not in this build:" << missing << "; " << npm_engines().front().remedy;
  EXPECT_TRUE(all_passed(self_test(counts)));
}

TEST(EngineStages, ask_for_a_motion_that_passes_in_time) {
  const auto refusal = [](const std::string& text) { return error_of<UsageError>([&] { stage_plan(text, 10); }); };
  EXPECT_TRUE(holds(refusal("stage_path = 0.66"), "at least 0.67 m"));
  EXPECT_TRUE(holds(refusal("stage = ['brick']"), "key 'stage'"));
  EXPECT_EQ(refusal("stage_path = 0.67"), "");
}

}  // namespace

}  // namespace thinwall
