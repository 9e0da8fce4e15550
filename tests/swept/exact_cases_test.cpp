// Every exact case at every scalar, and the same cases passed the other way round, moved and mirrored.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/exact_cases.hpp"
#include "support/judge.hpp"
#include "support/numbers_of.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

template <class S> struct ExactCases : ::testing::Test {
  template <class Check> static void each(const Check& check) { for_each_exact_case<S>(check); }
};
TYPED_TEST_SUITE(ExactCases, Scalars, ScalarNames);

/// A touch cannot be told from a miss by kappa: the time of a graze must not be later than the contact, nor earlier
/// than a backward error of 4 u would put it.
template <class S> AssertionResult judge_graze(const oracle::Pair& pair, const S& time) {
  const oracle::Impact truth = oracle::impact(pair);
  const oracle::Real slack = truth.time - oracle::earliest_time<S>(pair, truth, 4);
  const oracle::Real late = oracle::lift(time) - truth.time;
  if (abs(late) <= slack) return AssertionSuccess();
  return AssertionFailure() << "off by " << late << " where " << slack << " is the most";
}

template <class A, class B> void expect_exact(const Moving<A>& a, const Moving<B>& b) {
  const auto pair = oracle::pair(a, b);
  const auto toi = time_of_impact(a, b);
  EXPECT_TRUE(judge(pair, toi));
  if (toi.status == ToiStatus::hit) {
    EXPECT_TRUE(judge_graze(pair, toi.time));
  }
}

TYPED_TEST(ExactCases, oracle_agrees_with_the_table) {
  this->each([](const auto& c) {
    const oracle::Impact truth = oracle::impact(oracle::pair(c.a, c.b));
    if (c.as_written) {
      EXPECT_EQ(text(status_of(truth.verdict)), text(c.status));
    }
    if (std::is_same_v<TypeParam, double> && c.listed) {
      EXPECT_NEAR(truth.time.template convert_to<double>(), *c.listed, 1e-16 + 1e-15 * *c.listed);
    }
  });
}

/// x, y, z become -y, z, -x: a mirror and a change of axes at once.
template <class S> Vec3<S> mirrored(const Vec3<S>& v) { return {S(-v[1]), v[2], S(-v[0])}; }
template <class S> Sphere<S> mirrored(const Sphere<S>& s) { return {mirrored(s.center), s.radius}; }
template <class S> Aabb<S> mirrored(const Aabb<S>& b) {
  return {mirrored(b.center), mirrored(b.half_extents).cwiseAbs()};
}
template <class S> Capsule<S> mirrored(const Capsule<S>& c) { return {mirrored(c.a), mirrored(c.b), c.radius}; }

template <class Shape> Moving<Shape> mirrored(const Moving<Shape>& m) {
  return {mirrored(m.shape), mirrored(m.displacement)};
}

/// As written, from the other side, with the other one moving, and in a mirror.
TYPED_TEST(ExactCases, as_written_and_as_seen_otherwise) {
  this->each([](const auto& c) {
    const auto toi = time_of_impact(c.a, c.b);
    if (c.as_written) {
      EXPECT_EQ(text(toi.status), text(c.status));
    }
    expect_exact(c.a, c.b);
    expect_exact(c.b, c.a);
    if constexpr (!std::is_same_v<decltype(c.a), decltype(c.b)>) {
      EXPECT_TRUE(same_answer(flipped(time_of_impact(c.b, c.a)), toi));
    }
    auto a = c.a;
    auto b = c.b;
    a.displacement = -c.b.displacement;
    b.displacement = -c.a.displacement;
    expect_exact(a, b);
    expect_exact(mirrored(c.a), mirrored(c.b));
  });
}

TYPED_TEST(ExactCases, translated_where_exact) {
  using S = TypeParam;
  int tested = 0;
  const Vec3<S> offsets[] = {{S(1), S(-2), S(0.5)}, {S(1024), S(-4096), S(512)}, {power<S>(40), S(0), power<S>(30)}};
  this->each([&](const auto& c) {
    for (const Vec3<S>& by : offsets) {
      const Moving a{moved(c.a.shape, by), c.a.displacement};
      const Moving b{moved(c.b.shape, by), c.b.displacement};
      const auto exact = [&](const auto& to, const auto& from) {
        return same_body(oracle::body(to), oracle::body(from), 0, oracle::lift_vector(by));
      };
      if (!exact(a, c.a) || !exact(b, c.b)) continue;
      ++tested;
      expect_exact(a, b);
    }
  });
  EXPECT_GT(tested, 40);
}

