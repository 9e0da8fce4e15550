/// The thin wall: its shots and the response to them without any method under test, its answers and verdicts.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/models/tunneling_theory.hpp>
#include <thinwall/experiments/thin_wall/results.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

namespace {

const std::vector<Cell> cells = {
    bullet,
    {2000, 1.0 / 30, 0.001, 0.0001, 80},
    {1, 0.001, 0.02, 0.1, 80},
    {700, 1.0 / 60, 0, 0.0001, 30},
    {50, 1.0 / 60, 0.02, 0.1, 0, Wall::finite, 1},
    {2000, 1.0 / 30, 0.02, 0, 60, Wall::finite, 0.3},
    {1, 0.001, 0.02, 0.1, 80, Wall::finite, 1},
};

bool float_holds(const Vec3<double>& v) { return v.cast<float>().cast<double>() == v; }

/// Calls `check(cell, aimed, start)` for so many shots of each cell.
template <class Check> void for_shots(std::uint64_t shots, const Check& check) {
  for (const Cell& cell : cells) {
    SCOPED_TRACE(cell_factors.key(cell));
    const Target aimed = target(cell);
    for (std::uint64_t trial = 0; trial < shots; ++trial)
      check(cell, aimed, random_start(aimed, random_stream(cell, 1), trial));
  }
}

/// Of every pose, and of every step: so both scalars are asked the same question. And a rounded wall cannot let through
/// what the one in the settings stops.
TEST(ThinWallShots, float_holds_every_pose_and_rounding_only_helps_the_wall) {
  for_shots(200, [](const Cell& cell, const Target& aimed, const Vec3<double>& start) {
    ASSERT_TRUE(float_holds(aimed.displacement) && float_holds(aimed.half_extents));
    ASSERT_EQ(static_cast<double>(static_cast<float>(aimed.radius)), aimed.radius);
    const Vec3<double> step = step_length(cell) * direction(cell);
    ASSERT_GE(aimed.radius, cell.radius);
    ASSERT_GE(2 * aimed.half_extents[0], cell.thickness);
    for (int i = 0; i < 3; ++i) {
      ASSERT_LE(aimed.displacement[i], step[i]);
      ASSERT_NEAR(aimed.displacement[i], step[i], 1e-3 * step[i]);
    }
    Flight flight = {start, aimed.displacement};
    for (int k = 1; !has_left(aimed, flight); ++k) {
      ASSERT_TRUE(float_holds(flight.position));
      flight.position = start + k * aimed.displacement;
    }
    ASSERT_TRUE(float_holds(flight.position));
  });
}

/// By at most two steps of the plane. The ball touches where the path says, to rounding.
TEST(ThinWallShots, start_before_contact_and_the_path_ends_there) {
  for_shots(1000, [](const Cell& cell, const Target& aimed, const Vec3<double>& start) {
    ASSERT_GE(gap(aimed, start), 0);
    ASSERT_FALSE(has_left(aimed, {start, aimed.displacement}));
    const double path = path_to_contact(aimed, start);
    ASSERT_TRUE(cell.wall == Wall::finite || path <= aimed.step_length * (1 + 1e-6)) << path;
    const Vec3<double> contact = start + path / aimed.step_length * aimed.displacement;
    ASSERT_NEAR(gap(aimed, contact), 0, 1e-13 * (1 + start.norm()));
    ASSERT_GE(gap(aimed, (start + contact) / 2), 0);
  });
}

TEST(ThinWallShots, phase_is_uniform) {
  expect_uniform(50, 50000, [aimed = target(bullet)](std::uint64_t trial) {
    return path_to_contact(aimed, random_start(aimed, random_stream(bullet, 3), trial)) / aimed.step_length;
  });
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

const std::string small = small_toml("thin_wall");  // every kind of cell
const std::string bouncing = small + "response = 'bounce'\n";

std::unique_ptr<Run> small_run(std::int64_t trials) {
  return run_of(thin_wall_experiment(), small, {.seed = 1, .trials = trials});
}

ShotPlan plan_of(std::string_view text, std::optional<std::int64_t> trials = {}) {
  return make_plan(Settings(text, "test.toml", thin_wall_experiment().default_toml), {.seed = 1, .trials = trials});
}

/// Over all rows of the method.
std::int64_t count(const Table& table, const std::string& method, const std::string& column) {
  std::int64_t sum = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (value_of(table, row, "method") == Value(method)) sum += std::get<std::int64_t>(value_of(table, row, column));
  }
  return sum;
}

TEST(ThinWall, agrees_with_theory_and_nothing_passes_what_is_exact) {
  const Outcome& outcome = small_outcome(thin_wall_experiment());
  for (const char* method :
       {"closed_form", "swept_volume_ray", "speculative", "conservative_advancement", "bisection", "inclusion"}) {
    EXPECT_EQ(count(table_of(outcome, "cells"), method, "shots"), 2 * 33 * 400);
    EXPECT_EQ(count(table_of(outcome, "cells"), method, "tunneled"), 0) << method;
  }
  EXPECT_GT(count(table_of(outcome, "cells"), "centre_ray", "tunneled"), 100);  // that only the rim would hit
  const Table& methods = table_of(outcome, "methods");
  EXPECT_EQ(count(methods, "closed_form", "clean_cells"), 2 * 33);
  EXPECT_LT(count(methods, "end_of_step", "clean_cells"), 33);
  const double expected = std::get<double>(value_of(methods, "end_of_step", "theory_expected"));
  EXPECT_NEAR(static_cast<double>(count(methods, "end_of_step", "theory_tunneled")), 2 * expected, 0.05 * expected);
}

/// Does the self-test of end_of_step, over many shots at infinite walls, pass with another chord in its theory?
bool passes(const ThinWallFate& fate, double (*chord)(const Cell&), double factor = 1) {
  static const ShotPlan plan = plan_of(
      "speed = [3, 10, 40]\nstep = [0.01, 0.05]\nradius = [0, 0.02]\nthickness = [0.01]\nangle_deg = [0, 60]\n"
      "wall = ['infinite']\nshots = 10000\nresponse = 'bounce'\nmethod = ['end_of_step']");
  static const std::vector<ThinWallRow> fired = [] {
    std::vector<ThinWallRow> rows = rows_of(plan);
    for (ThinWallRow& row : rows) row.tally = fire(row.cell, *row.method, {0, plan.shots}, 1);
    return rows;
  }();
  std::vector<ThinWallRow> rows = fired;
  for (ThinWallRow& row : rows)
    row.theory.*fate.chance = factor * miss_probability(chord(row.cell), step_length(row.cell));
  return all_passed(self_test(counts_of(rows, fate)));
}

TEST(ThinWall, fails_a_wrong_theory) {
  const auto whole = [](const Cell& c) { return slab_chord(c); };
  const auto half = [](const Cell& c) { return slab_chord(c) / 2; };
  EXPECT_TRUE(passes(tunneling, whole));
  EXPECT_FALSE(passes(tunneling, whole, 0.97));
  EXPECT_FALSE(passes(tunneling, [](const Cell& c) { return c.thickness + 2 * c.radius; }));  // forgets the angle
  // Takes the radius for the diameter.
  EXPECT_FALSE(passes(tunneling, [](const Cell& c) { return (c.thickness + c.radius) / cosine(c); }));
  EXPECT_TRUE(passes(going_through, half));
  EXPECT_FALSE(passes(going_through, half, 0.98));
  EXPECT_FALSE(passes(going_through, whole));  // what is seen is saved
  // Only the wall's own half counts.
  EXPECT_FALSE(passes(going_through, [](const Cell& c) { return (c.radius + c.thickness) / cosine(c); }));
}

TEST(ThinWall, fires_other_shots_at_another_seed_and_in_another_cell) {
  const Outcome other = outcome_of(thin_wall_experiment(), small, {.seed = 2, .trials = {}});
  EXPECT_NE(table_of(other, "cells").rows, table_of(small_outcome(thin_wall_experiment()), "cells").rows);
  Cell faster = bullet;
  faster.speed = 11;
  EXPECT_NE(random_stream(bullet, 1).stream, random_stream(faster, 1).stream);
}

TEST(ThinWall, draws_no_figure_and_no_panel_without_a_measured_point) {
  using Names = std::vector<std::string>;
  const auto figures_and_panels = [](const std::string& more) {
    Names out;
    const Outcome outcome =
        outcome_of(thin_wall_experiment(), "speed = [40]\nradius = [0.02]\nshots = 400\nstep = [0.01]\n" + more);
    for (const Figure& f : outcome.figures) out.push_back(f.name + " " + std::to_string(f.panels.size()));
    return out;
  };
  EXPECT_EQ(figures_and_panels(""), (Names{"probability 2", "lateness 1", "finite 1"}));
  EXPECT_EQ(figures_and_panels("wall = ['infinite']"), (Names{"probability 2", "lateness 1"}));
  EXPECT_EQ(figures_and_panels("wall = ['infinite']\nmethod = ['closed_form']"),
            (Names{"probability 1", "lateness 1"}));
}

/// The bullet alone: of a step of 16.7 cm it is 5 cm in contact, of which the first 2.5 cm turn it back. Four poses are
/// 4.2 cm apart: every ball is seen, and two in five go through all the same, so that the safe step halves. What is
/// swept bounces.
TEST(ThinWallBounce, goes_through_unseen_or_seen_too_late) {
  const Outcome outcome =
      outcome_of(thin_wall_experiment(),
                 "speed = [10]\nstep = [0.016666666666666666]\nradius = [0.02]\nthickness = [0.01]\n"
                 "angle_deg = [0]\nwall = ['infinite']\nshots = 4000\nresponse = 'bounce'\nscalar = ['double']\n"
                 "substeps = [4, 8]\nmethod = ['end_of_step', 'substeps', 'closed_form', 'swept_volume_ray']");
  const auto is_near = [&](const char* method, const char* column, double share) {
    return std::abs(standard_residual(count(table_of(outcome, "bounce"), method, column), 4000, share)) < 4;
  };
  EXPECT_TRUE(is_near("end_of_step", "tunneled", 0.7));
  EXPECT_TRUE(is_near("end_of_step", "wrong_side", 0.15));
  EXPECT_TRUE(is_near("substeps_4", "behind", 0.4));
  EXPECT_EQ(count(table_of(outcome, "bounce"), "substeps_4", "tunneled"), 0);
  for (const char* method : {"substeps_8", "closed_form", "swept_volume_ray"})
    EXPECT_EQ(count(table_of(outcome, "bounce"), method, "behind"), 0) << method;
}

/// The same shots, and the same verdicts on them.
TEST(ThinWallBounce, agrees_with_theory_and_changes_no_other_count) {
  const Outcome bounced = outcome_of(thin_wall_experiment(), bouncing), &still = small_outcome(thin_wall_experiment());
  EXPECT_TRUE(bounced.self_test_passed) << bounced.summary;
  EXPECT_EQ(table_of(bounced, "bounce_self_test").rows.size(), 22U);
  EXPECT_EQ(bounced.figures.front().name, "bounce");
  for (const char* name : {"self_test", "stratified", "lateness", "methods"})
    EXPECT_EQ(table_of(still, name).rows, table_of(bounced, name).rows) << name;
  const Table &before = table_of(still, "cells"), &after = table_of(bounced, "cells");
  ASSERT_EQ(before.rows.size(), after.rows.size());
  for (std::size_t row = 0; row < before.rows.size(); ++row)
    EXPECT_EQ(value_of(before, row, "tunneled"), value_of(after, row, "tunneled")) << row;
  EXPECT_EQ(still.tables.size() + 2, bounced.tables.size());
}

/// The rows of the plan, every one with this tally.
std::vector<ThinWallRow> tallied(const ShotPlan& plan, const Tally& tally) {
  std::vector<ThinWallRow> rows = rows_of(plan);
  for (ThinWallRow& row : rows) row.tally = tally;
  return rows;
}

TEST(ThinWallBounce, ends_must_be_where_the_push_led) {
  const ShotPlan plan = plan_of(bouncing);
  EXPECT_TRUE(ends_agree(tallied(plan, {.shots = 100, .tunneled = 40, .wrong_side = 10, .behind = 50})));
  EXPECT_FALSE(ends_agree(tallied(plan, {.shots = 100, .tunneled = 40, .wrong_side = 10, .behind = 49})));
}

/// Each of the self-tests alone: of who went through, of where balls end, and of evenly spread phases.
TEST(ThinWallBounce, one_count_too_many_of_any_kind_fails_the_self_test) {
  const auto run =
      run_of(thin_wall_experiment(),
             "speed = [40]\nstep = [0.01]\nradius = [0.02]\nthickness = [0.01]\nangle_deg = [0]\nshots = 50\n"
             "wall = ['infinite']\nresponse = 'bounce'\nscalar = ['double']\nmethod = ['closed_form']");
  const std::vector<std::string> right = results_of(run->units());
  const auto passes = [&](const Tally& more, std::int64_t evenly) {
    std::vector<std::string> results = right;
    Tally tally = from_text<Tally>(results.front());
    results.front() = to_text(tally += more);
    results.back() = to_text(std::vector<std::int64_t>{evenly});
    return run->finish(results, std::vector<double>(results.size(), 1)).self_test_passed;
  };
  EXPECT_TRUE(passes({}, 0));
  EXPECT_FALSE(passes({.wrong_side = 1, .behind = 1}, 0));
  EXPECT_FALSE(passes({.behind = 1}, 0));
  EXPECT_FALSE(passes({}, 2));
}

/// Of a method whose bullets all are detected so late, at such a gap.
ThinWallTotal detected(const char* method, double late, double gap) {
  static const ShotPlan plan = plan_of(small);
  std::vector<ThinWallRow> rows = tallied(plan, {.shots = 100, .latest = late, .earliest = late, .widest = gap});
  rows.resize(plan.methods.size());
  const std::vector<ThinWallTotal> totals = totals_of(rows);
  return *std::ranges::find_if(totals, [&](const ThinWallTotal& t) { return t.method->name == method; });
}

TEST(LatenessTest, wants_hits_on_time_and_poses_late_and_catches_false_hits_and_late_ones) {
  EXPECT_TRUE(detected("closed_form", 0, 0).lateness_passes());
  EXPECT_FALSE(detected("end_of_step", 0, 0).lateness_passes());  // its mean cannot be 0
  EXPECT_EQ(detected("closed_form", 0, 1e-3).false_cells, 1);     // who always says "hit" would never tunnel
  EXPECT_FALSE(detected("closed_form", 0, 1e-3).lateness_passes());
  EXPECT_EQ(detected("end_of_step", 0.0501, 0).late_cells, 1);  // at most 5 cm
  EXPECT_EQ(detected("end_of_step", 0.05, 0).late_cells, 0);
}

TEST(Stratified, passes_the_true_counts_and_catches_two_too_many) {
  const ShotPlan plan = plan_of(small);
  std::vector<ThinWallRow> rows;
  for (ThinWallRow& row : rows_of(plan)) {
    if (!is_fired_evenly(row.cell, *row.method)) continue;
    row.tunneled_evenly = tunneled_evenly(row.cell, *row.method, 1);
    rows.push_back(row);
  }
  ASSERT_EQ(rows.size(), 17U * 11);  // infinite walls, in double
  for (const ThinWallTotal& total : totals_of(rows)) EXPECT_TRUE(total.even_passes()) << total.method->name;
  for (const std::int64_t count : {704, 708}) {  // 0.7 * 1009 = 706.3
    rows.front().tunneled_evenly = count;
    EXPECT_FALSE(totals_of(rows).front().even_passes()) << count;
  }
}

/// Evenly spread for any number of poses a step: the number of phases has no divisor that could be one.
TEST(Stratified, number_of_phases_is_prime) {
  for (std::int64_t divisor = 2; divisor < stratified_shots; ++divisor) ASSERT_NE(stratified_shots % divisor, 0);
}

TEST(ThinWallVolley, adds_up_to_the_same_tally_in_any_order) {
  for (const char* response : {"none", "bounce"}) {
    const ShotPlan plan = plan_of(small + "response = \"" + response + "\"\n", 50);
    for (const ThinWallRow& row : rows_of(plan)) {
      const Tally whole = fire(row.cell, *row.method, {.first = 0, .shots = plan.shots}, plan.seed);
      Tally forward, backward;
      std::vector<Volley> volleys = volleys_of(plan.shots, 17);
      for (const Volley& v : volleys) forward += fire(row.cell, *row.method, v, plan.seed);
      std::ranges::reverse(volleys);
      for (const Volley& v : volleys) backward += fire(row.cell, *row.method, v, plan.seed);
      EXPECT_EQ(forward, whole) << row.method->name;
      EXPECT_EQ(backward, whole) << row.method->name;
    }
  }
}

TEST(ThinWallVolley, is_a_unit_of_its_own_in_a_large_run_and_the_whole_cell_in_a_small_one) {
  const auto units = [](std::int64_t trials) {
    std::int64_t fired = 0;
    for (const Unit& unit : small_run(trials)->units()) {
      EXPECT_LE(unit.trials, most_shots_a_volley);
      EXPECT_EQ(unit.key.find(" from ") != std::string::npos,
                trials > most_shots_a_volley && !unit.key.ends_with(" stratified"));
      fired += unit.key.ends_with(" stratified") ? 0 : 1;
    }
    return fired;
  };
  EXPECT_EQ(units(2 * most_shots_a_volley + 1), 3 * units(most_shots_a_volley));
}

/// Results made up for every unit; what comes out must depend on their sums alone.
TEST(ThinWallVolley, makes_a_row_of_the_volleys_of_a_cell) {
  const auto whole = small_run(60), halves = small_run(2 * most_shots_a_volley);
  const std::vector<std::string> in_one = results_of(whole->units());
  std::vector<std::string> in_two;
  std::size_t next = 0;
  for (const Unit& unit : halves->units()) {
    const bool is_second = unit.key.ends_with(" from " + std::to_string(most_shots_a_volley));
    in_two.push_back(is_second ? to_text(Tally{}) : in_one[next++]);
  }
  const Outcome one = whole->finish(in_one, std::vector<double>(in_one.size(), 0.5));
  const Outcome two = halves->finish(in_two, std::vector<double>(in_two.size(), 0.25));
  EXPECT_EQ(table_of(one, "cells").rows, table_of(two, "cells").rows);
  EXPECT_EQ(value_of(table_of(one, "timings"), 0, "nanoseconds_per_shot"),
            value_of(table_of(two, "timings"), 0, "nanoseconds_per_shot"));
}

TEST(ThinWallVolley, has_room_for_no_more_shots_a_cell_than_its_sums_do) {
  EXPECT_NO_THROW(small_run(most_shots_a_cell));
  EXPECT_THROW(small_run(most_shots_a_cell + 1), UsageError);
}

/// What the default run promises: every method of the list, ten million shots, the whole range.
TEST(ThinWallConfig, default_fires_everything_and_ten_million_shots_over_the_whole_range) {
  const auto units = run_of(thin_wall_experiment(), "")->units();
  std::int64_t shots = 0;
  for (const Unit& unit : units) shots += unit.trials;
  EXPECT_GE(shots, 10'000'000);
  for (const std::string_view method : method_names()) {
    const auto is_its = [&](const Unit& unit) { return unit.key.find(method) != std::string::npos; };
    EXPECT_TRUE(std::ranges::any_of(units, is_its)) << method;
  }
  const ShotPlan plan = plan_of("");
  const auto expect_ends = [&](double Cell::*factor, double least, double most) {
    const auto [slow, fast] = std::ranges::minmax(plan.cells, {}, factor);
    EXPECT_EQ(slow.*factor, least);
    EXPECT_EQ(fast.*factor, most);
  };
  expect_ends(&Cell::speed, 1, 2000);
  expect_ends(&Cell::step, 1e-3, 1.0 / 30);
  expect_ends(&Cell::thickness, 1e-4, 0.1);
  expect_ends(&Cell::angle_deg, 0, 80);
}

/// What a factor's own range allows is refused by every experiment's test.
TEST(ThinWallConfig, refuses_what_cannot_be_fired) {
  expect_refusals(thin_wall_experiment(), {{"radius = [0]\nthickness = [0]", "key 'thickness'"},
                                           {"radius = [1e-10]\nthickness = [0]", "key 'thickness'"},
                                           {"speed = [1e-9]", "key 'speed'"},
                                           {"speed = [1e9]", "key 'speed'"},
                                           {"step = [1e-9]", "key 'step'"},
                                           {"wall_size = 0.01", "key 'wall_size'"},
                                           {"substeps = [1]", "key 'substeps'"},
                                           {"response = 'bounces'", "key 'response'"}});
}

// ---- The theory of what tunnels, without any experiment: bodies that are known, and lines through others.

constexpr double pi = std::numbers::pi;
const RoundedBox brick = {{0.5, 1.0, 0.25}, 0.3};
const RoundedBox plate = {{0, 1.0, 0.25}, 0.3};  // no thickness
const Vec3<double> oblique = Vec3<double>(2, -3, 6) / 7;

/// How far the point is from the box itself.
double distance(const RoundedBox& box, const Vec3<double>& point) {
  return (point.cwiseAbs() - box.half_extents).cwiseMax(0.0).norm();
}

/// Where a line nearest the origin at `foot` is inside: both ends of the chord, by bisection around its closest point.
double chord(const RoundedBox& box, const Vec3<double>& foot, const Vec3<double>& direction) {
  const auto gap = [&](double t) { return distance(box, foot + t * direction) - box.radius; };
  double left = -10, right = 10;
  for (int i = 0; i < 100; ++i) {  // ternary search: the gap is convex along the line
    const double third = (right - left) / 3;
    (gap(left + third) < gap(right - third) ? right : left) += gap(left + third) < gap(right - third) ? -third : third;
  }
  const double nearest = (left + right) / 2;
  if (gap(nearest) > 0) return 0;
  const auto end = [&](double outside) {
    double inside = nearest;
    for (int i = 0; i < 60; ++i) (gap((inside + outside) / 2) <= 0 ? inside : outside) = (inside + outside) / 2;
    return inside;
  };
  return end(10) - end(-10);
}

/// Two unit vectors across the direction, turned by a radian so that a lattice of them is aligned with no face.
std::array<Vec3<double>, 2> across(const Vec3<double>& direction) {
  const Vec3<double> helper = std::abs(direction[2]) < 0.9 ? Vec3<double>(0, 0, 1) : Vec3<double>(1, 0, 0);
  const Vec3<double> u = cross<double>(direction, helper).normalized();
  const Vec3<double> v = cross<double>(direction, u);
  return {std::cos(1.0) * u + std::sin(1.0) * v, std::cos(1.0) * v - std::sin(1.0) * u};
}

/// Volume, shadow and longest chord at once, from a lattice of lines across the direction.
struct Measured {
  double volume = 0, shadow = 0, longest = 0;
};
Measured measure(const RoundedBox& box, const Vec3<double>& direction) {
  constexpr int lines = 120;
  const double reach = box.half_extents.norm() + box.radius, spacing = 2 * reach / lines;
  const auto [u, v] = across(direction);
  Measured sum;
  for (int i = 0; i < lines; ++i) {
    for (int j = 0; j < lines; ++j) {
      const double length =
          chord(box, (-reach + (i + 0.5) * spacing) * u + (-reach + (j + 0.5) * spacing) * v, direction);
      sum.volume += length * spacing * spacing;
      sum.shadow += length > 0 ? spacing * spacing : 0;
      sum.longest = std::max(sum.longest, length);
    }
  }
  return sum;
}

TEST(TunnelingTheory, misses_begin_where_the_spacing_exceeds_the_chord) {
  EXPECT_EQ(miss_probability(1, 0.5), 0);
  EXPECT_EQ(miss_probability(1, 1), 0);
  EXPECT_EQ(miss_probability(1, 4), 0.75);
  EXPECT_EQ(slab_chord(0.5, 0.25, 0.5), 2);
}

TEST(TunnelingTheory, of_known_bodies) {
  EXPECT_DOUBLE_EQ(volume({{0, 0, 0}, 2}), 4 * pi / 3 * 8);
  EXPECT_DOUBLE_EQ(volume({{1, 2, 3}, 0}), 48);
  EXPECT_DOUBLE_EQ(volume({{0, 0, 3}, 2}), pi * 4 * 6 + 4 * pi / 3 * 8);  // a capsule
  EXPECT_DOUBLE_EQ(shadow({{0, 0, 0}, 2}, oblique), pi * 4);
  EXPECT_DOUBLE_EQ(shadow({{1, 2, 3}, 0}, {1, 0, 0}), 24);
  EXPECT_DOUBLE_EQ(shadow({{1, 2, 3}, 0.5}, {0, 0, 1}), 2 * 4 + 0.5 * 12 + pi / 4);
  EXPECT_DOUBLE_EQ(longest_chord({{0, 0, 0}, 2}, oblique), 4);
  EXPECT_DOUBLE_EQ(longest_chord(brick, {1, 0, 0}), 1.6);
  // A wide wall: every line through its middle cuts (w + 2r) / cos a.
  EXPECT_DOUBLE_EQ(longest_chord({{0.5, 50, 50}, 0.25}, {0.6, 0.8, 0}), slab_chord(1, 0.25, 0.6));
}

TEST(TunnelingTheory, agrees_with_a_lattice_of_lines) {
  for (const RoundedBox& box : {brick, plate}) {
    for (const Vec3<double>& direction : {Vec3<double>(1, 0, 0), Vec3<double>(0.6, 0.8, 0), oblique}) {
      const Measured sum = measure(box, direction);
      EXPECT_NEAR(volume(box) / sum.volume, 1, 5e-3);
      EXPECT_NEAR(shadow(box, direction) / sum.shadow, 1, 5e-3);
      EXPECT_GE(longest_chord(box, direction), sum.longest * (1 - 1e-12));
      EXPECT_NEAR(longest_chord(box, direction) / sum.longest, 1, 1e-2);
    }
  }
}

/// Poses at a uniform phase on lines uniform over the shadow, counted, with no formula in between.
TEST(TunnelingTheory, finite_wall_agrees_with_counting) {
  const double spacing = 2.5;
  const auto [u, v] = across(oblique);
  const double reach = brick.half_extents.norm() + brick.radius;
  std::int64_t lines = 0, missed = 0;
  for (std::uint64_t trial = 0; lines < 20000; ++trial) {
    const RandomWords words = random_words({1, 2}, trial, 0);
    const Vec3<double> foot = reach * ((2 * uniform(words[0]) - 1) * u + (2 * uniform(words[1]) - 1) * v);
    if (chord(brick, foot, oblique) <= 0) continue;
    ++lines;
    bool seen = false;
    for (int k = -4; k <= 4; ++k)
      seen |= distance(brick, foot + (k + uniform(words[2])) * spacing * oblique) <= brick.radius;
    missed += seen ? 0 : 1;
  }
  const auto theory = miss_probability(brick, oblique, spacing);
  ASSERT_TRUE(theory.has_value());
  const double n = static_cast<double>(lines);
  EXPECT_NEAR(static_cast<double>(missed) / n, *theory, 4 * std::sqrt(*theory * (1 - *theory) / n));
}

TEST(TunnelingTheory, finite_wall_is_silent_about_steps_shorter_than_its_longest_chord) {
  const double longest = longest_chord(brick, oblique);
  EXPECT_FALSE(miss_probability(brick, oblique, 0.99 * longest).has_value());
  EXPECT_TRUE(miss_probability(brick, oblique, 1.01 * longest).has_value());
  EXPECT_FALSE(center_ray_miss_probability(brick, 1.59).has_value());
}

/// A ball against a point: the ray sees nothing of positive measure, so both chances are those of a sphere and a line.
TEST(TunnelingTheory, center_ray_at_a_point_is_no_better_than_poses) {
  const RoundedBox point = {{0, 0, 0}, 1};
  EXPECT_DOUBLE_EQ(*center_ray_miss_probability(point, 4), *miss_probability(point, {1, 0, 0}, 4));
  EXPECT_DOUBLE_EQ(*center_ray_miss_probability(point, 4), 1 - 2.0 / (3 * 2));  // 1 - 2 / (3 k), k = s / 2R
  EXPECT_DOUBLE_EQ(*center_ray_miss_probability({{1, 2, 3}, 0}, 4), 0);         // a point sees all there is
}

TEST(TunnelingTheory, lateness_of_poses) {
  EXPECT_EQ(pose_lateness(1, 4).mean, 0.5);
  EXPECT_EQ(pose_lateness(1, 4).largest, 1);
  EXPECT_EQ(pose_lateness(4, 1).largest, 1);
  EXPECT_DOUBLE_EQ(pose_lateness(4, 1).deviation, 1 / std::sqrt(12.0));
}

/// The moments of min(s X, q) over a uniform X, by the midpoint rule.
TEST(TunnelingTheory, lateness_of_the_center_ray) {
  constexpr int parts = 100000;
  for (const double lead : {0.0, 0.1, 0.9, 1.5, 2.0}) {
    double mean = 0, square = 0, largest = 0;
    for (int i = 0; i < parts; ++i) {
      const double late = std::min(1.5 * (i + 0.5) / parts, lead);
      mean += late / parts;
      square += late * late / parts;
      largest = std::max(largest, late);
    }
    const Lateness theory = center_ray_lateness(lead, 1.5);
    EXPECT_NEAR(theory.mean, mean, 1e-9);
    EXPECT_NEAR(theory.deviation * theory.deviation, square - mean * mean, 1e-9);
    EXPECT_NEAR(theory.largest, largest, 1e-4);
  }
}

}  // namespace

}  // namespace thinwall
