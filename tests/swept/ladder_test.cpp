// The ladder of clear and careful: which rung decides, and that both say the same. The careful rung is held against oracles by every
// other test; here the clear one is held against the careful.

#include <cmath>
#include <cstddef>
#include <limits>

#include <gtest/gtest.h>

#include <thinwall/discrete/boxes/box_manifold.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/numbers_of.hpp"
#include "support/shaker.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {
namespace {

using Ball = Sphere<double>;
using Box = Aabb<double>;
using Turned = Obb<double>;
using Rod = Capsule<double>;
using Flat = Triangle<double>;
using V = Vec3<double>;
constexpr double u = 0x1p-53, infinity = std::numeric_limits<double>::infinity();
const std::size_t cases = thorough(slow_build ? 2'000 : 100'000);

template <class T> class Ladder : public ::testing::Test {};
using ClearPairs = ::testing::Types<PairOf<Ball, Ball>, PairOf<Box, Ball>, PairOf<Box, Box>, PairOf<Turned, Ball>,
                                    PairOf<Rod, Ball>, PairOf<Rod, Box>, PairOf<Rod, Turned>, PairOf<Rod, Rod>,
                                    PairOf<Turned, Box>, PairOf<Turned, Turned>, PairOf<Flat, Ball>, PairOf<Rod, Flat>>;
TYPED_TEST_SUITE(Ladder, ClearPairs, );

/// Two bodies of like size some sizes apart, one shot at the other or past it: what a scene asks.
template <class A, class B> Motion<A, B> everyday_shot(Shaker<double>& draw) {
  const auto any = [&] { return draw.plain_vector(); };
  const auto sized = [&]<class T>(T shape) {
    if constexpr (std::is_same_v<T, Ball>) shape = {V::Zero(), 0.3 + 0.25 * draw.plain()};
    if constexpr (std::is_same_v<T, Box>) shape = {V::Zero(), V::Constant(0.3) + any() * 0.25};
    if constexpr (std::is_same_v<T, Turned>) shape = {V::Zero(), V::Constant(0.3) + any() * 0.25, draw.plain_axes()};
    if constexpr (std::is_same_v<T, Rod>) shape = {any() * 0.5, any() * 0.5, 0.2 + 0.15 * draw.plain()};
    if constexpr (std::is_same_v<T, Flat>) shape = {any() * 0.5, any() * 0.5, any() * 0.5};
    return shape;
  };
  Motion<A, B> motion{at_rest(sized(A{})), at_rest(sized(B{}))};
  const V from = V(4, 0, 0) + any() * 2, drift = any();
  motion.b.shape = moved<double>(motion.b.shape, from);
  motion.a.displacement = drift;
  motion.b.displacement = drift + (any() - from) * (1.3 + 0.7 * draw.plain());
  return motion;
}

/// Holds the clear answer, if it is one, against the careful; returns if it is.
template <class A, class B> bool agrees_if_clear(const Motion<A, B>& motion, double gap) {
  const ClearToi rung = clear_impact(motion.a, motion.b, gap);
  if (!rung.clear) return false;
  const Toi<double> clear = rung.toi(), careful = careful_impact(ClosedForm<double>{gap}, motion.a, motion.b);
  EXPECT_EQ(clear.status, careful.status) << clear.time << " " << careful.time;
  const double size = magnitude(motion.a) + magnitude(motion.b) + gap;
  const double closing = std::abs(careful.normal.dot(motion.b.displacement - motion.a.displacement));
  const double off = clear.status == ToiStatus::hit ? 4 * u * size / closing : 0;
  EXPECT_NEAR(clear.time, careful.time, off);
  if (clear.status != ToiStatus::hit) return true;
  EXPECT_NEAR(static_cast<double>(clear.normal.cast<long double>().norm() - 1), 0, 4 * u);
  const double paths = motion.a.displacement.cwiseAbs().sum() + motion.b.displacement.cwiseAbs().sum();
  const auto from_point = [&](const auto& moving) {
    return separation(Ball{clear.point, 0}, pose_at(moving, clear.time)).distance;
  };
  EXPECT_NEAR(from_point(motion.a), gap / 2, 16 * u * size + off * paths);
  EXPECT_NEAR(from_point(motion.b), gap / 2, 16 * u * size + off * paths);
  const double round = skin_radius(motion.a.shape) + skin_radius(motion.b.shape) + gap;
  if (round > 0) {  // where there is none, two slabs that open at once have a normal each
    EXPECT_LE((clear.normal - careful.normal).cwiseAbs().maxCoeff(), 0x1p-20 + 2 * off * paths / round);
  }
  return true;
}

/// The share of `count` draws of which `is_so` says so.
template <class IsSo> double share(unsigned seed, std::size_t count, const IsSo& is_so) {
  Shaker<double> draw(seed);
  std::size_t many = 0;
  for (std::size_t i = 0; i < count; ++i) many += is_so(draw) ? 1U : 0U;
  return static_cast<double>(many) / static_cast<double>(count);
}

TYPED_TEST(Ladder, clear_decides_the_shots_of_a_scene) {
  const auto is_clear_shot = [](Shaker<double>& draw) {
    return agrees_if_clear(everyday_shot<typename TypeParam::A, typename TypeParam::B>(draw), 0.0);
  };
  EXPECT_GE(share(11, cases, is_clear_shot), 0.99);
}

TYPED_TEST(Ladder, clear_decides_what_is_asked_in_float) {  // whose axes, orthonormal to float, are made so in double
  const auto is_clear_shot = [](Shaker<double>& draw) {
    const auto shot = everyday_shot<typename TypeParam::A, typename TypeParam::B>(draw);
    const auto a = cast<float>(shot.a);
    const auto b = cast<float>(shot.b);
    const Motion<typename TypeParam::A, typename TypeParam::B> wide{widened<double>(a), widened<double>(b)};
    EXPECT_EQ(time_of_impact(a, b).time, static_cast<float>(time_of_impact(wide.a, wide.b).time));
    return agrees_if_clear(wide, 0.0);
  };
  EXPECT_GE(share(41, cases / 10, is_clear_shot), 0.99);
}

template <class T> class LadderOfTurned : public ::testing::Test {};
using TurnedPairs =
    ::testing::Types<PairOf<Turned, Ball>, PairOf<Rod, Turned>, PairOf<Turned, Box>, PairOf<Turned, Turned>>;
TYPED_TEST_SUITE(LadderOfTurned, TurnedPairs, );

TYPED_TEST(LadderOfTurned, clear_decides_of_boxes_whose_axes_come_from_a_quaternion) {
  using A = typename TypeParam::A;
  using B = typename TypeParam::B;
  const auto is_clear_shot = [](Shaker<double>& draw) {
    auto shot = everyday_shot<A, B>(draw);
    if constexpr (std::is_same_v<A, Turned>) shot.a.shape.axes = draw.quaternion_axes();
    if constexpr (std::is_same_v<B, Turned>) shot.b.shape.axes = draw.quaternion_axes();
    const bool in_time = agrees_if_clear(shot, 0.0);
    if constexpr (HasClearOverlap<A, B> && HasClearContact<A, B>) {
      const A a = shot.a.shape;
      const B b = pose_at(shot.b, 0.7);
      const bool all = clear_overlap(a, b).clear && clear_contact(a, b).clear;
      EXPECT_TRUE(!all || (clear_overlap(a, b).overlaps == careful_overlaps(a, b) &&
                           contact(a, b).has_value() == careful_overlaps(a, b)));
      return in_time && all;
    }
    return in_time;
  };
  EXPECT_GE(share(43, cases, is_clear_shot), 0.985);
}

// To which an axis is at right angles to a few roundings, which count by all of the box's length.
TEST(LadderFilters, a_ray_meets_the_face_that_the_other_axes_span) {
  const auto is_clear_ray = [](Shaker<double>& draw) {
    Turned plate{V::Zero(), {500, 500, 0.1}, draw.quaternion_axes()};
    while (ClearFrame(plate.axes).is_straight(packed::lanes(plate.half_extents), packed::all(0)))
      plate.axes = draw.quaternion_axes();
    const V above(draw.plain() * 499, draw.plain() * 499, 1), aside = draw.plain_vector() * 0.3;
    const Ray<double> ray{V(plate.axes * above), V(plate.axes * (V(0, 0, -1) + aside))};
    const ClearRayHit rung = raycast_from_afar(ray, plate);
    if (!rung.clear) return false;
    const Mat3<long double> to_box = plate.axes.cast<long double>().inverse();
    const Vec3<long double> p = to_box * ray.origin.cast<long double>(), v = to_box * ray.direction.cast<long double>();
    const auto late = static_cast<double>((rung.ray_hit()->t - (0.1L - p[2]) / v[2]) * v[2]);
    EXPECT_NEAR(late, 0, u * magnitude(plate));
    return true;
  };
  EXPECT_GE(share(53, cases / 50, is_clear_ray), 0.9);
}

/// The same shot straight along an axis, as things fall; boxes upright.
template <class A, class B> Motion<A, B> straight_shot(Shaker<double>& draw) {
  Motion<A, B> motion = everyday_shot<A, B>(draw);
  if constexpr (std::is_same_v<A, Turned>) motion.a.shape.axes.setIdentity();
  if constexpr (std::is_same_v<B, Turned>) motion.b.shape.axes.setIdentity();
  if constexpr (std::is_same_v<A, Rod>) motion.a.shape.b = motion.a.shape.a + V(0, 0, 0.5);
  if constexpr (std::is_same_v<B, Rod>) motion.b.shape.b = motion.b.shape.a + V(0, 0.5, 0);
  const V at = center(motion.a.shape) - center(motion.b.shape);
  motion.a.displacement.setZero();
  motion.b.displacement.setZero();
  const int axis = std::is_same_v<A, Rod> && draw.pick(0, 1) == 0 ? 2 : draw.pick(0, 2);
  motion.b.displacement[axis] = (draw.pick(0, 1) == 0 ? 4 : -4) + draw.plain();
  motion.b.shape = moved<double>(motion.b.shape, V(at - motion.b.displacement * 0.7 + draw.plain_vector()));
  return motion;
}

TYPED_TEST(Ladder, clear_decides_what_falls_straight) {
  using A = typename TypeParam::A;
  using B = typename TypeParam::B;
  const auto is_clear_shot = [](Shaker<double>& draw) {
    Motion<A, B> motion = straight_shot<A, B>(draw);
    while (overlaps(motion.a.shape, motion.b.shape)) motion = straight_shot<A, B>(draw);
    return agrees_if_clear(motion, 0.0);
  };
  EXPECT_GE(share(31, cases, is_clear_shot), 0.99);
}

/// Odd sizes and places: a speck far off, a long way along a rod, a graze or a stop within the noise, next to nothing as a number.
template <class A, class B> Motion<A, B> odd_motion(Shaker<double>& draw) {
  Motion<A, B> motion = everyday_shot<A, B>(draw);
  const auto shrink = [&](auto& shape) {
    if constexpr (requires { shape.radius; }) shape.radius *= power<double>(-draw.pick(0, 60));
    if constexpr (requires { shape.half_extents; })
      shape.half_extents[draw.pick(0, 2)] *= power<double>(-draw.pick(0, 1000));
    if constexpr (requires { shape.axes; }) {
      if (draw.pick(0, 3) == 0) shape.axes.setIdentity();
      if (draw.pick(0, 3) == 0) shape.axes(draw.pick(0, 2), draw.pick(0, 2)) += power<double>(-draw.pick(40, 1074));
    }
    const V aside = draw.plain_vector() * power<double>(-draw.pick(0, 60));
    if constexpr (requires { shape.c; }) {  // next to a needle
      if (draw.pick(0, 1) == 0) shape.c = shape.a + (shape.b - shape.a) * draw.plain() + aside;
    } else if constexpr (requires { shape.b; }) {  // next to a point, or parallel to an axis
      if (draw.pick(0, 2) == 0) shape.b = shape.a + aside;
      if (draw.pick(0, 2) == 0) shape.b = shape.a + V(0.5, 0, 0) + aside;
    }
  };
  shrink(motion.a.shape);
  shrink(motion.b.shape);
  const Separation<double> there = separation(pose_at(motion.a, 0.9), pose_at(motion.b, 0.9));
  if (draw.pick(0, 1) == 0) motion.b.shape = moved<double>(motion.b.shape, there.normal * -there.distance);
  if (draw.pick(0, 2) == 0) {  // far, or shallow
    const V motion_of_b = motion.b.displacement - motion.a.displacement;
    const double farther = power<double>(draw.pick(0, 14));
    motion.b.shape = moved<double>(motion.b.shape, motion_of_b * (0.9 - 0.9 * farther));
    motion.b.displacement = motion.a.displacement + motion_of_b * farther;
  }
  if (draw.pick(0, 3) == 0) motion.b.displacement[draw.pick(0, 2)] = motion.a.displacement[0] = 0;
  return motion;
}

TYPED_TEST(Ladder, clear_and_careful_agree_on_motions_drawn_to_go_wrong) {
  const auto is_clear_odd = [](Shaker<double>& draw) {
    const auto motion = odd_motion<typename TypeParam::A, typename TypeParam::B>(draw);
    return valid(motion.a) && valid(motion.b) && agrees_if_clear(motion, 0.0);
  };
  const auto is_clear_drawn = [](Shaker<double>& draw) {
    auto motion = drawn_motion<typename TypeParam::A, typename TypeParam::B>(draw);
    if (draw.pick(0, 9) == 0) {
      const int scale = draw.pick(-600, 600);
      motion = {scaled(motion.a, scale), scaled(motion.b, scale)};
    }
    return agrees_if_clear(motion, draw.pick(0, 9) == 0 ? 0.25 * std::abs(draw.plain()) : 0.0);
  };
  EXPECT_GT(share(37, cases, is_clear_odd), 0);
  EXPECT_GE(share(13, 2 * cases, is_clear_drawn), 1.0 / 6) << "too few to mean anything";
}

TYPED_TEST(Ladder, the_front_door_climbs_it) {  // from either side
  Shaker<double> draw(17);
  for (int i = 0; i < 2000; ++i) {
    const auto motion = drawn_motion<typename TypeParam::A, typename TypeParam::B>(draw);
    const ClearToi rung = clear_impact(motion.a, motion.b, 0);
    const Toi<double> expected = rung.clear ? rung.toi() : careful_impact({}, motion.a, motion.b);
    const Toi<double> toi = time_of_impact(motion.a, motion.b);
    EXPECT_EQ(toi.status, expected.status);
    EXPECT_EQ(toi.time, expected.time);
    EXPECT_EQ(toi.normal, expected.normal);
    if constexpr (!std::is_same_v<typename TypeParam::A, typename TypeParam::B>) {
      EXPECT_EQ(time_of_impact(motion.b, motion.a).normal, V(V::Zero() - expected.normal));
    }
  }
}

TYPED_TEST(Ladder, an_overlap_at_the_start_is_told_as_the_careful_rung_does) {
  Shaker<double> draw(19);
  for (int i = 0; i < 500; ++i) {
    auto motion = everyday_shot<typename TypeParam::A, typename TypeParam::B>(draw);
    const Separation<double> start = separation(motion.a.shape, motion.b.shape);
    motion.b.shape = moved<double>(motion.b.shape, start.normal * (-start.distance - power<double>(-draw.pick(5, 40))));
    const Toi<double> toi = time_of_impact(motion.a, motion.b), expected = careful_impact({}, motion.a, motion.b);
    EXPECT_EQ(toi.status, ToiStatus::overlapping);
    EXPECT_EQ(expected.status, ToiStatus::overlapping);
    EXPECT_EQ(toi.evaluations, expected.evaluations);
    EXPECT_LE((toi.point - expected.point).cwiseAbs().maxCoeff(), 0x1p-48);
    motion.b.displacement[draw.pick(0, 2)] = std::numeric_limits<double>::infinity();
    EXPECT_EQ(time_of_impact(motion.a, motion.b).status, ToiStatus::invalid);
  }
}

TYPED_TEST(Ladder, the_unit_of_length_changes_no_bit) {  // of what comes from afar, either
  Shaker<double> draw(23);
  for (int i = 0; i < 500; ++i) {
    auto motion = drawn_motion<typename TypeParam::A, typename TypeParam::B>(draw);
    const V by = motion.b.displacement - motion.a.displacement;
    const double farther = power<double>(draw.pick(0, 12));
    motion = {motion.a,
              {moved<double>(motion.b.shape, by * (0.5 - 0.5 * farther)), motion.a.displacement + by * farther}};
    const Toi<double> here = time_of_impact(motion.a, motion.b);
    for (const int exponent : {-75, -60, -48, -30, 60}) {
      const Toi<double> there = time_of_impact(scaled(motion.a, exponent), scaled(motion.b, exponent));
      EXPECT_EQ(there.status, here.status) << exponent;
      EXPECT_EQ(there.time, here.time) << exponent;
      EXPECT_EQ(there.normal, here.normal) << exponent;
    }
  }
}

// ---- Which rung decides what: doubt, and beside it none.

const Moving<Ball> unit_ball = at_rest(Ball{{0, 0, 0}, 1});
const Moving<Box> cube = at_rest(Box{{0, 0, 0}, {1, 1, 1}});

Moving<Ball> shot(const V& from, const V& by, double radius = 1) { return {{from, radius}, by}; }
Moving<Box> box_shot(const V& from, const V& by) { return {{from, {1, 1, 1}}, by}; }
template <class A, class B> bool is_clear(const Moving<A>& a, const Moving<B>& b, double gap = 0) {
  return clear_impact(a, b, gap).clear;
}

TEST(LadderFilters, a_graze_and_the_end_of_the_step_are_careful) {  // of which one is at height 2, and one at speed 2
  const auto at_height = [](double y) { return is_clear(shot({-4, y, 0}, {8, 0, 0}), unit_ball); };
  const auto at_speed = [](double speed) { return is_clear(shot({-4, 0, 0}, {speed, 0, 0}), unit_ball); };
  for (const double off : {0.0, 0x1p-12, -0x1p-12}) EXPECT_FALSE(at_height(2 + off)) << off;
  for (const double off : {0.0, 0x1p-12}) EXPECT_FALSE(at_speed(2 + off)) << off;
  for (const double off : {0x1p-8, -0x1p-8}) EXPECT_TRUE(at_height(2 + off)) << off;
  for (const double off : {0x1p-6, -0x1p-6}) EXPECT_TRUE(at_speed(2 + off)) << off;
  const auto onto_plate = [](double height, double by) {
    return is_clear(at_rest(Flat{{-4, -4, 0}, {8, -4, 0}, {-4, 8, 0}}), shot({0, 0, 1 + height}, {0, 0, -by}));
  };
  for (const double off : {0.0, 0x1p-12}) EXPECT_FALSE(onto_plate(2, 2 + off)) << off;
  EXPECT_TRUE(onto_plate(2, 2 + 0x1p-6));
  EXPECT_FALSE(onto_plate(0x1p-38, 0x1p-38 * 1.01)) << "a hundredth of the gap is a few roundings";
  EXPECT_TRUE(onto_plate(0x1p-20, 0x1p-20 * 1.01));
  const auto onto_wall = [](double gap) {  // where a place is rounded by 2^-35
    return is_clear(at_rest(Box{{0, 0, 0}, {0x1p17, 1, 1}}), box_shot({0x1p17 + 1 + gap, 0, 0}, {-256, 0, 0}));
  };
  EXPECT_FALSE(onto_wall(256 + 0x1p-34)) << "short of the wall by two roundings";
  EXPECT_TRUE(onto_wall(257));
}

TEST(LadderFilters, a_start_in_touch_is_careful) {
  for (const double x : {-1.5, -2.0, std::nextafter(-2.0, -3.0), -2 - 0x1p-20}) {
    const V from(x, 0, 0), by(8, 0, 0);
    const bool is_beside = x < -2 - 0x1p-30;
    EXPECT_EQ(is_clear(shot(from, by), unit_ball), is_beside) << x;
    EXPECT_EQ(is_clear(cube, shot(from, by)), is_beside) << x;
    EXPECT_EQ(is_clear(cube, box_shot(from, by)), is_beside) << x;
  }
}

TEST(LadderFilters, turned_boxes_that_lie_level_meet_in_the_middle_of_what_their_faces_share) {
  Shaker<double> draw(29);
  for (int i = 0; i < 100; ++i) {
    const Mat3<double> axes = draw.plain_axes();
    const Turned below{V::Zero(), {1, 0.5, 0.25}, axes}, above{V(axes * V(0.1, 0.2, 0.49)), {0.5, 1, 0.25}, axes};
    const V middle_of_faces = axes * V(0.1, 0, 0.25), up = axes.col(2);
    const ClearContact clear = clear_gap(below, above);
    EXPECT_TRUE(clear.clear);
    EXPECT_LE(cross<double>(clear.contact()->normal, up).norm(), 0x1p-50);
    EXPECT_NEAR(value(clear.depth), 0.01, 0x1p-50);
    EXPECT_LE((clear.contact()->local_a - middle_of_faces).norm(), 0x1p-48);
    EXPECT_EQ(manifold(below, above).size(), 4U);
    EXPECT_EQ(time_of_impact(at_rest(below), at_rest(above)).point, middle(separation(below, above)));

    const Motion<Turned, Turned> falls{at_rest(below), {moved<double>(above, V(up * 0.26)), V(up * -0.5)}};
    EXPECT_TRUE(agrees_if_clear(falls, 0.0));
    EXPECT_LE((time_of_impact(falls.a, falls.b).point - middle_of_faces).norm(), 0x1p-48);
    Motion<Turned, Turned> turned = falls;
    turned.b.shape.axes = axes * turn_in_plane<double>(0, 1, 0.6, 0.8);
    EXPECT_TRUE(agrees_if_clear(turned, 0.0));
  }
}

// Of any sizes, beside each other and across each other's ends, with axes that are a few roundings off.
TEST(LadderFilters, what_falls_level_agrees) {
  const auto is_clear_shot = [](Shaker<double>& draw) {
    const Mat3<double> axes = draw.quaternion_axes();
    const auto long_box = [&]() -> V {
      return V(draw.sizes() + V(0.1, 0.1, 0.1)).cwiseProduct(V(power<double>(draw.pick(0, 9)), 1, 1));
    };
    const Turned below{V::Zero(), long_box(), axes};
    Turned above{V::Zero(), long_box(), axes * turn_in_plane<double>(0, 1, 0.6, 0.8)};
    const double beside = (below.half_extents[0] + above.half_extents[0] * 0.6) * 0.9;
    above.center = axes * V(beside * draw.plain(), draw.plain() / 8, below.half_extents[2] + above.half_extents[2] + 1);
    const Motion<Turned, Turned> falls{at_rest(below), {above, V(axes.col(2) * -2.5)}};
    const Turned within = moved<double>(above, V(axes.col(2) * -1.01));
    const ClearContact rung = clear_contact(below, within);
    const auto clear = rung.contact(), careful = careful_contact(below, within);
    if (rung.clear && clear && careful) {
      EXPECT_NEAR(clear->penetration, careful->penetration, 4 * u * (magnitude(below) + magnitude(within)));
      EXPECT_NEAR(clear->normal.norm(), 1, 4 * u);
    }
    return agrees_if_clear(falls, 0.0);
  };
  EXPECT_GE(share(47, cases, is_clear_shot), 0.8);
}

TEST(LadderFilters, a_long_box_that_leans_by_roundings_does_not_lie_level) {
  const auto is_clear_fall = [](const V& half, const Mat3<double>& axes, double lean) {
    const Turned floor{V::Zero(), {500, 500, 0.1}, axes},
        above{{0.5, 0.5, 1}, half, axes * turn_in_plane<double>(0, 2, 1, lean)};
    return is_clear(at_rest(floor), Moving<Turned>{above, {0, 0, -2}});
  };
  const Mat3<double> upright = Mat3<double>::Identity();
  EXPECT_TRUE(is_clear_fall({500, 500, 0.1}, upright, 0));
  EXPECT_FALSE(is_clear_fall({500, 500, 0.1}, upright, 0x1p-52));
  EXPECT_TRUE(is_clear_fall({0.1, 0.1, 0.1}, upright, 0x1p-54));

  Turned skewed{V::Zero(), {1, 1, 1}, upright},
      across{{100.9, 0, 3}, {100, 1, 1}, turn_in_plane<double>(0, 2, 1, 1.49 * 0x1p-50)};
  skewed.axes(0, 2) = 0.99 * 0x1p-50;
  agrees_if_clear<Turned, Turned>({at_rest(skewed), {across, {0, 0, -4}}}, 0.0);
}

TEST(LadderFilters, which_of_two_ways_out_of_a_turned_box_is_shortest_may_be_in_doubt_though_that_it_overlaps_is_not) {
  Shaker<double> draw(29);
  for (int i = 0; i < 100; ++i) {
    const Mat3<double> axes = draw.plain_axes();
    const Turned below{V::Zero(), {1, 0.5, 0.25}, axes}, above{V(axes * V(1.49, 0.2, 0.49)), {0.5, 1, 0.25}, axes};
    EXPECT_FALSE(clear_gap(below, above).clear);
    const Separation<double> careful = careful_separation(below, above);
    EXPECT_EQ(doubtful_start(below, above).distance, careful.distance);
    EXPECT_NEAR(careful.distance, -0.01, 0x1p-50);
    const Toi<double> toi = time_of_impact(at_rest(below), at_rest(above));
    EXPECT_EQ(toi.status, ToiStatus::overlapping);
    EXPECT_EQ(toi.point, middle(careful));
  }
}

TEST(LadderFilters, an_edge_met_by_an_edge_is_careful) {  // the slabs of x and y open and close at one time
  EXPECT_FALSE(is_clear(cube, box_shot({-4, 0, 0}, {4, 4, 0})));
  EXPECT_TRUE(is_clear(cube, box_shot({-4, 0, 0}, {4, 3, 0})));
  EXPECT_FALSE(is_clear(cube, box_shot({-4, -4 + 0x1p-30, 0}, {4, 4, 0}))) << "two faces met at once, to rounding";
}

TEST(LadderFilters, a_graze_of_a_rod_is_careful) {  // of its side, of its caps, and along it
  const auto is_sure = [](const V& from, const V& by) {
    return is_clear(at_rest(Rod{{0, 0, 0}, {0, 0, 4}, 1}), shot(from, by));
  };
  EXPECT_FALSE(is_sure({-4, 2, 2}, {8, 0, 0}));
  EXPECT_FALSE(is_sure({-4, 0, 6}, {8, 0, 0}));
  EXPECT_FALSE(is_sure({2, 0, 8}, {0, 0, -4}));
  EXPECT_FALSE(is_sure({1, 0, 8}, {0x1p-33, 0, -4}));
  EXPECT_FALSE(is_sure({0, 0, 6}, {0, 0, -4}));
  EXPECT_TRUE(is_sure({-4, 1, 2}, {8, 0, 0}));
  EXPECT_TRUE(is_sure({-4, 1, 5}, {8, 0, 0.5}));
  EXPECT_TRUE(is_sure({-4, 3, 2}, {8, 0, 0}));
}

TEST(LadderFilters, a_graze_of_a_plate_is_careful) {  // of an edge, of a corner, and along its face
  const auto is_sure = [](const V& from, const V& by) {
    return is_clear(at_rest(Flat{{-4, -4, 0}, {8, -4, 0}, {-4, 8, 0}}), shot(from, by));
  };
  const V down(0, 0, -6);
  EXPECT_TRUE(is_sure({0, 0, 3}, down));
  EXPECT_FALSE(is_sure({0, -5, 3}, down));
  EXPECT_TRUE(is_sure({0, -5.25, 3}, down));
  EXPECT_TRUE(is_sure({0, -4.75, 3}, down));
  EXPECT_FALSE(is_sure({-4.6, -4.8, 3}, down));
  EXPECT_TRUE(is_sure({-4.7, -4.8, 3}, down));
  EXPECT_FALSE(is_sure({-3, 0, 1.001}, {3, 2, -0.01}));
  EXPECT_TRUE(is_sure({-3, 0, 1.001}, {3, 2, -0.1}));
  EXPECT_FALSE(is_sure({-3, 0, 1.001}, {4, 0, -0.1})) << "all but along an edge";
  EXPECT_FALSE(is_sure({0, 0, 1 + 0x1p-46}, down)) << "in touch, as far as roundings tell";
  EXPECT_FALSE(is_sure({0, 0, 0.5}, down));
}

// A hundredth of the gap beside it, which is a few roundings.
TEST(LadderFilters, an_end_within_the_noise_of_a_creep_is_careful) {
  const auto creep = [](double gap) {
    return is_clear(at_rest(to_obb(cube.shape)), shot({-2 - gap, 0, 0}, {gap * 1.01, 0, 0}));
  };
  EXPECT_FALSE(creep(0x1p-43));
  EXPECT_TRUE(creep(0x1p-20));
}

// Nearer to a plane of a slab than what times are told by; which slab comes first is asked of products then.
TEST(LadderFilters, a_start_close_to_a_plane_of_a_box_is_clear) {
  const auto turned_cube = at_rest(to_obb(cube.shape));
  EXPECT_TRUE(is_clear(turned_cube, shot({-2 - 0x1p-30, 0, 0}, {8, 0, 0})));
  const auto along_a_face = [&](double off) { return shot({-4, 2 + off, 0}, {8, 0, 0}); };
  for (const double off : {0x1p-30, 0x1p-40}) EXPECT_TRUE(is_clear(turned_cube, along_a_face(off))) << off;
  for (const double off : {0.0, 0x1p-49, -0x1p-30}) EXPECT_FALSE(is_clear(turned_cube, along_a_face(off))) << off;
}

// The slabs of x and y open both at zero, as far as double tells.
TEST(LadderFilters, quotients_that_underflow_are_careful) {
  const Box plate{{0, 0, 0}, {1, 1e-300, 1}};
  const V above(0, std::nextafter(1e-300, 1.0), 0), by(1, -1e12, 0);
  EXPECT_FALSE(clear_raycast(Ray<double>{above, by}, plate).clear);
  EXPECT_FALSE(is_clear(at_rest(plate), Moving{Box{above, {0, 0, 0}}, by}));
}

// Turning it would cost it digits.
TEST(LadderFilters, a_ray_of_subnormal_direction_is_careful) {
  const double c = 0x1.6a09e667f3bccp-1, h = 0x1p-20;
  const Turned box{{0, 0, 0}, {h, h, h}, Mat3<double>{{1, 0, 0}, {0, c, -c}, {0, c, c}}};
  const Ray<double> ray{{-0x1.1e9f8d19cdabp-22, 0x1.4f01d8ce0c298p-21, 0x1.8596b08c3e1fp-21},
                        {0x0.00000004e0259p-1022, -0x0.000000017e509p-1022, -0x0.00000000fcacep-1022}};
  EXPECT_FALSE(clear_raycast(ray, box).clear);
  const auto hit = raycast(ray, box);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t / 7.5156923536e307, 1, 1e-10);
  const Turned far{
      {0, 0, 0}, {0x1p50, 0x1p50, 0}, Mat3<double>::Identity()};  // met later than the slabs are asked about
  EXPECT_FALSE(clear_raycast(Ray<double>{{1, 1, -0x1p50}, {0, 0, 0x1p-760}}, far).clear);
}

