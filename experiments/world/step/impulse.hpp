#pragma once
/// What two bodies in contact do to each other: an impulse along the normal, with restitution, and no friction. Bodies do
/// not turn.

#include <algorithm>

#include <thinwall/experiments/world/body.hpp>

namespace thinwall {

/// A body's part of what parts it from another: with masses m_a and m_b, m_b / (m_a + m_b) for A. Neither overflows.
/// At least one of the two must be moved by impulses.
inline double share_of(const Body& a, const Body& b) {
  if (inverse_mass(a) == 0) return 0;
  return inverse_mass(b) == 0 ? 1 : 1 / (1 + a.mass / b.mass);
}
inline bool is_moved_by_impulses(const Body& body) { return inverse_mass(body) > 0; }

/// How a body moves within a step: where it is at `anchor`, relative to its place at the start, and at what velocity.
struct BodyMotion {
  Vec3<double> offset = Vec3<double>::Zero();    ///< [m] at `anchor`
  Vec3<double> velocity = Vec3<double>::Zero();  ///< [m/s]
  double anchor = 0;                             ///< [1] part of the step
  double speed = 0;           ///< [m/s] the largest |v_x| + |v_y| + |v_z| so far: what rounding is of
  std::uint32_t version = 0;  ///< changes with the motion
  std::uint32_t arrived = 0;  ///< the version that came to `anchor`: those after it turned there
  int events = 0;             ///< hits so far
  bool waiting = false;       ///< does not move any more in this step
};

/// [m/s] In effect: zero while it waits.
inline Vec3<double> moving_at(const BodyMotion& motion) {
  return motion.waiting ? Vec3<double>(Vec3<double>::Zero()) : motion.velocity;
}

/// [m/s] What rounding alone may make of a closing speed of zero, once an impulse has made it zero: 16 epsilon of the
/// speeds there were. Source: derived in docs/world.md.
inline double closing_noise(const BodyMotion& a, const BodyMotion& b) {
  return 16 * std::numeric_limits<double>::epsilon() * (a.speed + b.speed);
}

/// [m/s] > 0 if A and B approach along the normal, from A to B.
inline double closing_speed(const Vec3<double>& normal, const Vec3<double>& a, const Vec3<double>& b) {
  return normal.dot(Vec3<double>(a - b));
}

/// Lets the two bounce if they approach by more than rounding. True if it did.
inline bool bounce(const Body& body_a, const Body& body_b, BodyMotion& a, BodyMotion& b, const Vec3<double>& normal) {
  if (!is_moved_by_impulses(body_a) && !is_moved_by_impulses(body_b)) return false;
  const double closing = closing_speed(normal, a.velocity, b.velocity);
  if (!(closing > closing_noise(a, b))) return false;
  const double change = (1 + std::max(body_a.restitution, body_b.restitution)) * closing;
  const auto push = [&](const Body& body, const Body& other, BodyMotion& motion, double way) {
    if (!is_moved_by_impulses(body)) return;
    motion.velocity += normal * (way * change * share_of(body, other));
    motion.speed = std::max(motion.speed, motion.velocity.cwiseAbs().sum());
    ++motion.version;
  };
  push(body_a, body_b, a, -1);
  push(body_b, body_a, b, 1);
  return true;
}

/// Undoes `part` [1] of a penetration [m], the lighter body moving more.
inline void part_bodies(const Body& body_a, const Body& body_b, BodyMotion& a, BodyMotion& b,
                        const Vec3<double>& normal, double penetration, double part) {
  if (!is_moved_by_impulses(body_a) && !is_moved_by_impulses(body_b)) return;
  const double way = penetration * part;
  if (is_moved_by_impulses(body_a)) a.offset -= normal * (way * share_of(body_a, body_b));
  if (is_moved_by_impulses(body_b)) b.offset += normal * (way * share_of(body_b, body_a));
}

}  // namespace thinwall
