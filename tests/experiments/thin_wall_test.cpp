/// The thin wall's answers: who tunnels, and does theory agree?
#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/self_test.hpp>
#include <thinwall/experiments/thin_wall/figures.hpp>
#include <thinwall/experiments/thin_wall/line.hpp>

#include "experiments/thin_wall_run.hpp"

namespace thinwall {
namespace {

/// The failure is specified too.
TEST(ThinWall, end_of_step_tunnels) {
  const Outcome outcome = outcome_of(*configured(small));
  for (const std::int64_t count : tunneled(table_of(outcome, "bullet"), "end_of_step")) {
    EXPECT_NEAR(static_cast<double>(count), 0.7 * 400, 40);
  }
}

TEST(ThinWall, exact_methods_never_do) {
  const Outcome outcome = outcome_of(*configured(small));
  for (const char* method :
       {"closed_form", "swept_volume_ray", "speculative", "conservative_advancement", "bisection", "inclusion"}) {
    const auto counts = tunneled(table_of(outcome, "cells"), method);
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
  EXPECT_GT(tunneled(table_of(outcome, "cells"), "centre_ray").back(), 100);
}

TEST(ThinWall, agrees_with_theory) {
  const Outcome outcome = outcome_of(*configured(small));
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_EQ(table_of(outcome, "self_test").rows.size(), 22U);
  EXPECT_EQ(table_of(outcome, "stratified").rows.size(), 11U);
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
  const ShotPlan plan = make_plan(settings, {.seed = 1, .trials = {}});
  const std::vector<std::string> results =
      results_of(experiment.configure(settings, {.seed = 1, .trials = {}})->units());
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
  const Table all = table_of(outcome_of(*configured(small)), "cells");
  const Table one = table_of(outcome_of(*configured("speed = [40]\nstep = [0.05]\nradius = [0.02]\nthickness = [0.01]\n"
                                                    "angle_deg = [60]\nwall = ['finite']\nshots = 400\n"
                                                    "method = ['end_of_step']\nscalar = ['double']")),
                             "cells");
  ASSERT_EQ(one.rows.size(), 2U);  // the bullet, and the cell
  for (const std::vector<Value>& row : one.rows) {
    EXPECT_NE(std::find(all.rows.begin(), all.rows.end(), row), all.rows.end());
  }
}

TEST(ThinWall, does_not_depend_on_the_order_of_the_units) {
  const auto run = configured(small);
  std::vector<Unit> units = run->units();
  const std::vector<std::string> forward = results_of(units);
  std::reverse(units.begin(), units.end());
  std::vector<std::string> backward = results_of(units);
  std::reverse(backward.begin(), backward.end());
  EXPECT_EQ(forward, backward);
}

TEST(ThinWall, another_seed_gives_other_shots) {
  const Table first = table_of(outcome_of(*configured(small)), "cells");
  const Table second = table_of(outcome_of(*configured(small, {.seed = 2, .trials = {}})), "cells");
  EXPECT_NE(tunneled(first, "end_of_step"), tunneled(second, "end_of_step"));
}

TEST(ThinWall, speaks_plain_text) {
  for (const Section& section : outcome_of(*configured(small)).sections)
    EXPECT_EQ(section.text.find('`'), std::string::npos) << section.heading;
}

std::vector<std::string> figures_and_panels(const std::string& changes) {
  std::vector<std::string> out;
  for (const Figure& figure : outcome_of(*configured(changes + "\nspeed = [40]\nradius = [0.02]\nshots = 400")).figures)
    out.push_back(figure.name + " " + std::to_string(figure.panels.size()));
  return out;
}

TEST(ThinWall, draws_no_figure_and_no_panel_without_a_measured_point) {
  using Names = std::vector<std::string>;
  EXPECT_TRUE(with_points({finite_figure({}), lateness_figure({}), bounce_figure({})}).empty());
  EXPECT_EQ(figures_and_panels("step = [0.01]"), (Names{"probability 2", "lateness 1", "finite 1"}));
  EXPECT_EQ(figures_and_panels("step = [0.01]\nwall = [\"infinite\"]"), (Names{"probability 2", "lateness 1"}));
  EXPECT_EQ(figures_and_panels("step = [0.01]\nwall = [\"infinite\"]\nmethod = [\"closed_form\"]"),
            (Names{"probability 1", "lateness 1"}));
}

}  // namespace
}  // namespace thinwall
