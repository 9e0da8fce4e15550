#pragma once
/// The exact arc of a thrown ball, through as many bounces as a step holds.

#include <algorithm>
#include <cmath>

#include <thinwall/experiments/bouncing/world.hpp>

namespace thinwall {

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

}  // namespace thinwall
