// What each method claims, and that the foils do fail as they are said to.

#include <gtest/gtest.h>
#include <thinwall/swept/methods.hpp>

#include "support/method_cases.hpp"

namespace thinwall::testing {
namespace {

template <class S> struct SweptMethods : MethodCases<S> {
  const Moving<Aabb<S>> thin_wall = at_rest(Aabb<S>{{0, 0, 0}, {power<S>(-10), 8, 8}});
  const Sphere<S> bullet = this->shot.shape;
};
TYPED_TEST_SUITE(SweptMethods, Scalars, ScalarNames);

TYPED_TEST(SweptMethods, end_of_step_tunnels) {
  using S = TypeParam;
  const Toi<S> missed = time_of_impact(EndOfStep<S>{}, this->shot, this->wall);
  EXPECT_EQ(missed.status, ToiStatus::apart);
  EXPECT_EQ(missed.time, S(1));
  EXPECT_EQ(missed.evaluations, 1);
  const Toi<S> found = time_of_impact(ClosedForm<S>{}, this->shot, this->wall);
  EXPECT_EQ(found.status, ToiStatus::hit);
  EXPECT_EQ(found.time, S(0.3125));
  EXPECT_EQ(found.normal, Vec3<S>(1, 0, 0));
  EXPECT_EQ(found.point, Vec3<S>(-0.125, 0, 0));
}

TYPED_TEST(SweptMethods, end_of_step_finds_what_still_overlaps_at_the_end) {
  using S = TypeParam;
  const Toi<S> found = time_of_impact(EndOfStep<S>{}, Moving<Sphere<S>>{this->bullet, {1, 0, 0}}, this->wall);
  EXPECT_EQ(found.status, ToiStatus::hit);
  EXPECT_EQ(found.time, S(1));
}

TYPED_TEST(SweptMethods, substeps_tunnel_until_there_are_enough) {
  using S = TypeParam;
  const Moving<Sphere<S>> thin{Sphere<S>{{-1, 0, 0}, power<S>(-6)}, {2.5, 0, 0}};  // in the wall for t = 0.4 +- 0.0067
  for (const int n : {1, 2, 3, 4, 6, 8, 16}) {
    const Toi<S> missed = time_of_impact(Substeps<S>{.n = n}, thin, this->thin_wall);
    EXPECT_EQ(missed.status, ToiStatus::apart) << n;
    EXPECT_EQ(missed.evaluations, n);
  }
  const Toi<S> fifth = time_of_impact(Substeps<S>{.n = 5}, thin, this->thin_wall);
  EXPECT_EQ(fifth.status, ToiStatus::hit);
  EXPECT_EQ(fifth.time, S(2) / S(5));
  EXPECT_EQ(fifth.evaluations, 2);
  EXPECT_EQ(time_of_impact(Substeps<S>{.n = 256}, thin, this->thin_wall).time, S(101) / S(256));  // k / n, late
}

TYPED_TEST(SweptMethods, centre_ray_is_late_by_the_radius) {
  using S = TypeParam;
  const Toi<S> late = time_of_impact(CentreRay<S>{}, this->shot, this->wall);
  EXPECT_EQ(late.status, ToiStatus::hit);
  EXPECT_EQ(late.time - time_of_impact(this->shot, this->wall).time, S(0.125));  // a radius of 0.25 over a path of 2
}

TYPED_TEST(SweptMethods, centre_ray_misses_a_graze_of_the_rim) {
  using S = TypeParam;
  const Moving<Sphere<S>> at_the_rim{Sphere<S>{{-1, 8.125, 0}, 0.25}, {2, 0, 0}};
  EXPECT_EQ(time_of_impact(CentreRay<S>{}, at_the_rim, this->wall).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(ClosedForm<S>{}, at_the_rim, this->wall).status, ToiStatus::hit);
  const Toi<S> swept = time_of_impact(SweptVolumeRay<S>{}, at_the_rim, this->wall);
  EXPECT_EQ(swept.status, ToiStatus::hit);
  EXPECT_EQ(swept.time, S(0.5));  // of closest approach: the middle of the time spent beside the rim
  EXPECT_EQ(swept.normal, Vec3<S>(0, -1, 0));
}

TYPED_TEST(SweptMethods, centre_ray_shoots_from_the_one_that_travels_farther) {
  using S = TypeParam;
  const Moving<Aabb<S>> mover{Aabb<S>{{4, 0, 0}, {1, 1, 1}}, {-8, 0, 0}};
  const Toi<S> toi = time_of_impact(CentreRay<S>{}, at_rest(Sphere<S>{{0, 0.75, 0}, 1}), mover);
  EXPECT_EQ(toi.status, ToiStatus::hit);  // the box's center against the ball
  EXPECT_TRUE(toi.normal[0] > S(0));
}

TYPED_TEST(SweptMethods, rays_do_not_turn_on_the_order_of_what_is_alike) {
  using S = TypeParam;
  const Moving<Sphere<S>> a{{{0.75, 1.25, 0}, 0.5}, {2, 0, 0}}, b{{{1.75, -0.25, 0}, 0.5}, {0, 2, 0}};
  const Moving<Aabb<S>> x{{{-5, 0, 0}, {0.125, 0.25, 0.375}}, {5, 0, 0}},
      y{{{5, 0.3125, 0}, {0.125, 0.375, 0.25}}, {-5, 0, 0}};
  const auto expect_alike = [](const auto& method, const auto& first, const auto& second) {
    const Toi<S> there = time_of_impact(method, first, second), back = time_of_impact(method, second, first);
    EXPECT_EQ(there.status, back.status);
    EXPECT_EQ(there.time, back.time);
  };
  for_each_type(TypeList<CentreRay<S>, SweptVolumeRay<S>, SweepThenConfirm<S>>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, Sphere<S>, Sphere<S>>) expect_alike(Method{}, a, b);
    if constexpr (serves<Method, Aabb<S>, Aabb<S>>) expect_alike(Method{}, x, y);
  });
}

