#pragma once
/// Every experiment of the program.

#include <span>

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

std::span<const Experiment> experiments();

}  // namespace thinwall