TEST(LadderFilters, a_ray_whose_end_is_no_number_is_careful) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const V& half : {V(1, 1, 1), V(1, 1, 0)}) {
    const Turned box{{0, 0, 0}, half, Mat3<double>::Identity()};
    EXPECT_FALSE(raycast(Ray<double>{{0.2, 0.1, -3}, {0.1, 0.05, 1}, nan}, box));
    EXPECT_FALSE(raycast(Ray<double>{{0.2, 0.1, -3}, {0.1, 0.05, 1}, -1}, box));
  }
}

// From within a plane of another face, at a plate of no thickness, and at its rim: told by products.
TEST(LadderFilters, a_ray_close_to_a_plane_of_a_turned_box_is_clear) {
  const Mat3<double> axes = turn_in_plane(0, 1, 0.6, 0.8);
  const auto is_sure = [&](const V& half, const V& from, const V& by) {
    const Turned box{{0, 0, 0}, half, axes};
    const Ray<double> ray{out_of<double>(box, from), out_of<double>(box, by)};
    EXPECT_EQ(raycast(ray, box).has_value(), careful_raycast(ray, box).has_value());
    return clear_raycast(ray, box).clear;
  };
  EXPECT_TRUE(is_sure({1, 1, 1}, {3, 1, 0.2}, {1, 0.1, 0.1}));
  EXPECT_TRUE(is_sure({1, 1, 1}, {-3, 1, 0.2}, {1, -0.1, 0.1}));
  EXPECT_TRUE(is_sure({1, 1, 0}, {0.2, 0.1, -3}, {0.1, 0.05, 1}));
  EXPECT_TRUE(is_sure({1, 1, 0x1p-22}, {0.2, 0.1, -3}, {0.1, 0.05, 1}));
  EXPECT_TRUE(is_sure({1, 1, 0x1p-22}, {-3, 0.1, 0.5}, {1, 0.05, -0.2}));
}

