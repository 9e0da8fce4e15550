#include <thinwall/experiments/plan/model.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/world/referee.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

namespace {

constexpr double plan_dt = 1.0 / 60;           // [s]
constexpr double spacing = 2.2, jitter = 0.7;  // [m] of the lattice of bodies; none is wider than 1.5
constexpr double fast = 20;                    // [m/s] along each axis at most
constexpr std::uint32_t debris = 2;            // a group that does not meet itself

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
    way.sweeps += report.sweeps;
    way.gated += report.gated;
    way.hits += report.hits;
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
  Referee referee(world);
  std::int64_t count = 0;
  for (std::int64_t step = 0; step < steps; ++step) {
    world.step(plan_dt);
    count += static_cast<std::int64_t>(referee.missed_by(world, plan_dt).size());
  }
  return count;
}

}  // namespace

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

// ---- The motion gate.

namespace {

constexpr double gate_wall = 0.1;  // [1] thickness of the wall in radii of the ball
constexpr double lane = 16;        // [m] between shots; radii are 1 m, walls 6 m wide
constexpr double whole_step = 1;   // [s]

/// [m] How far the center is from the target's when they first touch, at most.
double reach(GateTarget target) { return target == GateTarget::wall ? 1 + gate_wall / 2 : 2; }

std::int64_t steps_of(const GateCell& cell) {
  return static_cast<std::int64_t>(std::ceil(2 * reach(cell.target) / cell.path)) + 3;
}

/// Ball i has the id 2 i + 1, its target the next. The draws do not depend on the gate.
std::vector<Body> bodies_of(const GateCell& cell, std::uint64_t seed) {
  const std::array<double, 2> factors = {cell.target == GateTarget::wall ? 0.0 : 1.0, cell.path};
  const RandomStream stream{seed, stream_of(factors)};
  const auto side = static_cast<std::int64_t>(std::ceil(std::sqrt(static_cast<double>(cell.shots))));
  std::vector<Body> bodies;
  for (std::int64_t i = 0; i < cell.shots; ++i) {
    const RandomWords words = random_words(stream, static_cast<std::uint64_t>(i), 0);
    const std::int64_t row = i / side;
    const Vec3<double> middle(0, lane * static_cast<double>(i % side), lane * static_cast<double>(row));
    const double offset = 2 * std::sqrt(uniform(words[0]));  // uniform over the disk
    Body ball, target;
    ball.id = static_cast<std::uint32_t>(2 * i + 1);
    target.id = ball.id + 1;
    const Vec3<double> start(-reach(cell.target) - cell.path * (1 + uniform(words[1])),
                             cell.target == GateTarget::wall ? 0 : offset, 0);
    ball.shape = Sphere<double>{middle + start, 1};
    ball.velocity = {cell.path / whole_step, 0, 0};
    target.is_static = true;
    if (cell.target == GateTarget::wall) {
      target.shape = Aabb<double>{middle, {gate_wall / 2, 3, 3}};
    } else {
      target.shape = Sphere<double>{middle, 1};
    }
    bodies.push_back(ball);
    bodies.push_back(target);
  }
  return bodies;
}

struct Flight {
  std::vector<double> met;  // [s] by shot; infinity: never
  std::int64_t sweeps = 0, gated = 0;
  double milliseconds = 0;
};

Flight fly(const GateCell& cell, const std::vector<Body>& bodies, double gate) {
  WorldOptions options;
  options.response = false;
  options.gate = gate;
  World world(bodies, options);
  Flight flight;
  flight.met.assign(bodies.size() / 2, std::numeric_limits<double>::infinity());
  const std::int64_t steps = steps_of(cell);
  for (std::int64_t step = 0; step < steps; ++step) {
    const StepReport& report = world.step(whole_step);
    flight.sweeps += report.sweeps;
    flight.gated += report.gated;
    flight.milliseconds += 1e3 * report.seconds.total() / static_cast<double>(steps);
    for (const Hit& hit : world.hits()) {
      double& met = flight.met[(hit.first - 1) / 2];
      met = std::min(met, hit.time);
    }
  }
  return flight;
}

}  // namespace

double missed_by_gate(const GateCell& cell) {
  if (cell.path > cell.gate) return 0;
  if (cell.target == GateTarget::wall) return std::max(0.0, 1 - (gate_wall + 2) / cell.path);
  const double length = cell.path / 4;
  return length <= 1 ? length * length / 3 : 1 - 2 / (3 * length);
}

GateTally shoot_at_gate(const GateCell& cell, std::int64_t rounds, std::uint64_t seed) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const std::vector<Body> bodies = bodies_of(cell, seed);
  GateTally tally;
  for (std::int64_t round = 0; round < rounds; ++round) {
    const Flight swept = fly(cell, bodies, 0), gated = fly(cell, bodies, cell.gate);
    tally.swept_milliseconds.push_back(swept.milliseconds);
    tally.milliseconds.push_back(gated.milliseconds);
    if (round > 0) continue;
    tally.sweeps = swept.sweeps;
    tally.gated = gated.gated;
    for (std::size_t i = 0; i < swept.met.size(); ++i) {
      const bool is_told = std::isfinite(gated.met[i]);
      tally.missed += is_told ? 0 : 1;
      tally.missed_swept += std::isfinite(swept.met[i]) ? 0 : 1;
      tally.early += gated.met[i] < swept.met[i] ? 1 : 0;
      if (is_told && std::isfinite(swept.met[i])) tally.late += gated.met[i] - swept.met[i];
    }
    const auto told = static_cast<std::int64_t>(swept.met.size()) - tally.missed;
    if (told > 0) tally.late /= whole_step * static_cast<double>(told);
  }
  return tally;
}

std::string gate_target_name(GateTarget target) { return target == GateTarget::wall ? "wall" : "ball"; }

std::vector<SelfTest> gate_self_test(const std::vector<GateRow>& rows) {
  std::vector<CellCount> cells;
  for (const GateRow& row : rows) {
    const auto same = [&](const GateRow& other) {  // the shots of a path are the same at every gate: one counts
      return &other < &row && other.cell.target == row.cell.target && other.cell.path == row.cell.path &&
             other.cell.path <= other.cell.gate && row.cell.path <= row.cell.gate;
    };
    if (std::ranges::none_of(rows, same)) {
      cells.push_back({"gate at a " + gate_target_name(row.cell.target), "double", row.cell.shots, row.tally.missed,
                       missed_by_gate(row.cell)});
    }
  }
  return self_test(cells);
}

bool gate_is_right(const std::vector<GateRow>& rows) {
  return all_passed(gate_self_test(rows)) && std::ranges::all_of(rows, [](const GateRow& row) {
           return row.tally.early == 0 && row.tally.missed_swept == 0;
         });
}

}  // namespace thinwall
