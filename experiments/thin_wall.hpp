#pragma once
/// The headline: how often does a fast ball pass through a thin wall, for each way of detecting the hit, and does theory
/// agree? See docs/thin_wall.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment thin_wall_experiment();

}  // namespace thinwall