// The next slab is left when its ball would be met, to rounding: a graze in the end.
TEST(LadderFilters, an_edge_met_as_it_ends_is_careful_where_it_is_turned) {
  const double c = 0x1.10530ac424b02p-1, s = 0x1.b19210369aa1ap-1;
  const Turned box{
      {0, 0, 0}, {0x1.566277b2fb23ep+16, 1, 0x1.45854ddc3d182p-1}, Mat3<double>{{c, s, 0}, {-s, c, 0}, {0, 0, 1}}};
  EXPECT_FALSE(
      is_clear(at_rest(box), shot({-0x1.c6d2a9a9ce00fp+14, 0x1.6a14320e3f769p+15, -0x1.00a2c4a833a3ep+8},
                                  {-0x1.572075e85ddbbp+14, 0x1.1125de2f7a1cep+15, 0x1.41da5a7e7c396p-15}, 256)));
}

TEST(LadderFilters, axes_that_are_off_are_careful) {  // by more than a few roundings
  Turned box = to_obb(cube.shape);
  const auto is_sure = [&] {
    const bool impact = is_clear(at_rest(box), shot({-4, 0, 0}, {8, 0.5, 0.5}));
    EXPECT_EQ(clear_raycast(Ray<double>{{-4, 0, 0}, {8, 0.5, 0.5}}, box).clear, impact);
    return impact;
  };
  EXPECT_TRUE(is_sure());
  box.axes(0, 1) = 0x1p-45;
  EXPECT_FALSE(is_sure());
  box.axes = Mat3<double>::Identity() * (1 + 0x1p-45);
  EXPECT_FALSE(is_sure());
  box.axes.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(is_sure());
}

