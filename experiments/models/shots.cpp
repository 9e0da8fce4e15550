#include <thinwall/experiments/models/shots.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace thinwall {

namespace {

/// Of an angle in [0, 90] degrees, to an ulp or two: Taylor's series. The same bits wherever it is computed, so that the same shots are
/// fired in a browser; a platform's own sine may differ in the last.
struct SineCosine {
  double sine, cosine;
};
SineCosine of_degrees(double angle) {
  if (angle > 45) {
    const SineCosine rest = of_degrees(90 - angle);
    return {rest.cosine, rest.sine};
  }
  const double x = angle * (std::numbers::pi / 180);
  double sine = 1, cosine = 1;
  for (int k = 18; k > 1; k -= 2) {
    cosine = 1 - x * x / (k * (k - 1)) * cosine;
    sine = 1 - x * x / (k * (k + 1)) * sine;
  }
  return {x * sine, cosine};
}

/// A shot must end: no ball takes more steps than this to cross.
constexpr double most_steps_across = 1e4;
/// [m] A wall and a ball that are thinner have no squares in float.
constexpr double thinnest = 1e-9;
/// Poses lie on a grid that float holds: a step must not be longer than this many times what it crosses.
constexpr double most_walls_a_step = 1e6;

/// The grid whose multiples up to `reach` float holds exactly: it has 24 bits.
double grid_for(double reach) { return reach > 0 ? std::ldexp(1.0, std::ilogb(reach) + 1 - 24) : 1; }

double rounded_up_to_float(double x) {
  const float near = static_cast<float>(x);
  const bool below = static_cast<double>(near) < x;
  return static_cast<double>(below ? std::nextafter(near, std::numeric_limits<float>::infinity()) : near);
}

/// How far from the origin a shot can be on each axis, from two steps before first contact to a step after the last.
Vec3<double> reach_of(const Cell& cell, const Vec3<double>& half_extents, double radius) {
  const Vec3<double> step = step_length(cell) * direction(cell);
  const Vec3<double> reach = half_extents + Vec3<double>::Constant(radius) + 2 * step;
  if (cell.wall == Wall::finite) return reach;
  return {reach[0], reach[0] / step[0] * step[1], 0};  // aimed at the origin
}

/// Where the line `across` from the origin (in the plane of motion, and out of it) is `phase` steps before the first
/// time it can touch: when it has entered the box thickened by the radius on every axis.
Vec3<double> start_on_line(const Target& target, double across, double out, double phase) {
  const Vec3<double>& step = target.displacement;
  const Vec3<double> unit = step / target.step_length;
  const Vec3<double> middle(-unit[1] * across, unit[0] * across, out);
  double entry = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (step[i] > 0) entry = std::max(entry, (-target.half_extents[i] - target.radius - middle[i]) / step[i]);
  }
  Vec3<double> start = middle + (entry - phase) * step;
  for (int i = 0; i < 3; ++i) start[i] = std::nearbyint(start[i] / target.grid[i]) * target.grid[i];
  bool before = false;
  for (int i = 0; i < 3; ++i) before |= step[i] > 0 && start[i] < -target.half_extents[i] - target.radius;
  return before ? start : Vec3<double>(start - step);  // rounded to the grid, a phase of almost 0 can be one
}

}  // namespace

double step_length(const Cell& cell) { return cell.speed * cell.step; }
double cosine(const Cell& cell) { return of_degrees(cell.angle_deg).cosine; }
Vec3<double> direction(const Cell& cell) {
  const SineCosine of = of_degrees(cell.angle_deg);
  return {of.cosine, of.sine, 0};
}
double slab_chord(const Cell& cell) { return slab_chord(cell.thickness, cell.radius, cosine(cell)); }

