/// The shots of the thin wall and the response to them, without any method under test.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/thin_wall/methods.hpp>
#include <thinwall/experiments/thin_wall/model.hpp>
#include <thinwall/experiments/thin_wall/results.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

namespace {

const std::vector<Cell> cells = {
    bullet,
    {2000, 1.0 / 30, 0.001, 0.0001, 80, Wall::infinite, 0},
    {1, 0.001, 0.02, 0.1, 80, Wall::infinite, 0},
    {700, 1.0 / 60, 0, 0.0001, 30, Wall::infinite, 0},
    {50, 1.0 / 60, 0.02, 0.1, 0, Wall::finite, 1},
    {2000, 1.0 / 30, 0.02, 0, 60, Wall::finite, 0.3},
    {1, 0.001, 0.02, 0.1, 80, Wall::finite, 1},
};

bool float_holds(const Vec3<double>& v) { return v.cast<float>().cast<double>() == v; }

/// Of every pose, and of every step: so both scalars are asked the same question.
TEST(ThinWallShots, float_holds_every_pose) {
  for (const Cell& cell : cells) {
    const Target aimed = target(cell);
    EXPECT_TRUE(float_holds(aimed.displacement) && float_holds(aimed.half_extents)) << cell_factors().key(cell);
    EXPECT_EQ(static_cast<double>(static_cast<float>(aimed.radius)), aimed.radius);
    for (std::uint64_t trial = 0; trial < 200; ++trial) {
      const Vec3<double> start = random_start(aimed, random_stream(cell, 1), trial);
      Vec3<double> pose = start;
      for (int k = 0; !is_past(aimed, pose); pose = start + ++k * aimed.displacement) ASSERT_TRUE(float_holds(pose));
      ASSERT_TRUE(float_holds(pose)) << cell_factors().key(cell);
    }
  }
}

/// So that a rounded wall cannot let through what the one in the settings stops.
TEST(ThinWallShots, rounding_only_helps_the_wall) {
  for (const Cell& cell : cells) {
    const Target aimed = target(cell);
    const Vec3<double> step = step_length(cell) * direction(cell);
    EXPECT_GE(aimed.radius, cell.radius);
    EXPECT_GE(2 * aimed.half_extents[0], cell.thickness);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(aimed.displacement[i], step[i]);
      EXPECT_NEAR(aimed.displacement[i], step[i], 1e-3 * step[i]);
    }
  }
}

TEST(ThinWallShots, start_before_contact_by_at_most_two_steps_of_the_plane) {
  for (const Cell& cell : cells) {
    const Target aimed = target(cell);
    for (std::uint64_t trial = 0; trial < 1000; ++trial) {
      const Vec3<double> start = random_start(aimed, random_stream(cell, 1), trial);
      ASSERT_GE(gap(aimed, start), 0) << cell_factors().key(cell);
      ASSERT_FALSE(is_past(aimed, start));
      if (cell.wall == Wall::infinite) {
        ASSERT_LE(path_to_contact(aimed, start), aimed.step_length * (1 + 1e-6));
      }
    }
  }
}

/// The ball touches where the path says, to rounding.
TEST(ThinWallShots, path_ends_at_contact) {
  for (const Cell& cell : cells) {
    const Target aimed = target(cell);
    for (std::uint64_t trial = 0; trial < 1000; ++trial) {
      const Vec3<double> start = random_start(aimed, random_stream(cell, 1), trial);
      const double path = path_to_contact(aimed, start);
      const Vec3<double> contact = start + path / aimed.step_length * aimed.displacement;
      ASSERT_NEAR(gap(aimed, contact), 0, 1e-13 * (1 + start.norm())) << cell_factors().key(cell);
      ASSERT_GE(gap(aimed, (start + contact) / 2), 0);
    }
  }
}

