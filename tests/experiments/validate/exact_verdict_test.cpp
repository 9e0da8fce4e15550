/// The judge itself, on cases that a person can check; each touch has a miss beside it.

#include <thinwall/experiments/validate/exact_verdict.hpp>

#include <gtest/gtest.h>

namespace thinwall {
namespace {

const Rational half = Rational(1) / 2, tiny = Rational(1) / Rational(Integer(1) << 2000);

std::optional<Rational> in_triangle(const RationalPoint& start, const RationalPoint& displacement) {
  return first_contact({FlatSet::triangle, start, displacement, {2, 0, 0}, {0, 2, 0}});
}
std::optional<Rational> in_parallelogram(const RationalPoint& start, const RationalPoint& displacement) {
  return first_contact({FlatSet::parallelogram, start, displacement, {2, 0, 0}, {0, 2, 0}});
}

TEST(ExactVerdict, across_the_plane) {
  EXPECT_EQ(in_triangle({half, half, 1}, {0, 0, -2}), half);
  EXPECT_EQ(in_triangle({half, half, 1}, {0, 0, -1}), 1);  // touches at the end of the step
  EXPECT_EQ(in_triangle({half, half, 1 + tiny}, {0, 0, -1}), std::nullopt);
  EXPECT_EQ(in_triangle({half, half, 0}, {0, 0, -1}), 0);  // and at its start
  EXPECT_EQ(in_triangle({half, half, -tiny}, {0, 0, -1}), std::nullopt);
  EXPECT_EQ(in_triangle({half, half, 1}, {0, 0, 2}), std::nullopt);
}

TEST(ExactVerdict, on_the_rim) {
  EXPECT_EQ(in_triangle({1, 1, 1}, {0, 0, -2}), half);
  EXPECT_EQ(in_triangle({1, 1 + tiny, 1}, {0, 0, -2}), std::nullopt);
  EXPECT_EQ(in_triangle({2, 0, 1}, {0, 0, -2}), half);
  EXPECT_EQ(in_triangle({2 + tiny, 0, 1}, {0, 0, -2}), std::nullopt);
  EXPECT_EQ(in_triangle({0, 0, 1}, {0, 0, -2}), half);
  EXPECT_EQ(in_triangle({0, -tiny, 1}, {0, 0, -2}), std::nullopt);
  EXPECT_EQ(in_parallelogram({2, 2, 1}, {0, 0, -2}), half);
  EXPECT_EQ(in_parallelogram({2, 2 + tiny, 1}, {0, 0, -2}), std::nullopt);
}

TEST(ExactVerdict, within_the_plane) {
  EXPECT_EQ(in_triangle({-1, half, 0}, {2, 0, 0}), half);
  EXPECT_EQ(in_triangle({-1, half, tiny}, {2, 0, 0}), std::nullopt);
  EXPECT_EQ(in_triangle({-1, 2, 0}, {2, 0, 0}), half);  // past the corner only
  EXPECT_EQ(in_triangle({-1, 2 + tiny, 0}, {2, 0, 0}), std::nullopt);
  EXPECT_EQ(in_triangle({-1, 0, 0}, {2, 0, 0}), half);  // along an edge
  EXPECT_EQ(in_parallelogram({3, 2, 0}, {-2, 0, 0}), half);
}

TEST(ExactVerdict, without_motion) {
  EXPECT_EQ(in_triangle({1, half, 0}, {0, 0, 0}), 0);
  EXPECT_EQ(in_triangle({1, 1, 0}, {0, 0, 0}), 0);
  EXPECT_EQ(in_triangle({1, 1 + tiny, 0}, {0, 0, 0}), std::nullopt);
  EXPECT_EQ(in_triangle({1, half, tiny}, {0, 0, 0}), std::nullopt);
}

TEST(ExactVerdict, sets_without_area) {
  const auto line = [](FlatSet set, const RationalPoint& start, const RationalPoint& displacement) {
    return first_contact({set, start, displacement, {2, 2, 0}, {-1, -1, 0}});
  };
  for (const FlatSet set : {FlatSet::triangle, FlatSet::parallelogram}) {
    EXPECT_EQ(line(set, {1, 1, 1}, {0, 0, -2}), half);
    EXPECT_EQ(line(set, {1, 1 + tiny, 1}, {0, 0, -2}), std::nullopt);
    EXPECT_EQ(line(set, {-1, -1, 1}, {0, 0, -2}), half);
    EXPECT_EQ(line(set, {-1 - tiny, -1 - tiny, 1}, {0, 0, -2}), std::nullopt);
    EXPECT_EQ(line(set, {4, 4, 0}, {-4, -4, 0}), half);
    EXPECT_EQ(first_contact({set, {1, 2, 3}, {-2, -4, -6}, {0, 0, 0}, {0, 0, 0}}), half);
    EXPECT_EQ(first_contact({set, {1, 2, 3 + tiny}, {-2, -4, -6}, {0, 0, 0}, {0, 0, 0}}), std::nullopt);
  }
  EXPECT_EQ(first_contact({FlatSet::triangle, {3, 0, 1}, {0, 0, -1}, {2, 0, 0}, {1, 0, 0}}), std::nullopt);
  EXPECT_EQ(first_contact({FlatSet::parallelogram, {3, 0, 1}, {0, 0, -1}, {2, 0, 0}, {1, 0, 0}}), 1);
}

}  // namespace
}  // namespace thinwall
