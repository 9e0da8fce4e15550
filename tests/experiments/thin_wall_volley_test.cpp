/// A cell that is fired at in several volleys counts what it counts in one.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include <thinwall/experiments/thin_wall/plan.hpp>
#include <thinwall/experiments/thin_wall/volley.hpp>

#include "experiments/thin_wall_run.hpp"

namespace thinwall {
namespace {

TEST(ThinWallVolley, takes_every_shot_once) {
  for (const std::int64_t shots : {1, 99, 100, 101, 1000}) {
    std::int64_t next = 0;
    for (const Volley& volley : volleys_of(shots, 100)) {
      EXPECT_EQ(volley.first, next);
      EXPECT_GE(volley.shots, 1);
      EXPECT_LE(volley.shots, 100);
      next += volley.shots;
    }
    EXPECT_EQ(next, shots);
  }
}

TEST(ThinWallVolley, adds_up_to_the_same_tally_in_any_order) {
  for (const char* response : {"none", "bounce"}) {
    const Experiment experiment = thin_wall_experiment();
    const std::string text = std::string(small) + "response = \"" + response + "\"\n";
    const ShotPlan plan = make_plan(Settings(text, "test.toml", experiment.default_toml), {.seed = 1, .trials = 50});
    for (const Cell& cell : plan.cells) {
      for (const Detector& detector : plan.detectors) {
        const Tally whole = fire(cell, detector, {.first = 0, .shots = plan.shots}, plan.seed);
        Tally forward, backward;
        const auto volleys = volleys_of(plan.shots, 17);
        for (auto v = volleys.begin(); v != volleys.end(); ++v) forward += fire(cell, detector, *v, plan.seed);
        for (auto v = volleys.rbegin(); v != volleys.rend(); ++v) backward += fire(cell, detector, *v, plan.seed);
        EXPECT_EQ(forward, whole) << detector.method;
        EXPECT_EQ(backward, whole) << detector.method;
      }
    }
  }
}

TEST(ThinWallVolley, is_a_unit_of_its_own_in_a_large_run_and_the_whole_cell_in_a_small_one) {
  const auto keys = [](std::int64_t trials) {
    std::set<std::string> out;
    for (const Unit& unit : configured(small, {.seed = 1, .trials = trials})->units()) {
      EXPECT_LE(unit.trials, most_shots_a_volley);
      EXPECT_TRUE(out.insert(unit.key).second) << unit.key;
    }
    return out;
  };
  const auto one = keys(most_shots_a_volley), three = keys(2 * most_shots_a_volley + 1);
  EXPECT_EQ(one.begin()->find(" from "), std::string::npos);
  const auto stratified = static_cast<std::size_t>(
      std::ranges::count_if(one, [](const std::string& key) { return key.ends_with(" stratified"); }));
  EXPECT_EQ(three.size() - stratified, 3 * (one.size() - stratified));
}

/// Results made up for every unit; what comes out must depend on their sums alone.
TEST(ThinWallVolley, makes_a_line_of_the_volleys_of_a_cell) {
  const auto run = configured(small, {.seed = 1, .trials = 2 * most_shots_a_volley});
  const auto units = run->units();
  const auto whole = configured(small, {.seed = 1, .trials = 60});
  std::vector<std::string> in_one = results_of(whole->units()), in_two;
  std::size_t next = 0;
  for (const Unit& unit : units) {
    if (unit.key.ends_with(" from " + std::to_string(most_shots_a_volley))) {
      in_two.push_back(to_line(Tally{}));
    } else {
      in_two.push_back(in_one[next++]);
    }
  }
  const Outcome one = whole->finish(in_one, std::vector<double>(in_one.size(), 0.5));
  const Outcome two = run->finish(in_two, std::vector<double>(in_two.size(), 0.25));
  EXPECT_EQ(table_of(one, "cells").rows, table_of(two, "cells").rows);
  EXPECT_EQ(value_of(table_of(one, "timings"), 0, "nanoseconds_per_shot"),
            value_of(table_of(two, "timings"), 0, "nanoseconds_per_shot"));
}

TEST(ThinWallVolley, has_room_for_no_more_shots_a_cell_than_its_sums_do) {
  EXPECT_NO_THROW(configured(small, {.seed = 1, .trials = most_shots_a_cell}));
  EXPECT_THROW(configured(small, {.seed = 1, .trials = most_shots_a_cell + 1}), UsageError);
}

}  // namespace
}  // namespace thinwall
