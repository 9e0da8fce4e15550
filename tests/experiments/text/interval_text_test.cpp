#include <gtest/gtest.h>

#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {
namespace {

std::string shown(double value, double lower, double upper) {
  const IntervalText text = interval_text(value, lower, upper);
  return text.value + " [" + text.lower + ", " + text.upper + "]";
}

TEST(IntervalText, shows_the_digits_that_the_interval_supports) {
  EXPECT_EQ(shown(0.28723, 0.28591, 0.28851), "0.2872 [0.2859, 0.2885]");  // +- 0.0013: two digits of it
  EXPECT_EQ(shown(0.28723, 0.2812, 0.2932), "0.287 [0.281, 0.293]");       // +- 0.006: one
  EXPECT_EQ(shown(0.70263, 0.6925, 0.7125), "0.703 [0.693, 0.713]");
  EXPECT_EQ(shown(12345, 11543, 13147), "12300 [11500, 13100]");
  EXPECT_EQ(shown(-1.25, -1.4, -1.1), "-1.25 [-1.40, -1.10]") << "a supported zero is shown";
}

TEST(IntervalText, leaves_whole_numbers_whole) {
  EXPECT_EQ(shown(0, 0, 0.00048), "0 [0, 0.00048]");
  EXPECT_EQ(shown(1, 0.99952, 1), "1 [0.99952, 1]");
}

TEST(IntervalText, has_exponents_for_the_very_small_and_the_very_large) {
  EXPECT_EQ(shown(0, 0, 1.84e-5), "0 [0, 1.8e-05]");
  EXPECT_EQ(shown(1.2345e-6, 1.1e-6, 1.4e-6), "1.23e-06 [1.10e-06, 1.40e-06]");
  EXPECT_EQ(shown(1.2345e9, 1.1e9, 1.4e9), "1.23e+09 [1.10e+09, 1.40e+09]");
}

TEST(IntervalText, shows_four_digits_where_the_interval_has_no_width) {
  EXPECT_EQ(shown(0.123456, 0.123456, 0.123456), "0.1235 [0.1235, 0.1235]");
}

}  // namespace
}  // namespace thinwall
