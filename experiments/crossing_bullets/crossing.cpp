#include <thinwall/experiments/crossing_bullets/crossing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace thinwall {

namespace {

/// The theory is integrated over a grid: it must see both the ball and the path.
constexpr double least_path = 0.01, longest_path = 1e4;  // in contact distances

void check(const Settings& settings, const Crossing& c) {
  const double path = faster_path(c).norm() / contact_distance(c);
  if (!(least_path <= path && path <= longest_path)) {
    settings.complain("speed", fmt::format("a path of {} to {} contact distances a step; speed {}, step {}, radius {} "
                                           "make {}",
                                           least_path, longest_path, c.speed, c.step, c.radius, path));
  }
  if (relative_path(c).norm() < least_path * contact_distance(c)) {
    settings.complain("angle_deg",
                      fmt::format("a relative path of at least {} contact distances; not so at ratio {}, angle_deg {}",
                                  least_path, c.ratio, c.angle_deg));
  }
}

}  // namespace

std::string key(const Crossing& c) {
  return fmt::format("speed {} step {} radius {} ratio {} angle {} offset {}", c.speed, c.step, c.radius, c.ratio,
                     c.angle_deg, c.offset);
}

double contact_distance(const Crossing& c) { return 2 * c.radius; }

Vec3<double> faster_path(const Crossing& c) { return {c.speed * c.step, 0, 0}; }

Vec3<double> slower_path(const Crossing& c) {
  const double path = c.ratio * c.speed * c.step, angle = c.angle_deg * (std::numbers::pi / 180);
  if (c.angle_deg == 180) return {-path, 0, 0};  // the sine of pi is not 0
  return {path * std::cos(angle), path * std::sin(angle), 0};
}

Vec3<double> relative_path(const Crossing& c) { return slower_path(c) - faster_path(c); }

double longest_contact(const Crossing& c) { return 2 * contact_distance(c) / relative_path(c).norm(); }

bool is_parallel(const Crossing& c) { return c.ratio == 0 || c.angle_deg == 0 || c.angle_deg == 180; }

RandomStream random_stream(const Crossing& c, std::uint64_t seed) {
  return {seed, stream_of(std::array{c.speed, c.step, c.radius, c.ratio, c.angle_deg, c.offset})};
}

std::vector<Crossing> make_crossings(const Settings& settings) {
  const auto speeds = settings.numbers("speed", {.lower = 0, .upper = 1e9, .lower_open = true, .unit = "m/s"});
  const double step = settings.number("step", {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "s"});
  const double radius = settings.number("radius", {.lower = 1e-9, .upper = 1e3, .unit = "m"});
  const auto ratios = settings.numbers("ratio", {.lower = 0, .upper = 1});
  const auto angles = settings.numbers("angle_deg", {.lower = 0, .upper = 180, .unit = "deg"});
  const auto offsets = settings.numbers("offset", {.lower = 1, .upper = 1000, .unit = "contact distances"});

  std::vector<Crossing> all = {head_on};
  bool any = false;
  for (const double speed : speeds) {
    for (const double ratio : ratios) {
      for (const double angle : angles) {
        for (const double offset : offsets) {
          if (ratio == 0 && angle != angles.front()) continue;  // what rests has no direction
          if (ratio == 1 && angle == 0) continue;               // nor has this any relative motion
          any = true;
          const Crossing c = {speed, step, radius, ratio, ratio == 0 ? 0 : angle, offset};
          if (c == head_on) continue;
          check(settings, c);
          all.push_back(c);
        }
      }
    }
  }
  if (!any) settings.complain("angle_deg", "an angle at which balls of equal speed move against each other: not 0");
  return all;
}

}  // namespace thinwall