TYPED_TEST(SweptMethods, swept_volume_ray_is_never_early) {
  using S = TypeParam;
  const Moving<Sphere<S>> slanted{this->bullet, {2, 0.5, 0}};
  const Toi<S> swept = time_of_impact(SweptVolumeRay<S>{}, slanted, this->wall);
  EXPECT_EQ(swept.status, ToiStatus::hit);
  EXPECT_EQ(swept.time, S(0.4375));  // the center at the wall's face
  EXPECT_TRUE(swept.time >= time_of_impact(slanted, this->wall).time);
}

TYPED_TEST(SweptMethods, swept_volume_ray_sees_the_relative_motion_only) {
  using S = TypeParam;
  const Moving<Sphere<S>> same{this->bullet, {2, 0, 0}}, faster{this->bullet, {66, 0, 0}};
  const Moving<Aabb<S>> fleeing{this->wall.shape, {2, 0, 0}};
  EXPECT_EQ(time_of_impact(SweptVolumeRay<S>{}, same, fleeing).status, ToiStatus::apart);
  const Moving<Aabb<S>> drifting{this->wall.shape, {64, 0, 0}};
  EXPECT_EQ(time_of_impact(SweptVolumeRay<S>{}, faster, drifting).time, S(0.4375));
}

TYPED_TEST(SweptMethods, min_separation_is_a_gap_that_counts_as_contact) {
  using S = TypeParam;
  const Moving<Sphere<S>> target = at_rest(Sphere<S>{{0, 0, 0}, 1});
  const Moving<Sphere<S>> beside{Sphere<S>{{-4, 3, 0}, 1}, {8, 0, 0}};
  const S almost = next_down(S(4)) - S(3);  // the sum with both radii is exact
  EXPECT_EQ(time_of_impact(ClosedForm<S>{.min_separation = 1}, beside, target).time, S(0.5));
  EXPECT_EQ(time_of_impact(ClosedForm<S>{.min_separation = almost}, beside, target).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(SweptVolumeRay<S>{.min_separation = 1}, beside, target).status, ToiStatus::hit);
  EXPECT_EQ(time_of_impact(SweptVolumeRay<S>{.min_separation = almost}, beside, target).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(Substeps<S>{.n = 2, .min_separation = 1}, beside, target).time, S(0.5));
  EXPECT_EQ(time_of_impact(Substeps<S>{.n = 2, .min_separation = almost}, beside, target).status, ToiStatus::apart);
  const Moving<Sphere<S>> stopping{Sphere<S>{{-4, 0, 0}, 1}, {1, 0, 0}};
  EXPECT_EQ(time_of_impact(EndOfStep<S>{.min_separation = 1}, stopping, target).status, ToiStatus::hit);
  EXPECT_EQ(time_of_impact(EndOfStep<S>{.min_separation = almost}, stopping, target).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(CentreRay<S>{.min_separation = 2}, stopping, target).status, ToiStatus::overlapping);
}

TYPED_TEST(SweptMethods, min_separation_before_a_wall) {  // 0.125 sooner along a path of 2: at 0.25
  using S = TypeParam;
  const auto late_by = [this](auto method) {
    method.min_separation = S(0.125);
    const S time = time_of_impact(method, this->shot, this->wall).time;
    EXPECT_EQ(time_of_impact(method, this->wall, this->shot).time, time);
    return S(time - S(0.25));
  };
  const S tolerance = half_digits<S>(), rounding = 256 * unit<S>();
  EXPECT_EQ(late_by(ClosedForm<S>{}), S(0));
  const S bisection = late_by(Bisection<S>{}), inclusion = late_by(Inclusion<S>{});
  EXPECT_TRUE(bisection >= S(0) && bisection <= tolerance) << bisection;
  EXPECT_TRUE(inclusion < S(0) && inclusion >= -tolerance - 2 * rounding) << inclusion;
  for (const S& plane : {late_by(ConservativeAdvancement<S>{}), late_by(Speculative<S>{})}) {
    EXPECT_TRUE(plane < S(0) && plane >= -rounding) << plane;
  }
}

}  // namespace
}  // namespace thinwall::testing
