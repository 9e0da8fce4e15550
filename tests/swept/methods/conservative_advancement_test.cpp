// Conservative advancement by cases: never late, bounded, and its options.

#include <gtest/gtest.h>
#include <thinwall/swept/methods/conservative_advancement.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/judge.hpp"

namespace thinwall::testing {
namespace {

template <class S> class Advancement : public ::testing::Test {
 protected:
  const Moving<Aabb<S>> wall = at_rest(Aabb<S>{{0, 0, 0}, {0.125, 8, 8}});
  const Moving<Sphere<S>> shot{{{-1, 0, 0}, 0.25}, {2, 0, 0}};  // in contact from 0.3125 on
  const Moving<Sphere<S>> post = at_rest(Sphere<S>{{0, 0, 0}, 1});
  const Moving<Sphere<S>> graze{{{-4, 1.9375, 0}, 1}, {8, 0, 0}};    // of that post
  const Moving<Sphere<S>> passing{{{-4, 2.0625, 0}, 1}, {8, 0, 0}};  // beside it, by 1/16
};
TYPED_TEST_SUITE(Advancement, Scalars, ScalarNames);

TYPED_TEST(Advancement, one_step_takes_it_before_a_face) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(ConservativeAdvancement<S>{}, this->shot, this->wall);
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_TRUE(toi.time < S(0.3125));
  EXPECT_TRUE(toi.time >= S(0.3125) * (1 - 1024 * unit<S>()));  // sizes of 18 over a closing speed of 2, times 16 u
  EXPECT_EQ(toi.evaluations, 3);                                // the overlap at the start, there, and the proof
  EXPECT_EQ(toi.normal, Vec3<S>(1, 0, 0));
  EXPECT_TRUE(toi.point.isApprox(Vec3<S>(-0.125, 0, 0), 4096 * unit<S>()));
}

TYPED_TEST(Advancement, a_graze_takes_more_and_is_early_by_the_tolerance_over_the_cosine) {
  using S = TypeParam;
  const S exact = time_of_impact(this->graze, this->post).time;
  const S cosine = S(31) / S(125);  // sqrt(4 - 1.9375^2) / 2 = 0.248...
  for (const S& tolerance : {S(0.125), S(0.0625), power<S>(-8), half_digits<S>()}) {
    const Toi<S> toi = time_of_impact(ConservativeAdvancement<S>{.tolerance = tolerance}, this->graze, this->post);
    EXPECT_EQ(toi.status, ToiStatus::hit);
    EXPECT_TRUE(toi.time < exact);
    EXPECT_TRUE(toi.time > exact - tolerance / cosine - 64 * unit<S>());
  }
}

TYPED_TEST(Advancement, a_miss_is_proven_in_a_few_steps) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(ConservativeAdvancement<S>{}, this->passing, this->post);
  EXPECT_EQ(toi.status, ToiStatus::apart);
  EXPECT_LE(toi.evaluations, 8);
}

TYPED_TEST(Advancement, a_miss_nearer_than_the_tolerance_may_be_a_hit) {
  using S = TypeParam;
  const ConservativeAdvancement<S> coarse{.tolerance = power<S>(-6)};  // 1/8 of a length over this path
  EXPECT_EQ(time_of_impact(coarse, this->passing, this->post).status, ToiStatus::hit);
}

TYPED_TEST(Advancement, out_of_evaluations_gives_up_with_what_is_proven) {
  using S = TypeParam;
  const S exact = time_of_impact(this->graze, this->post).time;
  const Toi<S> enough = time_of_impact(ConservativeAdvancement<S>{}, this->graze, this->post);
  ASSERT_EQ(enough.status, ToiStatus::hit);
  S before = 0;
  for (int n = 1; n < enough.evaluations - 1; ++n) {
    const Toi<S> toi = time_of_impact(ConservativeAdvancement<S>{.max_evaluations = n}, this->graze, this->post);
    EXPECT_EQ(text(toi.status), text(ToiStatus::gave_up));
    EXPECT_EQ(toi.evaluations, n + 1);
    EXPECT_TRUE(toi.time > before && toi.time < exact) << n;
    EXPECT_EQ(toi.normal, Vec3<S>(0, 0, 0));
    before = toi.time;
  }
  EXPECT_TRUE(before > exact / 2);
}

TYPED_TEST(Advancement, options_out_of_range_are_invalid) {
  using S = TypeParam;
  using Method = ConservativeAdvancement<S>;
  const S finest = std::numeric_limits<S>::epsilon();
  for (const S& bad : {S(0), S(-1), S(finest / 2), S(1.5), nan<S>(), infinity<S>()}) {
    const Toi<S> toi = time_of_impact(Method{.tolerance = bad}, this->shot, this->wall);
    EXPECT_EQ(text(toi.status), text(ToiStatus::invalid));
    EXPECT_NE(toi.time, toi.time);
  }
  for (const int bad : {0, -1}) {
    EXPECT_EQ(time_of_impact(Method{.max_evaluations = bad}, this->shot, this->wall).status, ToiStatus::invalid);
  }
  for (const S& good : {finest, S(1)}) {
    EXPECT_EQ(time_of_impact(Method{.tolerance = good}, this->shot, this->wall).status, ToiStatus::hit);
  }
}

TYPED_TEST(Advancement, keeps_the_minimal_separation) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(ConservativeAdvancement<S>{.min_separation = 0.125}, this->shot, this->wall);
  EXPECT_TRUE(toi.time < S(0.25) && toi.time >= S(0.25) * (1 - 1024 * unit<S>()));
}

TYPED_TEST(Advancement, leaving_is_apart_however_near) {
  using S = TypeParam;
  const Moving<Sphere<S>> leaving{Sphere<S>{{-next_up(S(0.375)), 0, 0}, 0.25}, {-1, 0, 0}};
  const Toi<S> toi = time_of_impact(ConservativeAdvancement<S>{}, leaving, this->wall);
  EXPECT_TRUE(toi.status == ToiStatus::apart || (toi.status == ToiStatus::hit && toi.time == S(0)));
  const Moving<Sphere<S>> clear{Sphere<S>{{-S(0.375) * (1 + 1024 * unit<S>()), 0, 0}, 0.25}, {-1, 0, 0}};
  EXPECT_EQ(time_of_impact(ConservativeAdvancement<S>{}, clear, this->wall).status, ToiStatus::apart);
}

TEST(AdvancementInFloat,
     rounds_its_time_down) {  // computed in double; to the nearest float would be late half the time
  int below = 0;
  for (int i = 0; i < 200; ++i) {
    const float x = -1 - static_cast<float>(i) / 256;
    const Moving<Sphere<float>> shot{{{x, 0, 0}, 0.25F}, {3, 0, 0}};
    const auto wall = at_rest(Aabb<float>{{0, 0, 0}, {0.125F, 8, 8}});
    const Toi<float> toi = time_of_impact(ConservativeAdvancement<float>{}, shot, wall);
    EXPECT_LE(3 * static_cast<double>(toi.time), -0.375 - static_cast<double>(x));
    below += static_cast<double>(toi.time) * 3 > (-0.375 - static_cast<double>(x)) * (1 - 2e-7) ? 1 : 0;
  }
  EXPECT_EQ(below, 200);
}

}  // namespace
}  // namespace thinwall::testing
