// What turns, in every scalar: a rod that swings into a ball, by every method.

#include <cmath>

#include <gtest/gtest.h>

#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/turning/turning_bounds.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "support/real.hpp"

namespace thinwall::testing {
namespace {

using std::asin, std::cos, std::sin;

/// From the x axis a rod swings by one radian about its middle, and meets a ball's center line at half a radian.
template <class S> class SwungRod : public ::testing::Test {
 protected:
  const Turning<Capsule<S>> rod{{{-2, 0, 0}, {2, 0, 0}, S(0.125)}, {0, 0, 0}, {0, 0, 1}};
  const Moving<Sphere<S>> ball = at_rest(Sphere<S>{{S(cos(S(0.5))), S(sin(S(0.5))), 0}, S(0.125)});
  const S time = S(0.5) - S(asin(S(0.25)));  ///< the ball's center is one away from the rod's
};
TYPED_TEST_SUITE(SwungRod, Scalars, ScalarNames);

TYPED_TEST(SwungRod, meets_the_ball_by_every_method) {
  using S = TypeParam;
  for_each_type(TurningMethods<S>{}, [&]<class Method>(TypeTag<Method>) {
    const Toi<S> toi = time_of_impact(Method{}, this->rod, this->ball);
    const bool is_discrete = std::is_same_v<Method, EndOfStep<S>> || std::is_same_v<Method, LinearSweep<S>>;
    EXPECT_EQ(toi.status, is_discrete ? ToiStatus::apart : ToiStatus::hit) << Method::name;
  });
}

TYPED_TEST(SwungRod, meets_it_in_time) {
  using S = TypeParam;
  const Toi<S> toi = time_of_impact(this->rod, this->ball);
  EXPECT_LE(toi.time, this->time);
  EXPECT_GE(toi.time, this->time - 4 * half_digits<S>());
}

TYPED_TEST(SwungRod, is_bounded) {
  using S = TypeParam;
  const Aabb<S> bounds = swept_bounds(this->rod);
  EXPECT_TRUE(overlaps(bounds, Sphere<S>{{S(2 * cos(S(1))), S(2 * sin(S(1))), 0}, 0}));
  EXPECT_LE(bounds.half_extents[0], S(2.2));
  EXPECT_LE(bounds.half_extents[2], S(0.126));
}

}  // namespace
}  // namespace thinwall::testing
