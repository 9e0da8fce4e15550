#include <thinwall/experiments/stiff_contact/model.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/stiff_contact/theory.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

namespace {

struct Ball {
  Sphere<double> shape;
  Vec3<double> velocity;  ///< [m/s]
};

/// One slab, wide enough that the nearest face is always the front or the back.
Aabb<double> wall_of(const Approach& e) {
  const double side = e.thickness + e.radius;
  return {{0, 0, 0}, {e.thickness / 2, side, side}};
}

/// In continuous time a bounce takes at most (pi + 4 zeta) / omega; this is sixteen times as long, and more.
std::int64_t most_steps(const PenaltyContact& c) {
  return 1024 + static_cast<std::int64_t>(64 * (1 + c.damping_ratio) / c.step);
}

struct Stepper {
  Scheme scheme;
  Spring spring;
  Aabb<double> wall;

  /// A step [s] against the wall, which lies along `normal` and is `depth` deep.
  void push(Ball& ball, const Vec3<double>& normal, double depth, double step) const {
    const Motion old = {depth, ball.velocity.dot(normal)};
    const Motion next = stepped(scheme, spring, Pull::push_only, step, old);
    ball.shape.center += normal * (next.depth - old.depth);
    ball.velocity += normal * (next.speed - old.speed);
  }

  /// A step that starts apart from the wall. Returns true if the wall was asked for a force.
  bool fly(Ball& ball, double step, Detection detection) const {
    const Vec3<double> path = ball.velocity * step;
    if (detection == Detection::toi_split) {
      const Toi<double> toi = time_of_impact(Moving{ball.shape, path}, at_rest(wall));
      if (toi.status == ToiStatus::hit) {
        ball.shape.center += path * toi.time;
        push(ball, toi.normal, 0, step * (1 - toi.time));
        return true;
      }
    }
    ball.shape.center += path;
    return false;
  }
};

}  // namespace

double reach(const Approach& e) { return e.radius + e.thickness / 2; }
Spring spring_of(const Approach& e, const PenaltyContact& c) { return spring_of(e.mass, c.stiffness, c.damping_ratio); }
double seconds(const Approach& e, const PenaltyContact& c) { return c.step / frequency(spring_of(e, c)); }
double step_path(const Approach& e, const PenaltyContact& c) { return e.speed * seconds(e, c); }

Bounce bounce(const Approach& e, const PenaltyContact& c, double phase) {
  const double step = seconds(e, c), contact_distance = reach(e);
  const Stepper stepper = {c.scheme, spring_of(e, c), wall_of(e)};
  Ball ball = {{{-contact_distance - phase * e.speed * step, 0, 0}, e.radius}, {e.speed, 0, 0}};
  Bounce result = {Ending::unfinished, 0, 0, 0, 0};
  const std::int64_t budget = most_steps(c);
  for (std::int64_t count = 1; count <= budget; ++count) {
    const Ball before = ball;
    const std::optional<Contact<double>> touch = contact(ball.shape, stepper.wall);
    const double x = ball.shape.center[0], v = ball.velocity[0];
    if (!touch && x * v > 0) {
      result.ending = x < 0 ? Ending::returned : Ending::escaped;
      result.speed = std::abs(v) / e.speed;
      return result;
    }
    if (touch) {
      stepper.push(ball, touch->normal, touch->penetration, step);
      ++result.contact_steps;
    } else if (stepper.fly(ball, step, c.detection)) {
      ++result.contact_steps;
    }
    const double speed = std::abs(ball.velocity[0]), now = ball.shape.center[0];
    if (result.blow_up_step == 0 && !(speed <= e.blow_up * e.speed)) result.blow_up_step = count;
    if (!std::isfinite(speed) || !std::isfinite(now)) return result;
    result.deepest = std::max(result.deepest, now + contact_distance);
    if (ball.velocity == before.velocity && ball.shape.center == before.shape.center) return result;  // it rests
  }
  return result;
}

ContactTally bounce_all(const Approach& e, const PenaltyContact& c, std::uint64_t seed, std::int64_t count) {
  const std::array factors = {e.mass,      e.speed,         e.radius, e.thickness,
                              c.stiffness, c.damping_ratio, c.step,   static_cast<double>(count)};
  const RandomStream stream = {seed, stream_of(factors)};
  const double exact = restitution(c.damping_ratio);
  ContactTally t;
  for (std::int64_t i = 0; i < count; ++i) {
    const double within = uniform(random_words(stream, static_cast<std::uint64_t>(i), 0)[0]);
    const Bounce b = bounce(e, c, (static_cast<double>(i) + within) / static_cast<double>(count));
    if (b.blow_up_step > 0) {
      t.blow_up_step = std::min(t.blow_up_step.value_or(b.blow_up_step), b.blow_up_step);
      ++t.blown_up;
    }
    if (b.ending == Ending::escaped) ++t.escaped;
    if (b.ending == Ending::unfinished) ++t.unfinished;
    if (b.ending != Ending::returned) continue;
    ++t.returned;
    t.contact_steps += b.contact_steps;
    t.slowest = std::min(t.slowest, b.speed);
    t.fastest = std::max(t.fastest, b.speed);
    t.speed_sum += b.speed;
    t.square_error += (b.speed - exact) * (b.speed - exact);
    t.deepest = std::max(t.deepest, b.deepest);
  }
  return t;
}

