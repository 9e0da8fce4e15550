// Swept volumes and naive bounds hold the moving shape at every time, checked without rounding.

#include <thinwall/swept/swept_volume.hpp>
#include <vector>

#include <gtest/gtest.h>

#include "support/real.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

using oracle::lift;
using oracle::lift_vector;
using oracle::Real;
using oracle::Vector;

/// Points and a radius whose convex hull, rounded, is the shape: exactly.
struct Hull {
  std::vector<Vector> points;
  Real radius = 0;
};

template <class S> Hull hull(const Sphere<S>& s) { return {{lift_vector(s.center)}, lift(s.radius)}; }
template <class S> Hull hull(const Capsule<S>& c) { return {{lift_vector(c.a), lift_vector(c.b)}, lift(c.radius)}; }
template <class S> Hull hull(const Triangle<S>& t) {
  return {{lift_vector(t.a), lift_vector(t.b), lift_vector(t.c)}, 0};
}
template <class S> Hull hull(const Obb<S>& box) {
  Hull corners;
  for (int corner = 0; corner < 8; ++corner) {
    Vector point = lift_vector(box.center);
    for (int i = 0; i < 3; ++i) {
      const Real side = lift(box.half_extents[i]) * ((corner >> i & 1) != 0 ? 1 : -1);
      point = point + side * lift_vector(Vec3<S>(box.axes.col(i)));
    }
    corners.points.push_back(point);
  }
  return corners;
}
template <class S> Hull hull(const Aabb<S>& box) { return hull(to_obb(box)); }

/// The hull of the moving shape at the start and the end: convex bounds that hold both hold everything between.
template <class A> Hull hull(const Moving<A>& m) {
  Hull all = hull(m.shape);
  for (std::size_t i = 0, n = all.points.size(); i < n; ++i) {
    all.points.push_back(all.points[i] + lift_vector(m.displacement));
  }
  return all;
}

template <class S> bool contains(const Aabb<S>& box, const Hull& shape) {
  for (const Vector& p : shape.points) {
    const Vector off = oracle::magnitude(p - lift_vector(box.center));
    for (std::size_t i = 0; i < 3; ++i) {
      if (off[i] + shape.radius > lift(box.half_extents[static_cast<Eigen::Index>(i)])) return false;
    }
  }
  return true;
}
template <class S> bool contains(const Sphere<S>& ball, const Hull& shape) {
  const Real room = lift(ball.radius) - shape.radius;
  for (const Vector& p : shape.points) {
    const Vector off = p - lift_vector(ball.center);
    if (room < 0 || oracle::dot(off, off) > room * room) return false;
  }
  return true;
}

template <class A> Moving<A> drawn_moving(Shaker<typename A::Scalar>& draw) {
  using S = typename A::Scalar;
  const A shape = drawn(draw, TypeTag<A>{});
  const S speed = power<S>(draw.pick(-30, 30));
  const S far = draw.pick(0, 3) == 0 ? power<S>(20) : S(1);
  return {moved(shape, Vec3<S>(draw.vector() * far)), draw.vector() * speed};
}

template <class A> class SweptBoundsProperty : public ::testing::Test {};
using Bounded =
    ::testing::Types<Sphere<float>, Sphere<double>, Sphere<Wide>, Aabb<float>, Aabb<double>, Aabb<Wide>, Obb<float>,
                     Obb<double>, Triangle<float>, Triangle<double>, Capsule<float>, Capsule<double>>;
TYPED_TEST_SUITE(SweptBoundsProperty, Bounded);

