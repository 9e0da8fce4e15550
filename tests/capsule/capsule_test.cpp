// The capsule at one instant, by hand.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/capsule/capsule_from.hpp>
#include <thinwall/capsule/clear_segment_box.hpp>

#include "support/any_number.hpp"
#include "support/contacts.hpp"
#include "support/portable_draw.hpp"
#include "support/real.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

template <class S> class CapsuleQueries : public ::testing::Test {
 protected:
  const Capsule<S> rod{{-2, 0, 0}, {2, 0, 0}, 0.5};
};
TYPED_TEST_SUITE(CapsuleQueries, Scalars, ScalarNames);

TYPED_TEST(CapsuleQueries, a_ball_at_the_side_and_at_the_caps) {
  using S = TypeParam;
  expect_gap(this->rod, Sphere<S>{{1, 1.5, 0}, 1}, 0, {0, 1, 0});
  EXPECT_FALSE(overlaps(this->rod, Sphere<S>{{1, next_up(S(1.5)), 0}, 1}));
  EXPECT_TRUE(overlaps(this->rod, Sphere<S>{{5, 0, 4}, 4.5}));  // 3-4-5 from the end
  EXPECT_FALSE(overlaps(this->rod, Sphere<S>{{5, 0, 4}, next_down(S(4.5))}));
  const Capsule<S> capsule{{2, 8, 0}, {6, 8, 0}, 0.5};
  const Sphere<S> above{{5, 9, 0}, 1};
  EXPECT_EQ(center(capsule), Vec3<S>(4, 8, 0));
  expect_gap(capsule, above, -0.5, {0, 1, 0});
  expect_contact_at(capsule, above, {1, 0.5, 0}, {0, -1, 0});  // from the middle
}

TYPED_TEST(CapsuleQueries, without_length_is_a_ball) {
  using S = TypeParam;
  const Capsule<S> point{{1, 2, 3}, {1, 2, 3}, 0.5};
  const Sphere<S> ball{{1, 2, 3}, 0.5};
  const auto as_a_ball = [&](const auto& other) {
    const Separation<S> as_ball = separation(ball, other);
    expect_gap(point, other, as_ball.distance, as_ball.normal);
  };
  as_a_ball(Sphere<S>{{1, 3, 3}, 1});
  as_a_ball(Aabb<S>{{1, 2, 5}, {1, 1, 1}});
  expect_gap(point, point, -1, {1, 0, 0});
  expect_gap(point, ball, -1, {1, 0, 0});
  expect_gap(ball, point, -1, {1, 0, 0});
  const Ray<S> ray{{-4, 2.25, 3.25}, {1, 0.03125, 0}};
  const auto hit = raycast(ray, ball);
  ASSERT_TRUE(hit.has_value());
  expect_hit(ray, point, hit->t, hit->normal);
}

TYPED_TEST(CapsuleQueries, cores_that_meet_part_across_both) {  // along x, as the rod's core runs, will not do
  using S = TypeParam;
  const Sphere<S> ball{{1, 0, 0}, 0.25};
  expect_gap(this->rod, ball, -0.75, {0, 1, 0});
  expect_gap(ball, this->rod, -0.75, {0, 1, 0});
  expect_gap(Capsule<S>{{0, -2, 0}, {0, 2, 0}, 0.5}, Sphere<S>{{0, 1, 0}, 0.25}, -0.75, {1, 0, 0});
  expect_gap(this->rod, Capsule<S>{{0, -2, 0}, {0, 2, 0}, 0.25}, -0.75, {0, 0, 1});
  expect_gap(this->rod, this->rod, -1, {0, 1, 0});
}

