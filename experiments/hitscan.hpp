#pragma once
/// The ray of an instant bullet against a real one: what does it miss, what does it hit falsely, how far off is it? See
/// docs/hitscan.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment hitscan_experiment();

}  // namespace thinwall
