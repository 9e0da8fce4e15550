// What each method claims, by cases, and that the foils do fail as they are said to; planes between moving shapes.

#include <cmath>
#include <source_location>

#include <gtest/gtest.h>

#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/methods/separating_plane.hpp>
#include <thinwall/swept/methods/tolerance.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>
#include <thinwall/swept/turning/turning_bounds.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "support/judge.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

using enum ToiStatus;

/// A status and its time, to the bit.
template <class S>
void expect_answer(const Toi<S>& toi, ToiStatus status, const std::type_identity_t<S>& time,
                   std::source_location where = std::source_location::current()) {
  const ::testing::ScopedTrace caller(where.file_name(), static_cast<int>(where.line()), "asked here");
  EXPECT_EQ(text(toi.status), text(status));
  EXPECT_EQ(toi.time, time);
}
template <class S> void expect_miss(const Toi<S>& toi, std::source_location where = std::source_location::current()) {
  expect_answer(toi, apart, 1, where);
}

/// A hit that is sooner than `exact` by at most `early`, or later by at most `late`; of what is never late, sooner.
template <class S>
void expect_hit_near(const Toi<S>& toi, const std::type_identity_t<S>& exact, const std::type_identity_t<S>& early,
                     const std::type_identity_t<S>& late,
                     std::source_location where = std::source_location::current()) {
  const ::testing::ScopedTrace caller(where.file_name(), static_cast<int>(where.line()), "asked here");
  EXPECT_EQ(text(toi.status), text(hit));
  EXPECT_GE(toi.time, exact - early);
  EXPECT_TRUE(late > 0 ? toi.time <= exact + late : toi.time < exact) << toi.time << " after " << exact;
}

/// Shots that every method is shown.
template <class S> struct SweptMethods : ::testing::Test {
  const Sphere<S> bullet{{-1, 0, 0}, 0.25};
  const Moving<Sphere<S>> shot{bullet, {2, 0, 0}};
  const Moving<Aabb<S>> wall = at_rest(Aabb<S>{{0, 0, 0}, {0.125, 8, 8}});  // met by that at 0.3125, for long
  const Moving<Aabb<S>> thin_wall = at_rest(Aabb<S>{{0, 0, 0}, {power<S>(-10), 8, 8}});
  const Moving<Sphere<S>> post = at_rest(Sphere<S>{{0, 0, 0}, 1});
  const Moving<Sphere<S>> graze = past_the_post(1.9375), passing = past_the_post(2.0625);  // beside it by 1/16

  static Moving<Sphere<S>> past_the_post(const S& height) { return {{{-4, height, 0}, 1}, {8, 0, 0}}; }

  /// Straight at the wall; and grazing the post, where what is early is so over the cosine of incidence.
  template <class Method> void expect_times(const Method& method, const S& early, const S& late) const {
    const Toi<S> straight = time_of_impact(method, shot, wall);
    expect_hit_near(straight, 0.3125, early, late);
    EXPECT_EQ(straight.normal, Vec3<S>(1, 0, 0));
    const S cosine = S(31) / S(125);  // sqrt(4 - 1.9375^2) / 2 = 0.248...
    expect_hit_near(time_of_impact(method, graze, post), time_of_impact(graze, post).time, early / cosine, late);
  }

  /// The fewer evaluations a method may make, the less it has proven: it says how much, and never too much.
  template <class Method> void expect_what_is_proven(bool more_each_time) const {
    const S exact = time_of_impact(graze, post).time;
    const Toi<S> enough = time_of_impact(Method{}, graze, post);
    ASSERT_EQ(enough.status, hit);
    S before = 0;
    for (int n = 1; n < enough.evaluations - 1; ++n) {
      const Toi<S> toi = time_of_impact(Method{.max_evaluations = n}, graze, post);
      EXPECT_EQ(text(toi.status), text(gave_up));
      EXPECT_EQ(toi.evaluations, n + 1);
      EXPECT_TRUE((more_each_time ? toi.time > before : toi.time >= before) && toi.time < exact) << n;
      EXPECT_EQ(toi.normal, Vec3<S>(0, 0, 0));
      before = toi.time;
    }
    EXPECT_TRUE(before > exact / 2);
  }
};
TYPED_TEST_SUITE(SweptMethods, Scalars, ScalarNames);

