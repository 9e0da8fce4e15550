// Bisection, conservative advancement and inclusion by cases.

#include <gtest/gtest.h>

#include <thinwall/swept/methods/bisection.hpp>
#include <thinwall/swept/methods/conservative_advancement.hpp>
#include <thinwall/swept/methods/inclusion.hpp>

#include "support/method_cases.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

// ---- Bisection: late by at most the tolerance, bounded, and what it may miss.

template <class S> using BisectionMethod = MethodCases<S>;
TYPED_TEST_SUITE(BisectionMethod, Scalars, ScalarNames);

TYPED_TEST(BisectionMethod, is_late_by_at_most_the_tolerance) {
  using S = TypeParam;
  const S exact = time_of_impact(this->graze, this->post).time;
  for (const S& tolerance : {S(0.125), power<S>(-8), half_digits<S>(), S(4 * std::numeric_limits<S>::epsilon())}) {
    const Bisection<S> method{.tolerance = tolerance};
    const Toi<S> straight = time_of_impact(method, this->shot, this->wall);
    EXPECT_EQ(straight.status, ToiStatus::hit);
    EXPECT_TRUE(straight.time >= S(0.3125) && straight.time <= S(0.3125) + tolerance);
    EXPECT_EQ(straight.normal, Vec3<S>(1, 0, 0));
    const Toi<S> slanted = time_of_impact(method, this->graze, this->post);
    EXPECT_EQ(slanted.status, ToiStatus::hit);
    EXPECT_TRUE(slanted.time >= exact * (1 - 16 * unit<S>()) && slanted.time <= exact + tolerance + 16 * unit<S>());
  }
}

TEST(BisectionOfShapes, has_no_tolerance_below_what_their_times_resolve) {  // it would halve for ever
  const Moving<Sphere<double>> shot{{{-4, 0, 0}, 1}, {8, 0, 0}};
  const auto ball = at_rest(Sphere<double>{{0, 0.25, 0}, 1});
  const long double finest = std::numeric_limits<long double>::epsilon();
  EXPECT_EQ(time_of_impact(Bisection<long double>{.tolerance = finest}, shot, ball).status, ToiStatus::invalid);
  EXPECT_EQ(time_of_impact(Bisection<long double>{.tolerance = 0x1p-52L}, shot, ball).status, ToiStatus::hit);
}

TYPED_TEST(BisectionMethod, finds_a_contact_however_short) {  // no pose of a search by halves falls into this wall
  using S = TypeParam;
  const S third = S(1) / S(3);
  const Moving<Sphere<S>> fast{{{-1, 0, 0}, 0}, {3, 0, 0}};
  const S thin = power<S>(3 - std::numeric_limits<S>::digits);
  const auto plate = at_rest(Aabb<S>{{0, 0, 0}, {thin, 8, 8}});
  const Toi<S> toi = time_of_impact(Bisection<S>{}, fast, plate);
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_TRUE(toi.time > third - thin && toi.time < third + thin);
}

TYPED_TEST(BisectionMethod, a_miss_is_proven_by_two_tangents) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(Bisection<S>{}, this->passing, this->post);
  EXPECT_EQ(toi.status, ToiStatus::apart);
  EXPECT_LE(toi.evaluations, 12);
  const Moving<Sphere<S>> leaving{{{-4, 0, 0}, 1}, {-8, 0, 0}}, stopping{{{-4, 0, 0}, 1}, {1, 0, 0}};
  EXPECT_EQ(time_of_impact(Bisection<S>{}, leaving, this->post).evaluations, 2);
  EXPECT_EQ(time_of_impact(Bisection<S>{}, stopping, this->post).evaluations, 3);
}

