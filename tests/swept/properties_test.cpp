// The closed form against the oracle on random and adversarial motions.

#include <gtest/gtest.h>

#include "support/swept_properties.hpp"

namespace thinwall::testing {
namespace {

constexpr int runs = 2000;

template <class P> class SweptPair : public ::testing::Test {
 protected:
  /// The oracle takes milliseconds where a core lies oblique.
  static constexpr int runs = std::is_same_v<typename P::A, Capsule<typename P::S>> ? 80 : 2000;
};
using Pairs = ::testing::Types<PairOf<Sphere<float>, Sphere<float>>, PairOf<Sphere<double>, Sphere<double>>,
                               PairOf<Sphere<long double>, Sphere<long double>>, PairOf<Sphere<Wide>, Sphere<Wide>>,
                               PairOf<Aabb<float>, Sphere<float>>, PairOf<Aabb<double>, Sphere<double>>,
                               PairOf<Aabb<long double>, Sphere<long double>>, PairOf<Aabb<Wide>, Sphere<Wide>>,
                               PairOf<Aabb<float>, Aabb<float>>, PairOf<Aabb<double>, Aabb<double>>,
                               PairOf<Capsule<float>, Sphere<float>>, PairOf<Capsule<double>, Sphere<double>>,
                               PairOf<Capsule<float>, Aabb<float>>, PairOf<Capsule<double>, Aabb<double>>,
                               PairOf<Capsule<float>, Capsule<float>>, PairOf<Capsule<double>, Capsule<double>>>;
TYPED_TEST_SUITE(SweptPair, Pairs);

TYPED_TEST(SweptPair, time_of_impact_meets_the_contract) {
  check_property(this->runs, time_of_impact_meets_the_contract<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptPair, kernel_meets_the_contract) {
  check_property(this->runs, kernel_meets_the_contract<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptPair, min_separation_meets_the_contract) {
  check_property(this->runs / 2, min_separation_meets_the_contract<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptPair, shapes_touch_at_the_hit) {
  check_property(this->runs, shapes_touch_at_the_hit<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptPair, other_way_round_flips_the_normal) {
  check_property(this->runs, other_way_round_flips_the_normal<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptPair, powers_of_two_change_no_bits) {
  check_property(this->runs, powers_of_two_change_no_bits<typename TypeParam::A, typename TypeParam::B>);
}

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
