#include <thinwall/experiments/thin_wall/theory.hpp>

namespace thinwall {

Theory pose_theory(const Cell& cell, double poses_per_step) {
  const double spacing = step_length(cell) / poses_per_step;
  if (cell.wall == Wall::finite) return {miss_probability(rounded_box(cell), direction(cell), spacing), std::nullopt};
  const double chord = slab_chord(cell);
  return {miss_probability(chord, spacing), pose_lateness(chord, spacing)};
}

Theory center_ray_theory(const Cell& cell) {
  if (cell.wall == Wall::infinite) return swept_volume_ray_theory(cell);  // no line misses the wall itself
  if (cell.angle_deg != 0) return {};
  return {center_ray_miss_probability(rounded_box(cell), step_length(cell)), std::nullopt};
}

Theory swept_volume_ray_theory(const Cell& cell) {
  if (cell.wall == Wall::finite) return {0, std::nullopt};
  return {0, center_ray_lateness(cell.radius / cosine(cell), step_length(cell))};
}

Theory exact_theory() { return {0, Lateness{0, 0, 0}}; }

}  // namespace thinwall