namespace {

// Growth is told from decay over ten decades of damping; see spring.hpp.
constexpr double least_ratio = 1e-5, greatest_ratio = 1e5;
constexpr double least_path = 0x1p-30;  // [reach] a step: 22 bits are left for the phase
constexpr double least_reach = 1e-9;    // [m]

std::vector<double> ascending(std::vector<double> list) {
  std::ranges::sort(list);
  return list;
}

void check(const Settings& settings, const StiffPlan& plan) {
  for (const double ratio : plan.ratios) {
    if (ratio != 0 && ratio < least_ratio) {
      settings.complain("damping_ratio",
                        fmt::format("0, or {:g} to {:g}; one is {:g}", least_ratio, greatest_ratio, ratio));
    }
  }
  if (reach(plan.approach) < least_reach) {
    settings.complain("thickness", fmt::format("such that radius + thickness / 2 is at least {:g} m", least_reach));
  }
  const double omega = frequency(spring_of(plan.approach.mass, plan.stiffest(), 0));
  const double shortest = plan.approach.speed * std::min(plan.bounce_steps.front(), plan.race_steps.back()) / omega;
  if (shortest < least_path * reach(plan.approach)) {
    settings.complain("stiffness",
                      fmt::format("such that the ball moves, in the shortest step, at least 2^-30 of radius + "
                                  "thickness / 2; at {:g} it moves {:.3g} m",
                                  plan.stiffest(), shortest));
  }
}

}  // namespace

StiffPlan make_stiff_plan(const Settings& settings, const RunOptions& options) {
  const auto steps = [&](std::string_view key, double lower, double upper) {  // a bounce takes about pi / step
    return ascending(settings.numbers(key, {.lower = lower, .upper = upper, .unit = "1/omega"}));
  };
  settings.limit_cells({"stiffness", "damping_ratio", "step"}, all_schemes.size());
  settings.limit_cells({"stiffness", "bounce_damping", "bounce_step"}, all_schemes.size() * all_detections.size());
  StiffPlan plan;
  plan.seed = options.seed;
  plan.approach.mass = settings.number("mass", {.lower = 1e-12, .upper = 1e12, .unit = "kg"});
  plan.stiffness = ascending(settings.numbers("stiffness", {.lower = 1e-12, .upper = 1e18, .unit = "N/m"}));
  plan.ratios = ascending(settings.numbers("damping_ratio", {.lower = 0, .upper = greatest_ratio}));
  plan.steps = steps("step", 1e-6, 1e6);
  plan.approach.speed = settings.number("speed", {.lower = 0, .upper = 1e6, .lower_open = true, .unit = "m/s"});
  plan.approach.radius = settings.number("radius", {.lower = 0, .upper = 1e6, .unit = "m"});
  plan.approach.thickness = settings.number("thickness", {.lower = 0, .upper = 1e6, .unit = "m"});
  plan.approach.blow_up =
      settings.number("blow_up", {.lower = 1, .upper = 1e9, .lower_open = true, .unit = "incoming speeds"});
  plan.bounce_ratios = ascending(settings.numbers("bounce_damping", {.lower = 0, .upper = 100}));
  plan.bounce_steps = steps("bounce_step", 1e-3, 1e6);
  plan.bounces = settings.trials("bounces", 1, 1 << 24, options.trials);
  plan.race_steps = steps("race_step", 1e-3, 2);
  std::ranges::reverse(plan.race_steps);
  plan.race_bounces = settings.integer("race_bounces", 1, 1 << 20);
  plan.rounds = settings.integer("rounds", 1, 1 << 20);
  check(settings, plan);
  return plan;
}

LimitRow measured_spring(const StiffPlan& plan, Scheme scheme, double stiffness, double ratio) {
  const Spring spring = spring_of(plan.approach.mass, stiffness, ratio);
  LimitRow row = {scheme, stiffness, ratio, step_limit(scheme, ratio), {}, {}};
  row.bracket = measured_limit(scheme, plan.approach.mass, stiffness, ratio);
  for (const double step : plan.steps) row.blow_ups.push_back(blow_up_step(scheme, spring, step / frequency(spring)));
  return row;
}

std::vector<ContactRow> measured_wall(const StiffPlan& plan, PenaltyContact wall) {
  std::vector<ContactRow> rows;
  for (const double step : plan.bounce_steps) {
    wall.step = step;
    rows.push_back({wall, bounce_all(plan.approach, wall, plan.seed, plan.bounces)});
  }
  return rows;
}

std::vector<ContactRow> measured_race(const StiffPlan& plan, double ratio) {
  constexpr double round_ns = 2e5;  // so that few rounds are interrupted
  std::vector<double> phases;
  for (std::int64_t i = 0; i < plan.race_bounces; ++i)
    phases.push_back((static_cast<double>(i) + 0.5) / static_cast<double>(plan.race_bounces));
  std::vector<ContactRow> rows;
  std::vector<TimedLoop<double>> loops;
  for (const Scheme scheme : all_schemes) {
    for (const Detection detection : all_detections) {
      for (const double step : plan.race_steps) {
        const PenaltyContact c = {scheme, detection, plan.stiffest(), ratio, step};
        rows.push_back({c, bounce_all(plan.approach, c, plan.seed, plan.race_bounces), {}});
        loops.push_back({[&plan, c](std::span<const double> some) {
          for (const double phase : some) keep(bounce(plan.approach, c, phase));
        }});
      }
    }
  }
  run_rounds<double>(loops, phases, plan.rounds, round_ns, {plan.seed, 0});
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].nanoseconds = loops[i].nanoseconds;
  return rows;
}

}  // namespace thinwall
