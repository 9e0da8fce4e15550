// The bounds below the gap across a plane, held against that gap in long double: no bound may lie above it, whatever the plane, the motion and
// the time. Boxes around motions and certificates are held against poses of the motion.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <thinwall/swept/certified/turning_certified.hpp>
#include <thinwall/swept/turning/turning_advancement.hpp>
#include <thinwall/swept/turning/turning_bounds.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include <gtest/gtest.h>

#include "support/portable_draw.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {
namespace {

using V = Vec3<double>;
using Wide = long double;
using W = Vec3<Wide>;
constexpr double pi = 3.14159265358979323846;

Sphere<double> shape_at(PortableDraw& draw, const V& at, TypeTag<Sphere<double>>) {
  return {at, draw.between(0.01, 0.5)};
}
Capsule<double> shape_at(PortableDraw& draw, const V& at, TypeTag<Capsule<double>>) {
  const V half = draw.point(1);
  return {at - half, at + half, draw.one_in(3) ? 0 : draw.between(0, 0.2)};
}
Obb<double> shape_at(PortableDraw& draw, const V& at, TypeTag<Obb<double>>) {
  return {at,
          {draw.between(0.01, 1), draw.between(0.01, 1), draw.between(0.01, 1)},
          rotation_about<double>(draw.direction(), draw.between(0, pi))};
}
Triangle<double> shape_at(PortableDraw& draw, const V& at, TypeTag<Triangle<double>>) {
  return {at + draw.point(1), at + draw.point(1), at + draw.point(1)};
}

/// Up to `most` [rad]: at times the same turn as another, about the same axis, or none.
template <class A> Turning<A> motion(PortableDraw& draw, double most, double far) {
  const V at = draw.point(far);
  const A shape = shape_at(draw, at, TypeTag<A>{});
  return {shape, draw.point(2), draw.one_in(5) ? V(V::Zero()) : draw.point(most)};
}

/// visit(TypeTag<A>, TypeTag<B>) for seven of the eight pairs that may turn: two balls have no plane but the one between them.
template <class Visit> void for_each_turning_pair(const Visit& visit) {
  const TypeTag<Sphere<double>> ball;
  const TypeTag<Capsule<double>> rod;
  const TypeTag<Obb<double>> box;
  const TypeTag<Triangle<double>> plate;
  visit(rod, ball);
  visit(box, ball);
  visit(plate, ball);
  visit(rod, rod);
  visit(rod, box);
  visit(rod, plate);
  visit(box, box);
}

/// Rodrigues' formula by itself, on a vector.
W turned_wide(const W& rotation, Wide time, const W& v) {
  const Wide angle = std::sqrt(rotation.squaredNorm());
  if (angle == 0) return v;
  const W axis = rotation / angle;
  const Wide c = std::cos(angle * time), s = std::sin(angle * time);
  return v * c + cross<Wide>(axis, v) * s + axis * (axis.dot(v) * (1 - c));
}

/// A plane as a test has it: what it rides, and the unit vectors it is made of at the time when it is attached.
struct Attached {
  Rides rides;
  V first, second;  ///< the normal; or the edges of A and B
};

/// The gap across the plane at a time, in long double.
Wide true_gap(const TurningPair<double>& pair, const Attached& plane, Wide attached_at, Wide time) {
  const auto wide = [](const V& v) { return W(v.cast<Wide>()); };
  const W x = wide(pair.b.center) - wide(pair.a.center) + (wide(pair.b.path) - wide(pair.a.path)) * time;
  const auto since = [&](const TurningBody<double>& body, Wide from, const V& v) {
    return turned_wide(wide(body.rotation), time - from, wide(v));
  };
  W n = wide(plane.first);
  if (plane.rides == Rides::a) n = since(pair.a, attached_at, plane.first);
  if (plane.rides == Rides::b) n = since(pair.b, attached_at, plane.first);
  if (plane.rides == Rides::edges)
    n = cross<Wide>(since(pair.a, attached_at, plane.first), since(pair.b, attached_at, plane.second));
  const auto reach = [&](const TurningBody<double>& body, Wide side) {
    Wide most = 0;
    for (int k = 0; k < body.core.count; ++k) {
      const Wide along = side * n.dot(since(body, 0, body.core.v[static_cast<std::size_t>(k)]));
      if (body.core.corners) {
        most = k == 0 ? along : std::max(most, along);
      } else {
        most += std::abs(along);
      }
    }
    return most;
  };
  return n.dot(x) - reach(pair.a, 1) - reach(pair.b, -1) - static_cast<Wide>(pair.reach) * std::sqrt(n.squaredNorm());
}

Wide bound_at(const ConcaveBound<double>& bound, Wide tau) {
  Wide value = bound.gap + bound.slope * tau - bound.curvature * tau * tau / 2;
  for (std::size_t k = 0; k < static_cast<std::size_t>(bound.edges); ++k) {
    value -= std::abs(bound.edge[k] + bound.edge_slope[k] * tau);
  }
  Wide most = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(bound.corners); ++k) {
    const Wide line = bound.corner[k] + bound.corner_slope[k] * tau;
    most = k == 0 ? line : std::max(most, line);
  }
  return value - most;
}

