// The closed form against the oracle on random and adversarial motions.

#include <gtest/gtest.h>

#include "support/swept_properties.hpp"

namespace thinwall::testing {
namespace {

constexpr int runs = 2000;

template <class P> class SweptPair : public ::testing::Test {};
using Pairs = ::testing::Types<PairOf<Sphere<float>, Sphere<float>>, PairOf<Sphere<double>, Sphere<double>>,
                               PairOf<Sphere<long double>, Sphere<long double>>, PairOf<Sphere<Wide>, Sphere<Wide>>,
                               PairOf<Aabb<float>, Sphere<float>>, PairOf<Aabb<double>, Sphere<double>>,
                               PairOf<Aabb<long double>, Sphere<long double>>, PairOf<Aabb<Wide>, Sphere<Wide>>>;
TYPED_TEST_SUITE(SweptPair, Pairs);

TYPED_TEST(SweptPair, time_of_impact_meets_the_contract) {
  check_property(runs, time_of_impact_meets_the_contract<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptPair, kernel_meets_the_contract) {
  check_property(runs, kernel_meets_the_contract<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptPair, min_separation_meets_the_contract) {
  check_property(runs / 2, min_separation_meets_the_contract<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptPair, shapes_touch_at_the_hit) {
  check_property(runs, shapes_touch_at_the_hit<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptPair, other_way_round_flips_the_normal) {
  check_property(runs, other_way_round_flips_the_normal<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptPair, powers_of_two_change_no_bits) {
  check_property(runs, powers_of_two_change_no_bits<typename TypeParam::A, typename TypeParam::B>);
}

template <class Shape> class SweptBounds : public ::testing::Test {};
using Shapes = ::testing::Types<Sphere<float>, Sphere<double>, Sphere<Wide>, Aabb<float>, Aabb<double>, Capsule<float>,
                                Capsule<double>>;
TYPED_TEST_SUITE(SweptBounds, Shapes);

TYPED_TEST(SweptBounds, contain_the_shape) { check_property(runs, bounds_contain_the_shape<TypeParam>); }

/// A swept ball is a capsule: its core holds the center at every time, to rounding.
template <class S> void capsule_holds_the_ball() {
  const Style style = draw_style();
  const Moving<Sphere<S>> moving{Draw<Sphere<S>>::shape(style), draw_vector<S>(style)};
  const Capsule<S> swept = swept_volume(moving);
  RC_ASSERT(swept.radius == moving.shape.radius);
  oracle::Body core = oracle::body(swept), ball = oracle::body(moving);
  core.radius = ball.radius = 0;
  for (int step = 0; step <= 8; ++step) {
    const oracle::Real time = oracle::Real(step) / 8;
    const oracle::Pair pair{core, at_time(ball, time), 0};
    RC_ASSERT(oracle::gap(pair, 0).separation <= oracle::unit_roundoff<S>() * size_at(pair, 0));
  }
}
TEST(SweptVolume, capsule_holds_the_ball) {
  check_property(runs, capsule_holds_the_ball<float>);
  check_property(runs, capsule_holds_the_ball<double>);
}

}  // namespace
}  // namespace thinwall::testing
