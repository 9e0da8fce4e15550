#include <thinwall/experiments/bouncing/model.hpp>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss.hpp>

#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

/// A ball on the true flight, `elapsed` seconds after it was dropped.
BouncingBall falling(const BounceCell& cell, double elapsed) {
  const double early = cell.policy.staggered ? cell.step / 2 : 0;  // its speed is of half a step before
  return ball_at(cell.height - cell.gravity * elapsed * elapsed / 2, -cell.gravity * (elapsed - early), cell.radius);
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

std::vector<BounceCell> make_bounce_cells(const Settings& settings) {
  const auto names = settings.choices_or_all("policy", distinct(all_bounce_policies, &BouncePolicy::name));
  const auto is_asked = [&](const BouncePolicy& p) { return std::ranges::find(names, p.name) != names.end(); };
  std::vector<BounceCell> drops = bounce_factors().cells(settings, names.size(), {}, [&](const BounceCell& c) {
    if (c.radius < 1e-3 * c.height || c.radius > 10 * c.height)
      settings.complain("radius", "0.001 to 10 times the height, whose digits it shares");
    if (!(delta(c) >= 1e-4 && delta(c) <= 0.5)) {
      settings.complain("step",
                        fmt::format("steps in which gravity adds 0.0001 to 0.5 of the impact speed: {} s to {} s",
                                    rounded_text(1e-4 * fall_time(c), 3), rounded_text(0.5 * fall_time(c), 3)));
    }
    return true;
  });
  std::ranges::stable_sort(drops, std::greater<>(), &BounceCell::step);
  std::vector<BounceCell> cells;
  for (BounceCell& drop : drops) {
    for (const BouncePolicy& policy : only(all_bounce_policies, is_asked)) {
      drop.policy = policy;
      cells.push_back(drop);
    }
  }
  return cells;
}

double error_at(const BounceCell& cell, double phase) {
  const BouncingWorld world = world_of(cell);
  const double steps = fall_time(cell) / cell.step - phase;
  BouncingBall ball = falling(cell, (steps - std::floor(steps)) * cell.step);
  cell.policy.to_the_apex(world, ball);
  const double energy = flight_energy(cell.policy, world, ball) / (cell.gravity * cell.height);
  return (energy - cell.restitution * cell.restitution) / delta(cell);
}

std::vector<double> energies(const BounceCell& cell, double elapsed, std::int64_t bounces) {
  const BouncingWorld world = world_of(cell, bounces);
  BouncingBall ball = falling(cell, elapsed * cell.step);
  const double first = flight_energy(cell.policy, world, ball), kick = cell.gravity * cell.step;
  std::vector<double> energies;
  while (ball.bounces < bounces) {
    const std::int64_t before = ball.bounces;
    cell.policy.step(world, ball);
    if (ball.velocity == 0 && gap_of(ball) <= 0) break;  // at rest
    if (ball.bounces == before) continue;
    const double energy = flight_energy(cell.policy, world, ball);
    if (!(energy > kick * kick / 2)) break;
    energies.push_back(energy / first);
  }
  return energies;
}

std::vector<double> heights(const BounceCell& cell, double elapsed, std::int64_t steps) {
  const BouncingWorld world = world_of(cell, steps);
  BouncingBall ball = falling(cell, elapsed * cell.step);
  std::vector<double> gaps = {gap_of(ball)};
  for (std::int64_t i = 0; i < steps; ++i) {
    cell.policy.step(world, ball);
    gaps.push_back(gap_of(ball));
  }
  return gaps;
}

BounceTally random_bounces(const BounceCell& cell, std::uint64_t seed, std::int64_t trials) {
  const RandomStream stream = bounce_factors().stream(cell, seed);
  BounceTally tally;
  for (std::int64_t i = 0; i < trials; ++i) {
    const double phase = uniform(random_words(stream, static_cast<std::uint64_t>(i), 0)[0]) + 0x1p-54;  // never 0 or 1
    tally.add(error_at(cell, phase));
  }
  return tally;
}

double BounceTheory::kurtosis() const {
  const auto fourth = [&](double x) { return std::pow(at(x) - mean(), 4); };
  using Gauss = boost::math::quadrature::gauss<double, 7>;  // exact to degree 13
  return Gauss::integrate(fourth, -1.0, 1.0) / 2 / std::pow(sigma(), 4);
}

BounceTheory bounce_theory(std::string_view policy, double delta, double restitution) {
  const double e = restitution;
  // Speed after: e (V + g h u / 2), which the flight has half a step later than Euler says, so it has lost g h / 2.
  const Vec3<double> late_speed = {delta / 4 - e, e * e - e * delta / 2, e * e * delta / 4};
  // What the depth at the end of the step is worth: V s + g s^2 / 2 with s = (1 + u) h / 2.
  const Vec3<double> depth = {1 + delta / 4, 1 + delta / 2, delta / 4};
  if (policy == "project_flip") return {late_speed};
  if (policy == "flip_only") return {late_speed - depth};
  if (policy == "linear_toi") return {late_speed + e * depth};
  if (policy == "exact_project") return {e * e * depth};
  if (policy == "parabola_toi") return {};
  throw std::logic_error(fmt::format("no theory for the policy '{}'", policy));
}

std::vector<BounceTest> bounce_tests(const std::vector<BounceRow>& rows) {
  std::vector<BounceTest> tests;
  for (const Group<BounceRow>& group : group_by(rows, [](const BounceRow& row) { return row.cell.policy.name; })) {
    BounceTest& test = tests.emplace_back(BounceTest{group[0]->cell.policy.name});
    for (const BounceRow* row : group) {
      const auto mean = row->mean_residual(), variance = row->variance_residual();
      if (!mean) {  // every bounce must be the same
        const double expected = row->theory.mean(), allowed = rounding_of(row->cell) + 4 * row->theory.sigma();
        ++test.certain_cells;
        if (!(row->tally.most - expected <= allowed && expected - row->tally.least <= allowed)) ++test.certain_wrong;
      } else if (row->tally.trials < 30) {
        ++test.other_cells;
      } else {
        test.means.add(*mean);
        if (std::abs(*mean) <= normal_95) ++test.covered;
        if (variance) test.variances.add(*variance);
      }
    }
  }
  return tests;
}

}  // namespace thinwall
