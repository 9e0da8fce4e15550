#pragma once
/// One step of a penalty contact, a spring and a damper between a ball and a wall, by three schemes.

#include <array>
#include <string_view>

namespace thinwall {

enum class Scheme { explicit_euler, semi_implicit, implicit_euler };
inline constexpr std::array all_schemes = {Scheme::explicit_euler, Scheme::semi_implicit, Scheme::implicit_euler};
std::string_view name(Scheme scheme);

struct Spring {
  double mass;       ///< [kg] > 0
  double stiffness;  ///< [N/m] > 0
  double damping;    ///< [N s/m] >= 0
};

/// Of damping ratio `ratio` = c / (2 sqrt(k m)) >= 0.
Spring spring_of(double mass, double stiffness, double ratio);

double frequency(const Spring& spring);  ///< [1/s] omega = sqrt(k / m)

struct Motion {
  double depth;  ///< [m] into the wall; < 0 is apart
  double speed;  ///< [m/s] into the wall
};

enum class Pull {
  both_ways,  ///< a spring that holds the ball: linear
  push_only,  ///< a wall: where k depth + c speed < 0 there is no force
};

/// The motion after a step [s] >= 0, with the force k depth + c speed against the wall.
///   explicit_euler: depth and speed both from the old state.
///   semi_implicit:  the new speed from the old state, damping too; the new depth from the new speed (symplectic).
///   implicit_euler: both from the new state; a wall that would pull does nothing.
/// Source: derived in docs/stiff_contact.md.
Motion stepped(Scheme scheme, const Spring& spring, Pull pull, double step, const Motion& motion);

}  // namespace thinwall
