#pragma once
/// What a run of the thin wall fires: the cells, the methods, and how many shots of each.

#include <cstdint>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/thin_wall/cell.hpp>
#include <thinwall/experiments/thin_wall/detectors.hpp>

namespace thinwall {

/// The bullet of the textbook: 10 m/s, 60 steps a second, before the wall at one frame and behind it at the next.
/// Ball and wall together are 5 cm thick and a step is 17 cm, so that it is missed 7 times in 10.
inline constexpr Cell bullet = {.speed = 10,
                                .step = 1.0 / 60,
                                .radius = 0.02,
                                .thickness = 0.01,
                                .angle_deg = 0,
                                .wall = Wall::infinite,
                                .wall_size = 0};

struct ShotPlan {
  std::vector<Cell> cells;  ///< the bullet first, then every combination of the settings' factors
  std::vector<Detector> detectors;
  std::int64_t shots;  ///< of each cell and detector
  std::uint64_t seed;
  Response response;
};

/// Throws UsageError.
ShotPlan make_plan(const Settings& settings, const RunOptions& options);

}  // namespace thinwall
