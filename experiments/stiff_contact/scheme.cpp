#include <thinwall/experiments/stiff_contact/scheme.hpp>

#include <algorithm>
#include <cmath>

namespace thinwall {

namespace {

double force(const Spring& spring, Pull pull, const Motion& motion) {
  const double f = spring.stiffness * motion.depth + spring.damping * motion.speed;
  return pull == Pull::push_only ? std::max(0.0, f) : f;
}

/// (m + h c + h^2 k) v' = m v - h k x, from v' = v - h (k x' + c v') / m and x' = x + h v'.
Motion implicit_step(const Spring& spring, Pull pull, double step, const Motion& old) {
  const double inertia = spring.mass + step * spring.damping + step * step * spring.stiffness;
  const double speed = (spring.mass * old.speed - step * spring.stiffness * old.depth) / inertia;
  const Motion next = {old.depth + step * speed, speed};
  const bool pulls = spring.stiffness * next.depth + spring.damping * next.speed < 0;
  if (pull == Pull::push_only && pulls) return {old.depth + step * old.speed, old.speed};
  return next;
}

}  // namespace

std::string_view name(Scheme scheme) {
  switch (scheme) {
    case Scheme::explicit_euler: return "explicit_euler";
    case Scheme::semi_implicit: return "semi_implicit";
    case Scheme::implicit_euler: return "implicit_euler";
  }
  return "";
}

Spring spring_of(double mass, double stiffness, double ratio) {
  return {mass, stiffness, 2 * ratio * std::sqrt(stiffness) * std::sqrt(mass)};
}

double frequency(const Spring& spring) { return std::sqrt(spring.stiffness / spring.mass); }

Motion stepped(Scheme scheme, const Spring& spring, Pull pull, double step, const Motion& motion) {
  if (scheme == Scheme::implicit_euler) return implicit_step(spring, pull, step, motion);
  const double speed = motion.speed - step * force(spring, pull, motion) / spring.mass;
  const double mover = scheme == Scheme::explicit_euler ? motion.speed : speed;
  return {motion.depth + step * mover, speed};
}

}  // namespace thinwall
