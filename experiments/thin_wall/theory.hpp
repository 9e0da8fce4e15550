#pragma once
/// What theory expects of a cell. Derived in docs/tunneling_theory.md.

#include <optional>

#include <thinwall/experiments/thin_wall/cell.hpp>
#include <thinwall/experiments/tunneling_theory.hpp>

namespace thinwall {

struct Theory {
  std::optional<double> probability;  ///< of tunneling
  std::optional<Lateness> lateness;   ///< [m] along the path, of the detected
};

Theory pose_theory(const Cell& cell, double poses_per_step);
Theory center_ray_theory(const Cell& cell);
Theory swept_volume_ray_theory(const Cell& cell);
Theory exact_theory();

}  // namespace thinwall