TYPED_TEST(SweptMethods, end_of_step_tunnels) {
  using S = TypeParam;
  const Toi<S> missed = time_of_impact(EndOfStep<S>{}, this->shot, this->wall);
  expect_miss(missed);
  EXPECT_EQ(missed.evaluations, 1);
  const Toi<S> found = time_of_impact(ClosedForm<S>{}, this->shot, this->wall);
  expect_answer(found, hit, 0.3125);
  EXPECT_EQ(found.normal, Vec3<S>(1, 0, 0));
  EXPECT_EQ(found.point, Vec3<S>(-0.125, 0, 0));
  expect_answer(time_of_impact(EndOfStep<S>{}, Moving<Sphere<S>>{this->bullet, {1, 0, 0}}, this->wall), hit, 1);
}

TYPED_TEST(SweptMethods, substeps_tunnel_until_there_are_enough) {
  using S = TypeParam;
  const Moving<Sphere<S>> thin{Sphere<S>{{-1, 0, 0}, power<S>(-6)}, {2.5, 0, 0}};  // in the wall for t = 0.4 +- 0.0067
  for (const int n : {1, 2, 3, 4, 6, 8, 16}) {
    const Toi<S> missed = time_of_impact(Substeps<S>{.n = n}, thin, this->thin_wall);
    expect_miss(missed);
    EXPECT_EQ(missed.evaluations, n);
  }
  const Toi<S> fifth = time_of_impact(Substeps<S>{.n = 5}, thin, this->thin_wall);
  expect_answer(fifth, hit, S(2) / S(5));
  EXPECT_EQ(fifth.evaluations, 2);
  expect_answer(time_of_impact(Substeps<S>{.n = 256}, thin, this->thin_wall), hit, S(101) / S(256));  // k / n, late
}

TYPED_TEST(SweptMethods, centre_ray_is_late_by_the_radius_and_misses_a_graze_of_the_rim) {
  using S = TypeParam;
  expect_answer(time_of_impact(CentreRay<S>{}, this->shot, this->wall), hit, 0.3125 + 0.125);  // 0.25 of a path of 2
  const Moving<Sphere<S>> at_the_rim{Sphere<S>{{-1, 8.125, 0}, 0.25}, {2, 0, 0}};
  expect_miss(time_of_impact(CentreRay<S>{}, at_the_rim, this->wall));
  EXPECT_EQ(time_of_impact(ClosedForm<S>{}, at_the_rim, this->wall).status, hit);
  const Toi<S> swept = time_of_impact(SweptVolumeRay<S>{}, at_the_rim, this->wall);
  expect_answer(swept, hit, 0.5);  // of closest approach: the middle of the time spent beside the rim
  EXPECT_EQ(swept.normal, Vec3<S>(0, -1, 0));
}

TYPED_TEST(SweptMethods, centre_ray_shoots_from_the_one_that_travels_farther) {
  using S = TypeParam;
  const Moving<Aabb<S>> mover{Aabb<S>{{4, 0, 0}, {1, 1, 1}}, {-8, 0, 0}};
  const Toi<S> toi = time_of_impact(CentreRay<S>{}, at_rest(Sphere<S>{{0, 0.75, 0}, 1}), mover);
  EXPECT_EQ(toi.status, hit);  // the box's center against the ball
  EXPECT_TRUE(toi.normal[0] > S(0));
}

TYPED_TEST(SweptMethods, rays_do_not_turn_on_the_order_of_what_is_alike) {
  using S = TypeParam;
  const Moving<Sphere<S>> a{{{0.75, 1.25, 0}, 0.5}, {2, 0, 0}}, b{{{1.75, -0.25, 0}, 0.5}, {0, 2, 0}};
  const Moving<Aabb<S>> x{{{-5, 0, 0}, {0.125, 0.25, 0.375}}, {5, 0, 0}},
      y{{{5, 0.3125, 0}, {0.125, 0.375, 0.25}}, {-5, 0, 0}};
  const auto expect_alike = [](const auto& method, const auto& first, const auto& second) {
    const Toi<S> there = time_of_impact(method, first, second);
    expect_answer(time_of_impact(method, second, first), there.status, there.time);
  };
  for_each_type(TypeList<CentreRay<S>, SweptVolumeRay<S>, SweepThenConfirm<S>>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, Sphere<S>, Sphere<S>>) expect_alike(Method{}, a, b);
    if constexpr (serves<Method, Aabb<S>, Aabb<S>>) expect_alike(Method{}, x, y);
  });
}