/// Any number of the two that is none, or out of range.
template <class A, class B> void expect_careful_of_bad_numbers(Moving<A> a, Moving<B> b) {
  EXPECT_TRUE(is_clear(a, b));
  const auto spoil = [&](const std::string& name, double& number) {
    const double usual = number;
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, 1e300, -1e300}) {
      number = bad;
      EXPECT_FALSE(is_clear(a, b)) << name << " " << bad;
    }
    number = usual;
  };
  for_each_named_number(a, spoil);
  for_each_named_number(b, spoil);
}

TEST(LadderFilters, what_is_no_question_or_out_of_range_is_careful) {
  const V from(-4, 0, 0), by(8, 0, 0);
  expect_careful_of_bad_numbers(shot(from, by), unit_ball);
  expect_careful_of_bad_numbers(cube, shot(from, by));
  expect_careful_of_bad_numbers(cube, box_shot(from, by));
  EXPECT_FALSE(is_clear(shot(from, by, -0.5), unit_ball));
  for (const double gap : {-0.5, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(is_clear(shot(from, by), unit_ball, gap)) << gap;
    EXPECT_FALSE(is_clear(cube, shot(from, by), gap)) << gap;
  }
  EXPECT_FALSE(is_clear(at_rest(Box{{0, 0, 0}, {1, -1, 1}}), shot(from, by, 3)));
  EXPECT_FALSE(is_clear(shot(from, by, 0), at_rest(Ball{{0, 0, 0}, 0})));
  EXPECT_FALSE(is_clear(shot(from, {0, 0, 0}), unit_ball));
}

TEST(LadderFilters, a_size_below_zero_is_invalid_however_small_beside_the_rest) {
  const Moving<Ball> a{{{-0x1p+900, 0, 0}, 0x1p+890}, {0x1p+901, 0, 0}}, b{{{0, 0, 0}, -0x1p-606}, {0, 0, 0}};
  EXPECT_EQ(time_of_impact(a, b).status, ToiStatus::invalid);
  EXPECT_EQ(time_of_impact(ClosedForm<double>{-0x1p-606}, a, a).status, ToiStatus::invalid);
}

TEST(LadderFilters, a_segment_that_meets_a_face_level_touches_in_more_than_one_place) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const auto at = [&](double z, double rise) {
    const Toi<double> toi =
        time_of_impact(Moving<Rod>{{{-4, 0, z}, {-4 + rise, 0, z + 1}, 0.5}, {4, 0, 0}}, at_rest(box));
    EXPECT_EQ(toi.status, ToiStatus::hit);
    return toi;
  };
  EXPECT_EQ(at(-0.5, 0).time, 0.625);
  EXPECT_EQ(at(-0.5, 0).point.z(), 0) << "the middle of the segment";
  EXPECT_EQ(at(0.5, 0).point.z(), 0.75) << "the middle of what of it is over the face";
  EXPECT_EQ(at(-0.5, 0x1p-3).point.z(), 0.5) << "the end that comes first";
  EXPECT_EQ(at(-0.5, -0x1p-3).point.z(), -0.5);
}

