/// The swept bounds' answers: who makes false hits, who misses, and does theory agree?
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/experiments/self_test.hpp>
#include <thinwall/swept/swept_volume.hpp>

#include "experiments/swept_bounds_run.hpp"

namespace thinwall {
namespace {

/// Lines of a run that is large enough to tell theories apart.
const std::vector<SweepLine>& measured() {
  static const std::vector<SweepLine> lines =
      sweep_lines("speed = [2.5, 40]\nangle_deg = [0, 30, 90]\nobstacle = [0.1, 1]", 4000);
  return lines;
}

TEST(SweptBounds, none_misses_what_is_touched) {
  for (const SweepLine& l : measured()) EXPECT_EQ(l.tally.missed, 0) << key(l.sweep) << " " << l.bound;
}

TEST(SweptBounds, the_exact_make_no_false_hit_and_the_naive_do) {
  for (const SweepLine& l : measured()) {
    const bool ball = l.sweep.form == SweptForm::sphere;
    const bool along_axis = direction(l.sweep).cwiseAbs().maxCoeff() == 1;
    const bool exact = l.bound == "closed_form" || l.bound == "relative_capsule" || (l.bound == "capsule" && ball) ||
                       (l.bound == "oriented_box" && along_axis) ||
                       (l.bound == "enclosing_aabb" && along_axis && !ball);
    EXPECT_EQ(l.tally.false_hits == 0, exact) << key(l.sweep) << " " << l.bound;
  }
}

TEST(SweptBounds, agrees_with_theory) {
  const Outcome outcome = sweep_outcome(few_sweeps);
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_EQ(table_of(outcome, "self_test").rows.size(), 6U * 4);  // six bounds, four events
}

/// Of two rectangles that mirror each other the library and the theory may pick different ones.
TEST(SweptBounds, does_not_mind_a_tie_of_oriented_boxes) {
  EXPECT_TRUE(all_passed(self_test(counts_of(sweep_lines(
      "shape = ['plate', 'cube']\nangle_deg = [15, 30, 45, 75]\nturn_deg = [45]\nobstacle = [0.1]", 5000)))));
}

/// Does the self-test pass if the volume around a body is another function of the ball's radius?
using Volume = std::function<double(const RoundedZonotope& body, double ball)>;

bool passes(const Volume& volume_with_ball) {
  std::vector<SweepLine> lines = measured();
  const std::vector<std::string_view> names = swept_bound_names();
  const std::vector<SweptBound> bounds = swept_bounds_named(std::vector<std::string>(names.begin(), names.end()));
  for (SweepLine& l : lines) {
    const auto bound =
        std::find_if(bounds.begin(), bounds.end(), [&](const SweptBound& b) { return b.name == l.bound; });
    const double ball = ball_radius(l.sweep), drawn = volume(region_around(bound->body(l.sweep), l.sweep));
    const double of_exact = volume_with_ball(exact_body(l.sweep).body, ball);
    const double of_bound = volume_with_ball(bound->body(l.sweep).body, ball);
    l.theory.touching = std::min(1.0, of_exact / drawn);
    if (l.theory.false_hits > 0)
      l.theory.false_hits = std::clamp(of_bound / drawn - l.theory.touching, 0.0, 1 - l.theory.touching);
  }
  return all_passed(self_test(counts_of(lines)));
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

/// A bound that misses, or reports more than its volume, fails too.
TEST(SweptBounds, fails_a_wrong_count) {
  const auto passes_with = [](const std::function<void(SweepTally&)>& change) {
    std::vector<SweepLine> lines = measured();
    change(lines[5].tally);
    return all_passed(self_test(counts_of(lines)));
  };
  EXPECT_TRUE(passes_with([](SweepTally&) {}));
  EXPECT_FALSE(passes_with([](SweepTally& t) { t.missed = 1; }));
}

/// What makes the zero of the misses mean something.
TEST(SweptBounds, grazing_balls_find_a_bound_that_is_a_little_too_small) {
  const Sweep s = {SweptForm::sphere, 10, 1.0 / 60, 0.04, 30, 45, 1};
  Capsule<double> thin = swept_volume(moving_ball(s)), shortened = thin;
  thin.radius *= 1 - 1e-4;
  shortened.b = shortened.a + (shortened.b - shortened.a) * (1 - 1e-4);
  const Sweep boxed = {SweptForm::plate, 10, 1.0 / 60, 0.04, 30, 45, 1};
  Obb<double> small = swept_volume(moving_box(boxed));
  small.half_extents[1] *= 1 - 1e-4;
  Capsule<double> tight =
      swept_volume(Moving{Sphere<double>{Vec3<double>::Zero(), half_extents(boxed).norm()}, path(boxed)});
  tight.radius *= 1 - 1e-4;
  std::int64_t by_thin = 0, by_shortened = 0, by_small = 0, by_tight = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Sphere<double> ball = grazing_ball(s, Mat3<double>::Identity(), random_stream(s, 1), i);
    const Sphere<double> at_box = grazing_ball(boxed, small.axes, random_stream(boxed, 1), i);
    by_thin += overlaps(thin, ball) ? 0 : 1;
    by_shortened += overlaps(shortened, ball) ? 0 : 1;
    by_small += overlaps(small, at_box) ? 0 : 1;
    by_tight += overlaps(tight, at_box) ? 0 : 1;
  }
  EXPECT_GT(by_thin, 900);
  EXPECT_GT(by_shortened, 300);
  EXPECT_GT(by_small, 50);
  EXPECT_GT(by_tight, 200);
}

TEST(SweptBounds, does_not_depend_on_the_order_of_the_units) {
  const auto run = sweep_run(few_sweeps);
  std::vector<Unit> units = run->units();
  const std::vector<std::string> forward = results_of(units);
  std::reverse(units.begin(), units.end());
  std::vector<std::string> backward = results_of(units);
  std::reverse(backward.begin(), backward.end());
  EXPECT_EQ(forward, backward);
}

TEST(SweptBounds, a_cell_keeps_its_balls_whatever_else_is_asked) {
  const Table all = table_of(sweep_outcome(few_sweeps), "cells");
  const Table one = table_of(
      sweep_outcome("shape = ['rod']\nspeed = [40]\nangle_deg = [30]\nturn_deg = [45]\nobstacle = [0.1]\nshots = 1000\n"
                    "bound = ['oriented_box']\ntiming_repeats = 0"),
      "cells");
  ASSERT_EQ(one.rows.size(), 2U);  // the diagonal cube, and the cell
  for (const std::vector<Value>& row : one.rows) {
    EXPECT_NE(std::find(all.rows.begin(), all.rows.end(), row), all.rows.end());
  }
}

}  // namespace
}  // namespace thinwall
