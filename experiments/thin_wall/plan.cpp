#include <thinwall/experiments/thin_wall/plan.hpp>

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <thinwall/experiments/thin_wall/allowed.hpp>
#include <thinwall/experiments/thin_wall/volley.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

/// A shot must end: no ball takes more steps than this to cross.
constexpr double most_steps_across = 1e4;
/// [m] A wall and a ball that are thinner have no squares in float.
constexpr double thinnest = 1e-9;
/// Poses lie on a grid that float holds: a step must not be longer than this many times what it crosses.
constexpr double most_walls_a_step = 1e6;

std::vector<std::string> selected_methods(const Settings& settings) {
  std::vector<std::string_view> allowed = method_names();
  const std::vector<std::string> all(allowed.begin(), allowed.end());
  allowed.emplace_back("all");
  const std::vector<std::string> chosen = settings.choices("method", allowed);
  return std::find(chosen.begin(), chosen.end(), "all") == chosen.end() ? chosen : all;
}

/// The list of the two that is not the default, to complain about: the other is hardly to blame.
std::string_view step_or_speed(const Settings& settings) {
  const Settings defaults("", "defaults", embedded_toml("thin_wall"));
  return settings.numbers("step", {}) == defaults.numbers("step", {}) ? "speed" : "step";
}

void check(const Settings& settings, const Cell& cell) {
  if (cell.radius == 0 && cell.thickness == 0) {
    settings.complain("thickness", "not 0 where radius is 0 too: a point is never in a wall of no thickness");
  }
  const double step = step_length(cell), thick = cell.thickness + 2 * cell.radius;
  if (thick < thinnest) {
    settings.complain("thickness", fmt::format("such that thickness + 2 * radius is at least {} m; radius is {}",
                                               thinnest, cell.radius));
  }
  const auto where = [&] {
    return fmt::format("not so at speed {}, step {}, radius {}, thickness {}, angle_deg {}", cell.speed, cell.step,
                       cell.radius, cell.thickness, cell.angle_deg);
  };
  if (slab_chord(cell) > most_steps_across * step) {
    settings.complain(step_or_speed(settings),
                      fmt::format("at most {} steps to cross the wall: {}", most_steps_across, where()));
  }
  if (step > most_walls_a_step * thick) {
    settings.complain(step_or_speed(settings),
                      fmt::format("a step of at most {} times thickness + 2 * radius: {}", most_walls_a_step, where()));
  }
  if (cell.wall == Wall::finite && cell.wall_size < thick) {
    settings.complain("wall_size", fmt::format("at least thickness + 2 * radius: {}", where()));
  }
}

/// `each`: units of a cell.
std::vector<Cell> make_cells(const Settings& settings, std::size_t each) {
  settings.limit_cells({"speed", "step", "radius", "thickness", "angle_deg", "wall"}, each);
  constexpr std::array<std::string_view, 2> wall_names = {name(Wall::infinite), name(Wall::finite)};
  const auto speeds = settings.numbers("speed", allowed_speed);
  const auto steps = settings.numbers("step", allowed_step);
  const auto radii = settings.numbers("radius", allowed_radius);
  const auto thicknesses = settings.numbers("thickness", allowed_thickness);
  const auto angles = settings.numbers("angle_deg", allowed_angle);
  const auto walls = settings.choices("wall", wall_names);
  const double wall_size = settings.number("wall_size", {.lower = 0, .upper = 1e6, .lower_open = true, .unit = "m"});

  std::vector<Cell> cells = {bullet};
  const std::size_t combinations =
      speeds.size() * steps.size() * radii.size() * thicknesses.size() * angles.size() * walls.size();
  for (std::size_t i = 0; i < combinations; ++i) {
    std::size_t rest = i;  // its digits, in the base of each list's length, choose from the lists
    const auto next = [&rest](const auto& list) {
      const std::size_t digit = rest % list.size();
      rest /= list.size();
      return list[digit];
    };
    Cell cell = {.speed = next(speeds),
                 .step = next(steps),
                 .radius = next(radii),
                 .thickness = next(thicknesses),
                 .angle_deg = next(angles),
                 .wall = Wall::infinite,
                 .wall_size = 0};
    if (next(walls) == name(Wall::finite)) {
      cell.wall = Wall::finite;
      cell.wall_size = wall_size;
    }
    check(settings, cell);
    if (cell != bullet) cells.push_back(cell);
  }
  return cells;
}

}  // namespace

ShotPlan make_plan(const Settings& settings, const RunOptions& options) {
  ShotPlan plan;
  plan.response = settings.choice("response", response_names) == "bounce" ? Response::bounce : Response::none;
  plan.detectors = detectors(selected_methods(settings), settings.integers("substeps", least_substeps, most_substeps),
                             settings.choices("scalar", scalar_names), plan.response);
  plan.shots = settings.trials("shots", 1, most_shots_a_cell, options.trials);
  plan.cells = make_cells(settings, plan.detectors.size() * volleys_of(plan.shots).size());
  plan.seed = options.seed;
  return plan;
}

}  // namespace thinwall
