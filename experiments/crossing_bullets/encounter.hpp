#pragma once
/// The encounters of a cell: where the two balls start, and whether and when they truly touch. No rule is in here.

#include <cstdint>

#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/crossing_bullets/crossing.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall {

struct Encounter {
  Moving<Sphere<double>> faster, slower;
};

/// Closest approach uniform over the disc, by rejection. The phase is uniform over the step: of first contact where they
/// touch, of closest approach where they do not.
Encounter random_encounter(const Crossing& c, const RandomStream& stream, std::uint64_t trial);

/// The exact relative motion: the quadratic of the squared distance, in long double. Shares no code with any rule.
struct TrueContact {
  bool touches;       ///< during the step
  long double time;   ///< [1] of first contact, if they touch
  long double until;  ///< [1] of the last contact on the line, which may be after the step
};
TrueContact true_contact(const Encounter& e);

/// [m] From surface to surface at a time in [0, 1]; < 0 where they overlap.
double gap_at(const Encounter& e, double time);

}  // namespace thinwall
