// Balls and boxes at one instant, by hand. What is no shape: capsule/capsule_test.cpp.

#include <gtest/gtest.h>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/sphere.hpp>

#include "support/contacts.hpp"
#include "support/real.hpp"

namespace thinwall::testing {
namespace {

// ---- Two balls.

template <class S> class SphereSphere : public ::testing::Test {
 protected:
  const Sphere<S> ball{{0, 0, 0}, 1};
};
TYPED_TEST_SUITE(SphereSphere, Scalars, ScalarNames);

TYPED_TEST(SphereSphere, touching_counts_and_one_ulp_decides) {
  using S = TypeParam;
  EXPECT_TRUE(overlaps(this->ball, Sphere<S>{{2, 0, 0}, 1}));
  EXPECT_TRUE(overlaps(this->ball, Sphere<S>{{next_down(S(2)), 0, 0}, 1}));
  EXPECT_FALSE(overlaps(this->ball, Sphere<S>{{next_up(S(2)), 0, 0}, 1}));
  EXPECT_TRUE(overlaps(Sphere<S>{{0, 0, 0}, 2}, Sphere<S>{{3, 4, 0}, 3}));  // 3-4-5
}

TYPED_TEST(SphereSphere, contact_of_a_touch_has_no_depth) {
  using S = TypeParam;
  expect_contact(contact(this->ball, Sphere<S>{{2, 0, 0}, 1}), Vec3<S>(1, 0, 0), S(0));
}

TYPED_TEST(SphereSphere, contact_points_are_relative_to_the_centers) {
  using S = TypeParam;
  const auto found = contact(Sphere<S>{{8, 16, -4}, 1}, Sphere<S>{{8, 17.5, -4}, 2});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->normal, Vec3<S>(0, 1, 0));
  EXPECT_EQ(found->penetration, S(1.5));
  EXPECT_EQ(found->local_a, Vec3<S>(0, 1, 0));
  EXPECT_EQ(found->local_b, Vec3<S>(0, -2, 0));
}

TYPED_TEST(SphereSphere, coincident_centers_part_along_x_whichever_way_round) {
  using S = TypeParam;
  const Sphere<S> small{{0, 0, 0}, 0.25};
  for (const auto& found : {contact(this->ball, small), contact(small, this->ball)})
    expect_contact(found, Vec3<S>(1, 0, 0), S(1.25));
  EXPECT_EQ(separation(this->ball, small).distance, S(-1.25));
  EXPECT_EQ(separation(this->ball, small).normal, Vec3<S>(1, 0, 0));
}

TYPED_TEST(SphereSphere, points) {
  using S = TypeParam;
  const Sphere<S> point{{1, 2, 3}, 0};
  EXPECT_TRUE(overlaps(point, point));
  ASSERT_TRUE(contact(point, point).has_value());
  EXPECT_EQ(contact(point, point)->penetration, S(0));
  EXPECT_EQ(contact(point, point)->normal, Vec3<S>(1, 0, 0));
  EXPECT_FALSE(overlaps(point, Sphere<S>{{1, 2, next_up(S(3))}, 0}));
  const S least = std::numeric_limits<S>::min();
  EXPECT_FALSE(overlaps(Sphere<S>{{0, 0, 0}, 0}, Sphere<S>{{least, 0, 0}, 0}));
  EXPECT_TRUE(overlaps(Sphere<S>{{0, 0, 0}, 0}, Sphere<S>{{least, 0, 0}, least}));
}

// ---- Two axis-aligned boxes.

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
  for (const auto& found : {contact(cube, cube), contact(cube, Aabb<S>{{4, 4, 4}, {1, 1, 1}})})
    expect_contact(found, Vec3<S>(1, 0, 0), S(2));
  expect_contact(contact(cube, Aabb<S>{{2.5, 2.5, 2.5}, {1, 1, 1}}), Vec3<S>(-1, 0, 0), S(0.5));
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

// ---- A box and a ball.

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
  expect_contact(contact(plate, Sphere<S>{{0, 1, 1}, 0.25}), Vec3<S>(1, 0, 0), S(0.25));
  EXPECT_TRUE(overlaps(point, Sphere<S>{{0, 0, 0}, 0}));
  EXPECT_FALSE(overlaps(point, Sphere<S>{{0, std::numeric_limits<S>::min(), 0}, 0}));
  EXPECT_EQ(contact(point, Sphere<S>{{0, 0, 0}, 2})->penetration, S(2));
}

