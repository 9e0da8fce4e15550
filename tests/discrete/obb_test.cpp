// Which axes an oriented box may have.

#include <gtest/gtest.h>

#include <thinwall/discrete/obb.hpp>

#include "support/scalars.hpp"

namespace thinwall::testing {
namespace {

template <class S> class ObbAxes : public ::testing::Test {
 protected:
  /// A box with one number of its axes off by so much.
  static Obb<S> off_by(int row, int column, const S& off) {
    Obb<S> box{{0, 0, 0}, {1, 1, 1}, Mat3<S>::Identity()};
    box.axes(row, column) += off;
    return box;
  }
};
TYPED_TEST_SUITE(ObbAxes, Scalars, ScalarNames);

TYPED_TEST(ObbAxes, are_orthonormal_to_more_than_half_the_digits) {
  using S = TypeParam;
  const bool is_float = std::is_same_v<S, float>;
  const S rounding = power<S>(is_float ? -15 : -32),
          beyond = power<S>(is_float ? -12 : -29);  // a unit column's square is off by twice that
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      EXPECT_TRUE(valid(this->off_by(row, column, rounding)));
      EXPECT_FALSE(valid(this->off_by(row, column, beyond)));
      for (const S& bad : {nan<S>(), infinity<S>(), S(-3), std::numeric_limits<S>::max()}) {
        EXPECT_FALSE(valid(this->off_by(row, column, bad))) << row << column << bad;
      }
    }
  }
  for (const S& factor : {S(0), S(0.5), S(2)}) {
    EXPECT_FALSE(valid(Obb<S>{{0, 0, 0}, {1, 1, 1}, Mat3<S>::Identity() * factor})) << factor;
  }
}

TYPED_TEST(ObbAxes, that_mirror_describe_the_same_box) {
  using S = TypeParam;
  const Obb<S> box{{0, 0, 0}, {1, 2, 3}, Mat3<S>::Identity()};
  Obb<S> mirrored = box;
  mirrored.axes.col(1) *= S(-1);
  EXPECT_TRUE(valid(mirrored));
  const Obb<S> other{{3, 3, 1}, {1, 2, 1}, Mat3<S>{{S(3) / 5, S(-4) / 5, 0}, {S(4) / 5, S(3) / 5, 0}, {0, 0, 1}}};
  EXPECT_EQ(separation(mirrored, other).distance, separation(box, other).distance);
  EXPECT_EQ(separation(mirrored, other).normal, separation(box, other).normal);
  EXPECT_EQ(raycast(Ray<S>{{-4, 1, 2}, {1, 0, 0}}, mirrored)->t, S(3));
}

TYPED_TEST(ObbAxes, that_lean_make_no_box) {  // nor does a NaN in one of them
  using S = TypeParam;
  const Sphere<S> ball{{0, 0, 0}, 1};
  for (const S& bad : {S(0.5), nan<S>()}) {
    const Obb<S> box = this->off_by(0, 1, bad);
    EXPECT_FALSE(overlaps(box, ball));
    EXPECT_FALSE(contact(ball, box));
    EXPECT_NE(separation(box, box).distance, separation(box, box).distance);
    EXPECT_FALSE(raycast(Ray<S>{{-4, 0, 0}, {1, 0, 0}}, box));
  }
}

}  // namespace
}  // namespace thinwall::testing
