#pragma once
/// Scenes that need everything, something and nothing of what a step can do.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/world/body.hpp>
#include <thinwall/experiments/world/options.hpp>

namespace thinwall {

struct PlanScene {
  std::string name;
  std::vector<Body> bodies;
  WorldOptions options;
};

inline constexpr double plan_dt = 1.0 / 60;  // [s]

std::span<const std::string_view> plan_scene_names();

/// About `count` >= 2 bodies. `name` is one of the names. Bodies start apart, but for the tiles of a floor, which touch.
PlanScene make_plan_scene(std::string_view name, std::int64_t count, std::uint64_t seed);

}  // namespace thinwall
