/// Hitscan: what the ray misses and hits falsely, how late the next frame is, and does theory agree?

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/hitscan/model.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

namespace {

/// A cell like the default's, without the rest.
HitscanCell some_shot(double range, double speed, double radius) {
  return {range, speed, radius, 5, 0.5, 1.0 / 60, 0.15, 9.81, 1.25};
}
HitscanCell weightless(HitscanCell c) {
  c.gravity = c.wind = 0;
  return c;
}
HitscanCell without_drag(HitscanCell c) {
  c.drag = c.wind = 0;
  return c;
}

std::vector<HitscanCell> cells_of(const char* text) {
  return make_hitscan_cells(Settings(text, "test.toml", hitscan_experiment().default_toml));
}

/// Whether the bullet touches a target at `center` across the line of fire, and what each rule says.
std::vector<bool> hits_at(const HitscanCell& c, const Vec3<double>& center) {
  const Vec3<double> there = center + Vec3<double>(c.range, 0, 0);
  std::vector<bool> hits = {true_impact(c, there).has_value()};
  for (const HitscanRule& rule : hitscan_rules) hits.push_back(answer_of(rule, c, {{there, c.target}, 0.3}).hit);
  return hits;
}

TEST(Hitscan, every_rule_hits_where_its_path_leads) {
  const HitscanCell far = some_shot(100, 300, 0.004), straight = some_shot(3, 1000, 0.02);
  ASSERT_GT(deflection(far), reach(far));
  using Hits = std::vector<bool>;  // truly, hitscan, hitscan_ball, next_frame, swept_steps
  EXPECT_EQ(hits_at(far, {0, 0, 0}), (Hits{false, true, true, false, false}));
  EXPECT_EQ(hits_at(far, pull_direction(far) * deflection(far)), (Hits{true, false, false, true, true}));
  EXPECT_EQ(hits_at(straight, {0, 0, 0.16}), (Hits{true, false, true, false, true}));  // what only the radius touches
}

/// 30 m in steps of 5 m from 1.5 m on: the center reaches the target at 29.85 m, in the step from 26.5 to 31.5 m.
TEST(Hitscan, reports_when_its_rule_says) {
  const HitscanCell c = without_drag(weightless(some_shot(30, 300, 0)));
  const Placement p = {{{c.range, 0, 0}, c.target}, 0.7};
  const double touch = 29.85 / 300;
  EXPECT_NEAR(true_impact(c, p.target.center)->time, touch, 1e-12);
  const std::array reported = {0.0, 0.0, 31.5 / 300, touch};
  for (std::size_t k = 0; k < hitscan_rules.size(); ++k) {
    const HitscanAnswer answer = answer_of(hitscan_rules[k], c, p);
    EXPECT_NEAR(answer.time, reported[k], 1e-12) << hitscan_rules[k].name;
    EXPECT_LT((answer.point - Vec3<double>(29.85, 0, 0)).norm(), 1e-12) << hitscan_rules[k].name;
  }
}

/// Head-on, without anything that pulls, an instant ray and a real bullet are the same but for time.
TEST(Hitscan, nothing_differs_where_nothing_pulls) {
  const HitscanCell c = weightless(some_shot(30, 100, 0));
  const auto tallies = shoot(hitscan_rules, c, 1, 2000);
  for (std::size_t k = 0; k < hitscan_rules.size(); ++k) {
    SCOPED_TRACE(hitscan_rules[k].name);
    EXPECT_GT(tallies[k].touching, 1000);
    EXPECT_EQ(tallies[k].missed, 0);
    EXPECT_EQ(tallies[k].false_hits, 0);
    EXPECT_EQ(tallies[k].path_error.most, 0);
    EXPECT_LT(tallies[k].point_error.most, 1e-6);  // of a graze the point is worth half the digits
    const HitscanExpected e = expected_of(hitscan_rules[k], c);
    EXPECT_NEAR(e.missed, 0, 1e-12);
    EXPECT_NEAR(e.false_hits, 0, 1e-12);
    EXPECT_EQ(e.path_error_possible.upper, 0);
  }
  const HitscanCell thick = weightless(some_shot(30, 100, 0.02));  // both know where on the target a ball touches it
  EXPECT_LT(shoot({hitscan_ball}, thick, 1, 2000)[0].point_error.most, 1e-6);
}

TEST(Hitscan, agrees_with_theory_and_says_what_the_ray_misses) {
  const Outcome& outcome = small_outcome(hitscan_experiment());
  EXPECT_NE(outcome.answer.find("with a rifle at 100 m (theory 28.7 %"), std::string::npos) << outcome.answer;
  ASSERT_EQ(outcome.figures.size(), 3U);
  EXPECT_EQ(outcome.figures[0].panels.size(), 3U);
  EXPECT_EQ(outcome.figures[2].panels.size(), 2U);
}

/// Do the self-tests pass of a run that is large enough to tell theories apart, its rows changed?
bool pass_with(const std::function<void(HitscanRow&)>& change) {
  static const std::vector<HitscanRow> measured = [] {
    const auto cells = cells_of("range = [5, 20, 100]\nspeed = [30, 300]\nradius = [0, 0.02]\nwind = [5]");
    std::vector<HitscanRow> all;
    for (const HitscanCell& c : cells) {
      const auto tallies = shoot(hitscan_rules, c, 1, 20000);
      for (std::size_t k = 0; k < tallies.size(); ++k) all.push_back({c, hitscan_rules[k], tallies[k]});
    }
    return all;
  }();
  std::vector<HitscanRow> rows = measured;
  for (HitscanRow& row : rows) change(row);
  return all_passed(self_test(counts_of(rows))) && all_passed(moment_tests(rows));
}

/// If one rule's expected number is that of another theory?
bool passes(const HitscanRule& rule, double HitscanExpected::*field, double (*theory)(const HitscanRow&)) {
  return pass_with([&](HitscanRow& row) {
    if (row.rule.name == rule.name) row.expected.*field = std::clamp(theory(row), 0.0, 1.0);
  });
}

TEST(Hitscan, fails_a_wrong_theory) {
  using E = HitscanExpected;
  using R = HitscanRow;
  const auto none = [](const R&) { return 0.0; };
  EXPECT_TRUE(pass_with([](R&) {}));
  EXPECT_FALSE(passes(hitscan_ray, &E::missed, [](const R& r) { return 0.95 * r.expected.missed; }));
  EXPECT_FALSE(passes(hitscan_ray, &E::missed, [](const R& r) {  // forgets drag and wind
    const double time = r.cell.range / r.cell.speed;
    return r.expected.touch * flat_missed(r.cell.target, r.cell.radius, r.cell.gravity * time * time / 2);
  }));
  EXPECT_FALSE(passes(hitscan_ray, &E::missed, [](const R& r) {  // forgets the radius
    return r.expected.touch * flat_missed(r.cell.target, 0, deflection(r.cell));
  }));
  EXPECT_FALSE(passes(hitscan_ray, &E::false_hits, [](const R& r) {  // takes the target for as large as the reach
    return r.expected.reported * flat_false(reach(r.cell), 0, deflection(r.cell));
  }));
  EXPECT_FALSE(passes(hitscan_ball, &E::missed, none));  // forgets that bullets fall
  EXPECT_FALSE(passes(next_frame, &E::missed, none));    // forgets the radius
  EXPECT_FALSE(passes(next_frame, &E::reported, [](const R& r) { return r.expected.touch; }));
  EXPECT_FALSE(passes(swept_steps, &E::missed, none));  // forgets the chord
  EXPECT_FALSE(pass_with([](R& r) {                     // forgets the slope
    r.expected.touch *= r.cell.aim * reach(r.cell) / disc_radius(r.cell);
  }));
  EXPECT_FALSE(pass_with([](R& r) { r.expected.path_error.mean *= 1.05; }));
  EXPECT_FALSE(pass_with([](R& r) { r.expected.path_error_possible.upper *= 0.999; }));
  EXPECT_FALSE(pass_with([](R& r) {  // forgets that the ball touches before its center
    if (r.expected.lateness) r.expected.lateness->mean = r.cell.step / 2;
  }));
  EXPECT_FALSE(pass_with([](R& r) { r.tally.lateness.most = 2 * r.cell.step; }));
  EXPECT_FALSE(pass_with([](R& r) { r.tally.lateness.least = -2 * contact_window(r.cell).upper; }));
}

TEST(Hitscan, fails_a_wrong_count_whose_moments_are_right) {
  const auto run = run_of(hitscan_experiment(), "rule = ['hitscan']\nrange = [3]\nspeed = [30]\nshots = 200");
  std::vector<std::string> results = results_of(run->units());
  auto tallies = from_text<std::vector<HitscanTally>>(results[0]);
  tallies[0].missed = tallies[0].touching;
  results[0] = to_text(tallies);
  EXPECT_FALSE(run->finish(results, std::vector<double>(results.size(), 1)).self_test_passed);
}

TEST(HitscanConfig, takes_the_known_shots_and_every_combination_that_arrives) {
  const std::size_t known = known_shots.size();
  const auto cells = cells_of("range = [3, 10]\nspeed = [30, 300]\nradius = [0, 0.02]\nwind = [0, 5]");
  EXPECT_EQ(cells.size(), known + 16);
  for (std::size_t i = 0; i < known; ++i) EXPECT_EQ(cells[i], known_shots[i].cell);
  // At half its speed a second a bullet of 30 m/s comes to rest at 60 m.
  EXPECT_EQ(cells_of("range = [3, 100]\nspeed = [30]\nradius = [0]\nwind = [0]").size(), known + 1);
  // Without drag it gets everywhere, and wind does nothing: two winds are one cell.
  const auto still = cells_of("range = [100]\nspeed = [30]\nradius = [0]\nwind = [0, 5]\ndrag = [0]");
  ASSERT_EQ(still.size(), known + 1);
  EXPECT_EQ(still.back().wind, 0);
}

/// Without the rules of the question, and without anything that pulls, there is still an answer.
TEST(HitscanConfig, answers_for_any_choice_of_rules) {
  const Outcome ball =
      outcome_of(hitscan_experiment(), "rule = ['hitscan_ball']\nrange = [3]\nspeed = [30]\nshots = 20");
  EXPECT_NE(ball.answer.find("hitscan_ball misses"), std::string::npos) << ball.answer;
  const Outcome frames =
      outcome_of(hitscan_experiment(), "rule = ['next_frame']\nrange = [3]\nspeed = [30]\nshots = 20");
  EXPECT_TRUE(frames.answer.ends_with("of its own are false.")) << frames.answer;
  const Outcome still =
      outcome_of(hitscan_experiment(), "gravity = 0\nwind = [0]\nrange = [3]\nspeed = [30]\nradius = [0]\nshots = 200");
  EXPECT_TRUE(still.self_test_passed) << still.summary;
  EXPECT_FALSE(still.answer.empty());
}

/// What a factor's range allows is the factor's own; this is what goes together, or not.
TEST(HitscanConfig, refuses_what_does_not_go_together) {
  expect_refusals(hitscan_experiment(), {{"range = [0.2]", "more than 2 * (target + radius)"},
                                         {"target = [2]\nrange = [3]", "more than 2 * (target + radius)"},
                                         {"speed = [3]\nrange = [3]", "fast enough to fly nearly straight"},
                                         {"speed = [30]\nrange = [100]", "a range that some bullet reaches"},
                                         {"drag = [40]\nspeed = [1000]\nrange = [3]", "drag * step at most 0.5"},
                                         {"step = [1e-9]", "a path of at least 0.01"},
                                         {"rule = ['next_fram']", "did you mean 'next_frame'?"}});
}

// ---- Without any rule's shots: the arc against 100 digits and its equation of motion, the oracle against the arc, and
// limits of the theory that have a formula of their own.

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

/// dv/dt = -k (v - wind) + gravity, by the classical fourth-order Runge-Kutta method: no closed form. One of the shots
/// is without drag.
TEST(HitscanArc, solves_the_equation_of_motion) {
  using Vector = Vec3<long double>;
  for (const HitscanCell& c : {some_shot(30, 30, 0), known_shots[1].cell, known_shots[2].cell, known_shots[3].cell}) {
    SCOPED_TRACE(hitscan_factors.key(c));
    const double time = flight_time(c);
    const Vector wind(0, 0, c.wind), gravity(0, -c.gravity, 0);
    const auto pull = [&](const Vector& v) -> Vector { return (wind - v) * c.drag + gravity; };
    Vector position = Vector::Zero(), velocity(c.speed, 0, 0);
    constexpr int steps = 4000;
    const long double h = static_cast<long double>(time) / steps;
    for (int i = 0; i < steps; ++i) {
      const Vector v1 = velocity, a1 = pull(v1), v2 = v1 + a1 * (h / 2), a2 = pull(v2);
      const Vector v3 = v1 + a2 * (h / 2), a3 = pull(v3), v4 = v1 + a3 * h, a4 = pull(v4);
      position += (v1 + v2 * 2 + v3 * 2 + v4) * (h / 6);
      velocity += (a1 + a2 * 2 + a3 * 2 + a4) * (h / 6);
    }
    const auto there = arc_of<double>(c).after(time);
    const Vec3<double> ahead(1, 0, 0), across = pull_direction(c);
    EXPECT_LT((ahead * there.x + across * there.s - position.cast<double>()).norm(), 1e-12 * c.range);
    EXPECT_LT((ahead * there.vx + across * there.vs - velocity.cast<double>()).norm(), 1e-12 * c.speed);
    EXPECT_NEAR(there.x, c.range, 1e-12 * c.range);
    EXPECT_NEAR(there.s, deflection(c), 1e-12 * c.range);
  }
}

const std::array some_cells = {some_shot(30, 30, 0.02), some_shot(50, 30, 0), some_shot(100, 1000, 0.004),
                               known_shots[2].cell, known_shots[3].cell};

/// Over fine times: the nearest that the arc comes, and when it is first within reach.
TEST(HitscanOracle, agrees_with_a_scan_of_the_arc) {
  for (const HitscanCell& c : some_cells) {
    SCOPED_TRACE(hitscan_factors.key(c));
    constexpr int times = 4000;
    const double from = contact_window(c).lower, fine = (contact_window(c).upper - from) / times;
    int touching = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const Vec3<double> center = random_placement(c, hitscan_factors.stream(c, 1), i).target.center;
      double nearest = std::numeric_limits<double>::infinity(), first = -1;
      for (int k = 0; k <= times; ++k) {
        const auto there = arc_of<double>(c).after(from + fine * k);
        const double distance = (Vec3<double>(there.x, 0, 0) + pull_direction(c) * there.s - center).norm();
        nearest = std::min(nearest, distance);
        if (distance <= reach(c) && first < 0) first = from + fine * k;
      }
      if (std::abs(nearest - reach(c)) < 1e-6 * reach(c)) continue;  // the scan cannot tell
      const std::optional<TrueImpact> truth = true_impact(c, center);
      ASSERT_EQ(truth.has_value(), nearest < reach(c)) << i;
      if (!truth) continue;
      ++touching;
      ASSERT_LE(truth->time, first + 1e-12);
      ASSERT_GE(truth->time, first - fine - 1e-12);
      ASSERT_NEAR((truth->bullet - center).norm(), reach(c), 1e-12 * c.range);
    }
    EXPECT_GT(touching, 20);
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
      EXPECT_FALSE(true_impact(c, middle + rim)) << hitscan_factors.key(c) << " " << i;
    }
  }
}

