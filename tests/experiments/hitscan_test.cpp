/// Runs of hitscan in memory, for its tests.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/hitscan/theory.hpp>
#include <thinwall/experiments/lab/judge.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

/// Small enough for a debug build, and still with every kind of cell: near and far, thin and thick, steep and flat.
inline constexpr std::string_view few_hitscans = R"(
  range = [3, 30]
  speed = [30, 300]
  radius = [0, 0.02]
  wind = [5]
  shots = 1000
)";

/// A cell like the default's, without the rest.
inline HitscanCell some_shot(double range, double speed, double radius) {
  return {.range = range,
          .speed = speed,
          .radius = radius,
          .wind = 5,
          .drag = 0.5,
          .step = 1.0 / 60,
          .target = 0.15,
          .gravity = 9.81,
          .aim = 1.25};
}

inline std::unique_ptr<Run> hitscan_run(std::string_view text, RunOptions options = {.seed = 1, .trials = {}}) {
  return run_of(hitscan_experiment(), text, options);
}

inline Outcome hitscan_outcome(std::string_view text) { return outcome_of(*hitscan_run(text)); }

// ---- Hitscan's answers: what the ray misses and hits falsely, how late the next frame is, and does theory agree?

namespace {

const std::vector<HitscanRule> all_rules(hitscan_rules.begin(), hitscan_rules.end());

/// The target's center, seen from a point along the row of fire at the range: upward, and to the side.
Placement target_at(const HitscanCell& c, double up, double side, double phase) {
  return {{{c.range, up, side}, c.target}, phase};
}
bool hits(const HitscanRule& rule, const HitscanCell& c, const Placement& p) { return answer_of(rule, c, p).hit; }

TEST(Hitscan, the_ray_hits_what_the_bullet_falls_short_of) {
  const HitscanCell c = some_shot(100, 300, 0.004);
  const Placement ahead = target_at(c, 0, 0, 0.3);
  ASSERT_GT(deflection(c), c.target + c.radius);
  EXPECT_FALSE(true_impact(c, ahead.target.center).touches);
  EXPECT_TRUE(hits(hitscan_ray, c, ahead));
  EXPECT_FALSE(hits(next_frame, c, ahead));
  EXPECT_FALSE(hits(swept_steps, c, ahead));
  const Vec3<double> fallen = pull_direction(c) * deflection(c);
  const Placement below = target_at(c, fallen[1], fallen[2], 0.3);
  EXPECT_TRUE(true_impact(c, below.target.center).touches);
  EXPECT_FALSE(hits(hitscan_ray, c, below));
  EXPECT_FALSE(hits(hitscan_ball, c, below));
  EXPECT_TRUE(hits(next_frame, c, below));
  EXPECT_TRUE(hits(swept_steps, c, below));
}

TEST(Hitscan, a_ray_misses_what_only_the_radius_touches) {
  const HitscanCell c = some_shot(3, 1000, 0.02);  // as good as straight
  const Placement beside = target_at(c, 0, 0.16, 0.3);
  EXPECT_TRUE(true_impact(c, beside.target.center).touches);
  EXPECT_FALSE(hits(hitscan_ray, c, beside));
  EXPECT_FALSE(hits(next_frame, c, beside));
  EXPECT_TRUE(hits(hitscan_ball, c, beside));
  EXPECT_TRUE(hits(swept_steps, c, beside));
}

/// 30 m in steps of 5 m from 1.5 m on: the center reaches the target at 29.85 m, in the step from 26.5 to 31.5 m.
TEST(Hitscan, reports_when_its_rule_says) {
  HitscanCell c = some_shot(30, 300, 0);
  c.gravity = 0;
  c.drag = 0;
  c.wind = 0;
  const Placement p = target_at(c, 0, 0, 0.7);
  const double touch = 29.85 / 300;
  EXPECT_NEAR(true_impact(c, p.target.center).time, touch, 1e-12);
  EXPECT_EQ(answer_of(hitscan_ray, c, p).time, 0);
  EXPECT_EQ(answer_of(hitscan_ball, c, p).time, 0);
  EXPECT_NEAR(answer_of(next_frame, c, p).time, 31.5 / 300, 1e-12);
  EXPECT_NEAR(answer_of(swept_steps, c, p).time, touch, 1e-12);
  for (const HitscanRule& rule : all_rules) {
    EXPECT_LT((answer_of(rule, c, p).point - Vec3<double>(29.85, 0, 0)).norm(), 1e-12) << rule.name;
  }
}

/// Head-on, without anything that pulls, an instant ray and a real bullet are the same but for time.
TEST(Hitscan, nothing_differs_where_nothing_pulls) {
  HitscanCell c = some_shot(30, 100, 0);
  c.gravity = 0;
  c.wind = 0;
  const auto tallies = shoot(all_rules, c, 1, 2000);
  for (std::size_t k = 0; k < all_rules.size(); ++k) {
    EXPECT_GT(tallies[k].touching, 1000) << all_rules[k].name;
    EXPECT_EQ(tallies[k].missed, 0) << all_rules[k].name;
    EXPECT_EQ(tallies[k].false_hits, 0) << all_rules[k].name;
    EXPECT_EQ(tallies[k].path_error.most, 0) << all_rules[k].name;
    EXPECT_LT(tallies[k].point_error.most, 1e-6) << all_rules[k].name;  // of a graze the point is worth half the digits
  }
}

TEST(Hitscan, the_next_frame_is_up_to_a_step_late) {
  HitscanCell c = some_shot(100, 1000, 0);
  c.drag = 0;
  const HitscanTally tally = shoot(std::vector{next_frame}, c, 1, 5000).front();
  const double window = contact_window(c).until - contact_window(c).from;  // a lower path enters the ball elsewhere
  EXPECT_GE(tally.lateness.least, -window);
  EXPECT_LT(tally.lateness.least, 0.01 * c.step);
  EXPECT_LE(tally.lateness.most, c.step + window);
  EXPECT_GT(tally.lateness.most, 0.99 * c.step);
  EXPECT_NEAR(tally.lateness.mean(time_unit(c)), c.step / 2, 0.03 * c.step);
}

TEST(Hitscan, agrees_with_theory_and_says_what_the_ray_misses) {
  const Outcome outcome = hitscan_outcome(few_hitscans);
  EXPECT_NE(outcome.answer.find("with a rifle at 100 m (theory 28.7 %"), std::string::npos) << outcome.answer;
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_EQ(table_of(outcome, "self_test").rows.size(), 1U + 4 * 3);
  EXPECT_EQ(table_of(outcome, "moments").rows.size(), 4U * 2);
  ASSERT_EQ(outcome.figures.size(), 3U);
  EXPECT_EQ(outcome.figures[0].panels.size(), 3U);
  EXPECT_EQ(outcome.figures[2].panels.size(), 2U);
}

/// Lines of a run that is large enough to tell theories apart.
const std::vector<HitscanRow>& measured() {
  static const std::vector<HitscanRow> rows = [] {
    const Experiment experiment = hitscan_experiment();
    const Settings settings("range = [5, 20, 100]\nspeed = [30, 300]\nradius = [0, 0.02]\nwind = [5]", "test.toml",
                            experiment.default_toml);
    const std::vector<HitscanCell> cells = make_hitscan_cells(settings);
    std::vector<std::vector<HitscanTally>> tallies;
    for (const HitscanCell& c : cells) tallies.push_back(shoot(all_rules, c, 1, 20000));
    return hitscan_rows(cells, all_rules, tallies);
  }();
  return rows;
}

using Share = std::function<double(const HitscanRow&)>;

/// Does the self-test pass if one rule's expected number is that of another theory?
bool passes(const HitscanRule& rule, double HitscanExpected::*field, const Share& theory) {
  std::vector<HitscanRow> rows = measured();
  for (HitscanRow& row : rows) {
    if (row.rule.name == rule.name) row.expected.*field = std::clamp(theory(row), 0.0, 1.0);
  }
  return all_passed(self_test(counts_of(rows)));
}

TEST(Hitscan, fails_a_wrong_theory) {
  using E = HitscanExpected;
  EXPECT_TRUE(passes(hitscan_ray, &E::missed, [](const HitscanRow& r) { return r.expected.missed; }));
  EXPECT_FALSE(passes(hitscan_ray, &E::missed, [](const HitscanRow& r) { return 0.95 * r.expected.missed; }));
  EXPECT_FALSE(passes(hitscan_ray, &E::missed, [](const HitscanRow& r) {  // forgets drag and wind
    const double time = r.cell.range / r.cell.speed;
    return r.expected.touch * flat_missed(r.cell.target, r.cell.radius, r.cell.gravity * time * time / 2);
  }));
  EXPECT_FALSE(passes(hitscan_ray, &E::missed, [](const HitscanRow& r) {  // forgets the radius
    return r.expected.touch * flat_missed(r.cell.target, 0, deflection(r.cell));
  }));
  EXPECT_FALSE(
      passes(hitscan_ray, &E::false_hits, [](const HitscanRow& r) {  // takes the target for as large as the reach
        return r.expected.reported * flat_false(r.cell.target + r.cell.radius, 0, deflection(r.cell));
      }));
  EXPECT_FALSE(passes(hitscan_ball, &E::missed, [](const HitscanRow&) { return 0; }));  // forgets that bullets fall
  EXPECT_FALSE(passes(next_frame, &E::missed, [](const HitscanRow&) { return 0; }));    // forgets the radius
  EXPECT_FALSE(passes(next_frame, &E::reported, [](const HitscanRow& r) { return r.expected.touch; }));
  EXPECT_FALSE(passes(swept_steps, &E::missed, [](const HitscanRow&) { return 0; }));  // forgets the chord
  std::vector<HitscanRow> flat = measured();
  for (HitscanRow& r : flat) r.expected.touch *= r.cell.aim * reach(r.cell) / disc_radius(r.cell);  // forgets the slope
  EXPECT_FALSE(all_passed(self_test(counts_of(flat))));
}

TEST(Hitscan, fails_wrong_errors) {
  const auto passes_with = [](const std::function<void(HitscanRow&)>& change) {
    std::vector<HitscanRow> changed = measured();
    for (HitscanRow& row : changed) change(row);
    const auto tests = moment_tests(changed);
    return std::all_of(tests.begin(), tests.end(), [](const HitscanMomentTest& t) { return t.passed(); });
  };
  EXPECT_TRUE(passes_with([](HitscanRow&) {}));
  EXPECT_FALSE(passes_with([](HitscanRow& r) { r.expected.path_error.mean *= 1.05; }));
  EXPECT_FALSE(passes_with([](HitscanRow& r) { r.expected.path_error_most *= 0.999; }));
  EXPECT_FALSE(passes_with([](HitscanRow& r) {  // forgets that the ball touches before its center
    if (r.expected.lateness) r.expected.lateness->mean = r.cell.step / 2;
  }));
  EXPECT_FALSE(passes_with([](HitscanRow& r) { r.tally.lateness.most = 2 * r.cell.step; }));
  EXPECT_FALSE(passes_with([](HitscanRow& r) { r.tally.lateness.least = -2 * contact_window(r.cell).until; }));
}

TEST(Hitscan, a_cell_keeps_its_shots_whatever_else_is_asked) {
  const Table all = table_of(hitscan_outcome(few_hitscans), "cells");
  const Table one = table_of(hitscan_outcome("range = [30]\nspeed = [300]\nradius = [0.02]\nwind = [5]\nshots = 1000\n"
                                             "rule = ['next_frame']"),
                             "cells");
  ASSERT_EQ(one.rows.size(), known_shots.size() + 1);
  for (const std::vector<Value>& row : one.rows) {
    EXPECT_NE(std::find(all.rows.begin(), all.rows.end(), row), all.rows.end());
  }
}

std::vector<HitscanCell> cells_of(const char* text) {
  const Experiment experiment = hitscan_experiment();
  return make_hitscan_cells(Settings(text, "test.toml", experiment.default_toml));
}

TEST(HitscanConfig, opens_with_the_known_shots) {
  const auto cells = cells_of("");
  for (std::size_t i = 0; i < known_shots.size(); ++i) EXPECT_EQ(cells[i], known_shots[i].cell);
}

TEST(HitscanConfig, takes_every_combination_that_arrives) {
  const std::size_t known = known_shots.size();
  EXPECT_EQ(cells_of("range = [3, 10]\nspeed = [30, 300]\nradius = [0, 0.02]\nwind = [0, 5]").size(), known + 16);
  // At half its speed a second a bullet of 30 m/s comes to rest at 60 m.
  EXPECT_EQ(cells_of("range = [3, 100]\nspeed = [30]\nradius = [0]\nwind = [0]").size(), known + 1);
  // Without drag it gets everywhere, and wind does nothing: two winds are one cell.
  const auto still = cells_of("range = [100]\nspeed = [30]\nradius = [0]\nwind = [0, 5]\ndrag = [0]");
  ASSERT_EQ(still.size(), known + 1);
  EXPECT_EQ(still.back().wind, 0);
}

/// Without the rules of the question, and without anything that pulls, there is still an answer.
TEST(HitscanConfig, answers_for_any_choice_of_rules) {
  const Outcome outcome = hitscan_outcome("rule = ['hitscan_ball']\nrange = [3]\nspeed = [30]\nshots = 20");
  EXPECT_NE(outcome.answer.find("hitscan_ball misses"), std::string::npos) << outcome.answer;
  const Outcome weightless =
      hitscan_outcome("gravity = 0\nwind = [0]\nrange = [3]\nspeed = [30]\nradius = [0]\nshots = 200");
  EXPECT_TRUE(weightless.self_test_passed) << weightless.summary;
  EXPECT_FALSE(weightless.answer.empty());
}

/// What a factor's range allows is the factor's own; this is what goes together, or not.
TEST(HitscanConfig, refuses_what_does_not_go_together) {
  struct Refusal {
    const char *text, *reason;
  };
  for (const auto& [text, reason] : {Refusal{"range = [0.2]", "more than 2 * (target + radius)"},
                                     Refusal{"target = [2]\nrange = [3]", "more than 2 * (target + radius)"},
                                     Refusal{"speed = [3]\nrange = [3]", "fast enough to fly nearly straight"},
                                     Refusal{"speed = [30]\nrange = [100]", "a range that some bullet reaches"},
                                     Refusal{"drag = [40]\nspeed = [1000]\nrange = [3]", "drag * step at most 0.5"},
                                     Refusal{"step = [1e-9]", "a path of at least 0.01"},
                                     Refusal{"rule = ['next_fram']", "did you mean 'next_frame'?"}}) {
    try {
      hitscan_run(text);
      ADD_FAILURE() << text;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }
}

// ---- Hitscan without any rule's shots: the arc against 100 digits and its equation of motion, the oracle against the arc, and limits of
// the theory that have a formula of their own.

using Wide = boost::multiprecision::cpp_bin_float_100;

/// As written down, which loses 2 log10(1 / kt) digits: few of a hundred.
template <class Real> void expect_all_digits() {
  const Real epsilon = std::numeric_limits<Real>::epsilon();
  for (const double drag : {1e-12, 1e-6, 0.01, 0.5, 0.9, 2.0, 40.0}) {
    for (const double time : {1e-9, 1e-3, 0.02, 0.3, 1.0, 1.3863, 4.0}) {
      if (drag * time > 4) continue;
      const Wide k(drag), t(time);
      const Wide tau = (1 - exp(-k * t)) / k, factor = (t - tau) / k;
      const auto error = [&](const Real& value, const Wide& truth) { return abs(Wide(value) / truth - 1); };
      const Real computed = undragged_time(Real(drag), Real(time));
      EXPECT_LT(error(computed, tau), 4 * epsilon) << drag << " " << time;
      // Of its own argument, as rounded: the last digits of tau are worth more of the time the slower the bullet.
      const Wide y = k * Wide(computed);
      EXPECT_LT(error(pull_factor(Real(drag), computed), (-log(1 - y) - y) / (k * k)), 16 * epsilon)
          << drag << " " << time;
      EXPECT_LT(error(dragged_time(Real(drag), computed), -log(1 - y) / k), 4 * epsilon) << drag << " " << time;
      EXPECT_LT(error(pull_factor(Real(drag), computed), factor), 200 * epsilon) << drag << " " << time;
    }
  }
}

TEST(HitscanArc, keeps_its_digits_in_double) { expect_all_digits<double>(); }
TEST(HitscanArc, keeps_its_digits_in_long_double) { expect_all_digits<long double>(); }

TEST(HitscanArc, without_drag_is_a_parabola) {
  const Arc<double> arc = {10, 0, 9.81};
  const auto there = after(arc, 0.5);
  EXPECT_EQ(there.x, 5);
  EXPECT_EQ(there.s, 9.81 / 8);
  EXPECT_EQ(there.vx, 10);
  EXPECT_EQ(there.vs, 9.81 / 2);
  EXPECT_EQ(time_to(arc, 5.0), 0.5);
}

struct State {
  Vec3<long double> position, velocity;
};

/// dv/dt = -k (v - wind) + gravity, by the classical fourth-order Runge-Kutta method: no closed form.
State integrated(const HitscanCell& c, double time) {
  const Vec3<long double> wind(0, 0, c.wind), gravity(0, -c.gravity, 0);
  const auto pull = [&](const Vec3<long double>& v) -> Vec3<long double> { return (wind - v) * c.drag + gravity; };
  State s = {Vec3<long double>::Zero(), Vec3<long double>(c.speed, 0, 0)};
  constexpr int steps = 4000;
  const long double h = static_cast<long double>(time) / steps;
  for (int i = 0; i < steps; ++i) {
    const Vec3<long double> v1 = s.velocity, a1 = pull(v1), v2 = v1 + a1 * (h / 2), a2 = pull(v2);
    const Vec3<long double> v3 = v1 + a2 * (h / 2), a3 = pull(v3), v4 = v1 + a3 * h, a4 = pull(v4);
    s.position += (v1 + v2 * 2 + v3 * 2 + v4) * (h / 6);
    s.velocity += (a1 + a2 * 2 + a3 * 2 + a4) * (h / 6);
  }
  return s;
}

TEST(HitscanArc, solves_the_equation_of_motion) {
  for (const HitscanCell& c : {some_shot(30, 30, 0), known_shots[1].cell, known_shots[2].cell, known_shots[3].cell}) {
    const double time = flight_time(c);
    const State truth = integrated(c, time);
    const auto there = after(arc_of<double>(c), time);
    const Vec3<double> pull = pull_direction(c);
    const Vec3<double> position = Vec3<double>(there.x, 0, 0) + pull * there.s;
    const Vec3<double> velocity = Vec3<double>(there.vx, 0, 0) + pull * there.vs;
    EXPECT_LT((position - truth.position.cast<double>()).norm(), 1e-12 * c.range) << hitscan_factors().key(c);
    EXPECT_LT((velocity - truth.velocity.cast<double>()).norm(), 1e-12 * c.speed) << hitscan_factors().key(c);
    EXPECT_NEAR(there.x, c.range, 1e-12 * c.range);
    EXPECT_NEAR(there.s, deflection(c), 1e-12 * c.range);
  }
}

/// The rule of thumb of ballistics: wind carries a bullet as far as it blows in the time that drag costs.
TEST(HitscanArc, drift_is_wind_times_lag) {
  const HitscanCell c = known_shots[1].cell;
  const double drift = deflection(c) * pull_direction(c)[2];
  EXPECT_NEAR(drift, c.wind * (flight_time(c) - c.range / c.speed), 1e-12);
}

/// The nearest the arc comes, and when it is first within reach, over fine times.
struct Scan {
  double nearest = std::numeric_limits<double>::infinity(), first = -1;
};
Scan scanned(const HitscanCell& c, const Vec3<double>& center) {
  const HitscanWindow window = contact_window(c);
  constexpr int times = 4000;
  Scan scan;
  for (int i = 0; i <= times; ++i) {
    const double t = window.from + (window.until - window.from) * i / times;
    const auto there = after(arc_of<double>(c), t);
    const double distance = (Vec3<double>(there.x, 0, 0) + pull_direction(c) * there.s - center).norm();
    scan.nearest = std::min(scan.nearest, distance);
    if (distance <= reach(c) && scan.first < 0) scan.first = t;
  }
  return scan;
}

const std::array some_cells = {some_shot(30, 30, 0.02), some_shot(50, 30, 0), some_shot(100, 1000, 0.004),
                               known_shots[2].cell, known_shots[3].cell};

TEST(HitscanOracle, agrees_with_a_scan_of_the_arc) {
  for (const HitscanCell& c : some_cells) {
    const HitscanWindow window = contact_window(c);
    const double fine = (window.until - window.from) / 4000;
    int touching = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const Vec3<double> center = random_placement(c, random_stream(c, 1), i).target.center;
      const TrueImpact truth = true_impact(c, center);
      const Scan scan = scanned(c, center);
      if (std::abs(scan.nearest - reach(c)) < 1e-6 * reach(c)) continue;  // the scan cannot tell
      ASSERT_EQ(truth.touches, scan.nearest < reach(c)) << hitscan_factors().key(c) << " " << i;
      if (!truth.touches) continue;
      ++touching;
      ASSERT_LE(truth.time, scan.first + 1e-12) << hitscan_factors().key(c);
      ASSERT_GE(truth.time, scan.first - fine - 1e-12) << hitscan_factors().key(c);
      ASSERT_NEAR((truth.bullet - center).norm(), reach(c), 1e-12 * c.range) << hitscan_factors().key(c);
      ASSERT_NEAR((contact_point(c, truth, center) - center).norm(), c.target, 1e-12 * c.range)
          << hitscan_factors().key(c);
    }
    EXPECT_GT(touching, 20) << hitscan_factors().key(c);
  }
}

/// What the bullet hits lies within the disc around the arc, also where it comes down steeply.
TEST(HitscanPlacement, draws_every_target_that_is_hit) {
  for (HitscanCell c : some_cells) {
    c.aim = 1.1;  // the least allowed
    const Vec3<double> middle = Vec3<double>(c.range, 0, 0) + pull_direction(c) * deflection(c);
    for (int i = 0; i < 360; ++i) {
      const double turn = i * (std::acos(-1.0) / 180);
      const Vec3<double> rim = Vec3<double>(0, std::cos(turn), std::sin(turn)) * disc_radius(c);
      EXPECT_FALSE(true_impact(c, middle + rim).touches) << hitscan_factors().key(c) << " " << i;
    }
  }
}

TEST(HitscanPlacement, is_uniform_over_both_discs_together) {
  const HitscanCell c = some_shot(10, 100, 0.02);  // two discs that overlap
  const double disc = disc_radius(c), apart = deflection(c);
  ASSERT_LT(apart, disc);
  const Vec3<double> second = Vec3<double>(c.range, 0, 0) + pull_direction(c) * apart;
  constexpr std::int64_t shots = 40000;
  std::int64_t in_first = 0, in_second = 0, in_both = 0, late = 0;
  for (std::int64_t i = 0; i < shots; ++i) {
    const Placement p = random_placement(c, random_stream(c, 5), static_cast<std::uint64_t>(i));
    const bool one = (p.target.center - Vec3<double>(c.range, 0, 0)).norm() <= disc;
    const bool two = (p.target.center - second).norm() <= disc;
    ASSERT_TRUE(one || two);
    in_first += one ? 1 : 0;
    in_second += two ? 1 : 0;
    in_both += one && two ? 1 : 0;
    late += p.phase >= 0.75 ? 1 : 0;
  }
  // Two equal discs: the lens is 2 r^2 acos(d / 2r) - (d / 2) sqrt(4 r^2 - d^2).
  const double circle = std::acos(-1.0) * disc * disc;
  const double lens =
      2 * disc * disc * std::acos(apart / (2 * disc)) - apart / 2 * std::sqrt(4 * disc * disc - apart * apart);
  const double all = 2 * circle - lens;
  EXPECT_TRUE(wilson(in_first, shots, 0.9999).contains(circle / all));
  EXPECT_TRUE(wilson(in_second, shots, 0.9999).contains(circle / all));
  EXPECT_TRUE(wilson(in_both, shots, 0.9999).contains(lens / all));
  EXPECT_TRUE(wilson(late, shots, 0.9999).contains(0.25));
}

TEST(HitscanShadow, of_a_straight_path_is_as_wide_as_the_ball_seen_along_it) {
  const Places level = shadow({{0, 3, 20, 3}}, 10, 2);
  ASSERT_EQ(level.size(), 1U);
  EXPECT_DOUBLE_EQ(level[0].lower, 1);
  EXPECT_DOUBLE_EQ(level[0].upper, 5);
  const Places steep = shadow({{0, 0, 20, 40}}, 10, 2);  // slope 2: 20 at the range, and sqrt(5) times as wide
  ASSERT_EQ(steep.size(), 1U);
  EXPECT_DOUBLE_EQ(steep[0].lower, 20 - 2 * std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(steep[0].upper, 20 + 2 * std::sqrt(5.0));
}

TEST(HitscanShadow, of_pieces_is_what_some_of_them_reach) {
  EXPECT_TRUE(shadow({{0, 0, 7, 0}}, 10, 2).empty());  // ends before the ball
  const Places end = shadow({{0, 0, 9, 0}}, 10, 2);    // stops on the near side of it
  ASSERT_EQ(end.size(), 1U);
  EXPECT_DOUBLE_EQ(end[0].upper, std::sqrt(3.0));
  const Places apart = shadow({{0, 0, 20, 0}, {0, 5, 20, 5}}, 10, 2);
  EXPECT_EQ(apart.size(), 2U);
  EXPECT_DOUBLE_EQ(length(apart), 8);
  const Places merged = shadow({{0, 3, 20, 3}, {0, 0, 20, 0}}, 10, 2);
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_DOUBLE_EQ(length(merged), 7);
  EXPECT_DOUBLE_EQ(length(common(apart, merged)), 4 + 2);
}

TEST(HitscanShadow, lens_has_its_limits) {
  const double pi = std::numbers::pi;
  EXPECT_EQ(lens_area(1, 2, 3), 0);
  EXPECT_DOUBLE_EQ(lens_area(1, 2, 1), pi);
  EXPECT_DOUBLE_EQ(lens_area(2, 1, 0), pi);
  EXPECT_DOUBLE_EQ(lens_area(1, 1, 1), 2 * pi / 3 - std::sqrt(3.0) / 2);
  // A disc of radius 1 whose center is on the rim of one of radius sqrt(2) a right angle wide.
  EXPECT_NEAR(lens_area(1, std::sqrt(2.0), 1), pi / 2 + (pi / 4 * 2 - 1), 1e-14);
  EXPECT_DOUBLE_EQ(lens_area(1, 2, 2.5), lens_area(2, 1, 2.5));
}

TEST(HitscanTheory, is_a_lens_in_flat_fire) {
  for (const double radius : {0.0, 0.004, 0.02}) {
    for (const double range : {10.0, 100.0, 200.0}) {
      const HitscanCell c = some_shot(range, 1000, radius);
      const HitscanExpected e = expected_of(hitscan_ray, c);
      const double off = deflection(c);
      EXPECT_NEAR(e.missed / e.touch, flat_missed(c.target, radius, off), 1e-4) << hitscan_factors().key(c);
      EXPECT_NEAR(e.false_hits / e.reported, flat_false(c.target, radius, off), 1e-4) << hitscan_factors().key(c);
      EXPECT_NEAR(e.touch / e.reported, std::pow(reach(c) / c.target, 2), 1e-4) << hitscan_factors().key(c);
    }
  }
}

/// Down a slope of a, the ball's shadow is sqrt(1 + a^2) times as wide.
TEST(HitscanTheory, sees_how_steeply_the_bullet_comes_down) {
  const HitscanCell c = {100, 30, 0.02, 0, 0, 1.0 / 60, 0.15, 9.81, 1.25};
  const double slope = 9.81 * (100.0 / 30) / 30;
  const HitscanExpected e = expected_of(hitscan_ray, c);
  EXPECT_NEAR(e.touch / e.reported, std::pow(reach(c) / c.target, 2) * std::hypot(1, slope), 1e-3);
  EXPECT_GT(slope, 1);
}

TEST(HitscanTheory, nothing_is_wrong_where_nothing_pulls) {
  HitscanCell c = some_shot(30, 100, 0);
  c.gravity = 0;
  c.wind = 0;
  for (const HitscanRule& rule : {hitscan_ray, hitscan_ball, next_frame, swept_steps}) {
    const HitscanExpected e = expected_of(rule, c);
    EXPECT_NEAR(e.missed, 0, 1e-12) << rule.name;
    EXPECT_NEAR(e.false_hits, 0, 1e-12) << rule.name;
    EXPECT_EQ(e.path_error_most, 0) << rule.name;
  }
}

/// Seen from the start of a step the bullet falls a h^2 / 2 in it: a third of that on average, a sixth from the chord.
TEST(HitscanTheory, path_errors_without_drag_have_formulas) {
  HitscanCell c = some_shot(30, 100, 0);
  c.drag = 0;
  const double fall = 9.81 * c.step * c.step;
  const auto ray = expected_of(hitscan_ray, c), tangent = expected_of(next_frame, c),
             chord = expected_of(swept_steps, c);
  EXPECT_NEAR(ray.path_error.mean, 9.81 * 0.3 * 0.3 / 2, 1e-12);
  EXPECT_EQ(ray.path_error.sigma, 0);
  EXPECT_NEAR(tangent.path_error.mean, fall / 6, 1e-5 * fall);
  EXPECT_NEAR(tangent.path_error.sigma, fall / std::sqrt(45.0), 1e-5 * fall);
  EXPECT_NEAR(tangent.path_error_most, fall / 2, 1e-12 * fall);
  EXPECT_NEAR(chord.path_error.mean, fall / 12, 1e-5 * fall);
  EXPECT_NEAR(chord.path_error.sigma, fall / std::sqrt(720.0), 1e-5 * fall);
  EXPECT_NEAR(chord.path_error_most, fall / 8, 1e-12 * fall);
}

/// Two equal discs little apart: what the one has and the other has not is 2 / (pi R) of that distance. Wherever in a
/// step the target is: few steps are flown.
TEST(HitscanTheory, steps_miss_by_their_path_error) {
  for (const double range : {50.0, 57.0, 63.0, 77.0, 100.0}) {
    const HitscanCell c = some_shot(range, 1000, 0);
    for (const HitscanRule& rule : {next_frame, swept_steps}) {
      const HitscanExpected e = expected_of(rule, c);
      const double share = 2 / std::numbers::pi * e.path_error.mean / c.target;
      EXPECT_NEAR(e.missed / e.touch, share, 0.01 * share) << rule.name << " " << range;
      EXPECT_NEAR(e.false_hits / e.reported, share, 0.01 * share) << rule.name << " " << range;
    }
  }
}

TEST(HitscanTheory, a_point_is_reported_half_a_step_late_and_a_ball_later) {
  HitscanCell c = some_shot(100, 1000, 0);
  c.drag = 0;
  const auto point = expected_of(next_frame, c).lateness;
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->mean / c.step, 0.5, 1e-3);
  EXPECT_NEAR(point->sigma / c.step, 1 / std::sqrt(12.0), 1e-3);
  // Mean chord to the center's entry less that to the ball's, over a disc: (2 / 3) (R^3 - (R^2 - T^2)^(3/2)) / T^2 - 2 T / 3.
  c.radius = 0.1;
  const double t = c.target, r = reach(c);
  const double ahead = 2.0 / 3 * (r * r * r - std::pow(r * r - t * t, 1.5)) / (t * t) - 2.0 / 3 * t;
  EXPECT_NEAR(expected_of(next_frame, c).lateness->mean - point->mean, ahead / c.speed, 0.01 * ahead / c.speed);
  EXPECT_FALSE(expected_of(swept_steps, c).lateness);
}

TEST(HitscanTheory, finds_the_range_of_a_share) {
  const HitscanCell c = some_shot(10, 300, 0);
  for (const double share : {0.05, 0.5}) {
    const auto range = range_of_missed(c, share);
    ASSERT_TRUE(range);
    EXPECT_NEAR(flat_missed(c.target, 0, at_distance(arc_of<double>(c), *range).s), share, 1e-9);
  }
  HitscanCell weightless = c;
  weightless.gravity = 0;
  weightless.wind = 0;
  EXPECT_FALSE(range_of_missed(weightless, 0.5));
  HitscanCell slow = c;
  slow.drag = 100;  // comes to rest within 3 m, after falling little
  EXPECT_FALSE(range_of_missed(slow, 0.5));
}

}  // namespace

}  // namespace thinwall
