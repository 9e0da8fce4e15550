#pragma once
/// What a bounce does to the energy of the flight, exactly and not only to first order. Derived in docs/bouncing.md.

#include <string_view>

namespace thinwall {

/// With delta = g h / V, where V is the speed at which the true flight meets the floor, and u = 1 - 2 tau, where tau in [0, 1] is
/// the phase: the share of the step that has passed then. The energy after the bounce, over that before, less the
/// restitution's square, is (c0 + c1 u + c2 u^2) * delta.
struct BounceTheory {
  double c0 = 0, c1 = 0, c2 = 0;  ///< [g h / V]
  double at(double u) const { return c0 + u * (c1 + u * c2); }
  double mean() const;      ///< [g h / V] over uniform phases
  double sigma() const;     ///< [g h / V] standard deviation over them
  double rms() const;       ///< [g h / V] root of the mean square
  double kurtosis() const;  ///< [1] fourth moment about the mean over the variance's square; 9/5 if c2 is 0
};

/// Requires one of the five policies' names.
BounceTheory bounce_theory(std::string_view policy, double delta, double restitution);

}  // namespace thinwall