TEST(ThinWallShots, phase_is_uniform) {
  const Target aimed = target(bullet);
  std::vector<double> counts(50);
  for (std::uint64_t trial = 0; trial < 50000; ++trial) {
    const double phase =
        path_to_contact(aimed, random_start(aimed, random_stream(bullet, 3), trial)) / aimed.step_length;
    ++counts[std::min<std::size_t>(49, static_cast<std::size_t>(50 * phase))];
  }
  double sum = 0;
  for (const double count : counts) sum += (count - 1000) * (count - 1000) / 1000;
  EXPECT_TRUE(chi_square_range(49, 0.9999).contains(sum)) << sum;
}

/// Head-on, the share of lines that meet the wall itself is its face over its shadow; the others meet the rim only.
TEST(ThinWallShots, aim_is_uniform_over_the_shadow) {
  const Cell cell = {10, 1.0 / 60, 0.2, 0.1, 0, Wall::finite, 1};
  const Target aimed = target(cell);
  std::int64_t face = 0, upper_half = 0;
  constexpr std::int64_t shots = 50000;
  for (std::uint64_t trial = 0; trial < shots; ++trial) {
    const Vec3<double> start = random_start(aimed, random_stream(cell, 3), trial);
    face += std::max(std::abs(start[1]), std::abs(start[2])) <= 0.5 ? 1 : 0;
    upper_half += start[2] > 0 ? 1 : 0;
  }
  EXPECT_LT(std::abs(standard_residual(face, shots, 1 / shadow(rounded_box(cell), {1, 0, 0}))), 4);
  EXPECT_LT(std::abs(standard_residual(upper_half, shots, 0.5)), 4);
}

TEST(ThinWallShots, depend_on_the_physical_factors_and_the_seed_alone) {
  const Target aimed = target(bullet);
  EXPECT_EQ(random_start(aimed, random_stream(bullet, 1), 7), random_start(aimed, random_stream(bullet, 1), 7));
  EXPECT_NE(random_start(aimed, random_stream(bullet, 1), 7), random_start(aimed, random_stream(bullet, 2), 7));
  EXPECT_NE(random_start(aimed, random_stream(bullet, 1), 7), random_start(aimed, random_stream(bullet, 1), 8));
  Cell faster = bullet;
  faster.speed = 11;
  EXPECT_NE(random_stream(bullet, 1).stream, random_stream(faster, 1).stream);
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

// ---- The thin wall's settings, answers and verdicts: who tunnels, who goes through, and does theory agree?

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
  return run_of(thin_wall_experiment(), text, options);
}

/// The number of shots of `method` that tunneled, by row of `table`.
std::vector<std::int64_t> tunneled(const Table& table, const std::string& method) {
  std::vector<std::int64_t> counts;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (value_of(table, row, "method") == Value(method))
      counts.push_back(std::get<std::int64_t>(value_of(table, row, "tunneled")));
  }
  return counts;
}

ShotPlan plan_of(std::string_view text, std::optional<std::int64_t> trials = {}) {
  return make_plan(Settings(text, "test.toml", thin_wall_experiment().default_toml), {.seed = 1, .trials = trials});
}

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

/// Rows of end_of_step at infinite walls, with many shots.
const std::vector<ThinWallRow>& rows_of_end_of_step() {
  static const std::vector<ThinWallRow> rows = [] {
    const ShotPlan plan = plan_of(R"(
      speed = [3, 10, 40]
      step = [0.01, 0.05]
      radius = [0, 0.02]
      thickness = [0.01]
      angle_deg = [0, 60]
      wall = ["infinite"]
      shots = 10000
      response = "bounce"
      method = ["end_of_step"])");
    std::vector<Tally> tallies;
    for (const Cell& cell : plan.cells) {
      for (const ThinWallMethod& method : plan.methods) tallies.push_back(fire(cell, method, {0, plan.shots}, 1));
    }
    return make_rows(plan, tallies, std::vector<double>(tallies.size()));
  }();
  return rows;
}

/// Does the self-test pass if theory gives the chance in its field `chance` by another formula?
bool passes(std::vector<CellCount> (*counts)(const std::vector<ThinWallRow>&), std::optional<double> Theory::*chance,
            double (*theory)(const Cell&)) {
  std::vector<ThinWallRow> rows = rows_of_end_of_step();
  for (ThinWallRow& row : rows) row.theory.*chance = theory(row.cell);
  return all_passed(self_test(counts(rows)));
}

