#pragma once
/// Ways to take a step of the bouncing ball: how it flies, how an impact is found, and what is done about it.
/// `drift` is the mean change of the flight's energy a bounce at restitution 1 and random phase, to first order, in units
/// of g h / V of the energy. Derived in docs/bouncing.md.

#include <string_view>

#include <thinwall/experiments/bouncing/arc.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

/// Semi-implicit Euler: first the speed, then the height with the new speed.
inline void kick_and_drift(const BouncingWorld& world, BouncingBall& ball) {
  ball.velocity -= world.gravity * world.step;
  ball.body.center.y() += ball.velocity * world.step;
  ball.time += world.step;
}

/// The game loop's way: move, test the pose, push the ball out and turn its speed.
struct ProjectAndFlip {
  static constexpr std::string_view name = "project_flip";
  static constexpr bool staggered = true;
  static constexpr int drift = -1;
  static void step(const BouncingWorld& world, BouncingBall& ball) {
    kick_and_drift(world, ball);
    const auto touch = contact(ball.body, world.floor);
    if (!touch) return;
    ball.body.center -= touch->normal * touch->penetration;
    bounce(world, ball);
  }
};

/// The same without pushing out.
struct FlipOnly {
  static constexpr std::string_view name = "flip_only";
  static constexpr bool staggered = true;
  static constexpr int drift = -2;
  static void step(const BouncingWorld& world, BouncingBall& ball) {
    kick_and_drift(world, ball);
    if (overlaps(ball.body, world.floor)) bounce(world, ball);
  }
};

/// Semi-implicit Euler, whose straight path in a step is split where the library finds first contact. A ball that touches
/// at the start of a step is carried by the floor: gravity does not push it in.
struct LinearToi {
  static constexpr std::string_view name = "linear_toi";
  static constexpr bool staggered = true;
  static constexpr int drift = 0;
  static void step(const BouncingWorld& world, BouncingBall& ball) {
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
};

/// The exact arc, and the pose at the end of the step pushed out.
struct ExactAndProject {
  static constexpr std::string_view name = "exact_project";
  static constexpr bool staggered = false;
  static constexpr int drift = 1;
  static void step(const BouncingWorld& world, BouncingBall& ball) {
    const double kick = world.gravity * world.step;
    ball.body.center.y() += (ball.velocity - kick / 2) * world.step;
    ball.velocity -= kick;
    ball.time += world.step;
    const auto touch = contact(ball.body, world.floor);
    if (!touch) return;
    ball.body.center -= touch->normal * touch->penetration;
    bounce(world, ball);
  }
};

/// The exact arc, split where it meets the floor: tested at the end of the step, which is enough since an arc is concave and
/// the floor deeper than a step, and solved if it ends inside.
struct ParabolaToi {
  static constexpr std::string_view name = "parabola_toi";
  static constexpr bool staggered = false;
  static constexpr int drift = 0;
  static void step(const BouncingWorld& world, BouncingBall& ball) {
    const double kick = world.gravity * world.step;
    Sphere<double> end = ball.body;
    end.center.y() += (ball.velocity - kick / 2) * world.step;
    if (overlaps(end, world.floor)) return follow_arc(world, ball, [](double) {});
    ball.body = end;
    ball.velocity -= kick;
    ball.time += world.step;
  }
};

/// Calls f(Policy) for each, in the order of the tables.
template <class F> void for_each_bounce_policy(const F& f) {
  f(ProjectAndFlip{});
  f(FlipOnly{});
  f(LinearToi{});
  f(ExactAndProject{});
  f(ParabolaToi{});
}

}  // namespace thinwall
