// A capsule by center, axis, height and radius.

#include <thinwall/capsule/capsule_from.hpp>

#include <gtest/gtest.h>

#include "support/scalars.hpp"

namespace thinwall::testing {
namespace {

template <class S> class CapsuleFrom : public ::testing::Test {};
TYPED_TEST_SUITE(CapsuleFrom, Scalars, ScalarNames);

TYPED_TEST(CapsuleFrom, height_is_end_to_end) {
  using S = TypeParam;
  const auto c = capsule_from<S>({1, 2, 3}, {0, 0, 5}, 6, 1);
  EXPECT_EQ(c.a, (Vec3<S>(1, 2, 1)));
  EXPECT_EQ(c.b, (Vec3<S>(1, 2, 5)));
  EXPECT_EQ(c.radius, S(1));
  EXPECT_EQ(center(c), (Vec3<S>(1, 2, 3)));
}

TYPED_TEST(CapsuleFrom, of_two_radii_is_a_ball) {
  using S = TypeParam;
  const auto c = capsule_from<S>({1, 2, 3}, {1, 1, 1}, 2, 1);
  EXPECT_EQ(c.a, c.b);
  EXPECT_TRUE(valid(c));
}

TYPED_TEST(CapsuleFrom, axis_may_have_any_length) {
  using S = TypeParam;
  const int far = std::min(std::numeric_limits<S>::max_exponent, 16000) - 8;
  const auto unit = capsule_from<S>({0, 0, 0}, {1, -2, 3}, 4, 1);
  for (const int e : {far, -far}) {
    const auto c = capsule_from<S>({0, 0, 0}, times_power_of_two(Vec3<S>(1, -2, 3), e), 4, 1);
    EXPECT_EQ(c.b, unit.b);
  }
}

TYPED_TEST(CapsuleFrom, impossible_sizes_make_no_valid_capsule) {
  using S = TypeParam;
  EXPECT_FALSE(valid(capsule_from<S>({0, 0, 0}, {0, 0, 1}, next_down(S(2)), 1)));
  EXPECT_FALSE(valid(capsule_from<S>({0, 0, 0}, {0, 0, 1}, 2, -1)));
  EXPECT_FALSE(valid(capsule_from<S>({0, 0, 0}, {0, 0, 0}, 4, 1)));
  EXPECT_FALSE(valid(capsule_from<S>({0, 0, 0}, {0, 0, infinity<S>()}, 4, 1)));
  EXPECT_FALSE(valid(capsule_from<S>({0, 0, 0}, {0, 0, 1}, nan<S>(), 1)));
  EXPECT_FALSE(valid(capsule_from<S>({0, 0, 0}, {0, 0, 1}, infinity<S>(), 1)));
  EXPECT_FALSE(valid(capsule_from<S>({0, 0, 0}, {0, 0, 1}, 4, nan<S>())));
  const Sphere<S> ball{{0, 0, 0}, 1};
  EXPECT_FALSE(overlaps(capsule_from<S>({0, 0, 0}, {0, 0, 1}, 1, 1), ball));
}

}  // namespace
}  // namespace thinwall::testing