TYPED_TEST(CapsuleQueries, crossed_parallel_and_collinear) {
  using S = TypeParam;
  expect_gap(this->rod, Capsule<S>{{0, -2, 1}, {0, 2, 1}, 0.5}, 0, {0, 0, 1});
  EXPECT_FALSE(overlaps(this->rod, Capsule<S>{{0, -2, next_up(S(1))}, {0, 2, next_up(S(1))}, 0.5}));
  expect_gap(this->rod, Capsule<S>{{-1, 3, 0}, {5, 3, 0}, 0.5}, 2, {0, 1, 0});
  expect_gap(this->rod, Capsule<S>{{5, 0, 0}, {9, 0, 0}, 0.5}, 2, {1, 0, 0});
  const Capsule<S> crossed{{1, -2, 3}, {1, 2, 3}, 0.5};
  expect_gap(this->rod, crossed, 2, {0, 0, 1});
  EXPECT_EQ(separation(this->rod, crossed).point_a, Vec3<S>(1, 0, 0.5));
  EXPECT_EQ(separation(this->rod, crossed).point_b, Vec3<S>(1, 0, 2.5));
}

TYPED_TEST(CapsuleQueries, a_box_beside_the_core_at_its_ends_and_around_it) {
  using S = TypeParam;
  expect_gap(this->rod, Aabb<S>{{0, 1.5, 0}, {8, 1, 1}}, 0, {0, 1, 0});
  EXPECT_FALSE(overlaps(this->rod, Aabb<S>{{0, next_up(S(1.5)), 0}, {8, 1, 1}}));
  EXPECT_TRUE(overlaps(Aabb<S>{{3.5, 0, 0}, {1, 1, 1}}, this->rod));
  EXPECT_EQ(separation(this->rod, Aabb<S>{{6, 5, 0}, {1, 1, 1}}).distance, S(4.5));  // 3-4-5 to an edge
  const Aabb<S> around{{0, 0.25, 0}, {1, 1, 3}};
  expect_gap(this->rod, around, -1.25, {0, 1, 0});                   // the box goes up, the shorter way
  EXPECT_EQ(contact(this->rod, around)->local_b, Vec3<S>(0, 0, 0));  // a box along the axes must not turn
}

TYPED_TEST(CapsuleQueries, a_core_without_radius_pierces_a_plate_without_thickness) {
  using S = TypeParam;
  const Aabb<S> plate{{0, 0, 0}, {0, 8, 8}};
  for (int i = 1; i <= 40; ++i) {  // slopes that no scalar holds exactly
    const S tilt = S(i) / S(7), end = S(i) / S(3);
    const Capsule<S> needle{{-end, tilt, S(1) / S(9)}, {S(1), -tilt / S(11), S(0)}, S(0)};
    EXPECT_TRUE(overlaps(needle, plate)) << i;
    EXPECT_TRUE(overlaps(plate, needle)) << i;
    EXPECT_TRUE(contact(needle, plate).has_value()) << i;
  }
  EXPECT_FALSE(overlaps(Capsule<S>{{-1, 9, 0}, {1, 9, 0}, 0}, plate));
  EXPECT_FALSE(overlaps(Capsule<S>{{-2, 0, 0}, {-1, 0, 0}, 0}, plate));
}

TYPED_TEST(CapsuleQueries, a_core_that_lies_on_a_narrow_beam_touches_it_there) {
  using S = TypeParam;
  const S tilt = unit<S>();  // too little to tell from lying flat
  const Capsule<S> plank{{-1, S(-tilt), 0}, {64, tilt, 0}, 0.25};
  const Separation<S> gap = separation(plank, Aabb<S>{{0, -1, 0}, {0.5, 1, 0.5}});
  EXPECT_TRUE(gap.point_a[0] >= S(-1) && gap.point_a[0] <= S(1)) << gap.point_a.transpose();
}

// ---- Rays at it.

template <class S> using CapsuleRays = CapsuleQueries<S>;
TYPED_TEST_SUITE(CapsuleRays, Scalars, ScalarNames);