void expect_shadow(const std::vector<PathPiece>& pieces, const std::vector<Interval>& places) {
  const Places found = shadow(pieces, 10, 2);
  ASSERT_EQ(found.iterative_size(), places.size());
  auto place = found.begin();
  for (const Interval& wanted : places) {
    EXPECT_DOUBLE_EQ(place->lower(), wanted.lower);
    EXPECT_DOUBLE_EQ(place->upper(), wanted.upper);
    ++place;
  }
}

TEST(HitscanShadow, is_what_some_piece_reaches_as_wide_as_the_ball_seen_along_it) {
  expect_shadow({{0, 3, 20, 3}}, {{1, 5}});
  const double wide = 2 * std::sqrt(5.0);  // slope 2: 20 at the range, and sqrt(5) times as wide
  expect_shadow({{0, 0, 20, 40}}, {{20 - wide, 20 + wide}});
  expect_shadow({{0, 0, 7, 0}}, {});                                   // ends before the ball
  expect_shadow({{0, 0, 9, 0}}, {{-std::sqrt(3.0), std::sqrt(3.0)}});  // stops on the near side of it
  expect_shadow({{0, 0, 20, 0}, {0, 5, 20, 5}}, {{-2, 2}, {3, 7}});
  expect_shadow({{0, 3, 20, 3}, {0, 0, 20, 0}}, {{-2, 5}});
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
      EXPECT_NEAR(e.missed / e.touch, flat_missed(c.target, radius, off), 1e-4) << hitscan_factors.key(c);
      EXPECT_NEAR(e.false_hits / e.reported, flat_false(c.target, radius, off), 1e-4) << hitscan_factors.key(c);
      EXPECT_NEAR(e.touch / e.reported, std::pow(reach(c) / c.target, 2), 1e-4) << hitscan_factors.key(c);
    }
  }
}

