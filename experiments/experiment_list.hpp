#pragma once
/// Every experiment of the program.

#include <span>

#include <thinwall/experiments/experiment.hpp>

/// A new experiment is a line here, and a function `Experiment NAME_experiment()` in experiments/NAME/NAME.cpp.
#define THINWALL_EXPERIMENTS(X) \
  X(thin_wall)                  \
  X(accuracy)                   \
  X(work_precision)             \
  X(swept_bounds)               \
  X(crossing_bullets)           \
  X(spinning_rod)               \
  X(hitscan)                    \
  X(stiff_contact)              \
  X(bouncing)                   \
  X(extremes)                   \
  X(broad_phase)                \
  X(plan)                       \
  X(engines)                    \
  X(speed)

namespace thinwall {

#define THINWALL_DECLARE(name) Experiment name##_experiment();
THINWALL_EXPERIMENTS(THINWALL_DECLARE)
#undef THINWALL_DECLARE

std::span<const Experiment> experiments();

}  // namespace thinwall