TYPED_TEST(CapsuleRays, along_the_core_meet_the_caps) {
  using S = TypeParam;
  expect_hit({{-5, 0, 0}, {1, 0, 0}}, this->rod, 2.5, {-1, 0, 0});
  EXPECT_EQ(raycast(Ray<S>{{5, 0.5, 0}, {-1, 0, 0}}, this->rod)->t, S(3));  // grazes the side from end to end
  EXPECT_FALSE(raycast(Ray<S>{{5, next_up(S(0.5)), 0}, {-1, 0, 0}}, this->rod));
  EXPECT_EQ(raycast(Ray<S>{{4, 0.25, 0}, {-2, 0, 0}}, this->rod)->normal[2], S(0));
  EXPECT_FALSE(raycast(Ray<S>{{4, 0.25, 0}, {0, 1, 0}}, this->rod));  // from in the cylinder beyond an end
  EXPECT_FALSE(raycast(Ray<S>{{4, 0, 0}, {1, 0, 0}}, this->rod));
  EXPECT_FALSE(raycast(Ray<S>{{2.5, 4, 0}, {0.125, -4, 0}}, this->rod));  // passes the cap
}

TYPED_TEST(CapsuleRays, inside_and_touching_hit_at_once) {
  using S = TypeParam;
  for (const Vec3<S>& start : {Vec3<S>(0, 0, 0), Vec3<S>(1, 0.25, 0), Vec3<S>(2.5, 0, 0), Vec3<S>(0, 0.5, 0)}) {
    expect_hit({start, {0, 1, 0}}, this->rod, 0, {0, 0, 0});
    EXPECT_EQ(raycast(Ray<S>{start, {0, 1, 0}}, this->rod)->point, start);
  }
  expect_hit({{1, 0, 0}, {0, 0, 0}}, this->rod, 0, {0, 0, 0});
  EXPECT_FALSE(raycast(Ray<S>{{1, 1, 0}, {0, 0, 0}}, this->rod));
  EXPECT_TRUE(raycast(Ray<S>{{1, 4.5, 0}, {0, -8, 0}, 0.5}, this->rod));  // as far as max_t
  EXPECT_FALSE(raycast(Ray<S>{{1, 4.5, 0}, {0, -8, 0}, next_down(S(0.5))}, this->rod));
}

TYPED_TEST(CapsuleRays, a_start_within_a_rounding_of_the_side_is_no_miss) {
  using S = TypeParam;
  for (int i = 0; i < 200; ++i) {  // on the side of a slanted capsule, as near as the scalar can say
    const Vec3<S> axis(S(3) / S(7), S(i + 1) / S(11), S(5) / S(13));
    const Vec3<S> across = cross(axis, Vec3<S>(0, 0, 1)).normalized();
    const Capsule<S> capsule{-axis, axis, S(1) / S(3)};
    const Vec3<S> start = axis * (S(i % 9 - 4) / S(5)) + across * capsule.radius;
    const auto hit = raycast(Ray<S>{start, Vec3<S>(-across)}, capsule);
    ASSERT_TRUE(hit.has_value()) << i;
    EXPECT_TRUE(hit->t <= 64 * unit<S>() * (S(1) + axis.norm())) << i << " " << hit->t;
  }
}

// ---- A capsule by center, axis, height and radius.

template <class S> class CapsuleFrom : public ::testing::Test {};
TYPED_TEST_SUITE(CapsuleFrom, Scalars, ScalarNames);

TYPED_TEST(CapsuleFrom, height_is_end_to_end) {
  using S = TypeParam;
  const auto c = capsule_from<S>({1, 2, 3}, {0, 0, 5}, 6, 1);
  EXPECT_EQ(c.a, (Vec3<S>(1, 2, 1)));
  EXPECT_EQ(c.b, (Vec3<S>(1, 2, 5)));
  EXPECT_EQ(c.radius, S(1));
  EXPECT_EQ(center(c), (Vec3<S>(1, 2, 3)));
  const auto ball = capsule_from<S>({1, 2, 3}, {1, 1, 1}, 2, 1);  // of two radii
  EXPECT_EQ(ball.a, ball.b);
  EXPECT_TRUE(valid(ball));
}

TYPED_TEST(CapsuleFrom, axis_may_have_any_length) {
  using S = TypeParam;
  const int far = std::min(std::numeric_limits<S>::max_exponent, 16000) - 8;
  const auto unit = capsule_from<S>({0, 0, 0}, {1, -2, 3}, 4, 1);
  for (const int e : {far, -far}) {
    const auto c = capsule_from<S>({0, 0, 0}, times_power_of_two(Vec3<S>(1, -2, 3), e), 4, 1);
    EXPECT_EQ(c.b, unit.b);
  }
}

