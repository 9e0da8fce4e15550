#include <thinwall/experiments/experiment_list.hpp>

#include <array>

#include <thinwall/experiments/accuracy.hpp>
#include <thinwall/experiments/bouncing.hpp>
#include <thinwall/experiments/broad_phase.hpp>
#include <thinwall/experiments/crossing_bullets.hpp>
#include <thinwall/experiments/engines.hpp>
#include <thinwall/experiments/extremes.hpp>
#include <thinwall/experiments/hitscan.hpp>
#include <thinwall/experiments/plan.hpp>
#include <thinwall/experiments/speed.hpp>
#include <thinwall/experiments/stiff_contact.hpp>
#include <thinwall/experiments/swept_bounds.hpp>
#include <thinwall/experiments/thin_wall.hpp>
#include <thinwall/experiments/work_precision.hpp>

namespace thinwall {

std::span<const Experiment> experiments() {
  // A new experiment is a line here: one that registered itself could be dropped by the linker.
  static const std::array list = {
      thin_wall_experiment(),  //
      accuracy_experiment(),    work_precision_experiment(), swept_bounds_experiment(), crossing_bullets_experiment(),
      hitscan_experiment(),     stiff_contact_experiment(),  bouncing_experiment(),     extremes_experiment(),
      broad_phase_experiment(), plan_experiment(),           engines_experiment(),      speed_experiment(),
  };
  return list;
}

}  // namespace thinwall
