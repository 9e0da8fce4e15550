#pragma once
/// What error does each way to find a time of impact make, and what time does it take? See docs/work_precision.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment work_precision_experiment();

}  // namespace thinwall