TYPED_TEST(SweptMethods, swept_volume_ray_is_never_early_and_sees_the_relative_motion_only) {
  using S = TypeParam;
  const SweptVolumeRay<S> ray;
  const Moving<Sphere<S>> slanted{this->bullet, {2, 0.5, 0}}, faster{this->bullet, {66, 0, 0}};
  expect_answer(time_of_impact(ray, slanted, this->wall), hit, 0.4375);  // the center at the wall's face
  EXPECT_GE(S(0.4375), time_of_impact(slanted, this->wall).time);
  const Moving<Aabb<S>> fleeing{this->wall.shape, {2, 0, 0}}, drifting{this->wall.shape, {64, 0, 0}};
  expect_miss(time_of_impact(ray, this->shot, fleeing));
  expect_answer(time_of_impact(ray, faster, drifting), hit, 0.4375);
}

TYPED_TEST(SweptMethods, min_separation_is_a_gap_that_counts_as_contact) {
  using S = TypeParam;
  const Moving<Sphere<S>> beside = this->past_the_post(3), stopping{{{-4, 0, 0}, 1}, {1, 0, 0}};
  const S almost = next_down(S(4)) - S(3);  // the sum with both radii is exact
  const auto is_contact = [&](auto method, const Moving<Sphere<S>>& ball, const S& time) {
    method.min_separation = 1;
    expect_answer(time_of_impact(method, ball, this->post), hit, time);
    method.min_separation = almost;
    expect_miss(time_of_impact(method, ball, this->post));
  };
  is_contact(ClosedForm<S>{}, beside, 0.5);
  is_contact(SweptVolumeRay<S>{}, beside, 0.5);
  is_contact(Substeps<S>{.n = 2}, beside, 0.5);
  is_contact(EndOfStep<S>{}, stopping, 1);
  EXPECT_EQ(time_of_impact(CentreRay<S>{.min_separation = 2}, stopping, this->post).status, overlapping);
}

TYPED_TEST(SweptMethods, min_separation_before_a_wall) {  // 0.125 sooner along a path of 2: at 0.25
  using S = TypeParam;
  const S tolerance = half_digits<S>(), rounding = 256 * unit<S>();
  const auto expect_off_by = [this](auto method, const S& early, const S& late) {
    method.min_separation = S(0.125);
    const Toi<S> toi = time_of_impact(method, this->shot, this->wall);
    expect_hit_near(toi, 0.25, early, late);
    expect_answer(time_of_impact(method, this->wall, this->shot), hit, toi.time);
  };
  expect_answer(time_of_impact(ClosedForm<S>{.min_separation = S(0.125)}, this->shot, this->wall), hit, 0.25);
  expect_off_by(Bisection<S>{}, 0, tolerance);
  expect_off_by(Inclusion<S>{}, tolerance + 2 * rounding, 0);
  expect_off_by(ConservativeAdvancement<S>{}, rounding, 0);
  expect_off_by(Speculative<S>{}, rounding, 0);
}

// ---- Those with a tolerance: bisection is late by at most that, advancement and inclusion are early by at most that, and all are bounded.

TYPED_TEST(SweptMethods, are_off_by_at_most_the_tolerance) {
  using S = TypeParam;
  const S rounding = unit<S>(), finest = 4 * std::numeric_limits<S>::epsilon();
  for (const S& tolerance : {S(0.125), S(0.0625), power<S>(-8), half_digits<S>(), finest}) {
    this->expect_times(Bisection<S>{.tolerance = tolerance}, 4 * rounding, tolerance + 16 * rounding);
    EXPECT_GE(time_of_impact(Bisection<S>{.tolerance = tolerance}, this->shot, this->wall).time, S(0.3125));
    this->expect_times(Inclusion<S>{.tolerance = tolerance}, tolerance + 512 * rounding, 0);
    this->expect_times(ConservativeAdvancement<S>{.tolerance = tolerance}, tolerance + 512 * rounding, 0);
  }
}

TYPED_TEST(SweptMethods, prove_a_miss_in_a_few_looks) {
  using S = TypeParam;
  const Moving<Sphere<S>> close = this->past_the_post(2 + power<S>(-10));
  const auto expect_looks = [this](const auto& method, const Moving<Sphere<S>>& ball, int most) {
    const Toi<S> toi = time_of_impact(method, ball, this->post);
    expect_miss(toi);
    EXPECT_LE(toi.evaluations, most);
  };
  expect_looks(Bisection<S>{}, this->passing, 12);
  expect_looks(Bisection<S>{}, {{{-4, 0, 0}, 1}, {-8, 0, 0}}, 2);  // it leaves
  expect_looks(Bisection<S>{}, {{{-4, 0, 0}, 1}, {1, 0, 0}}, 3);   // it stops
  expect_looks(ConservativeAdvancement<S>{}, this->passing, 8);
  expect_looks(Inclusion<S>{}, close, 64);
}