bool self_test_passes(double (*theory)(const Cell&)) { return passes(tunneled_counts, &Theory::probability, theory); }
bool bounce_test_passes(double (*theory)(const Cell&)) { return passes(through_counts, &Theory::through, theory); }

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

TEST(ThinWall, another_seed_gives_other_shots) {
  const Table first = table_of(outcome_of(*configured(small)), "cells");
  const Table second = table_of(outcome_of(*configured(small, {.seed = 2, .trials = {}})), "cells");
  EXPECT_NE(tunneled(first, "end_of_step"), tunneled(second, "end_of_step"));
}

std::vector<std::string> figures_and_panels(const std::string& changes) {
  std::vector<std::string> out;
  for (const Figure& figure : outcome_of(*configured(changes + "\nspeed = [40]\nradius = [0.02]\nshots = 400")).figures)
    out.push_back(figure.name + " " + std::to_string(figure.panels.size()));
  return out;
}

TEST(ThinWall, draws_no_figure_and_no_panel_without_a_measured_point) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(figures_and_panels("step = [0.01]"), (Names{"probability 2", "lateness 1", "finite 1"}));
  EXPECT_EQ(figures_and_panels("step = [0.01]\nwall = [\"infinite\"]"), (Names{"probability 2", "lateness 1"}));
  EXPECT_EQ(figures_and_panels("step = [0.01]\nwall = [\"infinite\"]\nmethod = [\"closed_form\"]"),
            (Names{"probability 1", "lateness 1"}));
}

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
  const ShotPlan plan = plan_of(bouncing);
  Tally tally = {.shots = 100, .tunneled = 40, .wrong_side = 10, .behind = 50};
  const std::size_t count = plan.cells.size() * plan.methods.size();
  EXPECT_TRUE(ends_agree(make_rows(plan, std::vector<Tally>(count, tally), std::vector<double>(count))));
  tally.behind = 49;
  EXPECT_FALSE(ends_agree(make_rows(plan, std::vector<Tally>(count, tally), std::vector<double>(count))));
}

/// One row of the bullet for each method, all detected exactly on time.
std::vector<ThinWallRow> punctual(const ShotPlan& plan) {
  const Tally tally = {.shots = 100, .latest = 0, .earliest = 0, .widest = 0};
  const std::size_t count = plan.cells.size() * plan.methods.size();
  std::vector<ThinWallRow> rows = make_rows(plan, std::vector<Tally>(count, tally), std::vector<double>(count));
  rows.resize(plan.methods.size());
  return rows;
}

const LatenessTest& of(const std::vector<LatenessTest>& tests, const std::string& method) {
  return *std::find_if(tests.begin(), tests.end(), [&](const LatenessTest& test) { return test.method == method; });
}

TEST(LatenessTest, wants_the_closed_form_on_time_and_poses_late) {
  const ShotPlan plan = plan_of(small);
  const auto tests = lateness_test(punctual(plan));
  EXPECT_TRUE(of(tests, "closed_form").passed());
  EXPECT_FALSE(of(tests, "end_of_step").passed());  // its mean cannot be 0
}

/// A method that always says "hit" would never tunnel.
TEST(LatenessTest, catches_false_hits) {
  const ShotPlan plan = plan_of(small);
  std::vector<ThinWallRow> rows = punctual(plan);
  for (ThinWallRow& row : rows) row.tally.widest = 1e-3;
  EXPECT_EQ(of(lateness_test(rows), "closed_form").false_cells, 1);
  EXPECT_FALSE(of(lateness_test(rows), "closed_form").passed());
}

TEST(LatenessTest, catches_what_is_later_than_it_can_be) {
  const ShotPlan plan = plan_of(small);
  std::vector<ThinWallRow> rows = punctual(plan);
  for (ThinWallRow& row : rows) row.tally.latest = 0.0501;  // end_of_step: at most 5 cm
  EXPECT_EQ(of(lateness_test(rows), "end_of_step").late_cells, 1);
  for (ThinWallRow& row : rows) row.tally.latest = 0.05;
  EXPECT_EQ(of(lateness_test(rows), "end_of_step").late_cells, 0);
}