TYPED_TEST(CapsuleFrom, impossible_sizes_make_no_valid_capsule) {
  using S = TypeParam;
  const auto makes_none = [](const Vec3<S>& axis, const S& height, const S& radius) {
    return !valid(capsule_from<S>({0, 0, 0}, axis, height, radius));
  };
  const Vec3<S> up(0, 0, 1);
  EXPECT_TRUE(makes_none(up, next_down(S(2)), 1));
  EXPECT_TRUE(makes_none(up, 2, -1));
  EXPECT_TRUE(makes_none({0, 0, 0}, 4, 1));
  EXPECT_TRUE(makes_none({0, 0, infinity<S>()}, 4, 1));
  for (const S& bad : {nan<S>(), infinity<S>()}) EXPECT_TRUE(makes_none(up, bad, 1));
  EXPECT_TRUE(makes_none(up, 4, nan<S>()));
  EXPECT_FALSE(overlaps(capsule_from<S>({0, 0, 0}, up, 1, 1), Sphere<S>{{0, 0, 0}, 1}));
}

// ---- Cores that cross, or all but do.

TEST(CrossingCores, part_across_both_at_the_smallest_angle) {
  Shaker<double> draw(5);
  for (int i = 0; i < 2000; ++i) {
    const Vec3<double> d = safe_unit(draw.vector()), e = safe_unit(thinwall::cross<double>(d, draw.vector()));
    if (e == Vec3<double>::Zero()) continue;
    const Vec3<double> beside = d + e * std::ldexp(1.0, -draw.pick(20, 46));
    const Capsule<double> a{-d, d, 0.5}, b{-beside, beside, 0.5};
    const auto found = contact(a, b);
    ASSERT_TRUE(found);
    const Capsule<double> parted = moved<double>(b, Vec3<double>(found->normal * found->penetration));
    EXPECT_NEAR(separation(a, parted).distance, 0, 1e-13) << i;
  }
}

/// [length] What is between two shapes, or what they overlap by, once the contact is undone.
template <class A, class B> double left_over(const A& a, const B& b) {
  const auto found = contact(a, b);
  if (!found) return std::numeric_limits<double>::infinity();
  const Vec3<long double> by = found->normal.template cast<long double>() * found->penetration;
  return static_cast<double>(separation(cast<long double>(a), moved<long double>(cast<long double>(b), by)).distance);
}

// Beside the length of the core the gap is short, and along the core it is rounding.
TEST(CrossingCores, what_is_just_beside_a_core_leaves_across_it) {
  Shaker<double> draw(7);
  for (int i = 0; i < 2000; ++i) {
    const Vec3<double> start = draw.plain_vector(), core = draw.plain_vector() + Vec3<double>(2, 0, 0);
    const Vec3<double> beside = draw.plain_vector() * std::ldexp(1.0, -draw.pick(1, 47));
    const Vec3<double> at = start + core * (0.5 + 0.4 * draw.plain()) + beside;
    const Capsule<double> rod{start, start + core, 1};
    EXPECT_NEAR(left_over(rod, Sphere<double>{at, 0.5}), 0, 1e-13) << i;
    EXPECT_NEAR(left_over(rod, Aabb<double>{at, {0, 0, 0}}), 0, 1e-13) << i;
    const Vec3<double> other = draw.plain_vector() + Vec3<double>(0, 2, 0);
    EXPECT_NEAR(left_over(rod, Capsule<double>{at - other, at + other, 0.5}), 0, 1e-13) << i;
    EXPECT_NEAR(left_over(rod, Triangle<double>{at - other, at + other, at + Vec3<double>(0, 0, 2)}), 0, 1e-13) << i;
  }
}