TYPED_TEST(SweptMethods, may_call_a_miss_nearer_than_the_tolerance_a_hit) {
  using S = TypeParam;
  auto later = this->past_the_post(2 + power<S>(-10));  // nearest at no middle of an interval
  later.shape.center[0] -= S(1) / S(3);
  expect_miss(time_of_impact(Inclusion<S>{}, later, this->post));
  EXPECT_EQ(time_of_impact(Inclusion<S>{.tolerance = power<S>(-4)}, later, this->post).status, hit);
  const ConservativeAdvancement<S> coarse{.tolerance = power<S>(-6)};  // 1/8 of a length over this path
  EXPECT_EQ(time_of_impact(coarse, this->passing, this->post).status, hit);
}

TYPED_TEST(SweptMethods, out_of_evaluations_give_up_with_what_is_proven) {
  this->template expect_what_is_proven<ConservativeAdvancement<TypeParam>>(true);
  this->template expect_what_is_proven<Inclusion<TypeParam>>(false);
}

TYPED_TEST(SweptMethods, advancement_takes_one_step_before_a_face) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(ConservativeAdvancement<S>{}, this->shot, this->wall);
  expect_hit_near(toi, 0.3125, 320 * unit<S>(), 0);  // sizes of 18 over a closing speed of 2, times 16 u
  EXPECT_EQ(toi.evaluations, 3);                     // the overlap at the start, there, and the proof
  EXPECT_TRUE(toi.point.isApprox(Vec3<S>(-0.125, 0, 0), 4096 * unit<S>()));
}

TYPED_TEST(SweptMethods, advancement_of_what_leaves_is_apart_however_near) {
  using S = TypeParam;
  const auto leaves = [this](const S& from) {
    return time_of_impact(ConservativeAdvancement<S>{}, Moving<Sphere<S>>{{{-from, 0, 0}, 0.25}, {-1, 0, 0}},
                          this->wall);
  };
  const Toi<S> toi = leaves(next_up(S(0.375)));
  EXPECT_TRUE(toi.status == apart || (toi.status == hit && toi.time == S(0)));
  expect_miss(leaves(S(0.375) * (1 + 1024 * unit<S>())));
}

TYPED_TEST(SweptMethods, bisection_finds_a_contact_however_short) {  // no pose of a search by halves is in this wall
  using S = TypeParam;
  const Moving<Sphere<S>> fast{{{-1, 0, 0}, 0}, {3, 0, 0}};
  const S thin = power<S>(3 - std::numeric_limits<S>::digits);
  const auto plate = at_rest(Aabb<S>{{0, 0, 0}, {thin, 8, 8}});
  expect_hit_near(time_of_impact(Bisection<S>{}, fast, plate), S(1) / S(3), thin, thin);
}

// Next to each other by less than the roundings of where they are later.
TEST(MethodsOfPoses, leave_apart_what_flies_side_by_side) {
  const Vec3<double> path(0, 0.25, -1.0000000000000002);
  const Moving<Sphere<double>> ball{{{-0.5, -0.49999999999999994, 1.7500000000000002}, 0.75}, path};
  const Moving<Aabb<double>> box{
      {{0.7499999999999999, -0.9999999999999999, -0.7500000000000001}, {1.4999999999999998, 0.75, 1.75}}, path};
  EXPECT_FALSE(overlaps(ball.shape, box.shape));
  EXPECT_EQ(text(time_of_impact(SweepThenConfirm<double>{}, ball, box).status), text(apart));
  const Vec3<double> fast(0, 211106232532992, 1.9073486328125e-6);
  const Moving<Sphere<double>> speck{{{0, 2.535301200456459e30, -4194304}, 2.0194839173657902e-28}, fast};
  const Moving<Triangle<double>> vast{{{549755813888, 10, -1.2912720851596686e20},
                                       {-1.1175870895385742e-8, 256, -1.3292279957849159e37},
                                       {-1.1920928955078125e-6, 2.535301200456459e30, 6.352747104407253e-22}},
                                      fast};
  EXPECT_EQ(text(time_of_impact(SweptVolumeRay<double>{}, speck, vast).status), text(apart));
}

