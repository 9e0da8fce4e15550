#pragma once
/// Does a spring that holds both ways grow? Measured on the scheme's own steps, without any formula for its limit.
///
/// The step is linear, so two unit states, stepped once, give its matrix (in units of energy: sqrt(k) depth,
/// sqrt(m) speed), and squaring that n times runs 2^n steps. Scaled by powers of two, nothing overflows.

#include <cstdint>

#include <thinwall/experiments/stiff_contact/scheme.hpp>

namespace thinwall {

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
  double stable;    ///< decays here, or holds if there is no damping; 0 if it grows at every step that was tried
  double unstable;  ///< grows here; infinity if it grows at no step that was tried
};

/// Tries 2^-20 (2^-14 without damping) to 2^20 by factors of 2, then bisects. `damping_ratio`: 0, or 1e-5 to 1e5,
/// where 2^50 steps tell growth from decay. `mass` [kg], `stiffness` [N/m] > 0.
LimitBracket measured_limit(Scheme scheme, double mass, double stiffness, double damping_ratio);

}  // namespace thinwall