TEST(CrossingCores, a_segment_that_lies_in_a_triangle_all_but_touches_it_in_points_of_both) {
  Shaker<double> draw(20261128);
  for (int i = 0; i < 20'000; ++i) {
    const Triangle<double> triangle{draw.plain_vector(), draw.plain_vector(), draw.plain_vector()};
    const Vec3<double> e1 = triangle.b - triangle.a, e2 = triangle.c - triangle.a;
    const double s = std::ldexp(1.0, -draw.pick(0, 8)), t = draw.plain() + 1, u = draw.plain() + 1;
    const Vec3<double> ways = draw.plain_vector() * s, normal = thinwall::cross<double>(e1, e2);
    const Vec3<double> in_plane = e1 * ways[0] + e2 * ways[1];
    const int bits = draw.pick(20, 60);
    const Vec3<double> tilt = normal * std::ldexp(draw.plain(), -bits);
    const Vec3<double> at = triangle.a + e1 * (t / 4) + e2 * (u / 4);
    const Capsule<double> segment{at - in_plane - tilt, at + in_plane + tilt, 0};
    const Separation<double> found = separation(segment, triangle);
    EXPECT_LE(separation(Sphere<double>{found.point_a, 0}, segment).distance, 4e-15) << i;
    EXPECT_LE(separation(Sphere<double>{found.point_b, 0}, triangle).distance, 4e-15) << i;
    EXPECT_LE(safe_norm<double>(found.point_b - found.point_a), std::abs(found.distance) + 4e-15) << i;
  }
}

TEST(CrossingCores, past_the_tip_of_a_triangle_without_area_do_not_cross_it) {
  Shaker<double> draw(20261128);
  const auto tenth = [&] { return 0.1 * draw.pick(0, 20); };
  for (int i = 0; i < 20'000; ++i) {  // in the plane z = 0 the third corner lies between the others, to rounding
    const double x1 = tenth(), y1 = tenth(), x2 = tenth(), y2 = tenth(), part = 0.25 * draw.pick(1, 3);
    const Vec3<double> a(x1, y1, 0), b(x2, y2, 0), at = b + (b - a) * (0.25 * draw.pick(1, 4)), up(0, 0, 1);
    const Triangle<double> needle{a, b, a + (b - a) * part};
    const double expected = separation(Sphere<double>{at, 0.05}, Capsule<double>{a, b, 0}).distance;
    EXPECT_NEAR(separation(Capsule<double>{at - up, at + up, 0.05}, needle).distance, expected, 1e-15) << i;
  }
  for (int e = -350; e > -540; e -= 10) {
    const double s = std::ldexp(1.0, e);
    const Triangle<double> speck{{0, -2 * s, -s}, {0, -3 * s, 3 * s}, {0, 0, -s}};
    EXPECT_NEAR(separation(Capsule<double>{{-1, -1, 1}, {1, -1, 1}, 0.125}, speck).distance, std::sqrt(2.0) - 0.125,
                1e-15)
        << e;
  }
}

TEST(CrossingCores, beside_a_triangle_by_a_few_roundings_do_not_cross_it) {
  const Triangle<double> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const double beside : {3e-15, 1e-15, 1e-17, 1e-30}) {
    const Capsule<double> rod{{0.25, -beside, 1}, {0.25, -beside, -1}, beside / 4};
    EXPECT_FALSE(overlaps(rod, triangle)) << beside;
    EXPECT_NEAR(separation(rod, triangle).distance, beside * 3 / 4, 1e-16) << beside;
  }
}

TEST(CrossingCores, along_a_face_to_rounding_leave_a_box_by_points_that_come_together) {
  Shaker<double> draw(20261128);
  for (int i = 0; i < 20'000; ++i) {
    const Aabb<double> box{{0, 0, 0}, draw.sizes() + Vec3<double>::Constant(1)};
    const int face = draw.pick(0, 2);
    Vec3<double> from = draw.vector() * 4, to = draw.vector() * 4;
    from[face] = 0.5 * draw.plain();
    const int bits = draw.pick(40, 60);
    to[face] = from[face] + std::ldexp(draw.plain(), -bits);
    const Separation<double> found = separation(Capsule<double>{from, to, 0.25}, box);
    const Vec3<double> off = found.point_b - found.point_a - found.normal * found.distance;
    EXPECT_LE(largest(off), 0x1p-46) << i;
    EXPECT_LE(separation(Sphere<double>{found.point_b, 0}, box).distance, 0x1p-46) << i;
  }
}

