/// Hitscan's answers: what the ray misses and hits falsely, how late the next frame is, and does theory agree?
#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/self_test.hpp>

#include "experiments/hitscan_run.hpp"

namespace thinwall {
namespace {

const std::vector<HitscanRule> all_rules = {hitscan_ray, hitscan_ball, next_frame, swept_steps};

/// The target's center, seen from a point along the line of fire at the range: upward, and to the side.
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
  EXPECT_NEAR(mean(tally.lateness, time_unit(c)), c.step / 2, 0.03 * c.step);
}

TEST(Hitscan, says_what_the_ray_misses) {
  const std::string answer = hitscan_outcome(few_hitscans).answer;
  for (const char* part :
       {"Of the true hits the ray misses", "with a rifle at 100 m (theory 28.7 %", "The flight time decides",
        "It has no radius", "late on average", "The ball swept along each step"}) {
    EXPECT_NE(answer.find(part), std::string::npos) << part << "\n" << answer;
  }
}

TEST(Hitscan, agrees_with_theory) {
  const Outcome outcome = hitscan_outcome(few_hitscans);
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_EQ(table_of(outcome, "self_test").rows.size(), 1U + 4 * 3);
  EXPECT_EQ(table_of(outcome, "moments").rows.size(), 4U * 2);
}

/// Lines of a run that is large enough to tell theories apart.
const std::vector<HitscanLine>& measured() {
  static const std::vector<HitscanLine> lines = [] {
    const Experiment experiment = hitscan_experiment();
    const Settings settings("range = [5, 20, 100]\nspeed = [30, 300]\nradius = [0, 0.02]\nwind = [5]", "test.toml",
                            experiment.default_toml);
    const std::vector<HitscanCell> cells = make_hitscan_cells(settings);
    std::vector<std::vector<HitscanTally>> tallies;
    for (const HitscanCell& c : cells) tallies.push_back(shoot(all_rules, c, 1, 10000));
    return make_hitscan_lines(cells, all_rules, tallies);
  }();
  return lines;
}

using Share = std::function<double(const HitscanLine&)>;

/// Does the self-test pass if one rule's expected number is that of another theory?
bool passes(const HitscanRule& rule, double HitscanExpected::*field, const Share& theory) {
  std::vector<HitscanLine> lines = measured();
  for (HitscanLine& line : lines) {
    if (line.rule.name == rule.name) line.expected.*field = std::clamp(theory(line), 0.0, 1.0);
  }
  return all_passed(self_test(counts_of(lines)));
}

TEST(Hitscan, fails_a_wrong_theory) {
  using E = HitscanExpected;
  EXPECT_TRUE(passes(hitscan_ray, &E::missed, [](const HitscanLine& l) { return l.expected.missed; }));
  EXPECT_FALSE(passes(hitscan_ray, &E::missed, [](const HitscanLine& l) { return 0.95 * l.expected.missed; }));
  EXPECT_FALSE(passes(hitscan_ray, &E::missed, [](const HitscanLine& l) {  // forgets drag and wind
    const double time = l.cell.range / l.cell.speed;
    return l.expected.touch * flat_missed(l.cell.target, l.cell.radius, l.cell.gravity * time * time / 2);
  }));
  EXPECT_FALSE(passes(hitscan_ray, &E::missed, [](const HitscanLine& l) {  // forgets the radius
    return l.expected.touch * flat_missed(l.cell.target, 0, deflection(l.cell));
  }));
  EXPECT_FALSE(
      passes(hitscan_ray, &E::false_hits, [](const HitscanLine& l) {  // takes the target for as large as the reach
        return l.expected.reported * flat_false(l.cell.target + l.cell.radius, 0, deflection(l.cell));
      }));
  EXPECT_FALSE(passes(hitscan_ball, &E::missed, [](const HitscanLine&) { return 0; }));  // forgets that bullets fall
  EXPECT_FALSE(passes(next_frame, &E::missed, [](const HitscanLine&) { return 0; }));    // forgets the radius
  EXPECT_FALSE(passes(next_frame, &E::reported, [](const HitscanLine& l) { return l.expected.touch; }));
  EXPECT_FALSE(passes(swept_steps, &E::missed, [](const HitscanLine&) { return 0; }));  // forgets the chord
  std::vector<HitscanLine> flat = measured();
  for (HitscanLine& l : flat)
    l.expected.touch *= l.cell.aim * reach(l.cell) / disc_radius(l.cell);  // forgets the slope
  EXPECT_FALSE(all_passed(self_test(counts_of(flat))));
}

TEST(Hitscan, fails_wrong_errors) {
  const auto passes_with = [](const std::function<void(HitscanLine&)>& change) {
    std::vector<HitscanLine> changed = measured();
    for (HitscanLine& line : changed) change(line);
    const auto tests = moment_tests(changed);
    return std::all_of(tests.begin(), tests.end(), [](const HitscanMomentTest& t) { return t.passed(); });
  };
  EXPECT_TRUE(passes_with([](HitscanLine&) {}));
  EXPECT_FALSE(passes_with([](HitscanLine& l) { l.expected.path_error.mean *= 1.05; }));
  EXPECT_FALSE(passes_with([](HitscanLine& l) { l.expected.path_error_most *= 0.999; }));
  EXPECT_FALSE(passes_with([](HitscanLine& l) {  // forgets that the ball touches before its center
    if (l.expected.lateness) l.expected.lateness->mean = l.cell.step / 2;
  }));
  EXPECT_FALSE(passes_with([](HitscanLine& l) { l.tally.lateness.most = 2 * l.cell.step; }));
  EXPECT_FALSE(passes_with([](HitscanLine& l) { l.tally.lateness.least = -2 * contact_window(l.cell).until; }));
}

TEST(Hitscan, does_not_depend_on_the_order_of_the_units) {
  const auto run = hitscan_run(few_hitscans);
  std::vector<Unit> units = run->units();
  const std::vector<std::string> forward = results_of(units);
  std::reverse(units.begin(), units.end());
  std::vector<std::string> backward = results_of(units);
  std::reverse(backward.begin(), backward.end());
  EXPECT_EQ(forward, backward);
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

}  // namespace
}  // namespace thinwall
