// Balls and boxes at one instant and rays at them, by hand; and triangles almost without an area. What is no shape:
// capsule/capsule_test.cpp.

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <gtest/gtest.h>

#include <thinwall/discrete/queries.hpp>

#include "support/contacts.hpp"
#include "support/real.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

// ---- Balls and boxes: where touching ends by one unit in the last place, what has no unique answer, and what vanishes.

template <class S> class ByHand : public ::testing::Test {
 protected:
  const Sphere<S> ball{{0, 0, 0}, 1};
  const Aabb<S> box{{0, 0, 0}, {1, 2, 3}};
  const S least = std::numeric_limits<S>::min();
};
TYPED_TEST_SUITE(ByHand, Scalars, ScalarNames);

TYPED_TEST(ByHand, two_balls) {
  using S = TypeParam;
  const S up = next_up(S(2)), down = next_down(S(2));
  expect_gap(this->ball, Sphere<S>{{2, 0, 0}, 1}, 0, {1, 0, 0});
  expect_gap(this->ball, Sphere<S>{{up, 0, 0}, 1}, up - 2, {1, 0, 0});
  expect_gap(this->ball, Sphere<S>{{down, 0, 0}, 1}, down - 2, {1, 0, 0});
  expect_gap(Sphere<S>{{0, 0, 0}, 2}, Sphere<S>{{3, 4, 0}, 3}, 0, {S(3) / S(5), S(4) / S(5), 0});
  expect_gap(Sphere<S>{{8, 16, -4}, 1}, Sphere<S>{{8, 17.5, -4}, 2}, -1.5, {0, 1, 0});
  expect_contact_at(Sphere<S>{{8, 16, -4}, 1}, Sphere<S>{{8, 17.5, -4}, 2}, {0, 1, 0}, {0, -2, 0});
}

TYPED_TEST(ByHand, two_balls_of_one_center_part_along_x_whichever_way_round) {
  using S = TypeParam;
  const Sphere<S> small{{0, 0, 0}, 0.25}, point{{1, 2, 3}, 0};
  expect_gap(this->ball, small, -1.25, {1, 0, 0});
  expect_gap(small, this->ball, -1.25, {1, 0, 0});
  expect_gap(point, point, 0, {1, 0, 0});
  EXPECT_FALSE(overlaps(point, Sphere<S>{{1, 2, next_up(S(3))}, 0}));
  EXPECT_FALSE(overlaps(Sphere<S>{{0, 0, 0}, 0}, Sphere<S>{{this->least, 0, 0}, 0}));
  EXPECT_TRUE(overlaps(Sphere<S>{{0, 0, 0}, 0}, Sphere<S>{{this->least, 0, 0}, this->least}));
}

TYPED_TEST(ByHand, two_boxes) {
  using S = TypeParam;
  const Vec3<S> half(1, 1, 1);
  EXPECT_TRUE(overlaps(this->box, Aabb<S>{{2, 3, 0}, half}));
  EXPECT_TRUE(overlaps(this->box, Aabb<S>{{-2, 3, -4}, half}));
  EXPECT_FALSE(overlaps(this->box, Aabb<S>{{next_up(S(2)), 0, 0}, half}));
  EXPECT_FALSE(overlaps(this->box, Aabb<S>{{2, 3, next_up(S(4))}, half}));
  EXPECT_TRUE(overlaps(this->box, Aabb<S>{{2, 3, next_down(S(4))}, half}));
  expect_contact_at(this->box, Aabb<S>{{1.5, 1, 2}, half}, {0, 0, 0},
                    {0, 0, 0});  // no torque: such a box must not turn
  const Aabb<S> corner{{5, 7, 0}, half};
  expect_gap(this->box, corner, 5, {S(3) / S(5), S(4) / S(5), 0});
  const Separation<S> gap = separation(this->box, corner);
  EXPECT_EQ(gap.point_a, Vec3<S>(1, 2, gap.point_b[2]));
  EXPECT_EQ(gap.point_b, Vec3<S>(4, 6, gap.point_a[2]));
}

