#pragma once
/// Time policies, and small worlds in which much happens: fast bodies of every shape, walls, masks, bodies in each other, ties.

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/world.hpp>

namespace thinwall::testing {

constexpr TimePolicy all_policies[] = {TimePolicy::discrete, TimePolicy::substeps, TimePolicy::clamp,
                                       TimePolicy::event_driven};
constexpr TimePolicy swept_policies[] = {TimePolicy::clamp, TimePolicy::event_driven};

class WorldDraw {
 public:
  explicit WorldDraw(std::uint64_t seed) : key_{seed, 5} {}

  double in(double low, double high) { return low + (high - low) * uniform(word()); }
  int pick(int count) { return static_cast<int>(word() % static_cast<std::uint64_t>(count)); }
  /// In a cube; on a lattice where coordinates shall tie.
  Vec3<double> vector(double half, bool lattice) {
    Vec3<double> v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = lattice ? half * (pick(5) - 2) / 2 : in(-half, half);
    return v;
  }

 private:
  std::uint64_t word() { return random_words(key_, 0, draw_++)[0]; }
  RandomStream key_;
  std::uint64_t draw_ = 0;
};

inline Mat3<double> drawn_axes(WorldDraw& draw) {
  const double a = draw.in(0, 6.3);
  const double b = draw.in(0, 6.3);
  Mat3<double> about_z, about_x;
  about_z << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1;
  about_x << 1, 0, 0, 0, std::cos(b), -std::sin(b), 0, std::sin(b), std::cos(b);
  return about_z * about_x;
}

inline AnyShape drawn_shape(WorldDraw& draw, int kinds, const Vec3<double>& place, bool lattice) {
  const double size = lattice ? 0.25 * draw.pick(3) : draw.in(0.05, 0.6);
  const int kind = draw.pick(kinds);
  const Vec3<double> half = Vec3<double>::Constant(size) + draw.vector(0.5, lattice).cwiseAbs();
  if (kind == 0) return Sphere<double>{place, size};
  if (kind == 1) return Aabb<double>{place, half};
  if (kind == 2) return std::monostate{};
  if (kind == 3) return Obb<double>{place, half, drawn_axes(draw)};
  const Vec3<double> arm = draw.vector(0.6, lattice);
  return Capsule<double>{place - arm, place + arm, size};
}

struct DrawnWorld {
  std::vector<Body> bodies;
  WorldOptions options;
  double dt = 0.1;  ///< [s]
  int steps = 3;
};

inline DrawnWorld drawn_world(std::uint64_t seed) {
  WorldDraw draw(seed);
  DrawnWorld world;
  const int count = draw.pick(10) == 0 ? draw.pick(40) : draw.pick(9);
  const int kinds = draw.pick(2) == 0 ? 3 : 5;
  const bool lattice = draw.pick(4) == 0;
  const bool masks = draw.pick(3) == 0;
  const double room = draw.in(1, 4);
  for (int i = 0; i < count; ++i) {
    Body body;
    body.id = static_cast<std::uint32_t>(7 * i + draw.pick(7));
    const Vec3<double> place = draw.vector(room, lattice);
    body.shape = drawn_shape(draw, kinds, place, lattice);
    body.is_static = draw.pick(4) == 0;
    const int motion = draw.pick(4);
    const Vec3<double> velocity = draw.vector(motion == 3 ? 200 : 20, lattice);
    if (motion > 0 && !body.is_static) body.velocity = velocity;
    body.mass = draw.in(0.1, 10);
    if (draw.pick(10) == 0) body.mass = std::numeric_limits<double>::infinity();
    body.restitution = draw.pick(3) == 0 ? 1 : draw.in(0, 1);
    if (draw.pick(4) == 0) body.restitution = 0;
    body.gravity_scale = draw.pick(5) == 0 ? 0 : 1;
    body.group = masks ? 1U << draw.pick(3) : 1;
    body.mask = masks ? static_cast<std::uint32_t>(draw.pick(8)) : ~0U;
    world.bodies.push_back(body);
  }
  WorldOptions& options = world.options;
  options.policy = static_cast<TimePolicy>(draw.pick(4));
  options.substeps = 1 + draw.pick(3);
  options.max_events = 1 + draw.pick(6);
  options.contact_rounds = draw.pick(5);
  options.correction = draw.pick(2) == 0 ? 1 : draw.in(0, 1);
  options.response = draw.pick(6) != 0;
  options.events = draw.pick(6) != 0;
  options.end_after = 1 + draw.pick(3);
  if (draw.pick(3) == 0) options.gate = draw.in(0, 2);
  if (draw.pick(3) != 0) options.gravity = draw.vector(30, lattice);
  return world;
}

/// The same bodies in another order.
inline std::vector<Body> shuffled(std::vector<Body> bodies, std::uint64_t seed) {
  WorldDraw draw(seed + 1);
  for (std::size_t i = bodies.size(); i > 1; --i) {
    std::swap(bodies[i - 1], bodies[static_cast<std::size_t>(draw.pick(static_cast<int>(i)))]);
  }
  return bodies;
}

}  // namespace thinwall::testing
