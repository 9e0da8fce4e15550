#pragma once
/// How often do the same fast balls pass a thin wall in whole physics engines? See docs/engines.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment engines_experiment();

}  // namespace thinwall
