/// The thin wall's settings and the form of what it hands over.
#include <algorithm>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/thin_wall/plan.hpp>

#include "experiments/thin_wall_run.hpp"

namespace thinwall {
namespace {

TEST(ThinWallConfig, unit_keys_are_unique) {
  std::vector<std::string> keys;
  for (const Unit& unit : configured(small)->units()) keys.push_back(unit.key);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST(ThinWallConfig, trials_override_the_shots) {
  const auto units = configured(small, {.seed = 1, .trials = 7})->units();
  EXPECT_EQ(units.front().trials, 7);
}

TEST(ThinWallConfig, every_row_is_as_long_as_its_columns) {
  for (const Table& t : outcome_of(*configured(small)).tables) {
    for (const std::vector<Value>& row : t.rows) ASSERT_EQ(row.size(), t.columns.size()) << t.name;
  }
}

TEST(ThinWallConfig, summary_fits_a_terminal_and_opens_with_the_bullet) {
  std::istringstream summary(outcome_of(*configured(small)).summary);
  std::string line;
  for (int number = 0; std::getline(summary, line); ++number) {
    EXPECT_LE(line.size(), 100U) << line;
    if (number == 0) {
      EXPECT_NE(line.find("bullet at 10 m/s"), std::string::npos);
    }
    if (number == 3) {
      EXPECT_EQ(line.substr(0, 11), "end_of_step");
    }
  }
}

TEST(ThinWallConfig, fires_every_method_of_the_list_by_default) {
  const auto units = configured("")->units();
  for (const std::string_view method : method_names()) {
    EXPECT_TRUE(std::any_of(units.begin(), units.end(), [&](const Unit& unit) {
      return unit.key.find(method) != std::string::npos;
    })) << method;
  }
}

/// What the default run promises.
TEST(ThinWallConfig, default_fires_ten_million_shots_over_the_whole_range) {
  std::int64_t shots = 0;
  for (const Unit& unit : configured("")->units()) shots += unit.trials;
  EXPECT_GE(shots, 10'000'000);
  const Experiment experiment = thin_wall_experiment();
  const ShotPlan plan = make_plan(Settings("", "test.toml", experiment.default_toml), {});
  const auto has = [&](const std::function<bool(const Cell&)>& test) {
    return std::any_of(plan.cells.begin(), plan.cells.end(), test);
  };
  EXPECT_TRUE(has([](const Cell& c) { return c.speed == 1; }) && has([](const Cell& c) { return c.speed == 2000; }));
  EXPECT_TRUE(has([](const Cell& c) { return c.step == 1e-3; }) &&
              has([](const Cell& c) { return c.step == 1.0 / 30; }));
  EXPECT_TRUE(has([](const Cell& c) { return c.thickness == 1e-4; }) &&
              has([](const Cell& c) { return c.thickness == 0.1; }));
  EXPECT_TRUE(has([](const Cell& c) { return c.angle_deg == 0; }) &&
              has([](const Cell& c) { return c.angle_deg == 80; }));
}

TEST(ThinWallConfig, refuses_what_cannot_be_fired) {
  for (const char* text : {"speed = [0]",
                           "speed = [nan]",
                           "speed = []",
                           "step = [0]",
                           "radius = [-0.1]",
                           "thickness = [inf]",
                           "angle_deg = [90]",
                           "angle_deg = [-1]",
                           "method = ['closedform']",
                           "wall = ['thick']",
                           "scalar = ['half']",
                           "substeps = [1]",
                           "substeps = [2.5]",
                           "shots = 0",
                           "wall_size = 0",
                           "sped = [1]",
                           "radius = [0]\nthickness = [0]",
                           "speed = [1e-9]",
                           "speed = [1e9]",
                           "wall_size = 0.01"}) {
    EXPECT_THROW(configured(text), UsageError) << text;
  }
}

TEST(Tally, survives_its_line) {
  Tally tally;
  EXPECT_EQ(tally_from_line(to_line(tally)), tally);
  tally = {.shots = 5,
           .tunneled = 1,
           .undecided = 2,
           .queries = 9,
           .evaluations = 11,
           .lateness = -3,
           .latest = 1.0 / 3,
           .earliest = -1e-300,
           .widest = -0.1};
  EXPECT_EQ(tally_from_line(to_line(tally)), tally);
  EXPECT_THROW(tally_from_line("1 2 3"), std::runtime_error);
  EXPECT_THROW(tally_from_line(to_line(tally) + " 4"), std::runtime_error);
}

}  // namespace
}  // namespace thinwall
