#pragma once
/// How far is the closed form off, and is its verdict ever wrong? See docs/accuracy.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment accuracy_experiment();

}  // namespace thinwall