TYPED_TEST(BisectionMethod, both_searches_are_bounded) {  // a touch that no pose shows and no tangent excludes
  using S = TypeParam;
  const int most = 3 + 2 * std::numeric_limits<S>::digits + std::numeric_limits<S>::digits;
  int longest = 0;
  for (int i = 0; i < 64; ++i) {
    const S height = S(2) * (1 + S(i - 32) * 4 * unit<S>());
    const Moving<Sphere<S>> touching{{{-4, height, 0}, 1}, {S(8) + S(i) / S(64), 0, 0}};
    const Bisection<S> finest{.tolerance = std::numeric_limits<S>::epsilon()};
    longest = std::max(longest, time_of_impact(finest, touching, this->post).evaluations);
  }
  EXPECT_LE(longest, most);
  EXPECT_GE(longest, std::numeric_limits<S>::digits / 3);
}

/// Boxes that are apart by 2^-24 at first, a fortieth of what their axes in float are off by: the way from one to the other says nothing.
TEST(BisectionInFloat, goes_by_no_slope_of_a_gap_that_is_rounding) {
  Shaker<float> draw(632056760);
  auto motion = drawn_motion<Obb<float>, Aabb<float>>(draw);
  const float apart = separation(motion.a.shape, motion.b.shape).distance;
  ASSERT_TRUE(apart > 0 && apart < 0x1p-22f) << apart;
  for (const float longer : {1.0f, 64.0f}) {  // in contact at the end; through and out by then
    motion.a.displacement *= longer;
    motion.b.displacement *= longer;
    const Toi<float> exact = time_of_impact(motion.a, motion.b),
                     toi = time_of_impact(Bisection<float>{}, motion.a, motion.b);
    ASSERT_EQ(exact.status, ToiStatus::hit);
    EXPECT_EQ(toi.status, ToiStatus::hit) << longer;
    EXPECT_LE(toi.time, exact.time + half_digits<float>());
  }
}

/// They are apart by little more than rounding, and the way from one to the other says that they part.
TEST(BisectionInDouble, goes_by_no_slope_that_rounding_may_turn) {
  using V = Vec3<double>;
  const Moving<Capsule<double>> needle{{V(0, 0, 0), V(0, 0, 0x1.fd9a4db5390ccp-1), 0},
                                       V(-0x1.ebb818b0dbde4p-2, -0x1.ebb818b0dbde4p-2, 0)};
  Mat3<double> axes;
  axes.col(0) << -0x1.fe4ddcaa6fddep-1, -0x1.cce830d9ee0fdp-7, -0x1.481447cab8264p-4;
  axes.col(1) << 0x1.46171621b2869p-4, 0x1.08046492ea62cp-5, -0x1.fe1ba9d833bebp-1;
  axes.col(2) << 0x1.0fe5694e42465p-6, -0x1.ffaef0044f3bcp-1, -0x1.fbf0434b27903p-6;
  const Moving<Obb<double>> plate{
      {V(-0x1.c89be1512861ep-23, 0x1.f98ba07757453p-17, 0x1.500f3ee5d49cp-2), V(1, 0, 0x1.f9d7295c2a3a6p-17), axes},
      V(-0x1.ebb80e0fc19b4p-2, -0x1.ebb82707d5eb5p-2, 0x1.6336e7e55ae2ep-3)};
  EXPECT_TRUE(overlaps(pose_at(needle, 1.0), pose_at(plate, 1.0)));
  EXPECT_EQ(time_of_impact(Bisection<double>{}, needle, plate).status, ToiStatus::hit);
}

