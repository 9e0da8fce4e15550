// Planes between moving shapes, and by cases the methods that look no farther than one plane or two tracks.

#include <gtest/gtest.h>

#include <thinwall/swept/methods/separating_plane.hpp>
#include <thinwall/swept/methods/speculative.hpp>
#include <thinwall/swept/methods/sweep_then_confirm.hpp>
#include <thinwall/swept/methods/tolerance.hpp>

#include "support/method_cases.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

// ---- A plane: what it proves, and that rounding only ever weakens the proof.

template <class S> using Plane = MethodCases<S>;
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
  Mat3<S> turned = Mat3<S>::Identity();
  turned.col(0) = n;
  turned.col(1) = Vec3<S>(-root, root, 0);
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

template <class S> using SpeculativeMethod = MethodCases<S>;
TYPED_TEST_SUITE(SpeculativeMethod, Scalars, ScalarNames);

TYPED_TEST(SpeculativeMethod, is_right_before_a_wall) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(Speculative<S>{}, this->shot, this->wall);
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_TRUE(toi.time < S(0.3125) && toi.time > S(0.3125) * (1 - 1024 * unit<S>()));
  EXPECT_EQ(toi.evaluations, 2);
  EXPECT_EQ(toi.normal, Vec3<S>(1, 0, 0));
}

TYPED_TEST(SpeculativeMethod, takes_the_other_for_the_plane_before_it) {  // and hits what would pass beside
  using S = TypeParam;
  const Moving<Sphere<S>> past_the_rim{{{-2, 8.25, 0}, 0.25}, {8, 2, 0}};
  EXPECT_EQ(time_of_impact(past_the_rim, this->wall).status, ToiStatus::apart);
  const Toi<S> toi = time_of_impact(Speculative<S>{}, past_the_rim, this->wall);
  EXPECT_EQ(toi.status, ToiStatus::hit);
  const Moving<Sphere<S>> stopping{{{-2, 8.25, 0}, 0.25}, {1, 0.25, 0}}, leaving{{{-2, 0, 0}, 0.25}, {-8, 1, 0}};
  EXPECT_EQ(time_of_impact(Speculative<S>{}, stopping, this->wall).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(Speculative<S>{}, leaving, this->wall).status, ToiStatus::apart);
}

TYPED_TEST(SpeculativeMethod, a_smaller_margin_misses_what_is_farther_off) {
  using S = TypeParam;  // a gap of 0.625, a path of 2
  for (const S& margin : {S(0.3125), S(0.5), S(1), S(64)})
    EXPECT_EQ(time_of_impact(Speculative<S>{.margin = margin}, this->shot, this->wall).status, ToiStatus::hit);
  for (const S& margin : {S(0.25), S(0)})
    EXPECT_EQ(time_of_impact(Speculative<S>{.margin = margin}, this->shot, this->wall).status, ToiStatus::apart);
  const auto touching = at_rest(Sphere<S>{{-0.375, 0, 0}, 0.25});
  EXPECT_EQ(time_of_impact(Speculative<S>{.margin = 0}, touching, this->wall).status, ToiStatus::overlapping);
}

TYPED_TEST(SpeculativeMethod,
           the_margin_counts_from_the_minimal_separation) {  // which is all that keeps it from a miss
  using S = TypeParam;
  const Moving<Sphere<S>> short_step{{{-1, 0, 0}, 0.25}, {0.5, 0, 0}};  // a gap of 0.625
  EXPECT_EQ(time_of_impact(Speculative<S>{}, short_step, this->wall).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(Speculative<S>{.min_separation = 0.25}, short_step, this->wall).status, ToiStatus::hit);
}

// ---- The tutorial's rule for two fast bodies: the false hits it removes and the true ones it misses.

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