// ---- Which way a capsule leaves a triangle that its core only touches.

template <class S> class CapsuleOnTriangle : public ::testing::Test {
 protected:
  const Triangle<S> floor{{-4, -4, 0}, {4, -4, 0}, {0, 4, 0}};

  static void expect_normal(const Capsule<S>& capsule, const Triangle<S>& triangle, const Vec3<S>& normal) {
    const Separation<S> there = separation(capsule, triangle), back = separation(triangle, capsule);
    EXPECT_EQ(there.distance, -capsule.radius);
    EXPECT_EQ(there.normal, normal);
    EXPECT_EQ(back.normal, -normal);
    const Triangle<S> parted = moved(triangle, Vec3<S>(normal * capsule.radius));
    EXPECT_EQ(separation(capsule, parted).distance, S(0));
  }
};
TYPED_TEST_SUITE(CapsuleOnTriangle, Scalars, ScalarNames);

TYPED_TEST(CapsuleOnTriangle, leaves_to_the_side_of_its_end_or_upwards_or_across_an_edge) {
  using S = TypeParam;
  const Triangle<S> wire{{-4, 0, 0}, {4, 0, 0}, {0, 0, 0}};
  this->expect_normal({{0, 0, 0}, {0, 0, 2}, 0.5}, this->floor, {0, 0, -1});
  this->expect_normal({{0, 0, -2}, {0, 0, 0}, 0.5}, this->floor, {0, 0, 1});
  this->expect_normal({{0, 0, 0}, {1, 1, 2}, 0.5}, this->floor, {0, 0, -1});
  this->expect_normal({{-1, -1, 0}, {1, -1, 0}, 0.5}, this->floor, {0, 0, 1});
  this->expect_normal({{0, -4, -1}, {0, -4, 1}, 0.5}, this->floor, {0, 1, 0});
  this->expect_normal({{-1, -4, -1}, {1, -4, 1}, 0.5}, this->floor, {0, 1, 0});
  this->expect_normal({{0, -1, 0}, {0, 1, 0}, 0.5}, wire, {0, 0, 1});  // no area: it is its edges
}

// Which side of the edge it is on is rounding.
TYPED_TEST(CapsuleOnTriangle, a_core_through_an_edge_leaves_away_from_the_rest) {
  using S = TypeParam;
  Shaker<S> draw(20261127);
  int touching = 0;
  for (int run = 0; run < 2'000; ++run) {
    const Vec3<S> a = draw.plain_vector(), b = draw.plain_vector();
    const Triangle<S> triangle{a, b, draw.plain_vector()};
    const Vec3<S> d = draw.plain_vector(), across = plane_normal(triangle);
    const Vec3<S> on_edge = a + (b - a) * S(S(1) / 2 + draw.plain() / 4);
    const Capsule<S> rod{on_edge - d, on_edge + d, S(1) / 8};
    const S wide = largest(cross<S>(b - a, triangle.c - a));
    if (wide < S(1) / 4 || largest(S(d.dot(across))) < S(1) / 4) continue;
    const Separation<S> gap = separation(rod, triangle);
    ++touching;
    const Triangle<S> parted = moved(triangle, Vec3<S>(gap.normal * -gap.distance));
    EXPECT_GE(separation(rod, parted).distance, -64 * unit<S>()) << run;
  }
  EXPECT_GT(touching, 200);
}

TYPED_TEST(CapsuleOnTriangle, a_ball_on_a_triangle_without_area_leaves_sideways) {
  using S = TypeParam;
  const Capsule<S> ball{{0, 0, 0}, {0, 0, 0}, 1};
  const Triangle<S> wire{{-4, 0, 0}, {4, 0, 0}, {4, 0, 0}};
  const Separation<S> there = separation(ball, wire);  // of which way there is no more to say than that
  EXPECT_EQ(there.normal, (Vec3<S>(0, 1, 0)));
  EXPECT_EQ(separation(ball, moved(wire, there.normal)).distance, S(0));
}

