// Two faces of upright boxes met at once to rounding, one of them slowly: the forward error is that of the face met last.

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
using Box = Aabb<double>;
using Point = Sphere<double>;

/// A box at rest, and one or a point of half extents `half` that comes beside its faces across x and y at one time but for rounding; half of
/// them through a shift that both have.
struct Tie : PortableDraw {
  Moving<Box> box;
  V half, start, path;

  Tie(std::uint64_t seed, bool is_point) : PortableDraw(seed) {
    const V shift = one_in(2) ? any(-64, 64) : V(V::Zero());
    box = {{any(-1, 1), any(0.2, 0.8)}, shift};
    half = is_point ? V(V::Zero()) : any(0.1, 0.5);
    const double time = between(0.1, 0.9);
    V signs, beside;
    for (int i = 0; i < 3; ++i) signs[i] = one_in(2) ? 1 : -1;
    path = V(between(0.5, 2), std::ldexp(between(0.5, 1), -below(50)), between(-0.2, 0.2)).cwiseProduct(signs);
    for (int i = 0; i < 2; ++i) beside[i] = -signs[i] * (box.shape.half_extents[i] + half[i]) - path[i] * time;
    beside[2] = between(-0.1, 0.1);
    start = box.shape.center + beside;
    path += shift;
  }
  V any(double low, double high) {
    const double x = between(low, high), y = between(low, high);
    return {x, y, between(low, high)};
  }
};
const std::uint64_t motions = thorough(slow_build ? 50 : 1000);

template <class A, class B> void meets_the_contract(const Moving<A>& a, const Moving<B>& b, std::uint64_t seed) {
  const oracle::Pair pair = oracle::pair(a, b);
  const Allowance allowance = {4, 4, 1};
  EXPECT_TRUE(judge(pair, time_of_impact(a, b), allowance)) << "seed " << seed;
  EXPECT_TRUE(judge(pair, careful_impact(ClosedForm<double>{}, a, b), allowance)) << "careful, seed " << seed;
}

TEST(Ties, two_boxes) {
  for (std::uint64_t seed = 0; seed < motions; ++seed) {
    const Tie tie(seed, false);
    meets_the_contract(tie.box, Moving{Box{tie.start, tie.half}, tie.path}, seed);
  }
}

TEST(Ties, a_box_and_a_point) {
  for (std::uint64_t seed = 0; seed < motions; ++seed) {
    const Tie tie(seed, true);
    meets_the_contract(tie.box, Moving{Point{tie.start, 0}, tie.path}, seed);
  }
}

TEST(Ties, a_box_and_a_ray) {
  for (std::uint64_t seed = 0; seed < motions; ++seed) {
    const Tie tie(seed, true);
    const Ray<double> ray{tie.start, tie.path - tie.box.displacement, 1};
    const oracle::Impact truth =
        oracle::impact(oracle::pair(at_rest(tie.box.shape), Moving{Point{ray.origin, 0}, ray.direction}));
    for (const auto& hit : {raycast(ray, tie.box.shape), careful_raycast(ray, tie.box.shape)}) {
      ASSERT_EQ(hit.has_value(), truth.verdict == oracle::Verdict::hit) << "seed " << seed;
      if (!hit) continue;
      EXPECT_LE(oracle::forward_error_in_u_kappa(truth, hit->t), 4) << "seed " << seed;
    }
  }
}

/// As boxes in a grid: which axis is the last has no answer, and any will do.
TEST(Ties, two_axes_alike) {
  const Moving<Box> still = at_rest(Box{V::Zero(), V::Constant(0.5)});
  for (const V& from : {V(2, 2, 0), V(2, 2, 2), V(-3, 3, 0.25)}) {
    const Toi<double> toi = time_of_impact(still, Moving{Box{from, V::Constant(0.5)}, V(-from)});
    EXPECT_EQ(toi.status, ToiStatus::hit);
    EXPECT_DOUBLE_EQ(toi.time, 1 - 1 / std::abs(from[0]));
    EXPECT_EQ(toi.normal, V(from[0] > 0 ? 1 : -1, 0, 0));
  }
}

}  // namespace
}  // namespace thinwall::testing
