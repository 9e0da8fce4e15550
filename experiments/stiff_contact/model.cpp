#include <thinwall/experiments/stiff_contact/model.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

Bounce bounce(const Approach& e, const PenaltyContact& c, double phase) {
  const Spring spring = spring_of(e.mass, c.spring.stiffness, c.spring.damping_ratio);
  const double side = e.thickness + e.radius;  // so wide that the nearest face is always the front or the back
  const Aabb<double> wall = {{0, 0, 0}, {e.thickness / 2, side, side}};
  const double step = c.step / frequency(spring);  // [s]
  Sphere<double> ball = {{-e.reach() - phase * e.speed * step, 0, 0}, e.radius};
  Vec3<double> velocity = {e.speed, 0, 0};
  // For a time [s], against the wall, which lies along `normal` and is `depth` deep.
  const auto push = [&](const Vec3<double>& normal, double depth, double time) {
    const Motion old = {depth, velocity.dot(normal)};
    const Motion next = pushed(c.spring.scheme, spring, time, old);
    ball.center += normal * (next.depth - old.depth);
    velocity += normal * (next.speed - old.speed);
  };
  // A step that starts apart from the wall. Returns true if the wall was asked for a force.
  const auto fly = [&] {
    const Vec3<double> path = velocity * step;
    if (c.detection == Detection::toi_split) {
      const Toi<double> toi = time_of_impact(Moving{ball, path}, at_rest(wall));
      if (toi.status == ToiStatus::hit) {
        ball.center += path * toi.time;
        push(toi.normal, 0, step * (1 - toi.time));
        return true;
      }
    }
    ball.center += path;
    return false;
  };
  Bounce result = {Ending::unfinished, 0, 0, 0, 0};
  // In continuous time a bounce takes at most (pi + 4 zeta) / omega; this is sixteen times as long, and more.
  const std::int64_t budget = 1024 + static_cast<std::int64_t>(64 * (1 + c.spring.damping_ratio) / c.step);
  for (std::int64_t count = 1; count <= budget; ++count) {
    const Vec3<double> center_before = ball.center, velocity_before = velocity;
    const std::optional<Contact<double>> touch = contact(ball, wall);
    if (!touch && ball.center[0] * velocity[0] > 0) {
      result.ending = ball.center[0] < 0 ? Ending::returned : Ending::escaped;
      result.speed = std::abs(velocity[0]) / e.speed;
      return result;
    }
    if (touch) push(touch->normal, touch->penetration, step);
    if (touch || fly()) ++result.contact_steps;
    const double speed = std::abs(velocity[0]), now = ball.center[0];
    if (result.blow_up_step == 0 && !(speed <= e.blow_up * e.speed)) result.blow_up_step = count;
    if (!std::isfinite(speed) || !std::isfinite(now)) return result;
    result.deepest = std::max(result.deepest, now + e.reach());
    if (velocity == velocity_before && ball.center == center_before) return result;  // it rests
  }
  return result;
}

