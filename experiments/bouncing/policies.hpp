#pragma once
/// A ball above a floor, under gravity, in one step size, and the ways to take a step: how it flies, how an impact is found, and what
/// is done about it. Only heights and vertical speeds differ from zero. Derived in docs/bouncing.md.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

struct BouncingWorld {
  double gravity;      ///< [m/s^2] > 0, downward
  double restitution;  ///< [1] in [0, 1]: speed after over speed before
  double step;         ///< [s] > 0
  Aabb<double> floor;  ///< its top is at height 0
};

struct BouncingBall {
  Sphere<double> body;
  double velocity;           ///< [m/s] upward, as the integrator keeps it
  double time = 0;           ///< [s] since the start
  std::int64_t bounces = 0;  ///< impacts so far
};

/// A floor so deep that nothing gets through: its top is exactly at 0.
inline Aabb<double> floor_of_depth(double depth) { return {{0, -depth / 2, 0}, {depth / 2, depth / 2, depth / 2}}; }

inline BouncingBall ball_at(double gap, double velocity, double radius) {
  return {{{0, radius + gap, 0}, radius}, velocity};
}

/// [m] Between ball and floor; negative inside.
inline double gap_of(const BouncingBall& ball) { return ball.body.center.y() - ball.body.radius; }

/// An approaching ball leaves with its speed times the restitution.
inline void bounce(const BouncingWorld& world, BouncingBall& ball) {
  if (!(ball.velocity < 0)) return;
  ball.velocity = world.restitution * -ball.velocity;
  ++ball.bounces;
}

/// [s] When gap + v t - g t^2 / 2 = 0, for gap >= 0 and g > 0: the root that is not negative. Neither branch subtracts, so
/// that no digit is lost, whether the ball rises or falls. Zero gap and zero speed: 0.
inline double landing_time(double gap, double velocity, double gravity) {
  const double speed = std::sqrt(velocity * velocity + 2 * gravity * gap);  // at landing
  if (velocity > 0) return (velocity + speed) / gravity;
  return speed > 0 ? 2 * gap / (speed - velocity) : 0;
}

/// Follows the arc through one step, and calls at_bounce(time) at each impact. Bounces pile up towards a limit where the
/// restitution is below 1; the ball is at rest from the one on whose flight is too short to move the clock. No tolerance.
/// Degenerate: at rest on the floor it stays, to the bit.
template <class AtBounce> void follow_arc(const BouncingWorld& world, BouncingBall& ball, const AtBounce& at_bounce) {
  const double g = world.gravity, start = ball.time;
  double gap = std::max(0.0, gap_of(ball)), left = world.step;
  while (left > 0) {
    const double end = gap + left * (ball.velocity - g * left / 2);
    if (end > 0) {  // the arc is concave: above the floor at both ends, it is so between
      gap = end;
      ball.velocity -= g * left;
      break;
    }
    const double speed = std::sqrt(ball.velocity * ball.velocity + 2 * g * gap);
    left = std::max(0.0, left - landing_time(gap, ball.velocity, g));
    gap = 0;
    ball.velocity = -speed;
    bounce(world, ball);
    const double clock = start + (world.step - left), flight = 2 * ball.velocity / g;
    if (speed > 0) at_bounce(clock);
    if (!(clock + flight > clock)) {
      ball.velocity = 0;
      break;
    }
  }
  ball.body.center.y() = ball.body.radius + gap;
  ball.time += world.step;
}

// The policies: the ways to take a step.

/// Semi-implicit Euler: first the speed, then the height with the new speed.
inline void kick_and_drift(const BouncingWorld& world, BouncingBall& ball) {
  ball.velocity -= world.gravity * world.step;
  ball.body.center.y() += ball.velocity * world.step;
  ball.time += world.step;
}

/// The exact arc, as if there were no floor.
inline void fly_on(const BouncingWorld& world, BouncingBall& ball) {
  const double kick = world.gravity * world.step;
  ball.body.center.y() += (ball.velocity - kick / 2) * world.step;
  ball.velocity -= kick;
  ball.time += world.step;
}