TEST(BisectionOfShapes, has_no_tolerance_below_what_their_times_resolve) {  // it would halve for ever
  const Moving<Sphere<double>> shot{{{-4, 0, 0}, 1}, {8, 0, 0}};
  const auto ball = at_rest(Sphere<double>{{0, 0.25, 0}, 1});
  const long double finest = std::numeric_limits<long double>::epsilon();
  EXPECT_EQ(time_of_impact(Bisection<long double>{.tolerance = finest}, shot, ball).status, invalid);
  EXPECT_EQ(time_of_impact(Bisection<long double>{.tolerance = 0x1p-52L}, shot, ball).status, hit);
}

TYPED_TEST(SweptMethods,
           bisection_has_two_searches_that_are_bounded) {  // a touch that no pose shows and no tangent excludes
  using S = TypeParam;
  const int most = 3 + 2 * std::numeric_limits<S>::digits + std::numeric_limits<S>::digits;
  int longest = 0;
  for (int i = 0; i < 64; ++i) {
    Moving<Sphere<S>> touching = this->past_the_post(S(2) * (1 + S(i - 32) * 4 * unit<S>()));
    touching.displacement[0] += S(i) / S(64);
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
    ASSERT_EQ(exact.status, hit);
    EXPECT_EQ(toi.status, hit) << longer;
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
  EXPECT_EQ(time_of_impact(Bisection<double>{}, needle, plate).status, hit);
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
    EXPECT_EQ(toi.status, hit) << e;
    EXPECT_NEAR(toi.time, 0.2575, 1e-4) << e;
  }
}

