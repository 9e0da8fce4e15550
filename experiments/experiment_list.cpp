#include <thinwall/experiments/experiment_list.hpp>

#include <array>

namespace thinwall {

std::span<const Experiment> experiments() {
  // Called by name: one that registered itself could be dropped by the linker.
#define THINWALL_CALL(name) name##_experiment(),
  static const std::array list = {THINWALL_EXPERIMENTS(THINWALL_CALL)};
#undef THINWALL_CALL
  return list;
}

}  // namespace thinwall
