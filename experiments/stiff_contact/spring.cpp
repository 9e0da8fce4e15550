#include <thinwall/experiments/stiff_contact/model.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace thinwall {

Motion stepped(Scheme scheme, const Spring& spring, double step, const Motion& old) {
  const auto& [mass, stiffness, damping] = spring;
  if (scheme == Scheme::implicit_euler) {
    // (m + h c + h^2 k) v' = m v - h k x, from v' = v - h (k x' + c v') / m and x' = x + h v'.
    const double inertia = mass + step * damping + step * step * stiffness;
    const double speed = (mass * old.speed - step * stiffness * old.depth) / inertia;
    return {old.depth + step * speed, speed};
  }
  const double speed = old.speed - step * (stiffness * old.depth + damping * old.speed) / mass;
  return {old.depth + step * (scheme == Scheme::explicit_euler ? old.speed : speed), speed};
}

Motion pushed(Scheme scheme, const Spring& spring, double step, const Motion& old) {
  const Motion next = stepped(scheme, spring, step, old);
  const bool is_implicit = scheme == Scheme::implicit_euler;
  const auto& [depth, speed] = is_implicit ? next : old;
  const double force = spring.stiffness * depth + spring.damping * speed;
  const bool pushes = is_implicit ? !(force < 0) : force >= 0;  // what is no number stays none
  return pushes ? next : Motion{old.depth + step * old.speed, old.speed};
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
  const Motion a = stepped(scheme, spring, step, {depth_unit, 0});
  const Motion b = stepped(scheme, spring, step, {0, speed_unit});
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
  while (!grows(list.back()) && !decays(list.back()) && static_cast<int>(list.size()) <= doublings)
    list.push_back(product(list.back(), list.back()));
  return list;
}

/// acos(z) / sqrt(1 - z^2), which is acosh(z) / sqrt(z^2 - 1) beyond 1, and 1 at 1.
double arc_over_sine(double z) {
  const double sine = std::sqrt(std::abs((1 - z) * (1 + z)));
  if (sine == 0) return 1;
  return (z < 1 ? std::atan2(sine, z) : std::asinh(sine)) / sine;
}

}  // namespace

Fate fate(Scheme scheme, const Spring& spring, double step) {
  const Power last = powers(scheme, spring, step).back();
  return grows(last) ? Fate::grows : decays(last) ? Fate::decays : Fate::holds;
}

std::optional<std::int64_t> blow_up_step(Scheme scheme, const Spring& spring, double step) {
  const std::vector<Power> list = powers(scheme, spring, step);
  if (!grows(list.back())) return std::nullopt;
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

Interval measured_limit(Scheme scheme, const Spring& spring) {
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

// What mathematics says.

std::optional<double> step_limit(Scheme scheme, double damping_ratio) {
  const double z = damping_ratio;
  if (scheme == Scheme::implicit_euler) return std::nullopt;
  if (scheme == Scheme::semi_implicit) return 2 / (std::hypot(1.0, z) + z);
  return z < 1 ? 2 * z : 2 / (z + std::sqrt((z - 1) * (z + 1)));
}

double restitution(double damping_ratio) { return std::exp(-2 * damping_ratio * arc_over_sine(damping_ratio)); }

double deepest(double damping_ratio) { return std::exp(-damping_ratio * arc_over_sine(damping_ratio)); }

}  // namespace thinwall
