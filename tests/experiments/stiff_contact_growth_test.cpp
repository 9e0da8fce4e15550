/// Growth of a spring that holds both ways, measured: against stepping, and against the limits (case 53).
#include <thinwall/experiments/stiff_contact/growth.hpp>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <thinwall/experiments/stiff_contact/theory.hpp>

namespace thinwall {
namespace {

/// The largest of |sqrt(k) depth| and |sqrt(m) speed| after each step from one of the unit states; up to `last` steps.
std::int64_t stepped_until(Scheme scheme, const Spring& s, double step, double bound, std::int64_t last) {
  const double depth_unit = 1 / std::sqrt(s.stiffness), speed_unit = 1 / std::sqrt(s.mass);
  Motion a = {depth_unit, 0}, b = {0, speed_unit};
  for (std::int64_t n = 1; n <= last; ++n) {
    a = stepped(scheme, s, Pull::both_ways, step, a);
    b = stepped(scheme, s, Pull::both_ways, step, b);
    const double largest = std::max({std::abs(a.depth) / depth_unit, std::abs(b.depth) / depth_unit,
                                     std::abs(a.speed) / speed_unit, std::abs(b.speed) / speed_unit});
    if (!(largest < bound)) return n;
  }
  return 0;
}

TEST(StiffGrowth, case_53_the_limits_lie_in_their_brackets) {
  for (const Scheme scheme : all_schemes) {
    for (const double stiffness : {1.0, 1e5, 1e10}) {
      for (const double zeta : {0.0, 1e-5, 1e-3, 0.1, 0.5, 0.9, 1.0, 1.1, 3.0, 1e3, 1e5}) {
        const LimitBracket bracket = measured_limit(scheme, 2, stiffness, zeta);
        const auto limit = step_limit(scheme, zeta);
        if (!limit) {
          EXPECT_TRUE(std::isinf(bracket.unstable)) << zeta;
          continue;
        }
        EXPECT_LE(bracket.stable, *limit) << name(scheme) << " " << stiffness << " " << zeta;
        EXPECT_GE(bracket.unstable, *limit) << name(scheme) << " " << stiffness << " " << zeta;
        if (*limit > 0) {
          EXPECT_LT(bracket.unstable, 1.001 * bracket.stable) << name(scheme) << " " << zeta;
        }
      }
    }
  }
}

/// An undamped explicit step grows always: by half of step^2.
TEST(StiffGrowth, undamped_explicit_grows_at_the_least_step_that_is_tried) {
  const LimitBracket bracket = measured_limit(Scheme::explicit_euler, 1, 1e4, 0);
  EXPECT_EQ(bracket.stable, 0);
  EXPECT_EQ(bracket.unstable, 0x1p-14);
}

TEST(StiffGrowth, powers_are_what_stepping_gives) {
  for (const Scheme scheme : all_schemes) {
    for (const double zeta : {0.0, 0.1, 2.0}) {
      for (const double step : {0.05, 0.4, 1.9, 2.1, 30.0}) {
        const Spring spring = spring_of(3, 1e6, zeta);
        const double seconds = step / frequency(spring);
        const std::int64_t stepped = stepped_until(scheme, spring, seconds, 0x1p32, 20000);
        const std::int64_t found = blow_up_step(scheme, spring, seconds);
        EXPECT_EQ(found > 0, fate(scheme, spring, seconds) == Fate::grows);
        if (stepped == 0) {
          EXPECT_TRUE(found == 0 || found > 20000) << name(scheme) << " " << zeta << " " << step;
          continue;
        }
        EXPECT_GE(found, stepped) << name(scheme) << " " << zeta << " " << step;
        EXPECT_LE(static_cast<double>(found - stepped), 10 / std::min(step, 1.0)) << name(scheme) << " " << zeta;
      }
    }
  }
}

TEST(StiffGrowth, below_the_limit_a_state_decays) {
  const Spring spring = spring_of(1, 1e8, 0.1);
  EXPECT_EQ(fate(Scheme::semi_implicit, spring, 1.8 / frequency(spring)), Fate::decays);
  EXPECT_EQ(fate(Scheme::semi_implicit, spring, 1.82 / frequency(spring)), Fate::grows);
  const Spring undamped = spring_of(1, 1e8, 0);
  EXPECT_EQ(fate(Scheme::semi_implicit, undamped, 1.99 / frequency(undamped)), Fate::holds);
  EXPECT_EQ(fate(Scheme::semi_implicit, undamped, 2.01 / frequency(undamped)), Fate::grows);
}

/// At h omega = 1 and zeta = 1/2 two semi-implicit steps make nothing of anything.
TEST(StiffGrowth, a_step_whose_square_is_zero_decays) {
  EXPECT_EQ(fate(Scheme::semi_implicit, spring_of(1, 1, 0.5), 1), Fate::decays);
}

TEST(StiffGrowth, nothing_overflows) {
  for (const double stiffness : {1e-12, 1e18}) {
    for (const double mass : {1e-12, 1e12}) {
      const LimitBracket bracket = measured_limit(Scheme::semi_implicit, mass, stiffness, 0.5);
      EXPECT_NEAR(bracket.unstable, *step_limit(Scheme::semi_implicit, 0.5), 1e-4);
      const Spring spring = spring_of(mass, stiffness, 1e5);
      EXPECT_EQ(blow_up_step(Scheme::semi_implicit, spring, 1e6 / frequency(spring)), 1);
    }
  }
}

}  // namespace
}  // namespace thinwall
