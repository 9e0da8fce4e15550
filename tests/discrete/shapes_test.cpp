// Balls and boxes at one instant and rays at them, by hand; and triangles almost without an area. What is no shape:
// capsule/capsule_test.cpp.

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <gtest/gtest.h>

#include <thinwall/discrete/queries.hpp>

#include "support/bodies.hpp"
#include "support/contacts.hpp"
#include "support/real.hpp"
#include "support/shaker.hpp"

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

// ---- Rays against balls and boxes.

template <class S> class Rays : public ::testing::Test {
 protected:
  const Sphere<S> ball{{0, 0, 0}, 1};
  const Aabb<S> box{{0, 0, 0}, {1, 2, 3}};

  /// Both shapes, for what must hold for either.
  template <class Check> void each_shape(const Check& check) const {
    check(ball);
    check(box);
  }
};
TYPED_TEST_SUITE(Rays, Scalars, ScalarNames);

TYPED_TEST(Rays, hit_from_outside) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    const auto hit = raycast(Ray<S>{{-5, 0, 0}, {1, 0, 0}}, shape);
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->t, S(4));
    EXPECT_EQ(hit->point, Vec3<S>(-1, 0, 0));
    EXPECT_EQ(hit->normal, Vec3<S>(-1, 0, 0));
  });
}

TYPED_TEST(Rays, t_counts_in_lengths_of_the_direction) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    EXPECT_EQ(raycast(Ray<S>{{-5, 0, 0}, {8, 0, 0}}, shape)->t, S(0.5));
    EXPECT_EQ(raycast(Ray<S>{{5, 0, 0}, {-0.5, 0, 0}}, shape)->t, S(8));
  });
}

TYPED_TEST(Rays, max_t_is_the_last_that_counts) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    EXPECT_TRUE(raycast(Ray<S>{{-5, 0, 0}, {1, 0, 0}, 4}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {1, 0, 0}, next_down(S(4))}, shape).has_value());
    EXPECT_TRUE(raycast(Ray<S>{{0, 0, 0}, {1, 0, 0}, 0}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{0, 0, 0}, {1, 0, 0}, -1}, shape).has_value());
  });
}

TYPED_TEST(Rays, a_start_inside_or_touching_hits_at_once_without_a_normal) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    for (const Vec3<S>& start : {Vec3<S>(0.25, 0, 0.5), Vec3<S>(1, 0, 0), Vec3<S>(0, 0, 0)}) {
      for (const Vec3<S>& direction : {Vec3<S>(1, 0, 0), Vec3<S>(-1, 0, 0), Vec3<S>(0, 0, 0)}) {
        const auto hit = raycast(Ray<S>{start, direction}, shape);
        ASSERT_TRUE(hit.has_value());
        EXPECT_EQ(hit->t, S(0));
        EXPECT_EQ(hit->point, start);
        EXPECT_EQ(hit->normal, Vec3<S>(0, 0, 0));
      }
    }
  });
}

TYPED_TEST(Rays, behind_and_beside_are_missed) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    EXPECT_FALSE(raycast(Ray<S>{{5, 0, 0}, {1, 0, 0}}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 4, 0}, {1, 0, 0}}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {0, 1, 0}}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {0, 0, 0}}, shape).has_value());  // no direction
  });
}

TYPED_TEST(Rays, a_ball_is_grazed_exactly) {
  using S = TypeParam;
  const auto hit = raycast(Ray<S>{{-4, 1, 0}, {8, 0, 0}}, this->ball);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->t, S(0.5));
  EXPECT_EQ(hit->normal, Vec3<S>(0, 1, 0));
  EXPECT_FALSE(raycast(Ray<S>{{-4, next_up(S(1)), 0}, {8, 0, 0}}, this->ball).has_value());
  EXPECT_TRUE(raycast(Ray<S>{{-4, next_down(S(1)), 0}, {8, 0, 0}}, this->ball).has_value());
}

TYPED_TEST(Rays, a_point_is_hit_only_head_on) {
  using S = TypeParam;
  const Sphere<S> point{{0, 0, 0}, 0};
  const auto hit = raycast(Ray<S>{{-2, -4, -6}, {1, 2, 3}}, point);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->t, S(2));
  EXPECT_FALSE(raycast(Ray<S>{{-2, -4, next_up(S(6))}, {1, 2, -3}}, point).has_value());
  EXPECT_TRUE(raycast(Ray<S>{{-2, -4, -6}, {1, 2, 3}}, Aabb<S>{{0, 0, 0}, {0, 0, 0}}).has_value());
}

