// The queries at one instant against the oracle: balls and boxes.

#include <gtest/gtest.h>

#include "support/discrete_properties.hpp"

namespace thinwall::testing {
namespace {

using Pairs = ::testing::Types<PairOf<Sphere<float>, Sphere<float>>, PairOf<Sphere<double>, Sphere<double>>,
                               PairOf<Sphere<Wide>, Sphere<Wide>>, PairOf<Aabb<float>, Aabb<float>>,
                               PairOf<Aabb<double>, Aabb<double>>, PairOf<Aabb<Wide>, Aabb<Wide>>,
                               PairOf<Aabb<float>, Sphere<float>>, PairOf<Aabb<double>, Sphere<double>>,
                               PairOf<Aabb<long double>, Sphere<long double>>>;
INSTANTIATE_TYPED_TEST_SUITE_P(DiscretePair, OneInstant, Pairs);

using RayTargets = ::testing::Types<Sphere<float>, Sphere<double>, Sphere<Wide>, Aabb<float>, Aabb<double>>;
INSTANTIATE_TYPED_TEST_SUITE_P(DiscreteRay, RayAtOneInstant, RayTargets);

}  // namespace
}  // namespace thinwall::testing
