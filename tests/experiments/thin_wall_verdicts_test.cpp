/// What the thin wall's own tests must catch: made-up counts that are wrong.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/thin_wall/lateness_test.hpp>
#include <thinwall/experiments/thin_wall/stratified.hpp>

#include "experiments/thin_wall_run.hpp"

namespace thinwall {
namespace {

ShotPlan small_plan() {
  return make_plan(Settings(small, "test.toml", thin_wall_experiment().default_toml), {.seed = 1, .trials = {}});
}

/// One line of the bullet for each detector, all detected exactly on time.
std::vector<Line> punctual(const ShotPlan& plan) {
  const Tally tally = {.shots = 100, .latest = 0, .earliest = 0, .widest = 0};
  const std::size_t count = plan.cells.size() * plan.detectors.size();
  std::vector<Line> lines = make_lines(plan, std::vector<Tally>(count, tally), std::vector<double>(count));
  lines.resize(plan.detectors.size());
  return lines;
}

const LatenessTest& of(const std::vector<LatenessTest>& tests, const std::string& method) {
  return *std::find_if(tests.begin(), tests.end(), [&](const LatenessTest& test) { return test.method == method; });
}

TEST(LatenessTest, wants_the_closed_form_on_time_and_poses_late) {
  const ShotPlan plan = small_plan();
  const auto tests = lateness_test(punctual(plan));
  EXPECT_TRUE(of(tests, "closed_form").passed());
  EXPECT_FALSE(of(tests, "end_of_step").passed());  // its mean cannot be 0
}

/// A method that always says "hit" would never tunnel.
TEST(LatenessTest, catches_false_hits) {
  const ShotPlan plan = small_plan();
  std::vector<Line> lines = punctual(plan);
  for (Line& line : lines) line.tally.widest = 1e-3;
  EXPECT_EQ(of(lateness_test(lines), "closed_form").false_cells, 1);
  EXPECT_FALSE(of(lateness_test(lines), "closed_form").passed());
}

TEST(LatenessTest, catches_what_is_later_than_it_can_be) {
  const ShotPlan plan = small_plan();
  std::vector<Line> lines = punctual(plan);
  for (Line& line : lines) line.tally.latest = 0.0501;  // end_of_step: at most 5 cm
  EXPECT_EQ(of(lateness_test(lines), "end_of_step").late_cells, 1);
  for (Line& line : lines) line.tally.latest = 0.05;
  EXPECT_EQ(of(lateness_test(lines), "end_of_step").late_cells, 0);
}

TEST(Stratified, passes_the_true_counts_and_catches_two_too_many) {
  const StratifiedPlan plan = stratified_plan(small_plan());
  ASSERT_FALSE(plan.cells.empty());
  std::vector<std::string> counts;
  for (const Cell& cell : plan.cells) counts.push_back(stratified_counts(cell, plan.detectors, 1));
  for (const StratifiedTest& test : stratified_test(plan, counts)) EXPECT_TRUE(test.passed()) << test.method;
  counts.front() = "708" + counts.front().substr(counts.front().find(' '));  // 0.7 * 1009 = 706.3
  EXPECT_FALSE(stratified_test(plan, counts).front().passed());
}

/// Evenly spread for any number of poses a step: the number of phases has no divisor that could be one.
TEST(Stratified, number_of_phases_is_prime) {
  for (std::int64_t divisor = 2; divisor < stratified_shots; ++divisor) ASSERT_NE(stratified_shots % divisor, 0);
}

TEST(Stratified, fires_infinite_walls_in_double_only) {
  const StratifiedPlan plan = stratified_plan(small_plan());
  for (const Cell& cell : plan.cells) EXPECT_EQ(cell.wall, Wall::infinite);
  for (const Detector& detector : plan.detectors) EXPECT_EQ(detector.scalar, "double");
}

}  // namespace
}  // namespace thinwall
