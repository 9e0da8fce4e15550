#pragma once
/// The chance of going through a wall for a ball that is looked at in poses alone. Derived in docs/tunneling_theory.md for one
/// angle; here the angle of incidence is uniform between 0 and a largest one.

#include <thinwall/experiments/engines/shots.hpp>

namespace thinwall {

/// [1] The mean over angles in [0, angle_deg] of max(0, 1 - depth / (spacing cos a)). `depth` > 0 and `spacing` > 0 [m].
double mean_miss_probability(double depth, double spacing, double angle_deg);

/// [1] No pose, `poses_per_step` of them, is in contact: the ball is never seen. `skin`: contact begins so far [m] before the
/// surfaces meet.
double unseen_theory(const EngineCell& cell, int poses_per_step, double skin = 0);

/// [1] No pose is in contact before the ball's center is past the wall's middle, from where the shortest way out leads on: it
/// is never seen, or seen too late.
double through_theory(const EngineCell& cell, int poses_per_step, double skin = 0);

}  // namespace thinwall
