/// The cells that a configuration asks for, and what it may not ask for.

#include <array>
#include <optional>
#include <string_view>

#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/thin_wall/model.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

/// The list of the two that is not the default, to complain about: the other is hardly to blame.
std::string_view step_or_speed(const Settings& settings) {
  const Settings defaults("", "defaults", embedded_toml("thin_wall"));
  return settings.numbers("step", {}) == defaults.numbers("step", {}) ? "speed" : "step";
}

void check(const Settings& settings, const Cell& cell) {
  const std::optional<CellFault> fault = fault_of(cell);
  if (fault) settings.complain(fault->key == "speed" ? step_or_speed(settings) : fault->key, fault->expected);
}

}  // namespace

const Factors<Cell>& cell_factors() {
  static constexpr std::array<std::string_view, 2> walls = {"infinite", "finite"};
  static const Factors<Cell> all =
      factors(numbers("speed", &Cell::speed, allowed_speed, "Speed of the ball."),
              numbers("step", &Cell::step, allowed_step, "Time between two poses."),
              numbers("radius", &Cell::radius, allowed_radius, "Radius of the ball."),
              numbers("thickness", &Cell::thickness, allowed_thickness, "Thickness of the wall."),
              numbers("angle_deg", &Cell::angle_deg, allowed_angle,
                      "Angle of incidence, between the motion and the wall's normal."),
              choices("wall", &Cell::wall, walls, "Infinite, or a finite square."))
          .first_fastest();
  return all;
}

std::vector<Cell> make_cells(const Settings& settings, std::size_t each) {
  const double size = settings.number("wall_size", {.lower = 0, .upper = 1e6, .lower_open = true, .unit = "m"});
  const auto other_than_bullet = [&](Cell& cell) {
    cell.wall_size = cell.wall == Wall::finite ? size : 0;
    check(settings, cell);
    return cell != bullet;
  };
  std::vector<Cell> cells = cell_factors().cells(settings, each, {}, other_than_bullet);
  cells.insert(cells.begin(), bullet);
  return cells;
}

}  // namespace thinwall
