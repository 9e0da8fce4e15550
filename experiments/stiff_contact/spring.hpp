#pragma once
/// A spring and a damper between a ball and a wall: one step by three schemes, whether the steps of a spring that holds both ways
/// grow, and what mathematics says of both. All is derived in docs/stiff_contact.md; the damping ratio is c / (2 sqrt(k m)).

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include <thinwall/experiments/lab/statistics.hpp>

namespace thinwall {

enum class Scheme { explicit_euler, semi_implicit, implicit_euler };
inline constexpr std::array all_schemes = {Scheme::explicit_euler, Scheme::semi_implicit, Scheme::implicit_euler};
constexpr std::string_view name(Scheme scheme) {
  constexpr std::array<std::string_view, 3> names = {"explicit_euler", "semi_implicit", "implicit_euler"};
  return names[static_cast<std::size_t>(scheme)];
}

struct Spring {
  double mass;       ///< [kg] > 0
  double stiffness;  ///< [N/m] > 0
  double damping;    ///< [N s/m] >= 0
};

/// Of damping ratio `ratio` >= 0.
Spring spring_of(double mass, double stiffness, double ratio);

double frequency(const Spring& spring);  ///< [1/s] omega = sqrt(k / m)

struct Motion {
  double depth;  ///< [m] into the wall; < 0 is apart
  double speed;  ///< [m/s] into the wall
};

/// The motion after a step [s] >= 0 of a spring that holds both ways, with the force k depth + c speed against it: linear.
///   explicit_euler: depth and speed both from the old state.
///   semi_implicit:  the new speed from the old state, damping too; the new depth from the new speed (symplectic).
///   implicit_euler: both from the new state.
Motion stepped(Scheme scheme, const Spring& spring, double step, const Motion& old);

/// The same with a wall, which does nothing where its force would pull: in the state that the scheme takes it from.
Motion pushed(Scheme scheme, const Spring& spring, double step, const Motion& old);

// Growth, measured on the scheme's own steps, without any formula for its limit: by squaring their matrix.

enum class Fate {
  decays,  ///< the largest entry of the power falls below 2^-32
  holds,   ///< neither, in 2^50 steps (2^36 without damping, where rounding would be seen first)
  grows,   ///< it passes 2^32
};

/// `step` [s] > 0.
Fate fate(Scheme scheme, const Spring& spring, double step);

/// A number of steps after which the power first passes 2^32, found by halving; 0 if it does not. The largest entry of a
/// state that oscillates dips, so an earlier step may have passed by less than one oscillation.
std::int64_t blow_up_step(Scheme scheme, const Spring& spring, double step);

/// Where stable ends, in steps of 1/omega: it decays at the lower end, or holds if undamped, and grows at the upper. The lower is 0 if
/// it grows at every step that was tried, the upper infinity if at none.
/// Tries 2^-20 (2^-14 without damping) to 2^20 by factors of 2, then bisects. Its damping ratio: 0, or 1e-5 to 1e5,
/// where 2^50 steps tell growth from decay.
Interval measured_limit(Scheme scheme, const Spring& spring);

// What mathematics says, without any step. Steps are in units of 1/omega, depths in units of speed / omega.

/// [1/omega] A spring that holds both ways is stable below this step, and not above. 0: at no step. Nothing: at every one.
std::optional<double> step_limit(Scheme scheme, double damping_ratio);

/// [1] |speed out / speed in| of a bounce off a wall that only pushes, in continuous time: 1 without damping.
double restitution(double damping_ratio);

/// [speed/omega] How deep that bounce goes.
double deepest(double damping_ratio);

/// [1] |speed out / speed in| of an undamped bounce by the semi-implicit scheme lies in here, whatever the phase.
/// Nothing for a step of 2 and more.
std::optional<Interval> bounce_bounds(double step);

}  // namespace thinwall
