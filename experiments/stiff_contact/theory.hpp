#pragma once
/// What mathematics says of a penalty contact. No simulation in here; all is derived in docs/stiff_contact.md.
/// Steps are in units of 1 / omega, depths in units of speed / omega; the damping ratio is c / (2 sqrt(k m)).

#include <optional>

#include <thinwall/experiments/statistics.hpp>
#include <thinwall/experiments/stiff_contact/scheme.hpp>

namespace thinwall {

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
