// Every exact case at every scalar, and the same cases passed the other way round, moved, mirrored and resized.

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "support/bodies.hpp"
#include "support/exact_cases.hpp"
#include "support/judge.hpp"
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

template <class S> void expect_equal(const Toi<S>& a, const Toi<S>& b) {
  EXPECT_EQ(text(a.status), text(b.status));
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.point, b.point);
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

TYPED_TEST(ExactCases, as_written) {
  this->each([](const auto& c) {
    if (c.as_written) {
      EXPECT_EQ(text(time_of_impact(c.a, c.b).status), text(c.status));
    }
    expect_exact(c.a, c.b);
  });
}

TYPED_TEST(ExactCases, other_way_round) {
  this->each([](const auto& c) {
    expect_exact(c.b, c.a);
    if constexpr (!std::is_same_v<decltype(c.a), decltype(c.b)>) {
      auto flipped = time_of_impact(c.b, c.a);
      flipped.normal = -flipped.normal;
      expect_equal(time_of_impact(c.a, c.b), flipped);
    }
  });
}

TYPED_TEST(ExactCases, the_other_one_moves) {
  this->each([](const auto& c) {
    auto a = c.a;
    auto b = c.b;
    std::swap(a.displacement, b.displacement);
    a.displacement = -a.displacement;
    b.displacement = -b.displacement;
    expect_exact(a, b);
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

TYPED_TEST(ExactCases, mirrored) {
  this->each([](const auto& c) { expect_exact(mirrored(c.a), mirrored(c.b)); });
}

TYPED_TEST(ExactCases, translated_where_exact) {
  using S = TypeParam;
  int tested = 0;
  const Vec3<S> offsets[] = {{S(1), S(-2), S(0.5)}, {S(1024), S(-4096), S(512)}, {power<S>(40), S(0), power<S>(30)}};
  this->each([&](const auto& c) {
    for (const Vec3<S>& by : offsets) {
      const auto a = translated(c.a, by);
      const auto b = translated(c.b, by);
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

TYPED_TEST(ExactCases, same_bits_at_every_size) {  // lengths times 2^k: nothing but the point may change
  int tested = 0;
  this->each([&](const auto& c) {
    const auto toi = time_of_impact(c.a, c.b);
    for (const int k : {-900, -400, -130, -70, -20, -1, 1, 20, 60, 100, 400, 900}) {
      const auto a = scaled(c.a, k);
      const auto b = scaled(c.b, k);
      const auto exact = [&](const auto& to, const auto& from) {
        return same_body(oracle::body(to), oracle::body(from), k);
      };
      if (!exact(a, c.a) || !exact(b, c.b)) continue;
      ++tested;
      SCOPED_TRACE(k);
      auto expected = toi;
      expected.point = times_power(toi.point, k);
      expect_equal(time_of_impact(a, b), expected);
    }
  });
  EXPECT_GT(tested, 200);
}

TYPED_TEST(ExactCases, same_bits_at_every_speed) {  // a displacement times 2^k is reached in 2^-k of the time
  this->each([&](const auto& c) {
    const auto toi = time_of_impact(c.a, c.b);
    if (toi.status != ToiStatus::hit) return;
    for (const int k : {1, 7, 40, 90}) {
      auto a = c.a;
      auto b = c.b;
      a.displacement = times_power(a.displacement, k);
      b.displacement = times_power(b.displacement, k);
      if (!is_finite(a.displacement) || !is_finite(b.displacement)) continue;
      const auto faster = time_of_impact(a, b);
      EXPECT_EQ(text(faster.status), text(toi.status)) << k;
      EXPECT_EQ(faster.time, times_power(toi.time, -k)) << k;
      EXPECT_EQ(faster.normal, toi.normal) << k;
    }
  });
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

TEST(RoundingDecides, what_slides_off_a_ball_is_not_met_later) {
  std::mt19937_64 engine(20261127);
  std::uniform_real_distribution<double> draw(-1, 1);
  const auto vector = [&] { return Vec3<double>(draw(engine), draw(engine), draw(engine)); };
  for (int i = 0; i < 200'000; ++i) {
    const Vec3<double> n = safe_unit(vector()), along = thinwall::cross(n, vector());
    const Sphere<double> ball{{0, 0, 0}, std::abs(draw(engine))}, other{n * (ball.radius + 0.25), 0.25};
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

TEST(RoundingDecides, a_segment_whose_way_back_meets_nothing_is_apart) {
  const Moving<Capsule<double>> segment{{{0, 0, 1e300}, {0, 1, 0}, 0}, {0, 1e300, 0}};
  const Triangle<double> line{{1e308, -2e-300, 0}, {0, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(time_of_impact(segment, at_rest(line)).status, ToiStatus::apart);
}

TEST(RoundingDecides, a_capsule_that_slides_along_a_face_is_met_by_its_nearer_end) {
  // the plane leans by 1e-10: by their normal the two ends are 2e-14 apart, which takes 1e-9 of the step
  const Moving<Capsule<double>> capsule{
      {{-0x1.a8cb0441d7562p-13, 0, 0}, {0x1.a8cb0441d7562p-13, 0, 0}, 0x1.559473bc96f62p-14},
      {0x1.49492650d771fp-7, 0x1.a9f6cf8eb7441p-5, -0x1.a2967bb812648p-6}};
  const Moving<Triangle<double>> triangle{{{-0x1.02159c07e9d83p-3, 0x1.56de7c315fa99p-14, -0x1.4abf2c273431cp-1},
                                           {0x1.67d2eb8c05e1dp-6, 0x1.56de65350219p-14, 0x1.3ef0fe386281ap-2},
                                           {-0x1.02159c06ce38bp-3, 0x1.56de90e2bd87p-14, -0x1.9a7b6bb547576p+0}},
                                          {0x1.51ef179b14b1p-2, 0x1.a9bc3cf4a9adcp-5, -0x1.6926c68314174p-2}};
  EXPECT_NEAR(time_of_impact(capsule, triangle).time, 0.011002985272795947, 1e-15);  // at 113 digits
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

TEST(RoundingDecides, the_end_of_a_step_is_the_same_at_any_scale) {
  const Triangle<double> triangle{{-0x1.a1a87813ab6a8p+13, -0x1.30e7c9bb1c733p+19, -0x1.d042c64b874ebp+18},
                                  {0x1.2fa7228a94bf2p+13, 0x1.2a52db4f325e6p+18, -0x1.d8a59d9677f68p+18},
                                  {0x1.c80556245aaep+11, 0x1.377cb8270688p+18, 0x1.d47431f0ffa28p+19}};
  const Moving<Sphere<double>> point{{{-0x1.49b1c31d67e17p+12, -0x1.5a25c6008d314p+19, -0x1.5240e276ebddfp+21}, 0},
                                     {0x1.48ce021e6d4edp+13, 0x1.d95ef23762fcep+19, 0x1.738c85026c317p+21}};
  for (int e = -600; e <= 900; e += 50) {  // it is met a billionth of a rounding after the end
    EXPECT_EQ(time_of_impact(scaled(at_rest(triangle), e), scaled(point, e)).status, ToiStatus::apart) << e;
  }
}

TEST(RoundingDecides, a_box_that_passes_a_point_in_no_time_is_apart) {  // enters and leaves its slab at 0, rounded
  const double most = std::numeric_limits<double>::max();
  const Moving<Aabb<double>> box{{{3, 1, -2}, {1.5, 1.5, 2}}, {0.9, 1.4, most}};
  const Moving<Sphere<double>> point{{{1.5, -1.5, 1}, 0}, {1, 2, 1.3}};
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
