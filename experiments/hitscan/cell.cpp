#include <thinwall/experiments/hitscan/cell.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace thinwall {

namespace {

constexpr double least_speed_left = 0.1;     // [1] of the muzzle's: with less the bullet does not arrive
constexpr double most_bend = 0.125;          // [1] the oracle asks for one closest approach: docs/hitscan.md
constexpr double least_path = 0.01;          // [reach] a step
constexpr double least_reach = 1e-6;         // [range] the oracle subtracts distances along the range
constexpr double most_drag_in_a_step = 0.5;  // [1] drag * step: a ray of a step is at most two steps long

bool arrives(const HitscanCell& c) { return c.drag * (c.range + reach(c)) <= (1 - least_speed_left) * c.speed; }

void check(const Settings& settings, const HitscanCell& c) {
  if (!(c.range > 2 * reach(c))) {
    settings.complain("range", fmt::format("more than 2 * (target + radius); {} is not, at target {}, radius {}",
                                           c.range, c.target, c.radius));
  }
  if (reach(c) < least_reach * c.range) {
    settings.complain(
        "target", fmt::format("such that target + radius is at least {} of the range; at range {}, radius {} {} is not",
                              least_reach, c.range, c.radius, c.target));
  }
  if (c.drag * c.step > most_drag_in_a_step) {
    settings.complain("step",
                      fmt::format("drag * step at most {}; drag {}, step {}", most_drag_in_a_step, c.drag, c.step));
  }
  const auto arc = arc_of<double>(c);
  const auto there = at_distance(arc, c.range + reach(c));
  if (reach(c) * arc.pull > most_bend * there.vx * there.vx) {
    settings.complain("speed",
                      fmt::format("fast enough to fly nearly straight past a target: (target + radius) * (gravity and "
                                  "wind) at most {} of the squared speed there; not so at speed {}, range {}",
                                  most_bend, c.speed, c.range));
  }
  if (there.vx * c.step < least_path * reach(c)) {
    settings.complain(
        "step", fmt::format("a path of at least {} of target + radius a step; not so at speed {}, step {}", least_path,
                            c.speed, c.step));
  }
}

/// One number of each list, the last list fastest.
template <std::size_t N, class Visit>
void for_each_combination(const std::array<std::vector<double>, N>& lists, const Visit& visit) {
  std::array<std::size_t, N> index = {};
  for (std::size_t turned = 0; turned < N;) {
    std::array<double, N> at = {};
    for (std::size_t i = 0; i < N; ++i) at[i] = lists[i][index[i]];
    visit(at);
    for (turned = 0; turned < N && ++index[N - 1 - turned] == lists[N - 1 - turned].size(); ++turned) {
      index[N - 1 - turned] = 0;
    }
  }
}

}  // namespace

bool is_known(const HitscanCell& c) {
  return std::any_of(known_shots.begin(), known_shots.end(), [&](const KnownShot& known) { return known.cell == c; });
}

std::string key(const HitscanCell& c) {
  return fmt::format("range {} speed {} radius {} wind {} drag {} step {} target {} gravity {} aim {}", c.range,
                     c.speed, c.radius, c.wind, c.drag, c.step, c.target, c.gravity, c.aim);
}

RandomStream random_stream(const HitscanCell& c, std::uint64_t seed) {
  return {seed, stream_of(std::array{c.range, c.speed, c.radius, c.wind, c.drag, c.step, c.target, c.gravity, c.aim})};
}

double reach(const HitscanCell& c) { return c.target + c.radius; }

Vec3<double> pull_direction(const HitscanCell& c) {
  const double pull = arc_of<double>(c).pull;
  if (pull == 0) return {0, -1, 0};
  return {0, -c.gravity / pull, c.drag * c.wind / pull};
}

double deflection(const HitscanCell& c) { return at_distance(arc_of<double>(c), c.range).s; }

double flight_time(const HitscanCell& c) { return time_to(arc_of<double>(c), c.range); }

double disc_radius(const HitscanCell& c) {
  const auto there = at_distance(arc_of<double>(c), c.range);
  return c.aim * reach(c) * std::hypot(1.0, there.vs / there.vx);  // a ball's shadow along a steep arc is an ellipse
}

HitscanWindow contact_window(const HitscanCell& c) {
  const auto arc = arc_of<double>(c);
  return {time_to(arc, c.range - reach(c)), time_to(arc, c.range + reach(c))};
}

std::vector<double> frames_near_target(const HitscanCell& c, double phase) {
  const HitscanWindow window = contact_window(c);
  double frame = std::max(0.0, std::floor(window.from / c.step + phase) - 1);
  std::vector<double> times;
  do {
    times.push_back(frame > 0 ? (frame - phase) * c.step : 0);
    frame += 1;
  } while (times.back() < window.until);
  return times;
}

std::vector<HitscanCell> make_hitscan_cells(const Settings& settings) {
  const auto positive = [](double upper, std::string_view unit) {
    return Range{.lower = 0, .upper = upper, .lower_open = true, .unit = unit};
  };
  settings.limit_cells({"range", "speed", "radius", "wind", "drag", "step", "target"});
  const auto ranges = settings.numbers("range", positive(1e6, "m"));
  const auto speeds = settings.numbers("speed", positive(1e6, "m/s"));
  const auto radii = settings.numbers("radius", {.lower = 0, .upper = 1e3, .unit = "m"});
  const auto winds = settings.numbers("wind", {.lower = 0, .upper = 1e3, .unit = "m/s"});
  const auto drags = settings.numbers("drag", {.lower = 0, .upper = 1e3, .unit = "1/s"});
  const auto steps = settings.numbers("step", positive(1e3, "s"));
  const auto targets = settings.numbers("target", {.lower = 1e-9, .upper = 1e3, .unit = "m"});
  const double gravity = settings.number("gravity", {.lower = 0, .upper = 1e3, .unit = "m/s^2"});
  const double aim = settings.number("aim", {.lower = 1.1, .upper = 100});

  std::vector<HitscanCell> all;
  for (const KnownShot& known : known_shots) all.push_back(known.cell);
  bool any = false;
  const auto add = [&](const HitscanCell& c) {
    if (!arrives(c)) return;
    any = true;
    if (is_known(c)) return;
    check(settings, c);
    all.push_back(c);
  };
  for_each_combination(std::array{targets, steps, drags, winds, radii, speeds, ranges}, [&](const auto& at) {
    const auto& [target, step, drag, wind, radius, speed, range] = at;
    if (drag == 0 && wind != winds.front()) return;  // without drag a wind does nothing
    add({range, speed, radius, drag > 0 ? wind : 0, drag, step, target, gravity, aim});
  });
  if (!any)
    settings.complain("range", "a range that some bullet reaches with a tenth of its speed: lower it, or the drag");
  return all;
}

}  // namespace thinwall