/// Seen from the start of a step the bullet falls a h^2 / 2 in it: a third of that on average, a sixth from the chord.
TEST(HitscanTheory, path_errors_without_drag_have_formulas) {
  const HitscanCell c = without_drag(some_shot(30, 100, 0));
  const double fall = 9.81 * c.step * c.step;
  const auto ray = expected_of(hitscan_ray, c), tangent = expected_of(next_frame, c),
             chord = expected_of(swept_steps, c);
  EXPECT_NEAR(ray.path_error.mean, 9.81 * 0.3 * 0.3 / 2, 1e-12);
  EXPECT_EQ(ray.path_error.sigma, 0);
  EXPECT_NEAR(tangent.path_error.mean, fall / 6, 1e-5 * fall);
  EXPECT_NEAR(tangent.path_error.sigma, fall / std::sqrt(45.0), 1e-5 * fall);
  EXPECT_NEAR(tangent.path_error_possible.upper, fall / 2, 1e-12 * fall);
  EXPECT_NEAR(chord.path_error.mean, fall / 12, 1e-5 * fall);
  EXPECT_NEAR(chord.path_error.sigma, fall / std::sqrt(720.0), 1e-5 * fall);
  EXPECT_NEAR(chord.path_error_possible.upper, fall / 8, 1e-12 * fall);
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
  HitscanCell c = without_drag(some_shot(100, 1000, 0));
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
    EXPECT_NEAR(flat_missed(c.target, 0, arc_of<double>(c).at_distance(*range).s), share, 1e-9);
  }
  EXPECT_FALSE(range_of_missed(weightless(c), 0.5));
  HitscanCell slow = c;
  slow.drag = 100;  // comes to rest within 3 m, after falling little
  EXPECT_FALSE(range_of_missed(slow, 0.5));
}

}  // namespace

}  // namespace thinwall