TEST(Stratified, passes_the_true_counts_and_catches_two_too_many) {
  const ShotPlan plan = evenly_spread(plan_of(small));
  ASSERT_FALSE(plan.cells.empty());
  std::vector<std::vector<std::int64_t>> counts;
  for (const Cell& cell : plan.cells) counts.push_back(stratified_counts(cell, plan.methods, 1));
  for (const StratifiedTest& test : stratified_test(plan, counts)) EXPECT_TRUE(test.passed()) << test.method;
  counts.front().front() = 708;  // 0.7 * 1009 = 706.3
  EXPECT_FALSE(stratified_test(plan, counts).front().passed());
}

/// Evenly spread for any number of poses a step: the number of phases has no divisor that could be one.
TEST(Stratified, number_of_phases_is_prime) {
  for (std::int64_t divisor = 2; divisor < stratified_shots; ++divisor) ASSERT_NE(stratified_shots % divisor, 0);
}

TEST(Stratified, fires_infinite_walls_in_double_only) {
  const ShotPlan plan = evenly_spread(plan_of(small));
  for (const Cell& cell : plan.cells) EXPECT_EQ(cell.wall, Wall::infinite);
  for (const ThinWallMethod& method : plan.methods) EXPECT_EQ(method.scalar, "double");
}

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
    const ShotPlan plan = plan_of(std::string(small) + "response = \"" + response + "\"\n", 50);
    for (const Cell& cell : plan.cells) {
      for (const ThinWallMethod& method : plan.methods) {
        const Tally whole = fire(cell, method, {.first = 0, .shots = plan.shots}, plan.seed);
        Tally forward, backward;
        const auto volleys = volleys_of(plan.shots, 17);
        for (auto v = volleys.begin(); v != volleys.end(); ++v) forward += fire(cell, method, *v, plan.seed);
        for (auto v = volleys.rbegin(); v != volleys.rend(); ++v) backward += fire(cell, method, *v, plan.seed);
        EXPECT_EQ(forward, whole) << method.name;
        EXPECT_EQ(backward, whole) << method.name;
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
TEST(ThinWallVolley, makes_a_row_of_the_volleys_of_a_cell) {
  const auto run = configured(small, {.seed = 1, .trials = 2 * most_shots_a_volley});
  const auto units = run->units();
  const auto whole = configured(small, {.seed = 1, .trials = 60});
  std::vector<std::string> in_one = results_of(whole->units()), in_two;
  std::size_t next = 0;
  for (const Unit& unit : units) {
    if (unit.key.ends_with(" from " + std::to_string(most_shots_a_volley))) {
      in_two.push_back(to_text(Tally{}));
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
  const ShotPlan plan = plan_of("");
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
  for (const auto& [text, key] :
       std::vector<std::pair<const char*, const char*>>{{"radius = [0]\nthickness = [0]", "thickness"},
                                                        {"radius = [1e-10]\nthickness = [0]", "thickness"},
                                                        {"speed = [1e-9]", "speed"},
                                                        {"step = [1e-9]", "step"},
                                                        {"speed = [1e9]", "speed"},
                                                        {"wall_size = 0.01", "wall_size"},
                                                        {"wall_size = 0", "wall_size"},
                                                        {"substeps = [1]", "substeps"},
                                                        {"substeps = [2.5]", "substeps"},
                                                        {"scalar = ['half']", "scalar"},
                                                        {"method = ['closedform']", "method"},
                                                        {"response = 'bounces'", "response"},
                                                        {"response = true", "response"}}) {
    try {
      configured(text);
      ADD_FAILURE() << text;
    } catch (const UsageError& refusal) {
      EXPECT_NE(std::string(refusal.what()).find(std::string("key '") + key + "'"), std::string::npos)
          << refusal.what();
    }
  }
}

}  // namespace

}  // namespace thinwall
