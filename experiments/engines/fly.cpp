#include <thinwall/experiments/engines/fly.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace thinwall {

namespace {

/// [s] of the processor that this thread has had: what others do meanwhile does not count.
double own_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::int64_t in_fixed_point(double x) { return std::llround(std::ldexp(x, 32)); }

/// The lines of flight before and after the bounce meet at some time: of a ball that turns in an instant, when it turned. Its
/// distance from first contact, in steps; < 0 where the ball turns before it touches.
double lateness_of(const EngineShot& shot, const BallState& end, double steps) {
  const double contact_at = -shot.scene.thickness / 2 - shot.scene.radius;
  const double in = shot.start.velocity[0] * shot.scene.step, out = end.velocity[0] * shot.scene.step;
  return (end.position[0] - contact_at - out * (steps - shot.contact)) / (in - out);
}

/// Where the ball would be had there been no wall, to a hundredth of its radius.
bool flew_straight(const EngineShot& shot, const BallState& end, double steps) {
  const Vec3<double> straight = shot.start.position + steps * shot.scene.step * shot.start.velocity;
  return (end.position - straight).norm() <= shot.scene.radius / 100;
}

}  // namespace

void judge(const EngineShot& shot, const std::vector<BallState>& flight, EngineTally& tally) {
  ++tally.shots;
  const BallState& end = flight.back();
  const auto steps = static_cast<double>(flight.size());
  const double half = shot.scene.thickness / 2;
  if (!end.position.allFinite() || !end.velocity.allFinite()) {
    ++tally.lost;
  } else if (end.position[0] > half) {
    ++tally.tunneled;
    if (flew_straight(shot, end, steps)) ++tally.unseen;
  } else if (end.position[0] >= -half) {
    ++tally.stuck;
  } else if (end.velocity[0] < 0) {
    ++tally.turned;
    const double lateness = lateness_of(shot, end, steps);
    const double energy = std::min(1024.0, end.velocity.squaredNorm() / shot.start.velocity.squaredNorm());
    tally.lateness += in_fixed_point(lateness);
    tally.energy += in_fixed_point(energy);
    tally.latest = std::max(tally.latest, lateness);
    tally.earliest = std::min(tally.earliest, lateness);
    tally.most_energy = std::max(tally.most_energy, energy);
    tally.least_energy = std::min(tally.least_energy, energy);
    for (const BallState& at : flight) {
      tally.deepest = std::max(tally.deepest, at.position[0] + shot.scene.radius + half);
    }
  }
}

std::vector<EngineVolley> engine_volleys(std::int64_t shots) {
  std::vector<EngineVolley> volleys;
  for (std::int64_t first = 0; first < shots; first += most_shots_an_engine_volley) {
    volleys.push_back({first, std::min(most_shots_an_engine_volley, shots - first)});
  }
  return volleys;
}

EngineTally fire(const EngineCell& cell, const EngineMode& mode, const EngineVolley& volley, std::uint64_t seed) {
  const RandomStream stream = random_stream(cell, seed);
  EngineTally tally;
  std::vector<BallState> flight(static_cast<std::size_t>(cell.steps));
  for (std::int64_t i = 0; i < volley.shots; ++i) {
    const EngineShot shot = engine_shot(cell, stream, static_cast<std::uint64_t>(volley.first + i));
    const auto world = mode.make(shot.scene, shot.start);
    const double start = own_seconds();
    for (BallState& at : flight) {
      world->step();
      at = world->ball();
    }
    tally.seconds += own_seconds() - start;
    judge(shot, flight, tally);
  }
  return tally;
}

}  // namespace thinwall
