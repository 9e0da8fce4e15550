#pragma once
/// What does finding the pairs that may touch cost, against the number of bodies? See docs/broad_phase.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment broad_phase_experiment();

}  // namespace thinwall
