/// The thin wall with a response: who goes through because it was not seen, and who because it was seen too late?
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/random.hpp>
#include <thinwall/experiments/statistics.hpp>
#include <thinwall/experiments/thin_wall/bounce_results.hpp>

#include "experiments/thin_wall_run.hpp"

namespace thinwall {
namespace {

const std::string bouncing = std::string(small) + "\nresponse = 'bounce'\n";

std::int64_t count(const Table& table, const std::string& method, const std::string& column) {
  std::int64_t sum = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (value_of(table, row, "method") == Value(method)) sum += std::get<std::int64_t>(value_of(table, row, column));
  }
  return sum;
}

/// The bullet alone, at two numbers of poses and two methods that sweep.
Table bullets() {
  const Outcome outcome = outcome_of(
      *configured("speed = [10]\nstep = [0.016666666666666666]\nradius = [0.02]\nthickness = [0.01]\n"
                  "angle_deg = [0]\nwall = ['infinite']\nshots = 4000\nresponse = 'bounce'\nscalar = ['double']\n"
                  "substeps = [4, 8]\nmethod = ['end_of_step', 'substeps', 'closed_form', 'swept_volume_ray']"));
  return table_of(outcome, "bounce");
}

/// A step of 16.7 cm, 5 cm in contact, of which the first 2.5 cm turn the ball back.
TEST(ThinWallBounce, end_of_step_lets_most_through_and_some_of_those_it_saw) {
  const Table table = bullets();
  EXPECT_LT(std::abs(standard_residual(count(table, "end_of_step", "tunneled"), 4000, 0.7)), 4);
  EXPECT_LT(std::abs(standard_residual(count(table, "end_of_step", "wrong_side"), 4000, 0.15)), 4);
  EXPECT_EQ(count(table, "end_of_step", "behind"),
            count(table, "end_of_step", "tunneled") + count(table, "end_of_step", "wrong_side"));
}

/// Four poses are 4.2 cm apart: every ball is seen, and two in five go through all the same.
TEST(ThinWallBounce, the_safe_step_halves) {
  const Table table = bullets();
  EXPECT_EQ(count(table, "substeps_4", "tunneled"), 0);
  EXPECT_LT(std::abs(standard_residual(count(table, "substeps_4", "behind"), 4000, 0.4)), 4);
  EXPECT_EQ(count(table, "substeps_8", "behind"), 0);
}

TEST(ThinWallBounce, what_is_swept_bounces) {
  const Table table = bullets();
  for (const char* method : {"closed_form", "swept_volume_ray"}) {
    EXPECT_EQ(count(table, method, "behind"), 0) << method;
    EXPECT_EQ(count(table, method, "wrong_side"), 0) << method;
  }
}

TEST(ThinWallBounce, agrees_with_theory) {
  const Outcome outcome = outcome_of(*configured(bouncing));
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_EQ(table_of(outcome, "bounce_self_test").rows.size(), 22U);
  EXPECT_EQ(outcome.figures.front().name, "bounce");
}

/// The same shots, and the same verdicts on them.
TEST(ThinWallBounce, changes_no_other_count) {
  const Outcome still = outcome_of(*configured(small)), bounced = outcome_of(*configured(bouncing));
  for (const char* method : {"end_of_step", "centre_ray", "closed_form"}) {
    EXPECT_EQ(tunneled(table_of(still, "cells"), method), tunneled(table_of(bounced, "cells"), method));
  }
  EXPECT_EQ(still.tables.size() + 2, bounced.tables.size());
}

/// Lines of end_of_step at infinite walls, with a theory of going through that may be wrong.
bool bounce_test_passes(double (*theory)(const Cell&)) {
  const Experiment experiment = thin_wall_experiment();
  const Settings settings(R"(
    speed = [3, 10, 40]
    step = [0.01, 0.05]
    radius = [0, 0.02]
    thickness = [0.01]
    angle_deg = [0, 60]
    wall = ["infinite"]
    shots = 10000
    response = "bounce"
    method = ["end_of_step"])",
                          "test.toml", experiment.default_toml);
  const ShotPlan plan = make_plan(settings, {.seed = 1, .trials = {}});
  const auto results = results_of(experiment.configure(settings, {.seed = 1, .trials = {}})->units());
  std::vector<Tally> tallies;
  for (std::size_t i = 0; i < plan.cells.size() * plan.detectors.size(); ++i)
    tallies.push_back(tally_from_line(results[i]));
  std::vector<Line> lines = make_lines(plan, tallies, std::vector<double>(tallies.size()));
  for (Line& line : lines) line.theory.through = theory(*line.cell);
  return all_passed(self_test(through_counts(lines)));
}

