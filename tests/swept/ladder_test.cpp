// The ladder of clear and careful: which rung decides, and that both say the same. The careful rung is held against oracles by every
// other test; here the clear one is held against the careful.

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/shaker.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {
namespace {

using Ball = Sphere<double>;
using Box = Aabb<double>;
using Turned = Obb<double>;
using Rod = Capsule<double>;
using V = Vec3<double>;
constexpr double u = 0x1p-53, infinity = std::numeric_limits<double>::infinity();
const std::size_t cases = thorough(slow_build ? 2'000 : 100'000);

template <class A, class B> struct Pairing {
  using First = A;
  using Second = B;
};
template <class T> class Ladder : public ::testing::Test {};
using ClearPairs = ::testing::Types<Pairing<Ball, Ball>, Pairing<Box, Ball>, Pairing<Box, Box>, Pairing<Turned, Ball>,
                                    Pairing<Rod, Ball>, Pairing<Turned, Box>>;
TYPED_TEST_SUITE(Ladder, ClearPairs, );

/// Two bodies of like size some sizes apart, one shot at the other or past it: what a scene asks.
template <class A, class B> Motion<A, B> everyday_shot(Shaker<double>& draw) {
  const auto any = [&] { return V(draw.plain(), draw.plain(), draw.plain()); };
  const auto any_turn = [&] {
    Mat3<double> axes;
    axes.col(0) = safe_unit(any());
    axes.col(1) = safe_unit(thinwall::cross<double>(axes.col(0), any()));
    axes.col(2) = thinwall::cross<double>(axes.col(0), axes.col(1));
    return axes;
  };
  const auto sized = [&]<class T>(T shape) {
    if constexpr (std::is_same_v<T, Ball>) shape = {V::Zero(), 0.3 + 0.25 * draw.plain()};
    if constexpr (std::is_same_v<T, Box>) shape = {V::Zero(), V::Constant(0.3) + any() * 0.25};
    if constexpr (std::is_same_v<T, Turned>) shape = {V::Zero(), V::Constant(0.3) + any() * 0.25, any_turn()};
    if constexpr (std::is_same_v<T, Rod>) shape = {any() * 0.5, any() * 0.5, 0.2 + 0.15 * draw.plain()};
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

TYPED_TEST(Ladder, clear_decides_the_shots_of_a_scene) {
  Shaker<double> draw(11);
  std::size_t clear = 0;
  for (std::size_t i = 0; i < cases; ++i) {
    clear += agrees_if_clear(everyday_shot<typename TypeParam::First, typename TypeParam::Second>(draw), 0.0) ? 1U : 0U;
  }
  EXPECT_GE(static_cast<double>(clear), 0.99 * static_cast<double>(cases));
}

/// The same shot straight along an axis, as things fall; boxes upright.
template <class A, class B> Motion<A, B> straight_shot(Shaker<double>& draw) {
  Motion<A, B> motion = everyday_shot<A, B>(draw);
  if constexpr (std::is_same_v<A, Turned>) motion.a.shape.axes.setIdentity();
  if constexpr (std::is_same_v<A, Rod>) motion.a.shape.b = motion.a.shape.a + V(0, 0, 0.5);
  const V at = center(motion.a.shape) - center(motion.b.shape);
  motion.a.displacement.setZero();
  motion.b.displacement.setZero();
  const int axis = std::is_same_v<A, Rod> && draw.pick(0, 1) == 0 ? 2 : draw.pick(0, 2);
  motion.b.displacement[axis] = (draw.pick(0, 1) == 0 ? 4 : -4) + draw.plain();
  motion.b.shape =
      moved<double>(motion.b.shape, V(at - motion.b.displacement * 0.7 + V(draw.plain(), draw.plain(), draw.plain())));
  return motion;
}

TYPED_TEST(Ladder, clear_decides_what_falls_straight) {
  using A = typename TypeParam::First;
  using B = typename TypeParam::Second;
  if constexpr (std::is_same_v<A, Turned> && std::is_same_v<B, Box>) {
    GTEST_SKIP() << "faces that are level are the careful rung's";
  }
  Shaker<double> draw(31);
  std::size_t clear = 0, apart = 0;
  for (std::size_t i = 0; i < cases; ++i) {
    const Motion<A, B> motion = straight_shot<A, B>(draw);
    if (overlaps(motion.a.shape, motion.b.shape)) continue;
    ++apart;
    clear += agrees_if_clear(motion, 0.0) ? 1U : 0U;
  }
  EXPECT_GE(static_cast<double>(clear), 0.99 * static_cast<double>(apart));
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

TYPED_TEST(Ladder, clear_and_careful_agree_on_odd_motions) {
  Shaker<double> draw(37);
  for (std::size_t i = 0; i < cases; ++i) {
    const auto motion = odd_motion<typename TypeParam::First, typename TypeParam::Second>(draw);
    if (valid(motion.a) && valid(motion.b)) agrees_if_clear(motion, 0.0);
  }
}

TYPED_TEST(Ladder, clear_and_careful_agree_on_motions_drawn_to_go_wrong) {
  Shaker<double> draw(13);
  std::size_t clear = 0;
  for (std::size_t i = 0; i < 2 * cases; ++i) {
    auto motion = drawn_motion<typename TypeParam::First, typename TypeParam::Second>(draw);
    if (draw.pick(0, 9) == 0) {
      const int scale = draw.pick(-600, 600);
      motion = {scaled(motion.a, scale), scaled(motion.b, scale)};
    }
    clear += agrees_if_clear(motion, draw.pick(0, 9) == 0 ? 0.25 * std::abs(draw.plain()) : 0.0) ? 1U : 0U;
  }
  EXPECT_GE(clear, cases / 3) << "too few to mean anything";
}

TYPED_TEST(Ladder, the_front_door_climbs_it) {  // from either side
  Shaker<double> draw(17);
  for (int i = 0; i < 2000; ++i) {
    const auto motion = drawn_motion<typename TypeParam::First, typename TypeParam::Second>(draw);
    const ClearToi rung = clear_impact(motion.a, motion.b, 0);
    const Toi<double> expected = rung.clear ? rung.toi() : careful_impact({}, motion.a, motion.b);
    const Toi<double> toi = time_of_impact(motion.a, motion.b);
    EXPECT_EQ(toi.status, expected.status);
    EXPECT_EQ(toi.time, expected.time);
    EXPECT_EQ(toi.normal, expected.normal);
    if constexpr (!std::is_same_v<typename TypeParam::First, typename TypeParam::Second>) {
      EXPECT_EQ(time_of_impact(motion.b, motion.a).normal, V(V::Zero() - expected.normal));
    }
  }
}

// ---- Which rung decides what: doubt, and beside it none.

bool is_clear(const Moving<Ball>& ball, const Ball& target, double gap = 0) {
  return clear_impact(ball, at_rest(target), gap).clear;
}
bool is_clear(const Box& box, const Moving<Ball>& ball, double gap = 0) {
  return clear_impact(at_rest(box), ball, gap).clear;
}
bool is_clear(const Box& a, const Moving<Box>& b, double gap = 0) { return clear_impact(at_rest(a), b, gap).clear; }

TEST(LadderFilters, a_graze_is_careful) {
  const auto at_height = [](double y) { return is_clear({Ball{{-4, y, 0}, 1}, {8, 0, 0}}, Ball{{0, 0, 0}, 1}); };
  EXPECT_FALSE(at_height(2));
  EXPECT_FALSE(at_height(2 - 0x1p-12));
  EXPECT_FALSE(at_height(2 + 0x1p-12));
  EXPECT_TRUE(at_height(2 - 0x1p-8));
  EXPECT_TRUE(at_height(2 + 0x1p-8));
}

TEST(LadderFilters, the_end_of_the_step_is_careful) {  // gap 2, met at 1
  const auto at_speed = [](double speed) { return is_clear({Ball{{-4, 0, 0}, 1}, {speed, 0, 0}}, Ball{{0, 0, 0}, 1}); };
  EXPECT_FALSE(at_speed(2));
  EXPECT_FALSE(at_speed(2 + 0x1p-12));
  EXPECT_TRUE(at_speed(2 + 0x1p-6));
  EXPECT_TRUE(at_speed(2 - 0x1p-6));
}

TEST(LadderFilters, a_start_in_touch_is_careful) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  for (const double x : {-1.5, -2.0, std::nextafter(-2.0, -3.0)}) {
    EXPECT_FALSE(is_clear({Ball{{x, 0, 0}, 1}, {8, 0, 0}}, Ball{{0, 0, 0}, 1})) << x;
    EXPECT_FALSE(is_clear(box, {Ball{{x, 0, 0}, 1}, {8, 0, 0}})) << x;
  }
  EXPECT_FALSE(is_clear(box, {Box{{-2, 0, 0}, {1, 1, 1}}, {8, 0, 0}}));
  EXPECT_TRUE(is_clear({Ball{{-2 - 0x1p-20, 0, 0}, 1}, {8, 0, 0}}, Ball{{0, 0, 0}, 1}));
  EXPECT_TRUE(is_clear(box, {Ball{{-2 - 0x1p-20, 0, 0}, 1}, {8, 0, 0}}));
  EXPECT_TRUE(is_clear(box, {Box{{-2 - 0x1p-20, 0, 0}, {1, 1, 1}}, {8, 0, 0}}));
}

TEST(LadderFilters, an_edge_met_by_an_edge_is_careful) {  // the slabs of x and y open and close at one time
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_FALSE(is_clear(box, {Box{{-4, 0, 0}, {1, 1, 1}}, {4, 4, 0}}));
  EXPECT_TRUE(is_clear(box, {Box{{-4, 0, 0}, {1, 1, 1}}, {4, 3, 0}}));
}

TEST(LadderFilters, a_graze_of_a_rod_is_careful) {  // of its side, of its caps, and along it
  const auto is_sure = [](const V& from, const V& by) {
    return clear_impact(at_rest(Rod{{0, 0, 0}, {0, 0, 4}, 1}), Moving<Ball>{{from, 1}, by}, 0).clear;
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

// A hundredth of the gap beside it, which is a few roundings.
TEST(LadderFilters, an_end_within_the_noise_of_a_creep_is_careful) {
  const auto creep = [](double gap) {
    const Moving<Ball> ball{{{-2 - gap, 0, 0}, 1}, {gap * 1.01, 0, 0}};
    return clear_impact(at_rest(Turned{{0, 0, 0}, {1, 1, 1}, Mat3<double>::Identity()}), ball, 0).clear;
  };
  EXPECT_FALSE(creep(0x1p-43));
  EXPECT_TRUE(creep(0x1p-20));
}

// The slabs of x and y open both at zero, as far as double tells.
TEST(LadderFilters, quotients_that_underflow_are_careful) {
  const Box plate{{0, 0, 0}, {1, 1e-300, 1}};
  const V above(0, std::nextafter(1e-300, 1.0), 0), by(1, -1e12, 0);
  EXPECT_FALSE(clear_raycast(Ray<double>{above, by}, plate).clear);
  EXPECT_FALSE(is_clear(plate, {Box{above, {0, 0, 0}}, by}));
}

TEST(LadderFilters, axes_that_are_off_are_careful) {  // by more than a few roundings
  Turned box{{0, 0, 0}, {1, 1, 1}, Mat3<double>::Identity()};
  const auto is_sure = [&] {
    const bool impact = clear_impact(at_rest(box), Moving<Ball>{{{-4, 0, 0}, 1}, {8, 0.5, 0.5}}, 0).clear;
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

TEST(LadderFilters, what_is_no_question_or_out_of_range_is_careful) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto ball = [](double x, double radius, double speed) {
    return Moving<Ball>{{{x, 0, 0}, radius}, {speed, 0, 0}};
  };
  for (const double bad : {nan, infinity, -infinity, 1e300, -1e300}) {
    EXPECT_FALSE(is_clear(ball(bad, 1, 8), Ball{{0, 0, 0}, 1})) << bad;
    EXPECT_FALSE(is_clear(ball(-4, 1, bad), Ball{{0, 0, 0}, 1})) << bad;
    EXPECT_FALSE(is_clear(ball(-4, bad, 8), Ball{{0, 0, 0}, 1})) << bad;
    EXPECT_FALSE(is_clear(box, ball(bad, 1, 8))) << bad;
    EXPECT_FALSE(is_clear(box, ball(-4, 1, bad))) << bad;
    EXPECT_FALSE(is_clear(box, ball(-4, bad, 8))) << bad;
    EXPECT_FALSE(is_clear(box, {Box{{bad, 0, 0}, {1, 1, 1}}, {8, 0, 0}})) << bad;
    EXPECT_FALSE(is_clear(box, {Box{{-4, 0, 0}, {1, bad, 1}}, {8, 0, 0}})) << bad;
    EXPECT_FALSE(is_clear(box, {Box{{-4, 0, 0}, {1, 1, 1}}, {8, 0, bad}})) << bad;
  }
  EXPECT_FALSE(is_clear(ball(-4, -0.5, 8), Ball{{0, 0, 0}, 1}));
  EXPECT_FALSE(is_clear(ball(-4, 1, 8), Ball{{0, 0, 0}, 1}, -0.5));
  EXPECT_FALSE(is_clear(ball(-4, 1, 8), Ball{{0, 0, 0}, 1}, nan));
  EXPECT_FALSE(is_clear(box, ball(-4, 1, 8), -0.5));
  EXPECT_FALSE(is_clear(Box{{0, 0, 0}, {1, -1, 1}}, ball(-4, 3, 8)));
  EXPECT_FALSE(is_clear(ball(-4, 0, 8), Ball{{0, 0, 0}, 0}));
  EXPECT_FALSE(is_clear(ball(-4, 1, 0), Ball{{0, 0, 0}, 1}));
}

TEST(LadderFilters, a_size_below_zero_is_invalid_however_small_beside_the_rest) {
  const Moving<Ball> a{{{-0x1p+900, 0, 0}, 0x1p+890}, {0x1p+901, 0, 0}}, b{{{0, 0, 0}, -0x1p-606}, {0, 0, 0}};
  EXPECT_EQ(time_of_impact(a, b).status, ToiStatus::invalid);
  EXPECT_EQ(time_of_impact(ClosedForm<double>{-0x1p-606}, a, a).status, ToiStatus::invalid);
}

// ---- The same of the queries at one instant.

TEST(LadderAtOneInstant, contacts_agree) {
  Shaker<double> draw(19);
  const auto agrees = [](const auto& a, const auto& b) {
    const ClearContact rung = clear_contact(a, b);
    if (!rung.clear) return 0U;
    const auto clear = rung.contact(), careful = careful_contact(a, b), door = contact(b, a);
    EXPECT_EQ(clear.has_value(), careful.has_value());
    EXPECT_EQ(clear.has_value(), door.has_value());
    if (!clear || !careful || !door) return 1U;
    const double off = 8 * u * (magnitude(a) + magnitude(b));
    EXPECT_NEAR(clear->penetration, careful->penetration, off);
    EXPECT_LE((clear->local_a - careful->local_a).cwiseAbs().maxCoeff(), off);
    EXPECT_LE((clear->local_b - careful->local_b).cwiseAbs().maxCoeff(), off);
    EXPECT_EQ(clear->penetration, door->penetration);
    return 1U;
  };
  std::size_t clear = 0;
  for (std::size_t i = 0; i < cases; ++i) {
    const Ball a = drawn(draw, TypeTag<Ball>{}), b = drawn(draw, TypeTag<Ball>{});
    const Box c = drawn(draw, TypeTag<Box>{}), d = drawn(draw, TypeTag<Box>{});
    clear += agrees(a, b) + agrees(c, a) + agrees(c, d);
  }
  EXPECT_GE(clear, 2 * cases);
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
  }
  EXPECT_GE(clear, cases);
}

TEST(LadderAtOneInstant, rays_agree) {
  Shaker<double> draw(23);
  const auto agrees = [](const Ray<double>& ray, const auto& shape) {
    const ClearRayHit rung = clear_raycast(ray, shape);
    if (!rung.clear) return 0U;
    const auto clear = rung.ray_hit(), careful = careful_raycast(ray, shape), door = raycast(ray, shape);
    EXPECT_EQ(clear.has_value(), careful.has_value());
    EXPECT_EQ(clear.has_value(), door.has_value());
    if (!clear || !careful || !door) return 1U;
    const double size = magnitude(ray) + magnitude(shape);
    EXPECT_NEAR(clear->t, careful->t, 4 * u * size / std::abs(careful->normal.dot(ray.direction)));
    EXPECT_EQ(clear->t, door->t);
    return 1U;
  };
  std::size_t clear = 0;
  for (std::size_t i = 0; i < cases; ++i) {
    const Ray<double> ray{draw.vector() * 2, draw.vector(), draw.pick(0, 1) == 0 ? infinity : 1.0};
    clear += agrees(ray, drawn(draw, TypeTag<Ball>{})) + agrees(ray, drawn(draw, TypeTag<Box>{})) +
             agrees(ray, drawn(draw, TypeTag<Turned>{})) + agrees(ray, drawn(draw, TypeTag<Rod>{}));
  }
  EXPECT_GE(clear, 3 * cases);
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
  EXPECT_TRUE(clear_raycast(Ray<double>{{-4, 0, 0}, {1, 0, 0}, 3.5}, ball).clear);
  EXPECT_TRUE(clear_raycast(Ray<double>{{-4, 0, 0}, {1, 0, 0}, 3.5}, Box{{0, 0, 0}, {1, 1, 1}}).clear);
  EXPECT_TRUE(clear_contact(ball, Ball{{1, 0, 0}, 1}).clear);
  const Turned turned{{2, 0, 0}, {1, 1, 1}, Mat3<double>::Identity()};
  EXPECT_FALSE(clear_overlap(turned, Box{{0, 0, 0}, {1, 1, 1}}).clear);
  EXPECT_TRUE(clear_overlap(turned, Box{{0, 0, 0}, {1 + 0x1p-40, 1, 1}}).clear);
  EXPECT_FALSE(clear_overlap(turned, Box{{0, 0, 0}, {2, -1, 1}}).clear);
}

}  // namespace
}  // namespace thinwall::testing