TEST(LadderFilters, which_places_of_nearly_parallel_segments_are_nearest_is_in_doubt) {
  const auto is_clear = [](double lean) {
    return clear_contact(Rod{{-1, 0, 0}, {1, 0, 0}, 0.3}, Rod{{-1, -lean, 0.5}, {1, lean, 0.5}, 0.3}).clear;
  };
  EXPECT_TRUE(is_clear(0x1p-8));
  EXPECT_FALSE(is_clear(0x1p-11));
  EXPECT_FALSE(is_clear(0));
}

TEST(LadderFilters, what_underflows_parts_nothing) {
  const V across(8, 0, 0);
  const auto meets = [](const auto& a, const auto& b) { return time_of_impact(a, b).status == ToiStatus::hit; };
  EXPECT_TRUE(meets(Moving<Rod>{{{-6, 0, 1.2}, {-5, 0x1p-600, 1.2}, 0.3}, across}, at_rest(Box{{0, 0, 0}, {1, 1, 1}})));
  const Mat3<double> all_but_upright = (Mat3<double>() << 1, 0, 0, 0, 1, 0x1p-1040, 0, 0, 1).finished();
  const Turned turned{{0, 0, 0}, {1, 1, 1}, all_but_upright};
  EXPECT_TRUE(meets(Moving<Rod>{{{-6, 0, 1.2}, {-6, 1, 1.2}, 0.3}, across}, at_rest(turned)));
  const Rod dot{{-4, 0, 0.3}, {-4 + 0x1p-50, 0, 0.3}, 0.3}, speck{{0, 0, 0}, {0, 0x1p-500, 0}, 0.2};
  EXPECT_TRUE(meets(Moving<Rod>{dot, across}, at_rest(speck)));
  const Flat crumb{{0, 0, 0}, {0x1p-300, 0, 0}, {0, 0x1p-300, 0}};
  EXPECT_TRUE(meets(Moving<Ball>{{{-4, 0, 0.3}, 0.5}, across}, at_rest(crumb)));
  const Flat needle{{0, 0, 0}, {1, 0, 0}, {0, 0x1p-548, 0}};
  const Toi<double> by_face = time_of_impact(Moving<Ball>{{{0.125, 0, 3}, 0x1p-16}, {0, 0, -4}}, at_rest(needle));
  EXPECT_EQ(by_face.time, 0.75 - 0x1p-18);
}

