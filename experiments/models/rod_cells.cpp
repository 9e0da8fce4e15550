/// The cells that a configuration asks for, and what it may not ask for.

#include <numbers>

#include <fmt/format.h>

#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/models/rods.hpp>

namespace thinwall {

namespace {

constexpr Range a_length = {.lower = 1e-3, .upper = 1e3, .unit = "m"};
constexpr Range a_thickness = {.lower = 0, .upper = 1e3, .unit = "m"};

}  // namespace

const Factors<RodFlight>& rod_factors() {
  static const Factors<RodFlight> all = factors<RodFlight>(
      number("half_length", &RodFlight::half_length, a_length, "From the middle of the rod's core to its end."),
      number("radius", &RodFlight::radius, a_length, "Radius of the rod."),
      number("thickness", &RodFlight::thickness, a_thickness, "Of the wall."),
      numbers("tilt_deg", &RodFlight::tilt_deg, {.lower = 0, .upper = 90, .unit = "deg"},
              "Between the axis of spin and the wall's normal."),
      numbers("spin_deg", &RodFlight::spin_deg, {.lower = 0, .upper = 720, .unit = "deg"},
              "How far the rod turns in a step."),
      numbers("step_ratio", &RodFlight::step_ratio, {.lower = 0.05, .upper = 1e4},
              "The step over wall and rod at their widest, w + 2 r + 2 L sin(tilt)."));
  return all;
}

const Factors<BladePass>& blade_factors() {
  static const Factors<BladePass> all = factors<BladePass>(
      number("half_length", &BladePass::half_length, a_length, "From the axis to the end of the blade's core."),
      number("radius", &BladePass::radius, a_length, "Radius of the blade."),
      number("post_radius", &BladePass::post_radius, a_thickness, "Radius of the post."),
      number("post_distance", &BladePass::post_distance, a_length, "From the blade's axis to the post's."),
      numbers("post_spin_deg", &BladePass::post_spin_deg, {.lower = 0, .upper = 180, .lower_open = true, .unit = "deg"},
              "How far the blade turns in a step."));
  return all;
}

std::vector<RodFlight> make_flights(const Settings& settings, std::size_t each) {
  return rod_factors().cells(settings, each);
}

std::vector<BladePass> make_passes(const Settings& settings, std::size_t each) {
  const std::vector<BladePass> cells = blade_factors().cells(settings, each);
  for (const BladePass& c : cells) {
    if (c.post_distance <= c.radius + c.post_radius || c.post_distance > c.half_length) {
      settings.complain("post_distance",
                        fmt::format("more than radius + post_radius, and at most half_length: not so at {}, {} and {}",
                                    c.radius, c.post_radius, c.half_length));
    }
    if (radians(c.post_spin_deg) > std::numbers::pi - 2 * half_window(c)) {
      settings.complain("post_spin_deg",
                        fmt::format("at most {:.6g}, so that one end alone is near the post; it is not at {}",
                                    180 - 2 * half_window(c) * 180 / std::numbers::pi, c.post_spin_deg));
    }
  }
  return cells;
}

}  // namespace thinwall