TYPED_TEST(Rays, a_point_of_a_turned_box_is_hit_at_every_size) {
  using S = TypeParam;
  Mat3<S> turn;
  turn << S(0.8), S(-0.6), 0, S(0.6), S(0.8), 0, 0, 0, 1;
  const Obb<S> point{{0, 0, 0}, {0, 0, 0}, turn};
  const auto here = raycast(Ray<S>{{0, -8, 0}, {0, 8, 0}}, point);
  ASSERT_TRUE(here.has_value());
  EXPECT_EQ(here->t, S(1));
  const int least = std::max(-20'000, std::numeric_limits<S>::min_exponent - std::numeric_limits<S>::digits);
  for (int e = least; e < 0; e += 7) {
    const auto hit = raycast(Ray<S>{{0, -power<S>(e + 3), 0}, {0, power<S>(e + 3), 0}}, point);
    ASSERT_TRUE(hit.has_value()) << e;
    EXPECT_EQ(hit->t, here->t) << e;
    EXPECT_EQ(hit->normal, here->normal) << e;
  }
}

TYPED_TEST(Rays, parallel_to_a_slab) {
  using S = TypeParam;
  EXPECT_TRUE(raycast(Ray<S>{{-5, 2, 0}, {1, 0, 0}}, this->box).has_value());   // along the face: closed
  EXPECT_TRUE(raycast(Ray<S>{{-5, -2, 3}, {1, 0, 0}}, this->box).has_value());  // along the edge
  EXPECT_FALSE(raycast(Ray<S>{{-5, next_up(S(2)), 0}, {1, 0, 0}}, this->box).has_value());
  EXPECT_FALSE(raycast(Ray<S>{{-5, 0, -next_up(S(3))}, {1, 0, 0}}, this->box).has_value());
  EXPECT_TRUE(raycast(Ray<S>{{-5, S(-S(0)), 0}, {1, S(-S(0)), 0}}, this->box).has_value());  // negative zeros
}

TYPED_TEST(Rays, through_an_edge_and_a_corner) {
  using S = TypeParam;
  const auto edge = raycast(Ray<S>{{-3, 0, 0}, {1, 1, 0}}, this->box);
  ASSERT_TRUE(edge.has_value());
  EXPECT_EQ(edge->t, S(2));
  const auto corner = raycast(Ray<S>{{-3, -4, 5}, {2, 2, -2}}, this->box);  // meets (-1, -2, 3) and goes in
  ASSERT_TRUE(corner.has_value());
  EXPECT_EQ(corner->t, S(1));
  EXPECT_EQ(corner->point, Vec3<S>(-1, -2, 3));
  EXPECT_TRUE(raycast(Ray<S>{{-2, 1, 0}, {1, 1, 0}}, this->box).has_value());  // grazes the edge at (-1, 2)
  EXPECT_FALSE(raycast(Ray<S>{{-2, next_up(S(1)), 0}, {1, 1, 0}}, this->box).has_value());
}

TYPED_TEST(Rays, a_plate_is_hit_on_either_side) {
  using S = TypeParam;
  const Aabb<S> plate{{1, 0, 0}, {0, 8, 8}};
  EXPECT_EQ(raycast(Ray<S>{{0, 0, 0}, {2, 0, 0}}, plate)->t, S(0.5));
  EXPECT_EQ(raycast(Ray<S>{{0, 0, 0}, {2, 0, 0}}, plate)->normal, Vec3<S>(-1, 0, 0));
  EXPECT_EQ(raycast(Ray<S>{{2, 0, 0}, {-2, 0, 0}}, plate)->normal, Vec3<S>(1, 0, 0));
  EXPECT_TRUE(raycast(Ray<S>{{1, -10, 0}, {0, 1, 0}}, plate).has_value());  // within its plane
  EXPECT_TRUE(raycast(Ray<S>{{0, S(1) / S(3), 0}, {S(1) / S(7), S(1) / S(11), 0}}, plate).has_value());  // inexact
}

TYPED_TEST(Rays, a_plate_is_met_on_its_edge_however_late_the_ray_ends) {
  using S = TypeParam;
  const Triangle<S> plate{{-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}};
  for (int exponent = 0; exponent < std::numeric_limits<S>::max_exponent && exponent < 20000; exponent += 7) {
    const auto hit = raycast(Ray<S>{{S(0.5), S(0.5), -5}, {0, 0, 8}, power<S>(exponent)}, plate);
    ASSERT_TRUE(hit.has_value()) << exponent;
    EXPECT_EQ(hit->t, S(0.625));
  }
}

TYPED_TEST(Rays, not_a_number) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    EXPECT_FALSE(raycast(Ray<S>{{nan<S>(), 0, 0}, {1, 0, 0}}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {1, nan<S>(), 0}}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {1, 0, 0}, nan<S>()}, shape).has_value());
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {infinity<S>(), 0, 0}}, shape).has_value());
  });
}

