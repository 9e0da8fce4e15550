/// Runs of the bouncing ball in memory, for their tests.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/bouncing/scenarios.hpp>
#include <thinwall/experiments/bouncing/theory.hpp>
#include <thinwall/experiments/experiment_list.hpp>

#include "support/experiment_run.hpp"
#include "support/thorough.hpp"

namespace thinwall {

/// Small enough for a debug build, and still with every policy.
inline constexpr std::string_view few_bounces = R"(
  step = [0.03333333333333333, 0.016666666666666666, 0.06666666666666667]
  restitution = [0, 0.5, 1]
  bounces = 400
  runs = 8
  run_bounces = 16
  rounds = 1
  mass_ratio = [1, 1e16]
  scenario = ["zeno", "walls", "masses", "cradle", "digits"]
  digits = 2
)";

inline std::unique_ptr<Run> bouncing_run(std::string_view text, RunOptions options = {.seed = 1, .trials = {}}) {
  return run_of(bouncing_experiment(), text, options);
}

inline Outcome bouncing_outcome(std::string_view text) { return outcome_of(*bouncing_run(text)); }

/// Of few_bounces, run once for all tests that only look.
inline const Outcome& few_bounces_outcome() {
  static const Outcome outcome = bouncing_outcome(few_bounces);
  return outcome;
}

inline std::vector<BouncePolicy> all_bounce_policies() {
  const std::vector<std::string_view> names = bounce_policy_names();
  return bounce_policies({names.begin(), names.end()});
}

inline BouncePolicy bounce_policy(const std::string& name) { return bounce_policies({name}).front(); }

// ---- The bouncing ball's answers: who loses energy, who gains it, and does theory agree?

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

// ---- One bounce at a time against the polynomial of its phase, the formulas by which the ball flies, and impacts that come in crowds, each
// against the answer that it must have.

BounceCell drop(double step, double restitution) { return {9.81, 1, 0.1, step, restitution}; }

/// Case 55. Not on average: every bounce lies on the polynomial, to rounding.
TEST(BounceTheory, every_bounce_is_what_theory_says_at_its_phase) {
  for (const BouncePolicy& policy : all_bounce_policies()) {
    for (const double step : {0.1, 1.0 / 60, 0.002}) {
      for (const double e : {0.0, 0.3, 0.9, 1.0}) {
        const BounceCell cell = drop(step, e);
        const BounceTheory theory = bounce_theory(policy.name, delta(cell), e);
        for (const double phase : {1e-6, 0.1, 0.25, 0.5, 0.77, 1 - 1e-6}) {
          ASSERT_NEAR(policy.error_at(cell, phase), theory.at(1 - 2 * phase), rounding_of(cell))
              << policy.name << " " << bounce_factors().key(cell) << " phase " << phase;
        }
      }
    }
  }
}

