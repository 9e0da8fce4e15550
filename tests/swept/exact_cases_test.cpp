// Every exact case at every scalar, and the same cases passed the other way round, moved, mirrored and resized.

#include <gtest/gtest.h>

#include "support/bodies.hpp"
#include "support/exact_cases.hpp"
#include "support/judge.hpp"

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

}  // namespace
}  // namespace thinwall::testing