TYPED_TEST(ByHand, two_boxes_that_tie_take_the_lowest_axis_and_its_positive_side) {
  using S = TypeParam;
  const Aabb<S> cube{{4, 4, 4}, {1, 1, 1}}, plate{{0, 0, 0}, {0, 8, 8}}, rod{{0, 0, 0}, {8, 0, 0}};
  const Aabb<S> point{{0, 4, 0}, {0, 0, 0}};
  expect_gap(cube, cube, -2, {1, 0, 0});
  expect_gap(cube, Aabb<S>{{2.5, 2.5, 2.5}, {1, 1, 1}}, -0.5, {-1, 0, 0});
  expect_gap(plate, plate, 0, {1, 0, 0});
  expect_gap(point, point, 0, {1, 0, 0});
  EXPECT_EQ(contact(plate, rod)->penetration, S(8));  // -8, 8, 8 on the three axes: y and z part by 8 as well
  EXPECT_TRUE(overlaps(plate, point));
  EXPECT_FALSE(overlaps(rod, point));
  EXPECT_FALSE(overlaps(plate, Aabb<S>{{this->least, 0, 0}, {0, 8, 8}}));
}

TYPED_TEST(ByHand, a_box_and_a_ball) {
  using S = TypeParam;
  expect_gap(this->box, Sphere<S>{{2, 0, 0}, 1}, 0, {1, 0, 0});
  EXPECT_FALSE(overlaps(this->box, Sphere<S>{{next_up(S(2)), 0, 0}, 1}));
  EXPECT_TRUE(overlaps(this->box, Sphere<S>{{4, 6, 0}, 5}));
  EXPECT_FALSE(overlaps(this->box, Sphere<S>{{4, 6, 0}, next_down(S(5))}));
  EXPECT_TRUE(overlaps(Sphere<S>{{-2, -4, -5}, 3}, this->box));  // 1, 2, 2 from the corner
  EXPECT_FALSE(overlaps(this->box, Sphere<S>{{-2, -4, -5}, next_down(S(3))}));
  const Sphere<S> below{{0, -2.5, 0}, 1}, inside{{0.25, 0, -2.75}, 0.5};  // which leaves through the nearest face
  expect_gap(this->box, below, -0.5, {0, -1, 0});
  expect_gap(this->box, inside, -0.75, {0, 0, -1});
  expect_contact_at(this->box, below, {0, 0, 0}, {0, 1, 0});  // of a box along the axes always at its center
  expect_contact_at(inside, this->box, {0, 0, 0.5}, {0, 0, 0});
}

TYPED_TEST(ByHand, a_box_and_a_ball_that_tie_leave_by_the_lowest_axis_on_its_positive_side) {
  using S = TypeParam;
  const Aabb<S> plate{{0, 0, 0}, {0, 8, 8}}, point{{0, 0, 0}, {0, 0, 0}};
  expect_gap(this->box, Sphere<S>{{0, 0, 0}, 0.5}, -1.5, {1, 0, 0});
  expect_gap(this->box, Sphere<S>{{0.5, -1.5, 2.5}, 0.5}, -1, {1, 0, 0});
  expect_gap(this->box, Sphere<S>{{-0.5, -1.5, 2.5}, 0.5}, -1, {-1, 0, 0});
  expect_gap(this->box, Sphere<S>{{1, 0, 0}, 0.5}, -0.5, {1, 0, 0});  // a center on the surface
  expect_gap(this->box, Sphere<S>{{0, 2, 3}, 0.5}, -0.5, {0, 1, 0});
  expect_gap(this->box, Sphere<S>{{1, 2, 3}, 0}, 0, {1, 0, 0});
  expect_gap(plate, Sphere<S>{{0, 1, 1}, 0.25}, -0.25, {1, 0, 0});
  expect_gap(plate, Sphere<S>{{0.25, 0, 0}, 0.25}, 0, {1, 0, 0});
  EXPECT_FALSE(overlaps(plate, Sphere<S>{{0.25, 0, 0}, next_down(S(0.25))}));
  expect_gap(point, Sphere<S>{{0, 0, 0}, 2}, -2, {1, 0, 0});
  EXPECT_FALSE(overlaps(point, Sphere<S>{{0, this->least, 0}, 0}));
}

TEST(RangeOfDouble, the_least_number_is_a_size) {
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(overlaps(Sphere<double>{{0, 0, 0}, least}, Sphere<double>{{2 * least, 0, 0}, least}));
  EXPECT_FALSE(overlaps(Sphere<double>{{0, 0, 0}, least}, Sphere<double>{{3 * least, 0, 0}, least}));
}

