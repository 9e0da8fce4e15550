#include <thinwall/experiments/thin_wall.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/self_test.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/thin_wall/line.hpp>
#include <thinwall/experiments/thin_wall/plan.hpp>

namespace thinwall {
namespace {

/// Small enough for a debug build, and still with every kind of cell.
constexpr std::string_view small = R"(
  speed = [3, 40]
  step = [0.01, 0.05]
  radius = [0, 0.02]
  thickness = [0.01]
  angle_deg = [0, 60]
  wall = ["infinite", "finite"]
  shots = 400
)";

std::unique_ptr<Run> configured(std::string_view text, RunOptions options = {.seed = 1, .trials = {}}) {
  const Experiment experiment = thin_wall_experiment();
  const Settings settings(text, "test.toml", experiment.default_toml);
  settings.reject_unknown_keys();
  return experiment.configure(settings, options);
}

std::vector<std::string> computed(const std::vector<Unit>& units) {
  std::vector<std::string> results;
  for (const Unit& unit : units) results.push_back(unit.compute());
  return results;
}

Outcome outcome_of(const Run& run) {
  const std::vector<std::string> results = computed(run.units());
  return run.finish(results, std::vector<double>(results.size(), 1e-3));
}

const Table& table(const Outcome& outcome, const std::string& name) {
  return *std::find_if(outcome.tables.begin(), outcome.tables.end(), [&](const Table& t) { return t.name == name; });
}

const Value& value(const Table& table, std::size_t row, const std::string& column) {
  const auto found =
      std::find_if(table.columns.begin(), table.columns.end(), [&](const Column& c) { return c.name == column; });
  return table.rows[row][static_cast<std::size_t>(found - table.columns.begin())];
}

/// The number of shots of `method` that tunneled, by row of `table`.
std::vector<std::int64_t> tunneled(const Table& table, const std::string& method) {
  std::vector<std::int64_t> counts;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (value(table, row, "method") == Value(method))
      counts.push_back(std::get<std::int64_t>(value(table, row, "tunneled")));
  }
  return counts;
}

/// The failure is specified too.
TEST(ThinWall, end_of_step_tunnels) {
  const Outcome outcome = outcome_of(*configured(small));
  for (const std::int64_t count : tunneled(table(outcome, "bullet"), "end_of_step")) {
    EXPECT_NEAR(static_cast<double>(count), 0.7 * 400, 40);
  }
}

TEST(ThinWall, exact_methods_never_do) {
  const Outcome outcome = outcome_of(*configured(small));
  for (const char* method : {"closed_form", "swept_volume_ray"}) {
    const auto counts = tunneled(table(outcome, "cells"), method);
    EXPECT_EQ(counts.size(), 2 * 33U);
    EXPECT_EQ(std::count(counts.begin(), counts.end(), 0), static_cast<std::ptrdiff_t>(counts.size())) << method;
  }
}

/// On a finite wall the ray from the center misses what only the rim would hit.
TEST(ThinWall, center_ray_misses_the_rim_of_a_finite_wall) {
  const Outcome outcome = outcome_of(*configured(R"(
    speed = [40]
    step = [0.05]
    radius = [0.2]
    thickness = [0.01]
    angle_deg = [0]
    wall = ["finite"]
    shots = 1000
    method = ["centre_ray"])"));
  EXPECT_GT(tunneled(table(outcome, "cells"), "centre_ray").back(), 100);
}

TEST(ThinWall, agrees_with_theory) {
  const Outcome outcome = outcome_of(*configured(small));
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_EQ(table(outcome, "self_test").rows.size(), 12U);
  EXPECT_EQ(table(outcome, "stratified").rows.size(), 6U);
}

/// Counts of end_of_step at infinite walls against a theory that may be wrong.
bool self_test_passes(double (*theory)(const Cell&)) {
  const Experiment experiment = thin_wall_experiment();
  const Settings settings(R"(
    speed = [3, 10, 40]
    step = [0.01, 0.05]
    radius = [0, 0.02]
    thickness = [0.01]
    angle_deg = [0, 60]
    wall = ["infinite"]
    shots = 10000
    method = ["end_of_step"])",
                          "test.toml", experiment.default_toml);
  const Plan plan = make_plan(settings, {.seed = 1, .trials = {}});
  const std::vector<std::string> results = computed(experiment.configure(settings, {.seed = 1, .trials = {}})->units());
  std::vector<Tally> tallies;
  for (std::size_t i = 0; i < plan.cells.size() * plan.detectors.size(); ++i)
    tallies.push_back(tally_from_line(results[i]));
  std::vector<CellCount> counts;
  for (const Line& line : make_lines(plan, tallies, std::vector<double>(tallies.size()))) {
    if (line.cell->wall == Wall::infinite && line.detector->poses_per_step == 1) {
      counts.push_back(
          {line.detector->method, line.detector->scalar, line.tally.shots, line.tally.tunneled, theory(*line.cell)});
    }
  }
  return all_passed(self_test(counts));
}

