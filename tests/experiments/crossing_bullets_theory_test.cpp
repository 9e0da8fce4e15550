/// The crossing bullets' encounters, oracle and theory, without any rule: limits that have a formula of their own.
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/crossing_bullets/model.hpp>
#include <thinwall/experiments/crossing_bullets/theory.hpp>
#include <thinwall/experiments/lab/statistics.hpp>

namespace thinwall {
namespace {

const std::vector<Crossing> crossings = {
    head_on,
    {10, 1.0 / 60, 0.02, 0, 0, 4},
    {10, 1.0 / 60, 0.02, 0.5, 0, 1},
    {300, 1.0 / 60, 0.02, 1, 90, 4},
    {300, 1.0 / 60, 0.02, 0.1, 150, 16},
};

/// A path of 5000 contact distances: where a step begins and ends no longer matters.
Crossing long_path(double ratio, double angle_deg, double offset) {
  return {1000, 0.2, 0.02, ratio, angle_deg, offset};
}

TEST(CrossingEncounter, nothing_touches_at_the_start) {
  for (const Crossing& c : crossings) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
      ASSERT_GT(gap_at(random_encounter(c, crossing_factors().stream(c, 1), i), 0), -1e-12)
          << crossing_factors().key(c);
    }
  }
}

TEST(CrossingEncounter, first_contact_is_uniform_over_the_step) {
  std::vector<double> counts(50);
  for (std::uint64_t i = 0; i < 50000; ++i) {
    const TrueContact truth = true_contact(random_encounter(head_on, crossing_factors().stream(head_on, 3), i));
    ASSERT_TRUE(truth.touches);
    ++counts[std::min<std::size_t>(49, static_cast<std::size_t>(50 * truth.time))];
  }
  double sum = 0;
  for (const double count : counts) sum += (count - 1000) * (count - 1000) / 1000;
  EXPECT_TRUE(chi_square_range(49, 0.9999).contains(sum)) << sum;
}

/// Against poses: the gap closes at the time, is open before, and stays open where the oracle says so.
TEST(CrossingEncounter, oracle_agrees_with_the_gap) {
  for (const Crossing& c : crossings) {
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Encounter e = random_encounter(c, crossing_factors().stream(c, 1), i);
      const TrueContact truth = true_contact(e);
      const double end = truth.touches ? static_cast<double>(truth.time) : 1;
      for (int k = 0; k < 200; ++k) ASSERT_GT(gap_at(e, end * k / 200), -1e-12) << crossing_factors().key(c);
      if (truth.touches) {
        ASSERT_NEAR(gap_at(e, end), 0, 1e-12) << crossing_factors().key(c);
      }
    }
  }
}

TEST(CrossingTheory, a_pose_sees_the_mean_chord_over_the_step) {
  const Crossing c = {300, 1.0 / 60, 0.02, 0.5, 60, 4};
  EXPECT_NEAR(theory_of(c).touch_at_end, 4 * contact_distance(c) / 3 / relative_path(c).norm() / 16, 1e-15);
  const Crossing slow = {0.1, 1.0 / 60, 0.02, 0, 0, 1};  // still in contact at the end of almost any step it touches in
  EXPECT_GT(theory_of(slow).touch_at_end, 0.9);
  EXPECT_LT(theory_of(slow).touch_at_end, 1);
}

/// The ray enters where it is within r of the other's line, which is there within sqrt(3) r of the entry, of a disc of 2 r.
TEST(CrossingTheory, on_long_paths_the_rule_confirms_a_share_with_a_formula) {
  for (const double ratio : {0.1, 0.5, 1.0}) {
    for (const double angle : {30.0, 90.0, 150.0}) {
      const CrossingTheory t = theory_of(long_path(ratio, angle, 1));
      const double turn = angle * (std::numbers::pi / 180);
      const double closing = std::sqrt(1 + ratio * ratio - 2 * ratio * std::cos(turn));
      EXPECT_NEAR(t.confirmed.share, std::sqrt(3.0) / std::numbers::pi * std::sin(turn) / closing, 1e-3)
          << ratio << " " << angle;
    }
    EXPECT_LT(theory_of(long_path(ratio, 180, 1)).confirmed.share, 1e-3);
  }
  EXPECT_NEAR(theory_of(long_path(0, 0, 1)).confirmed.share, 0.25, 1e-3);  // a point against r, where 2 r touches
}

/// The tracks overlap where they pass within contact of each other's plane: a strip of the disc.
TEST(CrossingTheory, on_long_paths_swept_overlap_is_a_strip) {
  for (const double k : {2.0, 4.0, 16.0}) {
    const double strip = 2 / std::numbers::pi * (std::asin(1 / k) + std::sqrt(k * k - 1) / (k * k));
    EXPECT_NEAR(theory_of(long_path(1, 90, k)).false_overlap, strip - 1 / (k * k), 1e-3) << k;
  }
  EXPECT_EQ(theory_of(long_path(1, 180, 4)).false_overlap, 0);
  EXPECT_EQ(theory_of(long_path(1, 90, 1)).false_overlap, 0);
}

TEST(CrossingTheory, scales_with_length) {
  const CrossingTheory t = theory_of({10, 1.0 / 60, 0.02, 0.5, 60, 4}),
                       big = theory_of({80, 1.0 / 60, 0.16, 0.5, 60, 4});
  EXPECT_NEAR(t.confirmed.share, big.confirmed.share, 1e-12);
  EXPECT_NEAR(t.false_overlap, big.false_overlap, 1e-12);
  EXPECT_NEAR(t.confirmed.lateness_mean, big.confirmed.lateness_mean, 1e-12);
}

}  // namespace
}  // namespace thinwall