// ---- Triangles almost without an area, whose plane roundings may turn by any angle: their distance from a point is that of the exact
// corners.

using oracle::Real;
using oracle::Vector;

Real from_edge(const Vector& x, const Vector& start, const Vector& end) {
  const Vector along = end - start;
  const Real square = dot(along, along), wanted = square > 0 ? Real(dot(x - start, along) / square) : Real(0);
  return length(x - (start + std::clamp<Real>(wanted, 0, 1) * along));
}

/// From every edge, and from the plane where the foot lies between the edges. 100 digits hold every product of the corners.
Real distance_of(const Vector& x, const Vector& a, const Vector& b, const Vector& c) {
  const Real from_edges = std::min({from_edge(x, a, b), from_edge(x, b, c), from_edge(x, c, a)});
  const Vector normal = cross(b - a, c - a);
  const auto within = [&](const Vector& start, const Vector& end) {
    return dot(cross(normal, end - start), x - start) >= 0;
  };
  if (dot(normal, normal) == 0 || !within(a, b) || !within(b, c) || !within(c, a)) return from_edges;
  return std::min(from_edges, Real(abs(dot(normal, x - a)) / length(normal)));
}

template <class S> class Needles : public ::testing::Test {};
TYPED_TEST_SUITE(Needles, Scalars, ScalarNames);

template <class S> S at_most(Shaker<S>& draw, int bits) { return power<S>(-draw.pick(0, bits - 1)); }

/// What lies next to a place on the line from a to b.
template <class S> Vec3<S> beside(Shaker<S>& draw, const Vec3<S>& a, const Vec3<S>& b, const S& place, int bits) {
  const Vec3<S> aside = draw.plain_vector();
  return a + (b - a) * place + aside * at_most(draw, bits);
}

template <class S> void expect_as_far(const Vec3<S>& x, const Vec3<S>& a, const Vec3<S>& b, const Vec3<S>& c, int i) {
  const S distance = separation(Triangle<S>{a, b, c}, Sphere<S>{x, S(0)}).distance;
  const auto [X, A, B, C] =
      std::tuple{oracle::lift_vector(x), oracle::lift_vector(a), oracle::lift_vector(b), oracle::lift_vector(c)};
  const Real size = length(B - A) + length(C - A) + length(X - A);
  ASSERT_LE(abs(oracle::lift(distance) - distance_of(X, A, B, C)), 4 * oracle::unit_roundoff<S>() * size) << i;
}

TYPED_TEST(Needles, are_as_far_as_their_corners_say) {
  using S = TypeParam;
  Shaker<S> draw(1);
  constexpr int bits = std::numeric_limits<S>::digits + 10;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3<S> a = draw.plain_vector() * S(i % 3 == 0 ? 0 : 1), b = draw.plain_vector();
    const Vec3<S> c = beside<S>(draw, a, b, S(0.7) + S(0.3) * draw.plain(), bits);
    expect_as_far<S>(beside<S>(draw, a, b, draw.plain(), bits), a, b, c, i);
  }
}

TYPED_TEST(Needles, are_as_far_from_what_lies_past_their_tips) {  // where all three sides are one line to rounding
  using S = TypeParam;
  Shaker<S> draw(2);
  constexpr int bits = std::numeric_limits<S>::digits;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3<S> a = draw.plain_vector(), b = draw.plain_vector(),
                  c = beside<S>(draw, a, b, S(0.5) + S(0.4) * draw.plain(), bits);
    expect_as_far<S>(beside<S>(draw, a, b, S(1) + at_most(draw, bits / 2), bits), a, b, c, i);
  }
}

TYPED_TEST(Needles, whose_area_all_but_vanishes_have_no_plane) {
  using S = TypeParam;
  const Triangle<S> line{{-3, -3, 0}, {3, -2, -std::numeric_limits<S>::denorm_min()}, {0, S(-2.5), 0}};
  EXPECT_NEAR(double(separation(line, Sphere<S>{{-1, 2, 0}, 0}).distance), 4.6031716445500041, 8 * double(unit<S>()));
}

// ---- Lengths whose squares overflow or vanish: the answer is not lost, and is the same to the bit.

