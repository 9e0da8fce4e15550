#include <thinwall/experiments/thin_wall/cell.hpp>

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace thinwall {

namespace {

double angle(const Cell& cell) { return cell.angle_deg * (std::numbers::pi / 180); }

}  // namespace

std::string key(const Cell& cell) {
  std::string text = fmt::format("speed {} step {} radius {} thickness {} angle {} {}", cell.speed, cell.step,
                                 cell.radius, cell.thickness, cell.angle_deg, name(cell.wall));
  if (cell.wall == Wall::finite) text += fmt::format(" {}", cell.wall_size);
  return text;
}

double step_length(const Cell& cell) { return cell.speed * cell.step; }
double cosine(const Cell& cell) { return std::cos(angle(cell)); }
Vec3<double> direction(const Cell& cell) { return {cosine(cell), std::sin(angle(cell)), 0}; }
double slab_chord(const Cell& cell) { return slab_chord(cell.thickness, cell.radius, cosine(cell)); }

RoundedBox rounded_box(const Cell& cell) {
  return {{cell.thickness / 2, cell.wall_size / 2, cell.wall_size / 2}, cell.radius};
}

RandomStream random_stream(const Cell& cell, std::uint64_t seed) {
  return {seed, stream_of(std::array{cell.speed, cell.step, cell.radius, cell.thickness, cell.angle_deg,
                                     cell.wall == Wall::finite ? 1.0 : 0.0, cell.wall_size})};
}

}  // namespace thinwall
