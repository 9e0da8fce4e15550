/// Bounces off a wall that only pushes: energy (case 54), what splitting the step changes, and who gets through.
#include <thinwall/experiments/stiff_contact/bounce.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include <thinwall/experiments/stiff_contact/tally.hpp>
#include <thinwall/experiments/stiff_contact/theory.hpp>

namespace thinwall {
namespace {

constexpr Approach usual = {.mass = 1, .speed = 10, .radius = 0.05, .thickness = 0.02, .blow_up = 10};

PenaltyContact contact_by(Scheme scheme, Detection detection, double step, double zeta = 0, double stiffness = 1e10) {
  return {scheme, detection, stiffness, zeta, step};
}

struct SpeedRange {
  double least = 1e300, most = 0;
};

SpeedRange speeds(const PenaltyContact& contact, int phases) {
  SpeedRange range;
  for (int i = 0; i < phases; ++i) {
    const Bounce b = bounce(usual, contact, static_cast<double>(i) / phases);
    EXPECT_EQ(b.ending, Ending::returned);
    range.least = std::min(range.least, b.speed);
    range.most = std::max(range.most, b.speed);
  }
  return range;
}

TEST(StiffBounce, case_54_linear_stability_is_not_enough) {
  const SpeedRange fine = speeds(contact_by(Scheme::semi_implicit, Detection::discrete, 0.3), 2000);
  EXPECT_NEAR(fine.least, 0.989, 5e-4);
  EXPECT_NEAR(fine.most, 1.011, 5e-4);
  const SpeedRange rough = speeds(contact_by(Scheme::semi_implicit, Detection::discrete, 1.5), 2000);
  EXPECT_NEAR(rough.least, 0.80, 5e-3);
  EXPECT_NEAR(rough.most, 1.25, 5e-3);
  const SpeedRange last = speeds(contact_by(Scheme::semi_implicit, Detection::discrete, 1.9), 2000);
  EXPECT_NEAR(last.least, 0.38, 5e-3);
  EXPECT_NEAR(last.most, 2.61, 5e-3);  // z^2 - 1: the ball is a whole path deep, and one step throws it out
}

TEST(StiffBounce, the_bounds_hold_and_are_nearly_reached) {
  for (const double step : {0.1, 0.3, 0.77, 1.3, 1.7, 1.99}) {
    const Interval bounds = *bounce_bounds(step);
    const SpeedRange range = speeds(contact_by(Scheme::semi_implicit, Detection::discrete, step), 500);
    EXPECT_GE(range.least, bounds.lower - 1e-9) << step;
    EXPECT_LE(range.most, bounds.upper + 1e-9) << step;
  }
  const SpeedRange fine = speeds(contact_by(Scheme::semi_implicit, Detection::discrete, 0.1), 500);
  EXPECT_NEAR((1 - fine.least) / (1 - bounce_bounds(0.1)->lower), 1, 0.05);
}

/// Explicit steps gain about pi z / 2, implicit ones lose it, semi-implicit ones neither.
TEST(StiffBounce, errors_shrink_with_the_step_as_the_schemes_order_says) {
  const auto error = [](Scheme scheme, double step) {
    return bounce_all(usual, contact_by(scheme, Detection::discrete, step), 1, 50).mean_speed() - 1;
  };
  EXPECT_NEAR(error(Scheme::explicit_euler, 0.01), 0.01 * std::acos(-1) / 2, 3e-4);
  EXPECT_NEAR(error(Scheme::implicit_euler, 0.01), -0.01 * std::acos(-1) / 2, 3e-4);
  const auto rms = [](double step) {
    return bounce_all(usual, contact_by(Scheme::semi_implicit, Detection::discrete, step), 1, 200).rms_error();
  };
  EXPECT_LT(rms(0.02), 1e-4);
  EXPECT_NEAR(std::log2(rms(0.03) / rms(0.015)), 2, 1);
}

TEST(StiffBounce, goes_over_into_continuous_time) {
  for (const Scheme scheme : all_schemes) {
    for (const Detection detection : all_detections) {
      for (const double zeta : {0.1, 0.5, 1.5}) {
        const ContactTally t = bounce_all(usual, contact_by(scheme, detection, 0.003, zeta), 1, 10);
        EXPECT_EQ(t.returned, 10);
        EXPECT_NEAR(t.mean_speed(), restitution(zeta), 0.01) << name(scheme) << " " << name(detection) << " " << zeta;
        EXPECT_NEAR(t.deepest * 1e5 / 10, deepest(zeta), 0.02) << name(scheme) << " " << name(detection) << " " << zeta;
      }
    }
  }
}

/// The spring is relaxed at first touch, so it does not push there.
TEST(StiffBounce, splitting_an_undamped_explicit_or_semi_implicit_step_changes_nothing) {
  for (const Scheme scheme : {Scheme::explicit_euler, Scheme::semi_implicit}) {
    for (const double step : {0.1, 0.77, 1.9, 5.0}) {
      for (const double phase : {0.1, 0.5, 0.93}) {
        const Bounce whole = bounce(usual, contact_by(scheme, Detection::discrete, step), phase);
        const Bounce split = bounce(usual, contact_by(scheme, Detection::toi_split, step), phase);
        EXPECT_NEAR(split.speed / whole.speed, 1, 1e-9) << name(scheme) << " " << step;
        EXPECT_EQ(split.contact_steps, whole.contact_steps + 1);
      }
    }
  }
}

/// ... and what splitting is good for: less depends on the phase, and the ball goes less deep.
TEST(StiffBounce, splitting_a_damped_step_takes_away_most_of_the_phase) {
  for (const Scheme scheme : all_schemes) {
    const SpeedRange whole = speeds(contact_by(scheme, Detection::discrete, 0.1, 0.5), 100);
    const SpeedRange split = speeds(contact_by(scheme, Detection::toi_split, 0.1, 0.5), 100);
    EXPECT_LT(split.most - split.least, (whole.most - whole.least) / 10) << name(scheme);
  }
}

/// The failure is specified too: 100 paths from front to middle, and the ball is out on the other side.
TEST(StiffBounce, long_steps_tunnel_unless_the_rest_of_a_split_step_is_implicit) {
  const double step = 100 * reach(usual) / usual.speed * 1e5;
  for (const double phase : {0.1, 0.5, 0.93}) {
    for (const Scheme scheme : all_schemes) {
      EXPECT_EQ(bounce(usual, contact_by(scheme, Detection::discrete, step), phase).ending, Ending::escaped);
    }
    EXPECT_EQ(bounce(usual, contact_by(Scheme::semi_implicit, Detection::toi_split, step), phase).ending,
              Ending::escaped);
    EXPECT_EQ(bounce(usual, contact_by(Scheme::implicit_euler, Detection::toi_split, step), phase).ending,
              Ending::returned);
  }
}

TEST(StiffBounce, a_soft_wall_lets_the_ball_through_at_any_step) {
  for (const Scheme scheme : all_schemes) {
    EXPECT_EQ(bounce(usual, contact_by(scheme, Detection::toi_split, 0.05, 0, 100), 0.5).ending, Ending::escaped);
  }
}

TEST(StiffBounce, blow_up_is_reported_at_the_step_where_it_happens) {
  const Bounce fast = bounce(usual, contact_by(Scheme::semi_implicit, Detection::discrete, 100), 0.5);
  EXPECT_EQ(fast.blow_up_step, 2);  // the first step enters, the second throws it out
  EXPECT_GT(fast.speed, 1000);
  EXPECT_EQ(bounce(usual, contact_by(Scheme::semi_implicit, Detection::discrete, 1), 0.5).blow_up_step, 0);
}

/// Thrown back from the far side and the near side in turn, faster each time, until numbers end.
TEST(StiffBounce, never_gives_a_number_that_is_none) {
  for (const Scheme scheme : all_schemes) {
    for (const Detection detection : all_detections) {
      for (const double zeta : {0.0, 0.1, 0.5, 1.0, 100.0}) {
        for (const double step : {0.1, 1.0, 3.0, 30.0, 1e4, 1e6}) {
          for (const double stiffness : {1.0, 1e4, 1e10}) {
            const ContactTally t = bounce_all(usual, contact_by(scheme, detection, step, zeta, stiffness), 1, 3);
            EXPECT_EQ(t.bounces(), 3);
            EXPECT_TRUE(std::isfinite(t.fastest) && std::isfinite(t.speed_sum) && std::isfinite(t.deepest));
          }
        }
      }
    }
  }
}

/// At 2 zeta h omega = 1 the damper stops a ball that just touches: the second step finds nothing to do.
TEST(StiffBounce, a_ball_that_rests_at_the_wall_ends_the_run) {
  const Bounce b = bounce(usual, contact_by(Scheme::semi_implicit, Detection::discrete, 1, 0.5), 0);
  EXPECT_EQ(b.ending, Ending::unfinished);
  EXPECT_EQ(b.speed, 0);
  EXPECT_EQ(b.contact_steps, 2);
}

TEST(StiffBounce, walls_and_balls_may_be_thin) {
  for (const Approach thin : {Approach{1, 10, 0, 0.02, 10}, Approach{1, 10, 0.05, 0, 10}}) {
    EXPECT_EQ(bounce(thin, contact_by(Scheme::semi_implicit, Detection::discrete, 0.3), 0.5).ending, Ending::returned);
    EXPECT_EQ(bounce(thin, contact_by(Scheme::implicit_euler, Detection::toi_split, 1e4), 0.5).ending,
              Ending::returned);
  }
}

}  // namespace
}  // namespace thinwall
