/// The science of the stiff contact: its formulas against eigenvalues and continuous time, without any of the schemes; growth of a
/// spring that holds both ways (case 53); bounces off a wall that only pushes (case 54).

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/stiff_contact/model.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

namespace {

/// The larger root of x^2 - trace x + determinant, for the one-step matrices that docs/stiff_contact.md writes down.
double spectral_radius(Scheme scheme, double zeta, double step) {
  const double damp = 2 * zeta * step, square = step * step;
  double trace = 2 - damp, determinant = 1 - damp + square;  // explicit
  if (scheme == Scheme::semi_implicit) {
    trace = 2 - square - damp;
    determinant = 1 - damp;
  } else if (scheme == Scheme::implicit_euler) {
    determinant = 1 / (1 + damp + square);
    trace = (2 + damp) * determinant;
  }
  const std::complex<double> root = std::sqrt(std::complex<double>(trace * trace / 4 - determinant));
  return std::max(std::abs(trace / 2 + root), std::abs(trace / 2 - root));
}

const std::vector<double> ratios = {0, 0.01, 0.1, 0.5, 0.9, 1, 1.1, 2, 10, 100};

TEST(StiffTheory, an_eigenvalue_leaves_the_unit_circle_at_the_limit) {
  for (const Scheme scheme : {Scheme::explicit_euler, Scheme::semi_implicit}) {
    for (const double zeta : ratios) {
      const double limit = *step_limit(scheme, zeta);
      if (limit > 0) {
        EXPECT_LE(spectral_radius(scheme, zeta, 0.999 * limit), 1 + 1e-12) << name(scheme) << " " << zeta;
      }
      EXPECT_GT(spectral_radius(scheme, zeta, 1.001 * limit + 1e-3), 1 + 1e-7) << name(scheme) << " " << zeta;
    }
  }
}

TEST(StiffTheory, implicit_euler_has_no_limit) {
  for (const double zeta : ratios) {
    EXPECT_FALSE(step_limit(Scheme::implicit_euler, zeta));
    for (const double step : {1e-3, 1.0, 1e3, 1e6}) {
      EXPECT_LT(spectral_radius(Scheme::implicit_euler, zeta, step), 1) << zeta << " " << step;
    }
  }
}

TEST(StiffTheory, limits_have_the_values_of_the_formula) {
  EXPECT_EQ(step_limit(Scheme::explicit_euler, 0), 0);
  EXPECT_EQ(step_limit(Scheme::explicit_euler, 0.25), 0.5);
  EXPECT_EQ(step_limit(Scheme::explicit_euler, 1), 2);
  EXPECT_NEAR(*step_limit(Scheme::explicit_euler, 1.25), 1, 1e-15);  // 2 (1.25 - 0.75)
  EXPECT_EQ(step_limit(Scheme::semi_implicit, 0), 2);
  EXPECT_NEAR(*step_limit(Scheme::semi_implicit, 0.75), 1, 1e-15);               // 2 (1.25 - 0.75)
  for (const Scheme scheme : {Scheme::explicit_euler, Scheme::semi_implicit}) {  // no digit is lost far out
    EXPECT_NEAR(*step_limit(scheme, 1e8) * 1e8, 1, 1e-15);
  }
}

/// The oscillation with classical Runge-Kutta until the wall would pull: what a bounce is in continuous time.
struct Slow {
  double speed, depth;
};
Slow slow_bounce(double zeta) {
  const auto acceleration = [&](double x, double v) { return -x - 2 * zeta * v; };
  const double h = 1e-4;
  double x = 0, v = 1;
  Slow result = {0, 0};
  while (x + 2 * zeta * v >= 0) {
    const double v1 = v, a1 = acceleration(x, v);
    const double v2 = v + h / 2 * a1, a2 = acceleration(x + h / 2 * v1, v2);
    const double v3 = v + h / 2 * a2, a3 = acceleration(x + h / 2 * v2, v3);
    const double v4 = v + h * a3, a4 = acceleration(x + h * v3, v4);
    x += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    result.depth = std::max(result.depth, x);
  }
  result.speed = -v;
  return result;
}

TEST(StiffTheory, restitution_and_depth_are_those_of_continuous_time) {
  for (const double zeta : {0.0, 0.1, 0.5, 0.99, 1.0, 1.01, 3.0}) {
    const Slow slow = slow_bounce(zeta);
    EXPECT_NEAR(restitution(zeta), slow.speed, 1e-7) << zeta;
    EXPECT_NEAR(deepest(zeta), slow.depth, 1e-7) << zeta;
  }
  EXPECT_EQ(restitution(0), 1);
  EXPECT_NEAR(restitution(1), std::exp(-2), 1e-15);
  EXPECT_NEAR(restitution(1 + 1e-9), restitution(1 - 1e-9), 1e-8);
  EXPECT_NEAR(restitution(1e4) * 4e8, 1, 1e-6);  // 1 / (2 zeta)^2
}

TEST(StiffTheory, bounds_end_where_stability_does) {
  EXPECT_FALSE(bounce_bounds(2));
  EXPECT_FALSE(bounce_bounds(1e6));
  EXPECT_NEAR(bounce_bounds(1.2)->lower, 0.8, 1e-15);
  EXPECT_NEAR(bounce_bounds(1.2)->upper, 1.25, 1e-15);
}

// Growth, measured: against stepping, and against the limits.

/// The largest of |sqrt(k) depth| and |sqrt(m) speed| after each step from one of the unit states; up to `last` steps.
std::int64_t stepped_until(Scheme scheme, const Spring& s, double step, double bound, std::int64_t last) {
  const double depth_unit = 1 / std::sqrt(s.stiffness), speed_unit = 1 / std::sqrt(s.mass);
  Motion a = {depth_unit, 0}, b = {0, speed_unit};
  for (std::int64_t n = 1; n <= last; ++n) {
    a = stepped(scheme, s, step, a);
    b = stepped(scheme, s, step, b);
    const double largest = std::max({std::abs(a.depth) / depth_unit, std::abs(b.depth) / depth_unit,
                                     std::abs(a.speed) / speed_unit, std::abs(b.speed) / speed_unit});
    if (!(largest < bound)) return n;
  }
  return 0;
}

TEST(StiffGrowth, case_53_the_limits_lie_in_their_brackets) {
  for (const Scheme scheme : all_schemes) {
    for (const double stiffness : {1.0, 1e5, 1e10}) {
      for (const double zeta : {0.0, 1e-5, 1e-3, 0.1, 0.5, 0.9, 1.0, 1.1, 3.0, 1e3, 1e5}) {
        const auto [stable, unstable] = measured_limit(scheme, spring_of(2, stiffness, zeta));
        const auto limit = step_limit(scheme, zeta);
        if (!limit) {
          EXPECT_TRUE(std::isinf(unstable)) << zeta;
          continue;
        }
        EXPECT_LE(stable, *limit) << name(scheme) << " " << stiffness << " " << zeta;
        EXPECT_GE(unstable, *limit) << name(scheme) << " " << stiffness << " " << zeta;
        if (*limit > 0) {
          EXPECT_LT(unstable, 1.001 * stable) << name(scheme) << " " << zeta;
        }
      }
    }
  }
}

/// An undamped explicit step grows always: by half of step^2.
TEST(StiffGrowth, undamped_explicit_grows_at_the_least_step_that_is_tried) {
  const auto [stable, unstable] = measured_limit(Scheme::explicit_euler, spring_of(1, 1e4, 0));
  EXPECT_EQ(stable, 0);
  EXPECT_EQ(unstable, 0x1p-14);
}

TEST(StiffGrowth, powers_are_what_stepping_gives) {
  for (const Scheme scheme : all_schemes) {
    for (const double zeta : {0.0, 0.1, 2.0}) {
      for (const double step : {0.05, 0.4, 1.9, 2.1, 30.0}) {
        const Spring spring = spring_of(3, 1e6, zeta);
        const double seconds = step / frequency(spring);
        const std::int64_t stepped = stepped_until(scheme, spring, seconds, 0x1p32, 20000);
        const auto found = blow_up_step(scheme, spring, seconds);
        EXPECT_EQ(found.has_value(), fate(scheme, spring, seconds) == Fate::grows);
        if (stepped == 0) {
          EXPECT_TRUE(!found || *found > 20000) << name(scheme) << " " << zeta << " " << step;
          continue;
        }
        ASSERT_TRUE(found);
        EXPECT_GE(*found, stepped) << name(scheme) << " " << zeta << " " << step;
        EXPECT_LE(static_cast<double>(*found - stepped), 10 / std::min(step, 1.0)) << name(scheme) << " " << zeta;
      }
    }
  }
}

TEST(StiffGrowth, a_state_decays_below_the_limit_and_grows_above) {
  const auto fate_at = [](double step, double zeta) {
    const Spring spring = spring_of(1, 1e8, zeta);
    return fate(Scheme::semi_implicit, spring, step / frequency(spring));
  };
  EXPECT_EQ(fate_at(1.8, 0.1), Fate::decays);
  EXPECT_EQ(fate_at(1.82, 0.1), Fate::grows);
  EXPECT_EQ(fate_at(1.99, 0), Fate::holds);
  EXPECT_EQ(fate_at(2.01, 0), Fate::grows);
  // At h omega = 1 and zeta = 1/2 two semi-implicit steps make nothing of anything.
  EXPECT_EQ(fate(Scheme::semi_implicit, spring_of(1, 1, 0.5), 1), Fate::decays);
}

TEST(StiffGrowth, nothing_overflows) {
  for (const double stiffness : {1e-12, 1e18}) {
    for (const double mass : {1e-12, 1e12}) {
      const Interval bracket = measured_limit(Scheme::semi_implicit, spring_of(mass, stiffness, 0.5));
      EXPECT_NEAR(bracket.upper, *step_limit(Scheme::semi_implicit, 0.5), 1e-4);
      const Spring spring = spring_of(mass, stiffness, 1e5);
      EXPECT_EQ(blow_up_step(Scheme::semi_implicit, spring, 1e6 / frequency(spring)), 1);
    }
  }
}

// Energy, what splitting the step changes, and who gets through.

constexpr Approach usual = {.mass = 1, .speed = 10, .radius = 0.05, .thickness = 0.02, .blow_up = 10};

PenaltyContact contact_by(Scheme scheme, Detection detection, double step, double zeta = 0, double stiffness = 1e10) {
  return {{scheme, stiffness, zeta}, detection, step};
}
PenaltyContact discrete(Scheme scheme, double step, double zeta = 0) {
  return contact_by(scheme, Detection::discrete, step, zeta);
}
PenaltyContact split(Scheme scheme, double step, double zeta = 0) {
  return contact_by(scheme, Detection::toi_split, step, zeta);
}

struct SpeedRange {
  double least = 1e300, most = 0;
};

SpeedRange speeds(const PenaltyContact& contact, int phases) {
  SpeedRange range;
  for (int i = 0; i < phases; ++i) {
    const Bounce b = bounce(usual, contact, static_cast<double>(i) / phases);
    EXPECT_EQ(b.ending, Ending::returned);
    range.least = std::min(range.least, b.speed);
    range.most = std::max(range.most, b.speed);
  }
  return range;
}

TEST(StiffBounce, case_54_linear_stability_is_not_enough) {
  struct Case {
    double step, least, most, allowed;
  };
  for (const Case& c : {Case{0.3, 0.989, 1.011, 5e-4}, Case{1.5, 0.80, 1.25, 5e-3},
                        Case{1.9, 0.38, 2.61, 5e-3}}) {  // z^2 - 1: a whole path deep, one step throws the ball out
    const SpeedRange range = speeds(discrete(Scheme::semi_implicit, c.step), 2000);
    EXPECT_NEAR(range.least, c.least, c.allowed) << c.step;
    EXPECT_NEAR(range.most, c.most, c.allowed) << c.step;
  }
}

TEST(StiffBounce, the_bounds_hold_and_are_nearly_reached) {
  for (const double step : {0.1, 0.3, 0.77, 1.3, 1.7, 1.99}) {
    const Interval bounds = *bounce_bounds(step);
    const SpeedRange range = speeds(discrete(Scheme::semi_implicit, step), 500);
    EXPECT_GE(range.least, bounds.lower - 1e-9) << step;
    EXPECT_LE(range.most, bounds.upper + 1e-9) << step;
    if (step == 0.1) {
      EXPECT_NEAR((1 - range.least) / (1 - bounds.lower), 1, 0.05);
    }
  }
}

/// Explicit steps gain about pi z / 2, implicit ones lose it, semi-implicit ones neither.
TEST(StiffBounce, errors_shrink_with_the_step_as_the_schemes_order_says) {
  const auto error = [](Scheme scheme, double step) {
    return bounce_all(usual, discrete(scheme, step), 1, 50).mean_speed() - 1;
  };
  EXPECT_NEAR(error(Scheme::explicit_euler, 0.01), 0.01 * std::acos(-1) / 2, 3e-4);
  EXPECT_NEAR(error(Scheme::implicit_euler, 0.01), -0.01 * std::acos(-1) / 2, 3e-4);
  const auto rms = [](double step) {
    return bounce_all(usual, discrete(Scheme::semi_implicit, step), 1, 200).rms_error();
  };
  EXPECT_LT(rms(0.02), 1e-4);
  EXPECT_NEAR(std::log2(rms(0.03) / rms(0.015)), 2, 1);
}

TEST(StiffBounce, goes_over_into_continuous_time) {
  for (const Scheme scheme : all_schemes) {
    for (const Detection detection : all_detections) {
      for (const double zeta : {0.1, 0.5, 1.5}) {
        const ContactTally t = bounce_all(usual, contact_by(scheme, detection, 0.003, zeta), 1, 10);
        EXPECT_EQ(t.returned, 10);
        EXPECT_NEAR(t.mean_speed(), restitution(zeta), 0.01) << name(scheme) << " " << name(detection) << " " << zeta;
        EXPECT_NEAR(t.deepest * 1e5 / 10, deepest(zeta), 0.02) << name(scheme) << " " << name(detection) << " " << zeta;
      }
    }
  }
}

/// The spring is relaxed at first touch, so it does not push there.
TEST(StiffBounce, splitting_an_undamped_explicit_or_semi_implicit_step_changes_nothing) {
  for (const Scheme scheme : {Scheme::explicit_euler, Scheme::semi_implicit}) {
    for (const double step : {0.1, 0.77, 1.9, 5.0}) {
      for (const double phase : {0.1, 0.5, 0.93}) {
        const Bounce at_poses = bounce(usual, discrete(scheme, step), phase);
        const Bounce at_impact = bounce(usual, split(scheme, step), phase);
        EXPECT_NEAR(at_impact.speed / at_poses.speed, 1, 1e-9) << name(scheme) << " " << step;
        EXPECT_EQ(at_impact.contact_steps, at_poses.contact_steps + 1);
      }
    }
  }
}

/// ... and what splitting is good for: less depends on the phase, and the ball goes less deep.
TEST(StiffBounce, splitting_a_damped_step_takes_away_most_of_the_phase) {
  for (const Scheme scheme : all_schemes) {
    const SpeedRange at_poses = speeds(discrete(scheme, 0.1, 0.5), 100);
    const SpeedRange at_impact = speeds(split(scheme, 0.1, 0.5), 100);
    EXPECT_LT(at_impact.most - at_impact.least, (at_poses.most - at_poses.least) / 10) << name(scheme);
  }
}

/// The failure is specified too: 100 paths from front to middle, and the ball is out on the other side.
TEST(StiffBounce, long_steps_tunnel_unless_the_rest_of_a_split_step_is_implicit) {
  const double step = 100 * usual.reach() / usual.speed * 1e5;
  for (const double phase : {0.1, 0.5, 0.93}) {
    for (const Scheme scheme : all_schemes) {
      EXPECT_EQ(bounce(usual, discrete(scheme, step), phase).ending, Ending::escaped);
    }
    EXPECT_EQ(bounce(usual, split(Scheme::semi_implicit, step), phase).ending, Ending::escaped);
    EXPECT_EQ(bounce(usual, split(Scheme::implicit_euler, step), phase).ending, Ending::returned);
  }
}

TEST(StiffBounce, a_soft_wall_lets_the_ball_through_at_any_step) {
  for (const Scheme scheme : all_schemes) {
    EXPECT_EQ(bounce(usual, contact_by(scheme, Detection::toi_split, 0.05, 0, 100), 0.5).ending, Ending::escaped);
  }
}

TEST(StiffBounce, blow_up_is_reported_at_the_step_where_it_happens) {
  const Bounce fast = bounce(usual, discrete(Scheme::semi_implicit, 100), 0.5);
  EXPECT_EQ(fast.blow_up_step, 2);  // the first step enters, the second throws it out
  EXPECT_GT(fast.speed, 1000);
  EXPECT_EQ(bounce(usual, discrete(Scheme::semi_implicit, 1), 0.5).blow_up_step, 0);
}

/// Thrown back from the far side and the near side in turn, faster each time, until numbers end.
TEST(StiffBounce, never_gives_a_number_that_is_none) {
  for (const Scheme scheme : all_schemes) {
    for (const Detection detection : all_detections) {
      for (const double zeta : {0.0, 0.1, 0.5, 1.0, 100.0}) {
        for (const double step : {0.1, 1.0, 3.0, 30.0, 1e4, 1e6}) {
          for (const double stiffness : {1.0, 1e4, 1e10}) {
            const ContactTally t = bounce_all(usual, contact_by(scheme, detection, step, zeta, stiffness), 1, 3);
            EXPECT_EQ(t.bounces(), 3);
            EXPECT_TRUE(std::isfinite(t.speed_sum));
            if (t.returned > 0) {
              EXPECT_TRUE(std::isfinite(t.fastest) && std::isfinite(t.deepest));
            }
          }
        }
      }
    }
  }
}

/// At 2 zeta h omega = 1 the damper stops a ball that just touches: the second step finds nothing to do.
TEST(StiffBounce, a_ball_that_rests_at_the_wall_ends_the_run) {
  const Bounce b = bounce(usual, discrete(Scheme::semi_implicit, 1, 0.5), 0);
  EXPECT_EQ(b.ending, Ending::unfinished);
  EXPECT_EQ(b.speed, 0);
  EXPECT_EQ(b.contact_steps, 2);
}

TEST(StiffBounce, walls_and_balls_may_be_thin) {
  for (const Approach thin : {Approach{1, 10, 0, 0.02, 10}, Approach{1, 10, 0.05, 0, 10}}) {
    EXPECT_EQ(bounce(thin, discrete(Scheme::semi_implicit, 0.3), 0.5).ending, Ending::returned);
    EXPECT_EQ(bounce(thin, split(Scheme::implicit_euler, 1e4), 0.5).ending, Ending::returned);
  }
}

// ---- The stiff contact's settings and answers, and whether a wrong theory would be noticed.

template <class Result> std::vector<Result> computed(const std::vector<Task<Result>>& tasks) {
  std::vector<Result> results;
  for (const Task<Result>& task : tasks) results.push_back(task.compute());
  return results;
}

StiffResults measured_small() {
  const Settings settings(small_toml("stiff_contact"), "test.toml", stiff_contact_experiment().default_toml);
  const auto plan = std::make_shared<const StiffPlan>(make_stiff_plan(settings, {.seed = 1, .trials = {}}));
  const StiffTasks tasks = stiff_tasks(plan);
  return {*plan, computed(tasks.springs), flat(computed(tasks.walls)), {}};
}

bool passes(const StiffResults& m) { return all_passed(stiff_claims(m)); }

bool passes_with_limit(StiffResults m, Scheme scheme, const std::function<double(double ratio, double limit)>& wrong) {
  for (LimitRow& row : m.limits) {
    if (row.spring.scheme == scheme) row.theory = wrong(row.spring.damping_ratio, row.theory.value_or(0));
  }
  return passes(m);
}

TEST(StiffContact, agrees_with_theory_and_says_so) {
  const Outcome& outcome = small_outcome(stiff_contact_experiment());
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  for (const std::vector<Value>& row : table_of(outcome, "self_test").rows) {
    EXPECT_GT(std::get<std::int64_t>(row[1]), 0) << std::get<std::string>(row[0]);  // no claim is empty
  }
  for (const char* part : {"in 45 of 45 springs", "at h omega = 1.9 a semi-implicit bounce leaves with 0.3", "to 2.",
                           "because at first touch a spring does not push yet", "and 0.0 %."}) {
    EXPECT_TRUE(holds(outcome.answer, part));
  }
  for (const Table& t : outcome.tables) EXPECT_EQ(t.is_timing, t.name == "timings");
  ASSERT_EQ(outcome.figures.size(), 5U);
  EXPECT_EQ(outcome.figures[0].name, "stability");
  EXPECT_EQ(outcome.figures[0].panels.size(), 3U);
  for (const Figure& figure : outcome.figures) {
    EXPECT_EQ(figure.is_timing, figure.name == "race");
    for (const Panel& panel : figure.panels) EXPECT_FALSE(panel.series.empty()) << figure.name;
  }
}

TEST(StiffContact, fails_a_wrong_limit) {
  const StiffResults m = measured_small();
  EXPECT_TRUE(passes(m));
  const auto as_it_is = [](double, double limit) { return limit; };
  EXPECT_TRUE(passes_with_limit(m, Scheme::semi_implicit, as_it_is));
  EXPECT_FALSE(passes_with_limit(m, Scheme::semi_implicit, [](double, double limit) { return limit * 1.001; }));
  EXPECT_FALSE(passes_with_limit(m, Scheme::semi_implicit, [](double, double) { return 2.0; }));  // forgets damping
  EXPECT_FALSE(passes_with_limit(m, Scheme::semi_implicit, [](double ratio, double) {  // takes damping as implicit
    return 2 * (std::hypot(1.0, ratio) + ratio);
  }));
  EXPECT_FALSE(passes_with_limit(m, Scheme::explicit_euler, [](double ratio, double) {  // forgets overdamping
    return 2 * ratio;
  }));
  EXPECT_FALSE(passes_with_limit(m, Scheme::implicit_euler, [](double, double) { return 1e5; }));
  StiffResults vague = m;  // around the limit still, but too far to tell
  for (LimitRow& row : vague.limits) row.unstable *= 1.01;
  EXPECT_FALSE(passes(vague));
}

TEST(StiffContact, fails_a_wrong_bounce) {
  const StiffResults m = measured_small();
  const auto passes_with = [&](const std::function<void(ContactRow&)>& change) {
    StiffResults changed = m;
    for (ContactRow& row : changed.bounces) change(row);
    return passes(changed);
  };
  EXPECT_TRUE(passes_with([](ContactRow&) {}));
  EXPECT_FALSE(passes_with([](ContactRow& r) { r.tally.fastest *= 1.01; }));
  EXPECT_FALSE(passes_with([](ContactRow& r) { r.tally.slowest *= 0.99; }));
  EXPECT_FALSE(passes_with([](ContactRow& r) {  // an implicit step that gains
    if (r.contact.spring.scheme == Scheme::implicit_euler) r.tally.fastest = 1.001;
  }));
  EXPECT_FALSE(passes_with([](ContactRow& r) {  // an explicit one that loses
    if (r.contact.spring.scheme == Scheme::explicit_euler) r.tally.slowest = 0.999;
  }));
  EXPECT_FALSE(passes_with([](ContactRow& r) {  // a split that matters
    if (r.contact.detection == Detection::toi_split) r.tally.fastest *= 1 + 1e-6;
  }));
  EXPECT_FALSE(passes_with([](ContactRow& r) { r.tally.escaped = 0; }));  // nobody tunnels
  EXPECT_FALSE(passes_with([](ContactRow& r) { r.tally.escaped = 1; }));  // somebody always does
}

TEST(StiffContact, an_unstable_step_is_reported_with_the_step_where_it_blew_up) {
  const Table& map = table_of(small_outcome(stiff_contact_experiment()), "stability");
  std::size_t unstable = 0;
  for (std::size_t row = 0; row < map.rows.size(); ++row) {
    if (value_of(map, row, "verdict") != Value("unstable")) continue;
    ++unstable;
    EXPECT_GT(std::get<std::int64_t>(value_of(map, row, "blow_up_step")), 0);
  }
  EXPECT_GT(unstable, 20U);
  EXPECT_LT(unstable, map.rows.size());
}

TEST(StiffContact, answers_for_the_smallest_of_settings) {
  const Outcome outcome = outcome_of(
      stiff_contact_experiment(),
      "bounces = 1\nstiffness = [100]\ndamping_ratio = [0]\nstep = [1]\nbounce_damping = [2]\nbounce_step = [3]\n"
      "race_step = [1]\nrace_bounces = 1\nrounds = 1");
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_TRUE(holds(outcome.answer, "in 3 of 3 springs"));
}

TEST(StiffContact, refuses_what_cannot_be_asked) {
  expect_refusals(stiff_contact_experiment(), {{"mass = 0", "key 'mass'"},
                                               {"stiffness = [1, 0]", "key 'stiffness'"},
                                               {"damping_ratio = [1e-6]", "0, or 1e-05 to 100000"},
                                               {"step = [0]", "key 'step'"},
                                               {"speed = 0", "key 'speed'"},
                                               {"radius = 0\nthickness = 0", "key 'thickness'"},
                                               {"blow_up = 1", "key 'blow_up'"},
                                               {"bounce_step = [0]", "key 'bounce_step'"},
                                               {"race_step = [0]", "key 'race_step'"},
                                               {"race_step = [2.5]", "key 'race_step'"},
                                               {"bounces = 0", "key 'bounces'"},
                                               {"rounds = 0", "key 'rounds'"},
                                               {"race_bounces = 0", "key 'race_bounces'"},
                                               {"mass = 1e-12\nstiffness = [1e18]", "2^-30 of radius"}});
}

}  // namespace

}  // namespace thinwall
