#include <thinwall/experiments/thin_wall/theory.hpp>

namespace thinwall {

Theory pose_theory(const Cell& cell, double poses_per_step) {
  const double spacing = step_length(cell) / poses_per_step;
  if (cell.wall == Wall::finite) {
    const RoundedBox box = rounded_box(cell);
    return {miss_probability(box, direction(cell), spacing), std::nullopt, std::nullopt, 0,
            unturned_probability(box, direction(cell), spacing)};
  }
  const double chord = slab_chord(cell);
  return {miss_probability(chord, spacing), pose_lateness(chord, spacing), std::nullopt, 0,
          miss_probability(chord / 2, spacing)};
}

Theory center_ray_theory(const Cell& cell) {
  if (cell.wall == Wall::infinite) return swept_volume_ray_theory(cell);  // no line misses the wall itself
  if (cell.angle_deg != 0) return {};
  return {center_ray_miss_probability(rounded_box(cell), step_length(cell)), std::nullopt, std::nullopt, 0};
}

Theory swept_volume_ray_theory(const Cell& cell) {
  if (cell.wall == Wall::finite) return {0, std::nullopt, std::nullopt, 0};
  return {0, center_ray_lateness(cell.radius / cosine(cell), step_length(cell)), std::nullopt, 0, 0};
}

/// The track of a wall at rest is the wall: a ray from the center, and at its hit the ball is in contact. A point is there
/// on the wall's face itself, and rounding decides.
Theory confirmed_ray_theory(const Cell& cell) {
  if (cell.radius == 0) return {};
  return center_ray_theory(cell);
}

/// The plane before an infinite wall is the wall. Beside one that ends, the plane reaches on, and so do its hits.
Theory speculative_theory(const Cell& cell) { return early_theory(cell, cell.wall == Wall::finite ? 1 : 0); }

/// At a rim, what is seen before contact may lie beside the ball: it is then pushed neither back nor ahead.
Theory early_theory(const Cell& cell, double tolerance) {
  const bool turns = cell.wall == Wall::infinite;
  return {0, std::nullopt, 0, tolerance * step_length(cell), turns ? std::optional(0.0) : std::nullopt};
}

/// Seen before the middle of the wall, it turns back. At a rim there is no depth that is safe.
Theory late_theory(const Cell& cell, double tolerance) {
  const double latest = tolerance * step_length(cell);
  const bool turns = cell.wall == Wall::infinite && latest < slab_chord(cell) / 2;
  return {0, std::nullopt, latest, 0, turns ? std::optional(0.0) : std::nullopt};
}

Theory exact_theory() { return {0, Lateness{0, 0, 0}, std::nullopt, 0, 0}; }

}  // namespace thinwall
