#include <thinwall/experiments/bouncing/theory.hpp>

#include <cmath>
#include <stdexcept>
#include <string>

#include <boost/math/quadrature/gauss.hpp>

#include <thinwall/experiments/bouncing/policies.hpp>

namespace thinwall {

namespace {

BounceTheory operator+(const BounceTheory& a, const BounceTheory& b) { return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2}; }
BounceTheory operator*(double factor, const BounceTheory& t) { return {factor * t.c0, factor * t.c1, factor * t.c2}; }

/// Speed after: e (V + g h u / 2), which the flight has half a step later than Euler says, so it has lost g h / 2.
BounceTheory late_speed(double delta, double e) { return {delta / 4 - e, e * e - e * delta / 2, e * e * delta / 4}; }

/// What the depth at the end of the step is worth: V s + g s^2 / 2 with s = (1 + u) h / 2.
BounceTheory depth(double delta) { return {1 + delta / 4, 1 + delta / 2, delta / 4}; }

}  // namespace

// Moments of u, uniform on [-1, 1]: 0, 1/3, 0, 1/5.
double BounceTheory::mean() const { return c0 + c2 / 3; }
double BounceTheory::sigma() const { return std::sqrt(c1 * c1 / 3 + 4 * c2 * c2 / 45); }
double BounceTheory::rms() const { return std::hypot(mean(), sigma()); }
double BounceTheory::kurtosis() const {
  const auto fourth = [&](double u) { return std::pow(at(u) - mean(), 4); };
  const double moment =
      boost::math::quadrature::gauss<double, 7>::integrate(fourth, -1.0, 1.0) / 2;  // exact to degree 13
  return moment / std::pow(sigma(), 4);
}

BounceTheory bounce_theory(std::string_view policy, double delta, double restitution) {
  const double e = restitution;
  if (policy == ProjectAndFlip::name) return late_speed(delta, e);
  if (policy == FlipOnly::name) return late_speed(delta, e) + -1.0 * depth(delta);
  if (policy == LinearToi::name) return late_speed(delta, e) + e * depth(delta);
  if (policy == ExactAndProject::name) return e * e * depth(delta);
  if (policy == ParabolaToi::name) return {};
  throw std::logic_error("no theory for the policy '" + std::string(policy) + "'");
}

}  // namespace thinwall