/// Case 55: the means in g h / V, and the deviation of the linear split.
TEST(BounceTheory, means_for_short_steps_without_loss) {
  EXPECT_EQ(bounce_theory("project_flip", 0, 1).mean(), -1);
  EXPECT_EQ(bounce_theory("flip_only", 0, 1).mean(), -2);
  EXPECT_EQ(bounce_theory("linear_toi", 0, 1).mean(), 0);
  EXPECT_EQ(bounce_theory("exact_project", 0, 1).mean(), 1);
  EXPECT_EQ(bounce_theory("parabola_toi", 0, 1).mean(), 0);
  EXPECT_NEAR(bounce_theory("linear_toi", 0, 1).sigma(), 2 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(bounce_theory("project_flip", 0, 1).rms(), 2 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(bounce_theory("linear_toi", 0.3, 1).mean(), 2 * 0.3 / 3, 1e-15);  // the split is of second order
  for (const BouncePolicy& policy : all_bounce_policies()) {
    EXPECT_EQ(bounce_theory(policy.name, 0, 1).mean(), policy.drift) << policy.name;
  }
  EXPECT_THROW(bounce_theory("none", 0, 1), std::logic_error);
}

/// Case 55: the exact arc keeps its energy.
TEST(BounceTheory, the_split_arc_keeps_its_energy) {
  const BouncePolicy arc = bounce_policy("parabola_toi");
  for (const double step : {1.0 / 15, 1.0 / 60, 1.0 / 240}) {
    for (const double phase : {0.01, 0.5, 0.99}) EXPECT_LE(std::abs(arc.error_at(drop(step, 1), phase)), 1e-11);
  }
}

TEST(BounceTheory, moments_are_those_of_a_uniform_phase) {
  const BounceTheory theory = {0.3, -1.2, 0.7};
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
  EXPECT_NEAR((BounceTheory{0, 1, 0}.kurtosis()), 1.8, 1e-14);
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
  ParabolaToi::step(world, ball);
  EXPECT_EQ(ball.bounces, 4);  // at 1, 3, 5 and 7 s
  EXPECT_EQ(ball.time, 7.5);
  EXPECT_EQ(gap_of(ball), 0.75);  // 0.5 s after the last
  EXPECT_EQ(ball.velocity, 1);
}

TEST(BounceArc, ends_a_step_on_the_floor) {
  const BouncingWorld world = {2, 1, 1, floor_of_depth(8)};
  BouncingBall ball = ball_at(1, 0, 0.5);
  ParabolaToi::step(world, ball);
  EXPECT_EQ(gap_of(ball), 0);
  EXPECT_EQ(ball.bounces, 1);
  ParabolaToi::step(world, ball);
  EXPECT_EQ(gap_of(ball), 1);
  EXPECT_EQ(ball.bounces, 1);
}

/// Locked phases: a run of project_flip that does not start on the drop loses 1 + 1 in two bounces, whatever its phase.
TEST(BounceLongRun, two_bounces_of_project_flip_lose_twice_the_mean) {
  const BounceCell cell = drop(1.0 / 240, 1);
  const double first_speed = 1 - delta(cell), d = delta(cell);
  for (const double elapsed : {0.2, 0.4, 0.7}) {
    const std::vector<double> energies = bounce_policy("project_flip").energies(cell, elapsed, 21);
    ASSERT_EQ(energies.size(), 21U);
    for (std::size_t n = 2; n < energies.size(); n += 2) {
      EXPECT_NEAR(std::sqrt(energies[n]), std::sqrt(energies[0]) - static_cast<double>(n) * d / 2, 1e-12) << elapsed;
    }
    EXPECT_GT(std::sqrt(energies[0]), first_speed);
  }
}

// Crowds: cases 56 to 62.

void expect_all_passed(const std::vector<BounceScenario>& scenarios, std::size_t count) {
  EXPECT_EQ(scenarios.size(), count);
  for (const BounceScenario& s : scenarios) {
    EXPECT_TRUE(s.passed) << s.name << "\nmust: " << s.must << "\nhappened: " << s.happened;
  }
}

TEST(BounceScenarios, case_56_bounces_pile_up_and_end) {
  const std::vector<double> times = zeno_times();
  ASSERT_EQ(times.size(), 54U);
  EXPECT_EQ(times[0], 1);
  EXPECT_EQ(times[1], 2);
  EXPECT_EQ(times[2], 2.5);
  EXPECT_EQ(times[3], 2.75);
  EXPECT_EQ(times[52], 3 - 0x1p-51);
  EXPECT_EQ(times[53], 3);
  expect_all_passed(zeno_scenarios(), 1);
}

TEST(BounceScenarios, case_57_a_million_bounces_in_a_gap) { expect_all_passed(gap_scenarios(), 2); }

/// The wall closes by its own motion alone: with a wall that stands still, nothing would be gained.
TEST(BounceScenarios, a_closing_wall_gives_speed) {
  FlyingBall ball = {{{0, 0, 0}, 0.5}, {1, 0, 0}};
  std::vector<FlyingWall> walls = {{{{2, 0, 0}, {1, 8, 8}}, {-0.25, 0, 0}}};
  EXPECT_EQ(fly_between(ball, walls, 1), 1);
  EXPECT_EQ(ball.velocity.x(), -1.5);
  EXPECT_NEAR(walls[0].shape.center.x(), 1.75, 1e-15);
}

TEST(BounceScenarios, case_58_blocks_count_the_digits_of_pi) {
  constexpr int most = testing::slow_build ? 4 : 7;  // all 31 million impacts: not where nothing is inlined
  constexpr std::size_t in_double = most + 1, in_float = std::min(most, 5) + 1;
  expect_all_passed(digit_scenarios(most), in_double + in_float);
  EXPECT_EQ(count_block_impacts<double>(3).impacts, 3141);
  EXPECT_EQ(count_block_impacts<float>(3).impacts, 3141);
}

TEST(BounceScenarios, case_59_masses_far_apart) {
  const LineSpeeds<double> light = after_impact({1.0, 0.0}, 1.0, 1e16, 1.0);
  EXPECT_EQ(light.a, -1);
  EXPECT_EQ(light.b, 2e-16);
  const LineSpeeds<double> heavy = after_impact({1.0, 0.0}, 1e16, 1.0, 1.0);
  EXPECT_NEAR(heavy.a, 1, 0x1p-52);
  EXPECT_EQ(heavy.b, 2);
  const LineSpeeds<double> dead = after_impact({1.0, 0.0}, 1.0, 3.0, 0.0);  // stick together
  EXPECT_EQ(dead.a, 0.25);
  EXPECT_EQ(dead.b, 0.25);
  expect_all_passed(mass_scenarios({1, 1e4, 1e8, 1e12, 1e16}), 9);
}

TEST(BounceScenarios, case_60_of_a_cradle_the_last_move) { expect_all_passed(cradle_scenarios(), 3); }

TEST(BounceScenarios, case_61_walls_hit_at_once_turn_every_speed_in_any_order) {
  expect_all_passed(corner_scenarios(), 2);
}

/// Two times of impact of 0, one after the other; and then the ball parts, so that there is no third.
TEST(BounceScenarios, a_ball_that_touches_both_walls_bounces_twice_at_once) {
  FlyingBall ball = {{{0, 0, 0}, 0.5}, {1, 1, 0}};
  std::vector<FlyingWall> walls = {{{{1.5, 0, 0}, {1, 8, 8}}, {0, 0, 0}}, {{{0, 1.5, 0}, {8, 1, 8}}, {0, 0, 0}}};
  EXPECT_EQ(fly_between(ball, walls, 1), 2);
  EXPECT_EQ(ball.velocity, Vec3<double>(-1, -1, 0));
  EXPECT_EQ(ball.shape.center, Vec3<double>(-1, -1, 0));
}

TEST(BounceScenarios, case_62_a_ball_at_rest_stays) { expect_all_passed(rest_scenarios(), 5); }

/// Whatever the restitution, also where every speed comes back whole.
TEST(BounceScenarios, rest_is_rest_at_every_restitution) {
  for (const double e : {0.0, 0.5, 1.0}) {
    const BouncingWorld world = {9.81, e, 1.0 / 60, floor_of_depth(8)};
    BouncingBall linear = ball_at(0, 0, 0.1), arc = linear;
    for (int i = 0; i < 1000; ++i) {
      LinearToi::step(world, linear);
      ParabolaToi::step(world, arc);
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
    for (int i = 0; i < 1000; ++i) ParabolaToi::step(world, ball);
    EXPECT_EQ(gap_of(ball), 0) << e;
    EXPECT_EQ(ball.velocity, 0) << e;
    EXPECT_LE(static_cast<double>(ball.bounces), e > 0 ? 2 - 60 * std::log(2) / std::log(e) : 1) << e;
  }
}

}  // namespace

}  // namespace thinwall
