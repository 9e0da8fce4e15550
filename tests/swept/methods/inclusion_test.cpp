// The inclusion method by cases: never late, early by at most the tolerance, bounded, and its options.

#include <gtest/gtest.h>
#include <thinwall/swept/methods/inclusion.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/judge.hpp"

namespace thinwall::testing {
namespace {

template <class S> class InclusionMethod : public ::testing::Test {
 protected:
  const Moving<Aabb<S>> wall = at_rest(Aabb<S>{{0, 0, 0}, {0.125, 8, 8}});
  const Moving<Sphere<S>> shot{{{-1, 0, 0}, 0.25}, {2, 0, 0}};  // in contact from 0.3125 on
  const Moving<Sphere<S>> post = at_rest(Sphere<S>{{0, 0, 0}, 1});
  const Moving<Sphere<S>> graze{{{-4, 1.9375, 0}, 1}, {8, 0, 0}};               // of that post
  const Moving<Sphere<S>> passing{{{-4, 2 + power<S>(-10), 0}, 1}, {8, 0, 0}};  // beside it
};
TYPED_TEST_SUITE(InclusionMethod, Scalars, ScalarNames);

TYPED_TEST(InclusionMethod, is_early_by_at_most_the_tolerance) {
  using S = TypeParam;
  const S exact = time_of_impact(this->graze, this->post).time;
  for (const S& tolerance : {S(0.125), power<S>(-8), half_digits<S>(), S(4 * std::numeric_limits<S>::epsilon())}) {
    const Inclusion<S> method{.tolerance = tolerance};
    const Toi<S> straight = time_of_impact(method, this->shot, this->wall);
    EXPECT_EQ(straight.status, ToiStatus::hit);
    EXPECT_TRUE(straight.time < S(0.3125));
    EXPECT_TRUE(straight.time >= S(0.3125) - tolerance - 512 * unit<S>());
    EXPECT_EQ(straight.normal, Vec3<S>(1, 0, 0));
    const Toi<S> slanted = time_of_impact(method, this->graze, this->post);
    EXPECT_EQ(slanted.status, ToiStatus::hit);
    EXPECT_TRUE(slanted.time < exact);
    EXPECT_TRUE(slanted.time >= exact - tolerance - 512 * unit<S>());
  }
}

TYPED_TEST(InclusionMethod, a_miss_is_proven_in_a_few_looks_each_time_the_interval_halves) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(Inclusion<S>{}, this->passing, this->post);
  EXPECT_EQ(toi.status, ToiStatus::apart);
  EXPECT_LE(toi.evaluations, 64);
}

TYPED_TEST(InclusionMethod, a_miss_nearer_than_the_tolerance_may_be_a_hit) {
  using S = TypeParam;
  auto later = this->passing;  // nearest at no middle of an interval
  later.shape.center[0] -= S(1) / S(3);
  EXPECT_EQ(time_of_impact(Inclusion<S>{}, later, this->post).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(Inclusion<S>{.tolerance = power<S>(-4)}, later, this->post).status, ToiStatus::hit);
}

TYPED_TEST(InclusionMethod, out_of_evaluations_gives_up_with_what_is_proven) {
  using S = TypeParam;
  const S exact = time_of_impact(this->graze, this->post).time;
  const Toi<S> enough = time_of_impact(Inclusion<S>{}, this->graze, this->post);
  ASSERT_EQ(enough.status, ToiStatus::hit);
  S before = 0;
  for (int n = 1; n < enough.evaluations - 1; ++n) {
    const Toi<S> toi = time_of_impact(Inclusion<S>{.max_evaluations = n}, this->graze, this->post);
    EXPECT_EQ(text(toi.status), text(ToiStatus::gave_up));
    EXPECT_EQ(toi.evaluations, n + 1);
    EXPECT_TRUE(toi.time >= before && toi.time < exact) << n;
    before = toi.time;
  }
  EXPECT_TRUE(before > exact / 2);
}

TYPED_TEST(InclusionMethod, options_out_of_range_are_invalid) {
  using S = TypeParam;
  const S finest = std::numeric_limits<S>::epsilon();
  for (const S& bad : {S(0), S(-1), S(finest / 2), S(1.5), nan<S>(), infinity<S>()}) {
    const Toi<S> toi = time_of_impact(Inclusion<S>{.tolerance = bad}, this->shot, this->wall);
    EXPECT_EQ(text(toi.status), text(ToiStatus::invalid));
    EXPECT_NE(toi.time, toi.time);
  }
  for (const int bad : {0, -1}) {
    EXPECT_EQ(time_of_impact(Inclusion<S>{.max_evaluations = bad}, this->shot, this->wall).status, ToiStatus::invalid);
  }
  for (const S& good : {finest, S(1)}) {
    EXPECT_EQ(time_of_impact(Inclusion<S>{.tolerance = good}, this->shot, this->wall).status, ToiStatus::hit);
  }
}

TYPED_TEST(InclusionMethod, keeps_the_minimal_separation) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(Inclusion<S>{.min_separation = 0.125}, this->shot, this->wall);
  EXPECT_TRUE(toi.time < S(0.25) && toi.time >= S(0.25) - half_digits<S>() - 512 * unit<S>());
}

}  // namespace
}  // namespace thinwall::testing
