// Lengths whose squares overflow or vanish: the answer is not lost, and is the same to the bit.

#include <gtest/gtest.h>

#include <thinwall/discrete/queries.hpp>

#include "support/bodies.hpp"
#include "support/real.hpp"

namespace thinwall::testing {
namespace {

template <class S> class Range : public ::testing::Test {
 protected:
  /// Powers of two from the smallest to the largest at which small whole numbers stay exact.
  static std::vector<int> exponents() {
    using Limits = std::numeric_limits<S>;
    const int low = std::max(Limits::min_exponent + 2, -20000), high = std::min(Limits::max_exponent - 6, 20000);
    return {low, low / 2, -70, 70, high / 2, high - 3, high};
  }

  /// Checks all queries on two shapes at every size against the same at size one.
  template <class A, class B> static void same_at_every_size(const A& a, const B& b) {
    for (const int k : exponents()) {
      SCOPED_TRACE(k);
      const A large_a = scaled(a, k);
      const B large_b = scaled(b, k);
      EXPECT_EQ(overlaps(large_a, large_b), overlaps(a, b));
      EXPECT_EQ(separation(large_a, large_b).distance, times_power(separation(a, b).distance, k));
      EXPECT_EQ(separation(large_a, large_b).normal, separation(a, b).normal);
      const auto found = contact(large_a, large_b), expected = contact(a, b);
      ASSERT_EQ(found.has_value(), expected.has_value());
      if (!found) continue;
      EXPECT_EQ(found->penetration, times_power(expected->penetration, k));
      EXPECT_EQ(found->normal, expected->normal);
      EXPECT_EQ(found->local_b, times_power(expected->local_b, k));
    }
  }
};
TYPED_TEST_SUITE(Range, Scalars, ScalarNames);

TYPED_TEST(Range, balls) {
  using S = TypeParam;
  const Sphere<S> ball{{1, -2, 3}, 2};
  this->same_at_every_size(ball, Sphere<S>{{1, 1, 7}, 3});  // 3-4-5: touch
  this->same_at_every_size(ball, Sphere<S>{{1, 1, 7}, next_down(S(3))});
  this->same_at_every_size(ball, Sphere<S>{{2, 0, 3}, 1});
  this->same_at_every_size(ball, ball);
}

TYPED_TEST(Range, boxes) {
  using S = TypeParam;
  const Aabb<S> box{{0, 0, 0}, {1, 2, 3}};
  this->same_at_every_size(box, Aabb<S>{{2, 1, 1}, {1, 1, 1}});
  this->same_at_every_size(box, Aabb<S>{{next_up(S(2)), 1, 1}, {1, 1, 1}});
  this->same_at_every_size(box, Aabb<S>{{5, 7, 0}, {1, 1, 1}});
  this->same_at_every_size(box, Aabb<S>{{0.5, 0.5, 1}, {1, 1, 1}});
}

TYPED_TEST(Range, box_and_ball) {
  using S = TypeParam;
  const Aabb<S> box{{0, 0, 0}, {1, 2, 3}};
  this->same_at_every_size(box, Sphere<S>{{4, 6, 0}, 5});
  this->same_at_every_size(box, Sphere<S>{{4, 6, 0}, next_down(S(5))});
  this->same_at_every_size(box, Sphere<S>{{0.5, 0, 1}, 1});
  this->same_at_every_size(Sphere<S>{{0.5, 0, 1}, 1}, box);
}

TYPED_TEST(Range, rays) {
  using S = TypeParam;
  const Ray<S> ray{{-4, 0.5, -0.25}, {2, 0.25, 0.125}};
  const auto check = [&](const auto& shape) {
    const auto expected = raycast(ray, shape);
    ASSERT_TRUE(expected.has_value());
    for (const int k : this->exponents()) {
      SCOPED_TRACE(k);
      const Ray<S> large{times_power(ray.origin, k), times_power(ray.direction, k), ray.max_t};
      const auto found = raycast(large, scaled(shape, k));
      ASSERT_TRUE(found.has_value());
      EXPECT_EQ(found->t, expected->t);
      EXPECT_EQ(found->normal, expected->normal);
      EXPECT_EQ(found->point, times_power(expected->point, k));
    }
  };
  check(Sphere<S>{{0, 0, 0}, 2});
  check(Aabb<S>{{0, 0, 0}, {1, 2, 3}});
}

TEST(RangeOfDouble, the_least_number_is_a_size) {
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(overlaps(Sphere<double>{{0, 0, 0}, least}, Sphere<double>{{2 * least, 0, 0}, least}));
  EXPECT_FALSE(overlaps(Sphere<double>{{0, 0, 0}, least}, Sphere<double>{{3 * least, 0, 0}, least}));
}

}  // namespace
}  // namespace thinwall::testing