std::optional<CellFault> fault_of(const Cell& cell) {
  const double step = step_length(cell), thick = cell.thickness + 2 * cell.radius;
  if (cell.radius == 0 && cell.thickness == 0)
    return CellFault{"thickness", "not 0 where radius is 0 too: a point is never in a wall of no thickness"};
  if (thick < thinnest) {
    return CellFault{"thickness", fmt::format("such that thickness + 2 * radius is at least {} m; radius is {}",
                                              thinnest, cell.radius)};
  }
  const auto where = [&] {
    return fmt::format("not so at speed {}, step {}, radius {}, thickness {}, angle_deg {}", cell.speed, cell.step,
                       cell.radius, cell.thickness, cell.angle_deg);
  };
  if (slab_chord(cell) > most_steps_across * step)
    return CellFault{"speed", fmt::format("at most {} steps to cross the wall: {}", most_steps_across, where())};
  if (step > most_walls_a_step * thick) {
    return CellFault{"speed",
                     fmt::format("a step of at most {} times thickness + 2 * radius: {}", most_walls_a_step, where())};
  }
  if (cell.wall == Wall::finite && cell.wall_size < thick)
    return CellFault{"wall_size", fmt::format("at least thickness + 2 * radius: {}", where())};
  return std::nullopt;
}

RoundedBox rounded_box(const Cell& cell) {
  return {{cell.thickness / 2, cell.wall_size / 2, cell.wall_size / 2}, cell.radius};
}

RandomStream random_stream(const Cell& cell, std::uint64_t seed) {
  return {seed, stream_of(std::array{cell.speed, cell.step, cell.radius, cell.thickness, cell.angle_deg,
                                     cell.wall == Wall::finite ? 1.0 : 0.0, cell.wall_size})};
}

Target target(const Cell& cell) {
  Target t;
  t.wall = cell.wall;
  t.radius = rounded_up_to_float(cell.radius);
  const double half_side = rounded_up_to_float(cell.wall_size / 2);
  t.half_extents = {rounded_up_to_float(cell.thickness / 2), half_side, half_side};
  const Vec3<double> reach = reach_of(cell, t.half_extents, t.radius);
  const double far = std::ldexp(1.0, std::ilogb(reach.norm()) + 2);  // no two poses of a shot are this far apart
  if (cell.wall == Wall::infinite) t.half_extents[1] = t.half_extents[2] = 1024 * far;
  for (int i = 0; i < 3; ++i) {
    t.grid[i] = grid_for(reach[i]);
    t.displacement[i] = std::floor(step_length(cell) * direction(cell)[i] / t.grid[i]) * t.grid[i];
  }
  t.step_length = t.displacement.norm();
  t.lateness_unit = std::ldexp(far, -32);
  return t;
}

Vec3<double> random_start(const Target& target, const RandomStream& stream, std::uint64_t trial) {
  if (target.wall == Wall::infinite) return start_at_phase(target, uniform(random_words(stream, trial, 0)[0]));
  // Seen along the motion, the wall is a rectangle (its z edges are across the plane of motion), and what the ball can
  // touch is that rectangle rounded by the radius.
  const Vec3<double> unit = target.displacement / target.step_length;
  const Vec3<double>& h = target.half_extents;
  const double wide = h[0] * unit[1] + h[1] * unit[0], high = h[2], r = target.radius;
  for (std::uint64_t draw = 0;; ++draw) {
    const RandomWords words = random_words(stream, trial, draw);
    const double across = (2 * uniform(words[1]) - 1) * (wide + r), out = (2 * uniform(words[2]) - 1) * (high + r);
    const Vec3<double> start = start_on_line(target, across, out, uniform(words[0]));
    const double beyond_wide = std::max(0.0, std::abs(unit[0] * start[1] - unit[1] * start[0]) - wide);
    const double beyond_high = std::max(0.0, std::abs(start[2]) - high);
    if (std::hypot(beyond_wide, beyond_high) <= r) return start;  // judged on the grid, where the shot is fired
  }
}

Vec3<double> start_at_phase(const Target& target, double phase) { return start_on_line(target, 0, 0, phase); }

double gap(const Target& target, const Vec3<double>& position) {
  return (position.cwiseAbs() - target.half_extents).cwiseMax(0.0).norm() - target.radius;
}

double path_to_contact(const Target& target, const Vec3<double>& start) {
  double steps = 0;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const Vec3<double> center = start + steps * target.displacement;
    const Vec3<double> beyond = (center.cwiseAbs() - target.half_extents).cwiseMax(0.0);
    const double distance = beyond.norm();
    if (distance <= target.radius) break;
    double closing = 0;  // the distance a step takes off
    for (int i = 0; i < 3; ++i) closing -= std::copysign(beyond[i], center[i]) * target.displacement[i] / distance;
    if (closing <= 0) break;
    const double next = steps + (distance - target.radius) / closing;
    if (next <= steps) break;
    steps = next;
  }
  return steps * target.step_length;
}

}  // namespace thinwall