// ---- Where all that decides is rounding.

TEST(RoundingDecides, an_edge_is_met_at_every_size) {  // exact numbers of up to six lengths
  for (const int e : {0, 90, 150, 175, 190, 203, 216, 300, -90, -150, -175, -203, -300}) {
    SCOPED_TRACE(e);
    const auto at = [e](const Vec3<double>& x) { return times_power_of_two(x, e); };
    const Triangle<double> triangle{at({1, 2, 3}), at({11, 4, 5}), at({4, 13, 7})};
    const Vec3<double> middle = at({6, 3, 4}), way = at({3, 1, 17}), side = triangle.c - triangle.a;
    const auto hit = raycast(Ray<double>{middle - way, way, 2}, triangle);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->t, 1);
    const Moving<Sphere<double>> point{{middle - way, 0}, way * 2};
    EXPECT_EQ(time_of_impact(point, at_rest(triangle)).time, 0.5);
    const Moving<Capsule<double>> rod{{middle - way, middle - way + side, 0}, way * 2};
    EXPECT_EQ(time_of_impact(rod, at_rest(Capsule<double>{triangle.a, triangle.b, 0})).time, 0.5);
    EXPECT_TRUE(overlaps(Capsule<double>{middle - way, middle + way, 0}, triangle));
  }
}

/// [length, 1] Eighths and halves: no difference of any two, nor a product with a time, is rounded.
template <class S> struct Lattice {
  Shaker<S> draw;
  S eighth(int low, int high) { return S(draw.pick(low, high)) / S(8); }
  Vec3<S> place() { return {eighth(-32, 32), eighth(-32, 32), eighth(-32, 32)}; }
  /// A box, flat in one direction of three, and a place on it.
  std::pair<Aabb<S>, Vec3<S>> box() {
    Aabb<S> box{place(), place().cwiseAbs()};
    Vec3<S> on_it;
    for (int i = 0; i < 3; ++i) {
      if (draw.pick(0, 2) == 0) box.half_extents[i] = 0;
      on_it[i] = box.center[i] + box.half_extents[i] * S(draw.pick(-2, 2)) / S(2);
    }
    return {box, on_it};
  }
};

template <class S> void expect_touches_to_be_met(int runs) {
  Lattice<S> lattice{Shaker<S>(20261201)};
  const Mat3<S> turn = turn_in_plane<S>(0, 1, S(0), S(1)) * turn_in_plane<S>(2, 0, S(0), S(-1));
  for (int run = 0; run < runs; ++run) {
    const Vec3<S> path = 2 * lattice.place(), half_core = lattice.place();
    const S time = lattice.eighth(1, 8);
    const auto is_met = [&](const auto& a, const auto& b) {
      SCOPED_TRACE(describe(a) + describe(b));
      const Moving moving{a, path};
      const auto toi = time_of_impact(moving, at_rest(b));
      EXPECT_EQ(time_of_impact(at_rest(b), moving).status, toi.status);
      EXPECT_EQ(toi.status, overlaps(a, b) ? ToiStatus::overlapping : ToiStatus::hit);
      EXPECT_LE(toi.time, time);
      EXPECT_LE(separation(pose_at(moving, toi.time), b).distance, 64 * unit<S>() * (magnitude(moving) + magnitude(b)));
    };
    const Capsule<S> core{lattice.place(), lattice.place(), 0};
    is_met(Sphere<S>{(core.a + core.b) / S(2) - path * time, 0}, core);
    const auto [box, on_it] = lattice.box();
    const Vec3<S> start = on_it - path * time;
    const Obb<S> turned{box.center, turn.transpose().cwiseAbs() * box.half_extents, turn};
    const auto meets_both = [&](const auto& shape) {
      is_met(shape, box);
      is_met(shape, turned);
      const auto toi = time_of_impact(Moving{shape, path}, at_rest(turned));
      if (std::is_same_v<S, double> && toi.status == ToiStatus::overlapping) {  // in float a time is asked in double
        const Vec3<S> off = toi.normal - separation(shape, turned).normal;
        EXPECT_LE(largest(off), 4 * unit<S>()) << describe(shape) << describe(turned);
      }
    };
    meets_both(Sphere<S>{start, 0});
    meets_both(Capsule<S>{start, start, 0});
    meets_both(Capsule<S>{start - half_core, start + half_core, 0});
    meets_both(Aabb<S>{start, Vec3<S>::Zero()});
    meets_both(Obb<S>{start, Vec3<S>::Zero()});
  }
}

