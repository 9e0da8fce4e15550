#pragma once
/// A spring and a damper between a ball and a wall: one step by three schemes, and whether the steps of a spring that holds both ways
/// grow.

#include <array>
#include <cstdint>
#include <string_view>

#include <thinwall/experiments/lab/record.hpp>

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

/// Where stable ends, in steps of 1/omega.
struct LimitBracket {
  double stable = no_most;     ///< decays here, or holds if undamped; 0 if it grows at every step that was tried
  double unstable = no_least;  ///< grows here; infinity if it grows at no step that was tried

  static constexpr auto fields() {
    return record(
        most("stable", &LimitBracket::stable, "1/omega", "Measured: the state decays here (undamped: stays bounded)."),
        least("unstable", &LimitBracket::unstable, "1/omega",
              "Measured: it grows here; missing if it grows at no step."));
  }
};

/// Tries 2^-20 (2^-14 without damping) to 2^20 by factors of 2, then bisects. `damping_ratio`: 0, or 1e-5 to 1e5,
/// where 2^50 steps tell growth from decay. `mass` [kg], `stiffness` [N/m] > 0.
LimitBracket measured_limit(Scheme scheme, double mass, double stiffness, double damping_ratio);

}  // namespace thinwall
