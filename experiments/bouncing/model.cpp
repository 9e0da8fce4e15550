#include <thinwall/experiments/bouncing/model.hpp>

#include <algorithm>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

/// A ball on the true flight, `elapsed` seconds after it was dropped.
BouncingBall falling(const BouncePolicy& policy, const BounceCell& cell, double elapsed) {
  const double early = policy.staggered ? cell.step / 2 : 0;  // its speed is of half a step before
  return ball_at(cell.height - cell.gravity * elapsed * elapsed / 2, -cell.gravity * (elapsed - early), cell.radius);
}

void check(const Settings& settings, const BounceCell& c) {
  if (c.radius < 1e-3 * c.height || c.radius > 10 * c.height)
    settings.complain("radius", "0.001 to 10 times the height, whose digits it shares");
  if (!(delta(c) >= 1e-4 && delta(c) <= 0.5)) {
    settings.complain("step", fmt::format("steps in which gravity adds 0.0001 to 0.5 of the impact speed: {} s to {} s",
                                          rounded_text(1e-4 * fall_time(c), 3), rounded_text(0.5 * fall_time(c), 3)));
  }
}

}  // namespace

const Factors<BounceCell>& bounce_factors() {
  using C = BounceCell;
  static const Factors<C> all = factors<C>(
      number("gravity", &C::gravity, {.lower = 1e-6, .upper = 1e6, .unit = "m/s^2"}, "Downward."),
      number("height", &C::height, {.lower = 1e-6, .upper = 1e6, .unit = "m"}, "Of the gap that it is dropped from."),
      number("radius", &C::radius, {.lower = 1e-6, .upper = 1e6, .unit = "m"}, "Of the ball."),
      numbers("step", &C::step, {.lower = 0, .lower_open = true, .unit = "s"}, "Time step h."),
      numbers("restitution", &C::restitution, {.lower = 0, .upper = 1}, "Speed after over speed before."));
  return all;
}

std::vector<BounceCell> make_bounce_cells(const Settings& settings, std::size_t each) {
  std::vector<BounceCell> cells = bounce_factors().cells(settings, each, {}, [&](const BounceCell& c) {
    check(settings, c);
    return true;
  });
  std::ranges::stable_sort(cells, std::greater<>(), &BounceCell::step);
  return cells;
}

double impact_speed(const BounceCell& c) { return std::sqrt(2 * c.gravity * c.height); }
double fall_time(const BounceCell& c) { return impact_speed(c) / c.gravity; }
double delta(const BounceCell& c) { return c.gravity * c.step / impact_speed(c); }

BouncingWorld world_of(const BounceCell& c, std::int64_t bounces) {
  const double fastest = impact_speed(c) + static_cast<double>(bounces + 1) * c.gravity * c.step;
  return {c.gravity, c.restitution, c.step, floor_of_depth(2 * c.height + 4 * c.radius + 2 * c.step * fastest)};
}

double rounding_of(const BounceCell& c) {
  constexpr double u = std::numeric_limits<double>::epsilon() / 2;
  const double steps = 2 / delta(c) + 2;  // each rounds a height, or a coordinate of the floor, and a speed
  return 8 * u * steps * (1 + c.radius / c.height) / delta(c);
}

void BounceTally::add(double error) {
  ++trials;
  const double distance = error - mean;
  mean += distance / static_cast<double>(trials);
  squares += distance * (error - mean);
  least = std::min(least, error);
  most = std::max(most, error);
}

double error_at(const BouncePolicy& policy, const BounceCell& cell, double phase) {
  const BouncingWorld world = world_of(cell);
  const double steps = fall_time(cell) / cell.step - phase;
  BouncingBall ball = falling(policy, cell, (steps - std::floor(steps)) * cell.step);
  policy.to_the_apex(world, ball);
  const double energy = flight_energy(policy, world, ball) / (cell.gravity * cell.height);
  return (energy - cell.restitution * cell.restitution) / delta(cell);
}

std::vector<double> energies(const BouncePolicy& policy, const BounceCell& cell, double elapsed, std::int64_t bounces) {
  const BouncingWorld world = world_of(cell, bounces);
  BouncingBall ball = falling(policy, cell, elapsed * cell.step);
  const double first = flight_energy(policy, world, ball), kick = cell.gravity * cell.step;
  std::vector<double> energies;
  while (ball.bounces < bounces) {
    const std::int64_t before = ball.bounces;
    policy.step(world, ball);
    if (ball.velocity == 0 && gap_of(ball) <= 0) break;  // at rest
    if (ball.bounces == before) continue;
    const double energy = flight_energy(policy, world, ball);
    if (!(energy > kick * kick / 2)) break;
    energies.push_back(energy / first);
  }
  return energies;
}

std::vector<double> heights(const BouncePolicy& policy, const BounceCell& cell, double elapsed, std::int64_t steps) {
  const BouncingWorld world = world_of(cell, steps);
  BouncingBall ball = falling(policy, cell, elapsed * cell.step);
  std::vector<double> gaps = {gap_of(ball)};
  for (std::int64_t i = 0; i < steps; ++i) {
    policy.step(world, ball);
    gaps.push_back(gap_of(ball));
  }
  return gaps;
}

BounceTally random_bounces(const BouncePolicy& policy, const BounceCell& cell, std::uint64_t seed,
                           std::int64_t trials) {
  const RandomStream stream = bounce_factors().stream(cell, seed);
  BounceTally tally;
  for (std::int64_t i = 0; i < trials; ++i) {
    const double phase = uniform(random_words(stream, static_cast<std::uint64_t>(i), 0)[0]) + 0x1p-54;  // never 0 or 1
    tally.add(error_at(policy, cell, phase));
  }
  return tally;
}

std::vector<LongRunPoint> long_run(const BouncePolicy& policy, const BounceCell& cell, std::uint64_t seed,
                                   std::int64_t runs, std::int64_t bounces) {
  const RandomStream stream = bounce_factors().stream(cell, seed);
  constexpr std::uint64_t draw = 1;  // draw 0 is the phases'
  std::vector<std::vector<double>> all;
  std::size_t shortest = static_cast<std::size_t>(bounces);
  for (std::int64_t i = 0; i < runs; ++i) {
    const double elapsed = uniform(random_words(stream, static_cast<std::uint64_t>(i), draw)[0]);
    all.push_back(energies(policy, cell, elapsed, bounces));
    shortest = std::min(shortest, all.back().size());
  }
  std::vector<LongRunPoint> points;
  for (std::size_t n = 1; n <= shortest; n *= 2) {
    BounceTally tally;
    for (const std::vector<double>& run : all) tally.add(run[n - 1]);
    points.push_back({static_cast<std::int64_t>(n), runs, tally.mean, tally.sigma()});
  }
  return points;
}

}  // namespace thinwall
