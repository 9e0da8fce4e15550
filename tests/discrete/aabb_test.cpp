// Two axis-aligned boxes at one instant, by hand.

#include <gtest/gtest.h>
#include <thinwall/discrete/aabb.hpp>

#include "support/scalars.hpp"

namespace thinwall::testing {
namespace {

template <class S> class AabbAabb : public ::testing::Test {
 protected:
  const Aabb<S> box{{0, 0, 0}, {1, 2, 3}};
};
TYPED_TEST_SUITE(AabbAabb, Scalars, ScalarNames);

TYPED_TEST(AabbAabb, faces_edges_and_corners_touch) {
  using S = TypeParam;
  const Vec3<S> half(1, 1, 1);
  EXPECT_TRUE(overlaps(this->box, Aabb<S>{{2, 0, 0}, half}));
  EXPECT_TRUE(overlaps(this->box, Aabb<S>{{2, 3, 0}, half}));
  EXPECT_TRUE(overlaps(this->box, Aabb<S>{{-2, 3, -4}, half}));
  EXPECT_FALSE(overlaps(this->box, Aabb<S>{{next_up(S(2)), 0, 0}, half}));
  EXPECT_FALSE(overlaps(this->box, Aabb<S>{{2, 3, next_up(S(4))}, half}));
  EXPECT_TRUE(overlaps(this->box, Aabb<S>{{2, 3, next_down(S(4))}, half}));
}

TYPED_TEST(AabbAabb, parts_along_the_axis_of_least_penetration) {
  using S = TypeParam;
  const auto found = contact(this->box, Aabb<S>{{0.5, -2.75, 1}, {1, 1, 1}});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->normal, Vec3<S>(0, -1, 0));
  EXPECT_EQ(found->penetration, S(0.25));
}

TYPED_TEST(AabbAabb, contact_acts_at_the_centers) {  // no torque: an axis-aligned box must not turn
  using S = TypeParam;
  const auto found = contact(this->box, Aabb<S>{{1.5, 1, 2}, {1, 1, 1}});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->local_a, Vec3<S>(0, 0, 0));
  EXPECT_EQ(found->local_b, Vec3<S>(0, 0, 0));
}

TYPED_TEST(AabbAabb, ties_take_the_lowest_axis_and_its_positive_side) {
  using S = TypeParam;
  const Aabb<S> cube{{4, 4, 4}, {1, 1, 1}};
  for (const auto& found : {contact(cube, cube), contact(cube, Aabb<S>{{4, 4, 4}, {1, 1, 1}})}) {
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->normal, Vec3<S>(1, 0, 0));
    EXPECT_EQ(found->penetration, S(2));
  }
  const auto corner = contact(cube, Aabb<S>{{2.5, 2.5, 2.5}, {1, 1, 1}});
  ASSERT_TRUE(corner.has_value());
  EXPECT_EQ(corner->normal, Vec3<S>(-1, 0, 0));
  EXPECT_EQ(corner->penetration, S(0.5));
}

TYPED_TEST(AabbAabb, distance_between_corners_is_euclidean) {
  using S = TypeParam;
  const Separation<S> gap = separation(this->box, Aabb<S>{{5, 7, 0}, {1, 1, 1}});
  EXPECT_EQ(gap.distance, S(5));  // 3 and 4
  EXPECT_EQ(gap.normal, Vec3<S>(S(3) / S(5), S(4) / S(5), 0));
  EXPECT_EQ(gap.point_a[0], S(1));
  EXPECT_EQ(gap.point_a[1], S(2));
  EXPECT_EQ(gap.point_b[0], S(4));
  EXPECT_EQ(gap.point_b[1], S(6));
  EXPECT_EQ(gap.point_a[2], gap.point_b[2]);
}

TYPED_TEST(AabbAabb, one_within_the_other) {
  using S = TypeParam;
  const Separation<S> gap = separation(Aabb<S>{{0, 0, 0}, {8, 8, 8}}, Aabb<S>{{0, 0, -1}, {1, 1, 1}});
  EXPECT_EQ(gap.distance, S(-8));
  EXPECT_EQ(gap.normal, Vec3<S>(0, 0, -1));
}

TYPED_TEST(AabbAabb, plates_rods_and_points) {
  using S = TypeParam;
  const Aabb<S> plate{{0, 0, 0}, {0, 8, 8}}, rod{{0, 0, 0}, {8, 0, 0}}, point{{0, 4, 0}, {0, 0, 0}};
  EXPECT_TRUE(overlaps(plate, rod));
  EXPECT_TRUE(overlaps(plate, point));
  EXPECT_TRUE(overlaps(point, point));
  EXPECT_FALSE(overlaps(rod, point));
  EXPECT_FALSE(overlaps(plate, Aabb<S>{{std::numeric_limits<S>::min(), 0, 0}, {0, 8, 8}}));
  EXPECT_EQ(contact(plate, plate)->penetration, S(0));
  EXPECT_EQ(contact(plate, plate)->normal, Vec3<S>(1, 0, 0));
  EXPECT_EQ(contact(plate, rod)->penetration, S(8));  // -8, 8, 8 on the three axes: y and z part by 8 as well
  EXPECT_EQ(separation(point, point).distance, S(0));
}

TYPED_TEST(AabbAabb, validity) {
  using S = TypeParam;
  EXPECT_TRUE(valid(this->box));
  EXPECT_TRUE(valid(Aabb<S>{{0, 0, 0}, {0, 0, 0}}));
  EXPECT_FALSE(valid(Aabb<S>{{0, 0, 0}, {1, -1, 1}}));
  for (const S& bad : {nan<S>(), infinity<S>(), S(-infinity<S>())}) {
    EXPECT_FALSE(valid(Aabb<S>{{0, 0, bad}, {1, 1, 1}}));
    EXPECT_FALSE(valid(Aabb<S>{{0, 0, 0}, {1, bad, 1}}));
  }
}

TYPED_TEST(AabbAabb, nan_is_no_contact) {
  using S = TypeParam;
  for (const Aabb<S>& bad : {Aabb<S>{{0, nan<S>(), 0}, {1, 1, 1}}, Aabb<S>{{0, 0, 0}, {1, 1, nan<S>()}}}) {
    EXPECT_FALSE(overlaps(this->box, bad));
    EXPECT_FALSE(overlaps(bad, this->box));
    EXPECT_FALSE(contact(bad, this->box).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-4, 0, 0}, {1, 0, 0}}, bad).has_value());
  }
}

}  // namespace
}  // namespace thinwall::testing
