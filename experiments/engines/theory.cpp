#include <thinwall/experiments/engines/theory.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <thinwall/experiments/tunneling_theory.hpp>

namespace thinwall {

/// The integral of 1 / cos from 0 is ln tan(pi/4 + a/2), and beyond the angle whose cosine is depth / spacing nothing is missed.
double mean_miss_probability(double depth, double spacing, double angle_deg) {
  const double share = depth / spacing;
  if (share >= 1) return 0;
  const double most = angle_deg * (std::numbers::pi / 180);
  if (most < 1e-6) return miss_probability(depth, spacing);
  const double a = std::min(most, std::acos(share));
  return (a - share * std::log(std::tan(std::numbers::pi / 4 + a / 2))) / most;
}

double unseen_theory(const EngineCell& cell, int poses_per_step, double skin) {
  return mean_miss_probability(cell.thickness + 2 * cell.radius + 2 * skin, cell.path / poses_per_step, cell.angle_deg);
}

double through_theory(const EngineCell& cell, int poses_per_step, double skin) {
  return mean_miss_probability(cell.thickness / 2 + cell.radius + skin, cell.path / poses_per_step, cell.angle_deg);
}

}  // namespace thinwall
