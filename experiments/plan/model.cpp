#include <thinwall/experiments/plan/model.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <mutex>

#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/scenes/scene.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

namespace {

constexpr double plan_dt = 1.0 / 60;           // [s]
constexpr double spacing = 2.2, jitter = 0.7;  // [m] of the lattice of bodies; none is wider than 1.5
constexpr double fast = 20;                    // [m/s] along each axis at most
constexpr std::uint32_t debris = 2;            // a group that does not meet itself

constexpr std::array<std::string_view, 7> scene_names = {"crowd",  "slow_crowd", "town", "told",
                                                         "unread", "unasked",    "few"};

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

/// Source: the 64-bit FNV-1a hash, by half words.
class Digest {
 public:
  void add(std::uint64_t word) {
    for (const std::uint64_t half : {word & 0xffffffff, word >> 32}) hash_ = (hash_ ^ half) * 0x100000001b3;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const Vec3<double>& v) {
    for (int axis = 0; axis < 3; ++axis) add(v[axis]);
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

/// The state, and what was asked for: hits where anybody could read them, events where they are read.
void add_step(Digest& digest, const World& world) {
  digest.add(world.state_hash());
  if (world.options().response || world.options().events) {
    for (const Hit& hit : world.hits()) {
      digest.add((std::uint64_t{hit.first} << 32) + hit.second);
      digest.add(hit.time);
      digest.add(hit.normal);
      digest.add(hit.point);
    }
  }
  for (const CollisionEvent& event : world.events().events()) {
    digest.add((std::uint64_t{event.first} << 32) + event.second);
    digest.add(static_cast<std::uint64_t>(event.kind));
    digest.add(event.time);
  }
}

/// Steps the scene once; the clock runs within the steps alone.
void run_once(const PlanScene& scene, const WorldOptions& options, std::int64_t steps, Way& way) {
  const bool first = way.milliseconds.empty();
  World world(scene.bodies, options);
  Digest digest;
  double seconds = 0;
  for (std::int64_t step = 0; step < steps; ++step) {
    const double start = thread_seconds();
    const StepReport& report = world.step(plan_dt);
    seconds += thread_seconds() - start;
    add_step(digest, world);
    if (!first) continue;
    way.sweeps += static_cast<std::int64_t>(report.sweeps);
    way.gated += static_cast<std::int64_t>(report.gated);
    way.hits += static_cast<std::int64_t>(report.hits);
    way.bytes = std::max(way.bytes, static_cast<std::int64_t>(report.bytes));
  }
  if (first) way.outcome = digest.value();
  way.repeated_alike = way.repeated_alike && way.outcome == digest.value();
  way.milliseconds.push_back(1e3 * seconds / static_cast<double>(steps));
}

/// What the referee of scenes finds that the steps did not.
std::int64_t count_tunneled(const PlanScene& scene, const WorldOptions& options, std::int64_t steps) {
  if (!options.events && !options.response) return 0;  // no contact is looked for, so that none is missed
  World world(scene.bodies, options);
  MissedContacts referee(world);
  std::int64_t count = 0;
  for (std::int64_t step = 0; step < steps; ++step) {
    world.step(plan_dt);
    count += static_cast<std::int64_t>(referee.after_step(world, plan_dt).size());
  }
  return count;
}

}  // namespace

std::span<const std::string_view> plan_scene_names() { return scene_names; }

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

PlanRace race_plans(const PlanScene& scene, const PlanRaceOptions& options) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  PlanRace race{scene.name, std::ssize(scene.bodies), options.steps, {}};
  std::vector<WorldOptions> all;
  const auto add = [&](std::string_view name, const WorldOptions& way) {
    race.ways.emplace_back().name = name;
    all.push_back(way);
  };
  add(lean_way, scene.options);
  const Plan lean = plan(scene.bodies, scene.options);
  for (const PlanLine& line : lean.lines) {
    if (!line.omitted) continue;
    WorldOptions kept = scene.options;
    kept.keep = {line.what};
    add(line.what, kept);
  }
  WorldOptions full = scene.options, gated = scene.options;
  full.full_plan = true;
  gated.gate = options.gate;
  add(full_way, full);
  add(gate_way, gated);
  for (std::int64_t round = 0; round < options.rounds; ++round) {
    for (std::size_t k = 0; k < all.size(); ++k) run_once(scene, all[k], options.steps, race.ways[k]);
  }
  for (const std::size_t k : {std::size_t{0}, all.size() - 1}) {
    race.ways[k].tunneled = count_tunneled(scene, all[k], options.steps);
  }
  return race;
}

bool is_right(const PlanRace& race) {
  return race.ways.front().tunneled == 0 && std::all_of(race.ways.begin(), race.ways.end(), [&](const Way& way) {
           return way.repeated_alike && (way.name == gate_way || way.outcome == race.ways.front().outcome);
         });
}

}  // namespace thinwall
