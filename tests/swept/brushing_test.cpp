/// The closed form where little decides, against the oracle at 50 digits: verdicts and times to a backward error of 4 u.

#include <gtest/gtest.h>

#include "fuzz/judge.hpp"
#include "support/brushing.hpp"
#include "support/discrete_properties.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {
namespace {

using Pairs = ::testing::Types<PairOf<Sphere<double>, Sphere<double>>, PairOf<Aabb<double>, Sphere<double>>,
                               PairOf<Aabb<double>, Aabb<double>>, PairOf<Obb<double>, Sphere<double>>,
                               PairOf<Obb<double>, Aabb<double>>, PairOf<Obb<double>, Obb<double>>,
                               PairOf<Triangle<double>, Sphere<double>>, PairOf<Capsule<double>, Sphere<double>>,
                               PairOf<Capsule<double>, Aabb<double>>, PairOf<Capsule<double>, Obb<double>>,
                               PairOf<Capsule<double>, Capsule<double>>, PairOf<Capsule<double>, Triangle<double>>>;

template <class P> class Brushing : public ::testing::Test {};
TYPED_TEST_SUITE(Brushing, Pairs);

TYPED_TEST(Brushing, meets_the_contract_where_little_decides) {
  const std::size_t motions = slow_build ? 20 : thorough(500);
  std::size_t faults = 0;
  for (const int smallest : {-3, -30}) {
    for (std::size_t seed = 0; seed < motions; ++seed) {
      const auto [a, b] = BrushingDraw(seed, smallest).template motion<typename TypeParam::A, typename TypeParam::B>();
      const Toi<double> toi = time_of_impact(a, b);
      const auto fault = fuzz::judge_impact(fuzz::exhibit(a, b), toi.status, toi.time, 4);
      if (!fault) continue;
      if (++faults > 10) continue;
      ADD_FAILURE() << fault->property << ": " << fault->details << ", seed " << seed << ", sizes from 2^" << smallest;
    }
  }
  EXPECT_EQ(faults, 0U) << "of " << 2 * motions;
}

}  // namespace
}  // namespace thinwall::testing