ContactTally bounce_all(const Approach& e, const PenaltyContact& c, std::uint64_t seed, std::int64_t count) {
  const auto& [scheme, stiffness, ratio] = c.spring;
  const double all = static_cast<double>(count), exact = restitution(ratio);
  const std::array factors = {e.mass, e.speed, e.radius, e.thickness, stiffness, ratio, c.step, all};
  const RandomStream stream = {seed, stream_of(factors)};
  ContactTally t;
  for (std::int64_t i = 0; i < count; ++i) {
    const double within = uniform(random_words(stream, static_cast<std::uint64_t>(i), 0)[0]);
    const Bounce b = bounce(e, c, (static_cast<double>(i) + within) / all);
    if (b.blow_up_step > 0) {
      t.blow_up_step = std::min(t.blow_up_step.value_or(b.blow_up_step), b.blow_up_step);
      ++t.blown_up;
    }
    if (b.ending == Ending::escaped) {
      t.least_path = step_path(e, c) / e.reach();
      ++t.escaped;
    }
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

// Growth is told from decay over ten decades of damping; see measured_limit.
constexpr double least_ratio = 1e-5, greatest_ratio = 1e5;
constexpr double least_path = 0x1p-30;  // [reach] a step: 22 bits are left for the phase
constexpr double least_reach = 1e-9;    // [m]

std::vector<double> ascending(std::vector<double> list) {
  std::ranges::sort(list);
  return list;
}

void check(const Settings& settings, const StiffPlan& plan) {
  for (const double ratio : only(plan.ratios, [](double r) { return r != 0 && r < least_ratio; })) {
    settings.complain("damping_ratio",
                      fmt::format("0, or {:g} to {:g}; one is {:g}", least_ratio, greatest_ratio, ratio));
  }
  if (plan.approach.reach() < least_reach) {
    settings.complain("thickness", fmt::format("such that radius + thickness / 2 is at least {:g} m", least_reach));
  }
  const double omega = frequency(spring_of(plan.approach.mass, plan.stiffest(), 0));
  const double shortest = plan.approach.speed * std::min(plan.bounce_steps.front(), plan.race_steps.back()) / omega;
  if (shortest < least_path * plan.approach.reach()) {
    settings.complain("stiffness",
                      fmt::format("such that the ball moves, in the shortest step, at least 2^-30 of radius + "
                                  "thickness / 2; at {:g} it moves {:.3g} m",
                                  plan.stiffest(), shortest));
  }
}

LimitRow measured_spring(const StiffPlan& plan, const SpringCell& cell) {
  const Spring spring = spring_of(plan.approach.mass, cell.stiffness, cell.damping_ratio);
  const auto [stable, unstable] = measured_limit(cell.scheme, spring);
  LimitRow row = {cell, step_limit(cell.scheme, cell.damping_ratio), stable, unstable, {}};
  for (const double step : plan.steps) {
    const auto blow_up = blow_up_step(cell.scheme, spring, step / frequency(spring));
    const char* const verdict = blow_up ? "unstable" : "stable";
    row.map.push_back({cell, step, stable < step && step < unstable ? "undecided" : verdict, blow_up});
  }
  return row;
}

/// At each step of the plan in place of the wall's own.
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
        const PenaltyContact c = {{scheme, plan.stiffest(), ratio}, detection, step};
        rows.push_back({c, bounce_all(plan.approach, c, plan.seed, plan.race_bounces)});
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

/// `rows` are those that it speaks of.
template <class Row, class Holds> StiffClaim claim(std::string text, const std::vector<Row>& rows, const Holds& holds) {
  const std::int64_t right = std::ranges::count_if(rows, holds);
  return {std::move(text), std::ssize(rows), std::ssize(rows) - right};
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

StiffTasks stiff_tasks(const std::shared_ptr<const StiffPlan>& plan) {
  StiffTasks tasks;
  for (const Scheme scheme : all_schemes) {
    for (const double stiffness : plan->stiffness) {
      for (const double ratio : plan->ratios) {
        tasks.springs.push_back({fmt::format("limit {} stiffness {} ratio {}", name(scheme), stiffness, ratio),
                                 std::ssize(plan->steps), [=] {
                                   return measured_spring(*plan, {scheme, stiffness, ratio});
                                 }});
      }
    }
    for (const double ratio : plan->bounce_ratios) {
      for (const double stiffness : plan->stiffness) {
        for (const Detection detection : all_detections) {
          const PenaltyContact wall = {{scheme, stiffness, ratio}, detection, 0};
          tasks.walls.push_back(
              {fmt::format("bounce {} {} stiffness {} ratio {}", name(scheme), name(detection), stiffness, ratio),
               plan->bounces * std::ssize(plan->bounce_steps), [=] { return measured_wall(*plan, wall); }});
        }
      }
    }
  }
  for (const double ratio : plan->bounce_ratios) {
    tasks.races.push_back({fmt::format("race ratio {}", ratio), plan->race_bounces * plan->rounds,
                           [=] { return measured_race(*plan, ratio); }});
  }
  return tasks;
}

// Whether what was measured agrees with theory.

const ContactRow& twin_of(const std::vector<ContactRow>& rows, const ContactRow& row) {
  PenaltyContact other = row.contact;
  other.detection = other.detection == Detection::discrete ? Detection::toi_split : Detection::discrete;
  return *std::ranges::find(rows, other, &ContactRow::contact);
}

std::vector<StiffClaim> stiff_claims(const StiffResults& results) {
  const StiffPlan& plan = results.plan;
  const Approach& e = plan.approach;
  const auto is_decided = [](const MapStep& s) { return s.verdict != "undecided"; };
  const auto undamped = only(
      results.bounces, [&](const ContactRow& r) { return r.contact.spring.damping_ratio == 0 && is_clean(plan, r); });
  const auto undamped_by = [&](Scheme scheme) {
    return only(undamped, [scheme](const ContactRow& r) { return r.contact.spring.scheme == scheme; });
  };
  const auto discrete = [](const ContactRow& r) { return r.contact.detection == Detection::discrete; };
  // [1] Of the incoming speed: what rounding may do to a bounce. Each of pi / step + 2 poses is off by half an ulp of the reach, a share
  // of the path of a step, which the spring turns into step^2 of it in speed; near a step of 2 the bounce passes that on up to
  // 1 / sqrt(1 - step^2 / 4) times.
  const auto slack = [&](const ContactRow& r) {
    const double step = r.contact.step, passed_on = bounce_bounds(step).value_or(Interval{1, 1}).upper;
    const double pose = std::numeric_limits<double>::epsilon() * (1 + e.reach() / step_path(e, r.contact));
    return pose * (std::numbers::pi + 2 * step) * (1 + step) * passed_on;
  };
  return {
      claim("the limit lies in the measured bracket", results.limits, &LimitRow::holds_theory),
      claim("where there is a limit above 0, the bracket is at most 0.1 % wide",
            only(results.limits, [](const LimitRow& row) { return row.theory && *row.theory > 0; }),
            [](const LimitRow& row) { return row.unstable / row.stable - 1 <= 1e-3; }),
      claim("a step is stable below the limit and unstable above",
            only(flat(results.limits, &LimitRow::map), is_decided),
            [](const MapStep& s) {
              const auto limit = step_limit(s.spring.scheme, s.spring.damping_ratio);
              return (s.verdict == "stable") == (!limit || s.step < *limit);
            }),
      claim("semi-implicit, undamped: the speed ratio keeps its bounds",
            only(undamped_by(Scheme::semi_implicit),
                 [](const ContactRow& r) { return bounce_bounds(r.contact.step).has_value(); }),
            [&](const ContactRow& r) {
              const Interval range = *bounce_bounds(r.contact.step);
              return r.tally.slowest >= range.lower - slack(r) && r.tally.fastest <= range.upper + slack(r);
            }),
      claim("explicit, undamped: never slower after than before", undamped_by(Scheme::explicit_euler),
            [&](const ContactRow& r) { return r.tally.slowest >= 1 - slack(r); }),
      claim("implicit, undamped: never faster after than before", undamped_by(Scheme::implicit_euler),
            [&](const ContactRow& r) { return r.tally.fastest <= 1 + slack(r); }),
      // A spring that is relaxed at first touch does not push there: the rest of the split step goes where the whole one went.
      claim("explicit and semi-implicit, undamped: splitting the step changes no bounce",
            only(undamped,
                 [&](const ContactRow& r) { return discrete(r) && r.contact.spring.scheme != Scheme::implicit_euler; }),
            [&](const ContactRow& r) {
              const ContactRow& split = twin_of(results.bounces, r);
              const double most = slack(r) * std::max(1.0, r.tally.fastest);
              return is_clean(plan, split) && std::abs(r.tally.slowest - split.tally.slowest) <= most &&
                     std::abs(r.tally.fastest - split.tally.fastest) <= most;
            }),
      claim("discrete: as many escape as are first seen past the middle, or more", only(results.bounces, discrete),
            [&](const ContactRow& r) {
              const double late_share = std::max(0.0, 1 - e.reach() / step_path(e, r.contact));
              const double least = std::floor(static_cast<double>(r.tally.bounces()) * late_share) - 1;
              return static_cast<double>(r.tally.escaped) >= least;
            }),
      claim("implicit, split, stiff enough for continuous time: none escapes",
            only(results.bounces,
                 [&](const ContactRow& r) {
                   const double depth = e.speed / frequency(e, r.contact);
                   return r.contact.spring.scheme == Scheme::implicit_euler && !discrete(r) && depth < e.reach();
                 }),
            [](const ContactRow& r) { return r.tally.escaped == 0; })};
}

}  // namespace thinwall
