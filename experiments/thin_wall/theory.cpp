#include <thinwall/experiments/thin_wall/methods.hpp>

namespace thinwall {

namespace {

/// Contact so short against the step is lost in the rounding of a pose, and it is chance whether a pose is found in it.
bool rounding_decides(const Cell& cell, double contact) { return contact <= 0x1p-45 * step_length(cell); }

}  // namespace

Theory pose_theory(const Cell& cell, int poses_per_step) {
  const double spacing = step_length(cell) / poses_per_step;
  if (cell.wall == Wall::finite) {
    const RoundedBox box = rounded_box(cell);
    return {miss_probability(box, direction(cell), spacing), std::nullopt, std::nullopt, 0,
            unturned_probability(box, direction(cell), spacing)};
  }
  const double chord = slab_chord(cell);
  Theory theory = {miss_probability(chord, spacing), pose_lateness(chord, spacing), std::nullopt, 0,
                   miss_probability(chord / 2, spacing)};
  const bool once = poses_per_step == 1;
  theory.why = once ? "max(0, 1 - (w + 2r) / (v h cos a))" : "max(0, 1 - n (w + 2r) / (v h cos a))";
  theory.why_late = once ? "min(v h, (w + 2r) / cos a)" : "min(v h / n, (w + 2r) / cos a)";
  return theory;
}

Theory center_ray_theory(const Cell& cell) {
  if (cell.wall == Wall::infinite) {  // no line misses the wall itself
    Theory theory = swept_volume_ray_theory(cell);
    theory.why = "0: a ray meets any infinite wall";
    return theory;
  }
  if (cell.angle_deg != 0) return {};
  return {center_ray_miss_probability(rounded_box(cell), step_length(cell)), std::nullopt, std::nullopt, 0};
}

Theory swept_volume_ray_theory(const Cell& cell) {
  if (cell.wall == Wall::finite) return {0, std::nullopt, std::nullopt, 0};
  return {0,
          center_ray_lateness(cell.radius / cosine(cell), step_length(cell)),
          std::nullopt,
          0,
          0,
          "0: the swept volume is seen",
          "min(v h, r / cos a)"};
}

/// The track of a wall at rest is the wall: a ray from the center, and at its hit the ball is in contact. A point is there
/// on the wall's face itself.
Theory confirmed_ray_theory(const Cell& cell) {
  if (rounding_decides(cell, cell.radius)) return {};
  Theory theory = center_ray_theory(cell);
  if (cell.wall == Wall::infinite) theory.why = "0: a wall at rest is its own track";
  return theory;
}

/// The plane before an infinite wall is the wall. Beside one that ends, the plane reaches on, and so do its hits.
Theory speculative_theory(const Cell& cell) {
  Theory theory = early_theory(cell, cell.wall == Wall::finite ? 1 : 0);
  theory.why = "0: it looks a whole step ahead";
  return theory;
}

/// At a rim, what is seen before contact may lie beside the ball: it is then pushed neither back nor ahead.
Theory early_theory(const Cell& cell, double tolerance) {
  const bool turns = cell.wall == Wall::infinite;
  return {0,
          std::nullopt,
          0,
          tolerance * step_length(cell),
          turns ? std::optional(0.0) : std::nullopt,
          "0: free up to its answer, proven",
          "0"};
}

/// Seen before the middle of the wall, it turns back. At a rim there is no depth that is safe.
Theory late_theory(const Cell& cell, double tolerance) {
  if (rounding_decides(cell, slab_chord(cell))) return {};
  const double latest = tolerance * step_length(cell);
  const bool turns = cell.wall == Wall::infinite && latest < slab_chord(cell) / 2;
  return {0,
          std::nullopt,
          latest,
          0,
          turns ? std::optional(0.0) : std::nullopt,
          "0: finds the least of a convex gap",
          "tolerance v h"};
}

Theory exact_theory() { return {0, Lateness{0, 0, 0}, std::nullopt, 0, 0, "0: exact to rounding", "0"}; }

}  // namespace thinwall
