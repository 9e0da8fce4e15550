// The queries at one instant against the oracle: balls and boxes.

#include <gtest/gtest.h>

#include "support/discrete_properties.hpp"

namespace thinwall::testing {
namespace {

constexpr int runs = 3000;

template <class P> class DiscretePair : public ::testing::Test {};
using Pairs = ::testing::Types<PairOf<Sphere<float>, Sphere<float>>, PairOf<Sphere<double>, Sphere<double>>,
                               PairOf<Sphere<Wide>, Sphere<Wide>>, PairOf<Aabb<float>, Aabb<float>>,
                               PairOf<Aabb<double>, Aabb<double>>, PairOf<Aabb<float>, Sphere<float>>,
                               PairOf<Aabb<double>, Sphere<double>>, PairOf<Aabb<long double>, Sphere<long double>>>;
TYPED_TEST_SUITE(DiscretePair, Pairs);

TYPED_TEST(DiscretePair, overlaps_has_the_sign_of_the_separation) {
  check_property(runs, overlaps_has_the_sign_of_the_separation<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(DiscretePair, separation_is_the_distance) {
  check_property(runs, separation_is_the_distance<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(DiscretePair, contact_moves_out) {
  check_property(runs, contact_moves_out<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(DiscretePair, other_way_round_is_the_same) {
  check_property(runs, other_way_round_is_the_same<typename TypeParam::A, typename TypeParam::B>);
}
TYPED_TEST(DiscretePair, same_bits_at_every_size) {
  check_property(runs, same_bits_at_every_size<typename TypeParam::A, typename TypeParam::B>);
}

template <class Shape> class DiscreteRay : public ::testing::Test {};
using RayTargets = ::testing::Types<Sphere<float>, Sphere<double>, Sphere<Wide>, Aabb<float>, Aabb<double>>;
TYPED_TEST_SUITE(DiscreteRay, RayTargets);

TYPED_TEST(DiscreteRay, raycast_is_the_motion_of_a_point) {
  check_property(runs, raycast_is_the_motion_of_a_point<TypeParam>);
}

}  // namespace
}  // namespace thinwall::testing