/// Tests the pose, pushes the ball out and turns its speed.
inline void push_out(const BouncingWorld& world, BouncingBall& ball) {
  const auto touch = contact(ball.body, world.floor);
  if (!touch) return;
  ball.body.center -= touch->normal * touch->penetration;
  bounce(world, ball);
}

/// The game loop's way.
inline void project_flip(const BouncingWorld& world, BouncingBall& ball) {
  kick_and_drift(world, ball);
  push_out(world, ball);
}

/// The same without pushing out.
inline void flip_only(const BouncingWorld& world, BouncingBall& ball) {
  kick_and_drift(world, ball);
  if (overlaps(ball.body, world.floor)) bounce(world, ball);
}

/// Semi-implicit Euler, whose straight path in a step is split where the library finds first contact. A ball that touches
/// at the start of a step is carried by the floor: gravity does not push it in.
inline void linear_toi(const BouncingWorld& world, BouncingBall& ball) {
  const double before = ball.velocity, kick = world.gravity * world.step;
  double left = world.step;
  ball.velocity = before - kick;
  const Vec3<double> path = {0, ball.velocity * left, 0};
  const Toi<double> toi = time_of_impact(Moving<Sphere<double>>{ball.body, path}, at_rest(world.floor));
  if (toi.status == ToiStatus::overlapping) {
    ball.velocity = before < 0 ? before : std::max(0.0, ball.velocity);
    bounce(world, ball);
  } else if (toi.status == ToiStatus::hit) {
    ball.body.center += path * toi.time;
    left *= 1 - toi.time;
    bounce(world, ball);
  }
  ball.body.center.y() += ball.velocity * left;
  ball.time += world.step;
}

/// The exact arc, and the pose at the end of the step pushed out.
inline void exact_project(const BouncingWorld& world, BouncingBall& ball) {
  fly_on(world, ball);
  push_out(world, ball);
}

/// The exact arc, split where it meets the floor: tested at the end of the step, which is enough since an arc is concave and
/// the floor deeper than a step, and solved if it ends inside.
inline void parabola_toi(const BouncingWorld& world, BouncingBall& ball) {
  BouncingBall end = ball;
  fly_on(world, end);
  if (overlaps(end.body, world.floor)) return follow_arc(world, ball, [](double) {});
  ball = end;
}

struct BouncePolicy {
  using Step = void (*)(const BouncingWorld&, BouncingBall&);
  std::string_view name;
  bool staggered;  ///< its speeds are half a step early
  int drift;       ///< [g h / V] mean change of the flight's energy at restitution 1 and random phase, to first order
  Step step;
  Step to_the_apex;  ///< steps up to the apex after the next impact: what is timed, so nothing stands between its steps

  bool operator==(const BouncePolicy&) const = default;
};

template <BouncePolicy::Step step>
constexpr BouncePolicy bounce_policy(std::string_view name, bool staggered, int drift) {
  return {name, staggered, drift, step, [](const BouncingWorld& world, BouncingBall& ball) {
            for (const std::int64_t before = ball.bounces; ball.bounces == before;) step(world, ball);
            while (ball.velocity > world.gravity * world.step) step(world, ball);
          }};
}

/// In the order of the tables.
inline constexpr std::array all_bounce_policies = {
    bounce_policy<project_flip>("project_flip", true, -1), bounce_policy<flip_only>("flip_only", true, -2),
    bounce_policy<linear_toi>("linear_toi", true, 0), bounce_policy<exact_project>("exact_project", false, 1),
    bounce_policy<parabola_toi>("parabola_toi", false, 0)};

/// [J/kg] Energy of the flight: gravity times the height that the ball will rise to. Semi-implicit Euler's positions lie on an exact
/// parabola, and its velocities are that parabola's half a step earlier. Derived in docs/bouncing.md.
inline double flight_energy(const BouncePolicy& policy, const BouncingWorld& world, const BouncingBall& ball) {
  const double v = policy.staggered ? ball.velocity - world.gravity * world.step / 2 : ball.velocity;
  return v * v / 2 + world.gravity * gap_of(ball);
}

}  // namespace thinwall
