#pragma once
/// A ball is dropped from a height onto a floor: the conditions, the ways to take a step, and what each does to the energy of the
/// ball's flight, in one bounce after another or on and on; what theory says of that, exactly and not only to first order, and whether
/// what was measured agrees. Only heights and vertical speeds differ from zero. Derived in docs/bouncing.md.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss.hpp>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

// A ball above a floor, and the exact arc of its flight.

struct BouncingWorld {
  double gravity;      ///< [m/s^2] > 0, downward
  double restitution;  ///< [1] in [0, 1]: speed after over speed before
  double step;         ///< [s] > 0
  Aabb<double> floor;  ///< its top is at height 0
};

struct BouncingBall {
  Sphere<double> body;
  double velocity;           ///< [m/s] upward, as the integrator keeps it
  double time = 0;           ///< [s] since the start
  std::int64_t bounces = 0;  ///< impacts so far
};

/// A floor so deep that nothing gets through: its top is exactly at 0.
inline Aabb<double> floor_of_depth(double depth) { return {{0, -depth / 2, 0}, {depth / 2, depth / 2, depth / 2}}; }

inline BouncingBall ball_at(double gap, double velocity, double radius) {
  return {{{0, radius + gap, 0}, radius}, velocity};
}

/// [m] Between ball and floor; negative inside.
inline double gap_of(const BouncingBall& ball) { return ball.body.center.y() - ball.body.radius; }

/// An approaching ball leaves with its speed times the restitution.
inline void bounce(const BouncingWorld& world, BouncingBall& ball) {
  if (!(ball.velocity < 0)) return;
  ball.velocity = world.restitution * -ball.velocity;
  ++ball.bounces;
}

/// [s] When gap + v t - g t^2 / 2 = 0, for gap >= 0 and g > 0: the root that is not negative. Neither branch subtracts, so
/// that no digit is lost, whether the ball rises or falls. Zero gap and zero speed: 0.
inline double landing_time(double gap, double velocity, double gravity) {
  const double speed = std::sqrt(velocity * velocity + 2 * gravity * gap);  // at landing
  if (velocity > 0) return (velocity + speed) / gravity;
  return speed > 0 ? 2 * gap / (speed - velocity) : 0;
}

/// Follows the arc through one step, and calls at_bounce(time) at each impact. Bounces pile up towards a limit where the
/// restitution is below 1; the ball is at rest from the one on whose flight is too short to move the clock. No tolerance.
/// Degenerate: at rest on the floor it stays, to the bit.
template <class AtBounce> void follow_arc(const BouncingWorld& world, BouncingBall& ball, const AtBounce& at_bounce) {
  const double g = world.gravity, start = ball.time;
  double gap = std::max(0.0, gap_of(ball)), left = world.step;
  while (left > 0) {
    const double end = gap + left * (ball.velocity - g * left / 2);
    if (end > 0) {  // the arc is concave: above the floor at both ends, it is so between
      gap = end;
      ball.velocity -= g * left;
      break;
    }
    const double speed = std::sqrt(ball.velocity * ball.velocity + 2 * g * gap);
    left = std::max(0.0, left - landing_time(gap, ball.velocity, g));
    gap = 0;
    ball.velocity = -speed;
    bounce(world, ball);
    const double clock = start + (world.step - left), flight = 2 * ball.velocity / g;
    if (speed > 0) at_bounce(clock);
    if (!(clock + flight > clock)) {
      ball.velocity = 0;
      break;
    }
  }
  ball.body.center.y() = ball.body.radius + gap;
  ball.time += world.step;
}

// The policies: the ways to take a step.

/// Semi-implicit Euler, first the speed, then the height with the new speed; or the exact arc.
enum class BounceFlight { euler, arc };