template <class S> class Range : public ::testing::Test {
 protected:
  /// Powers of two from the smallest to the largest at which small whole numbers stay exact.
  static std::vector<int> exponents() {
    using Limits = std::numeric_limits<S>;
    const int low = std::max(Limits::min_exponent + 2, -20000), high = std::min(Limits::max_exponent - 6, 20000);
    return {low, low / 2, -70, 70, high / 2, high - 3, high};
  }

  /// Checks all queries on two shapes at every size against the same at size one.
  template <class A, class B> static void same_at_every_size(const A& a, const B& b) {
    for (const int k : exponents()) {
      SCOPED_TRACE(k);
      const A large_a = scaled(a, k);
      const B large_b = scaled(b, k);
      EXPECT_EQ(overlaps(large_a, large_b), overlaps(a, b));
      EXPECT_EQ(separation(large_a, large_b).distance, times_power(separation(a, b).distance, k));
      EXPECT_EQ(separation(large_a, large_b).normal, separation(a, b).normal);
      const auto found = contact(large_a, large_b), expected = contact(a, b);
      ASSERT_EQ(found.has_value(), expected.has_value());
      if (!found) continue;
      EXPECT_EQ(found->penetration, times_power(expected->penetration, k));
      EXPECT_EQ(found->normal, expected->normal);
      EXPECT_EQ(found->local_b, times_power(expected->local_b, k));
    }
  }
};
TYPED_TEST_SUITE(Range, Scalars, ScalarNames);

TYPED_TEST(Range, balls) {
  using S = TypeParam;
  const Sphere<S> ball{{1, -2, 3}, 2};
  this->same_at_every_size(ball, Sphere<S>{{1, 1, 7}, 3});  // 3-4-5: touch
  this->same_at_every_size(ball, Sphere<S>{{1, 1, 7}, next_down(S(3))});
  this->same_at_every_size(ball, Sphere<S>{{2, 0, 3}, 1});
  this->same_at_every_size(ball, ball);
}

TYPED_TEST(Range, boxes) {
  using S = TypeParam;
  const Aabb<S> box{{0, 0, 0}, {1, 2, 3}};
  this->same_at_every_size(box, Aabb<S>{{2, 1, 1}, {1, 1, 1}});
  this->same_at_every_size(box, Aabb<S>{{next_up(S(2)), 1, 1}, {1, 1, 1}});
  this->same_at_every_size(box, Aabb<S>{{5, 7, 0}, {1, 1, 1}});
  this->same_at_every_size(box, Aabb<S>{{0.5, 0.5, 1}, {1, 1, 1}});
}

TYPED_TEST(Range, box_and_ball) {
  using S = TypeParam;
  const Aabb<S> box{{0, 0, 0}, {1, 2, 3}};
  this->same_at_every_size(box, Sphere<S>{{4, 6, 0}, 5});
  this->same_at_every_size(box, Sphere<S>{{4, 6, 0}, next_down(S(5))});
  this->same_at_every_size(box, Sphere<S>{{0.5, 0, 1}, 1});
  this->same_at_every_size(Sphere<S>{{0.5, 0, 1}, 1}, box);
}

TYPED_TEST(Range, rays) {
  using S = TypeParam;
  const Ray<S> ray{{-4, 0.5, -0.25}, {2, 0.25, 0.125}};
  const auto check = [&](const auto& shape) {
    const auto expected = raycast(ray, shape);
    ASSERT_TRUE(expected.has_value());
    for (const int k : this->exponents()) {
      SCOPED_TRACE(k);
      const Ray<S> large{times_power(ray.origin, k), times_power(ray.direction, k), ray.max_t};
      const auto found = raycast(large, scaled(shape, k));
      ASSERT_TRUE(found.has_value());
      EXPECT_EQ(found->t, expected->t);
      EXPECT_EQ(found->normal, expected->normal);
      EXPECT_EQ(found->point, times_power(expected->point, k));
    }
  };
  check(Sphere<S>{{0, 0, 0}, 2});
  check(Aabb<S>{{0, 0, 0}, {1, 2, 3}});
}

TEST(RangeOfDouble, the_least_number_is_a_size) {
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(overlaps(Sphere<double>{{0, 0, 0}, least}, Sphere<double>{{2 * least, 0, 0}, least}));
  EXPECT_FALSE(overlaps(Sphere<double>{{0, 0, 0}, least}, Sphere<double>{{3 * least, 0, 0}, least}));
}

}  // namespace
}  // namespace thinwall::testing