TEST(ThinWall, fails_a_wrong_theory) {
  EXPECT_TRUE(self_test_passes([](const Cell& c) { return miss_probability(slab_chord(c), step_length(c)); }));
  EXPECT_FALSE(self_test_passes([](const Cell& c) {  // forgets the angle
    return miss_probability(c.thickness + 2 * c.radius, step_length(c));
  }));
  EXPECT_FALSE(self_test_passes([](const Cell& c) {  // takes the radius for the diameter
    return miss_probability((c.thickness + c.radius) / cosine(c), step_length(c));
  }));
  EXPECT_FALSE(self_test_passes([](const Cell& c) {  // three percent off
    return miss_probability(slab_chord(c), step_length(c)) * 0.97;
  }));
}

TEST(ThinWall, a_cell_keeps_its_shots_whatever_else_is_fired) {
  const Table all = table(outcome_of(*configured(small)), "cells");
  const Table one = table(outcome_of(*configured("speed = [40]\nstep = [0.05]\nradius = [0.02]\nthickness = [0.01]\n"
                                                 "angle_deg = [60]\nwall = ['finite']\nshots = 400\n"
                                                 "method = ['end_of_step']\nscalar = ['double']")),
                          "cells");
  ASSERT_EQ(one.rows.size(), 2U);  // the bullet, and the cell
  for (const std::vector<Value>& row : one.rows)
    EXPECT_NE(std::find(all.rows.begin(), all.rows.end(), row), all.rows.end());
}

TEST(ThinWall, does_not_depend_on_the_order_of_the_units) {
  const auto run = configured(small);
  std::vector<Unit> units = run->units();
  const std::vector<std::string> forward = computed(units);
  std::reverse(units.begin(), units.end());
  std::vector<std::string> backward = computed(units);
  std::reverse(backward.begin(), backward.end());
  EXPECT_EQ(forward, backward);
}

TEST(ThinWall, unit_keys_are_unique) {
  std::vector<std::string> keys;
  for (const Unit& unit : configured(small)->units()) keys.push_back(unit.key);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST(ThinWall, another_seed_gives_other_shots) {
  const Table first = table(outcome_of(*configured(small)), "cells");
  const Table second = table(outcome_of(*configured(small, {.seed = 2, .trials = {}})), "cells");
  EXPECT_NE(tunneled(first, "end_of_step"), tunneled(second, "end_of_step"));
}

TEST(ThinWall, trials_override_the_shots) {
  const auto units = configured(small, {.seed = 1, .trials = 7})->units();
  EXPECT_EQ(units.front().trials, 7);
}

TEST(ThinWall, every_row_is_as_long_as_its_columns) {
  for (const Table& t : outcome_of(*configured(small)).tables) {
    for (const std::vector<Value>& row : t.rows) ASSERT_EQ(row.size(), t.columns.size()) << t.name;
  }
}

TEST(ThinWall, summary_fits_a_terminal_and_opens_with_the_bullet) {
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

TEST(ThinWall, fires_every_method_of_the_list_by_default) {
  const auto units = configured("")->units();
  for (const std::string_view method : method_names()) {
    EXPECT_TRUE(std::any_of(units.begin(), units.end(), [&](const Unit& unit) {
      return unit.key.find(method) != std::string::npos;
    })) << method;
  }
}

/// What the default run promises.
TEST(ThinWall, default_fires_ten_million_shots_over_the_whole_range) {
  std::int64_t shots = 0;
  for (const Unit& unit : configured("")->units()) shots += unit.trials;
  EXPECT_GE(shots, 10'000'000);
  const Experiment experiment = thin_wall_experiment();
  const Plan plan = make_plan(Settings("", "test.toml", experiment.default_toml), {});
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

TEST(ThinWall, refuses_what_cannot_be_fired) {
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
