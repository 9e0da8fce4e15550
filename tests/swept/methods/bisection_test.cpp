// Bisection by cases: late by at most the tolerance, bounded, what it may miss, and its options.

#include <gtest/gtest.h>
#include <thinwall/swept/methods/bisection.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/judge.hpp"

namespace thinwall::testing {
namespace {

template <class S> class BisectionMethod : public ::testing::Test {
 protected:
  static constexpr int digits = std::numeric_limits<S>::digits;
  const Moving<Aabb<S>> wall = at_rest(Aabb<S>{{0, 0, 0}, {0.125, 8, 8}});
  const Moving<Sphere<S>> shot{{{-1, 0, 0}, 0.25}, {2, 0, 0}};  // in contact from 0.3125 on
  const Moving<Sphere<S>> post = at_rest(Sphere<S>{{0, 0, 0}, 1});
  const Moving<Sphere<S>> graze{{{-4, 1.9375, 0}, 1}, {8, 0, 0}};  // of that post
};
TYPED_TEST_SUITE(BisectionMethod, Scalars, ScalarNames);

TYPED_TEST(BisectionMethod, is_late_by_at_most_the_tolerance) {
  using S = TypeParam;
  const S exact = time_of_impact(this->graze, this->post).time;
  for (const S& tolerance : {S(0.125), power<S>(-8), half_digits<S>(), S(4 * std::numeric_limits<S>::epsilon())}) {
    const Bisection<S> method{.tolerance = tolerance};
    const Toi<S> straight = time_of_impact(method, this->shot, this->wall);
    EXPECT_EQ(straight.status, ToiStatus::hit);
    EXPECT_TRUE(straight.time >= S(0.3125) && straight.time <= S(0.3125) + tolerance);
    EXPECT_EQ(straight.normal, Vec3<S>(1, 0, 0));
    const Toi<S> slanted = time_of_impact(method, this->graze, this->post);
    EXPECT_EQ(slanted.status, ToiStatus::hit);
    EXPECT_TRUE(slanted.time >= exact * (1 - 16 * unit<S>()) && slanted.time <= exact + tolerance + 16 * unit<S>());
  }
}

TYPED_TEST(BisectionMethod, finds_a_contact_however_short) {  // no pose of a search by halves falls into this wall
  using S = TypeParam;
  const S third = S(1) / S(3);
  const Moving<Sphere<S>> fast{{{-1, 0, 0}, 0}, {3, 0, 0}};
  const S thin = power<S>(3 - this->digits);
  const auto plate = at_rest(Aabb<S>{{0, 0, 0}, {thin, 8, 8}});
  const Toi<S> toi = time_of_impact(Bisection<S>{}, fast, plate);
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_TRUE(toi.time > third - thin && toi.time < third + thin);
}

TYPED_TEST(BisectionMethod, a_miss_is_proven_by_two_tangents) {
  using S = TypeParam;
  const Moving<Sphere<S>> passing{{{-4, 2.0625, 0}, 1}, {8, 0, 0}};
  const Toi<S> toi = time_of_impact(Bisection<S>{}, passing, this->post);
  EXPECT_EQ(toi.status, ToiStatus::apart);
  EXPECT_LE(toi.evaluations, 12);
  const Moving<Sphere<S>> leaving{{{-4, 0, 0}, 1}, {-8, 0, 0}}, stopping{{{-4, 0, 0}, 1}, {1, 0, 0}};
  EXPECT_EQ(time_of_impact(Bisection<S>{}, leaving, this->post).evaluations, 2);
  EXPECT_EQ(time_of_impact(Bisection<S>{}, stopping, this->post).evaluations, 3);
}

TYPED_TEST(BisectionMethod, both_searches_are_bounded) {  // a touch that no pose shows and no tangent excludes
  using S = TypeParam;
  const int most = 3 + 2 * this->digits + this->digits;
  int longest = 0;
  for (int i = 0; i < 64; ++i) {
    const S height = S(2) * (1 + S(i - 32) * 4 * unit<S>());
    const Moving<Sphere<S>> touching{{{-4, height, 0}, 1}, {S(8) + S(i) / S(64), 0, 0}};
    const Bisection<S> finest{.tolerance = std::numeric_limits<S>::epsilon()};
    longest = std::max(longest, time_of_impact(finest, touching, this->post).evaluations);
  }
  EXPECT_LE(longest, most);
  EXPECT_GE(longest, this->digits / 3);
}

TYPED_TEST(BisectionMethod, options_out_of_range_are_invalid) {
  using S = TypeParam;
  const S finest = std::numeric_limits<S>::epsilon();
  for (const S& bad : {S(0), S(-1), S(finest / 2), S(1.5), nan<S>(), infinity<S>()}) {
    const Toi<S> toi = time_of_impact(Bisection<S>{.tolerance = bad}, this->shot, this->wall);
    EXPECT_EQ(text(toi.status), text(ToiStatus::invalid));
    EXPECT_NE(toi.time, toi.time);
  }
  for (const S& good : {finest, S(1)}) {
    EXPECT_EQ(time_of_impact(Bisection<S>{.tolerance = good}, this->shot, this->wall).status, ToiStatus::hit);
  }
}

TYPED_TEST(BisectionMethod, keeps_the_minimal_separation) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(Bisection<S>{.min_separation = 0.125}, this->shot, this->wall);
  EXPECT_TRUE(toi.time >= S(0.25) && toi.time <= S(0.25) + half_digits<S>());
}

}  // namespace
}  // namespace thinwall::testing
