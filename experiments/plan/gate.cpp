#include <thinwall/experiments/plan/gate.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

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
    flight.sweeps += static_cast<std::int64_t>(report.sweeps);
    flight.gated += static_cast<std::int64_t>(report.gated);
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