// ---- Which axes an oriented box may have.

template <class S> class ObbAxes : public ::testing::Test {
 protected:
  /// A box with one number of its axes off by so much.
  static Obb<S> off_by(int row, int column, const S& off) {
    Obb<S> box{{0, 0, 0}, {1, 1, 1}, Mat3<S>::Identity()};
    box.axes(row, column) += off;
    return box;
  }
};
TYPED_TEST_SUITE(ObbAxes, Scalars, ScalarNames);

TYPED_TEST(ObbAxes, are_orthonormal_to_more_than_half_the_digits) {
  using S = TypeParam;
  const bool is_float = std::is_same_v<S, float>;
  const S rounding = power<S>(is_float ? -15 : -32),
          beyond = power<S>(is_float ? -12 : -29);  // a unit column's square is off by twice that
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      EXPECT_TRUE(valid(this->off_by(row, column, rounding)));
      EXPECT_FALSE(valid(this->off_by(row, column, beyond)));
      for (const S& bad : {nan<S>(), infinity<S>(), S(-3), std::numeric_limits<S>::max()}) {
        EXPECT_FALSE(valid(this->off_by(row, column, bad))) << row << column << bad;
      }
    }
  }
  for (const S& factor : {S(0), S(0.5), S(2)}) {
    EXPECT_FALSE(valid(Obb<S>{{0, 0, 0}, {1, 1, 1}, Mat3<S>::Identity() * factor})) << factor;
  }
}

/// A box in S whose axes are off is one in W whose axes are not, with edges as long as they were.
template <class S, class W> void expect_orthonormal_when_widened(const S& off) {
  const W rounding = 8 * std::numeric_limits<W>::epsilon(), allowed = 2 * W(off) * W(off) + rounding;
  const auto expect_near = [&](const W& is, const W& should_be) { EXPECT_LE(std::abs(is - should_be), allowed); };
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      Obb<S> slanted{{0, 0, 0}, {1, 1, 1}, Mat3<S>::Identity()};
      slanted.axes(row, column) += off;
      const Obb<W> box = widened<W>(slanted);
      const Mat3<W> gram = box.axes.transpose() * box.axes;
      EXPECT_LE((gram - Mat3<W>::Identity()).cwiseAbs().maxCoeff(), rounding);
      if (row != column) {
        expect_near(box.axes(row, column), off / 2);
        expect_near(box.axes(column, row), -off / 2);
      }
      for (int i = 0; i < 3; ++i) expect_near(box.half_extents[i], i == row && i == column ? 1 + W(off) : W(1));
    }
  }
}

TEST(ObbAxesWidened, are_orthonormal_to_the_rounding_of_the_wider_scalar) {
  expect_orthonormal_when_widened<float, double>(0x1p-15F);
  expect_orthonormal_when_widened<double, long double>(0x1p-32);
}

TYPED_TEST(ObbAxes, that_mirror_describe_the_same_box) {
  using S = TypeParam;
  const Obb<S> box{{0, 0, 0}, {1, 2, 3}, Mat3<S>::Identity()};
  Obb<S> mirrored = box;
  mirrored.axes.col(1) *= S(-1);
  EXPECT_TRUE(valid(mirrored));
  const Obb<S> other{{3, 3, 1}, {1, 2, 1}, Mat3<S>{{S(3) / 5, S(-4) / 5, 0}, {S(4) / 5, S(3) / 5, 0}, {0, 0, 1}}};
  EXPECT_EQ(separation(mirrored, other).distance, separation(box, other).distance);
  EXPECT_EQ(separation(mirrored, other).normal, separation(box, other).normal);
  EXPECT_EQ(raycast(Ray<S>{{-4, 1, 2}, {1, 0, 0}}, mirrored)->t, S(3));
}

TYPED_TEST(ObbAxes, that_lean_make_no_box) {  // nor does a NaN in one of them
  using S = TypeParam;
  const Sphere<S> ball{{0, 0, 0}, 1};
  for (const S& bad : {S(0.5), nan<S>()}) {
    const Obb<S> box = this->off_by(0, 1, bad);
    EXPECT_FALSE(overlaps(box, ball));
    EXPECT_FALSE(contact(ball, box));
    EXPECT_NE(separation(box, box).distance, separation(box, box).distance);
    EXPECT_FALSE(raycast(Ray<S>{{-4, 0, 0}, {1, 0, 0}}, box));
  }
}

}  // namespace
}  // namespace thinwall::testing
