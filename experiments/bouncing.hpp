#pragma once
/// A ball bounces on a floor: what does each way to find and answer the impact do to its energy, and what time does it
/// take? See docs/bouncing.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment bouncing_experiment();

}  // namespace thinwall
