// The queries at one instant against the oracle: capsules with balls, boxes and capsules.

#include <gtest/gtest.h>

#include "support/discrete_properties.hpp"

namespace thinwall::testing {
namespace {

using Pairs = ::testing::Types<PairOf<Capsule<float>, Sphere<float>>, PairOf<Capsule<double>, Sphere<double>>,
                               PairOf<Capsule<float>, Aabb<float>>, PairOf<Capsule<double>, Aabb<double>>,
                               PairOf<Capsule<long double>, Aabb<long double>>, PairOf<Capsule<float>, Capsule<float>>,
                               PairOf<Capsule<double>, Capsule<double>>, PairOf<Capsule<Wide>, Capsule<Wide>>>;
INSTANTIATE_TYPED_TEST_SUITE_P(CapsulePair, OneInstant, Pairs);

using RayTargets = ::testing::Types<Capsule<float>, Capsule<double>, Capsule<Wide>>;
INSTANTIATE_TYPED_TEST_SUITE_P(CapsuleRay, RayAtOneInstant, RayTargets);

}  // namespace
}  // namespace thinwall::testing
