/// Hitscan's answers: what the ray misses and hits falsely, how late the next frame is, and does theory agree?
#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/lab/judge.hpp>

#include "experiments/hitscan_run.hpp"

namespace thinwall {
namespace {

const std::vector<HitscanRule> all_rules(hitscan_rules.begin(), hitscan_rules.end());

/// The target's center, seen from a point along the row of fire at the range: upward, and to the side.
Placement target_at(const HitscanCell& c, double up, double side, double phase) {
  return {{{c.range, up, side}, c.target}, phase};
}
bool hits(const HitscanRule& rule, const HitscanCell& c, const Placement& p) { return answer_of(rule, c, p).hit; }

TEST(Hitscan, the_ray_hits_what_the_bullet_falls_short_of) {
  const HitscanCell c = some_shot(100, 300, 0.004);
  const Placement ahead = target_at(c, 0, 0, 0.3);
  ASSERT_GT(deflection(c), c.target + c.radius);
  EXPECT_FALSE(true_impact(c, ahead.target.center).touches);
  EXPECT_TRUE(hits(hitscan_ray, c, ahead));
  EXPECT_FALSE(hits(next_frame, c, ahead));
  EXPECT_FALSE(hits(swept_steps, c, ahead));
  const Vec3<double> fallen = pull_direction(c) * deflection(c);
  const Placement below = target_at(c, fallen[1], fallen[2], 0.3);
  EXPECT_TRUE(true_impact(c, below.target.center).touches);
  EXPECT_FALSE(hits(hitscan_ray, c, below));
  EXPECT_FALSE(hits(hitscan_ball, c, below));
  EXPECT_TRUE(hits(next_frame, c, below));
  EXPECT_TRUE(hits(swept_steps, c, below));
}

TEST(Hitscan, a_ray_misses_what_only_the_radius_touches) {
  const HitscanCell c = some_shot(3, 1000, 0.02);  // as good as straight
  const Placement beside = target_at(c, 0, 0.16, 0.3);
  EXPECT_TRUE(true_impact(c, beside.target.center).touches);
  EXPECT_FALSE(hits(hitscan_ray, c, beside));
  EXPECT_FALSE(hits(next_frame, c, beside));
  EXPECT_TRUE(hits(hitscan_ball, c, beside));
  EXPECT_TRUE(hits(swept_steps, c, beside));
}

/// 30 m in steps of 5 m from 1.5 m on: the center reaches the target at 29.85 m, in the step from 26.5 to 31.5 m.
TEST(Hitscan, reports_when_its_rule_says) {
  HitscanCell c = some_shot(30, 300, 0);
  c.gravity = 0;
  c.drag = 0;
  c.wind = 0;
  const Placement p = target_at(c, 0, 0, 0.7);
  const double touch = 29.85 / 300;
  EXPECT_NEAR(true_impact(c, p.target.center).time, touch, 1e-12);
  EXPECT_EQ(answer_of(hitscan_ray, c, p).time, 0);
  EXPECT_EQ(answer_of(hitscan_ball, c, p).time, 0);
  EXPECT_NEAR(answer_of(next_frame, c, p).time, 31.5 / 300, 1e-12);
  EXPECT_NEAR(answer_of(swept_steps, c, p).time, touch, 1e-12);
  for (const HitscanRule& rule : all_rules) {
    EXPECT_LT((answer_of(rule, c, p).point - Vec3<double>(29.85, 0, 0)).norm(), 1e-12) << rule.name;
  }
}

/// Head-on, without anything that pulls, an instant ray and a real bullet are the same but for time.
TEST(Hitscan, nothing_differs_where_nothing_pulls) {
  HitscanCell c = some_shot(30, 100, 0);
  c.gravity = 0;
  c.wind = 0;
  const auto tallies = shoot(all_rules, c, 1, 2000);
  for (std::size_t k = 0; k < all_rules.size(); ++k) {
    EXPECT_GT(tallies[k].touching, 1000) << all_rules[k].name;
    EXPECT_EQ(tallies[k].missed, 0) << all_rules[k].name;
    EXPECT_EQ(tallies[k].false_hits, 0) << all_rules[k].name;
    EXPECT_EQ(tallies[k].path_error.most, 0) << all_rules[k].name;
    EXPECT_LT(tallies[k].point_error.most, 1e-6) << all_rules[k].name;  // of a graze the point is worth half the digits
  }
}

TEST(Hitscan, the_next_frame_is_up_to_a_step_late) {
  HitscanCell c = some_shot(100, 1000, 0);
  c.drag = 0;
  const HitscanTally tally = shoot(std::vector{next_frame}, c, 1, 5000).front();
  const double window = contact_window(c).until - contact_window(c).from;  // a lower path enters the ball elsewhere
  EXPECT_GE(tally.lateness.least, -window);
  EXPECT_LT(tally.lateness.least, 0.01 * c.step);
  EXPECT_LE(tally.lateness.most, c.step + window);
  EXPECT_GT(tally.lateness.most, 0.99 * c.step);
  EXPECT_NEAR(tally.lateness.mean(time_unit(c)), c.step / 2, 0.03 * c.step);
}

TEST(Hitscan, agrees_with_theory_and_says_what_the_ray_misses) {
  const Outcome outcome = hitscan_outcome(few_hitscans);
  EXPECT_NE(outcome.answer.find("with a rifle at 100 m (theory 28.7 %"), std::string::npos) << outcome.answer;
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_EQ(table_of(outcome, "self_test").rows.size(), 1U + 4 * 3);
  EXPECT_EQ(table_of(outcome, "moments").rows.size(), 4U * 2);
  ASSERT_EQ(outcome.figures.size(), 3U);
  EXPECT_EQ(outcome.figures[0].panels.size(), 3U);
  EXPECT_EQ(outcome.figures[2].panels.size(), 2U);
}

/// Lines of a run that is large enough to tell theories apart.
const std::vector<HitscanRow>& measured() {
  static const std::vector<HitscanRow> rows = [] {
    const Experiment experiment = hitscan_experiment();
    const Settings settings("range = [5, 20, 100]\nspeed = [30, 300]\nradius = [0, 0.02]\nwind = [5]", "test.toml",
                            experiment.default_toml);
    const std::vector<HitscanCell> cells = make_hitscan_cells(settings);
    std::vector<std::vector<HitscanTally>> tallies;
    for (const HitscanCell& c : cells) tallies.push_back(shoot(all_rules, c, 1, 10000));
    return hitscan_rows(cells, all_rules, tallies);
  }();
  return rows;
}

using Share = std::function<double(const HitscanRow&)>;

/// Does the self-test pass if one rule's expected number is that of another theory?
bool passes(const HitscanRule& rule, double HitscanExpected::*field, const Share& theory) {
  std::vector<HitscanRow> rows = measured();
  for (HitscanRow& row : rows) {
    if (row.rule.name == rule.name) row.expected.*field = std::clamp(theory(row), 0.0, 1.0);
  }
  return all_passed(self_test(counts_of(rows)));
}

TEST(Hitscan, fails_a_wrong_theory) {
  using E = HitscanExpected;
  EXPECT_TRUE(passes(hitscan_ray, &E::missed, [](const HitscanRow& r) { return r.expected.missed; }));
  EXPECT_FALSE(passes(hitscan_ray, &E::missed, [](const HitscanRow& r) { return 0.95 * r.expected.missed; }));
  EXPECT_FALSE(passes(hitscan_ray, &E::missed, [](const HitscanRow& r) {  // forgets drag and wind
    const double time = r.cell.range / r.cell.speed;
    return r.expected.touch * flat_missed(r.cell.target, r.cell.radius, r.cell.gravity * time * time / 2);
  }));
  EXPECT_FALSE(passes(hitscan_ray, &E::missed, [](const HitscanRow& r) {  // forgets the radius
    return r.expected.touch * flat_missed(r.cell.target, 0, deflection(r.cell));
  }));
  EXPECT_FALSE(
      passes(hitscan_ray, &E::false_hits, [](const HitscanRow& r) {  // takes the target for as large as the reach
        return r.expected.reported * flat_false(r.cell.target + r.cell.radius, 0, deflection(r.cell));
      }));
  EXPECT_FALSE(passes(hitscan_ball, &E::missed, [](const HitscanRow&) { return 0; }));  // forgets that bullets fall
  EXPECT_FALSE(passes(next_frame, &E::missed, [](const HitscanRow&) { return 0; }));    // forgets the radius
  EXPECT_FALSE(passes(next_frame, &E::reported, [](const HitscanRow& r) { return r.expected.touch; }));
  EXPECT_FALSE(passes(swept_steps, &E::missed, [](const HitscanRow&) { return 0; }));  // forgets the chord
  std::vector<HitscanRow> flat = measured();
  for (HitscanRow& r : flat) r.expected.touch *= r.cell.aim * reach(r.cell) / disc_radius(r.cell);  // forgets the slope
  EXPECT_FALSE(all_passed(self_test(counts_of(flat))));
}

TEST(Hitscan, fails_wrong_errors) {
  const auto passes_with = [](const std::function<void(HitscanRow&)>& change) {
    std::vector<HitscanRow> changed = measured();
    for (HitscanRow& row : changed) change(row);
    const auto tests = moment_tests(changed);
    return std::all_of(tests.begin(), tests.end(), [](const HitscanMomentTest& t) { return t.passed(); });
  };
  EXPECT_TRUE(passes_with([](HitscanRow&) {}));
  EXPECT_FALSE(passes_with([](HitscanRow& r) { r.expected.path_error.mean *= 1.05; }));
  EXPECT_FALSE(passes_with([](HitscanRow& r) { r.expected.path_error_most *= 0.999; }));
  EXPECT_FALSE(passes_with([](HitscanRow& r) {  // forgets that the ball touches before its center
    if (r.expected.lateness) r.expected.lateness->mean = r.cell.step / 2;
  }));
  EXPECT_FALSE(passes_with([](HitscanRow& r) { r.tally.lateness.most = 2 * r.cell.step; }));
  EXPECT_FALSE(passes_with([](HitscanRow& r) { r.tally.lateness.least = -2 * contact_window(r.cell).until; }));
}

TEST(Hitscan, a_cell_keeps_its_shots_whatever_else_is_asked) {
  const Table all = table_of(hitscan_outcome(few_hitscans), "cells");
  const Table one = table_of(hitscan_outcome("range = [30]\nspeed = [300]\nradius = [0.02]\nwind = [5]\nshots = 1000\n"
                                             "rule = ['next_frame']"),
                             "cells");
  ASSERT_EQ(one.rows.size(), known_shots.size() + 1);
  for (const std::vector<Value>& row : one.rows) {
    EXPECT_NE(std::find(all.rows.begin(), all.rows.end(), row), all.rows.end());
  }
}

std::vector<HitscanCell> cells_of(const char* text) {
  const Experiment experiment = hitscan_experiment();
  return make_hitscan_cells(Settings(text, "test.toml", experiment.default_toml));
}

TEST(HitscanConfig, opens_with_the_known_shots) {
  const auto cells = cells_of("");
  for (std::size_t i = 0; i < known_shots.size(); ++i) EXPECT_EQ(cells[i], known_shots[i].cell);
}

TEST(HitscanConfig, takes_every_combination_that_arrives) {
  const std::size_t known = known_shots.size();
  EXPECT_EQ(cells_of("range = [3, 10]\nspeed = [30, 300]\nradius = [0, 0.02]\nwind = [0, 5]").size(), known + 16);
  // At half its speed a second a bullet of 30 m/s comes to rest at 60 m.
  EXPECT_EQ(cells_of("range = [3, 100]\nspeed = [30]\nradius = [0]\nwind = [0]").size(), known + 1);
  // Without drag it gets everywhere, and wind does nothing: two winds are one cell.
  const auto still = cells_of("range = [100]\nspeed = [30]\nradius = [0]\nwind = [0, 5]\ndrag = [0]");
  ASSERT_EQ(still.size(), known + 1);
  EXPECT_EQ(still.back().wind, 0);
}

/// Without the rules of the question, and without anything that pulls, there is still an answer.
TEST(HitscanConfig, answers_for_any_choice_of_rules) {
  const Outcome outcome = hitscan_outcome("rule = ['hitscan_ball']\nrange = [3]\nspeed = [30]\nshots = 20");
  EXPECT_NE(outcome.answer.find("hitscan_ball misses"), std::string::npos) << outcome.answer;
  const Outcome weightless =
      hitscan_outcome("gravity = 0\nwind = [0]\nrange = [3]\nspeed = [30]\nradius = [0]\nshots = 200");
  EXPECT_TRUE(weightless.self_test_passed) << weightless.summary;
  EXPECT_FALSE(weightless.answer.empty());
}

/// What a factor's range allows is the factor's own; this is what goes together, or not.
TEST(HitscanConfig, refuses_what_does_not_go_together) {
  struct Refusal {
    const char *text, *reason;
  };
  for (const auto& [text, reason] : {Refusal{"range = [0.2]", "more than 2 * (target + radius)"},
                                     Refusal{"target = [2]\nrange = [3]", "more than 2 * (target + radius)"},
                                     Refusal{"speed = [3]\nrange = [3]", "fast enough to fly nearly straight"},
                                     Refusal{"speed = [30]\nrange = [100]", "a range that some bullet reaches"},
                                     Refusal{"drag = [40]\nspeed = [1000]\nrange = [3]", "drag * step at most 0.5"},
                                     Refusal{"step = [1e-9]", "a path of at least 0.01"},
                                     Refusal{"rule = ['next_fram']", "did you mean 'next_frame'?"}}) {
    try {
      hitscan_run(text);
      ADD_FAILURE() << text;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace thinwall