/// As if there were no floor.
template <BounceFlight flight> void fly(const BouncingWorld& world, BouncingBall& ball) {
  const double kick = world.gravity * world.step;
  ball.body.center.y() += (ball.velocity - (flight == BounceFlight::euler ? kick : kick / 2)) * world.step;
  ball.velocity -= kick;
  ball.time += world.step;
}

/// Tests the pose, pushes the ball out and turns its speed.
inline void push_out(const BouncingWorld& world, BouncingBall& ball) {
  const auto touch = contact(ball.body, world.floor);
  if (!touch) return;
  ball.body.center -= touch->normal * touch->penetration;
  bounce(world, ball);
}

/// The same without pushing out.
inline void turn_speed(const BouncingWorld& world, BouncingBall& ball) {
  if (overlaps(ball.body, world.floor)) bounce(world, ball);
}

/// Semi-implicit Euler, whose straight path in a step is split where the library finds first contact. A ball that touches
/// at the start of a step is carried by the floor: gravity does not push it in.
inline void linear_toi(const BouncingWorld& world, BouncingBall& ball) {
  const double before = ball.velocity, kick = world.gravity * world.step;
  double left = world.step;
  ball.velocity = before - kick;
  const Vec3<double> path = {0, ball.velocity * left, 0};
  const Toi<double> toi = time_of_impact(Moving<Sphere<double>>{ball.body, path}, at_rest(world.floor));
  if (toi.status == ToiStatus::overlapping) {
    ball.velocity = before < 0 ? before : std::max(0.0, ball.velocity);
    bounce(world, ball);
  } else if (toi.status == ToiStatus::hit) {
    ball.body.center += path * toi.time;
    left *= 1 - toi.time;
    bounce(world, ball);
  }
  ball.body.center.y() += ball.velocity * left;
  ball.time += world.step;
}

/// The exact arc, split where it meets the floor: tested at the end of the step, which is enough since an arc is concave and
/// the floor deeper than a step, and solved if it ends inside.
inline void parabola_toi(const BouncingWorld& world, BouncingBall& ball) {
  BouncingBall end = ball;
  fly<BounceFlight::arc>(world, end);
  if (overlaps(end.body, world.floor)) return follow_arc(world, ball, [](double) {});
  ball = end;
}

struct BouncePolicy {
  using Step = void (*)(const BouncingWorld&, BouncingBall&);
  std::string_view name;
  bool staggered;  ///< its speeds are half a step early
  Step step;
  Step to_the_apex;  ///< steps up to the apex after the next impact: what is timed, so nothing stands between its steps
};

/// A step is its parts, one after the other.
template <BouncePolicy::Step... parts> constexpr BouncePolicy bounce_policy(std::string_view name, bool staggered) {
  constexpr BouncePolicy::Step step = [](const BouncingWorld& world, BouncingBall& ball) { (parts(world, ball), ...); };
  return {name, staggered, step, [](const BouncingWorld& world, BouncingBall& ball) {
            for (const std::int64_t before = ball.bounces; ball.bounces == before;) step(world, ball);
            while (ball.velocity > world.gravity * world.step) step(world, ball);
          }};
}

/// In the order of the tables; the first is the game loop's way.
inline const std::vector<BouncePolicy> all_bounce_policies = {
    bounce_policy<fly<BounceFlight::euler>, push_out>("project_flip", true),
    bounce_policy<fly<BounceFlight::euler>, turn_speed>("flip_only", true),
    bounce_policy<linear_toi>("linear_toi", true),
    bounce_policy<fly<BounceFlight::arc>, push_out>("exact_project", false),
    bounce_policy<parabola_toi>("parabola_toi", false)};

/// [J/kg] Energy of the flight: gravity times the height that the ball will rise to. Semi-implicit Euler's positions lie on an exact
/// parabola, and its velocities are that parabola's half a step earlier. Derived in docs/bouncing.md.
inline double flight_energy(const BouncePolicy& policy, const BouncingWorld& world, const BouncingBall& ball) {
  const double v = policy.staggered ? ball.velocity - world.gravity * world.step / 2 : ball.velocity;
  return v * v / 2 + world.gravity * gap_of(ball);
}

