// Lanes and pairs do what plain numbers do, to the bit.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <thinwall/discrete/clear/vectors.hpp>

namespace thinwall::packed {
namespace {

const Vec3<double> a(3, -0x1.8p-40, 7), b(-2, 5, 0x1p60);
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Vec3<double> stored(const Lanes& x) {
  Vec3<double> to;
  store(x, to);
  return to;
}

TEST(ClearLanes, arithmetic_goes_lane_by_lane) {
  EXPECT_EQ(stored(lanes(a)), a);
  EXPECT_EQ(stored(lanes(a) + lanes(b)), a + b);
  EXPECT_EQ(stored(lanes(a) - lanes(b)), a - b);
  EXPECT_EQ(stored(lanes(a) * lanes(b)), a.cwiseProduct(b));
  EXPECT_EQ(stored(lanes(a) / lanes(b)), a.cwiseQuotient(b));
  EXPECT_EQ(stored(min(lanes(a), lanes(b))), a.cwiseMin(b));
  EXPECT_EQ(stored(max(lanes(a), lanes(b))), a.cwiseMax(b));
  EXPECT_EQ(stored(abs(lanes(a))), a.cwiseAbs());
  EXPECT_EQ(stored(yzx(lanes(a))), Vec3<double>(a[1], a[2], a[0]));
  EXPECT_EQ(stored(packed::cross(lanes(a), lanes(b))), thinwall::cross<double>(a, b));
  EXPECT_EQ(value(root(both(2))), std::sqrt(2.0));
}

TEST(ClearLanes, a_length_near_1_is_made_nearer_by_its_square) {
  const Vec3<long double> unit(0.6L, 0, 0.8L);
  for (const double off : {0x1p-28, -0x1p-28, 0x1p-10}) {
    const Vec3<double> made = stored(nearer_unit(lanes((unit * (1 + off)).cast<double>())));
    EXPECT_NEAR(static_cast<double>(made.cast<long double>().norm() - 1), -1.5 * off * off,
                0x1p-52 + std::abs(off * off * off))
        << off;
  }
}

TEST(ClearLanes, sums_have_one_order) {  // (1 + 2^-53) + 2^-53 is 1, 1 + (2^-53 + 2^-53) is not
  const double tiny = 0x1p-53;
  EXPECT_EQ(value(sum(lanes(Vec3<double>(1, tiny, tiny)))), 1.0);
  EXPECT_EQ(value(sum(lanes(Vec3<double>(tiny, tiny, 1)))), 1 + 2 * tiny);
  const Pair sums = two_sums(lanes(a), lanes(b));
  EXPECT_EQ(value(firsts(sums)), (a[0] + a[1]) + a[2]);
  EXPECT_EQ(value(seconds(sums)), (b[0] + b[1]) + b[2]);
}

TEST(ClearLanes, least_and_largest_are_of_all_three) {
  for (int i = 0; i < 3; ++i) {
    Vec3<double> v(1, 1, 1);
    v[i] = 2;
    EXPECT_EQ(value(largest_of(lanes(v))), 2) << i;
    v[i] = -2;
    EXPECT_EQ(value(smallest_of(lanes(v))), -2) << i;
  }
}

TEST(ClearLanes, where_there_are_four_the_fourth_repeats_the_third) {
  for (const double far : {100.0, -100.0}) {
    const Lanes p = lanes(Vec3<double>(1, far, 2)), q = lanes(Vec3<double>(far, 3, 1)),
                r = lanes(Vec3<double>(2, far, 3));
    const Vectors<Lanes> rows = transposed(p, q, r), all_of_p = spread(p);
    for (const Lanes& x : {p, yzx(p), yzx(yzx(p)), rows.x, rows.y, rows.z, all_of_p.y, packed::cross(p, q), p + q * r,
                           only(lowest(1), rows), keep(mask(true, false, true), p), all(far), all(sum(p))}) {
      const Vec3<double> v = stored(x);
      EXPECT_EQ(value(largest_of(x)), v.maxCoeff()) << v.transpose();
      EXPECT_EQ(value(smallest_of(x)), v.minCoeff()) << v.transpose();
      for (const Pair& sums : {sum(x), two_sums(x, x)}) {
        EXPECT_EQ(value(firsts(sums)), (v[0] + v[1]) + v[2]) << v.transpose();
        EXPECT_EQ(value(seconds(sums)), (v[0] + v[1]) + v[2]) << v.transpose();
      }
    }
  }
}

TEST(ClearLanes, a_comparison_with_what_is_not_a_number_is_false) {
  const Lanes x = lanes(Vec3<double>(1, nan, 3)), y = lanes(Vec3<double>(2, 2, 2));
  EXPECT_EQ(bits(x < y), 1U);
  EXPECT_EQ(bits(y < x), 4U);
  EXPECT_EQ(bits(x <= x), 5U);
  EXPECT_FALSE(all_of(both(nan) <= both(nan)));
  EXPECT_EQ(stored(max(x, y)), Vec3<double>(2, 2, 3));  // the second, where one is not a number
}

TEST(ClearLanes, masks_select) {
  const LanesMask first = lanes(a) < lanes(b);
  EXPECT_EQ(bits(first), 6U);
  EXPECT_EQ(stored(select(first, lanes(a), lanes(b))), Vec3<double>(b[0], a[1], a[2]));
  EXPECT_EQ(stored(keep(first, lanes(a))), Vec3<double>(0, a[1], a[2]));
  EXPECT_EQ(bits(first & (lanes(a) < all(1))), 2U);
  EXPECT_EQ(bits(first | (lanes(a) < all(4))), 7U);
}

TEST(ClearLanes, as_if_downwards) {
  EXPECT_EQ(stored(against(lanes(a), lanes(Vec3<double>(1, -1, 0)))), Vec3<double>(-3, a[1], -7));
  EXPECT_EQ(stored(against(lanes(a), lanes(Vec3<double>(-0.0, -1, -2)))), a);
}

TEST(ClearLanes, vectors_side_by_side_are_asked_at_once) {
  const Vec3<double> c(0.1, -0.7, 11);
  const Vectors<Lanes> rows = transposed(lanes(a), lanes(b), lanes(c));
  EXPECT_EQ(stored(rows.x), Vec3<double>(a[0], b[0], c[0]));
  EXPECT_EQ(stored(rows.y), Vec3<double>(a[1], b[1], c[1]));
  EXPECT_EQ(stored(rows.z), Vec3<double>(a[2], b[2], c[2]));
  const Lanes v = lanes(Vec3<double>(5, 3, -2));
  EXPECT_EQ(stored(dot(rows, spread(v))),
            Vec3<double>(value(dot(lanes(a), v)), value(dot(lanes(b), v)), value(dot(lanes(c), v))));
  EXPECT_EQ(stored(only(lowest(2), rows)), b);
  const Pair two = dot(side_by_side(a, b), twice(c));
  EXPECT_EQ(value(firsts(two)), (a[0] * c[0] + a[1] * c[1]) + a[2] * c[2]);
  EXPECT_EQ(value(seconds(two)), (b[0] * c[0] + b[1] * c[1]) + b[2] * c[2]);
}

TEST(ClearLanes, the_lowest_bit_has_the_lane) {
  for (const unsigned which : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U}) EXPECT_EQ(bits(lowest(which)), which & (~which + 1U));
  for (unsigned which = 0; which < 16; ++which) {
    const LanesMask of_four = mask((which & 1U) != 0, (which & 2U) != 0, (which & 4U) != 0, (which & 8U) != 0);
    EXPECT_EQ(four_bits(of_four), which);
    EXPECT_EQ(four_bits(lowest_of_four(of_four)), which & (~which + 1U));
  }
}

}  // namespace
}  // namespace thinwall::packed
