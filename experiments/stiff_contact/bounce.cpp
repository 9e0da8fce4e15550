#include <thinwall/experiments/stiff_contact/bounce.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

namespace {

struct Ball {
  Sphere<double> shape;
  Vec3<double> velocity;  ///< [m/s]
};

/// One slab, wide enough that the nearest face is always the front or the back.
Aabb<double> wall_of(const Approach& e) {
  const double side = e.thickness + e.radius;
  return {{0, 0, 0}, {e.thickness / 2, side, side}};
}

/// In continuous time a bounce takes at most (pi + 4 zeta) / omega; this is sixteen times as long, and more.
std::int64_t most_steps(const PenaltyContact& c) {
  return 1024 + static_cast<std::int64_t>(64 * (1 + c.damping_ratio) / c.step);
}

struct Stepper {
  Scheme scheme;
  Spring spring;
  Aabb<double> wall;

  /// A step [s] against the wall, which lies along `normal` and is `depth` deep.
  void push(Ball& ball, const Vec3<double>& normal, double depth, double step) const {
    const Motion old = {depth, ball.velocity.dot(normal)};
    const Motion next = stepped(scheme, spring, Pull::push_only, step, old);
    ball.shape.center += normal * (next.depth - old.depth);
    ball.velocity += normal * (next.speed - old.speed);
  }

  /// A step that starts apart from the wall. Returns true if the wall was asked for a force.
  bool fly(Ball& ball, double step, Detection detection) const {
    const Vec3<double> path = ball.velocity * step;
    if (detection == Detection::toi_split) {
      const Toi<double> toi = time_of_impact(Moving{ball.shape, path}, at_rest(wall));
      if (toi.status == ToiStatus::hit) {
        ball.shape.center += path * toi.time;
        push(ball, toi.normal, 0, step * (1 - toi.time));
        return true;
      }
    }
    ball.shape.center += path;
    return false;
  }
};

}  // namespace

std::string_view name(Detection detection) { return detection == Detection::discrete ? "discrete" : "toi_split"; }

double reach(const Approach& e) { return e.radius + e.thickness / 2; }
Spring spring_of(const Approach& e, const PenaltyContact& c) { return spring_of(e.mass, c.stiffness, c.damping_ratio); }
double seconds(const Approach& e, const PenaltyContact& c) { return c.step / frequency(spring_of(e, c)); }

Bounce bounce(const Approach& e, const PenaltyContact& c, double phase) {
  const double step = seconds(e, c), contact_distance = reach(e);
  const Stepper stepper = {c.scheme, spring_of(e, c), wall_of(e)};
  Ball ball = {{{-contact_distance - phase * e.speed * step, 0, 0}, e.radius}, {e.speed, 0, 0}};
  Bounce result = {Ending::unfinished, 0, 0, 0, 0};
  const std::int64_t budget = most_steps(c);
  for (std::int64_t count = 1; count <= budget; ++count) {
    const Ball before = ball;
    const std::optional<Contact<double>> touch = contact(ball.shape, stepper.wall);
    const double x = ball.shape.center[0], v = ball.velocity[0];
    if (!touch && x * v > 0) {
      result.ending = x < 0 ? Ending::returned : Ending::escaped;
      result.speed = std::abs(v) / e.speed;
      return result;
    }
    if (touch) {
      stepper.push(ball, touch->normal, touch->penetration, step);
      ++result.contact_steps;
    } else if (stepper.fly(ball, step, c.detection)) {
      ++result.contact_steps;
    }
    const double speed = std::abs(ball.velocity[0]), now = ball.shape.center[0];
    if (result.blow_up_step == 0 && !(speed <= e.blow_up * e.speed)) result.blow_up_step = count;
    if (!std::isfinite(speed) || !std::isfinite(now)) return result;
    result.deepest = std::max(result.deepest, now + contact_distance);
    const bool rests = ball.velocity == before.velocity && ball.shape.center == before.shape.center;
    if (rests) return result;
  }
  return result;
}

}  // namespace thinwall