// Products of an edge with one all but parallel are shorter by the lean, and of a float soon nothing.
TEST(RangeOfFloat, boxes_all_but_parallel_overlap_as_far_at_any_size) {
  constexpr float lean = 1e-10F;
  Mat3<float> axes;
  axes << 1, -lean, lean / 3, lean, 1, lean / 2, -lean / 3, -lean / 2, 1;
  const Aabb<float> a{{0, 0, 0}, {1, 1, 1}};
  const Obb<float> b{{0.5F, 0.25F, 0.125F}, {1, 1, 1}, axes};
  for (const int e : {0, -60, -110, -118}) {
    const Aabb<float> tiny_a = scaled(a, e);
    const Obb<float> tiny_b = scaled(b, e);
    EXPECT_TRUE(overlaps(tiny_a, tiny_b)) << e;
    EXPECT_EQ(std::ldexp(separation(tiny_a, tiny_b).distance, -e), -1.5F) << e;
    EXPECT_EQ(std::ldexp(contact(tiny_a, tiny_b)->penetration, -e), 1.5F) << e;
  }
}

// ---- Which axes an oriented box may have.

template <class S> class ObbAxes : public ::testing::Test {
 protected:
  /// A box with one number of its axes off by so much.
  static Obb<S> off_by(int row, int column, const S& off) {
    Obb<S> box{{0, 0, 0}, {1, 1, 1}};
    box.axes(row, column) += off;
    return box;
  }
};
TYPED_TEST_SUITE(ObbAxes, Scalars, ScalarNames);

TYPED_TEST(ObbAxes, are_upright_where_they_are_left_out) {
  EXPECT_EQ(this->off_by(0, 0, TypeParam(0)).axes, Mat3<TypeParam>::Identity());
}

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

// ---- Rays against balls and boxes.

template <class S> class Rays : public ByHand<S> {
 protected:
  /// Both shapes, for what must hold for either: their faces at x = -1 and x = 1.
  template <class Check> void each_shape(const Check& check) const {
    check(this->ball);
    check(this->box);
  }
};
TYPED_TEST_SUITE(Rays, Scalars, ScalarNames);

TYPED_TEST(Rays, hit_from_outside_by_lengths_of_their_direction) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    expect_hit({{-5, 0, 0}, {1, 0, 0}}, shape, 4, {-1, 0, 0});
    expect_hit({{-5, 0, 0}, {8, 0, 0}}, shape, 0.5, {-1, 0, 0});
    expect_hit({{5, 0, 0}, {-0.5, 0, 0}}, shape, 8, {1, 0, 0});
    EXPECT_EQ(raycast(Ray<S>{{-5, 0, 0}, {1, 0, 0}}, shape)->point, Vec3<S>(-1, 0, 0));
    EXPECT_FALSE(raycast(Ray<S>{{5, 0, 0}, {1, 0, 0}}, shape));  // behind and beside
    EXPECT_FALSE(raycast(Ray<S>{{-5, 4, 0}, {1, 0, 0}}, shape));
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {0, 1, 0}}, shape));
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {0, 0, 0}}, shape));  // no direction
  });
}

TYPED_TEST(Rays, max_t_is_the_last_that_counts) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    expect_hit({{-5, 0, 0}, {1, 0, 0}, 4}, shape, 4, {-1, 0, 0});
    EXPECT_FALSE(raycast(Ray<S>{{-5, 0, 0}, {1, 0, 0}, next_down(S(4))}, shape));
    expect_hit({{0, 0, 0}, {1, 0, 0}, 0}, shape, 0, {0, 0, 0});
    EXPECT_FALSE(raycast(Ray<S>{{0, 0, 0}, {1, 0, 0}, -1}, shape));
  });
}

TYPED_TEST(Rays, a_start_inside_or_touching_hits_at_once_without_a_normal) {
  using S = TypeParam;
  this->each_shape([](const auto& shape) {
    for (const Vec3<S>& start : {Vec3<S>(0.25, 0, 0.5), Vec3<S>(1, 0, 0), Vec3<S>(0, 0, 0)}) {
      for (const Vec3<S>& direction : {Vec3<S>(1, 0, 0), Vec3<S>(-1, 0, 0), Vec3<S>(0, 0, 0)}) {
        expect_hit({start, direction}, shape, 0, {0, 0, 0});
        EXPECT_EQ(raycast(Ray<S>{start, direction}, shape)->point, start);
      }
    }
  });
}