TEST(BisectionInDouble,
     goes_by_no_tangent_that_rounding_may_turn) {  // at the end they are apart by little more than rounding
  using V = Vec3<double>;
  Obb<double> a{V(-0x1.10e1ed99c9aep-3, 0x1.7a2ab948e3f6ep-1, 0x1.9cad44761579p-1),
                V(0x1.920e3d9f5058ap-1, 0x1.0ddedad068f86p+0, 0x1.87044cdcc57d5p-2),
                {}};
  a.axes << 0x1.8e8d4f7927d9cp-2, 0x1.73fae93ba3df8p-1, 0x1.21f00cb56a68ep-1, -0x1.b155d8d4b0ab9p-3,
      -0x1.0e3cdc3cf0022p-1, 0x1.a52a0dec0938cp-1, 0x1.cb046c06d74b5p-1, -0x1.c289fe3896be3p-2, -0x1.a78ee386b976p-5;
  Obb<double> b{V(0x1.fb0b8e47c1e19p+0, -0x1.c04833662ba16p-2, -0x1.576dde720664ap-2),
                V(0x1.a1b35d7527ee8p-1, 0x1.233bc7d95601fp+0, 0x1.601faa9793e3ap-1),
                {}};
  b.axes << -0x1.fb184f46f806p-1, -0x1.a76f8e5fc5b06p-5, 0x1.063f0c976d963p-3, -0x1.0ec3992ff980dp-3,
      0x1.654ee56d54f18p-4, -0x1.f98954660592ep-1, 0x1.46956b60e248bp-5, -0x1.fd5c74bb9782dp-1, -0x1.7de04a2defbep-4;
  const Moving<Obb<double>> moving{b, V(-0x1.b2d3d6d4eded7p-5, 0x1.f0728f5b1dbd3p-1, 0x1.8b4cefb648cf5p-1)};
  EXPECT_TRUE(overlaps(a, pose_at(moving, 0.5)));
  for (const int e : {0, -60, 60}) {
    const Toi<double> toi = time_of_impact(Bisection<double>{}, at_rest(scaled(a, e)), scaled(moving, e));
    EXPECT_EQ(toi.status, ToiStatus::hit) << e;
    EXPECT_NEAR(toi.time, 0.2575, 1e-4) << e;
  }
}

// ---- Conservative advancement: never late, and bounded.

template <class S> using Advancement = MethodCases<S>;
TYPED_TEST_SUITE(Advancement, Scalars, ScalarNames);

TYPED_TEST(Advancement, one_step_takes_it_before_a_face) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(ConservativeAdvancement<S>{}, this->shot, this->wall);
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_TRUE(toi.time < S(0.3125));
  EXPECT_TRUE(toi.time >= S(0.3125) * (1 - 1024 * unit<S>()));  // sizes of 18 over a closing speed of 2, times 16 u
  EXPECT_EQ(toi.evaluations, 3);                                // the overlap at the start, there, and the proof
  EXPECT_EQ(toi.normal, Vec3<S>(1, 0, 0));
  EXPECT_TRUE(toi.point.isApprox(Vec3<S>(-0.125, 0, 0), 4096 * unit<S>()));
}

TYPED_TEST(Advancement, a_graze_takes_more_and_is_early_by_the_tolerance_over_the_cosine) {
  using S = TypeParam;
  const S exact = time_of_impact(this->graze, this->post).time;
  const S cosine = S(31) / S(125);  // sqrt(4 - 1.9375^2) / 2 = 0.248...
  for (const S& tolerance : {S(0.125), S(0.0625), power<S>(-8), half_digits<S>()}) {
    const Toi<S> toi = time_of_impact(ConservativeAdvancement<S>{.tolerance = tolerance}, this->graze, this->post);
    EXPECT_EQ(toi.status, ToiStatus::hit);
    EXPECT_TRUE(toi.time < exact);
    EXPECT_TRUE(toi.time > exact - tolerance / cosine - 64 * unit<S>());
  }
}

TYPED_TEST(Advancement, a_miss_is_proven_in_a_few_steps) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(ConservativeAdvancement<S>{}, this->passing, this->post);
  EXPECT_EQ(toi.status, ToiStatus::apart);
  EXPECT_LE(toi.evaluations, 8);
}

TYPED_TEST(Advancement, a_miss_nearer_than_the_tolerance_may_be_a_hit) {
  using S = TypeParam;
  const ConservativeAdvancement<S> coarse{.tolerance = power<S>(-6)};  // 1/8 of a length over this path
  EXPECT_EQ(time_of_impact(coarse, this->passing, this->post).status, ToiStatus::hit);
}

TYPED_TEST(Advancement, out_of_evaluations_gives_up_with_what_is_proven) {
  this->template expect_what_is_proven<ConservativeAdvancement<TypeParam>>(true);
}

