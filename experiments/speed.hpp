#pragma once
/// What does an answer cost on this machine, and how wrong is it? See docs/benchmarks.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment speed_experiment();

}  // namespace thinwall