TEST(ThinWallBounce, fails_a_wrong_theory) {
  EXPECT_TRUE(bounce_test_passes([](const Cell& c) { return miss_probability(slab_chord(c) / 2, step_length(c)); }));
  EXPECT_FALSE(bounce_test_passes([](const Cell& c) {  // what is seen is saved
    return miss_probability(slab_chord(c), step_length(c));
  }));
  EXPECT_FALSE(bounce_test_passes([](const Cell& c) {  // only the wall's own half counts
    return miss_probability((c.radius + c.thickness) / cosine(c), step_length(c));
  }));
  EXPECT_FALSE(bounce_test_passes([](const Cell& c) {  // two percent off
    return miss_probability(slab_chord(c) / 2, step_length(c)) * 0.98;
  }));
}

TEST(ThinWallBounce, ends_must_be_where_the_push_led) {
  const Experiment experiment = thin_wall_experiment();
  const ShotPlan plan = make_plan(Settings(bouncing, "test.toml", experiment.default_toml), {.seed = 1, .trials = {}});
  Tally tally = {.shots = 100, .tunneled = 40, .wrong_side = 10, .behind = 50};
  const std::size_t cells = plan.cells.size() * plan.detectors.size();
  EXPECT_TRUE(ends_agree(make_lines(plan, std::vector<Tally>(cells, tally), std::vector<double>(cells))));
  tally.behind = 49;
  EXPECT_FALSE(ends_agree(make_lines(plan, std::vector<Tally>(cells, tally), std::vector<double>(cells))));
}

TEST(ThinWallBounce, pushes_out_to_touch_and_reflects) {
  const Target wall = target(bullet);
  const double face = wall.half_extents[0] + wall.radius;
  Flight shallow = {{-face + 0.01, 0, 0}, {0.1, 0.05, 0}};
  respond(wall, {1, 0, 0}, shallow);
  EXPECT_NEAR(shallow.position[0], -face, 1e-15);
  EXPECT_EQ(shallow.displacement, Vec3<double>(-0.1, 0.05, 0));
  Flight deep = {{0.001, 0, 0}, {0.1, 0.05, 0}};  // past the middle: the way out leads ahead
  respond(wall, {-1, 0, 0}, deep);
  EXPECT_NEAR(deep.position[0], face, 1e-15);
  EXPECT_EQ(deep.displacement, Vec3<double>(0.1, 0.05, 0));
  Flight early = {{-face - 0.01, 0, 0}, {0.1, 0, 0}};  // seen before contact: reflected where it is
  respond(wall, {1, 0, 0}, early);
  EXPECT_EQ(early.position[0], -face - 0.01);
  EXPECT_TRUE(has_left(wall, early));
}

/// Points uniform in the rounded box, and the normal that the library gives there.
TEST(ThinWallBounce, unturned_share_is_what_the_normals_say) {
  const RoundedBox box = {{0.1, 0.6, 0.6}, 0.25};
  for (const double angle : {0.0, 0.5, 1.2}) {
    const Vec3<double> direction(std::cos(angle), angle == 0 ? 0 : std::sin(angle), 0);
    const RandomStream stream{5, 7};
    std::int64_t inside = 0, unturned = 0;
    for (std::uint64_t trial = 0; trial < 100000; ++trial) {
      const RandomWords words = random_words(stream, trial, 0);
      Vec3<double> point;
      for (int i = 0; i < 3; ++i)
        point[i] = (2 * uniform(words[static_cast<std::size_t>(i)]) - 1) * (box.half_extents[i] + box.radius);
      const auto found =
          separation(Sphere<double>{point, box.radius}, Aabb<double>{Vec3<double>::Zero(), box.half_extents});
      if (found.distance > 0) continue;
      ++inside;
      unturned += found.normal.dot(direction) > 0 ? 0 : 1;
    }
    const double spacing = 2 * longest_chord(box, direction), lines = spacing * shadow(box, direction);
    const double missed = 1 - volume(box) / lines;
    const double expected = (*unturned_probability(box, direction, spacing) - missed) / (volume(box) / lines);
    EXPECT_LT(std::abs(standard_residual(unturned, inside, expected)), 4) << angle;
    EXPECT_FALSE(unturned_probability(box, direction, longest_chord(box, direction) / 2));
  }
}

TEST(ThinWallBounce, refuses_another_response) {
  EXPECT_THROW(configured("response = 'bounces'"), UsageError);
  EXPECT_THROW(configured("response = true"), UsageError);
}

}  // namespace
}  // namespace thinwall
