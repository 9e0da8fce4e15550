#include <thinwall/experiments/engines/shots.hpp>

#include <array>

#include <fmt/format.h>

#include <thinwall/experiments/thin_wall/model.hpp>

namespace thinwall {

std::string key(const EngineCell& cell) {
  return fmt::format("path {} step {} radius {} thickness {} wall {} angle {} steps {}", cell.path, cell.step,
                     cell.radius, cell.thickness, cell.wall_size, cell.angle_deg, cell.steps);
}

EngineShot engine_shot(const EngineCell& cell, const RandomStream& stream, std::uint64_t trial) {
  const RandomWords words = random_words(stream, trial, 0);
  const Target fired = target({.speed = cell.path / cell.step,
                               .step = cell.step,
                               .radius = cell.radius,
                               .thickness = cell.thickness,
                               .angle_deg = cell.angle_deg * uniform(words[1]),
                               .wall = Wall::infinite,
                               .wall_size = 0});
  const Vec3<double> start = start_at_phase(fired, uniform(words[0]));
  return {.scene = {.radius = fired.radius,
                    .thickness = 2 * fired.half_extents[0],
                    .half_side = cell.wall_size / 2,
                    .step = cell.step},
          .start = {start, fired.displacement / cell.step},
          .contact = path_to_contact(fired, start) / fired.step_length};
}

RandomStream random_stream(const EngineCell& cell, std::uint64_t seed) {
  return {seed, stream_of(std::array{cell.path, cell.step, cell.radius, cell.thickness, cell.angle_deg})};
}

double least_wall_size(const EngineCell& cell) {
  return 2 * (cell.steps * cell.path + 2 * (cell.radius + cell.thickness));
}

}  // namespace thinwall
