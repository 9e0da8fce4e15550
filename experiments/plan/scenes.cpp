#include <thinwall/experiments/plan/scenes.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <thinwall/experiments/random.hpp>

namespace thinwall {

namespace {

constexpr double spacing = 2.2, jitter = 0.7;  // [m] of the lattice of bodies; none is wider than 1.5
constexpr double fast = 20;                    // [m/s] along each axis at most
constexpr std::uint32_t debris = 2;            // a group that does not meet itself

constexpr std::array<std::string_view, 7> names = {"crowd", "slow_crowd", "town", "told", "unread", "unasked", "few"};

std::int64_t cube_side(std::int64_t count) {
  std::int64_t side = 1;
  while (side * side * side < count) ++side;
  return side;
}

Vec3<double> centered(const RandomWords& words) {
  return {uniform(words[0]) - 0.5, uniform(words[1]) - 0.5, uniform(words[2]) - 0.5};
}

/// Orthonormal axes, turned about z by an angle in [0, pi).
Mat3<double> turned(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3<double> axes;
  axes << c, -s, 0, s, c, 0, 0, 0, 1;
  return axes;
}

AnyShape shape_at(const Vec3<double>& place, std::int64_t kind, double angle) {
  switch (kind) {
    case 0: return Sphere<double>{place, 0.5};
    case 1: return Aabb<double>{place, {0.4, 0.3, 0.5}};
    case 2: return Obb<double>{place, {0.4, 0.3, 0.5}, turned(angle)};
    default: {
      const Vec3<double> half = turned(angle) * Vec3<double>(0.3, 0, 0);
      return Capsule<double>{place - half, place + half, 0.3};
    }
  }
}

/// In a lattice, each off its place by at most half the jitter; `kinds` shapes in turn.
std::vector<Body> movers(std::int64_t count, std::int64_t kinds, double speed, std::uint64_t seed) {
  const std::array<double, 2> factors = {static_cast<double>(count), static_cast<double>(kinds)};  // not the speed
  const RandomStream stream{seed, stream_of(factors)};
  const std::int64_t side = cube_side(count);
  std::vector<Body> bodies;
  for (std::int64_t i = 0; i < count; ++i) {
    const auto trial = static_cast<std::uint64_t>(i);
    const RandomWords place_words = random_words(stream, trial, 0), velocity_words = random_words(stream, trial, 1);
    const auto row = i / side, layer = row / side;
    const Vec3<double> corner(static_cast<double>(i % side), static_cast<double>(row % side),
                              static_cast<double>(layer));
    Body body;
    body.id = static_cast<std::uint32_t>(i + 1);
    body.shape = shape_at(spacing * corner + jitter * centered(place_words), i % kinds, 3 * uniform(place_words[3]));
    body.velocity = 2 * speed * centered(velocity_words);
    body.restitution = 1;
    bodies.push_back(body);
  }
  return bodies;
}

/// A floor of about `count` square tiles below the lattice of `above` bodies. Neighbors touch.
void add_tiles(std::vector<Body>& bodies, std::int64_t count) {
  const auto side = static_cast<std::int64_t>(std::sqrt(static_cast<double>(count)));
  const double width = spacing * static_cast<double>(cube_side(static_cast<std::int64_t>(bodies.size())) + 2);
  const double tile = width / static_cast<double>(side);
  for (std::int64_t i = 0; i < side * side; ++i) {
    const std::int64_t row = i / side;
    const Vec3<double> place((static_cast<double>(i % side) + 0.5) * tile - 1.5 * spacing, -1.1,
                             (static_cast<double>(row) + 0.5) * tile - 1.5 * spacing);
    Body body;
    body.id = static_cast<std::uint32_t>(bodies.size() + 1);
    body.shape = Aabb<double>{place, {tile / 2, 0.1, tile / 2}};
    body.is_static = true;
    bodies.push_back(body);
  }
}

PlanScene town(std::int64_t count, std::uint64_t seed) {
  PlanScene scene;
  scene.bodies = movers(count - count / 2, 2, fast, seed);
  for (std::size_t i = 0; i < scene.bodies.size(); i += 4) {
    scene.bodies[i].group = debris;
    scene.bodies[i].mask = ~debris;
  }
  add_tiles(scene.bodies, count / 2);
  scene.options.gravity = {0, -9.81, 0};
  return scene;
}

}  // namespace

std::span<const std::string_view> plan_scene_names() { return names; }

PlanScene make_plan_scene(std::string_view name, std::int64_t count, std::uint64_t seed) {
  PlanScene scene;
  if (name == "crowd" || name == "slow_crowd") {
    scene.bodies = movers(count, 4, name == "crowd" ? fast : fast / 10, seed);
  } else {
    scene = town(name == "few" ? std::min<std::int64_t>(count, 100) : count, seed);
    scene.options.response = name != "told" && name != "unasked";
    scene.options.events = name != "unread" && name != "unasked";
  }
  scene.name = name;
  return scene;
}

}  // namespace thinwall
