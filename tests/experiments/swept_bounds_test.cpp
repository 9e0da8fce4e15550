/// The swept bounds' volumes, oracle and balls against numbers that are found another way.

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/table_text.hpp>
#include <thinwall/experiments/swept_bounds/bounds.hpp>
#include <thinwall/swept/swept_volume.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

namespace {

using std::numbers::pi;
using Vec = Vec3<double>;

const std::vector<Sweep> sweeps = {
    diagonals[0],
    diagonals[1],
    {SweptForm::sphere, 2.5, 1.0 / 60, 0.04, 30, 20, 0.1},
    {SweptForm::cube, 2.5, 1.0 / 60, 0.04, 54.735610317245346, 45, 1},
    {SweptForm::plate, 2.5, 1.0 / 60, 0.04, 30, 45, 0.1},
    {SweptForm::plate, 0.6, 1.0 / 60, 0.04, 90, 45, 10},
    {SweptForm::rod, 10, 1.0 / 60, 0.04, 75, 0, 1},
    {SweptForm::rod, 10, 1.0 / 60, 0.04, 0, 0, 0},
};

TEST(Steiner, knows_the_ball_the_capsule_and_the_box) {
  EXPECT_NEAR(volume(RoundedZonotope{{}, 3}), 36 * pi, 1e-12);
  EXPECT_NEAR(volume(RoundedZonotope{{{0, 3, 4}}, 2}), pi * 4 * 5 + 32 * pi / 3,
              1e-12);  // a cylinder and two half balls
  const SteinerNumbers box = steiner_numbers({{2, 0, 0}, {0, 3, 0}, {0, 0, 5}});
  EXPECT_NEAR(box.volume, 30, 1e-12);
  EXPECT_NEAR(box.area, 62, 1e-12);
  EXPECT_NEAR(box.mean_curvature, 10 * pi, 1e-12);
}

/// A polytope's mean curvature is half the sum of edge lengths times the angles between the normals at them.
TEST(Steiner, knows_the_rhombic_dodecahedron) {
  const SteinerNumbers body = steiner_numbers({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
  const double edge = std::sqrt(3.0);
  EXPECT_NEAR(body.volume, 16 * std::sqrt(3.0) / 9 * edge * edge * edge, 1e-12);
  EXPECT_NEAR(body.area, 8 * std::sqrt(2.0) * edge * edge, 1e-12);
  EXPECT_NEAR(body.mean_curvature, 24 * edge * (pi / 3) / 2, 1e-12);
}

/// Against the volume of all points within reach of the moving shape, counted on a grid by the oracle.
TEST(Steiner, grown_volumes_agree_with_a_grid) {
  for (const Sweep& s : sweeps) {
    const RoundedZonotope reached = grown(exact_body(s).body, ball_radius(s));
    const Mat3<double> axes = exact_body(s).axes;  // the grid along the motion
    constexpr int cells = 60;
    Vec half;
    for (int i = 0; i < 3; ++i) half[i] = half_width(reached, axes.col(i));
    std::int64_t inside = 0;
    for (int i = 0; i < cells; ++i) {
      for (int j = 0; j < cells; ++j) {
        for (int k = 0; k < cells; ++k) {
          const Vec place = (Vec(i + 0.5, j + 0.5, k + 0.5) * (2.0 / cells) - Vec::Ones()).cwiseProduct(half);
          inside += touches(s, path(s) / 2 + axes * place) ? 1 : 0;
        }
      }
    }
    const double counted = 8 * half.prod() * static_cast<double>(inside) / (1.0 * cells * cells * cells);
    EXPECT_NEAR(counted / volume(reached), 1, 6e-3) << sweep_factors.key(s);
  }
}

/// By walking through the step, where the distance can only be a little more than its least.
TEST(SweepOracle, least_distance_agrees_with_many_poses) {
  constexpr int poses = 4000;
  for (const Sweep& s : sweeps) {
    const BallRegion region = region_around(enclosing_sphere_body(s), s);
    const Vec h = s.form == SweptForm::sphere ? Vec(Vec::Zero()) : half_extents(s);
    for (std::uint64_t i = 0; i < 50; ++i) {
      const Vec c = ball_in(region, s, random_stream(s, 5), i).center;
      double least = std::numeric_limits<double>::infinity();
      for (int k = 0; k <= poses; ++k) {
        const Vec beside = ((c - path(s) * k / poses).cwiseAbs() - h).cwiseMax(0.0);
        least = std::min(least, beside.norm());
      }
      if (s.form == SweptForm::sphere) least = std::max(0.0, least - s.width / 2);
      const double found = static_cast<double>(least_distance(s, c));
      EXPECT_LE(found, least + 1e-15) << sweep_factors.key(s);
      EXPECT_GE(found, least - path(s).norm() / poses) << sweep_factors.key(s);
    }
  }
}

TEST(SweepOracle, grazing_balls_touch_and_barely) {
  for (const Sweep& s : sweeps) {
    double deepest = 0;
    for (std::uint64_t i = 0; i < 500; ++i) {
      const Sphere<double> ball = grazing_ball(s, exact_body(s).axes, random_stream(s, 1), i);
      EXPECT_TRUE(touches(s, ball.center)) << sweep_factors.key(s);
      const double depth = ball.radius - static_cast<double>(least_distance(s, ball.center));
      deepest = std::max(deepest, depth);
    }
    EXPECT_LT(deepest, 1e-6 * (path(s).norm() + s.width + ball_radius(s))) << sweep_factors.key(s);
  }
}

/// The library promises the least rectangle of any orientation; theory tries three. Every degree is tried here.
TEST(SweepTheory, oriented_box_is_the_least) {
  for (const Sweep& s : sweeps) {
    if (s.form == SweptForm::sphere || s.angle_deg == 0) continue;
    const FittedBody fitted = oriented_box_body(s);
    const RoundedZonotope exact = exact_body(s).body;
    const auto area = [&](double turn) {
      const Vec across = fitted.axes.col(1) * std::cos(turn) + fitted.axes.col(2) * std::sin(turn);
      return half_width(exact, across) * half_width(exact, cross<double>(fitted.axes.col(0), across));
    };
    for (int degree = 0; degree < 180; ++degree)
      EXPECT_GE(area(degree * pi / 180), area(0) * (1 - 1e-12)) << sweep_factors.key(s);
    EXPECT_NEAR(volume(fitted.body), 8 * swept_volume(moving_box(s)).half_extents.prod(), 1e-15)
        << sweep_factors.key(s);
  }
}

/// On a long path the ends no longer count: a capsule and what a cube sweeps differ by their cross sections alone.
TEST(SweepTheory, on_long_paths_is_a_quotient_of_areas) {
  const Sweep s = {SweptForm::cube, 24000, 1.0 / 60, 0.04, 0, 0, 1};
  const double h = 0.02, q = ball_radius(s), around = std::sqrt(3.0) * h + q;
  const double across = 4 * h * h + 8 * h * q + pi * q * q;
  EXPECT_NEAR(sweep_theory(capsule_body(s), s).false_fraction, 1 - across / (pi * around * around), 1e-3);
  EXPECT_GT(sweep_theory(enclosing_sphere_body(s), s).false_fraction, 0.999);
}

/// The picture in the text: a unit cube that moves by two widths along x and y.
TEST(SweepTheory, of_points_is_the_empty_volume) {
  const Sweep s = {SweptForm::cube, 2 * std::sqrt(2.0), 1, 1, 45, 0, 0};
  const SweepTheory aabb = sweep_theory(enclosing_aabb_body(s), s);
  EXPECT_NEAR(aabb.false_fraction, 1 - 5.0 / 9, 1e-12);  // 3 x 3 x 1, of which 1 + 2 sqrt(2) sqrt(2) is swept
  EXPECT_NEAR(aabb.empty, aabb.false_fraction, 1e-15);
  EXPECT_NEAR(sweep_theory(oriented_box_body(s), s).false_fraction, 1 - 5.0 / 6, 1e-12);  // 3 sqrt(2) x sqrt(2) x 1
}

TEST(SweepTheory, knows_from_which_path_on_to_turn) {
  Sweep s = diagonals[1];
  const auto wasted = [&](const FittedBody& body) {
    const SweepTheory theory = sweep_theory(body, s);
    return theory.false_hits / theory.touching;
  };
  const double widths = path_to_turn_for(s).value();
  for (const double factor : {0.99, 1.01}) {
    s.speed = factor * widths * s.width / s.step;
    EXPECT_EQ(wasted(oriented_box_body(s)) < wasted(enclosing_aabb_body(s)), factor > 1);
  }
  s.angle_deg = 0;
  EXPECT_FALSE(path_to_turn_for(s));
  EXPECT_FALSE(path_to_turn_for(diagonals[0]));
}

// ---- The swept bounds' settings and answers: who makes false hits, who misses, what it costs, and does theory agree?

SweepPlan sweep_plan(std::string_view text) {
  return make_sweeps(Settings(text, "test.toml", swept_bounds_experiment().default_toml));
}

/// The measured rows of settings laid over the defaults.
std::vector<SweepRow> sweep_rows(std::string_view text, std::int64_t shots) {
  static const std::vector<SweptBound> bounds = all_swept_bounds();
  std::vector<SweepRow> rows;
  for (const SweepPair& pair : serving_pairs(sweep_plan(text).cells, bounds))
    rows.push_back({pair, count_balls(pair, 1, shots)});
  return rows;
}

/// Rows of a run that is large enough to tell theories apart.
const std::vector<SweepRow>& measured() {
  static const std::vector<SweepRow> rows =
      sweep_rows("speed = [2.5, 40]\nangle_deg = [0, 30, 90]\nobstacle = [0.1, 1]", 4000);
  return rows;
}

TEST(SweptBounds, the_exact_make_no_false_hit_the_naive_do_and_none_misses_what_is_touched) {
  for (const SweepRow& r : measured()) {
    SCOPED_TRACE(sweep_factors.key(r.sweep) + " " + r.bound->name);
    const bool ball = r.sweep.form == SweptForm::sphere;
    const bool along_axis = direction(r.sweep).cwiseAbs().maxCoeff() == 1;
    const std::map<std::string_view, bool> exact = {
        {"enclosing_sphere", false}, {"enclosing_aabb", along_axis && !ball},
        {"capsule", ball},           {"oriented_box", along_axis},
        {"relative_capsule", true},  {"closed_form", true}};
    EXPECT_EQ(r.theory.false_hits == 0, exact.at(r.bound->name));
    EXPECT_EQ(r.tally.false_hits == 0, exact.at(r.bound->name));
    EXPECT_EQ(r.tally.missed, 0);
  }
}

/// Of two rectangles that mirror each other the library and the theory may pick different ones.
TEST(SweptBounds, does_not_mind_a_tie_of_oriented_boxes) {
  EXPECT_TRUE(all_passed(self_test(counts_of(sweep_rows(
      "shape = ['plate', 'cube']\nangle_deg = [15, 30, 45, 75]\nturn_deg = [45]\nobstacle = [0.1]", 5000)))));
}

/// Does the self-test pass if the volume around a body is another function of the ball's radius?
using Volume = std::function<double(const RoundedZonotope& body, double ball)>;

bool passes(const Volume& volume_with_ball) {
  std::vector<SweepRow> rows = measured();
  for (SweepRow& r : rows) {
    const FittedBody bound = r.bound->body(r.sweep);
    const double ball = ball_radius(r.sweep), drawn = volume(region_around(bound, r.sweep));
    r.theory.touching = std::min(1.0, volume_with_ball(exact_body(r.sweep).body, ball) / drawn);
    if (r.theory.false_hits == 0) continue;
    const double reported = volume_with_ball(bound.body, ball) / drawn;
    r.theory.false_hits = std::clamp(reported - r.theory.touching, 0.0, 1 - r.theory.touching);
  }
  return all_passed(self_test(counts_of(rows)));
}

TEST(SweptBounds, fails_a_wrong_theory) {
  const auto steiner = [](double volume_factor, double area, double curvature, double ball_factor) {
    return [=](const RoundedZonotope& body, double ball) {
      const SteinerNumbers of = steiner_numbers(body.segments);
      const double r = body.radius + ball;
      return volume_factor * of.volume + area * of.area * r + curvature * of.mean_curvature * r * r +
             ball_factor * volume(RoundedZonotope{{}, r});
    };
  };
  EXPECT_TRUE(passes(steiner(1, 1, 1, 1)));
  EXPECT_FALSE(passes(steiner(1, 1, 0, 1)));                                               // forgets the edges
  EXPECT_FALSE(passes(steiner(1, 1, 1, 0)));                                               // forgets the corners
  EXPECT_FALSE(passes(steiner(1, 1, 0.9, 1)));                                             // 10 % of the edges
  EXPECT_FALSE(passes(steiner(0.95, 1, 1, 1)));                                            // 5 % of the volume
  EXPECT_FALSE(passes([](const RoundedZonotope& body, double) { return volume(body); }));  // takes balls for points
}

TEST(SweptBounds, fails_a_bound_that_misses) {
  std::vector<SweepRow> rows = measured();
  rows[5].tally.missed = 1;
  EXPECT_FALSE(all_passed(self_test(counts_of(rows))));
}

/// What makes the zero of the misses mean something.
TEST(SweptBounds, grazing_balls_find_a_bound_that_is_a_little_too_small) {
  const auto found = [](const Sweep& s, const Mat3<double>& axes, const auto& bound) {
    std::int64_t missed = 0;
    for (std::uint64_t i = 0; i < 1000; ++i)
      missed += overlaps(bound, grazing_ball(s, axes, random_stream(s, 1), i)) ? 0 : 1;
    return missed;
  };
  const Sweep s = {SweptForm::sphere, 10, 1.0 / 60, 0.04, 30, 45, 1};
  const Mat3<double> upright = Mat3<double>::Identity();
  Capsule<double> thin = swept_volume(moving_ball(s)), shortened = thin;
  thin.radius *= 1 - 1e-4;
  shortened.b = shortened.a + (shortened.b - shortened.a) * (1 - 1e-4);
  EXPECT_GT(found(s, upright, thin), 900);
  EXPECT_GT(found(s, upright, shortened), 300);
  const Sweep boxed = {SweptForm::plate, 10, 1.0 / 60, 0.04, 30, 45, 1};
  Obb<double> small = swept_volume(moving_box(boxed));
  small.half_extents[1] *= 1 - 1e-4;
  Capsule<double> tight =
      swept_volume(Moving{Sphere<double>{Vec3<double>::Zero(), half_extents(boxed).norm()}, path(boxed)});
  tight.radius *= 1 - 1e-4;
  EXPECT_GT(found(boxed, small.axes, small), 50);
  EXPECT_GT(found(boxed, small.axes, tight), 200);
}

TEST(SweptBoundsConfig, opens_with_the_diagonals) {
  const SweepPlan plan = sweep_plan("");
  EXPECT_EQ(plan.cells[0], diagonals[0]);
  EXPECT_EQ(plan.cells[1], diagonals[1]);
  EXPECT_EQ(std::ranges::count_if(plan.cells, is_diagonal), 2);
  EXPECT_EQ(plan.view, diagonals[1]);
}

TEST(SweptBoundsConfig, draws_what_is_nearest_to_the_diagonal) {
  const SweepPlan plan = sweep_plan("speed = [1, 8, 90]\nangle_deg = [0, 40, 80]\nobstacle = [0, 3]");
  EXPECT_EQ(plan.view.speed, 8);
  EXPECT_EQ(plan.view.angle_deg, 40);
  EXPECT_EQ(plan.view.obstacle, 0);
  const SweepPlan along_x = sweep_plan("angle_deg = [0]\nturn_deg = [45]");
  EXPECT_EQ(along_x.view.turn_deg, 0);  // what goes along x is turned by nothing
}

/// In every picture, of whatever factor: what was counted lies on the line of its own bound.
TEST(SweptBounds, points_lie_on_the_lines_of_theory) {
  int compared = 0;
  for (const Figure& figure : small_outcome(swept_bounds_experiment()).figures) {
    for (const Panel& panel : figure.panels) {
      for (const Series& points : panel.series) {
        const auto is_its_line = [&](const Series& s) { return s.mark == Mark::line && s.label == points.label; };
        const auto line = std::ranges::find_if(panel.series, is_its_line);
        if (points.mark != Mark::points || line == panel.series.end()) continue;
        for (std::size_t i = 0; i < points.x.size(); ++i) {
          const auto nearest =
              std::ranges::min_element(line->x, {}, [&](double x) { return std::abs(x - points.x[i]); });
          EXPECT_NEAR(points.y[i], line->y[static_cast<std::size_t>(nearest - line->x.begin())], 0.08)
              << figure.name << " " << points.label << " at " << points.x[i];
          ++compared;
        }
      }
    }
  }
  EXPECT_GT(compared, 20);
}

/// Only the table of times may know how long anything took.
TEST(SweptBoundsConfig, what_is_not_a_timing_does_not_depend_on_the_clock) {
  const auto run =
      run_of(swept_bounds_experiment(),
             "shape = ['sphere', 'cube']\nspeed = [10]\nangle_deg = [45]\nturn_deg = [0]\nobstacle = [1]\nshots = 100\n"
             "timing_repeats = 2");
  const std::vector<std::string> results = results_of(run->units());
  const Outcome fast = run->finish(results, std::vector<double>(results.size(), 1e-6));
  const Outcome slow = run->finish(results, std::vector<double>(results.size(), 1));
  EXPECT_EQ(fast.answer, slow.answer);
  for (std::size_t i = 0; i < fast.tables.size(); ++i)
    EXPECT_EQ(csv_text(fast.tables[i]) == csv_text(slow.tables.at(i)), !fast.tables[i].is_timing);
  EXPECT_EQ(fast.tables.back().rows.size(), 4U + 6U);  // a sphere's bounds, and a cube's
  EXPECT_TRUE(fast.tables.back().is_timing);
}

TEST(SweptBoundsConfig, times_are_medians_over_the_rounds) {
  const auto bounds = only(all_swept_bounds(), [](const SweptBound& bound) { return bound.name == "capsule"; });
  const auto subjects = timed_subjects({diagonals[1]}, bounds, 1);
  ASSERT_EQ(subjects.size(), 4U);
  std::vector<double> seconds;
  for (const double round : {9.0, 1.0, 3.0, 6.0, 2.0}) {
    for (const TimedSubject& t : subjects) seconds.push_back(1e-9 * round * static_cast<double>(t.tests()));
  }
  const std::vector<SweepCost> costs = sweep_costs(subjects, seconds);
  ASSERT_EQ(costs.size(), 1U);
  EXPECT_NEAR(costs[0].quantile_ns(TimedWork::test).value(), 3, 1e-9);
  EXPECT_NEAR(costs[0].quantile_ns(TimedWork::pipeline, 0.25).value(), 2, 1e-9);
  EXPECT_NEAR(costs[0].quantile_ns(TimedWork::pipeline, 0.75).value(), 6, 1e-9);
  EXPECT_NEAR(costs[0].wasted_ns(), 3 * costs[0].false_hits, 1e-9);
  EXPECT_GT(costs[0].false_hits, 0);
}

TEST(SweptBoundsConfig, answers_for_any_choice_of_bounds_and_shapes) {
  for (const char* text : {"bound = ['closed_form']", "shape = ['sphere']\nbound = ['capsule']", "obstacle = [0]",
                           "angle_deg = [0]", "shape = ['plate']\nturn_deg = [90]\nangle_deg = [90]"}) {
    const Outcome outcome =
        outcome_of(swept_bounds_experiment(), std::string("speed = [10]\nshots = 50\ntiming_repeats = 0\n") + text);
    EXPECT_TRUE(holds(outcome.answer, "the bounds miss 0"));
    EXPECT_TRUE(outcome.self_test_passed) << text;
  }
}

TEST(SweptBoundsConfig, refuses_what_cannot_be_asked) {
  expect_refusals(swept_bounds_experiment(),
                  {{"shape = ['sphere']\nbound = ['oriented_box']", "one that serves one of the shapes"},
                   {"speed = [1e-6]", "a path of 0.001 to 10000 widths a step"},
                   {"speed = [1e8]", "a path of 0.001 to 10000 widths a step"},
                   {"angle_deg = [91]", "key 'angle_deg'"}});
}

}  // namespace

}  // namespace thinwall