TEST(LadderFilters, a_ray_that_meets_two_faces_of_a_turned_box_at_once_is_in_doubt) {
  const Turned box{{0, -1.5, -0x1.fe932d64p+0}, {0.5, 1, 2}, Mat3<double>::Identity()};
  const Ray<double> slowly_down{{-0x1.00800001p+8, -0x1.ffffff54dfb02p-2, -0x1.ec8b4b8ff20ep+1},
                                {0x1.00000001p-6, -0x1.56409fdp-41, 0x1.6fc837e4p-39}};
  EXPECT_FALSE(clear_raycast(slowly_down, box).clear);
  const auto hit = raycast(slowly_down, box);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 16384);  // by the face across; the other's time is wrong by 2^-13, as slow as the ray comes down
}

TEST(LadderFilters, a_rod_at_a_triangle) {
  const Moving<Flat> floor = at_rest(Flat{{-4, -4, 0}, {8, -4, 0}, {-4, 8, 0}});
  const auto rod = [](const V& from, const V& core, const V& by) { return Moving<Rod>{{from, from + core, 0.5}, by}; };
  const V upright(0, 0, 1), level(1, 0, 0), down(0, 0, -4), along(4, 0, 0);
  EXPECT_TRUE(is_clear(rod({0, 0, 2}, upright, down), floor));
  EXPECT_TRUE(is_clear(rod({0, 0, -2}, upright, -down), floor));
  EXPECT_TRUE(is_clear(rod({0, 0, 2}, {1, 0, 0x1p-19}, down), floor));
  EXPECT_FALSE(is_clear(rod({0, 0, 2}, level, down), floor)) << "it touches along a stretch";
  EXPECT_TRUE(is_clear(rod({0, 0, 2}, level, -down), floor)) << "away from it";
  EXPECT_TRUE(is_clear(rod({0, 0, 0.75}, upright, along), floor)) << "above it all the way";
  EXPECT_FALSE(is_clear(rod({0, 0, 0.5}, upright, along), floor));
  EXPECT_FALSE(is_clear(rod({0, 0, -0.5}, upright, down), floor)) << "through it at the start";
  EXPECT_FALSE(is_clear(rod({0, 0, -0.5}, upright, -down), floor));
  EXPECT_FALSE(is_clear(rod({0, 0, 2}, V::Zero(), down), floor)) << "a ball";
}

TEST(LadderFilters, the_face_of_a_needle_is_tilted_by_rounding) {
  const Moving<Flat> needle{{{0x1.19b9695e98f5p-2, 0x1.6934428dd4f6p-1, -0x1.77500c30a42ap-3},
                             {0x1.f726052d3f179p-4, 0x1.428cbce69b10bp-2, -0x1.4f28694582734p-4},
                             {0, 0, 0}},
                            {0, -1.5, -1.5}};
  const Moving<Ball> ball{{{0x1.29f254ec73641p-1, 0x1.15759342d31p-1, -0x1.7eac0a49ecc63p+0}, 0x1.c56ab920e7b5p-3},
                          {-0x1.28a7af984e7e4p-1, -0x1.2cd6bb1295c59p+1, 0x1.ff27133dd68bcp-1}};
  EXPECT_FALSE(clear_impact(needle, ball, 0).clear);
  const Flat sliver{{-0x1.e7c5471d24c5p-3, -0x1.5ac5b40ea0aacp-1, 0x1.bad93b8ed786p-4},
                    {0, 0, 0},
                    {-0x1.2ab772a0c937p-24, 0x1.d9f4ac36d1cfp-49, -0x1.f8bb45297fee8p-56}};
  const Moving<Ball> slow{{{-0x1.2291df2aab09cp-24, 0x1.4cc1d87060e43p-5, 0x1.0490b8b7a08a2p-2}, 0x1.07dd44aa96adcp-2},
                          {-0x1.ep-53, -0x1.42f6e256p-28, -0x1.f9cb4b4dp-26}};
  EXPECT_FALSE(clear_impact(at_rest(sliver), slow, 0).clear);
}

TEST(LadderFilters, a_ray_from_beside_a_corner_is_in_doubt_about_the_far_edge) {
  const Flat hit{{-0.0, -0x1p-23, 0x1.353780bafebf8p+0},
                 {-0x1.0c8cee745b9ap-4, 0x1.cb6e5e0ae4228p+0, 0x1.4947e5d32bdd5p+1},
                 {0, -0x1.2f85c53c325acp+0, 0x1.c6a670a9148aep+0}};
  const Ray<double> by_corner{{0x1.b342610fa5ac2p-24, -0x1.42fc32a9d0e1dp-23, 0x1.35378277f6f83p+0},
                              {-0x1.3f73cbefe8058p-19, 0x1.2c84c7f1d4e1p-15, 0x1.0ab6b91b71443p-14}};
  EXPECT_FALSE(clear_raycast(by_corner, hit).clear);
  const Flat at_origin{{0, 0, 0},
                       {0x1.1bbe6f3a4fdc4p-2, -0x1.3f4038e5a92fp-2, -0x1.245c4076a99b3p-1},
                       {0x1.31a2826f01789p+0, -0x1.4f52a3ade2f06p+0, -0x1.34a60b4c559a3p+1}};
  const Ray<double> next_to_nothing{{-0x0.00000031a1fb8p-1022, 0x0.0000002201d5ap-1022, 0x0.00000020eb025p-1022},
                                    {0x1.0487955be0394p-25, 0x1.e3fc33350406p-28, 0x1.a63f6de0c3ebcp-25},
                                    1};
  EXPECT_FALSE(clear_raycast(next_to_nothing, at_origin).clear);
}

TEST(LadderFilters, parallel_capsules_touch_in_more_than_one_place) {
  const Rod rod{{0, 0, 0}, {0, 0, 1}, 0.25}, beside{{3, 0, 0.25}, {3, 0, 1.75}, 0.25},
      askew{{3, 0, 0.25}, {3, 0.75, 1.5}, 0.25};
  const auto is_clear_towards = [&](const Rod& to, double by) {
    return clear_impact(Moving<Rod>{rod, {by, 0, 0}}, at_rest(to), 0).clear;
  };
  EXPECT_FALSE(is_clear_towards(beside, 4));
  EXPECT_TRUE(is_clear_towards(beside, 2)) << "a miss has a plane for all that";
  EXPECT_TRUE(is_clear_towards(askew, 4));
  EXPECT_FALSE(clear_contact(rod, Rod{{0.3, 0, 0.25}, {0.3, 0, 1.5}, 0.25}).clear);
}

// Both in exact numbers: a normal of both cores that is tilted by a rounding put a face's place off by the square of that over their angle.
TEST(CarefulRung, sees_capsules_meet_that_are_nearly_parallel) {
  const Moving<Rod> a{{{0, 0, 0}, {0x1.b737f78e5e094p-3, 0x1.9030f882f2007p-3, -0x1.59b3f46db82cp-4}, 0x1p-7},
                      {-0x1.e261aed890137p+0, -1.5, 1.5}};
  const Moving<Rod> b{{{-0x1.1ee38f0f7d92p-6, -0x1.fca771a3d46c2p-4, 0x1.9792af61f34f2p-5},
                       {0x1.0fb547d4cdd0ap-2, 0x1.11dbad97d390fp-3, -0x1.f43845dc3c5cep-5},
                       0x1.328eb0192a75p-4},
                      {-0x1.e261acb9f70cdp+0, -0x1.7fffcp+0, 0x1.7ffffffffcafp+0}};
  const Toi<double> graze = careful_impact({}, a, b);
  EXPECT_EQ(graze.status, ToiStatus::hit);
  EXPECT_NEAR(graze.time, 0.875, 0x1p-30);
  const Moving<Rod> c{{{0, 0, 0}, {0x1.222d06dca0d3p-4, 0, -0x1.222d06dca0d3p-4}, 1},
                      {0x1.76fe7d9d63bf8p-2, 0x1.98a340b4ebf58p+0, 0x1.28246c9a1640cp-2}};
  const Rod d{{0x1.72bb080dfbe08p+0, 0x1.a808274520207p-1, 0x1.62a8e8db35d2p+0},
              {0x1.84eaa50bf700ap+0, 0x1.a8382dc2177cbp-1, 0x1.506eb0a2b4bfp+0},
              0x1p-5};
  EXPECT_NEAR(careful_impact({1}, c, at_rest(d)).time, 0.13957987260374352, 1e-14);
}

