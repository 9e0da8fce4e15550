#pragma once
/// What the factors of a cell may be.

#include <thinwall/experiments/settings.hpp>

namespace thinwall {

inline constexpr Range allowed_speed = {.lower = 0, .upper = 1e9, .lower_open = true, .unit = "m/s"};
inline constexpr Range allowed_step = {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "s"};
inline constexpr Range allowed_radius = {.lower = 0, .upper = 1e3, .unit = "m"};
inline constexpr Range allowed_thickness = {.lower = 0, .upper = 1e3, .unit = "m"};
inline constexpr Range allowed_angle = {.lower = 0, .upper = 89.9, .unit = "deg"};
inline constexpr int least_substeps = 2, most_substeps = 1000;  ///< poses a step

}  // namespace thinwall
