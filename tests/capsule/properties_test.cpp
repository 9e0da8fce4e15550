// The queries at one instant against the oracle: capsules with balls, boxes and capsules.

#include <gtest/gtest.h>

#include "support/discrete_properties.hpp"

namespace thinwall::testing {
namespace {

template <class P> class CapsulePair : public ::testing::Test {
 protected:
  /// The oracle tries every face of the Minkowski sum: 81 for a capsule and a box.
  static constexpr int runs = std::is_same_v<typename P::B, Aabb<typename P::S>> ? 600 : 3000;
};
using Pairs = ::testing::Types<PairOf<Capsule<float>, Sphere<float>>, PairOf<Capsule<double>, Sphere<double>>,
                               PairOf<Capsule<float>, Aabb<float>>, PairOf<Capsule<double>, Aabb<double>>,
                               PairOf<Capsule<long double>, Aabb<long double>>, PairOf<Capsule<float>, Capsule<float>>,
                               PairOf<Capsule<double>, Capsule<double>>, PairOf<Capsule<Wide>, Capsule<Wide>>>;
TYPED_TEST_SUITE(CapsulePair, Pairs);

TYPED_TEST(CapsulePair, overlaps_has_the_sign_of_the_separation) {
  check_property(this->runs, overlaps_has_the_sign_of_the_separation<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(CapsulePair, separation_is_the_distance) {
  check_property(this->runs, separation_is_the_distance<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(CapsulePair, contact_moves_out) {
  check_property(this->runs, contact_moves_out<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(CapsulePair, other_way_round_is_the_same) {
  check_property(this->runs, other_way_round_is_the_same<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(CapsulePair, same_bits_at_every_size) {
  check_property(this->runs, same_bits_at_every_size<typename TypeParam::A, typename TypeParam::B>);
}

template <class Shape> class CapsuleRay : public ::testing::Test {};
using RayTargets = ::testing::Types<Capsule<float>, Capsule<double>, Capsule<Wide>>;
TYPED_TEST_SUITE(CapsuleRay, RayTargets);

TYPED_TEST(CapsuleRay, raycast_is_the_motion_of_a_point) {
  check_property(1000, raycast_is_the_motion_of_a_point<TypeParam>);
}

}  // namespace
}  // namespace thinwall::testing