// ---- What is no shape meets nothing: a field that is not finite, a size below zero, axes that lean.

template <class S> class BadShapes : public ::testing::Test {};
TYPED_TEST_SUITE(BadShapes, Scalars, ScalarNames);

template <class A, class B> void expect_no_answer(const A& a, const B& b) {
  EXPECT_FALSE(overlaps(a, b));
  EXPECT_FALSE(contact(a, b));
  EXPECT_NE(separation(a, b).distance, separation(a, b).distance);
}

TYPED_TEST(BadShapes, meet_nothing) {
  using S = TypeParam;
  for_each_type(Shapes<S>{}, []<class A>(TypeTag<A> tag) {
    A shape = usual(tag);
    Ray<S> ray{{-4, 0.25, 0}, {1, 0, 0}};
    with_every_number<S>(ray, [&] { EXPECT_TRUE(valid(ray) || !raycast(ray, shape)); });
    with_every_number<S>(shape, [&](const std::string& name, const S& number) {
      const bool is_axis = name.starts_with("axis"), is_size = name == "radius" || name.starts_with("half");
      const bool is_bad = !is_finite(number) || (is_size && number < 0);
      EXPECT_TRUE(is_bad ? !valid(shape) : is_axis || valid(shape));  // which axes a box may have: ObbAxes
      if (valid(shape)) return;
      EXPECT_FALSE(raycast(ray, shape));
      for_each_type(TypeList<Sphere<S>, Aabb<S>, A>{}, [&]<class B>(TypeTag<B> other) {
        if constexpr (ServedPair<A, B>) {
          expect_no_answer(shape, usual(other));
          expect_no_answer(usual(other), shape);
        }
      });
    });
  });
}

// ---- What a segment and a box tell of their nearest points, place after place.

using packed::value;

TEST(ClearSegmentBox, an_aim_is_met_where_its_part_is_nearest_still) {
  PortableDraw draw(7);
  const auto distance = [](const packed::Lanes& gap) { return std::sqrt(value(dot(gap, gap))); };
  int aimed = 0, nearest = 0, met = 0;
  for (int i = 0; i < 20'000; ++i) {
    const ClearSegmentBox core(packed::lanes(draw.vector(-2, 2)), packed::lanes(draw.vector(0.1, 2)),
                               packed::lanes(draw.vector(-1, 1)));
    const double R = draw.between(0.1, 0.5);
    const packed::Lanes from = packed::lanes(draw.vector(-5, 5));
    if (distance(core.nearest(from).gap) < R) continue;
    const ClearSegmentBox::Aim aim = core.aim(from, core.place(from), packed::both(R * R));
    if (!(value(aim.time) > 0 && value(aim.time) < 20)) continue;
    ++aimed;
    const packed::Lanes there = from + core.v * all(aim.time);
    const ClearNearest at = core.nearest_to(there, aim.s);
    const double afresh = distance(core.nearest(there).gap);
    EXPECT_GE(distance(at.gap), afresh - 1e-13) << "draw " << i;
    if (!core.is_nearest(at, packed::both(1e-14))) continue;
    ++nearest;
    EXPECT_NEAR(distance(at.gap), afresh, 1e-13) << "draw " << i;
    if (std::abs(afresh - R) < 1e-12) ++met;
  }
  EXPECT_GT(nearest, aimed / 2);
  EXPECT_LT(nearest, aimed);
  EXPECT_GT(met, nearest / 20);
}

TEST(ClearSegmentBox, of_a_stretch_that_is_all_as_near_the_middle_is_told) {
  const ClearSegmentBox core(packed::lanes(Vec3<double>(1, 0, 0)), packed::all(1), packed::all(0));
  EXPECT_EQ(value(core.place(packed::lanes(Vec3<double>(-3, 2, 0)))), 1) << "its end is nearest";
  EXPECT_EQ(value(core.place(packed::lanes(Vec3<double>(-1.5, 2, 0)))), 0.75) << "half of it is above the face";
}

}  // namespace
}  // namespace thinwall::testing