TYPED_TEST(SweptBoundsProperty, hold_the_shape_at_every_time) {
  using S = typename TypeParam::Scalar;
  Shaker<S> draw(1);
  for (int run = 0; run < 2000; ++run) {
    const auto m = drawn_moving<TypeParam>(draw);
    const auto bounds = swept_bounds(m);
    ASSERT_TRUE(contains(bounds, hull(m))) << run;
    ASSERT_TRUE(contains(bounds, hull(pose_at(m, S(draw.plain() / S(2) + S(1) / S(2)))))) << run << ": a rounded pose";
    Vec3<S> half = half_widths(m.shape);
    if constexpr (std::is_same_v<TypeParam, Triangle<S>>) {  // of which they are around the centroid
      const auto& [a, b, c] = m.shape;
      half = (a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c)) / S(2);
    }
    const Vec3<S> spare = bounds.half_extents - (half + m.displacement.cwiseAbs() / S(2));
    ASSERT_LE(largest(spare), 16 * unit<S>() * (largest(center(m.shape)) + largest(bounds.half_extents))) << run;
  }
}

template <class S> class SweptVolume : public ::testing::Test {};
TYPED_TEST_SUITE(SweptVolume, Scalars, ScalarNames);

TYPED_TEST(SweptVolume, enclosing_sphere_box_and_capsule_hold_the_shape_at_every_time) {
  using S = TypeParam;
  Shaker<S> draw(2);
  for (int run = 0; run < 2000; ++run) {
    const auto ball = drawn_moving<Sphere<S>>(draw);
    ASSERT_TRUE(contains(enclosing_sphere(ball), hull(ball))) << run;
    const Capsule<S> capsule = swept_volume(ball);  // its way and its radius
    ASSERT_EQ(capsule.a, ball.shape.center) << run;
    ASSERT_EQ(capsule.b, Vec3<S>(ball.shape.center + ball.displacement)) << run;
    ASSERT_EQ(capsule.radius, ball.shape.radius) << run;
    const S tight = ball.shape.radius + safe_norm(ball.displacement) / S(2);
    ASSERT_LE(enclosing_sphere(ball).radius - tight, 64 * unit<S>() * (largest(ball.shape.center) + tight)) << run;
    const auto box = drawn_moving<Aabb<S>>(draw);
    ASSERT_TRUE(contains(enclosing_aabb(box), hull(box))) << run;
  }
}

TYPED_TEST(SweptVolume, oriented_box_holds_the_moving_box_and_touches_it_on_every_side) {
  using S = TypeParam;
  Shaker<S> draw(3);
  for (int run = 0; run < 1000; ++run) {
    const auto m = drawn_moving<Aabb<S>>(draw);
    const Obb<S> box = swept_volume(m);
    ASSERT_TRUE(valid(box)) << run;
    const Real allowed =
        16 * lift(unit<S>()) *
        lift(S(m.shape.center.cwiseAbs().sum() + m.shape.half_extents.sum() + m.displacement.cwiseAbs().sum()));
    for (int i = 0; i < 3; ++i) {
      Real reach = 0;
      for (const Vector& p : hull(m).points) {
        const Real off = abs(oracle::dot(p - lift_vector(box.center), lift_vector(Vec3<S>(box.axes.col(i)))));
        reach = off > reach ? off : reach;
      }
      ASSERT_LE(abs(Real(reach - lift(box.half_extents[i]))), allowed) << run << " axis " << i;
    }
  }
}

TYPED_TEST(SweptVolume, oriented_box_has_an_axis_along_the_motion_and_least_volume) {
  using S = TypeParam;
  using std::cos, std::sin, std::acos;
  Shaker<S> draw(4);
  for (int run = 0; run < 30; ++run) {
    const auto m = drawn_moving<Aabb<S>>(draw);
    const Obb<S> box = swept_volume(m);
    const Vec3<S> along = safe_unit(m.displacement);
    int axis = 0;
    while (axis < 3 && !nearly_parallel(along, Vec3<S>(box.axes.col(axis)))) ++axis;
    if (along == Vec3<S>::Zero()) continue;
    ASSERT_LT(axis, 3) << run;
    const Vec3<S> h = m.shape.half_extents;
    const Vec3<S> first = box.axes.col((axis + 1) % 3), second = box.axes.col((axis + 2) % 3);
    const auto area = [&](const Vec3<S>& u, const Vec3<S>& v) { return h.dot(u.cwiseAbs()) * h.dot(v.cwiseAbs()); };
    const S found = box.half_extents[(axis + 1) % 3] * box.half_extents[(axis + 2) % 3];
    ASSERT_LE(largest(S(found - area(first, second))), 64 * unit<S>() * found);
    for (int step = 0; step < 500; ++step) {
      const S angle = S(acos(S(0))) * S(step) / S(500);
      const S c = cos(angle), s = sin(angle);
      ASSERT_LE(found, area(first * c + second * s, second * c - first * s) * (1 + 64 * unit<S>()))
          << run << " " << step;
    }
  }
}

