#pragma once
/// What stands in a swept bound and is never touched: how many false hits does each bound make, and what do they cost?
/// See docs/swept_bounds.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment swept_bounds_experiment();

}  // namespace thinwall
