#pragma once
/// A scene of the user's, and what the program does with it: `thinwall run FILE`, `thinwall compare FILE`.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

/// Steps the scene once: what tunneled, who met whom, energy, and time a step by phase.
Experiment scene_experiment();

/// Steps it under every time policy and step, and holds each against the finest exact run.
Experiment compare_experiment();

}  // namespace thinwall
