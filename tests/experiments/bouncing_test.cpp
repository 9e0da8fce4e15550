/// The bouncing ball: who loses energy, who gains it, and does theory agree? One bounce at a time against the polynomial of its phase,
/// the formulas by which the ball flies, and impacts that come in crowds.

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/bouncing/model.hpp>
#include <thinwall/experiments/experiment_list.hpp>

#include "support/experiment_run.hpp"
#include "support/thorough.hpp"

namespace thinwall {

namespace {

TEST(Bouncing, agrees_with_theory) {
  const Outcome& outcome = small_outcome(bouncing_experiment());
  EXPECT_NE(outcome.answer.find("flip_only -2.0"), std::string::npos) << outcome.answer;
  EXPECT_NE(outcome.answer.find("theory agrees"), std::string::npos) << outcome.answer;
  for (const Table& t : outcome.tables) EXPECT_EQ(t.is_timing, t.name == "timings");
  for (const Figure& f : outcome.figures) EXPECT_EQ(f.is_timing, f.name == "energy_against_time");
}

TEST(Bouncing, does_not_call_on_a_theory_that_too_few_bounces_judge) {
  const Outcome outcome = outcome_of(bouncing_experiment(), small_toml("bouncing"), {.seed = 1, .trials = 1});
  EXPECT_TRUE(holds(outcome.answer, "theory not judged: too few bounces")) << outcome.answer;
}

/// Lines of a run that is large enough to tell theories apart.
const std::vector<BounceRow>& measured() {
  static const std::vector<BounceRow> rows = [] {
    const Experiment experiment = bouncing_experiment();
    const Settings settings("step = [0.06666666666666667, 0.03333333333333333]\nrestitution = [0, 0.5, 1]", "test.toml",
                            experiment.default_toml);
    std::vector<BounceRow> all;
    for (const BounceCell& c : make_bounce_cells(settings)) all.push_back({c, random_bounces(c, 1, 4000)});
    return all;
  }();
  return rows;
}

/// Does the self-test pass if one policy's rows are changed?
bool passes(std::string_view policy, const std::function<void(BounceRow&)>& change) {
  std::vector<BounceRow> rows = measured();
  for (BounceRow& row : rows) {
    if (row.cell.policy.name == policy) change(row);
  }
  return all_passed(bounce_tests(rows));
}

TEST(Bouncing, fails_a_wrong_theory) {
  EXPECT_TRUE(all_passed(bounce_tests(measured())));
  const auto first_order = [](BounceRow& r) { r.theory = bounce_theory(r.cell.policy.name, 0, r.cell.restitution); };
  const auto off_by = [](double shift) { return [shift](BounceRow& r) { r.theory.c[0] += shift; }; };
  const auto spread_by = [](double factor) {  // the mean stays
    return [factor](BounceRow& r) {
      const double mean = r.theory.mean();
      r.theory.c *= factor;
      r.theory.c[0] += mean - r.theory.mean();
    };
  };
  for (const char* policy : {"project_flip", "flip_only", "linear_toi", "exact_project"}) {
    EXPECT_FALSE(passes(policy, first_order)) << policy;
    EXPECT_FALSE(passes(policy, off_by(0.1))) << policy;
    EXPECT_FALSE(passes(policy, spread_by(1.1))) << policy;
    EXPECT_FALSE(passes(policy, spread_by(1 / 1.1))) << policy;
  }
  EXPECT_FALSE(passes("parabola_toi", off_by(1e-11)));
  EXPECT_FALSE(passes("flip_only", [](BounceRow& r) {  // as if it were pushed out
    r.theory = bounce_theory("project_flip", delta(r.cell), r.cell.restitution);
  }));
  for (const double off : {-1e-9, 1e-9}) {  // a single bounce is enough where every bounce must be the same
    EXPECT_FALSE(passes("parabola_toi", [off](BounceRow& r) { r.tally.add(off); }));
  }
}

/// Of the journal of a run: one crowd that went wrong.
TEST(Bouncing, fails_a_scenario_that_went_wrong) {
  const auto run = run_of(bouncing_experiment(), small_toml("bouncing"));
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
  EXPECT_EQ(value_of(table_of(small_outcome(bouncing_experiment()), "self_test"), "project_flip", "other_cells"),
            Value(std::int64_t{0}));
  const Outcome few = outcome_of(bouncing_experiment(), small_toml("bouncing"), {.seed = 1, .trials = 20});
  EXPECT_EQ(value_of(table_of(few, "self_test"), "linear_toi", "other_cells"), Value(std::int64_t{6}));
}

BounceCell drop(const BouncePolicy& policy, double step, double restitution) {
  return {9.81, 1, 0.1, step, restitution, policy};
}
BounceCell drop(std::string_view policy, double step, double restitution) {
  return drop(called(all_bounce_policies, policy), step, restitution);
}

/// The failure is specified too: one who only turns its speed ends in the floor, one who is pushed out of exact arcs climbs.
TEST(Bouncing, a_ball_that_bounces_on_shows_who_loses_and_who_gains) {
  const auto after = [&](const char* policy, std::int64_t bounces) {
    return energies(drop(policy, 1.0 / 60, 1), 1.0 / 3, bounces);
  };
  EXPECT_LT(after("flip_only", 1000).back(), 0.01);
  EXPECT_LT(after("flip_only", 1000).size(), 30U);
  EXPECT_LT(after("project_flip", 40).back(), 0.1);
  EXPECT_GT(after("exact_project", 40).back(), 2.5);
  EXPECT_NEAR(after("parabola_toi", 1000).back(), 1, 1e-12);
  EXPECT_LT(heights(drop("flip_only", 1.0 / 60, 1), 1.0 / 3, 2000).back(), -1);
}

/// Its speed grows with every bounce, and the floor is still deeper than a step.
TEST(Bouncing, a_ball_that_gains_and_gains_never_falls_through) {
  for (const BouncePolicy& policy : all_bounce_policies) {
    const std::vector<double> run = energies(drop(policy, 0.2, 1), 0.4, 1000);  // half of the impact speed in a step
    const double drift = bounce_theory(policy.name, 0, 1).mean();
    EXPECT_EQ(run.size() == 1000, drift >= 0) << policy.name;
    if (drift > 0) {
      EXPECT_GT(run.back(), 10000) << policy.name;
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
  for (const BouncePolicy& policy : all_bounce_policies) {
    const Outcome outcome = outcome_of(bouncing_experiment(), "policy = ['" + std::string(policy.name) + R"(']
      step = [0.05]
      restitution = [0.5]
      scenario = ["walls"]
      bounces = 50
      runs = 2
      run_bounces = 2
      rounds = 1)");
    EXPECT_NE(outcome.answer.find(policy.name), std::string::npos) << outcome.answer;
    EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
    EXPECT_EQ(outcome.figures.size(), 4U);
  }
}

/// What a factor's range allows is the factor's own; this is what goes together, or not.
TEST(BouncingConfig, refuses_what_does_not_go_together) {
  expect_refusals(bouncing_experiment(), {{"step = [0.3]", "gravity adds 0.0001 to 0.5 of the impact speed"},
                                          {"step = [1e-6]", "gravity adds 0.0001 to 0.5 of the impact speed"},
                                          {"radius = 1e-4", "0.001 to 10 times the height"},
                                          {"radius = 11", "0.001 to 10 times the height"},
                                          {"mass_ratio = [0.5]", "key 'mass_ratio'"},
                                          {"runs = 1", "key 'runs'"},
                                          {"run_bounces = 0", "key 'run_bounces'"},
                                          {"rounds = 0", "key 'rounds'"},
                                          {"digits = 8", "key 'digits'"}});
}

TEST(BouncingConfig, crowds_come_in_the_order_asked) {
  const auto run = run_of(bouncing_experiment(), "scenario = ['walls', 'zeno']");
  EXPECT_EQ(run->units()[0].key, "scenario walls");
  EXPECT_EQ(run->units()[1].key, "scenario zeno");
}

/// Case 55. Not on average: every bounce lies on the polynomial, to rounding.
TEST(BounceTheory, every_bounce_is_what_theory_says_at_its_phase) {
  for (const BouncePolicy& policy : all_bounce_policies) {
    for (const double step : {0.1, 1.0 / 60, 0.002}) {
      for (const double e : {0.0, 0.3, 0.9, 1.0}) {
        const BounceCell cell = drop(policy, step, e);
        const BounceTheory theory = bounce_theory(policy.name, delta(cell), e);
        for (const double phase : {1e-6, 0.1, 0.25, 0.5, 0.77, 1 - 1e-6}) {
          ASSERT_NEAR(error_at(cell, phase), theory.at(1 - 2 * phase), rounding_of(cell))
              << policy.name << " " << bounce_factors.key(cell) << " phase " << phase;
        }
      }
    }
  }
}

/// Case 55: the means in g h / V, and the deviation of the linear split.
TEST(BounceTheory, means_for_short_steps_without_loss) {
  const auto mean = [](std::string_view policy) { return bounce_theory(policy, 0, 1).mean(); };
  EXPECT_EQ(mean("project_flip"), -1);
  EXPECT_EQ(mean("flip_only"), -2);
  EXPECT_EQ(mean("linear_toi"), 0);
  EXPECT_EQ(mean("exact_project"), 1);
  EXPECT_EQ(mean("parabola_toi"), 0);
  EXPECT_NEAR(bounce_theory("linear_toi", 0, 1).sigma(), 2 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(bounce_theory("project_flip", 0, 1).sigma(), 1 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(bounce_theory("linear_toi", 0.3, 1).mean(), 2 * 0.3 / 3, 1e-15);  // the split is of second order
  EXPECT_THROW(bounce_theory("none", 0, 1), std::logic_error);
}

/// Case 55: the exact arc keeps its energy.
TEST(BounceTheory, the_split_arc_keeps_its_energy) {
  for (const double step : {1.0 / 15, 1.0 / 60, 1.0 / 240}) {
    for (const double phase : {0.01, 0.5, 0.99})
      EXPECT_LE(std::abs(error_at(drop("parabola_toi", step, 1), phase)), 1e-11);
  }
}

TEST(BounceTheory, moments_are_those_of_a_uniform_phase) {
  const BounceTheory theory = {{0.3, -1.2, 0.7}};
  constexpr int count = 4000;
  double sum = 0, squares = 0, fourths = 0;
  for (int i = 0; i < count; ++i) {
    const double off = theory.at(2 * (i + 0.5) / count - 1) - theory.mean();
    sum += off;
    squares += off * off;
    fourths += off * off * off * off;
  }
  EXPECT_NEAR(sum / count, 0, 1e-6);
  EXPECT_NEAR(squares / count, theory.sigma() * theory.sigma(), 1e-6);
  EXPECT_NEAR(fourths / count / std::pow(theory.sigma(), 4), theory.kurtosis(), 1e-5);
  EXPECT_NEAR((BounceTheory{{0, 1, 0}}.kurtosis()), 1.8, 1e-14);
}

TEST(BounceArc, lands_where_the_quadratic_has_its_root) {
  EXPECT_EQ(landing_time(1, 0, 2), 1);
  EXPECT_EQ(landing_time(0, 3, 2), 3);
  EXPECT_EQ(landing_time(0, 0, 2), 0);
  EXPECT_EQ(landing_time(0, -3, 2), 0);
  EXPECT_EQ(landing_time(1, 1e9, 2), 1e9);
  // Where the textbook's root (speed - |velocity|) / g has no digit left: a fall of 1e-12 m at 1e8 m/s.
  EXPECT_DOUBLE_EQ(landing_time(1e-12, -1e8, 2), 1e-20);
  for (const double v : {-3.0, -0.1, 0.1, 7.0}) {
    const double t = landing_time(0.7, v, 9.81);
    EXPECT_NEAR(0.7 + t * (v - 9.81 * t / 2), 0, 1e-14) << v;
  }
}

/// A step on the arc holds as many bounces as it can, and ends on time.
TEST(BounceArc, follows_many_bounces_in_one_step) {
  const BouncingWorld world = {2, 1, 7.5, floor_of_depth(512)};  // flights of 2 s after the first impact at 1 s
  BouncingBall ball = ball_at(1, 0, 0.5);
  parabola_toi(world, ball);
  EXPECT_EQ(ball.bounces, 4);  // at 1, 3, 5 and 7 s
  EXPECT_EQ(ball.time, 7.5);
  EXPECT_EQ(gap_of(ball), 0.75);  // 0.5 s after the last
  EXPECT_EQ(ball.velocity, 1);
}

TEST(BounceArc, ends_a_step_on_the_floor) {
  const BouncingWorld world = {2, 1, 1, floor_of_depth(8)};
  BouncingBall ball = ball_at(1, 0, 0.5);
  parabola_toi(world, ball);
  EXPECT_EQ(gap_of(ball), 0);
  EXPECT_EQ(ball.bounces, 1);
  parabola_toi(world, ball);
  EXPECT_EQ(gap_of(ball), 1);
  EXPECT_EQ(ball.bounces, 1);
}

/// Locked phases: a run of project_flip that does not start on the drop loses 1 + 1 in two bounces, whatever its phase.
TEST(BounceLongRun, two_bounces_of_project_flip_lose_twice_the_mean) {
  const BounceCell cell = drop("project_flip", 1.0 / 240, 1);
  const double d = delta(cell);
  for (const double elapsed : {0.2, 0.4, 0.7}) {
    const std::vector<double> run = energies(cell, elapsed, 21);
    ASSERT_EQ(run.size(), 21U);
    for (std::size_t n = 2; n < run.size(); n += 2)
      EXPECT_NEAR(std::sqrt(run[n]), std::sqrt(run[0]) - static_cast<double>(n) * d / 2, 1e-12) << elapsed;
    EXPECT_GT(std::sqrt(run[0]), 1 - d);
  }
}

/// Cases 56 to 62.
/// What some of them come to, whatever they say that they must.
constexpr std::pair<std::string_view, std::string_view> known_ends[] = {
    {"bounces that pile up (restitution 1/2)", "54 bounces, the last at 3 s"},
    {"a cradle of five balls, 2 come in", "speeds 0 0 0 1 1, 6 impacts"},
    {"blocks of masses 1 : 100^3 and a wall, float", "3141 impacts"},
    {"blocks of masses 1 : 100^3 and a wall, double", "3141 impacts"},
};

TEST(BounceScenarios, end_as_they_must) {
  constexpr int digits = testing::slow_build ? 4 : 7;  // all 31 million impacts: not where nothing is inlined
  std::vector<std::size_t> counts;
  std::size_t known = 0;
  for (const std::string_view group : scenario_groups) {
    const std::vector<BounceScenario> scenarios = bounce_scenarios(group, {1, 1e4, 1e8, 1e12, 1e16}, digits);
    counts.push_back(scenarios.size());
    for (const BounceScenario& s : scenarios) {
      EXPECT_EQ(s.group, group);
      EXPECT_TRUE(s.passed) << s.name << "\nmust: " << s.must << "\nhappened: " << s.happened;
      for (const auto& [name, end] : known_ends) {
        if (s.name != name) continue;
        EXPECT_EQ(s.happened.substr(0, end.size()), end);
        ++known;
      }
    }
  }
  EXPECT_EQ(known, std::size(known_ends));
  EXPECT_EQ(counts, (std::vector<std::size_t>{1, 5, 2, 2, 9, 3, digits + 1 + std::min(digits, 5) + 1}));
}

/// Whatever the restitution, also where every speed comes back whole.
TEST(BounceScenarios, rest_is_rest_at_every_restitution) {
  for (const double e : {0.0, 0.5, 1.0}) {
    const BouncingWorld world = {9.81, e, 1.0 / 60, floor_of_depth(8)};
    BouncingBall linear = ball_at(0, 0, 0.1), arc = linear;
    for (int i = 0; i < 1000; ++i) {
      linear_toi(world, linear);
      parabola_toi(world, arc);
    }
    for (const BouncingBall& ball : {linear, arc}) {
      EXPECT_EQ(gap_of(ball), 0) << e;
      EXPECT_EQ(ball.velocity, 0) << e;
      EXPECT_EQ(ball.bounces, 0) << e;
    }
  }
}

/// A ball that loses nearly all of its speed comes to rest on the arc, in finitely many bounces.
TEST(BounceScenarios, every_loss_ends_in_rest) {
  for (const double e : {0.0, 0.1, 0.9, 0.99}) {
    const BouncingWorld world = {9.81, e, 0.1, floor_of_depth(8)};
    BouncingBall ball = ball_at(0.5, 0, 0.1);
    for (int i = 0; i < 1000; ++i) parabola_toi(world, ball);
    EXPECT_EQ(gap_of(ball), 0) << e;
    EXPECT_EQ(ball.velocity, 0) << e;
    EXPECT_LE(static_cast<double>(ball.bounces), e > 0 ? 2 - 60 * std::log(2) / std::log(e) : 1) << e;
  }
}

}  // namespace

}  // namespace thinwall
