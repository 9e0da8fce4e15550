/// Time policies on one scene, held against the exact run.

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/compare/compare.hpp>

#include "experiments/scenes/scene_text.hpp"
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

/// 0.05 s: in two steps of 1/30 s a ball would come to the wall behind the end of the scene, and be through it.
TEST(Comparison, steps_every_contender_for_the_same_time) {
  const Comparison comparison = comparison_from(
      "scene = 'odd'\nsteps = 3\n[[body]]\nshape = 'sphere'\nradius = 0.02\nat = [-0.6, 0, 0]\n"
      "velocity = [10, 0, 0]\n[[body]]\nshape = 'box'\nsize = [0.01, 2, 2]\nmotion = 'static'\n"
      "[compare]\ndt = [0.0125, 0.016666666666666666, 0.02, 0.03333333333333333]\n");
  for (std::size_t i = 0; i < 4; ++i) {
    const Scene scene = scene_for(comparison, comparison.contenders[i]);
    EXPECT_EQ(scene.steps, (std::array{4, 3, 3, 2})[i]);
    EXPECT_EQ(scene.last_dt > 0, i > 1) << "the step divides the time, though with a rounding";
    EXPECT_NEAR(scene.duration(), 0.05, 1e-16);
    EXPECT_EQ(run_trial(scene).tunneled, 0);
  }
}

TEST(Comparison, refuses_steps_that_do_not_fit) {
  for (const std::string bad :
       {"dt = [1]", "dt = [0]", "dt = [1e-9]", "policy = ['sweep']", "repeats = 0", "repeat = 1"})
    EXPECT_THROW(comparison_from(bullet_text() + "\n[compare]\n" + bad + "\n"), UsageError) << bad;
  const std::string said = error_of<UsageError>([] { comparison_from("scene = 'short'\nsteps = 1\n"); });
  EXPECT_TRUE(said.starts_with("my.toml:1: key 'compare.dt', left at its default: [0.0041")) << said;
  EXPECT_TRUE(holds(said, "is not allowed; at most the scene's"));
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
  const Contest c = contest(contender, {run, other}, exact, 9.5);
  EXPECT_EQ(c.met, 1);
  EXPECT_EQ(c.unmet, 1);
  EXPECT_EQ(c.extra, 1);
  EXPECT_EQ(c.errors, std::vector<double>{0.25});
  EXPECT_EQ(c.seconds, (std::vector<double>{2, 4}));
  EXPECT_TRUE(c.repeated_alike);
  other.hash = 7;
  EXPECT_FALSE(contest(contender, {run, other}, exact, 9.5).repeated_alike);
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
  const Outcome outcome = outcome_of(compare_experiment(), bullet_text() + compared);
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  expect_readable(outcome);
  const Comparison comparison = comparison_from(bullet_text() + compared);
  const Trial exact = run_trial(scene_for(comparison, comparison.exact));
  EXPECT_NEAR(exact.met(1, 2).value_or(-1), (1 - 0.025) / 40, 1e-14) << "by a sheet of paper, not by a run";
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
}

/// 0 and 1 are discrete, 4 and 5 clamp, each at 1 ms and at 20 ms; times, and what was met and missed, as none are.
TEST(Comparison, names_the_fastest_of_those_that_let_nothing_through_and_fails_an_exact_run_that_does) {
  const auto run = run_of(compare_experiment(), bullet_text() + compared);
  std::vector<Trial> trials;
  for (const std::string& result : results_of(run->units())) trials.push_back(from_text<Trial>(result));
  for (std::size_t i = 0; i < trials.size(); ++i) trials[i].seconds = i % 8 == 1 ? 1 : i % 8 == 5 ? 2 : 3;
  trials[1].meetings = trials[9].meetings = trials[5].meetings;  // what it meets now, it lets through all the same
  const auto outcome = [&] {
    std::vector<std::string> results;
    for (const Trial& trial : trials) results.push_back(to_text(trial));
    return run->finish(results, std::vector<double>(results.size(), 1));
  };
  EXPECT_TRUE(holds(outcome().answer, "lets nothing through and meets every pair is clamp at 20 ms"));
  trials[5].meetings.clear();
  trials[13].meetings.clear();
  EXPECT_TRUE(holds(outcome().answer, "lets nothing through and meets every pair is substeps_4 at 1 ms"))
      << "seen, pushed on";
  EXPECT_EQ(trials[0].counts.pushed_through, 1);
  trials[0].counts.pushed_through = trials[8].counts.pushed_through = 0;
  EXPECT_TRUE(holds(outcome().answer, "lets nothing through and meets every pair is discrete at 1 ms"));
  EXPECT_TRUE(outcome().self_test_passed);
  trials.back().tunneled = 1;
  EXPECT_FALSE(outcome().self_test_passed);
}

/// To and fro between two walls, 1 m to either side.
TEST(Comparison, of_those_that_meet_again_the_first_time_counts) {
  const Trial trial = run_trial(scene_from(
      "scene = 'twice'\ndt = 0.2\nsteps = 30\n[[body]]\nshape = 'sphere'\nradius = 0.5\nvelocity = [2, 0, 0]\n"
      "restitution = 1\n[[body]]\nshape = 'box'\nsize = [1, 9, 9]\nat = [2, 0, 0]\nmotion = 'static'\n"
      "copies = [2, 1, 1]\nevery = [-4, 0, 0]\n"));
  EXPECT_NEAR(trial.met(1, 2).value_or(-1), 0.5, 1e-12);
  EXPECT_NEAR(trial.met(1, 3).value_or(-1), 1.5, 1e-12);
}

TEST(Comparison, has_no_error_to_tell_where_nothing_meets) {
  const Outcome outcome = outcome_of(compare_experiment(), "scene = 'none'\nsteps = 6\n" + compared);
  EXPECT_TRUE(outcome.answer.ends_with(" ms of run time a second of the scene.")) << outcome.answer;
  EXPECT_FALSE(holds(outcome.answer, "every pair"));
}

}  // namespace

}  // namespace thinwall