TEST(InclusionInFloat, tells_the_side_it_comes_from) {  // its last interval is longer than ball and wall are thick
  const auto wall = at_rest(Aabb<float>{{0, 0, 0}, {0.00005F, 8, 8}});
  for (int i = 0; i < 200; ++i) {
    const Moving<Sphere<float>> shot{{{-1 - static_cast<float>(i) / 16, 0, 0}, 0.001F}, {33, 1, 0}};
    const Toi<float> toi = time_of_impact(Inclusion<float>{}, shot, wall);
    ASSERT_EQ(toi.status, hit) << i;
    ASSERT_EQ(toi.normal, Vec3<float>::UnitX()) << i;
  }
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

// ---- A plane: what it proves, and that rounding only ever weakens the proof.

template <class S> using Plane = SweptMethods<S>;
TYPED_TEST_SUITE(Plane, Scalars, ScalarNames);

TYPED_TEST(Plane, is_open_until_just_before_contact) {
  using S = TypeParam;
  const SeparatingPlane<S> plane = separating_plane<Sphere<S>, Aabb<S>>(this->shot, this->wall, {1, 0, 0}, S(0));
  EXPECT_TRUE(plane.gap < S(0.625) && plane.gap > S(0.625) - 512 * unit<S>());
  EXPECT_TRUE(plane.closing > S(2) && plane.closing < S(2) + 64 * unit<S>());
  EXPECT_TRUE(plane.free_until() < S(0.3125) && plane.free_until() > S(0.3125) - 512 * unit<S>());
  EXPECT_TRUE(plane.free_at(S(0)) && plane.free_at(plane.free_until() * (1 - 8 * unit<S>())));
  EXPECT_FALSE(plane.free_at(S(0.3125)));
  EXPECT_FALSE(plane.free_from(S(0)));
}

TYPED_TEST(Plane, across_any_other_direction_proves_less) {
  using S = TypeParam;
  for (const S& tilt : {S(0.03125), S(0.0625), S(1), S(-1)}) {
    const Vec3<S> n = safe_unit(Vec3<S>(1, tilt, 0));
    EXPECT_TRUE(separating_plane(this->shot, this->wall, n, S(0)).free_until() < S(0.3125)) << tilt;
  }
  EXPECT_EQ((separating_plane<Sphere<S>, Aabb<S>>(this->shot, this->wall, {0, 1, 0}, S(0)).free_until()), S(0));
  EXPECT_EQ((separating_plane<Sphere<S>, Aabb<S>>(this->shot, this->wall, {-1, 0, 0}, S(0)).free_until()), S(0));
}

TYPED_TEST(Plane, stays_open_behind_what_leaves) {
  using S = TypeParam;
  const Moving<Sphere<S>> leaving{{{-1, 0, 0}, 0.25}, {-2, 0, 0}}, through{{{-0.25, 0, 0}, 0.25}, {-2, 0, 0}};
  const auto open = separating_plane<Sphere<S>, Aabb<S>>(leaving, this->wall, {1, 0, 0}, S(0));
  EXPECT_TRUE(open.free_from(S(0)) && open.free_until() > S(1));
  const auto opening = separating_plane<Sphere<S>, Aabb<S>>(through, this->wall, {1, 0, 0}, S(0));
  EXPECT_EQ(opening.free_until(), S(0));  // in contact at the start
  EXPECT_FALSE(opening.free_from(S(0.0625)));
  EXPECT_TRUE(opening.free_from(S(0.0625) + 512 * unit<S>()));
}

TYPED_TEST(Plane, knows_how_far_every_shape_reaches) {
  using S = TypeParam;
  const Vec3<S> x(1, 0, 0), n = safe_unit(Vec3<S>(1, 1, 0));
  const S root = n[0];  // of one half
  const Mat3<S> turned = turn_in_plane(0, 1, root, root);
  const auto near = [](const S& found, const S& wanted) { return largest(S(found - wanted)) <= 16 * unit<S>(); };
  EXPECT_EQ(reach_along(Sphere<S>{{5, 0, 0}, 2}, n), S(2));
  EXPECT_TRUE(near(reach_along(Aabb<S>{{5, 0, 0}, {2, 1, 4}}, n), 3 * root));
  EXPECT_TRUE(near(reach_along(Obb<S>{{5, 0, 0}, {2, 1, 4}, turned}, n), S(2)));
  EXPECT_TRUE(near(reach_along(Obb<S>{{5, 0, 0}, {2, 1, 4}, turned}, x), 3 * root));
  EXPECT_TRUE(near(reach_along(Triangle<S>{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, x), S(2)));  // the centroid is at 1
  EXPECT_TRUE(near(reach_along<S>(Triangle<S>{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, -x), S(1)));
  EXPECT_TRUE(near(reach_along(Capsule<S>{{-1, 0, 0}, {3, 2, 0}, 0.5}, x), S(2.5)));
  EXPECT_TRUE(near(reach_along<S>(Capsule<S>{{-1, 0, 0}, {3, 2, 0}, 0.5}, -x), S(2.5)));
}

TEST(RoundedDown, is_the_largest_float_that_is_not_later) {
  const double above = 0.5 + 1e-9, below = 0.5 - 1e-9;  // nearer to 0.5 than to its neighbors
  EXPECT_EQ(rounded_down_to<float>(above), 0.5);
  EXPECT_EQ(rounded_down_to<float>(below), 0.5 - power<double>(-25));
  EXPECT_EQ(rounded_down_to<float>(0.5), 0.5);
  EXPECT_EQ(rounded_down_to<float>(0.0), 0.0);
  EXPECT_EQ(rounded_down_to<double>(above), above);
  EXPECT_EQ(rounded_down_to<float>(1e-60), 0.0);  // the smallest float is later
}

// ---- Speculative contacts: what a margin sees, and its false hits.

TYPED_TEST(SweptMethods, speculative_takes_the_other_for_the_plane_before_it) {  // and hits what would pass beside
  using S = TypeParam;
  const Toi<S> at_the_wall = time_of_impact(Speculative<S>{}, this->shot, this->wall);
  expect_hit_near(at_the_wall, 0.3125, 320 * unit<S>(), 0);
  EXPECT_EQ(at_the_wall.evaluations, 2);
  EXPECT_EQ(at_the_wall.normal, Vec3<S>(1, 0, 0));
  const auto before_the_rim = [](const Vec3<S>& path) { return Moving<Sphere<S>>{{{-2, 8.25, 0}, 0.25}, path}; };
  expect_miss(time_of_impact(before_the_rim({8, 2, 0}), this->wall));
  EXPECT_EQ(time_of_impact(Speculative<S>{}, before_the_rim({8, 2, 0}), this->wall).status, hit);
  expect_miss(time_of_impact(Speculative<S>{}, before_the_rim({1, 0.25, 0}), this->wall));
  expect_miss(time_of_impact(Speculative<S>{}, Moving<Sphere<S>>{{{-2, 0, 0}, 0.25}, {-8, 1, 0}}, this->wall));
}

TYPED_TEST(SweptMethods, speculative_misses_what_is_farther_off_than_its_margin) {  // a gap of 0.625, a path of 2
  using S = TypeParam;
  for (const S& margin : {S(0), S(0.25), S(0.3125), S(0.5), S(1), S(64)}) {
    const Toi<S> toi = time_of_impact(Speculative<S>{.margin = margin}, this->shot, this->wall);
    EXPECT_EQ(text(toi.status), text(margin > S(0.3) ? hit : apart)) << margin;
  }
  const auto touching = at_rest(Sphere<S>{{-0.375, 0, 0}, 0.25});
  EXPECT_EQ(time_of_impact(Speculative<S>{.margin = 0}, touching, this->wall).status, overlapping);
  const Moving<Sphere<S>> short_step{this->bullet, {0.5, 0, 0}};  // the margin counts from the minimal separation
  expect_miss(time_of_impact(Speculative<S>{}, short_step, this->wall));
  EXPECT_EQ(time_of_impact(Speculative<S>{.min_separation = 0.25}, short_step, this->wall).status, hit);
}

// ---- The tutorial's rule for two fast bodies: the false hits it removes and the true ones it misses.

template <class S> class Confirm : public ::testing::Test {
 protected:
  using Ball = Moving<Sphere<S>>;
  const Ball east{{{-4, 0, 0}, 0.5}, {8, 0, 0}};  // through the origin at half the step
};
TYPED_TEST_SUITE(Confirm, Scalars, ScalarNames);

TYPED_TEST(Confirm, misses_two_bullets_that_meet_but_not_in_each_others_track) {
  using S = TypeParam;
  const auto sees = [this](const Vec3<S>& from, const Vec3<S>& path, bool truly, bool confirmed) {
    const typename TestFixture::Ball other{{from, 0.5}, path};
    EXPECT_EQ(time_of_impact(this->east, other).status, truly ? hit : apart) << from.transpose();
    const Toi<S> toi = time_of_impact(SweepThenConfirm<S>{}, this->east, other);
    EXPECT_EQ(toi.status, confirmed ? hit : apart) << from.transpose();
    if (confirmed) {
      EXPECT_TRUE(toi.time >= time_of_impact(this->east, other).time);
      EXPECT_TRUE(overlaps(pose_at(this->east, toi.time), pose_at(other, toi.time)));
    }
    return toi.evaluations;
  };
  // The start, the ray into the track, and the true volumes, which are apart: the tracks cross at different times.
  EXPECT_EQ(sees({0, -16, 0}, {0, 20, 0}, false, false), 3);
  sees({0, -3.5, 0}, {0, 9, 0}, true, false);    // the one is in the other's track before the other arrives
  sees({0, -0.25, 0}, {0, 0.5, 0}, true, true);  // the other is there already
  sees({4, 0, 0}, {-8, 0, 0}, true, false);      // who starts in the track looks at the start alone
  sees({-2, 0, 0}, {1, 0, 0}, true, true);
}

TYPED_TEST(Confirm, at_a_wall_at_rest_it_is_the_ray_from_the_center) {
  using S = TypeParam;
  const auto wall = at_rest(Aabb<S>{{0, 0, 0}, {0.125, 8, 8}});
  for (const S& height : {S(0), S(7.5), S(8.25)}) {
    const typename TestFixture::Ball shot{{{-1, height, 0}, 0.5}, {2, 0.25, 0}};
    const Toi<S> ray = time_of_impact(CentreRay<S>{}, shot, wall);
    expect_answer(time_of_impact(SweepThenConfirm<S>{}, shot, wall), ray.status, ray.time);
  }
}

TYPED_TEST(Confirm, overlap_at_the_start_is_overlapping_whatever_the_tracks) {
  using S = TypeParam;
  const typename TestFixture::Ball there{{{-4.5, 0, 0}, 0.5}, {-3, 1, 0}}, touching{{{-5, 0, 0}, 0.5}, {8, 0, 0}};
  for (const auto& other : {there, touching}) {
    const Toi<S> toi = time_of_impact(SweepThenConfirm<S>{}, this->east, other);
    expect_answer(toi, overlapping, 0);
    EXPECT_TRUE(is_unit(toi.normal));
  }
}

TYPED_TEST(Confirm, boxes_sweep_oriented_boxes) {
  using S = TypeParam;
  const Moving<Aabb<S>> shooter{{{-4, 0, 0}, {0.5, 0.5, 0.5}}, {8, 0, 0}};
  const Moving<Aabb<S>> drifting{{{0, -0.25, 0}, {0.5, 0.5, 0.5}}, {0.5, 0.5, 0}};
  const Toi<S> toi = time_of_impact(SweepThenConfirm<S>{}, shooter, drifting);
  EXPECT_EQ(toi.status, hit);
  EXPECT_TRUE(overlaps(pose_at(shooter, toi.time), pose_at(drifting, toi.time)));
  const Toi<S> back = time_of_impact(SweepThenConfirm<S>{}, drifting, shooter);
  EXPECT_EQ(back.time, toi.time);
  EXPECT_EQ(back.normal, Vec3<S>(-toi.normal));
}

TYPED_TEST(Confirm, serves_what_sweeps_a_shape) {
  using S = TypeParam;
  using Method = SweepThenConfirm<S>;
  static_assert(serves<Method, Sphere<S>, Sphere<S>> && serves<Method, Sphere<S>, Aabb<S>>);
  static_assert(serves<Method, Aabb<S>, Aabb<S>> && !serves<Method, Obb<S>, Sphere<S>>);
  static_assert(!serves<Method, Capsule<S>, Sphere<S>> && !serves<Method, Triangle<S>, Sphere<S>>);
}

/// Balls at equal speeds whose paths cross at a right angle, uniform over all that touch: the numbers of docs/methods.md.
TEST(ConfirmedShare, is_two_in_five_at_a_right_angle) {
  Shaker<double> draw(1);
  const Vec3<double> east(50, 0, 0), north(0, 50, 0), across = safe_unit<double>(east + north), up(0, 0, 1);
  int touching = 0, seen = 0;
  while (touching < 5000) {
    const double x = draw.plain(), z = draw.plain(), time = (draw.plain() + 1) / 2;
    const Vec3<double> nearest = across * x + up * z;  // from the one to the other; they are half as wide
    const Moving<Sphere<double>> a{{nearest - east * time, 0.5}, east}, b{{-north * time, 0.5}, north};
    if (time_of_impact(a, b).status != hit) continue;
    ++touching;
    seen += time_of_impact(SweepThenConfirm<double>{}, a, b).status == hit ? 1 : 0;
  }
  EXPECT_GT(seen, 0.37 * touching);
  EXPECT_LT(seen, 0.41 * touching);
}

TYPED_TEST(Confirm, min_separation_confirms_a_gap) {
  using S = TypeParam;
  const typename TestFixture::Ball north{{{0, -3.5, 0}, 0.5}, {0, 9, 0}};
  EXPECT_EQ(time_of_impact(SweepThenConfirm<S>{.min_separation = 0.5}, this->east, north).status, hit);
}

// ---- What turns: a rod that swings into a ball, by every method.

using std::asin, std::cos, std::sin;

/// From the x axis a rod swings by one radian about its middle, and meets a ball's center line at half a radian.
template <class S> class SwungRod : public ::testing::Test {
 protected:
  const Turning<Capsule<S>> rod{{{-2, 0, 0}, {2, 0, 0}, S(0.125)}, {0, 0, 0}, {0, 0, 1}};
  const Moving<Sphere<S>> ball = at_rest(Sphere<S>{{S(cos(S(0.5))), S(sin(S(0.5))), 0}, S(0.125)});
  const S time = S(0.5) - S(asin(S(0.25)));  ///< the ball's center is one away from the rod's
};
TYPED_TEST_SUITE(SwungRod, Scalars, ScalarNames);

TYPED_TEST(SwungRod, meets_the_ball_by_every_method) {
  using S = TypeParam;
  for_each_type(TurningMethods<S>{}, [&]<class Method>(TypeTag<Method>) {
    const Toi<S> toi = time_of_impact(Method{}, this->rod, this->ball);
    const bool is_discrete = std::is_same_v<Method, EndOfStep<S>> || std::is_same_v<Method, LinearSweep<S>>;
    EXPECT_EQ(toi.status, is_discrete ? apart : hit) << Method::name;
  });
  expect_hit_near(time_of_impact(this->rod, this->ball), this->time + unit<S>(), 4 * half_digits<S>(), 0);
}

TYPED_TEST(SwungRod, is_bounded) {
  using S = TypeParam;
  const Aabb<S> bounds = swept_bounds(this->rod);
  EXPECT_TRUE(overlaps(bounds, Sphere<S>{{S(2 * cos(S(1))), S(2 * sin(S(1))), 0}, 0}));
  EXPECT_LE(bounds.half_extents[0], S(2.2));
  EXPECT_LE(bounds.half_extents[2], S(0.126));
}

}  // namespace
}  // namespace thinwall::testing