// ---- The same of the queries at one instant.

/// agrees(a, b) of two shapes at one instant is 1 if the clear rung answers, which it does of most that are drawn, and 0 if not.
template <class Agrees> void expect_most_are_clear(unsigned seed, const Agrees& agrees) {
  Shaker<double> draw(seed);
  std::size_t clear = 0, of_turned = 0, of_cores = 0, of_triangles = 0;
  for (std::size_t n = 0; n < cases; ++n) {
    const Ball a = drawn(draw, TypeTag<Ball>{}), b = drawn(draw, TypeTag<Ball>{});
    const Box c = drawn(draw, TypeTag<Box>{}), d = drawn(draw, TypeTag<Box>{});
    const Turned g = drawn(draw, TypeTag<Turned>{}), h = drawn(draw, TypeTag<Turned>{});
    clear += agrees(a, b) + agrees(c, a) + agrees(c, d);
    of_turned += agrees(g, a) + agrees(c, g) + agrees(g, h);
    const Rod e = drawn(draw, TypeTag<Rod>{}), f = drawn(draw, TypeTag<Rod>{});
    of_cores += agrees(e, a) + agrees(e, f) + agrees(c, e) + agrees(g, e);
    const Flat i = drawn(draw, TypeTag<Flat>{});
    of_triangles += agrees(i, b) + agrees(e, i);
  }
  EXPECT_GE(clear, 2 * cases);
  EXPECT_GE(of_turned, cases);
  EXPECT_GE(of_cores, 2 * cases);
  EXPECT_GE(of_triangles, cases / 2);
}

TEST(LadderAtOneInstant, contacts_agree) {
  expect_most_are_clear(19, [](const auto& a, const auto& b) {
    const ClearContact rung = clear_contact(a, b);
    if (!rung.clear) return 0U;
    const auto clear = rung.contact(), careful = careful_contact(a, b), door = contact(b, a);
    EXPECT_EQ(clear.has_value(), careful.has_value());
    EXPECT_EQ(clear.has_value(), door.has_value());
    EXPECT_EQ(clear.has_value(), overlaps(a, b));
    EXPECT_EQ(clear.has_value(), careful_overlaps(a, b));
    if (!clear || !careful || !door) return 1U;
    const double off = 8 * u * (magnitude(a) + magnitude(b));
    EXPECT_NEAR(clear->penetration, careful->penetration, off);
    const V by_a = clear->local_a - careful->local_a, by_b = clear->local_b - careful->local_b;
    EXPECT_LE(std::abs(by_a.dot(careful->normal)), off);
    EXPECT_LE(std::abs(by_b.dot(careful->normal)), off);
    // cores all but parallel, or all but touching, have their points where rounding says, and so what is turned has them; rods and plates that
    // lie level, somewhere along what they share
    constexpr bool is_rounded = requires { a.b; } || requires { b.b; } || requires { a.axes; } || requires { b.axes; };
    constexpr bool boxes_of_which_one_is_turned = is_rounded && requires { a.half_extents, b.half_extents; };
    const double along = std::max(by_a.cwiseAbs().maxCoeff(), by_b.cwiseAbs().maxCoeff());
    const auto lies_level_at = [&](const auto& box, const V& place) {
      V own = clear->normal;
      if constexpr (requires { box.axes; }) own = box.axes.transpose() * own;
      const bool is_level = own.cwiseAbs().sum() - own.cwiseAbs().maxCoeff() <= 0x1p-48;
      return is_level && careful_separation(box, Ball{place, 0}).distance <= off;
    };
    const V on_b = center(b) + clear->local_b, on_a = on_b + clear->normal * clear->penetration;
    EXPECT_TRUE(along <= (is_rounded ? 0x1p22 * off : off) ||
                (boxes_of_which_one_is_turned && lies_level_at(a, on_a) && lies_level_at(b, on_b)))
        << along;
    EXPECT_NEAR(clear->penetration, door->penetration, is_rounded ? off : 0);
    return 1U;
  });
}

TEST(LadderAtOneInstant, separations_agree) {
  expect_most_are_clear(31, [](const auto& a, const auto& b) {
    if (!clear_gap(a, b).clear) return 0U;
    const Separation<double> door = separation(a, b), careful = careful_separation(a, b), back = separation(b, a);
    const double off = 8 * u * (magnitude(a) + magnitude(b));
    EXPECT_NEAR(door.distance, careful.distance, off);
    EXPECT_NEAR(door.distance, back.distance, off);
    // cores all but parallel have their places where rounding says, and so their gap's direction; boxes that share a center, both ways alike
    constexpr bool two_cores = requires { a.b, b.b; }, two_boxes = requires { a.half_extents, b.half_extents; };
    const double gap = door.distance + skin_radius(a) + skin_radius(b), turned = (door.normal + back.normal).norm();
    const double leaning = two_boxes ? 0x1p23 : two_cores ? 0x1p10 : 2;
    if (!two_boxes || gap > 0) {
      EXPECT_LE(turned * std::abs(gap), leaning * off);
    }
    EXPECT_LE((door.point_b - door.point_a - door.normal * door.distance).norm(), off);
    EXPECT_LE(std::abs(careful_separation(a, Ball{door.point_a, 0}).distance), off);
    EXPECT_LE(std::abs(careful_separation(b, Ball{door.point_b, 0}).distance), off);
    return 1U;
  });
}

TEST(LadderAtOneInstant, overlaps_agree) {
  Shaker<double> draw(29);
  const auto agrees = [](const auto& a, const auto& b) {
    const ClearOverlap rung = clear_overlap(a, b);
    if (!rung.clear) return 0U;
    EXPECT_EQ(rung.overlaps, careful_overlaps(a, b));
    EXPECT_EQ(rung.overlaps, overlaps(b, a));
    return 1U;
  };
  std::size_t clear = 0;
  for (std::size_t i = 0; i < cases; ++i) {
    const Turned a = drawn(draw, TypeTag<Turned>{}), b = drawn(draw, TypeTag<Turned>{});
    clear += agrees(a, b) + agrees(a, drawn(draw, TypeTag<Box>{}));
    const auto gap = separation(a, b);  // and as good as touching, parallel or not
    const double apart = draw.plain() * power<double>(-draw.pick(20, 50));
    agrees(a, moved<double>(b, V(gap.normal * (apart - gap.distance))));
  }
  EXPECT_GE(clear, cases);
}

// Two long boxes lie edge on edge, one turned a little across the other: nothing parts them but the product of the edges that are all but
// parallel, whose length is that of the turn.
TEST(LadderAtOneInstant, edges_all_but_parallel_part_boxes) {
  const double c = std::sqrt(0.5), h = 0.25, turn = 0x1p-18;
  const Mat3<double> on_edge = turn_in_plane<double>(1, 2, c, c);
  const Turned below{V::Zero(), {1, h, h}, on_edge};
  for (const double gap : {turn / 2, -turn / 2}) {
    const Turned above{
        {0, 0, 2 * h / c + gap}, {1, h, h}, turn_in_plane<double>(0, 1, std::cos(turn), std::sin(turn)) * on_edge};
    EXPECT_TRUE(clear_overlap(below, above).clear);
    EXPECT_EQ(overlaps(below, above), gap < 0);
    EXPECT_EQ(careful_overlaps(below, above), gap < 0);
  }
}

