#pragma once
/// What does it save to leave out what a scene does not need, and does it change anything? See docs/plan.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment plan_experiment();

}  // namespace thinwall
