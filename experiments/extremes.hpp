#pragma once
/// The precision ladder: at which scale, distance, speed, thickness, offset, angle or size ratio does each way to find a time
/// of impact break, in float, double, long double and at 50 digits? See docs/extremes.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment extremes_experiment();

}  // namespace thinwall
