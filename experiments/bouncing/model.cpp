#include <thinwall/experiments/bouncing/model.hpp>

#include <algorithm>
#include <functional>
#include <limits>
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

constexpr double normal_95 = 1.959963984540054;
constexpr std::int64_t least_for_mean = 30, least_for_spread = 100;

/// Phases differ by no more than rounding: every bounce is the same.
bool is_certain(const BounceRow& row) { return row.theory.sigma() <= rounding_of(row.cell); }

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

std::vector<LongRunPoint> long_run(const BounceCell& cell, std::uint64_t seed, std::int64_t runs,
                                   std::int64_t bounces) {
  const RandomStream stream = bounce_factors().stream(cell, seed);
  constexpr std::uint64_t draw = 1;  // draw 0 is the phases'
  std::vector<std::vector<double>> all;
  std::size_t shortest = static_cast<std::size_t>(bounces);
  for (std::int64_t i = 0; i < runs; ++i) {
    const double elapsed = uniform(random_words(stream, static_cast<std::uint64_t>(i), draw)[0]);
    all.push_back(energies(cell, elapsed, bounces));
    shortest = std::min(shortest, all.back().size());
  }
  std::vector<LongRunPoint> points;
  for (std::size_t n = 1; n <= shortest; n *= 2) {
    BounceTally tally;
    for (const std::vector<double>& run : all) tally.add(run[n - 1]);
    const RandomPhases random = at_random_phases(cell, static_cast<double>(n));
    points.push_back({static_cast<std::int64_t>(n), runs, tally.mean, random.mean, tally.sigma(), random.sigma});
  }
  return points;
}

// Moments of u, uniform on [-1, 1]: 0, 1/3, 0, 1/5.
double BounceTheory::mean() const { return c[0] + c[2] / 3; }
double BounceTheory::sigma() const { return std::sqrt(c[1] * c[1] / 3 + 4 * c[2] * c[2] / 45); }
double BounceTheory::kurtosis() const {
  const auto fourth = [&](double x) { return std::pow(at(x) - mean(), 4); };
  const double moment =
      boost::math::quadrature::gauss<double, 7>::integrate(fourth, -1.0, 1.0) / 2;  // exact to degree 13
  return moment / std::pow(sigma(), 4);
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

RandomPhases at_random_phases(const BounceCell& cell, double bounces) {
  const BounceTheory theory = bounce_theory(cell.policy.name, 0, 1);
  const double speed = std::max(0.0, 1 + theory.mean() * delta(cell) * bounces / 2), mean = speed * speed;  // of V
  return {mean, std::sqrt(mean * bounces) * delta(cell) * theory.sigma()};
}

Measured measured_mean(const BounceRow& row) {
  const double half = normal_95 * row.tally.sigma() / std::sqrt(static_cast<double>(row.tally.trials));
  return {row.tally.mean, {row.tally.mean - half, row.tally.mean + half}};
}

std::optional<double> mean_residual(const BounceRow& row) {
  if (is_certain(row)) return std::nullopt;
  const double difference = row.tally.mean - row.theory.mean();
  const double beyond = std::max(0.0, std::abs(difference) - rounding_of(row.cell));
  const double standard_error = row.theory.sigma() / std::sqrt(static_cast<double>(row.tally.trials));
  return std::copysign(beyond / standard_error, difference);
}

std::optional<double> variance_residual(const BounceRow& row) {
  if (is_certain(row) || row.tally.trials < least_for_spread) return std::nullopt;
  const double n = static_cast<double>(row.tally.trials), s = row.tally.sigma() / row.theory.sigma();
  return (s * s - 1) / std::sqrt((row.theory.kurtosis() - (n - 3) / (n - 1)) / n);
}

Interval BounceTest::covered_allowed() const { return binomial_range(means.judged, 0.95, 0.999); }

bool BounceTest::passed() const {
  const bool is_covered = means.judged == 0 || covered_allowed().contains(static_cast<double>(covered));
  return certain_wrong == 0 && is_covered && means.passed() && variances.passed();
}

std::vector<BounceTest> bounce_tests(const std::vector<BounceRow>& rows) {
  std::vector<BounceTest> tests;
  for (const Group<BounceRow>& group : group_by(rows, [](const BounceRow& row) { return row.cell.policy.name; })) {
    BounceTest& test = tests.emplace_back(BounceTest{group[0]->cell.policy.name});
    for (const BounceRow* row : group) {
      const auto mean = mean_residual(*row), variance = variance_residual(*row);
      if (!mean) {  // every bounce must be the same
        const double expected = row->theory.mean(), allowed = rounding_of(row->cell) + 4 * row->theory.sigma();
        ++test.certain_cells;
        if (!(row->tally.most - expected <= allowed && expected - row->tally.least <= allowed)) ++test.certain_wrong;
      } else if (row->tally.trials < least_for_mean) {
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
