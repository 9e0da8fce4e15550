#pragma once
/// A ball above a floor, under gravity, in one step size. Only heights and vertical speeds differ from zero.

#include <cstdint>

#include <thinwall/discrete/aabb.hpp>

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

/// Semi-implicit Euler's positions lie on an exact parabola, and its velocities are that parabola's half a step earlier. This
/// is the parabola's own velocity, now. Derived in docs/bouncing.md.
template <class Policy> double flight_velocity(const BouncingWorld& world, const BouncingBall& ball) {
  return Policy::staggered ? ball.velocity - world.gravity * world.step / 2 : ball.velocity;
}

/// [J/kg] Energy of the flight: gravity times the height that the ball will rise to.
template <class Policy> double flight_energy(const BouncingWorld& world, const BouncingBall& ball) {
  const double v = flight_velocity<Policy>(world, ball);
  return v * v / 2 + world.gravity * gap_of(ball);
}

}  // namespace thinwall
