// Axes are of unit length to rounding only. A box along the world's axes, whose own are off by 8 u, is met as the upright box of its edges'
// true lengths is.

#include <cmath>

#include <gtest/gtest.h>

#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/judge.hpp"
#include "support/portable_draw.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {
namespace {

using V = Vec3<double>;
using Ball = Sphere<double>;
const Allowance allowance = {4, 4, 1};
const std::uint64_t boxes = thorough(slow_build ? 50 : 1000);

/// A plate or a block at the origin, and a ball that comes from near one of its faces.
struct NearShot : PortableDraw {
  Moving<Obb<double>> box;
  Moving<Aabb<double>> upright;
  Moving<Ball> ball;

  explicit NearShot(std::uint64_t seed) : PortableDraw(seed) {
    const auto length = [this] { return 1 + (below(17) - 8) * 0x1p-53; };
    const int side = below(3);
    V lengths;
    for (int i = 0; i < 3; ++i) lengths[i] = length();
    V halves = V::Constant(8);  // powers of two: products with lengths are exact
    halves[side] = std::ldexp(1.0, -below(8));
    box = at_rest(Obb<double>{V::Zero(), halves, Mat3<double>(lengths.asDiagonal())});
    upright = at_rest(Aabb<double>{V::Zero(), halves.cwiseProduct(lengths)});
    V from = vector(-3, 3), to = vector(-6, 6);
    from[side] = (one_in(2) ? -1 : 1) * (halves[side] + 0x1p-4 + between(0.01, 0.3));
    to[side] = 0;
    ball = {{from, 0x1p-4}, to - from};
  }
};

TEST(AxesLengths, count_for_a_sphere) {
  for (std::uint64_t seed = 0; seed < boxes; ++seed) {
    const NearShot shot(seed);
    const oracle::Pair pair = oracle::pair(shot.upright, shot.ball);
    EXPECT_TRUE(clear_impact(shot.box, shot.ball, 0.0).clear) << "seed " << seed;
    EXPECT_TRUE(judge(pair, time_of_impact(shot.box, shot.ball), allowance)) << "seed " << seed;
    EXPECT_TRUE(judge(pair, careful_impact(ClosedForm<double>{}, shot.box, shot.ball), allowance)) << "seed " << seed;
  }
}

TEST(AxesLengths, count_for_a_capsule) {
  for (std::uint64_t seed = 0; seed < boxes / 10; ++seed) {
    NearShot shot(seed);
    const V start = shot.ball.shape.center, away = start.cwiseSign() * shot.between(0, 0.5);
    const Moving capsule{Capsule<double>{start, start + away, shot.ball.shape.radius}, shot.ball.displacement};
    EXPECT_TRUE(judge(oracle::pair(shot.upright, capsule), time_of_impact(shot.box, capsule), allowance))
        << "seed " << seed;
  }
}

TEST(AxesLengths, count_for_a_ray) {
  for (std::uint64_t seed = 0; seed < boxes; ++seed) {
    const NearShot shot(seed);
    const Ray<double> ray{shot.ball.shape.center, shot.ball.displacement, 1};
    const oracle::Pair pair = oracle::pair(shot.upright, Moving{Ball{ray.origin, 0}, ray.direction});
    const oracle::Impact truth = oracle::impact(pair);
    for (const auto& hit : {raycast(ray, shot.box.shape), careful_raycast(ray, shot.box.shape)}) {
      ASSERT_EQ(hit.has_value(), truth.verdict == oracle::Verdict::hit) << "seed " << seed;
      if (!hit) continue;
      EXPECT_LE(oracle::forward_error_in_u_kappa(truth, hit->t), 4) << "seed " << seed;
      EXPECT_TRUE(is_unit(hit->normal)) << "seed " << seed;
      EXPECT_LE(oracle::length(oracle::lift_vector(hit->point) - pair.offset(truth.time)), 0x1p-46) << "seed " << seed;
    }
  }
}

/// A floor leans by what its axes do, more than sizes round far from its middle.
TEST(AxesLengths, are_not_clear_where_axes_lean) {
  Obb<double> floor{V::Zero(), {10, 1, 0x1p-4}, Mat3<double>::Identity()};
  const Moving<Ball> ball{{{5, 0, 0x1p-3 + 0x1p-5}, 0x1p-5}, {0, 0, -0.125}};
  EXPECT_TRUE(clear_impact(at_rest(floor), ball, 0.0).clear);
  floor.axes(2, 0) = 0x1p-50;
  EXPECT_FALSE(clear_impact(at_rest(floor), ball, 0.0).clear);
}

}  // namespace
}  // namespace thinwall::testing
