#pragma once
/// How far off and how late hitscan's rules are: the part of the theory that needs no areas. Derived in
/// docs/hitscan.md.

#include <thinwall/experiments/hitscan/rules.hpp>

namespace thinwall {

/// Mean and spread of a quantity from shot to shot.
struct HitscanMoments {
  double mean = 0, sigma = 0;
};

/// The i-th of evenly spaced phases, such that none of them is near where one step takes over from another at the
/// target: there everything jumps. A ray along the velocity gets a little farther than the bullet, as that slows down.
double phase_of(const HitscanRule& rule, const HitscanCell& c, int i, int phases);

/// [m] From the rule's path to the arc at the range.
HitscanMoments path_errors(const HitscanRule& rule, const HitscanCell& c);
/// [m] No path error is larger.
double path_error_bound(const HitscanRule& rule, const HitscanCell& c);

/// [s] Of next_frame: what is left of the step in which the center gets to the target, and how much earlier the ball
/// touches.
HitscanMoments next_frame_lateness(const HitscanCell& c);

}  // namespace thinwall
