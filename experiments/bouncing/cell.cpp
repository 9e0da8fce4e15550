#include <thinwall/experiments/bouncing/cell.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

std::string key(const BounceCell& c) {
  return fmt::format("gravity {} height {} radius {} step {} restitution {}", exact_text(c.gravity),
                     exact_text(c.height), exact_text(c.radius), exact_text(c.step), exact_text(c.restitution));
}

double impact_speed(const BounceCell& c) { return std::sqrt(2 * c.gravity * c.height); }
double fall_time(const BounceCell& c) { return impact_speed(c) / c.gravity; }
double delta(const BounceCell& c) { return c.gravity * c.step / impact_speed(c); }

BouncingWorld world_of(const BounceCell& c, std::int64_t bounces) {
  const double fastest = impact_speed(c) + static_cast<double>(bounces + 1) * c.gravity * c.step;
  return {c.gravity, c.restitution, c.step, floor_of_depth(2 * c.height + 4 * c.radius + 2 * c.step * fastest)};
}

double rounding_of(const BounceCell& c) {
  constexpr double u = std::numeric_limits<double>::epsilon() / 2;
  const double steps = 2 / delta(c) + 2;  // each rounds a height, or a coordinate of the floor, and a speed
  return 8 * u * steps * (1 + c.radius / c.height) / delta(c);
}

RandomStream random_stream(const BounceCell& c, std::uint64_t seed) {
  const std::array<double, 5> factors = {c.gravity, c.height, c.radius, c.step, c.restitution};
  return {seed, stream_of(factors)};
}

std::vector<BounceCell> make_bounce_cells(const Settings& settings) {
  BounceCell c{};
  c.gravity = settings.number("gravity", {.lower = 1e-6, .upper = 1e6, .unit = "m/s^2"});
  c.height = settings.number("height", {.lower = 1e-6, .upper = 1e6, .unit = "m"});
  c.radius = settings.number("radius", {.lower = 1e-6, .upper = 1e6, .unit = "m"});
  if (c.radius < 1e-3 * c.height || c.radius > 10 * c.height) {
    settings.complain("radius", "0.001 to 10 times the height, whose digits it shares");
  }
  std::vector<double> steps = settings.numbers("step", {.lower = 0, .lower_open = true, .unit = "s"});
  std::sort(steps.begin(), steps.end(), std::greater<>());
  const std::vector<double> restitutions = settings.numbers("restitution", {.lower = 0, .upper = 1});
  std::vector<BounceCell> cells;
  for (const double step : steps) {
    c.step = step;
    if (!(delta(c) >= 1e-4 && delta(c) <= 0.5)) {
      settings.complain("step",
                        fmt::format("steps in which gravity adds 0.0001 to 0.5 of the impact speed: {} s to {} s",
                                    rounded_text(1e-4 * fall_time(c), 3), rounded_text(0.5 * fall_time(c), 3)));
    }
    for (const double e : restitutions) {
      c.restitution = e;
      cells.push_back(c);
    }
  }
  return cells;
}

}  // namespace thinwall
