/// The chance of going through, averaged over angles.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <thinwall/experiments/engines/theory.hpp>
#include <thinwall/experiments/tunneling_theory.hpp>

#include "experiments/engines/engines_run.hpp"

namespace thinwall {
namespace {

/// The same by the midpoint rule, from the formula for one angle.
double average(double depth, double spacing, double angle_deg) {
  constexpr int parts = 20000;
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double a = (i + 0.5) / parts * angle_deg * std::numbers::pi / 180;
    sum += miss_probability(slab_chord(depth, 0, std::cos(a)), spacing) / parts;
  }
  return sum;
}

TEST(EngineTheory, is_the_average_over_the_angles) {
  for (const double spacing : {0.05, 0.056, 0.1, 0.11, 1.0, 10.0}) {
    for (const double angle : {1.0, 30.0, 60.0, 89.0}) {
      EXPECT_NEAR(mean_miss_probability(0.055, spacing, angle), average(0.055, spacing, angle), 1e-6)
          << spacing << " " << angle;
    }
  }
  EXPECT_EQ(mean_miss_probability(0.055, 0.11, 0), 0.5);
  EXPECT_NEAR(mean_miss_probability(0.055, 0.11, 1e-3), 0.5, 1e-9);
  EXPECT_EQ(mean_miss_probability(0.055, 0.055, 60), 0);
}

TEST(EngineTheory, counts_both_surfaces_of_what_is_never_seen_and_half_of_what_is_seen_in_time) {
  EXPECT_EQ(unseen_theory(meter_cell, 1), mean_miss_probability(0.11, 1, 60));
  EXPECT_EQ(through_theory(meter_cell, 1), mean_miss_probability(0.055, 1, 60));
  EXPECT_EQ(through_theory(meter_cell, 4), mean_miss_probability(0.055, 0.25, 60));
  EXPECT_NEAR(through_theory(meter_cell, 1, 0.01), mean_miss_probability(0.065, 1, 60), 1e-15);
  EXPECT_NEAR(unseen_theory(meter_cell, 1, 0.01), mean_miss_probability(0.13, 1, 60), 1e-15);
}

}  // namespace
}  // namespace thinwall
