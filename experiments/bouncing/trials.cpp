#include <thinwall/experiments/bouncing/trials.hpp>

#include <algorithm>
#include <cmath>

#include <thinwall/experiments/bouncing/policies.hpp>

namespace thinwall {

namespace {

/// A ball on the true flight, `elapsed` seconds after it was dropped.
template <class Policy> BouncingBall falling(const BounceCell& cell, double elapsed) {
  const double early = Policy::staggered ? cell.step / 2 : 0;  // its speed is of half a step before
  return ball_at(cell.height - cell.gravity * elapsed * elapsed / 2, -cell.gravity * (elapsed - early), cell.radius);
}

template <class Policy> double error_at(const BounceCell& cell, double phase) {
  const BouncingWorld world = world_of(cell);
  const double steps = fall_time(cell) / cell.step - phase;
  BouncingBall ball = falling<Policy>(cell, (steps - std::floor(steps)) * cell.step);
  while (ball.bounces == 0) Policy::step(world, ball);
  while (ball.velocity > world.gravity * world.step) Policy::step(world, ball);  // up to the apex
  const double energy = flight_energy<Policy>(world, ball) / (cell.gravity * cell.height);
  return (energy - cell.restitution * cell.restitution) / delta(cell);
}

template <class Policy> std::vector<double> energies(const BounceCell& cell, double elapsed, std::int64_t bounces) {
  const BouncingWorld world = world_of(cell, bounces);
  BouncingBall ball = falling<Policy>(cell, elapsed * cell.step);
  const double first = flight_energy<Policy>(world, ball), kick = cell.gravity * cell.step;
  std::vector<double> energies;
  while (ball.bounces < bounces) {
    const std::int64_t before = ball.bounces;
    Policy::step(world, ball);
    if (ball.velocity == 0 && gap_of(ball) <= 0) break;  // at rest
    if (ball.bounces == before) continue;
    const double energy = flight_energy<Policy>(world, ball);
    if (!(energy > kick * kick / 2)) break;
    energies.push_back(energy / first);
  }
  return energies;
}

template <class Policy> std::vector<double> heights(const BounceCell& cell, double elapsed, std::int64_t steps) {
  const BouncingWorld world = world_of(cell, steps);
  BouncingBall ball = falling<Policy>(cell, elapsed * cell.step);
  std::vector<double> gaps = {gap_of(ball)};
  for (std::int64_t i = 0; i < steps; ++i) {
    Policy::step(world, ball);
    gaps.push_back(gap_of(ball));
  }
  return gaps;
}

}  // namespace

std::vector<BouncePolicy> bounce_policies(const std::vector<std::string>& names) {
  std::vector<BouncePolicy> policies;
  for_each_bounce_policy([&]<class Policy>(Policy) {
    if (std::find(names.begin(), names.end(), Policy::name) == names.end()) return;
    policies.push_back({std::string(Policy::name), Policy::staggered, Policy::drift, &error_at<Policy>,
                        &energies<Policy>, &heights<Policy>});
  });
  return policies;
}

std::vector<std::string_view> bounce_policy_names() {
  std::vector<std::string_view> names;
  for_each_bounce_policy([&]<class Policy>(Policy) { names.push_back(Policy::name); });
  return names;
}

BounceTally random_bounces(const BouncePolicy& policy, const BounceCell& cell, std::uint64_t seed,
                           std::int64_t trials) {
  const RandomStream stream = random_stream(cell, seed);
  BounceTally tally;
  for (std::int64_t i = 0; i < trials; ++i) {
    const double phase = uniform(random_words(stream, static_cast<std::uint64_t>(i), 0)[0]) + 0x1p-54;  // never 0 or 1
    tally.add(policy.error_at(cell, phase));
  }
  return tally;
}

BounceTally even_bounces(const BouncePolicy& policy, const BounceCell& cell, std::int64_t count) {
  BounceTally tally;
  for (std::int64_t i = 0; i < count; ++i) {
    tally.add(policy.error_at(cell, (static_cast<double>(i) + 0.5) / static_cast<double>(count)));
  }
  return tally;
}

}  // namespace thinwall
