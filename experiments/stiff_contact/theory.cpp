#include <thinwall/experiments/stiff_contact/theory.hpp>

#include <cmath>

namespace thinwall {

namespace {

/// acos(z) / sqrt(1 - z^2), which is acosh(z) / sqrt(z^2 - 1) beyond 1, and 1 at 1.
double arc_over_sine(double z) {
  const double sine = std::sqrt(std::abs((1 - z) * (1 + z)));
  if (sine == 0) return 1;
  return (z < 1 ? std::atan2(sine, z) : std::asinh(sine)) / sine;
}

}  // namespace

std::optional<double> step_limit(Scheme scheme, double damping_ratio) {
  const double z = damping_ratio;
  switch (scheme) {
    case Scheme::explicit_euler: return z < 1 ? 2 * z : 2 / (z + std::sqrt((z - 1) * (z + 1)));
    case Scheme::semi_implicit: return 2 / (std::hypot(1.0, z) + z);
    case Scheme::implicit_euler: break;
  }
  return std::nullopt;
}

double restitution(double damping_ratio) { return std::exp(-2 * damping_ratio * arc_over_sine(damping_ratio)); }

double deepest(double damping_ratio) { return std::exp(-damping_ratio * arc_over_sine(damping_ratio)); }

std::optional<Interval> bounce_bounds(double step) {
  if (!(step < 2)) return std::nullopt;
  const double least = std::sqrt(1 - step * step / 4);
  return Interval{least, 1 / least};
}

}  // namespace thinwall