/// Checks one plane from one time on. `worst` [margin] is how far the true gap came below the bound with the margin given back.
void check_plane(const TurningPair<double>& pair, const Attached& attached, double time, double& worst) {
  const TurningInstant<double> now = instant(pair, time);
  const AttachedPlane<double> plane = attached.rides == Rides::edges
                                          ? plane_of_edges<double>(pair, now, attached.first, attached.second)
                                          : plane_riding(pair, now, attached.rides, attached.first);
  const TurningInstant<double> later = instant(pair, time + (1 - time) / 3);
  const auto allowed = static_cast<Wide>(pair.margin), attached_at = static_cast<Wide>(time);
  for (const TurningInstant<double>* from : {&now, &later}) {
    const ConcaveBound<double> bound = gap_ahead(pair, plane, *from, curvature_of_centers(pair, plane, now)).bound;
    for (int step = 0; step <= 8; ++step) {
      const Wide start = static_cast<Wide>(from->time), tau = (1 - start) * step * step / 64;
      const Wide gap = true_gap(pair, attached, attached_at, start + tau), below = bound_at(bound, tau);
      ASSERT_GE(gap, below) << "plane " << static_cast<int>(attached.rides) << ", from " << from->time << " by "
                            << static_cast<double>(tau) << ", angles " << pair.a.angle << " " << pair.b.angle;
      if (step == 0) worst = std::max(worst, static_cast<double>((below + allowed - gap) / allowed));
    }
  }
}

template <class A, class B> void check_pair(unsigned count) {
  PortableDraw draw(7);
  double worst = 0;
  for (unsigned i = 0; i < count; ++i) {
    const double most = draw.one_in(3) ? 20 : pi, far = draw.one_in(8) ? 1e4 : 2;
    const Turning<A> a = motion<A>(draw, most, far);
    Turning<B> b = motion<B>(draw, most, far);
    if (draw.one_in(6)) b.rotation = a.rotation;
    if (draw.one_in(6)) b.rotation = -a.rotation * draw.between(0, 1);
    TurningPair<double> pair(a, b, draw.one_in(3) ? 0.1 : 0);
    pair.last = 1;  // whether they can meet or not
    const double time = draw.one_in(3) ? 0 : draw.between(0, 1);
    for (const Rides rides : {Rides::world, Rides::a, Rides::b, Rides::edges}) {
      const V first = draw.direction(), second = draw.direction();
      const bool has_edges = pair.a.core.count > 0 && pair.b.core.count > 0;
      if (has_edges || rides != Rides::edges) check_plane(pair, {rides, first, second}, time, worst);
    }
    if (::testing::Test::HasFatalFailure()) return;
  }
  EXPECT_LT(worst, 0.5) << "of the margin is used up";
}