TEST(RoundingDecides, without_a_radius_what_touches_by_exact_numbers_is_met) {
  expect_touches_to_be_met<float>(5'000);
  expect_touches_to_be_met<double>(5'000);
}

TEST(RoundingDecides, what_slides_off_a_ball_is_not_met_later) {
  Shaker<double> draw(20261127);
  for (int i = 0; i < 200'000; ++i) {
    const Vec3<double> n = safe_unit(draw.plain_vector()), along = thinwall::cross(n, draw.plain_vector());
    const Sphere<double> ball{{0, 0, 0}, std::abs(draw.plain())}, other{n * (ball.radius + 0.25), 0.25};
    const auto toi = time_of_impact(Moving<Sphere<double>>{other, along}, at_rest(ball));
    if (toi.status != ToiStatus::hit) continue;
    EXPECT_LE(toi.time * along.norm(), 1e-12) << i;
  }
}

TEST(RoundingDecides, the_normal_of_a_graze_is_across_it) {
  const Moving<Triangle<double>> triangle{{{0x1.d7478c6071c54p-2, 0x1.3f2883e6f8058p-2, 0x1.ad6850489ab25p-3},
                                           {0x1.2162997bec8bdp-1, 0x1.eea888e4165efp-3, -0x1.6d45bb971b8fcp-5},
                                           {-0x1.06832fd612b74p+0, -0x1.1b3e642c819a8p-1, -0x1.5216e162d3ce5p-3}},
                                          {0x1.3a348db431d5cp-10, 0x1.855a74aa031ffp-10, 0x1.55a40f6ab0d29p-8}};
  const Moving<Sphere<double>> ball{
      {{-0x1.702990afdfc57p-3, 0x1.b8c669841c9cfp-3, 0x1.e198f480529aap-5}, 0x1.ea4ef1d4e971ap-3},
      {0x1.629cba233dcacp-10, 0x1.8bfddab8b4cb5p-10, 0x1.29c377a806fc8p-8}};
  const auto toi = time_of_impact(triangle, ball);
  ASSERT_EQ(toi.status, ToiStatus::hit);
  const auto there = separation(pose_at(triangle, toi.time), pose_at(ball, toi.time));
  EXPECT_GT(toi.normal.dot(there.normal), 0.999);
}

TEST(RoundingDecides, a_point_at_an_edge_meets_no_face_that_it_leaves_by) {
  Shaker<double> draw(20261127);
  const Obb<double> box{{0, 0, 0}, {0x1p-5, 2, 2}, Mat3<double>::Identity()};
  int hits = 0;
  for (int i = 0; i < 20'000; ++i) {  // to the edge at +y, where it comes in by -x or +x and leaves by +y
    const Vec3<double> way = draw.plain_vector().cwiseProduct(Vec3<double>(60, 20, 1)) + Vec3<double>(0, 40, 0);
    const Vec3<double> edge(way[0] > 0 ? -0x1p-5 : 0x1p-5, 2, 0);
    const auto toi = time_of_impact(Moving<Sphere<double>>{{edge - way, 0}, way}, at_rest(box));
    if (toi.status != ToiStatus::hit) continue;
    ++hits;
    EXPECT_EQ(toi.normal, (Vec3<double>(way[0] > 0 ? 1 : -1, 0, 0))) << i;
  }
  EXPECT_GT(hits, 1'000);
}

TEST(RoundingDecides, a_segment_at_a_rim_meets_a_face_that_it_comes_in_by) {
  Shaker<double> draw(20261128);
  int hits = 0;
  for (int i = 0; i < 20'000;
       ++i) {  // an end of the segment at an edge of the triangle: two faces of their prism are met at once
    const Triangle<double> triangle{draw.plain_vector(), draw.plain_vector(), draw.plain_vector()};
    const Vec3<double> at = triangle.a + (triangle.b - triangle.a) * (0.5 + 0.25 * draw.plain());
    const Vec3<double> way = draw.plain_vector(), shape = draw.plain_vector();
    const Vec3<double> core = shape * std::ldexp(1.0, -draw.pick(0, 12));
    const Moving<Capsule<double>> segment{{at - way / 2, at - way / 2 + core, 0}, way};
    const auto toi = time_of_impact(segment, at_rest(triangle));
    if (toi.status != ToiStatus::hit) continue;
    ++hits;
    const Capsule<double> there = pose_at(segment, toi.time);
    const auto along = [&](const Vec3<double>& x) { return toi.normal.dot(x); };
    EXPECT_LE(std::max(along(there.a), along(there.b)),
              std::min({along(triangle.a), along(triangle.b), along(triangle.c)}) + 0x1p-48)
        << i;
  }
  EXPECT_GT(hits, 5'000);
}

TEST(RoundingDecides, a_miss_by_the_least_number_is_one_beside_any_length) {
  const double least = std::numeric_limits<double>::denorm_min();
  for (const double size : {1.0, 4.0, 0x1p20, 0x1p200}) {  // products of four are in range
    const Triangle<double> triangle{{0, 0, 0}, {size, 0, 0}, {0, size, size}};
    const auto past = [&](double x) {
      return time_of_impact(at_rest(triangle), Moving<Sphere<double>>{{{x, size / 4, -size}, 0}, {0, 0, 4 * size}})
          .status;
    };
    EXPECT_EQ(past(-least), ToiStatus::apart) << size;
    EXPECT_EQ(past(0), ToiStatus::hit) << size;
    EXPECT_FALSE(overlaps(triangle, Sphere<double>{{0, 0, least}, 0})) << size;
  }
}

TEST(RoundingDecides, what_passes_at_the_ends_of_the_range_is_apart) {
  const double most = std::numeric_limits<double>::max();
  const Moving<Capsule<double>> segment{{{0, 0, 1e300}, {0, 1, 0}, 0}, {0, 1e300, 0}};
  const Triangle<double> line{
      {1e308, -2e-300, 0}, {0, 0, 0}, {0, 0, 0}};  // whose way back to the segment meets nothing
  EXPECT_EQ(time_of_impact(segment, at_rest(line)).status, ToiStatus::apart);
  const Moving<Aabb<double>> box{{{3, 1, -2}, {1.5, 1.5, 2}}, {0.9, 1.4, most}};
  const Moving<Sphere<double>> point{{{1.5, -1.5, 1}, 0},
                                     {1, 2, 1.3}};  // whose slab it enters and leaves at 0, rounded
  EXPECT_EQ(time_of_impact(box, point).status, ToiStatus::apart);
}

TEST(RoundingDecides, boxes_that_meet_as_the_step_ends_touch_between_them) {
  Shaker<double> draw(20261127);
  int hits = 0;
  for (int i = 0; i < 5'000; ++i) {
    const Obb<double> a{{0, 0, 0}, {1, 1, 1}, draw.axes()};
    const Vec3<double> way = a.axes.col(0) * (1.5 + draw.plain());
    const Obb<double> b{a.axes.col(0) * 2 + way, {1, 1, 1}, a.axes};
    const auto toi = time_of_impact(at_rest(a), Moving<Obb<double>>{b, -way});
    if (toi.status != ToiStatus::hit) continue;
    ++hits;
    EXPECT_NEAR(toi.point.dot(a.axes.col(0)), 1, 1e-14) << i;
  }
  EXPECT_GT(hits, 1'000);
}

}  // namespace
}  // namespace thinwall::testing