// Of a place high over a narrow triangle, beside its long leg, the distances to both long edges are the same to rounding.
TEST(LadderAtOneInstant, the_nearest_edge_is_told_by_its_side) {
  const Flat narrow{{0, 0, 0}, {1, 0, 0}, {0, 0x1p-33, 0}};
  const Ball above{{0.5, -0x1p-34, 0.5}, 0.25};
  EXPECT_TRUE(clear_gap(narrow, above).clear);
  EXPECT_NEAR(separation(narrow, above).normal[1], -0x1p-33, 0x1p-53);
}

// A corner of a crumb is right below the center, where the sides that it is on of the two edges and of their ends are roundings that contradict
// each other.
TEST(LadderAtOneInstant, no_place_is_made_up_of_contradictions) {
  const Flat crumb{{0, 0, 0}, {0x1p-27 * 5, 0x1p-27 * -63, 0x1p-27 * -49}, {0x1p-27 * 58, 0x1p-27 * 20, 0x1p-27 * 50}};
  const Ball above{{-0x1.a13ef76ab8428p-2, -0x1.2943944398bedp-1, 0x1.68e872070421p-1}, 0x1.00000000002p+0};
  EXPECT_TRUE(careful_overlaps(crumb, above));
  EXPECT_TRUE(overlaps(crumb, above));
  EXPECT_TRUE(contact(crumb, above));
}

/// 1 if the clear rung answers, which must agree with the careful one.
template <class Shape> std::size_t ray_agrees_if_clear(const Ray<double>& ray, const Shape& shape) {
  const ClearRayHit rung = clear_raycast(ray, shape);
  if (!rung.clear) return 0;
  const auto clear = rung.ray_hit(), careful = careful_raycast(ray, shape), door = raycast(ray, shape);
  EXPECT_EQ(clear.has_value(), careful.has_value());
  EXPECT_EQ(clear.has_value(), door.has_value());
  if (!clear || !careful || !door) return 1;
  const V path = ray.direction * careful->t;  // what the contract counts, docs/closed_forms.md
  const double size = ray.origin.cwiseAbs().sum() + path.cwiseAbs().sum() + magnitude(shape);
  EXPECT_NEAR(clear->t, careful->t, 4 * u * size / std::abs(careful->normal.dot(ray.direction)));
  EXPECT_EQ(clear->t, door->t);
  return 1;
}

// Aimed at a shape or beside it, from near or from where roundings are as large as it is; and nearly along a rod, or a box's axis.
TEST(LadderAtOneInstant, rays_agree) {
  Shaker<double> draw(37);
  std::size_t clear = 0, plainly_clear = 0;
  const auto ask = [&](const auto& shape, const V& axis) {
    const V direction =
        draw.pick(0, 1) == 0 ? draw.vector() : V(axis + draw.vector() * power<double>(-draw.pick(0, 60)));
    const V target = center(shape) + draw.vector() * (draw.pick(0, 1) == 0 ? 1.0 : 0.1);
    const V origin = target - direction * power<double>(draw.pick(-4, 60));
    clear += ray_agrees_if_clear(Ray<double>{origin, direction * power<double>(draw.pick(-40, 40))}, shape);
    const double most = draw.pick(0, 1) == 0 ? infinity : 1.0;
    plainly_clear += ray_agrees_if_clear(Ray<double>{draw.vector() * 2, draw.vector(), most}, shape);
  };
  for (std::size_t i = 0; i < cases; ++i) {
    const Rod rod = drawn(draw, TypeTag<Rod>{});
    const Turned turned = drawn(draw, TypeTag<Turned>{});
    ask(rod, rod.b - rod.a);
    ask(turned, turned.axes.col(0));
    ask(Turned{turned.center, turned.half_extents, Mat3<double>::Identity()}, V::UnitX());
    ask(drawn(draw, TypeTag<Box>{}), V::UnitY());
    ask(drawn(draw, TypeTag<Ball>{}), V::UnitZ());
    ask(drawn(draw, TypeTag<Flat>{}), V::UnitZ());
  }
  EXPECT_GE(clear, cases);
  EXPECT_GE(plainly_clear, 4 * cases);
}

// A size near 1 would be 0 for the gap between these plates, and let them touch.
TEST(LadderAtOneInstant, sizes_far_apart_are_not_scaled) {
  const Box wide{{0, 0x1p-714, 0}, {0x1p515, 0, 1}}, tiny{{0, 0, 0}, {0x1p-937, 0x1p-986, 1}};
  EXPECT_FALSE(overlaps(wide, tiny));
  EXPECT_FALSE(contact(wide, tiny));
}

TEST(LadderAtOneInstant, doubt_is_careful) {
  const Ball ball{{0, 0, 0}, 1};
  EXPECT_FALSE(clear_contact(ball, Ball{{2, 0, 0}, 1}).clear);
  EXPECT_FALSE(clear_contact(ball, Ball{{0, 0, 0}, 1}).clear);
  EXPECT_FALSE(clear_contact(Box{{0, 0, 0}, {1, 1, 1}}, Ball{{2, 0, 0}, 1}).clear);
  EXPECT_FALSE(clear_contact(Box{{0, 0, 0}, {1, -1, 1}}, Box{{1, 0, 0}, {1, 3, 1}}).clear);
  EXPECT_FALSE(clear_raycast(Ray<double>{{-4, 1, 0}, {1, 0, 0}}, ball).clear);
  EXPECT_FALSE(clear_raycast(Ray<double>{{-4, 0, 0}, {1, 0, 0}, 3}, ball).clear);
  EXPECT_FALSE(clear_raycast(Ray<double>{{-4, 0, 0}, {1, 0, 0}, -3}, ball).clear);
  EXPECT_FALSE(clear_raycast(Ray<double>{{-4, 0, 0}, {1, 0, 0}, 3}, Box{{0, 0, 0}, {1, 1, 1}}).clear);
  EXPECT_FALSE(clear_raycast(Ray<double>{{-4, 0, 0}, {1, 0, 0}, 3}, to_obb(Box{{0, 0, 0}, {1, 1, 1}})).clear);
  EXPECT_TRUE(clear_raycast(Ray<double>{{-4, 0, 0}, {1, 0, 0}, 3.5}, ball).clear);
  EXPECT_TRUE(clear_raycast(Ray<double>{{-4, 0, 0}, {1, 0, 0}, 3.5}, Box{{0, 0, 0}, {1, 1, 1}}).clear);
  EXPECT_TRUE(clear_contact(ball, Ball{{1, 0, 0}, 1}).clear);
  const Ball above{{0, 0, 1}, 0.5};
  EXPECT_TRUE(clear_contact(Flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, above).clear);
  EXPECT_FALSE(clear_contact(Flat{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, above).clear);
  EXPECT_FALSE(clear_contact(Flat{{0, 0, 0}, {1, 0, 0}, {1, 0x1p-5, 0}}, above).clear);
  const Flat floor{{-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}};
  EXPECT_TRUE(clear_contact(Rod{{0, 0, 1}, {0, 0.5, 2}, 0.5}, floor).clear);
  EXPECT_FALSE(clear_contact(Rod{{0, 0, -1}, {0, 0.5, 2}, 0.5}, floor).clear) << "its core crosses";
  EXPECT_FALSE(clear_contact(Rod{{0, 0, 1}, {0, 0.5, 1}, 0.5}, floor).clear) << "level";
  const Turned turned{{2, 0, 0}, {1, 1, 1}, Mat3<double>::Identity()};
  EXPECT_FALSE(clear_overlap(turned, Box{{0, 0, 0}, {1, 1, 1}}).clear);
  EXPECT_TRUE(clear_overlap(turned, Box{{0, 0, 0}, {1 + 0x1p-40, 1, 1}}).clear);
  EXPECT_FALSE(clear_overlap(turned, Box{{0, 0, 0}, {2, -1, 1}}).clear);
}

}  // namespace
}  // namespace thinwall::testing
