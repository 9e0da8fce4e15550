/// The spinning rod: does theory agree, does a wrong one fail, who tunnels and who is late?

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/models/rods.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

namespace {

using std::numbers::pi;

/// At the default rod and wall.
RodFlight rod_flight(double spin_deg, double step_ratio, double tilt_deg = 90) {
  return {.half_length = 0.5,
          .radius = 0.05,
          .thickness = 0.05,
          .tilt_deg = tilt_deg,
          .spin_deg = spin_deg,
          .step_ratio = step_ratio};
}
constexpr BladePass a_pass = {
    .half_length = 0.5, .radius = 0.05, .post_radius = 0.05, .post_distance = 0.4, .post_spin_deg = 60};

RodMethod rod_method(const std::string& name) {
  return rod_methods(std::vector<std::string>{name}, std::vector<std::int64_t>{4}).front();
}

// ---- Theory.

TEST(SpinningRodTheory, is_the_mean_over_the_rods_angle) {
  for (const double spin : {0.0, 0.3, 0.5 * pi, 2.0, pi, 4.0, 7.8}) {
    for (const double step : {0.2, 0.5, 0.7, 0.9, 1.2, 5.0}) {
      constexpr double clearance = 0.15, reach = 0.5;
      constexpr int angles = 20000;
      double sum = 0;
      for (int i = 0; i < angles; ++i) {
        const double psi = pi * (i + 0.5) / angles;
        const double wide =
            std::max(std::abs(std::cos(spin / 2) * std::cos(psi)), std::abs(std::sin(spin / 2) * std::sin(psi)));
        sum += std::max(0.0, 1 - (clearance + 2 * reach * wide) / step);
      }
      EXPECT_NEAR(rod_miss_probability(clearance, reach, step, spin), sum / angles, 1e-7) << spin << " " << step;
    }
  }
}

TEST(SpinningRodTheory, loses_the_spin_on_long_steps) {
  for (const double spin : {0.0, 0.3, 1.0, 0.5 * pi, 3.0, 9.0}) {
    for (const double step : {1.15, 2.0, 30.0})
      EXPECT_NEAR(rod_miss_probability(0.15, 0.5, step, spin), long_step_miss_probability(0.15, 0.5, step), 1e-15);
  }
}

TEST(SpinningRodTheory, is_zero_up_to_a_step_that_spin_makes_longer) {
  for (const double spin : {0.0, 0.3, 1.0, 0.5 * pi, 2.5, 4.0}) {
    const double safe = 0.15 + 0.5 * std::abs(std::sin(spin));
    EXPECT_EQ(rod_miss_probability(0.15, 0.5, safe * (1 - 1e-12), spin), 0) << spin;
    EXPECT_GT(rod_miss_probability(0.15, 0.5, safe * (1 + 1e-3), spin), 0) << spin;
  }
  EXPECT_EQ(rod_miss_probability(0.15, 0, 0.3, 1), 0.5);  // a rod that stays flat is a ball
}

// ---- Motions.

/// By walking in small steps: the gap is open before the first contact, and closed at it.
TEST(SpinningRodOracle, finds_the_first_contact) {
  for (const RodFlight& c :
       {rod_flight(0, 1), rod_flight(90, 0.3), rod_flight(450, 0.125), rod_flight(720, 0.05, 30)}) {
    for (std::uint64_t i = 0; i < 50; ++i) {
      const RodMotion m = random_motion(c, random_stream(c, 7), i);
      constexpr int looks = 5000;
      for (int k = 0; k < looks; ++k)
        ASSERT_GT(gap_at(c, m, m.contact * k / looks), 0) << c.spin_deg << " deg, " << c.step_ratio;
      EXPECT_NEAR(gap_at(c, m, m.contact), 0, 1e-15) << c.spin_deg << " deg, " << c.step_ratio;
    }
  }
  for (std::uint64_t i = 0; i < 50; ++i) {
    const RodMotion m = random_motion(a_pass, random_stream(a_pass, 7), i);
    EXPECT_NEAR(gap_at(a_pass, m, m.contact), 0, 1e-15);
    EXPECT_GT(gap_at(a_pass, m, m.contact * 0.999L), 0);
    EXPECT_LE(m.contact, 1);
  }
}

/// 17,000 half turns before an end can reach the wall, of which the last 45 are walked.
TEST(SpinningRodOracle, leaves_out_turns_that_cannot_touch) {
  constexpr long double lead = 2, step = 1e-3L, spin = 36, reach = 0.5, skipped = 1496;
  for (int i = 0; i < 100; ++i) {
    const long double angle = 0.07L * i;
    const long double walked =
        skipped + first_contact(lead - step * skipped, step, reach, angle + spin * skipped, spin);
    EXPECT_NEAR(static_cast<double>(first_contact(lead, step, reach, angle, spin) - walked), 0, 1e-13) << i;
  }
}

/// It agrees with the library's shapes.
TEST(SpinningRodOracle, measures_the_gap_between_the_shapes) {
  const RodFlight c = rod_flight(100, 0.3, 50);
  const RodMotion m = random_motion(c, random_stream(c, 3), 1);
  for (std::int64_t k = 0; k < m.steps; ++k)
    EXPECT_NEAR(separation(step_of(m, k).shape, wall(c).shape).distance, gap_at(c, m, static_cast<long double>(k)),
                1e-13);
  const RodMotion blade = random_motion(a_pass, random_stream(a_pass, 3), 1);
  EXPECT_NEAR(separation(step_of(blade, 0).shape, post(a_pass).shape).distance, gap_at(a_pass, blade, 0), 1e-14);
}

TEST(SpinningRodOracle, turns_as_the_library_does) {
  const RodFlight c = rod_flight(100, 0.3, 50);
  const RodMotion m = random_motion(c, random_stream(c, 3), 1);
  const Capsule<double> there = pose_at(step_of(m, 0), 1.0), next = step_of(m, 1).shape;
  EXPECT_LT((there.a - next.a).norm() + (there.b - next.b).norm(), 1e-14);
}

// ---- Counts.

/// The failure is specified too.
TEST(SpinningRod, end_of_step_tunnels_and_spin_shields_a_short_step) {
  const RodMethod ends = rod_method("end_of_step");
  EXPECT_GT(fly(rod_flight(0, 0.4), ends, 1000, 1).tunneled, 40);  // theory: 67
  EXPECT_EQ(fly(rod_flight(90, 0.4), ends, 1000, 1).tunneled, 0);
  EXPECT_GT(pass(a_pass, ends, 1000, 1).tunneled, 400);
}

/// The right theory passes; one that forgets the pose on the wall's other side fails, on short steps and on long ones.
TEST(SpinningRod, the_judge_passes_the_theory_and_fails_a_wrong_one) {
  const RodMethod ends = rod_method("end_of_step");
  const auto first_pose_alone = [](const RodFlight& c) {
    constexpr int angles = 2000;
    double sum = 0;
    for (int i = 0; i < angles; ++i) {
      const double wide = reach(c) * std::abs(std::cos(radians(c.spin_deg) / 2) * std::cos(pi * (i + 0.5) / angles));
      sum += std::max(0.0, 1 - (clearance(c) + 2 * wide) / step_length(c));
    }
    return sum / angles;
  };
  for (const std::vector<double>& ratios : {std::vector{0.4, 0.55, 0.7, 0.85}, std::vector{1.0, 2.0, 4.0, 8.0}}) {
    std::vector<CellCount> right, wrong;
    for (const double ratio : ratios) {
      for (const double spin : {60.0, 90.0, 135.0}) {
        const RodFlight c = rod_flight(spin, ratio);
        const RodTally tally = fly(c, ends, 2000, 1);
        right.push_back({ends.name, "wall", tally.trials, tally.tunneled, *ends.wall_theory(c)});
        wrong.push_back({ends.name, "wall", tally.trials, tally.tunneled, first_pose_alone(c)});
      }
    }
    EXPECT_TRUE(all_passed(self_test(right))) << self_test_text(self_test(right));
    EXPECT_FALSE(all_passed(self_test(wrong))) << self_test_text(self_test(wrong));
  }
}

TEST(SpinningRod, what_is_never_late_never_tunnels_at_the_wall_and_the_post) {
  for (const char* name : {"speculative", "conservative_advancement"}) {
    const RodMethod method = rod_method(name);
    for (const RodTally& tally : {fly(rod_flight(450, 0.25, 60), method, 300, 1),
                                  fly(rod_flight(90, 8), method, 300, 1), pass(a_pass, method, 300, 1)}) {
      EXPECT_EQ(tally.tunneled + tally.undecided + tally.late, 0) << name;
      EXPECT_LE(tally.latest, 0) << name;
    }
  }
  EXPECT_EQ(fly(rod_flight(450, 0.25, 60), rod_method("conservative_advancement"), 300, 1).false_hits, 0);
  EXPECT_GT(fly(rod_flight(450, 0.25, 60), rod_method("speculative"), 300, 1).false_hits, 100);
}

TEST(SpinningRod, a_linear_sweep_is_late_where_the_rod_spins_and_misses_what_only_spins) {
  const RodMethod sweep = rod_method("linear_sweep");
  const RodTally straight = fly(rod_flight(0, 2), sweep, 500, 1), spun = fly(rod_flight(90, 2), sweep, 500, 1);
  EXPECT_EQ(straight.tunneled + straight.late, 0);
  EXPECT_EQ(spun.tunneled, 0);
  EXPECT_GT(spun.late, 100);
  EXPECT_LT(spun.deepest, -0.1);
  const RodTally blade = pass(a_pass, sweep, 500, 1), ends = pass(a_pass, rod_method("end_of_step"), 500, 1);
  EXPECT_EQ(blade.tunneled, ends.tunneled);
}

/// What the rod turns towards the wall within a step, and nearly that: L' sin(spin), L' from a quarter turn on.
TEST(SpinningRod, a_linear_sweep_is_so_deep_at_worst) {
  for (const double spin : {0.0, 30.0, 60.0, 90.0, 300.0}) {
    for (const double ratio : {0.4, 2.0}) {
      const RodFlight c = rod_flight(spin, ratio, 50);
      const double worst = reach(c) * std::sin(radians(std::min(spin, 90.0)));
      const RodTally tally = fly(c, rod_method("linear_sweep"), 3000, 1);
      EXPECT_GE(tally.deepest, -worst - 1e-12) << c.spin_deg << " deg, " << c.step_ratio;
      if (ratio == 2) {
        EXPECT_LE(tally.deepest, -0.9 * worst + 1e-12) << c.spin_deg << " deg, " << c.step_ratio;
      }
    }
  }
}

TEST(SpinningRodConfig, answers_for_any_choice_of_methods) {
  for (const std::string_view name : rod_method_names()) {
    const Outcome outcome = outcome_of(spinning_rod_experiment(),
                                       "spin_deg = [90]\ntilt_deg = [0, 90]\nstep_ratio = [2]\nflights = 20\n"
                                       "post_spin_deg = [60]\nmethod = ['" +
                                           std::string(name) + "']");
    EXPECT_TRUE(holds(outcome.answer, name));
    EXPECT_FALSE(outcome.figures.empty());
  }
}

TEST(SpinningRodConfig, refuses_what_cannot_be_asked) {
  expect_refusals(spinning_rod_experiment(), {{"post_distance = 0.1", "more than radius + post_radius"},
                                              {"post_distance = 0.6", "at most half_length"},
                                              {"post_spin_deg = [152]", "so that one end alone is near the post"},
                                              {"step_ratio = [0.01]", "key 'step_ratio'"},
                                              {"spin_deg = [1000]", "key 'spin_deg'"},
                                              {"tilt_deg = [91]", "key 'tilt_deg'"},
                                              {"substeps = [1]", "key 'substeps'"}});
}

}  // namespace

}  // namespace thinwall