TYPED_TEST(Advancement, leaving_is_apart_however_near) {
  using S = TypeParam;
  const Moving<Sphere<S>> leaving{Sphere<S>{{-next_up(S(0.375)), 0, 0}, 0.25}, {-1, 0, 0}};
  const Toi<S> toi = time_of_impact(ConservativeAdvancement<S>{}, leaving, this->wall);
  EXPECT_TRUE(toi.status == ToiStatus::apart || (toi.status == ToiStatus::hit && toi.time == S(0)));
  const Moving<Sphere<S>> clear{Sphere<S>{{-S(0.375) * (1 + 1024 * unit<S>()), 0, 0}, 0.25}, {-1, 0, 0}};
  EXPECT_EQ(time_of_impact(ConservativeAdvancement<S>{}, clear, this->wall).status, ToiStatus::apart);
}

TEST(AdvancementInFloat,
     rounds_its_time_down) {  // computed in double; to the nearest float would be late half the time
  int below = 0;
  for (int i = 0; i < 200; ++i) {
    const float x = -1 - static_cast<float>(i) / 256;
    const Moving<Sphere<float>> shot{{{x, 0, 0}, 0.25F}, {3, 0, 0}};
    const auto wall = at_rest(Aabb<float>{{0, 0, 0}, {0.125F, 8, 8}});
    const Toi<float> toi = time_of_impact(ConservativeAdvancement<float>{}, shot, wall);
    EXPECT_LE(3 * static_cast<double>(toi.time), -0.375 - static_cast<double>(x));
    below += static_cast<double>(toi.time) * 3 > (-0.375 - static_cast<double>(x)) * (1 - 2e-7) ? 1 : 0;
  }
  EXPECT_EQ(below, 200);
}

// ---- Inclusion: never late, early by at most the tolerance, and bounded.

template <class S> using InclusionMethod = MethodCases<S>;
TYPED_TEST_SUITE(InclusionMethod, Scalars, ScalarNames);

template <class S>
const Moving<Sphere<S>> passing_close{{{-4, 2 + power<S>(-10), 0}, 1}, {8, 0, 0}};  // beside the post

TYPED_TEST(InclusionMethod, is_early_by_at_most_the_tolerance) {
  using S = TypeParam;
  const S exact = time_of_impact(this->graze, this->post).time;
  for (const S& tolerance : {S(0.125), power<S>(-8), half_digits<S>(), S(4 * std::numeric_limits<S>::epsilon())}) {
    const Inclusion<S> method{.tolerance = tolerance};
    const Toi<S> straight = time_of_impact(method, this->shot, this->wall);
    EXPECT_EQ(straight.status, ToiStatus::hit);
    EXPECT_TRUE(straight.time < S(0.3125));
    EXPECT_TRUE(straight.time >= S(0.3125) - tolerance - 512 * unit<S>());
    EXPECT_EQ(straight.normal, Vec3<S>(1, 0, 0));
    const Toi<S> slanted = time_of_impact(method, this->graze, this->post);
    EXPECT_EQ(slanted.status, ToiStatus::hit);
    EXPECT_TRUE(slanted.time < exact);
    EXPECT_TRUE(slanted.time >= exact - tolerance - 512 * unit<S>());
  }
}

TYPED_TEST(InclusionMethod, a_miss_is_proven_in_a_few_looks_each_time_the_interval_halves) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(Inclusion<S>{}, passing_close<S>, this->post);
  EXPECT_EQ(toi.status, ToiStatus::apart);
  EXPECT_LE(toi.evaluations, 64);
}

TYPED_TEST(InclusionMethod, a_miss_nearer_than_the_tolerance_may_be_a_hit) {
  using S = TypeParam;
  auto later = passing_close<S>;  // nearest at no middle of an interval
  later.shape.center[0] -= S(1) / S(3);
  EXPECT_EQ(time_of_impact(Inclusion<S>{}, later, this->post).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(Inclusion<S>{.tolerance = power<S>(-4)}, later, this->post).status, ToiStatus::hit);
}

TYPED_TEST(InclusionMethod, out_of_evaluations_gives_up_with_what_is_proven) {
  this->template expect_what_is_proven<Inclusion<TypeParam>>(false);
}

}  // namespace
}  // namespace thinwall::testing