TYPED_TEST(SweptVolume, oriented_box_of_motion_along_an_axis_or_of_none_is_exact) {
  using S = TypeParam;
  const Aabb<S> start{{1, 2, 3}, {1, 0, 4}};
  for (int axis = 0; axis < 3; ++axis) {
    for (const S& far : {S(3), S(-6), S(0)}) {
      const Obb<S> box = swept_volume(Moving<Aabb<S>>{start, axis_vector<S>(axis) * far});
      EXPECT_EQ(box.axes, (Mat3<S>::Identity()));
      EXPECT_EQ(box.center, (Vec3<S>(start.center + axis_vector<S>(axis) * (far / 2))));
      EXPECT_EQ(box.half_extents, (Vec3<S>(start.half_extents + axis_vector<S>(axis) * (largest(far) / 2))));
    }
  }
}

TYPED_TEST(SweptVolume, oriented_box_of_a_plate_and_a_point) {
  using S = TypeParam;
  const Obb<S> point = swept_volume(Moving<Aabb<S>>{{{0, 0, 0}, {0, 0, 0}}, {2, 3, 6}});
  EXPECT_TRUE(valid(point));
  EXPECT_LE(largest(S(point.half_extents[0] - S(7) / S(2))), 4 * unit<S>());
  EXPECT_EQ(point.half_extents[1] + point.half_extents[2], S(0));
  const Obb<S> plate = swept_volume(Moving<Aabb<S>>{{{0, 0, 0}, {1, 1, 0}}, {3, 4, 0}});  // within its plane
  EXPECT_EQ(plate.half_extents.minCoeff(), S(0));
}

TYPED_TEST(SweptVolume, oriented_box_at_any_scale) {
  using S = TypeParam;
  const Moving<Aabb<S>> m{{{0, 0, 0}, {1, 2, 3}}, {2, 3, 6}};
  const Obb<S> here = swept_volume(m);
  const int far = std::min(std::numeric_limits<S>::max_exponent, 16000) - 8;
  for (const int e : {far, -far}) {
    const Obb<S> there = swept_volume(scaled(m, e));
    EXPECT_EQ(there.axes, here.axes);
    EXPECT_EQ(times_power_of_two(there.half_extents, -e), here.half_extents);
  }
}

TYPED_TEST(SweptVolume, bounds_of_a_triangle_are_those_of_its_corners) {
  using S = TypeParam;
  const Aabb<S> box = swept_bounds(Moving<Triangle<S>>{{{0, 0, 0}, {0, 0, 0}, {3, 0, 0}}, {0, 1, 0}});
  const auto at = [](const S& x, double expected) { EXPECT_NEAR(double(x), expected, 64 * double(unit<S>())); };
  at(box.center[0] - box.half_extents[0], 0);
  at(box.center[0] + box.half_extents[0], 3);
  at(box.center[1] + box.half_extents[1], 1);
}

TYPED_TEST(SweptVolume, oriented_box_is_one_whatever_vanishes_beside_the_motion) {
  using S = TypeParam;
  const S least = std::numeric_limits<S>::denorm_min();
  for (const S& aside : {least, S(20 * least), S(least / unit<S>()), unit<S>()}) {
    const Obb<S> box = swept_volume(Moving<Aabb<S>>{{{0, 0, 0}, {1, 1, 1}}, {0, -4, aside}});
    EXPECT_TRUE(valid(box)) << aside;
    EXPECT_TRUE(overlaps(box, Sphere<S>{{0, 0, 0}, S(0.5)})) << aside;
  }
}

}  // namespace
}  // namespace thinwall::testing