// What is asked of them.

struct BounceCell {
  double gravity;      ///< [m/s^2] > 0
  double height;       ///< [m] > 0, of the gap that it is dropped from
  double radius;       ///< [m] > 0
  double step;         ///< [s] > 0
  double restitution;  ///< [1] in [0, 1]
  BouncePolicy policy;
};

/// But for the policy.
inline const Factors<BounceCell> bounce_factors = factors<BounceCell>(
    number("gravity", &BounceCell::gravity, {.lower = 1e-6, .upper = 1e6, .unit = "m/s^2"}, "Downward."),
    number("height", &BounceCell::height, {.lower = 1e-6, .upper = 1e6, .unit = "m"},
           "Of the gap that it is dropped from."),
    number("radius", &BounceCell::radius, {.lower = 1e-6, .upper = 1e6, .unit = "m"}, "Of the ball."),
    numbers("step", &BounceCell::step, {.lower = 0, .lower_open = true, .unit = "s"}, "Time step h."),
    numbers("restitution", &BounceCell::restitution, {.lower = 0, .upper = 1}, "Speed after over speed before."));

/// [m/s] V, of the true flight.
inline double impact_speed(const BounceCell& c) { return std::sqrt(2 * c.gravity * c.height); }
/// [s] V / g.
inline double fall_time(const BounceCell& c) { return impact_speed(c) / c.gravity; }
/// [1] g h / V: speed that gravity adds in a step, over the impact's.
inline double delta(const BounceCell& c) { return c.gravity * c.step / impact_speed(c); }

