// Speculative contacts by cases: what a margin sees, its false hits, and its options.

#include <gtest/gtest.h>
#include <thinwall/swept/methods/speculative.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/judge.hpp"

namespace thinwall::testing {
namespace {

template <class S> class SpeculativeMethod : public ::testing::Test {
 protected:
  const Moving<Aabb<S>> wall = at_rest(Aabb<S>{{0, 0, 0}, {0.125, 8, 8}});
  const Moving<Sphere<S>> shot{{{-1, 0, 0}, 0.25}, {2, 0, 0}};  // in contact from 0.3125 on
};
TYPED_TEST_SUITE(SpeculativeMethod, Scalars, ScalarNames);

TYPED_TEST(SpeculativeMethod, is_right_before_a_wall) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(Speculative<S>{}, this->shot, this->wall);
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_TRUE(toi.time < S(0.3125) && toi.time > S(0.3125) * (1 - 1024 * unit<S>()));
  EXPECT_EQ(toi.evaluations, 2);
  EXPECT_EQ(toi.normal, Vec3<S>(1, 0, 0));
}

TYPED_TEST(SpeculativeMethod, takes_the_other_for_the_plane_before_it) {  // and hits what would pass beside
  using S = TypeParam;
  const Moving<Sphere<S>> past_the_rim{{{-2, 8.25, 0}, 0.25}, {8, 2, 0}};
  EXPECT_EQ(time_of_impact(past_the_rim, this->wall).status, ToiStatus::apart);
  const Toi<S> toi = time_of_impact(Speculative<S>{}, past_the_rim, this->wall);
  EXPECT_EQ(toi.status, ToiStatus::hit);
  const Moving<Sphere<S>> stopping{{{-2, 8.25, 0}, 0.25}, {1, 0.25, 0}}, leaving{{{-2, 0, 0}, 0.25}, {-8, 1, 0}};
  EXPECT_EQ(time_of_impact(Speculative<S>{}, stopping, this->wall).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(Speculative<S>{}, leaving, this->wall).status, ToiStatus::apart);
}

TYPED_TEST(SpeculativeMethod, a_smaller_margin_misses_what_is_farther_off) {
  using S = TypeParam;  // a gap of 0.625, a path of 2
  for (const S& margin : {S(0.3125), S(0.5), S(1), S(64)})
    EXPECT_EQ(time_of_impact(Speculative<S>{.margin = margin}, this->shot, this->wall).status, ToiStatus::hit);
  for (const S& margin : {S(0.25), S(0)})
    EXPECT_EQ(time_of_impact(Speculative<S>{.margin = margin}, this->shot, this->wall).status, ToiStatus::apart);
  const auto touching = at_rest(Sphere<S>{{-0.375, 0, 0}, 0.25});
  EXPECT_EQ(time_of_impact(Speculative<S>{.margin = 0}, touching, this->wall).status, ToiStatus::overlapping);
}

TYPED_TEST(SpeculativeMethod, options_out_of_range_are_invalid) {
  using S = TypeParam;
  for (const S& bad : {S(-1), nan<S>(), infinity<S>()}) {
    const Toi<S> toi = time_of_impact(Speculative<S>{.margin = bad}, this->shot, this->wall);
    EXPECT_EQ(text(toi.status), text(ToiStatus::invalid));
    EXPECT_NE(toi.time, toi.time);
  }
  const S largest = std::numeric_limits<S>::max();
  EXPECT_EQ(time_of_impact(Speculative<S>{.margin = largest}, this->shot, this->wall).status, ToiStatus::hit);
}

TYPED_TEST(SpeculativeMethod, keeps_the_minimal_separation) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(Speculative<S>{.min_separation = 0.125}, this->shot, this->wall);
  EXPECT_TRUE(toi.time < S(0.25) && toi.time > S(0.25) * (1 - 1024 * unit<S>()));
}

TYPED_TEST(SpeculativeMethod,
           the_margin_counts_from_the_minimal_separation) {  // which is all that keeps it from a miss
  using S = TypeParam;
  const Moving<Sphere<S>> short_step{{{-1, 0, 0}, 0.25}, {0.5, 0, 0}};  // a gap of 0.625
  EXPECT_EQ(time_of_impact(Speculative<S>{}, short_step, this->wall).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(Speculative<S>{.min_separation = 0.25}, short_step, this->wall).status, ToiStatus::hit);
}

}  // namespace
}  // namespace thinwall::testing
