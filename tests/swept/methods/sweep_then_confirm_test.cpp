// The tutorial's rule for two fast bodies: the false hits it removes and the true ones it misses.

#include <gtest/gtest.h>
#include <thinwall/swept/methods/sweep_then_confirm.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/judge.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

template <class S> class Confirm : public ::testing::Test {
 protected:
  using Ball = Moving<Sphere<S>>;
  const Ball east{{{-4, 0, 0}, 0.5}, {8, 0, 0}};  // through the origin at half the step
};
TYPED_TEST_SUITE(Confirm, Scalars, ScalarNames);

TYPED_TEST(Confirm, tracks_that_cross_at_different_times_are_no_hit) {
  using S = TypeParam;
  const typename TestFixture::Ball late{{{0, -16, 0}, 0.5}, {0, 20, 0}};
  const Toi<S> toi = time_of_impact(SweepThenConfirm<S>{}, this->east, late);
  EXPECT_EQ(toi.status, ToiStatus::apart);
  EXPECT_EQ(toi.evaluations, 3);  // the start, the ray into the track, and the true volumes, which are apart
  EXPECT_EQ(time_of_impact(this->east, late).status, ToiStatus::apart);
}

TYPED_TEST(Confirm, misses_two_bullets_that_do_meet) {  // the one is in the other's track before the other arrives
  using S = TypeParam;
  const typename TestFixture::Ball north{{{0, -3.5, 0}, 0.5}, {0, 9, 0}};
  EXPECT_EQ(time_of_impact(this->east, north).status, ToiStatus::hit);
  EXPECT_EQ(time_of_impact(SweepThenConfirm<S>{}, this->east, north).status, ToiStatus::apart);
}

TYPED_TEST(Confirm, sees_them_if_the_other_is_there_already) {
  using S = TypeParam;
  const typename TestFixture::Ball slow{{{0, -0.25, 0}, 0.5}, {0, 0.5, 0}};
  const Toi<S> toi = time_of_impact(SweepThenConfirm<S>{}, this->east, slow);
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_TRUE(toi.time >= time_of_impact(this->east, slow).time);
  EXPECT_TRUE(overlaps(pose_at(this->east, toi.time), pose_at(slow, toi.time)));
}

TYPED_TEST(Confirm, starting_in_the_track_looks_at_the_start_alone) {
  using S = TypeParam;
  const typename TestFixture::Ball chased{{{-2, 0, 0}, 0.5}, {1, 0, 0}}, oncoming{{{4, 0, 0}, 0.5}, {-8, 0, 0}};
  EXPECT_EQ(time_of_impact(this->east, oncoming).status, ToiStatus::hit);
  EXPECT_EQ(time_of_impact(SweepThenConfirm<S>{}, this->east, oncoming).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(SweepThenConfirm<S>{}, this->east, chased).status, ToiStatus::hit);
}

TYPED_TEST(Confirm, at_a_wall_at_rest_it_is_the_ray_from_the_center) {
  using S = TypeParam;
  const auto wall = at_rest(Aabb<S>{{0, 0, 0}, {0.125, 8, 8}});
  for (const S& height : {S(0), S(7.5), S(8.25)}) {
    const typename TestFixture::Ball shot{{{-1, height, 0}, 0.5}, {2, 0.25, 0}};
    const Toi<S> toi = time_of_impact(SweepThenConfirm<S>{}, shot, wall);
    const Toi<S> ray = time_of_impact(CentreRay<S>{}, shot, wall);
    EXPECT_EQ(text(toi.status), text(ray.status)) << height;
    EXPECT_EQ(toi.time, ray.time) << height;
  }
}

TYPED_TEST(Confirm, overlap_at_the_start_is_overlapping_whatever_the_tracks) {
  using S = TypeParam;
  const typename TestFixture::Ball there{{{-4.5, 0, 0}, 0.5}, {-3, 1, 0}}, touching{{{-5, 0, 0}, 0.5}, {8, 0, 0}};
  for (const auto& other : {there, touching}) {
    const Toi<S> toi = time_of_impact(SweepThenConfirm<S>{}, this->east, other);
    EXPECT_EQ(toi.status, ToiStatus::overlapping);
    EXPECT_EQ(toi.time, S(0));
    EXPECT_TRUE(is_unit(toi.normal));
  }
}

TYPED_TEST(Confirm, boxes_sweep_oriented_boxes) {
  using S = TypeParam;
  const Moving<Aabb<S>> shooter{{{-4, 0, 0}, {0.5, 0.5, 0.5}}, {8, 0, 0}};
  const Moving<Aabb<S>> drifting{{{0, -0.25, 0}, {0.5, 0.5, 0.5}}, {0.5, 0.5, 0}};
  const Toi<S> toi = time_of_impact(SweepThenConfirm<S>{}, shooter, drifting);
  EXPECT_EQ(toi.status, ToiStatus::hit);
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
    if (time_of_impact(a, b).status != ToiStatus::hit) continue;
    ++touching;
    seen += time_of_impact(SweepThenConfirm<double>{}, a, b).status == ToiStatus::hit ? 1 : 0;
  }
  EXPECT_GT(seen, 0.37 * touching);
  EXPECT_LT(seen, 0.41 * touching);
}

TYPED_TEST(Confirm, min_separation_confirms_a_gap) {
  using S = TypeParam;
  const typename TestFixture::Ball north{{{0, -3.5, 0}, 0.5}, {0, 9, 0}};
  EXPECT_EQ(time_of_impact(SweepThenConfirm<S>{.min_separation = 0.5}, this->east, north).status, ToiStatus::hit);
}

}  // namespace
}  // namespace thinwall::testing
