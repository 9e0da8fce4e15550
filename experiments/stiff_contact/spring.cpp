#include <thinwall/experiments/stiff_contact/spring.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

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

namespace {

constexpr int bound = 32;                                      // [log2] what counts as growth, and as decay
constexpr int damped_doublings = 50, undamped_doublings = 36;  // of the number of steps
constexpr int damped_exponent = -20, undamped_exponent = -14;  // of the least step that is tried
constexpr int last_exponent = 20, halvings = 16;               // of the greatest; of its exponent, by bisection

/// m * 2^exponent, the largest entry of m in [1, 2), or all of them 0.
struct Power {
  Eigen::Matrix2d m;
  int exponent;
};

Power normalized(const Eigen::Matrix2d& m, int exponent) {
  const double largest = m.cwiseAbs().maxCoeff();
  if (largest == 0) return {m, -2 * bound};
  const int shift = std::ilogb(largest);
  return {m.unaryExpr([&](double x) { return std::ldexp(x, -shift); }), exponent + shift};
}

Power product(const Power& a, const Power& b) { return normalized(a.m * b.m, a.exponent + b.exponent); }

/// Two unit states, stepped once, are its columns: in units of energy, sqrt(k) depth and sqrt(m) speed.
Power one_step(Scheme scheme, const Spring& spring, double step) {
  const double depth_unit = 1 / std::sqrt(spring.stiffness), speed_unit = 1 / std::sqrt(spring.mass);
  const Motion a = stepped(scheme, spring, Pull::both_ways, step, {depth_unit, 0});
  const Motion b = stepped(scheme, spring, Pull::both_ways, step, {0, speed_unit});
  Eigen::Matrix2d m;
  m << a.depth / depth_unit, b.depth / depth_unit, a.speed / speed_unit, b.speed / speed_unit;
  return normalized(m, 0);
}

bool grows(const Power& p) { return p.exponent >= bound; }
bool decays(const Power& p) { return p.exponent < -bound; }

/// The powers 1, 2, 4, ... of a step, until it is clear what becomes of it.
std::vector<Power> powers(Scheme scheme, const Spring& spring, double step) {
  const int doublings = spring.damping > 0 ? damped_doublings : undamped_doublings;
  std::vector<Power> list = {one_step(scheme, spring, step)};
  while (!grows(list.back()) && !decays(list.back()) && static_cast<int>(list.size()) <= doublings) {
    list.push_back(product(list.back(), list.back()));
  }
  return list;
}

}  // namespace

Fate fate(Scheme scheme, const Spring& spring, double step) {
  const Power last = powers(scheme, spring, step).back();
  return grows(last) ? Fate::grows : decays(last) ? Fate::decays : Fate::holds;
}

std::int64_t blow_up_step(Scheme scheme, const Spring& spring, double step) {
  const std::vector<Power> list = powers(scheme, spring, step);
  if (!grows(list.back())) return 0;
  Power state = {Eigen::Matrix2d::Identity(), 0};
  std::int64_t steps = 0;
  for (std::size_t i = list.size(); i-- > 0;) {
    const Power further = product(list[i], state);
    if (grows(further)) continue;
    state = further;
    steps += std::int64_t{1} << i;
  }
  return steps + 1;
}

LimitBracket measured_limit(Scheme scheme, double mass, double stiffness, double damping_ratio) {
  const Spring spring = spring_of(mass, stiffness, damping_ratio);
  const double omega = frequency(spring);
  const auto fate_at = [&](double exponent) { return fate(scheme, spring, std::exp2(exponent) / omega); };
  const bool damped = spring.damping > 0;
  const int first = damped ? damped_exponent : undamped_exponent;
  int power = first;
  while (power <= last_exponent && fate_at(power) != Fate::grows) ++power;
  if (power == first) return {0, std::exp2(power)};
  if (power > last_exponent) return {std::exp2(last_exponent), std::numeric_limits<double>::infinity()};
  double below = power - 1, above = power;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (below + above) / 2;
    (fate_at(middle) == Fate::grows ? above : below) = middle;
  }
  // Next to the limit nothing is decided in 2^50 steps: back off until it decays.
  double back = above - below;
  const auto is_stable = [&](Fate f) { return f == Fate::decays || (!damped && f == Fate::holds); };
  while (above - back > first && !is_stable(fate_at(above - back))) back *= 2;
  return {above - back > first ? std::exp2(above - back) : 0, std::exp2(above)};
}

}  // namespace thinwall
