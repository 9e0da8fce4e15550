// The closed form against the oracle: boxes and capsules.

#include <gtest/gtest.h>

#include "support/swept_properties.hpp"

namespace thinwall::testing {
namespace {

template <class P> class SweptCores : public ::testing::Test {
 protected:
  /// The oracle takes milliseconds where a core lies oblique.
  static constexpr int runs = std::is_same_v<typename P::A, Aabb<typename P::S>> ? 1000 : 80;
};
using Pairs = ::testing::Types<PairOf<Aabb<float>, Aabb<float>>, PairOf<Aabb<double>, Aabb<double>>,
                               PairOf<Capsule<float>, Sphere<float>>, PairOf<Capsule<double>, Sphere<double>>,
                               PairOf<Capsule<float>, Aabb<float>>, PairOf<Capsule<double>, Aabb<double>>,
                               PairOf<Capsule<float>, Capsule<float>>, PairOf<Capsule<double>, Capsule<double>>>;
TYPED_TEST_SUITE(SweptCores, Pairs);

TYPED_TEST(SweptCores, time_of_impact_meets_the_contract) {
  check_property(this->runs, time_of_impact_meets_the_contract<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptCores, shapes_touch_at_the_hit) {
  check_property(this->runs, shapes_touch_at_the_hit<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptCores, other_way_round_flips_the_normal) {
  check_property(this->runs / 2, other_way_round_flips_the_normal<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(SweptCores, powers_of_two_change_no_bits) {
  check_property(this->runs, powers_of_two_change_no_bits<typename TypeParam::A, typename TypeParam::B>);
}

}  // namespace
}  // namespace thinwall::testing