TYPED_TEST(Rays, graze_a_ball_and_meet_a_point_to_the_bit) {
  using S = TypeParam;
  const Sphere<S> point{{0, 0, 0}, 0};
  expect_hit({{-4, 1, 0}, {8, 0, 0}}, this->ball, 0.5, {0, 1, 0});
  EXPECT_FALSE(raycast(Ray<S>{{-4, next_up(S(1)), 0}, {8, 0, 0}}, this->ball));
  EXPECT_TRUE(raycast(Ray<S>{{-4, next_down(S(1)), 0}, {8, 0, 0}}, this->ball));
  EXPECT_EQ(raycast(Ray<S>{{-2, -4, -6}, {1, 2, 3}}, point)->t, S(2));
  EXPECT_FALSE(raycast(Ray<S>{{-2, -4, next_up(S(6))}, {1, 2, -3}}, point));
  EXPECT_TRUE(raycast(Ray<S>{{-2, -4, -6}, {1, 2, 3}}, Aabb<S>{{0, 0, 0}, {0, 0, 0}}));
}

TYPED_TEST(Rays, a_point_of_a_turned_box_is_hit_at_every_size) {
  using S = TypeParam;
  const Obb<S> point{{0, 0, 0}, {0, 0, 0}, turn_in_plane(0, 1, S(0.8), S(0.6))};
  const auto here = raycast(Ray<S>{{0, -8, 0}, {0, 8, 0}}, point);
  ASSERT_TRUE(here.has_value());
  EXPECT_EQ(here->t, S(1));
  const int lowest = std::max(-20'000, std::numeric_limits<S>::min_exponent - std::numeric_limits<S>::digits);
  for (int e = lowest; e < 0; e += 7) {
    const auto hit = raycast(Ray<S>{{0, -power<S>(e + 3), 0}, {0, power<S>(e + 3), 0}}, point);
    ASSERT_TRUE(hit.has_value()) << e;
    EXPECT_EQ(hit->t, here->t) << e;
    EXPECT_EQ(hit->normal, here->normal) << e;
  }
}

TYPED_TEST(Rays, meet_the_faces_edges_and_corners_of_a_box) {
  using S = TypeParam;
  const auto meets = [](const Ray<S>& ray, const Aabb<S>& target) { return raycast(ray, target).has_value(); };
  EXPECT_TRUE(meets({{-5, 2, 0}, {1, 0, 0}}, this->box));   // along the face: closed
  EXPECT_TRUE(meets({{-5, -2, 3}, {1, 0, 0}}, this->box));  // along the edge
  EXPECT_FALSE(meets({{-5, next_up(S(2)), 0}, {1, 0, 0}}, this->box));
  EXPECT_FALSE(meets({{-5, 0, -next_up(S(3))}, {1, 0, 0}}, this->box));
  EXPECT_TRUE(meets({{-5, S(-S(0)), 0}, {1, S(-S(0)), 0}}, this->box));
  EXPECT_TRUE(meets({{-2, 1, 0}, {1, 1, 0}}, this->box));  // grazes the edge at (-1, 2)
  EXPECT_FALSE(meets({{-2, next_up(S(1)), 0}, {1, 1, 0}}, this->box));
  EXPECT_EQ(raycast(Ray<S>{{-3, 0, 0}, {1, 1, 0}}, this->box)->t, S(2));  // by an edge
  const auto corner = raycast(Ray<S>{{-3, -4, 5}, {2, 2, -2}}, this->box);
  ASSERT_TRUE(corner.has_value());
  EXPECT_EQ(corner->t, S(1));
  EXPECT_EQ(corner->point, Vec3<S>(-1, -2, 3));
  const Aabb<S> plate{{1, 0, 0}, {0, 8, 8}};
  expect_hit({{0, 0, 0}, {2, 0, 0}}, plate, 0.5, {-1, 0, 0});
  expect_hit({{2, 0, 0}, {-2, 0, 0}}, plate, 0.5, {1, 0, 0});
  EXPECT_TRUE(meets({{1, -10, 0}, {0, 1, 0}}, plate));                               // within its plane
  EXPECT_TRUE(meets({{0, S(1) / S(3), 0}, {S(1) / S(7), S(1) / S(11), 0}}, plate));  // inexact
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

}  // namespace
}  // namespace thinwall::testing
