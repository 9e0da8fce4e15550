/// One ball on the floor: bounces that pile up, and rest.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/bouncing/policies.hpp>
#include <thinwall/experiments/bouncing/scenarios.hpp>

namespace thinwall {

namespace {

constexpr int zeno_steps = 40;  // 10 s
constexpr double rest_restitution = 0.25;

struct Zeno {
  std::vector<double> times;
  BouncingBall ball;
};

Zeno run_zeno() {
  const BouncingWorld world = {2, 0.5, 0.25, floor_of_depth(8)};
  Zeno run = {{}, ball_at(1, 0, 0.5)};
  for (int i = 0; i < zeno_steps; ++i) {
    follow_arc(world, run.ball, [&](double time) { run.times.push_back(time); });
  }
  return run;
}

/// [m] How deep a ball is after `steps` that only turns its speed. From rest, its speed after step k is v (1 - (-e)^k) with
/// v = e g h / (1 + e), and it sinks by (g h - the speed before) h in each. Derived in docs/bouncing.md.
double depth_of_flip_only(const BounceCell& c, double steps) {
  const double e = c.restitution, kick = c.gravity * c.step, speed = e * kick / (1 + e);
  return c.step * (steps * kick - speed * (steps - (1 - std::pow(-e, steps)) / (1 + e)));
}

}  // namespace

std::vector<double> zeno_times() { return run_zeno().times; }

std::vector<BounceScenario> zeno_scenarios() {
  const Zeno run = run_zeno();
  bool exact = run.times.size() == 54;
  for (std::size_t n = 0; n < run.times.size(); ++n)
    exact &= run.times[n] == 3 - std::ldexp(1.0, 1 - static_cast<int>(n));
  const bool rests = gap_of(run.ball) == 0 && run.ball.velocity == 0;
  return {{"bounces that pile up (restitution 1/2)",
           "at 3 - 2^(2-n) s, exactly; the clock stalls at 3 s with the 54th, then rest",
           fmt::format("{} bounces, the last at {} s, {}; {} at 10 s", run.times.size(),
                       run.times.empty() ? 0 : run.times.back(), exact ? "all exact" : "NOT all exact",
                       rests ? "at rest" : "NOT at rest"),
           exact && rests}};
}

std::vector<BounceScenario> rest_scenarios() {
  constexpr std::int64_t steps = 100000;
  std::vector<BounceScenario> scenarios;
  for_each_bounce_policy([&]<class Policy>(Policy) {
    const bool sinks = Policy::name == FlipOnly::name;
    const BounceCell cell = {9.81, sinks ? 1024.0 : 1.0, 0.5, 1.0 / 60, rest_restitution};
    const BouncingWorld world = world_of(cell);
    BouncingBall ball = ball_at(0, 0, cell.radius);
    double lowest = 0, highest = 0;
    for (std::int64_t i = 0; i < steps; ++i) {
      Policy::step(world, ball);
      lowest = std::min(lowest, gap_of(ball));
      highest = std::max(highest, gap_of(ball));
    }
    BounceScenario row = {fmt::format("rest on the floor, {}", Policy::name), "no drift over 100 000 steps",
                          fmt::format("{:.3g} to {:.3g} m", lowest, highest), false};
    const double moved = std::max(highest, -lowest);
    if (sinks) {
      const double depth = depth_of_flip_only(cell, static_cast<double>(steps));
      row.must = fmt::format("sinks: nothing pushes it out; {:.3f} m in 100 000 steps", depth);
      row.happened = fmt::format("{:.3f} m", -gap_of(ball));
      row.passed = std::abs(gap_of(ball) + depth) <= 1e-9 * depth;
    } else if (Policy::name == LinearToi::name || Policy::name == ParabolaToi::name) {
      row.must += ", to the bit";
      row.passed = moved == 0;
    } else {  // pushed out of a floor, whose coordinates are rounded
      row.must += " but the rounding of the floor";
      row.passed = moved <= 0x1p-52 * world.floor.half_extents.y();
    }
    scenarios.push_back(row);
  });
  return scenarios;
}

}  // namespace thinwall