TEST(AttachedPlanes, are_below_the_gap) {
  const auto count = static_cast<unsigned>(thorough(slow_build ? 300 : 5'000));
  for_each_turning_pair([&]<class A, class B>(TypeTag<A>, TypeTag<B>) { check_pair<A, B>(count); });
}

// The margin takes a sine and a cosine to be right to 2 units in the last place.
TEST(AttachedPlanes, have_the_sines_they_ask_for) {
  PortableDraw draw(7);
  for (int i = 0; i < 100'000; ++i) {
    const double x = draw.between(0, i % 2 == 0 ? pi : 1e6);
    const auto wide = static_cast<Wide>(x);
    EXPECT_LE(std::abs(static_cast<Wide>(std::sin(x)) - std::sin(wide)), 0x1p-52L) << x;
    EXPECT_LE(std::abs(static_cast<Wide>(std::cos(x)) - std::cos(wide)), 0x1p-52L) << x;
  }
}

template <class A> void check_bounds(double most) {
  PortableDraw draw(7);
  double log_volumes = 0;
  constexpr int count = 300;
  for (int i = 0; i < count; ++i) {
    Turning<A> m = motion<A>(draw, most, 2);
    if (draw.one_in(4)) m.displacement = V::Zero();
    const Aabb<double> box = swept_bounds(m);
    const V low = box.center - box.half_extents, high = box.center + box.half_extents;
    V least = V::Constant(std::numeric_limits<double>::infinity()), largest_seen = -least;
    for (int k = 0; k <= 200; ++k) {
      const Aabb<double> pose = swept_bounds(at_rest(pose_at(m, k / 200.0)));
      least = least.cwiseMin(pose.center - pose.half_extents);
      largest_seen = largest_seen.cwiseMax(pose.center + pose.half_extents);
    }
    constexpr double rounding = 1e-14;  // of the poses
    EXPECT_LE((low - least).maxCoeff(), rounding);
    EXPECT_LE((largest_seen - high).maxCoeff(), rounding);
    const V size = V::Constant(1e-3), mine = high - low + size, tightest = largest_seen - least + size;
    log_volumes += std::log((mine[0] * mine[1] * mine[2]) / (tightest[0] * tightest[1] * tightest[2]));
  }
  const double ratio = std::exp(log_volumes / count);
  EXPECT_LT(ratio, most < 6 ? 1.1 : 2.0);
}

TEST(TurningBounds, contain_every_pose_and_little_more) {
  for (const double most : {0.4, 1.6, 3.2, 5.9, 20.0, 1e6}) {
    check_bounds<Sphere<double>>(most);
    check_bounds<Capsule<double>>(most);
    check_bounds<Obb<double>>(most);
    check_bounds<Triangle<double>>(most);
  }
}

TEST(TurningBounds, hold_at_any_scale) {
  PortableDraw draw(7);
  for (const int e : {-1060, -700, -200, 200, 700, 1000}) {
    Turning<Capsule<double>> m = motion<Capsule<double>>(draw, 2, 2);
    const Aabb<double> near = swept_bounds(m), there = swept_bounds(scaled(m, e));
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(there.half_extents[i], std::ldexp(near.half_extents[i], e) * (1 - 1e-12)) << e;
      EXPECT_LE(there.half_extents[i], std::ldexp(near.half_extents[i], e) * (1 + 1e-12) + 1e-321) << e;
    }
  }
}

TEST(TurningBounds, are_those_of_the_orbit_from_a_full_turn_on) {
  Turning<Obb<double>> plank{{V(0, 0, 0), V(2, 0.1, 0.1), Mat3<double>::Identity()}, V::Zero(), V(0, 0, 7)};
  const Aabb<double> orbit = swept_bounds(plank);
  for (const double angle : {1e15, 1e100, std::numeric_limits<double>::max()}) {
    plank.rotation[2] = angle;
    EXPECT_EQ(swept_bounds(plank).half_extents, orbit.half_extents) << angle;
  }
}

TEST(TurningBounds, axes_of_a_box_are_no_lengths) {
  const Turning<Obb<double>> plank{{V(0, 0, 0), V(2, 0.1, 0.1), Mat3<double>::Identity()}, V(4, 0, 0), V(0, 0, 0.5)};
  const Turning<Sphere<double>> ball{{V(5, 0, 0), 0.5}, V::Zero(), V::Zero()};
  const Toi<double> toi = time_of_impact(plank, ball), early = time_of_impact(Speculative<double>{}, plank, ball);
  ASSERT_EQ(toi.status, ToiStatus::hit);
  const Aabb<double> bounds = swept_bounds(plank);
  const CertifiedToi proven = certified_time_of_impact(plank, ball);
  for (const int e : {-40, -540, -900}) {
    EXPECT_EQ(time_of_impact(scaled(plank, e), scaled(ball, e)).time, toi.time) << e;
    EXPECT_EQ(time_of_impact(Speculative<double>{}, scaled(plank, e), scaled(ball, e)).time, early.time) << e;
    EXPECT_EQ(certified_time_of_impact(scaled(plank, e), scaled(ball, e)), proven) << e;
    const V there = times_power_of_two(swept_bounds(scaled(plank, e)).half_extents, -e);
    EXPECT_LE((there - bounds.half_extents).cwiseAbs().maxCoeff(), 1e-12) << e;
  }
}

TEST(TurningBounds, a_turn_whose_angle_is_no_number_is_given_up) {
  const double most = std::numeric_limits<double>::max();
  const Turning<Capsule<double>> rod{{V(0, 0, 0), V(0, 0, 2), 0.2}, V::Zero(), V(0, most, most)};
  const Turning<Triangle<double>> vast{{V(0, -8, -8), V(-8, 0.25, -0.5), V(7, -4, most)}, V::Zero(), V::Zero()};
  const Toi<double> toi = time_of_impact(rod, vast);
  EXPECT_EQ(toi.status, ToiStatus::gave_up);
  EXPECT_EQ(toi.time, 0);
  // The normal is a number, and no point is.
  const Turning<Capsule<double>> wire{
      {V(1, 0x1p33, 0), V(-0x1p33, 0, -0x1.63c83p-1), 1}, V(0, -4, 0x1.3p-3), V::Zero()};
  const Turning<Triangle<double>> spun{
      {V(0, 0, -5), V(-0x1.63c83p-1, 5, -2), V(-0x1.63c83p-1, -0x1.b3p-1, -5)}, V(0, 0x1p33, 5), V(most, most, -1)};
  const Toi<double> of_spun = time_of_impact(wire, spun);
  EXPECT_TRUE(is_finite(of_spun.point)) << of_spun.point.transpose();
}

TEST(TurningShapes, a_turn_that_is_out_of_range_is_no_hit_of_what_is_far_away) {
  const double most = std::numeric_limits<double>::max();
  const Turning<Obb<double>> box{{V(0, 0, 0), V(1, 1, 1), Mat3<double>::Identity()}, V::Zero(), V(0, most, most)};
  const Turning<Capsule<double>> rod{{V(10, 0, 0), V(11, 0, 0), 0.5}, V::Zero(), V::Zero()};
  EXPECT_EQ(time_of_impact(EndOfStep<double>{}, box, rod).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(Substeps<double>{}, box, rod).status, ToiStatus::apart);
}

/// A ball flies at the corner of a box whose axes are `length` long: when they meet.
template <class S> void check_long_axes(const S& length) {
  const S far = 20, radius = 10;
  const Turning<Obb<S>> box{
      {{0, 0, 0}, {1, 1, 1}, Mat3<S>(Mat3<S>::Identity() * length)}, Vec3<S>::Zero(), Vec3<S>::Zero()};
  const Turning<Sphere<S>> ball{{{far, far, far}, radius}, {-far, -far, -far}, Vec3<S>::Zero()};
  ASSERT_TRUE(valid(box));
  const long double first = 1 - (length + 10 / std::sqrt(3.0L)) / 20;
  EXPECT_LE(time_of_impact(box, ball).time, first);
  EXPECT_GE(time_of_impact(box, ball).time, first - 1e-3L);
  EXPECT_LE(time_of_impact(ConservativeAdvancement<S>{std::numeric_limits<S>::epsilon()}, box, ball).time, first);
  if constexpr (std::is_same_v<S, double>) {
    const CertifiedToi proven = certified_time_of_impact(box, ball);
    EXPECT_LE(proven.lower, first);
    EXPECT_GE(proven.upper, first);
  }
}

TEST(TurningShapes, axes_that_are_not_quite_unit_make_nothing_late) {
  for (const float off : {2e-5F, 1e-6F, 2e-7F, -2e-5F}) check_long_axes(1 + off);
  for (const double off : {0x1p-33, 0x1p-40, -0x1p-33}) check_long_axes(1 + off);
}

/// Questions that looks are easily wasted on: answered, in few.
template <class A, class B>
Toi<typename A::Scalar> few_looks(const Turning<A>& a, const Turning<B>& b,
                                  const ConservativeAdvancement<typename A::Scalar>& method = {}) {
  const auto toi = time_of_impact(method, a, b);
  EXPECT_EQ(toi.status, time_of_impact(method, b, a).status);
  EXPECT_LE(toi.evaluations, 12);
  return toi;
}

TEST(TurningShapes, wires_that_cross_at_a_small_angle_are_seen_at_the_finest_tolerance) {
  for (const double radius : {1e-4, 1e-3, 1e-2}) {
    const Turning<Capsule<double>> a{{V(-0.5, 0, 0), V(0.5, 0, 0), radius}, V::Zero(), V(0, 0.001, 0)};
    const Turning<Capsule<double>> b{{V(-0.5, -0.03, 0.004 + 2 * radius), V(0.5, 0.03, 0.004 + 2 * radius), radius},
                                     V(0.003, 0.001, -0.01),
                                     V(0.0005, 0, -0.001)};
    EXPECT_EQ(few_looks(a, b, {0x1p-40}).status, ToiStatus::hit) << radius;
  }
}

TEST(TurningShapes, untrue_axes_hide_no_contact) {
  const auto ball_at_box = [](auto off, double start, double path, double spin) {
    using S = decltype(off);
    Mat3<S> axes = Mat3<S>::Identity();
    axes(0, 0) += off;
    const Vec3<S> half = Vec3<S>::Constant(S(0.5)), none = Vec3<S>::Zero();
    const Turning<Obb<S>> box{{none, half, axes}, none, {S(0), S(0), S(spin)}};
    return few_looks(box, Turning<Sphere<S>>{{{S(start), S(0), S(0)}, S(0.1)}, {S(-path), S(0), S(0)}, none});
  };
  EXPECT_EQ(ball_at_box(2e-10, 0.6005, 0.001, 0.001).status, ToiStatus::hit);
  EXPECT_EQ(ball_at_box(5e-5F, 0.605, 0.01, 0.01).status, ToiStatus::hit);
}

TEST(TurningShapes, what_rolls_along_touches_nothing) {
  for (const double gap : {1e-4, 1e-5, 1e-7}) {
    const Turning<Capsule<double>> rod{{V(0, -1, 0), V(0, 1, 0), 0.375}, V::Zero(), V(0, 2.9, 0)};
    const Turning<Sphere<double>> ball{{V(0.625 + gap, 0, 0), 0.25}, V(0, 0.5, 0), V::Zero()};
    EXPECT_EQ(few_looks(rod, ball).status, ToiStatus::apart) << gap;
  }
}

TEST(TurningShapes, what_spins_on_another_about_one_axis_touches_nothing) {
  const Mat3<double> upright = Mat3<double>::Identity();
  for (const auto& [gap, spin] : {std::pair(1e-6, 0.5), {1e-5, 1.5}, {1e-4, 5.5}, {1e-4, 1000.0}}) {
    const Turning<Obb<double>> below{{V(0, 0, 0), V(0.75, 0.25, 1), upright}, V(0.2, 0, 0.5), V(0, -spin, 0)};
    const Turning<Obb<double>> above{{V(0, 0.5 + gap, 0.25), V(0.5, 0.25, 1), upright}, V::Zero(), V(0, 0.45, 0)};
    EXPECT_EQ(few_looks(below, above).status, ToiStatus::apart) << gap << " " << spin;
  }
}

/// Planes that ride on it part them for no longer than it takes to turn a little.
TEST(TurningShapes, what_spins_very_often_far_away_touches_nothing) {
  const Turning<Obb<double>> wall{{V(0, 0, 0), V(0.1, 50, 50), Mat3<double>::Identity()}, V::Zero(), V::Zero()};
  for (const double spin : {10.0, 1e3, 1e6}) {
    const Turning<Obb<double>> tile{
        {V(-10, 0, 0), V(0.01, 0.01, 0.02), Mat3<double>::Identity()}, V(0, 5, 0), V(spin, 0.3 * spin, 0.2 * spin)};
    const Toi<double> toi = time_of_impact(tile, wall);
    EXPECT_EQ(toi.status, ToiStatus::apart) << spin;
    EXPECT_LE(toi.evaluations, 2) << spin;
    const Turning<Capsule<double>> rotor{{V(-1, 0, 0), V(1, 0, 0), 0.1}, V::Zero(), V(0, 0, spin)};
    const Turning<Sphere<double>> above{{V(0.3, 0.5, 0.2), 0.01}, V(0, 0, -0.001), V::Zero()};
    EXPECT_EQ(time_of_impact(rotor, above).status, ToiStatus::apart) << spin << " above its disc";
  }
}

TEST(TurningShapes, a_triangle_on_a_line_is_as_good_as_its_segment) {
  const Turning<Capsule<double>> rod{
      {V(-0.375, 0.75, -0.625), V(1.125, -0.5, -1.125), 0.0078125}, V(-0.875, -0.25, 1.125), V(0.125, 0.625, -2.75)};
  const V tip(0.875, -0.25, 0.375), path = V::Zero(), spin(1, -1.25, -1);
  const Toi<double> truth = few_looks(rod, Turning<Capsule<double>>{{-tip, tip, 0}, path, spin});
  const Toi<double> toi = few_looks(rod, Turning<Triangle<double>>{{-tip, tip, {0, 0, 0}}, path, spin});
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_NEAR(toi.time, truth.time, 1e-8);
  for (const V& third : {V(-tip), V(tip / 3)})  // about another center
    EXPECT_NE(few_looks(rod, Turning<Triangle<double>>{{-tip, tip, third}, path, spin}).status, ToiStatus::gave_up);
}

TEST(TurningShapes, what_has_flown_by_is_not_waited_for) {
  const Turning<Capsule<double>> a{{V(-0.5, 0, 0), V(0.5, 0, 0), 0.0625}, V::Zero(), V(1.25, 8.625, 10)};
  const Turning<Capsule<double>> b{
      {V(-0.125, -0.125, 2), V(-0.125, 0.875, 2), 0.0625}, V(3.5, 1.25, -6.75), V(70, -59.375, -45.375)};
  EXPECT_EQ(time_of_impact(a, b).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(b, a).status, ToiStatus::apart);
}

// What parts balls for a while is told by squares of squares, and of a motion so slow beside their size, or beside all numbers, they are nothing.
TEST(CertifiedTurning, calls_nothing_parted_by_a_square_that_vanishes) {
  const auto expect_touching = [](double distance, double radius, const V& path, const V& own_path) {
    const Turning<Sphere<double>> a{{V(0, 0, 0), radius}, path, V::Zero()};
    const Turning<Sphere<double>> b{{V(0, 0, distance), radius}, V(path + own_path), V::Zero()};
    EXPECT_NE(time_of_impact(a, b).status, ToiStatus::apart);
    EXPECT_NE(certified_time_of_impact(a, b).verdict, ToiStatus::apart);
  };
  for (const double common : {1e150, 1e154, 1e160}) expect_touching(2, 2, {common, 0, 0}, {0, 0, 1});
  expect_touching(2, 2, {1e17, 0, 0}, {0, 0, 1e-140});
  expect_touching(1e-3, 1e-3, V::Zero(), {0, 0, 1e-160});
  expect_touching(1e-10, 1e-10, V::Zero(), {0, 0, 1e-153});
}

/// At rest a rounded test is no proof: balls that overlap by 2^-106, and boxes by 2^-33 of axes that are not quite unit.
TEST(CertifiedTurning, proves_nothing_of_what_rests_within_rounding) {
  const Turning<Sphere<double>> large{{V(0, 0, 0), 1}, V::Zero(), V::Zero()};
  const Turning<Sphere<double>> small{{V(1, 0x1p-26, 0), 0x1p-53}, V::Zero(), V(0, 0, 1)};
  EXPECT_NE(certified_time_of_impact(large, small).verdict, ToiStatus::apart);
  Turning<Obb<double>> a{{V(0, 0, 0), V(1, 1, 1), Mat3<double>::Identity()}, V::Zero(), V::Zero()}, b = a;
  a.shape.axes(0, 0) = 1 + 0x1p-32;
  b.shape.center[0] = 2 + 0x1p-33;
  EXPECT_NE(certified_time_of_impact(a, b).verdict, ToiStatus::apart);
  b.shape.center[0] = 2.1;
  EXPECT_EQ(certified_time_of_impact(a, b).verdict, ToiStatus::apart);
}

template <class A, class B> void check_certified(int& proven, int& asked) {
  PortableDraw draw(7);
  const auto count = static_cast<unsigned>(thorough(slow_build ? 100 : 1'000));
  for (unsigned i = 0; i < count; ++i) {
    const Turning<A> a = motion<A>(draw, 2 * pi, 1.5);
    const Turning<B> b = motion<B>(draw, 2 * pi, 1.5);
    const CertifiedToi answer = certified_time_of_impact(a, b);
    if constexpr (!std::is_same_v<A, B>) {
      EXPECT_EQ(answer.verdict, certified_time_of_impact(b, a).verdict);
    }
    constexpr bool solid = std::is_same_v<A, Obb<double>> && std::is_same_v<B, Obb<double>>;
    const bool thick = solid || skin_radius(a.shape) + skin_radius(b.shape) > 0;  // or nothing lies beyond rounding
    asked += thick ? 1 : 0;
    proven += thick && answer.verdict != ToiStatus::gave_up ? 1 : 0;
    const double free = answer.verdict == ToiStatus::overlapping ? 0 : answer.lower;
    for (int k = 0; k < 40 && free > 0; ++k) {  // nothing touches before `lower`, of what is given up either
      const double time = free * k / 40;
      EXPECT_GT(separation(pose_at(a, time), pose_at(b, time)).distance, -1e-13) << time;
    }
  }
}

/// That its brackets are right is asked of the published set, whose times are proven (PublishedTurningSet).
TEST(CertifiedTurning, proves_nearly_everything_whichever_way_round) {
  int proven = 0, asked = 0;
  for_each_turning_pair([&]<class A, class B>(TypeTag<A>, TypeTag<B>) { check_certified<A, B>(proven, asked); });
  EXPECT_GE(proven, asked * 999 / 1000);
}

TEST(CertifiedTurning, gives_up_on_a_graze_and_refuses_no_question) {
  const Turning<Capsule<double>> rod{{{-1, 0, 0}, {1, 0, 0}, 0}, {0, 0, 0}, {0, 0, pi}};
  const Sphere<double> graze{{0, 1.5, 0}, 0.5};  // the tip passes at the distance of its radius
  const CertifiedToi touch = certified_time_of_impact(rod, at_rest(graze));
  EXPECT_EQ(touch.verdict, ToiStatus::gave_up);
  EXPECT_NEAR(touch.lower, 0.5, 1e-6);
  EXPECT_EQ(touch.upper, 1);
  Turning<Capsule<double>> bad = rod;
  bad.rotation[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(certified_time_of_impact(bad, at_rest(graze)).verdict, ToiStatus::invalid);
  const CertifiedToi apart = certified_time_of_impact(rod, at_rest(Sphere<double>{{0, 1.51, 0}, 0.5}));
  EXPECT_EQ(apart.verdict, ToiStatus::apart);
  EXPECT_EQ(apart.lower, 1);
  const CertifiedToi hit = certified_time_of_impact(rod, at_rest(Sphere<double>{{0, 1.4, 0}, 0.5}));
  EXPECT_EQ(hit.verdict, ToiStatus::hit);
}

}  // namespace
}  // namespace thinwall::testing
