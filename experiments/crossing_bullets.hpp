#pragma once
/// Two fast bodies cross: how many false hits and how many misses come of sweeping both and testing, against the exact
/// relative motion? See docs/crossing_bullets.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment crossing_bullets_experiment();

}  // namespace thinwall