/// Every combination of step, restitution and policy: steps from coarse to fine, policies fastest and in the order of the tables.
/// Throws UsageError.
inline std::vector<BounceCell> make_bounce_cells(const Settings& settings) {
  const std::vector<BouncePolicy> policies = chosen(settings, "policy", all_bounce_policies);
  std::vector<BounceCell> drops = bounce_factors.cells(settings, policies.size(), {}, [&](const BounceCell& c) {
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
  for (const BounceCell& drop : drops) {
    for (const BouncePolicy& policy : policies) cells.emplace_back(drop).policy = policy;
  }
  return cells;
}

/// The floor is deeper than what a ball falls in a step after `bounces` of which each adds a whole g h to its speed, so that
/// a test of the pose at the end of a step sees it.
inline BouncingWorld world_of(const BounceCell& c, std::int64_t bounces = 1) {
  const double fastest = impact_speed(c) + static_cast<double>(bounces + 1) * c.gravity * c.step;
  return {c.gravity, c.restitution, c.step, floor_of_depth(2 * c.height + 4 * c.radius + 2 * c.step * fastest)};
}
/// [g h / V] More than what rounding does to the energy of a flight of this many steps.
inline double rounding_of(const BounceCell& c) {
  const double steps = 2 / delta(c) + 2;  // each rounds a height, or a coordinate of the floor, and a speed
  return 4 * std::numeric_limits<double>::epsilon() * steps * (1 + c.radius / c.height) / delta(c);
}

// What is measured: bounces each of its own phase, and balls that bounce on and on.

/// Numbers in their order: the change of energy [g h / V] over the trials of one cell.
struct BounceTally {
  std::int64_t trials = 0;
  double mean = 0;
  double squares = 0;  ///< sum of squared distances from the mean
  double least = no_least, most = no_most;

  void add(double x) {  ///< Source: Welford's update
    const double distance = x - mean;
    mean += distance / static_cast<double>(++trials);
    squares += distance * (x - mean);
    least = std::min(least, x);
    most = std::max(most, x);
  }
  double sigma() const { return trials > 1 ? std::sqrt(squares / static_cast<double>(trials - 1)) : 0; }
  double rms() const { return std::sqrt(mean * mean + squares / static_cast<double>(trials)); }
  static constexpr auto fields() {
    using T = BounceTally;
    return record(kept("bounces", &T::trials, "1", "Bounces at random phase."), kept("mean", &T::mean),
                  kept("squares", &T::squares), kept("least", &T::least, "g h / V", "The bounce that loses most."),
                  kept("most", &T::most, "g h / V", "The bounce that gains most."));
  }
};

/// A ball on the true flight, `elapsed` seconds after it was dropped.
inline BouncingBall falling(const BounceCell& cell, double elapsed) {
  const double early = cell.policy.staggered ? cell.step / 2 : 0;  // its speed is of half a step before
  return ball_at(cell.height - cell.gravity * elapsed * elapsed / 2, -cell.gravity * (elapsed - early), cell.radius);
}

/// [g h / V] Change of the flight's energy when a ball of `cell` meets the floor `phase` in (0, 1) of a step after it began.
inline double error_at(const BounceCell& cell, double phase) {
  const BouncingWorld world = world_of(cell);
  const double steps = fall_time(cell) / cell.step - phase;
  BouncingBall ball = falling(cell, (steps - std::floor(steps)) * cell.step);
  cell.policy.to_the_apex(world, ball);
  const double energy = flight_energy(cell.policy, world, ball) / (cell.gravity * cell.height);
  return (energy - cell.restitution * cell.restitution) / delta(cell);
}

/// `trials` bounces at random phases: independent, the same for every policy.
inline BounceTally random_bounces(const BounceCell& cell, std::uint64_t seed, std::int64_t trials) {
  const RandomStream stream = bounce_factors.stream(cell, seed);
  BounceTally tally;
  for (std::int64_t i = 0; i < trials; ++i) {
    const double phase = uniform(random_words(stream, static_cast<std::uint64_t>(i), 0)[0]) + 0x1p-54;  // never 0 or 1
    tally.add(error_at(cell, phase));
  }
  return tally;
}

/// One ball that bounces on and on: energy of the flight after each bounce over that of the first flight, until `bounces` or
/// until a flight has become shorter than two steps. The run begins `elapsed` in [0, 1) of a step after the drop.
inline std::vector<double> energies(const BounceCell& cell, double elapsed, std::int64_t bounces) {
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

/// [m] The gap at the start of such a run, and after each step.
inline std::vector<double> heights(const BounceCell& cell, double elapsed, std::int64_t steps) {
  const BouncingWorld world = world_of(cell, steps);
  BouncingBall ball = falling(cell, elapsed * cell.step);
  std::vector<double> gaps = {gap_of(ball)};
  for (std::int64_t i = 0; i < steps; ++i) {
    cell.policy.step(world, ball);
    gaps.push_back(gap_of(ball));
  }
  return gaps;
}

// What theory says.

/// With delta = g h / V, where V is the speed at which the true flight meets the floor, and u = 1 - 2 tau, where tau in [0, 1] is
/// the phase: the share of the step that has passed then. The energy after the bounce, over that before, less the
/// restitution's square, is (c0 + c1 u + c2 u^2) * delta.
struct BounceTheory {
  Vec3<double> c = Vec3<double>::Zero();  ///< [g h / V]
  double at(double u) const { return c[0] + u * (c[1] + u * c[2]); }
  // Over uniform phases. Moments of u, uniform on [-1, 1]: 0, 1/3, 0, 1/5.
  double mean() const { return c[0] + c[2] / 3; }                                     ///< [g h / V]
  double sigma() const { return std::sqrt(c[1] * c[1] / 3 + 4 * c[2] * c[2] / 45); }  ///< [g h / V] standard deviation
  /// [1] Fourth moment about the mean over the variance's square; 9/5 if c2 is 0.
  double kurtosis() const {
    const auto fourth = [&](double x) { return std::pow(at(x) - mean(), 4); };
    using Gauss = boost::math::quadrature::gauss<double, 7>;  // exact to degree 13
    return Gauss::integrate(fourth, -1.0, 1.0) / 2 / std::pow(sigma(), 4);
  }
};

/// At restitution `e`. Requires one of the five policies' names.
inline BounceTheory bounce_theory(std::string_view policy, double delta, double e) {
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

// Whether the two agree.

/// A cell, what was measured and what theory expects.
struct BounceRow {
  BounceCell cell;
  BounceTally tally;
  BounceTheory theory = bounce_theory(cell.policy.name, delta(cell), cell.restitution);
  std::vector<double> nanoseconds = {};  ///< a bounce, from apex to apex, round by round; of what is timed alone

  /// Phases differ by no more than rounding: every bounce is the same, and there are no residuals.
  bool is_certain() const { return theory.sigma() <= rounding_of(cell); }
  /// Standard errors between the mean and theory, where the two differ by more than rounding.
  std::optional<double> mean_residual() const {
    if (is_certain()) return std::nullopt;
    const double difference = tally.mean - theory.mean();
    const double beyond = std::max(0.0, std::abs(difference) - rounding_of(cell));
    return std::copysign(beyond / (theory.sigma() / std::sqrt(static_cast<double>(tally.trials))), difference);
  }
  /// The same of the variance, whose standard error follows from the kurtosis; nothing below 100 trials.
  std::optional<double> variance_residual() const {
    if (is_certain() || tally.trials < 100) return std::nullopt;
    const double n = static_cast<double>(tally.trials), s = tally.sigma() / theory.sigma();
    return (s * s - 1) / std::sqrt((theory.kurtosis() - (n - 3) / (n - 1)) / n);
  }
};

/// The verdict on one policy. A right theory fails by chance about once in 300 times for each.
struct BounceTest {
  std::string_view policy;
  std::int64_t certain_cells = 0;  ///< every bounce must give what theory says, to rounding
  std::int64_t certain_wrong = 0;  ///< ... and does not
  std::int64_t covered = 0;        ///< of the judged means, those whose 95 % interval holds the theory
  ResidualTest means = {};         ///< of cells with at least 30 bounces, and phases that matter
  ResidualTest variances = {};     ///< of those with at least 100
  std::int64_t other_cells = 0;    ///< too few bounces to judge
  /// Central 99.9 % of Binomial(judged, 0.95); requires that some are.
  Interval covered_allowed() const { return binomial_range(means.judged, 0.95, 0.999); }
  bool passed() const {
    const bool is_covered = means.judged == 0 || covered_allowed().contains(static_cast<double>(covered));
    return certain_wrong == 0 && is_covered && means.passed() && variances.passed();
  }
};

/// By policy.
inline std::vector<BounceTest> bounce_tests(const std::vector<BounceRow>& rows) {
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

// Impacts that come in crowds: at one instant, without end, or in tens of millions. Each has an answer of its own to be held against.

struct BounceScenario {
  std::string name, must, happened;
  bool passed = false;
  std::string group = {};

  static constexpr auto fields() {
    using S = BounceScenario;
    return record(kept("group", &S::group, "", "Kind of scenario."), kept("scenario", &S::name, "", "What is done."),
                  kept("must", &S::must, "", "What must happen."), kept("happened", &S::happened, "", "What did."),
                  kept("passed", &S::passed, "", "It is what must."));
  }
};

/// What happens in each, and what must, is told in docs/bouncing.md.
inline constexpr std::string_view scenario_groups[] = {"zeno", "rest", "walls", "gap", "masses", "cradle", "digits"};

/// All of one group: masses `mass_ratios` apart, and up to `digits` <= 7 digits of pi after its first, in float at most 5.
std::vector<BounceScenario> bounce_scenarios(std::string_view group, const std::vector<double>& mass_ratios,
                                             int digits);

}  // namespace thinwall
