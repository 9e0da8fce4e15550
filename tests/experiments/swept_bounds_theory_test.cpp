/// The swept bounds' volumes, oracle and balls against numbers that are found another way.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/experiments/swept_bounds/theory.hpp>
#include <thinwall/swept/swept_volume.hpp>

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

TEST(Steiner, of_a_swept_box_is_its_volume_and_the_way_of_its_shadow) {
  for (const Sweep& s : sweeps) {
    if (s.form == SweptForm::sphere) continue;
    const Vec h = half_extents(s), d = path(s);
    const double shadow =
        4 * (h[1] * h[2] * std::abs(d[0]) + h[0] * h[2] * std::abs(d[1]) + h[0] * h[1] * std::abs(d[2]));
    EXPECT_NEAR(volume(exact_body(s).body), 8 * h.prod() + shadow, 1e-15) << sweep_factors().key(s);
  }
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
    EXPECT_NEAR(counted / volume(reached), 1, 6e-3) << sweep_factors().key(s);
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
      EXPECT_LE(found, least + 1e-15) << sweep_factors().key(s);
      EXPECT_GE(found, least - path(s).norm() / poses) << sweep_factors().key(s);
    }
  }
}

TEST(SweepOracle, grazing_balls_touch_and_barely) {
  for (const Sweep& s : sweeps) {
    double deepest = 0;
    for (std::uint64_t i = 0; i < 500; ++i) {
      const Sphere<double> ball = grazing_ball(s, exact_body(s).axes, random_stream(s, 1), i);
      EXPECT_TRUE(touches(s, ball.center)) << sweep_factors().key(s);
      const double depth = ball.radius - static_cast<double>(least_distance(s, ball.center));
      deepest = std::max(deepest, depth);
    }
    EXPECT_LT(deepest, 1e-6 * (path(s).norm() + s.width + ball_radius(s))) << sweep_factors().key(s);
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
      EXPECT_GE(area(degree * pi / 180), area(0) * (1 - 1e-12)) << sweep_factors().key(s);
    EXPECT_NEAR(volume(fitted.body), 8 * swept_volume(moving_box(s)).half_extents.prod(), 1e-15)
        << sweep_factors().key(s);
  }
}

TEST(SweepTheory, is_zero_only_where_the_bound_is_exact) {
  for (const Sweep& s : sweeps) {
    const bool ball = s.form == SweptForm::sphere, along_axis = direction(s).cwiseAbs().maxCoeff() == 1;
    EXPECT_GT(sweep_theory(enclosing_sphere_body(s), s).false_hits, 0) << sweep_factors().key(s);
    EXPECT_EQ(sweep_theory(enclosing_aabb_body(s), s).false_hits == 0, !ball && along_axis) << sweep_factors().key(s);
    EXPECT_EQ(sweep_theory(capsule_body(s), s).false_hits == 0, ball) << sweep_factors().key(s);
    EXPECT_EQ(sweep_theory(exact_body(s), s).false_fraction, 0) << sweep_factors().key(s);
    if (!ball) {
      EXPECT_EQ(sweep_theory(oriented_box_body(s), s).false_hits == 0, along_axis) << sweep_factors().key(s);
    }
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
  const double widths = path_to_turn_for(s).value();
  for (const double factor : {0.99, 1.01}) {
    s.speed = factor * widths * s.width / s.step;
    EXPECT_EQ(sweep_theory(oriented_box_body(s), s).false_hits /
              sweep_theory(oriented_box_body(s), s)
                  .touching<sweep_theory(enclosing_aabb_body(s), s).false_hits /
                                sweep_theory(enclosing_aabb_body(s), s).touching,
                            factor> 1);
  }
  s.angle_deg = 0;
  EXPECT_FALSE(path_to_turn_for(s));
  EXPECT_FALSE(path_to_turn_for(diagonals[0]));
}

}  // namespace
}  // namespace thinwall
