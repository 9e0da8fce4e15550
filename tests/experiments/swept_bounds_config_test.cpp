/// The swept bounds' settings and the form of what they hand over.
#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/swept_bounds/timing.hpp>

#include "experiments/swept_bounds_run.hpp"

namespace thinwall {
namespace {

constexpr const char* few_timed =
    "shape = ['sphere', 'cube']\nspeed = [10]\nangle_deg = [45]\nturn_deg = [0]\nobstacle = [1]\nshots = 100\n"
    "timing_repeats = 2";

TEST(SweptBoundsConfig, unit_keys_are_unique) {
  std::vector<std::string> keys;
  for (const Unit& unit : sweep_run("")->units()) keys.push_back(unit.key);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST(SweptBoundsConfig, trials_override_the_shots) {  // around the bound, and as many that just touch
  EXPECT_EQ(sweep_run(few_sweeps, {.seed = 1, .trials = 7})->units().front().trials, 14);
}

TEST(SweptBoundsConfig, opens_with_the_diagonals_and_asks_no_cell_twice) {
  const Experiment experiment = swept_bounds_experiment();
  const SweepPlan plan = make_sweeps(Settings("", "test.toml", experiment.default_toml));
  EXPECT_EQ(plan.cells[0], diagonals[0]);
  EXPECT_EQ(plan.cells[1], diagonals[1]);
  for (const Sweep& s : plan.cells) EXPECT_EQ(std::count(plan.cells.begin(), plan.cells.end(), s), 1) << key(s);
  EXPECT_EQ(plan.view, diagonals[1]);
}

TEST(SweptBoundsConfig, draws_what_is_nearest_to_the_diagonal) {
  const Experiment experiment = swept_bounds_experiment();
  const SweepPlan plan = make_sweeps(
      Settings("speed = [1, 8, 90]\nangle_deg = [0, 40, 80]\nobstacle = [0, 3]", "test.toml", experiment.default_toml));
  EXPECT_EQ(plan.view.speed, 8);
  EXPECT_EQ(plan.view.angle_deg, 40);
  EXPECT_EQ(plan.view.obstacle, 0);
  const SweepPlan along_x =
      make_sweeps(Settings("angle_deg = [0]\nturn_deg = [45]", "test.toml", experiment.default_toml));
  EXPECT_EQ(along_x.view.turn_deg, 0);  // what goes along x is turned by nothing
}

TEST(SweptBoundsConfig, every_row_is_as_long_as_its_columns_and_every_column_is_described) {
  for (const Table& t : sweep_outcome(few_timed).tables) {
    for (const std::vector<Value>& row : t.rows) ASSERT_EQ(row.size(), t.columns.size()) << t.name;
    for (const Column& column : t.columns) {
      EXPECT_FALSE(column.description.empty()) << t.name << " " << column.name;
      EXPECT_EQ(column.unit.empty(), column.type == ColumnType::text || column.type == ColumnType::boolean)
          << t.name << " " << column.name;
    }
  }
}

TEST(SweptBoundsConfig, summary_fits_a_terminal) {
  std::istringstream summary(sweep_outcome(few_timed).summary);
  for (std::string line; std::getline(summary, line);) EXPECT_LE(line.size(), 100U) << line;
}

/// Only the table of times may know how long anything took.
TEST(SweptBoundsConfig, what_is_not_a_timing_does_not_depend_on_the_clock) {
  const auto run = sweep_run(few_timed);
  const std::vector<std::string> results = results_of(run->units());
  const Outcome fast = run->finish(results, std::vector<double>(results.size(), 1e-6));
  const Outcome slow = run->finish(results, std::vector<double>(results.size(), 1));
  EXPECT_EQ(fast.answer, slow.answer);
  ASSERT_EQ(fast.tables.size(), slow.tables.size());
  for (std::size_t i = 0; i < fast.tables.size(); ++i) {
    EXPECT_EQ(fast.tables[i].rows == slow.tables[i].rows, !fast.tables[i].is_timing) << fast.tables[i].name;
  }
  EXPECT_EQ(fast.tables.back().rows.size(), 4U + 6U);  // a sphere's bounds, and a cube's
  EXPECT_TRUE(fast.tables.back().is_timing);
}

TEST(SweptBoundsConfig, times_are_medians_over_the_rounds) {
  const std::vector<std::string> names = {"capsule"};
  const std::vector<SweptBound> bounds = swept_bounds_named(names);
  const auto subjects = timed_subjects({diagonals[1]}, bounds, 1);
  ASSERT_EQ(subjects.size(), 4U);
  std::vector<double> seconds;
  for (const double round : {9.0, 1.0, 3.0}) {
    for (const TimedSubject& t : subjects) seconds.push_back(1e-9 * round * static_cast<double>(t.tests()));
  }
  const std::vector<SweepCost> costs = sweep_costs(subjects, seconds);
  ASSERT_EQ(costs.size(), 1U);
  EXPECT_NEAR(costs[0].test_ns, 3, 1e-9);
  EXPECT_NEAR(costs[0].pair_lower_ns, 2, 1e-9);
  EXPECT_NEAR(costs[0].pair_upper_ns, 6, 1e-9);
  EXPECT_NEAR(costs[0].wasted_ns(), 3 * costs[0].false_hits, 1e-9);
  EXPECT_GT(costs[0].false_hits, 0);
}

TEST(SweptBoundsConfig, answers_for_any_choice_of_bounds_and_shapes) {
  for (const char* text : {"bound = ['closed_form']", "shape = ['sphere']\nbound = ['capsule']", "obstacle = [0]",
                           "angle_deg = [0]", "shape = ['plate']\nturn_deg = [90]\nangle_deg = [90]"}) {
    const Outcome outcome = sweep_outcome(std::string("speed = [10]\nshots = 50\ntiming_repeats = 0\n") + text);
    EXPECT_NE(outcome.answer.find("the bounds miss 0"), std::string::npos) << outcome.answer;
    EXPECT_TRUE(outcome.self_test_passed) << text;
  }
}

TEST(SweptBoundsConfig, refuses_what_cannot_be_asked) {
  const auto refusal = [](const char* text) -> std::string {
    try {
      sweep_run(text);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  for (const char* text : {"speed = [0]",         "speed = [nan]",    "speed = []",
                           "speed = [1e-6]",      "speed = [1e8]",    "step = 0",
                           "step = [0.1]",        "width = 0",        "width = -1",
                           "width = 1e-200",      "shape = ['ball']", "shape = []",
                           "angle_deg = [91]",    "angle_deg = [-1]", "turn_deg = [100]",
                           "obstacle = [-0.5]",   "obstacle = [inf]", "shots = 0",
                           "timing_repeats = -1", "bound = ['box']",  "shape = ['sphere']\nbound = ['oriented_box']",
                           "turn = [0]"}) {
    EXPECT_NE(refusal(text), "") << text;
  }
  EXPECT_NE(refusal("bound = ['oriented_bax']").find("did you mean 'oriented_box'?"), std::string::npos);
  EXPECT_NE(refusal("speed = [1e8]").find("a path of 0.001 to 10000 widths a step"), std::string::npos);
  EXPECT_NE(refusal("angle_deg = [91]").find("key 'angle_deg'"), std::string::npos);
}

TEST(SweepTally, survives_its_line) {
  const SweepTally tally = {.shots = 9, .touching = 8, .reported = 7, .false_hits = 6, .grazing = 5, .missed = 4};
  EXPECT_EQ(sweep_tally_from_line(to_line(tally)), tally);
  EXPECT_THROW(sweep_tally_from_line("1 2 3"), std::runtime_error);
  EXPECT_THROW(sweep_tally_from_line(to_line(tally) + " 4"), std::runtime_error);
}

}  // namespace
}  // namespace thinwall
