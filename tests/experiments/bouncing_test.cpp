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
const std::vector<BounceLine>& measured() {
  static const std::vector<BounceLine> lines = [] {
    const Experiment experiment = bouncing_experiment();
    const Settings settings("step = [0.06666666666666667, 0.03333333333333333]\nrestitution = [0, 0.5, 1]", "test.toml",
                            experiment.default_toml);
    const std::vector<BounceCell> cells = make_bounce_cells(settings);
    const std::vector<BouncePolicy> policies = all_bounce_policies();
    std::vector<BounceTally> tallies;
    for (const BounceCell& c : cells) {
      for (const BouncePolicy& policy : policies) tallies.push_back(random_bounces(policy, c, 1, 4000));
    }
    return make_bounce_lines(cells, policies, tallies);
  }();
  return lines;
}

/// Does the self-test pass if one policy's theory is another?
bool passes(const std::string& policy, const std::function<BounceTheory(const BounceLine&)>& theory) {
  std::vector<BounceLine> lines = measured();
  for (BounceLine& line : lines) {
    if (line.policy == policy) line.theory = theory(line);
  }
  return all_passed(bounce_tests(lines));
}

TEST(Bouncing, fails_a_wrong_theory) {
  const auto own = [](const BounceLine& l) { return l.theory; };
  for (const BouncePolicy& policy : all_bounce_policies()) EXPECT_TRUE(passes(policy.name, own)) << policy.name;
  const auto first_order = [](const BounceLine& l) { return bounce_theory(l.policy, 0, l.cell.restitution); };
  const auto off_by = [](double shift) {
    return [shift](const BounceLine& l) { return BounceTheory{l.theory.c0 + shift, l.theory.c1, l.theory.c2}; };
  };
  const auto spread_by = [](double factor) {  // the mean stays
    return [factor](const BounceLine& l) {
      return BounceTheory{l.theory.mean() - factor * l.theory.c2 / 3, factor * l.theory.c1, factor * l.theory.c2};
    };
  };
  for (const char* policy : {"project_flip", "flip_only", "linear_toi", "exact_project"}) {
    EXPECT_FALSE(passes(policy, first_order)) << policy;
    EXPECT_FALSE(passes(policy, off_by(0.1))) << policy;
    EXPECT_FALSE(passes(policy, spread_by(1.1))) << policy;
    EXPECT_FALSE(passes(policy, spread_by(1 / 1.1))) << policy;
  }
  EXPECT_FALSE(passes("parabola_toi", off_by(1e-11)));
  EXPECT_FALSE(passes("flip_only", [](const BounceLine& l) {  // as if it were pushed out
    return bounce_theory("project_flip", delta(l.cell), l.cell.restitution);
  }));
}

/// A single bounce that is off is enough where every bounce must be the same.
TEST(Bouncing, fails_a_bounce_that_loses_energy_on_the_exact_arc) {
  for (const double off : {-1e-9, 1e-9}) {
    std::vector<BounceLine> lines = measured();
    for (BounceLine& line : lines) {
      if (line.policy == "parabola_toi") line.tally.add(off);
    }
    EXPECT_FALSE(all_passed(bounce_tests(lines)));
  }
}

TEST(Bouncing, fails_a_scenario_that_went_wrong) {
  BouncingResults results;
  results.groups = {{"walls", {{"a", "b", "c", true}, {"d", "e", "f", true}}}};
  EXPECT_TRUE(results.passed());
  results.groups[0].scenarios[1].passed = false;
  EXPECT_FALSE(results.passed());
  EXPECT_EQ(results.scenarios_passed(), 1U);
}

TEST(Bouncing, too_few_bounces_are_not_judged) {
  const Outcome outcome = bouncing_outcome(std::string(few_bounces) + "policy = ['project_flip']\n");
  EXPECT_EQ(value_of(table_of(outcome, "self_test"), "project_flip", "other_cells"), Value(std::int64_t{0}));
  const auto run = bouncing_run(few_bounces, {.seed = 1, .trials = 20});
  EXPECT_EQ(value_of(table_of(outcome_of(*run), "self_test"), "linear_toi", "other_cells"), Value(std::int64_t{6}));
}

TEST(Bouncing, does_not_depend_on_the_order_of_the_units) {
  const auto run = bouncing_run(few_bounces);
  std::vector<Unit> units = run->units();
  const std::vector<std::string> forward = results_of(units);
  std::reverse(units.begin(), units.end());
  std::vector<std::string> backward = results_of(units);
  std::reverse(backward.begin(), backward.end());
  EXPECT_EQ(forward, backward);
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
  EXPECT_EQ(bounce_tally_from_line(to_line(tally)), tally);
  EXPECT_EQ(bounce_tally_from_line(to_line(BounceTally{})), BounceTally{});
  EXPECT_THROW(bounce_tally_from_line("1 2 3"), std::runtime_error);
  EXPECT_THROW(bounce_tally_from_line(to_line(tally) + " 4"), std::runtime_error);
}

}  // namespace
}  // namespace thinwall
