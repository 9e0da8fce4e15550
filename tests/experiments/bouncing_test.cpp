/// The bouncing ball's answers: who loses energy, who gains it, and does theory agree?
#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "experiments/bouncing_run.hpp"

namespace thinwall {
namespace {

TEST(Bouncing, agrees_with_theory) {
  const Outcome& outcome = few_bounces_outcome();
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_EQ(table_of(outcome, "self_test").rows.size(), 5U);
  EXPECT_EQ(table_of(outcome, "cells").rows.size(), 3U * 3 * 5);
  EXPECT_EQ(table_of(outcome, "means").rows.size(), 3U * 5);
  EXPECT_NE(outcome.answer.find("flip_only -2.0"), std::string::npos) << outcome.answer;
  EXPECT_NE(outcome.answer.find("theory agrees"), std::string::npos) << outcome.answer;
}

/// Lines of a run that is large enough to tell theories apart.
const std::vector<BounceRow>& measured() {
  static const std::vector<BounceRow> rows = [] {
    const Experiment experiment = bouncing_experiment();
    const Settings settings("step = [0.06666666666666667, 0.03333333333333333]\nrestitution = [0, 0.5, 1]", "test.toml",
                            experiment.default_toml);
    const std::vector<BounceCell> cells = make_bounce_cells(settings);
    const std::vector<BouncePolicy> policies = all_bounce_policies();
    std::vector<BounceTally> tallies;
    for (const BounceCell& c : cells) {
      for (const BouncePolicy& policy : policies) tallies.push_back(random_bounces(policy, c, 1, 4000));
    }
    return bounce_rows(cells, policies, tallies);
  }();
  return rows;
}

/// Does the self-test pass if one policy's theory is another?
bool passes(const std::string& policy, const std::function<BounceTheory(const BounceRow&)>& theory) {
  std::vector<BounceRow> rows = measured();
  for (BounceRow& row : rows) {
    if (row.policy == policy) row.theory = theory(row);
  }
  return all_passed(bounce_tests(rows));
}

TEST(Bouncing, fails_a_wrong_theory) {
  const auto own = [](const BounceRow& r) { return r.theory; };
  for (const BouncePolicy& policy : all_bounce_policies()) EXPECT_TRUE(passes(policy.name, own)) << policy.name;
  const auto first_order = [](const BounceRow& r) { return bounce_theory(r.policy, 0, r.cell.restitution); };
  const auto off_by = [](double shift) {
    return [shift](const BounceRow& r) { return BounceTheory{r.theory.c0 + shift, r.theory.c1, r.theory.c2}; };
  };
  const auto spread_by = [](double factor) {  // the mean stays
    return [factor](const BounceRow& r) {
      return BounceTheory{r.theory.mean() - factor * r.theory.c2 / 3, factor * r.theory.c1, factor * r.theory.c2};
    };
  };
  for (const char* policy : {"project_flip", "flip_only", "linear_toi", "exact_project"}) {
    EXPECT_FALSE(passes(policy, first_order)) << policy;
    EXPECT_FALSE(passes(policy, off_by(0.1))) << policy;
    EXPECT_FALSE(passes(policy, spread_by(1.1))) << policy;
    EXPECT_FALSE(passes(policy, spread_by(1 / 1.1))) << policy;
  }
  EXPECT_FALSE(passes("parabola_toi", off_by(1e-11)));
  EXPECT_FALSE(passes("flip_only", [](const BounceRow& r) {  // as if it were pushed out
    return bounce_theory("project_flip", delta(r.cell), r.cell.restitution);
  }));
}

/// A single bounce that is off is enough where every bounce must be the same.
TEST(Bouncing, fails_a_bounce_that_loses_energy_on_the_exact_arc) {
  for (const double off : {-1e-9, 1e-9}) {
    std::vector<BounceRow> rows = measured();
    for (BounceRow& row : rows) {
      if (row.policy == "parabola_toi") row.tally.add(off);
    }
    EXPECT_FALSE(all_passed(bounce_tests(rows)));
  }
}

/// Of the journal of a run: one crowd that went wrong.
TEST(Bouncing, fails_a_scenario_that_went_wrong) {
  const auto run = bouncing_run(few_bounces);
  const std::vector<Unit> units = run->units();
  std::vector<std::string> results = results_of(units);
  const std::vector<double> seconds(results.size(), 1e-3);
  EXPECT_TRUE(run->finish(results, seconds).self_test_passed);
  ASSERT_EQ(units[1].key, "scenario walls");
  results[1] = to_text(std::vector<BounceScenario>{{"a", "b", "c", true}, {"d", "e", "f", false}});
  const Outcome outcome = run->finish(results, seconds);
  EXPECT_FALSE(outcome.self_test_passed);
  EXPECT_NE(outcome.summary.find("FAILED d: f"), std::string::npos) << outcome.summary;
}

TEST(Bouncing, too_few_bounces_are_not_judged) {
  EXPECT_EQ(value_of(table_of(few_bounces_outcome(), "self_test"), "project_flip", "other_cells"),
            Value(std::int64_t{0}));
  const auto run = bouncing_run(few_bounces, {.seed = 1, .trials = 20});
  EXPECT_EQ(value_of(table_of(outcome_of(*run), "self_test"), "linear_toi", "other_cells"), Value(std::int64_t{6}));
}

/// Times are in tables and figures that no hash covers, and nowhere else.
TEST(Bouncing, only_what_is_marked_depends_on_the_time_it_took) {
  const auto run = bouncing_run(few_bounces);
  const std::vector<std::string> results = results_of(run->units());
  const Outcome fast = run->finish(results, std::vector<double>(results.size(), 1e-3));
  const Outcome slow = run->finish(results, std::vector<double>(results.size(), 2e-3));
  for (std::size_t i = 0; i < fast.tables.size(); ++i) {
    EXPECT_EQ(fast.tables[i].rows == slow.tables[i].rows, !fast.tables[i].is_timing) << fast.tables[i].name;
  }
  for (std::size_t i = 0; i < fast.figures.size(); ++i) {
    const bool same = fast.figures[i].panels[0].series[0].x == slow.figures[i].panels[0].series[0].x;
    EXPECT_EQ(same, !fast.figures[i].is_timing) << fast.figures[i].name;
  }
}

TEST(Bouncing, a_cell_keeps_its_bounces_whatever_else_is_asked) {
  const Table& all = table_of(few_bounces_outcome(), "cells");
  const Table one = table_of(bouncing_outcome(std::string(R"(
    step = [0.016666666666666666]
    restitution = [0.5]
    policy = ["linear_toi"]
    scenario = ["walls"]
    bounces = 400
    rounds = 1
    runs = 2
    run_bounces = 1)")),
                             "cells");
  ASSERT_EQ(one.rows.size(), 1U);
  EXPECT_NE(std::find(all.rows.begin(), all.rows.end(), one.rows[0]), all.rows.end());
}

/// The failure is specified too: one who only turns its speed ends in the floor, one who is pushed out of exact arcs climbs.
TEST(Bouncing, a_ball_that_bounces_on_shows_who_loses_and_who_gains) {
  const BounceCell cell = {9.81, 1, 0.1, 1.0 / 60, 1};
  const auto energy_after = [&](const char* name, std::int64_t bounces) {
    return bounce_policy(name).energies(cell, 1.0 / 3, bounces).back();
  };
  EXPECT_LT(energy_after("flip_only", 1000), 0.01);
  EXPECT_LT(bounce_policy("flip_only").energies(cell, 1.0 / 3, 1000).size(), 30U);
  EXPECT_LT(energy_after("project_flip", 40), 0.1);
  EXPECT_GT(energy_after("exact_project", 40), 2.5);
  EXPECT_NEAR(energy_after("parabola_toi", 1000), 1, 1e-12);
  const std::vector<double> sinking = bounce_policy("flip_only").heights(cell, 1.0 / 3, 2000);
  EXPECT_LT(sinking.back(), -1);
}

/// Its speed grows with every bounce, and the floor is still deeper than a step.
TEST(Bouncing, a_ball_that_gains_and_gains_never_falls_through) {
  const BounceCell cell = {9.81, 1, 0.1, 0.2, 1};  // half of the impact speed in a step
  for (const BouncePolicy& policy : all_bounce_policies()) {
    const std::vector<double> energies = policy.energies(cell, 0.4, 1000);
    EXPECT_EQ(energies.size() == 1000, policy.drift >= 0) << policy.name;
    if (policy.drift > 0) {
      EXPECT_GT(energies.back(), 10000) << policy.name;
    }
  }
}

TEST(BounceTally, is_the_mean_and_the_variance) {
  BounceTally tally;
  for (const double x : {1.0, 2.0, 4.0, 9.0}) tally.add(x);
  EXPECT_EQ(tally.trials, 4);
  EXPECT_EQ(tally.mean, 4);
  EXPECT_NEAR(tally.sigma(), std::sqrt(38.0 / 3), 1e-15);
  EXPECT_NEAR(tally.rms(), std::sqrt(102.0 / 4), 1e-15);
  EXPECT_EQ(tally.least, 1);
  EXPECT_EQ(tally.most, 9);
}

/// Any policy alone has an answer, tables and pictures.
TEST(BouncingConfig, answers_for_any_one_policy_and_step) {
  for (const std::string_view policy : bounce_policy_names()) {
    const Outcome outcome = bouncing_outcome("policy = ['" + std::string(policy) + R"(']
      step = [0.05]
      restitution = [0.5]
      scenario = ["walls"]
      bounces = 50
      runs = 2
      run_bounces = 2
      rounds = 1)");
    EXPECT_NE(outcome.answer.find(policy), std::string::npos) << outcome.answer;
    EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
    EXPECT_EQ(outcome.figures.size(), 4U);
  }
}

/// What a factor's range allows is the factor's own; this is what goes together, or not.
TEST(BouncingConfig, refuses_what_does_not_go_together) {
  struct Refusal {
    const char *text, *reason;
  };
  for (const auto& [text, reason] :
       {Refusal{"step = [0.3]", "gravity adds 0.0001 to 0.5 of the impact speed"},
        Refusal{"step = [1e-6]", "gravity adds 0.0001 to 0.5 of the impact speed"},
        Refusal{"radius = 1e-4", "0.001 to 10 times the height"},
        Refusal{"radius = 11", "0.001 to 10 times the height"},
        Refusal{"policy = ['project_flp']", "did you mean 'project_flip'?"},
        Refusal{"scenario = ['pi']", "key 'scenario'"}, Refusal{"mass_ratio = [0.5]", "key 'mass_ratio'"},
        Refusal{"runs = 1", "key 'runs'"}, Refusal{"run_bounces = 0", "key 'run_bounces'"},
        Refusal{"rounds = 0", "key 'rounds'"}, Refusal{"digits = 8", "key 'digits'"}}) {
    try {
      bouncing_run(text);
      ADD_FAILURE() << text;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }
}

TEST(BouncingConfig, crowds_come_in_the_order_asked) {
  const auto run = bouncing_run("scenario = ['walls', 'zeno']");
  EXPECT_EQ(run->units()[0].key, "scenario walls");
  EXPECT_EQ(run->units()[1].key, "scenario zeno");
}

}  // namespace
}  // namespace thinwall
