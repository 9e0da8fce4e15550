/// Time policies on one scene, held against the exact run.
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include <thinwall/experiments/scenes/comparison.hpp>

#include "experiments/scenes/scene_text.hpp"
#include "support/described_tables.hpp"
#include "support/experiment_run.hpp"

namespace thinwall {
namespace {

const std::string compared = "\n[compare]\ndt = [0.02, 0.001]\nrepeats = 2\nfiner = 2\n";

Comparison comparison_from(const std::string& text) { return read_comparison(scene_settings(text), {}); }

TEST(Comparison, names_every_policy_and_step_and_an_exact_run_finer_than_any) {
  const Comparison comparison = comparison_from(bullet_text() + compared);
  ASSERT_EQ(comparison.contenders.size(), 8U);
  EXPECT_EQ(comparison.contenders[0].dt, 0.001);
  EXPECT_EQ(comparison.contenders[3].label(), "substeps_4");
  EXPECT_EQ(comparison.exact.dt, 0.0005);
  EXPECT_EQ(scene_for(comparison, comparison.contenders[1]).steps, 5);
  EXPECT_EQ(scene_for(comparison, comparison.contenders[1]).options.policy, TimePolicy::discrete);
}

TEST(Comparison, refuses_steps_that_do_not_fit) {
  EXPECT_THROW(comparison_from(bullet_text() + "\n[compare]\ndt = [1]\n"), UsageError);
  EXPECT_THROW(comparison_from(bullet_text() + "\n[compare]\ndt = [0]\n"), UsageError);
  EXPECT_THROW(comparison_from(bullet_text() + "\n[compare]\ndt = [1e-9]\n"), UsageError);
  EXPECT_THROW(comparison_from(bullet_text() + "\n[compare]\npolicy = ['sweep']\n"), UsageError);
  EXPECT_THROW(comparison_from(bullet_text() + "\n[compare]\nrepeats = 0\n"), UsageError);
  EXPECT_THROW(comparison_from(bullet_text() + "\n[compare]\nrepeat = 1\n"), UsageError);
  try {
    comparison_from("scene = 'short'\nsteps = 1\n");
    ADD_FAILURE() << "the default steps are longer than the scene";
  } catch (const UsageError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("my.toml:1: key 'compare.dt', left at its default: [0.0041"))
        << error.what();
    EXPECT_NE(std::string(error.what()).find("is not allowed; at most the scene's"), std::string::npos);
  }
}

/// Made-up meetings: one in both, one missed, one missed in the last step, one here alone.
TEST(Comparison, counts_pairs_that_met_in_one_run_alone) {
  const Contender contender{TimePolicy::discrete, 1, 0.5};
  Trial exact, run;
  exact.meetings = {{1, 2, 1.0}, {1, 3, 2.0}, {1, 4, 9.75}};
  run.meetings = {{1, 2, 1.25}, {2, 3, 3.0}};
  run.seconds = 2;
  Trial other = run;
  other.seconds = 4;
  const Contest c = contest(contender, {run, other}, exact, 10);
  EXPECT_EQ(c.met, 1);
  EXPECT_EQ(c.unmet, 1);
  EXPECT_EQ(c.extra, 1);
  EXPECT_EQ(c.errors, std::vector<double>{0.25});
  EXPECT_EQ(c.seconds, (std::vector<double>{2, 4}));
  EXPECT_TRUE(c.repeated_alike);
  other.hash = 7;
  EXPECT_FALSE(contest(contender, {run, other}, exact, 10).repeated_alike);
}

TEST(Comparison, a_trial_survives_its_line) {
  const Trial trial = run_trial(scene_from(bullet_text()));
  EXPECT_EQ(trial.meetings.size(), 1U);
  const auto again = from_text<Trial>(to_text(trial));
  EXPECT_TRUE(again.same_outcome(trial));
  EXPECT_EQ(again.seconds, trial.seconds);
  EXPECT_EQ(again.energy_end, trial.energy_end);
}

/// The question itself: with steps of 20 ms the discrete one is through; the swept ones are on time at any step.
TEST(Comparison, tells_discrete_from_swept) {
  const Outcome outcome = outcome_of(*run_of(compare_experiment(), bullet_text() + compared));
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  expect_described_tables(outcome);
  const Table& table = table_of(outcome, "compare");
  ASSERT_EQ(table.rows.size(), 8U);
  EXPECT_EQ(value_of(table, 1, "policy"), Value(std::string("discrete")));
  EXPECT_EQ(value_of(table, 1, "tunneled"), Value(std::int64_t(1)));
  EXPECT_EQ(value_of(table, 1, "unmet"), Value(std::int64_t(1)));
  EXPECT_EQ(value_of(table, 0, "tunneled"), Value(std::int64_t(0)));  // 4 cm a step: it is seen
  EXPECT_GT(std::get<double>(value_of(table, 0, "error_median")), 1e-6);
  for (const std::size_t row : {4U, 5U, 6U, 7U}) {
    EXPECT_EQ(value_of(table, row, "met"), Value(std::int64_t(1))) << row;
    EXPECT_EQ(value_of(table, row, "tunneled"), Value(std::int64_t(0))) << row;
    EXPECT_LT(std::get<double>(value_of(table, row, "error_largest")), 1e-12) << row;
  }
  std::istringstream summary(outcome.summary);
  for (std::string line; std::getline(summary, line);) EXPECT_LE(line.size(), 100U) << line;
}

/// Balls of 0.125 m in pairs, each on a line of its own: the exact run is held against a sheet of paper, not against a run.
TEST(Comparison, holds_every_kind_of_pair_against_the_time_it_meets) {
  struct Pair {
    std::string first, second;       // motion
    double gap, speed, other_speed;  // [m], [m/s] toward each other
  };
  const std::vector<Pair> pairs = {{"driven", "static", 0.9375, 11, 0},   {"driven", "static", 9.75, 1000, 0},
                                   {"driven", "driven", 0.875, 7, 3},     {"driven", "driven", 19.75, 1000, 500},
                                   {"free", "static", 9.75, 1000, 0},     {"free", "free", 19.75, 500, 1000},
                                   {"driven", "free", 19.75, 1000, 1000}, {"driven", "free", 0.875, 12, 0}};
  std::string bodies;
  std::vector<FirstMeeting> expected;
  const auto add = [&](const std::string& motion, double x, double speed) {
    bodies += "[[body]]\nshape = 'sphere'\nradius = 0.125\nmotion = '" + motion + "'\n";
    bodies += fmt::format("at = [{}, {}, 0]\nvelocity = [{}, 0, 0]\n", x, expected.size(), speed);
  };
  for (const Pair& pair : pairs) {
    add(pair.first, 0, pair.speed);
    add(pair.second, pair.gap, -pair.other_speed);
    const auto id = static_cast<std::uint32_t>(2 * expected.size() + 1);
    expected.push_back({id, id + 1, (pair.gap - 0.25) / (pair.speed + pair.other_speed)});
  }
  for (const char* way : {"response = true\n", "response = false\n", "plan = 'full'\n"}) {
    const Comparison comparison = comparison_from("scene = 'pairs'\ndt = 0.02\nsteps = 5\n" + std::string(way) +
                                                  bodies + "[compare]\ndt = [0.001, 0.02]\nfiner = 2\n");
    std::vector<Contender> all = comparison.contenders;
    all.push_back(comparison.exact);
    for (const Contender& contender : all) {
      if (contender.policy == TimePolicy::discrete || contender.policy == TimePolicy::substeps) continue;
      const Trial trial = run_trial(scene_for(comparison, contender));
      const std::string where = fmt::format("{} {} {}", contender.label(), contender.dt, way);
      EXPECT_EQ(trial.tunneled, 0) << where;
      ASSERT_EQ(trial.meetings.size(), expected.size()) << where;
      for (const auto& [first, second, time] : expected)
        EXPECT_NEAR(trial.met(first, second).value_or(-1), time, 1e-14) << where << first;
    }
  }
}

}  // namespace
}  // namespace thinwall
