/// The formulas of the penalty contact, against eigenvalues and against continuous time, without any of the schemes.
#include <thinwall/experiments/stiff_contact/theory.hpp>

#include <cmath>
#include <complex>
#include <vector>

#include <gtest/gtest.h>

namespace thinwall {
namespace {

/// The larger root of x^2 - trace x + determinant, for the one-step matrices that docs/stiff_contact.md writes down.
double spectral_radius(Scheme scheme, double zeta, double step) {
  const double damp = 2 * zeta * step, square = step * step;
  double trace = 2 - damp, determinant = 1 - damp + square;  // explicit
  if (scheme == Scheme::semi_implicit) {
    trace = 2 - square - damp;
    determinant = 1 - damp;
  } else if (scheme == Scheme::implicit_euler) {
    determinant = 1 / (1 + damp + square);
    trace = (2 + damp) * determinant;
  }
  const std::complex<double> root = std::sqrt(std::complex<double>(trace * trace / 4 - determinant));
  return std::max(std::abs(trace / 2 + root), std::abs(trace / 2 - root));
}

const std::vector<double> ratios = {0, 0.01, 0.1, 0.5, 0.9, 1, 1.1, 2, 10, 100};

TEST(StiffTheory, an_eigenvalue_leaves_the_unit_circle_at_the_limit) {
  for (const Scheme scheme : {Scheme::explicit_euler, Scheme::semi_implicit}) {
    for (const double zeta : ratios) {
      const double limit = *step_limit(scheme, zeta);
      if (limit > 0) {
        EXPECT_LE(spectral_radius(scheme, zeta, 0.999 * limit), 1 + 1e-12) << name(scheme) << " " << zeta;
      }
      EXPECT_GT(spectral_radius(scheme, zeta, 1.001 * limit + 1e-3), 1 + 1e-7) << name(scheme) << " " << zeta;
    }
  }
}

TEST(StiffTheory, implicit_euler_has_no_limit) {
  for (const double zeta : ratios) {
    EXPECT_FALSE(step_limit(Scheme::implicit_euler, zeta));
    for (const double step : {1e-3, 1.0, 1e3, 1e6}) {
      EXPECT_LT(spectral_radius(Scheme::implicit_euler, zeta, step), 1) << zeta << " " << step;
    }
  }
}

TEST(StiffTheory, limits_have_the_values_of_the_formula) {
  EXPECT_EQ(step_limit(Scheme::explicit_euler, 0), 0);
  EXPECT_EQ(step_limit(Scheme::explicit_euler, 0.25), 0.5);
  EXPECT_EQ(step_limit(Scheme::explicit_euler, 1), 2);
  EXPECT_NEAR(*step_limit(Scheme::explicit_euler, 1.25), 1, 1e-15);  // 2 (1.25 - 0.75)
  EXPECT_EQ(step_limit(Scheme::semi_implicit, 0), 2);
  EXPECT_NEAR(*step_limit(Scheme::semi_implicit, 0.75), 1, 1e-15);               // 2 (1.25 - 0.75)
  for (const Scheme scheme : {Scheme::explicit_euler, Scheme::semi_implicit}) {  // no digit is lost far out
    EXPECT_NEAR(*step_limit(scheme, 1e8) * 1e8, 1, 1e-15);
  }
}

/// The oscillation with classical Runge-Kutta until the wall would pull: what a bounce is in continuous time.
struct Slow {
  double speed, depth;
};
Slow slow_bounce(double zeta) {
  const auto acceleration = [&](double x, double v) { return -x - 2 * zeta * v; };
  const double h = 1e-4;
  double x = 0, v = 1;
  Slow result = {0, 0};
  while (x + 2 * zeta * v >= 0) {
    const double v1 = v, a1 = acceleration(x, v);
    const double v2 = v + h / 2 * a1, a2 = acceleration(x + h / 2 * v1, v2);
    const double v3 = v + h / 2 * a2, a3 = acceleration(x + h / 2 * v2, v3);
    const double v4 = v + h * a3, a4 = acceleration(x + h * v3, v4);
    x += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    result.depth = std::max(result.depth, x);
  }
  result.speed = -v;
  return result;
}

TEST(StiffTheory, restitution_and_depth_are_those_of_continuous_time) {
  for (const double zeta : {0.0, 0.1, 0.5, 0.99, 1.0, 1.01, 3.0}) {
    const Slow slow = slow_bounce(zeta);
    EXPECT_NEAR(restitution(zeta), slow.speed, 1e-7) << zeta;
    EXPECT_NEAR(deepest(zeta), slow.depth, 1e-7) << zeta;
  }
  EXPECT_EQ(restitution(0), 1);
  EXPECT_NEAR(restitution(1), std::exp(-2), 1e-15);
  EXPECT_NEAR(restitution(1 + 1e-9), restitution(1 - 1e-9), 1e-8);
  EXPECT_NEAR(restitution(1e4) * 4e8, 1, 1e-6);  // 1 / (2 zeta)^2
}

TEST(StiffTheory, bounds_end_where_stability_does) {
  EXPECT_FALSE(bounce_bounds(2));
  EXPECT_FALSE(bounce_bounds(1e6));
  EXPECT_NEAR(bounce_bounds(1.2)->lower, 0.8, 1e-15);
  EXPECT_NEAR(bounce_bounds(1.2)->upper, 1.25, 1e-15);
}

}  // namespace
}  // namespace thinwall
