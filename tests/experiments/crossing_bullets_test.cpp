/// The crossing bullets' answers: who misses, who hits what is not there, and does theory agree?
#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/self_test.hpp>

#include "experiments/crossing_bullets_run.hpp"

namespace thinwall {
namespace {

std::int64_t count(const Outcome& outcome, const char* table, const char* rule, const char* column) {
  return std::get<std::int64_t>(value_of(table_of(outcome, table), rule, column));
}

/// The failure is specified too.
TEST(CrossingBullets, two_bullets_head_on_pass_each_other) {
  const Outcome outcome = crossing_outcome(few_crossings);
  EXPECT_EQ(count(outcome, "head_on", "sweep_then_confirm", "touching"), 1000);
  EXPECT_GT(count(outcome, "head_on", "sweep_then_confirm", "missed"), 960);
  EXPECT_NEAR(static_cast<double>(count(outcome, "head_on", "end_of_step", "missed")), 840, 50);
  EXPECT_EQ(count(outcome, "head_on", "swept_overlap", "missed"), 0);
  EXPECT_EQ(count(outcome, "head_on", "closed_form", "missed"), 0);
}

TEST(CrossingBullets, sweeping_both_makes_false_hits_and_the_confirmed_are_none) {
  const Outcome outcome = crossing_outcome(few_crossings);
  EXPECT_GT(count(outcome, "rules", "swept_overlap", "false_hits"), 50);
  EXPECT_EQ(count(outcome, "rules", "swept_overlap", "missed"), 0);
  EXPECT_EQ(count(outcome, "rules", "sweep_then_confirm", "false_hits"), 0);
  EXPECT_GT(count(outcome, "rules", "sweep_then_confirm", "missed"), 3000);
  EXPECT_EQ(count(outcome, "rules", "closed_form", "missed"), 0);
  EXPECT_EQ(count(outcome, "rules", "closed_form", "false_hits"), 0);
}

TEST(CrossingBullets, says_what_the_rule_misses_and_why) {
  const std::string answer = crossing_outcome(few_crossings).answer;
  for (const char* part : {"true hits the tutorial's rule for two bodies misses", "where two bullets meet head-on",
                           "before the other ball arrives", "starts inside the track", "The closed form"}) {
    EXPECT_NE(answer.find(part), std::string::npos) << part << "\n" << answer;
  }
}

TEST(CrossingBullets, agrees_with_theory) {
  const Outcome outcome = crossing_outcome(few_crossings);
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_EQ(table_of(outcome, "self_test").rows.size(), 1U + 4 * 3);
  EXPECT_EQ(table_of(outcome, "times").rows.size(), 3U);
}

/// Lines of a run that is large enough to tell theories apart.
std::vector<CrossingLine> measured() {
  const Experiment experiment = crossing_bullets_experiment();
  const Settings settings("speed = [10, 300]\nratio = [0.5, 1]\nangle_deg = [30, 90, 150]\noffset = [1, 4]",
                          "test.toml", experiment.default_toml);
  const std::vector<std::string> names = {"swept_overlap", "end_of_step", "sweep_then_confirm", "closed_form"};
  const std::vector<Crossing> cells = make_crossings(settings);
  const std::vector<CrossingRule> rules = crossing_rules(names);
  std::vector<CrossingTally> tallies;
  for (const Crossing& c : cells) {
    for (const CrossingRule& rule : rules) tallies.push_back(ask_all(rule, c, 1, 10000));
  }
  return make_lines(cells, rules, tallies);
}

/// Does the self-test pass if one rule's expected reports are those of another theory?
bool passes(std::vector<CrossingLine> lines, const std::string& rule,
            const std::function<double(const CrossingLine&)>& theory) {
  for (CrossingLine& line : lines) {
    if (line.rule == rule) line.expected.reported = std::min(1.0, theory(line));
  }
  return all_passed(self_test(counts_of(lines)));
}

TEST(CrossingBullets, fails_a_wrong_theory) {
  const std::vector<CrossingLine> lines = measured();
  const auto confirmed = [](const CrossingLine& l) { return l.theory.confirmed.share; };
  EXPECT_TRUE(passes(lines, "sweep_then_confirm", confirmed));
  EXPECT_FALSE(passes(lines, "sweep_then_confirm", [](const CrossingLine& l) {  // forgets where a step begins and ends
    const double turn = l.crossing.angle_deg * (std::numbers::pi / 180), ratio = l.crossing.ratio;
    return l.theory.touch * std::sqrt(3.0) / std::numbers::pi * std::sin(turn) /
           std::sqrt(1 + ratio * ratio - 2 * ratio * std::cos(turn));
  }));
  EXPECT_FALSE(
      passes(lines, "sweep_then_confirm", [](const CrossingLine& l) { return l.theory.confirmed.share * 0.95; }));
  EXPECT_FALSE(passes(lines, "closed_form", [](const CrossingLine& l) {  // takes the disc for a segment
    return 1 / l.crossing.offset;
  }));
  EXPECT_FALSE(passes(lines, "swept_overlap", [](const CrossingLine& l) {  // tracks without ends
    const double k = l.crossing.offset;
    return 2 / std::numbers::pi * (std::asin(1 / k) + std::sqrt(k * k - 1) / (k * k));
  }));
  EXPECT_FALSE(passes(lines, "end_of_step", [](const CrossingLine& l) {  // takes the radius for the contact distance
    return l.theory.touch_at_end / 8;
  }));
}

TEST(CrossingBullets, fails_wrong_times) {
  const std::vector<CrossingLine> lines = measured();
  const auto passes_with = [&](const std::function<void(CrossingLine&)>& change) {
    std::vector<CrossingLine> changed = lines;
    for (CrossingLine& line : changed) change(line);
    const auto tests = timing_test(changed);
    return std::all_of(tests.begin(), tests.end(), [](const TimingTest& t) { return t.passed(); });
  };
  EXPECT_TRUE(passes_with([](CrossingLine&) {}));
  EXPECT_FALSE(passes_with([](CrossingLine& l) { l.theory.confirmed.lateness_mean *= 1.1; }));
  EXPECT_FALSE(passes_with([](CrossingLine& l) { l.tally.widest = 1e-6; }));    // apart at the answered time
  EXPECT_FALSE(passes_with([](CrossingLine& l) { l.tally.deepest = -1e-6; }));  // the closed form would be late
  EXPECT_FALSE(passes_with([](CrossingLine& l) { l.tally.latest = 1; }));       // after contact has ended
}

TEST(CrossingBullets, every_miss_has_a_cause) {
  for (const CrossingLine& line : measured()) {
    const MissCauses& c = line.tally.causes;
    EXPECT_EQ(c.inside + c.too_early + c.too_late + c.beside,
              line.rule == "sweep_then_confirm" ? line.tally.missed : 0);
  }
}

TEST(CrossingBullets, does_not_depend_on_the_order_of_the_units) {
  const auto run = crossing_run(few_crossings);
  std::vector<Unit> units = run->units();
  const std::vector<std::string> forward = results_of(units);
  std::reverse(units.begin(), units.end());
  std::vector<std::string> backward = results_of(units);
  std::reverse(backward.begin(), backward.end());
  EXPECT_EQ(forward, backward);
}

TEST(CrossingBullets, a_cell_keeps_its_encounters_whatever_else_is_asked) {
  const Table all = table_of(crossing_outcome(few_crossings), "cells");
  const Table one =
      table_of(crossing_outcome(
                   "speed = [10]\nratio = [0.5]\nangle_deg = [90]\noffset = [4]\nshots = 1000\nrule = ['end_of_step']"),
               "cells");
  ASSERT_EQ(one.rows.size(), 2U);  // head-on, and the cell
  for (const std::vector<Value>& row : one.rows) {
    EXPECT_NE(std::find(all.rows.begin(), all.rows.end(), row), all.rows.end());
  }
}

}  // namespace
}  // namespace thinwall
