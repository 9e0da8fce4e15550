#pragma once
/// Scenes from text, for their tests.

#include <string>

#include <thinwall/experiments/scenes/scene.hpp>

namespace thinwall {

inline Settings scene_settings(const std::string& text) {
  Settings settings(text, "my.toml", scene_experiment().default_toml);
  settings.reject_unknown_keys();
  return settings;
}

inline Scene scene_from(const std::string& text, RunOptions options = {}) {
  return read_scene(scene_settings(text), options);
}

/// A ball at 40 m/s, 2/3 m a step, and a wall of 1 cm that it is before at one step and behind at the next.
inline std::string bullet_text(const std::string& more = "") {
  return "scene = 'bullet'\nsteps = 6\n" + more + R"(
[[body]]
name = "bullet"
shape = "sphere"
radius = 0.02
at = [-1, 0, 0]
velocity = [40, 0, 0]
restitution = 1

[[body]]
name = "wall"
shape = "box"
motion = "static"
size = [0.01, 2, 2]
)";
}

}  // namespace thinwall
