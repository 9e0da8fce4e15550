// A box and a ball at one instant, by hand.

#include <gtest/gtest.h>
#include <thinwall/discrete/aabb.hpp>

#include "support/scalars.hpp"

namespace thinwall::testing {
namespace {

template <class S> class AabbSphere : public ::testing::Test {
 protected:
  const Aabb<S> box{{0, 0, 0}, {1, 2, 3}};

  /// The contact of the box with a ball, and the same the other way round, flipped back.
  Contact<S> both_ways(const Sphere<S>& ball) {
    const auto there = contact(box, ball);
    auto back = contact(ball, box);
    EXPECT_TRUE(there.has_value() && back.has_value());
    if (!there || !back) return {};
    EXPECT_EQ(there->normal, Vec3<S>(-back->normal));
    EXPECT_EQ(there->penetration, back->penetration);
    EXPECT_EQ(there->local_a, back->local_b);
    EXPECT_EQ(there->local_b, back->local_a);
    EXPECT_EQ(there->local_a, Vec3<S>(0, 0, 0));  // an axis-aligned box's contact is at its center
    return *there;
  }
};
TYPED_TEST_SUITE(AabbSphere, Scalars, ScalarNames);

TYPED_TEST(AabbSphere, face_edge_and_corner_touch) {
  using S = TypeParam;
  EXPECT_TRUE(overlaps(this->box, Sphere<S>{{2, 0, 0}, 1}));
  EXPECT_FALSE(overlaps(this->box, Sphere<S>{{next_up(S(2)), 0, 0}, 1}));
  EXPECT_TRUE(overlaps(this->box, Sphere<S>{{4, 6, 0}, 5}));
  EXPECT_FALSE(overlaps(this->box, Sphere<S>{{4, 6, 0}, next_down(S(5))}));
  EXPECT_TRUE(overlaps(this->box, Sphere<S>{{-2, -4, -5}, 3}));  // 1, 2, 2 from the corner
  EXPECT_FALSE(overlaps(this->box, Sphere<S>{{-2, -4, -5}, next_down(S(3))}));
  EXPECT_TRUE(overlaps(Sphere<S>{{-2, -4, -5}, 3}, this->box));
}

TYPED_TEST(AabbSphere, contact_with_a_face) {
  using S = TypeParam;
  const Contact<S> found = this->both_ways({{0, -2.5, 0}, 1});
  EXPECT_EQ(found.normal, Vec3<S>(0, -1, 0));
  EXPECT_EQ(found.penetration, S(0.5));
  EXPECT_EQ(found.local_b, Vec3<S>(0, 1, 0));
}

TYPED_TEST(AabbSphere, contact_with_an_edge) {
  using S = TypeParam;
  const Contact<S> found = this->both_ways({{4, 6, 0}, 5.5});
  EXPECT_EQ(found.normal, Vec3<S>(S(3) / S(5), S(4) / S(5), 0));
  EXPECT_EQ(found.penetration, S(0.5));
}

TYPED_TEST(AabbSphere, a_center_inside_leaves_through_the_nearest_face) {
  using S = TypeParam;
  const Contact<S> found = this->both_ways({{0.25, 0, -2.75}, 0.5});
  EXPECT_EQ(found.normal, Vec3<S>(0, 0, -1));
  EXPECT_EQ(found.penetration, S(0.75));  // radius and depth
  EXPECT_EQ(found.local_b, Vec3<S>(0, 0, 0.5));
  EXPECT_EQ(separation(this->box, Sphere<S>{{0.25, 0, -2.75}, 0.5}).distance, S(-0.75));
}

TYPED_TEST(AabbSphere, ties_leave_by_the_lowest_axis_on_its_positive_side) {
  using S = TypeParam;
  EXPECT_EQ(this->both_ways({{0, 0, 0}, 0.5}).normal, Vec3<S>(1, 0, 0));
  EXPECT_EQ(this->both_ways({{0, 0, 0}, 0.5}).penetration, S(1.5));
  EXPECT_EQ(this->both_ways({{0.5, -1.5, 2.5}, 0.5}).normal, Vec3<S>(1, 0, 0));
  EXPECT_EQ(this->both_ways({{-0.5, -1.5, 2.5}, 0.5}).normal, Vec3<S>(-1, 0, 0));
}

TYPED_TEST(AabbSphere, a_center_on_the_surface) {
  using S = TypeParam;
  EXPECT_EQ(this->both_ways({{1, 0, 0}, 0.5}).normal, Vec3<S>(1, 0, 0));
  EXPECT_EQ(this->both_ways({{1, 0, 0}, 0.5}).penetration, S(0.5));
  EXPECT_EQ(this->both_ways({{0, 2, 3}, 0.5}).normal, Vec3<S>(0, 1, 0));
  EXPECT_EQ(this->both_ways({{1, 2, 3}, 0}).penetration, S(0));  // a point on a corner
}

TYPED_TEST(AabbSphere, plates_and_points) {
  using S = TypeParam;
  const Aabb<S> plate{{0, 0, 0}, {0, 8, 8}}, point{{0, 0, 0}, {0, 0, 0}};
  EXPECT_TRUE(overlaps(plate, Sphere<S>{{0.25, 0, 0}, 0.25}));
  EXPECT_FALSE(overlaps(plate, Sphere<S>{{0.25, 0, 0}, next_down(S(0.25))}));
  const auto on_plate = contact(plate, Sphere<S>{{0, 1, 1}, 0.25});
  ASSERT_TRUE(on_plate.has_value());
  EXPECT_EQ(on_plate->normal, Vec3<S>(1, 0, 0));
  EXPECT_EQ(on_plate->penetration, S(0.25));
  EXPECT_TRUE(overlaps(point, Sphere<S>{{0, 0, 0}, 0}));
  EXPECT_FALSE(overlaps(point, Sphere<S>{{0, std::numeric_limits<S>::min(), 0}, 0}));
  EXPECT_EQ(contact(point, Sphere<S>{{0, 0, 0}, 2})->penetration, S(2));
}

TYPED_TEST(AabbSphere, separation_gives_a_point_on_each) {
  using S = TypeParam;
  const Separation<S> gap = separation(this->box, Sphere<S>{{0.5, 7, 0}, 1});
  EXPECT_EQ(gap.distance, S(4));
  EXPECT_EQ(gap.point_a, Vec3<S>(0.5, 2, 0));
  EXPECT_EQ(gap.point_b, Vec3<S>(0.5, 6, 0));
}

}  // namespace
}  // namespace thinwall::testing
