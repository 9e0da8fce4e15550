/// The experiment broad_phase: its worlds, its verdicts and its words, never its times.

#include <cmath>

#include <gtest/gtest.h>

#include <thinwall/discrete/broad_phase.hpp>
#include <thinwall/experiments/broad_phase/model.hpp>
#include <thinwall/experiments/experiment_list.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {
namespace {

const CrowdFactors uniform_crowd = {.placement = "uniform", .speed = 2, .count = 4000, .density = 0.1};

TEST(BroadPhaseCrowd, fills_its_cube_at_the_density_and_moves_as_far_as_asked) {
  const Crowd crowd = make_crowd(uniform_crowd, 1);
  ASSERT_EQ(crowd.size(), 4000U);
  const double side = std::cbrt(4000 / 0.1);
  Vec3<double> mean = Vec3<double>::Zero(), mean_path = Vec3<double>::Zero();
  for (const auto& ball : crowd) {
    EXPECT_GE(ball.shape.center.minCoeff(), 0);
    EXPECT_LT(ball.shape.center.maxCoeff(), side);
    EXPECT_NEAR(ball.displacement.norm(), 2, 1e-12);
    mean += ball.shape.center / 4000;
    mean_path += ball.displacement / 4000;
  }
  const double deviation = 1 / std::sqrt(12.0 * 4000), bound = 5;  // of a uniform mean, in sides
  EXPECT_LT((mean / side - Vec3<double>::Constant(0.5)).cwiseAbs().maxCoeff(), bound * deviation);
  EXPECT_LT(mean_path.cwiseAbs().maxCoeff(), bound * 2 / std::sqrt(3.0 * 4000));
}

TEST(BroadPhaseCrowd, of_uniform_balls_has_as_many_pairs_as_probability_says) {
  // Two boxes of sides w touch if their centers are within w on each axis: with no motion w = 1, and of n balls in a
  // cube of side L the expected number is n (n - 1) / 2 times the cube of 2 w / L - (w / L)^2.
  CrowdFactors still = uniform_crowd;
  still.speed = 0;
  const double share = 1 / std::cbrt(4000 / 0.1), one_axis = 2 * share - share * share;
  const double expected = 4000.0 * 3999 / 2 * std::pow(one_axis, 3);
  double sum = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    std::vector<ProxyPair> pairs;
    find_pairs(UniformGrid{}, proxies_of(make_crowd(still, seed)), pairs);
    sum += static_cast<double>(pairs.size());
  }
  EXPECT_NEAR(sum, 10 * expected, 5 * std::sqrt(10 * expected));  // counts of rare pairs scatter as Poisson's
}

TEST(BroadPhaseCrowd, heaps_have_more_pairs) {
  CrowdFactors heaps = uniform_crowd;
  heaps.placement = "clustered";
  std::vector<ProxyPair> uniform_pairs, heap_pairs;
  find_pairs(UniformGrid{}, proxies_of(make_crowd(uniform_crowd, 1)), uniform_pairs);
  find_pairs(UniformGrid{}, proxies_of(make_crowd(heaps, 1)), heap_pairs);
  EXPECT_GT(heap_pairs.size(), 3 * uniform_pairs.size());
}

TEST(BroadPhaseCrowd, boxes_hold_the_balls_and_the_next_step_begins_where_this_one_ends) {
  const Crowd crowd = make_crowd(uniform_crowd, 2), next = next_step(crowd);
  const std::vector<Proxy> proxies = proxies_of(crowd);
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    const Vec3<double> end = crowd[i].shape.center + crowd[i].displacement;
    EXPECT_EQ(next[i].shape.center, end);
    EXPECT_LE((proxies[i].low - end).maxCoeff(), -crowd_radius);
    EXPECT_GE((proxies[i].high - end).minCoeff(), crowd_radius);
  }
}

TEST(BroadPhase, counts_as_meetings_the_balls_that_touch_and_not_the_boxes) {
  const Sphere<double> ball{{0, 0, 0}, 0.5};
  const Crowd crowd = {{ball, {0, 0, 0}},
                       {moved(ball, Vec3<double>(1, 0, 0)), {0, 0, 0}},
                       {moved(ball, Vec3<double>(0.9, 0.9, 0)), {0, 0, 0}},
                       {moved(ball, Vec3<double>(0, 0, 9)), {0, 0, -20}}};
  EXPECT_EQ(count_meetings(crowd, {{0, 1}, {0, 2}, {1, 2}, {0, 3}}), 3);  // 0 and 2 pass each other's corner
}

TEST(BroadPhase, puts_every_broad_phase_of_the_list_to_every_world) {
  const auto run = run_of(broad_phase_experiment(), small_toml("broad_phase"));
  for (const Unit& unit : run->units()) {
    const auto s = from_text<Survey>(unit.compute());
    for_each_type(BroadPhases{}, [&]<class Method>(TypeTag<Method>) {
      const Finding* f = finding_of(s, Method::name);
      ASSERT_NE(f, nullptr) << Method::name;
      EXPECT_EQ(f->pairs, s.pairs);
      EXPECT_EQ(f->milliseconds.size(), 3U);
    });
    EXPECT_EQ(finding_of(s, "bullet_step") != nullptr, has_bullet());
    EXPECT_GT(s.pairs, 0);
    EXPECT_LT(s.meetings, s.pairs);
    for (const Finding& f : s.findings) EXPECT_TRUE(f.is_right()) << f.finder << " misses " << f.missing;
  }
}

/// Who is asked about a step and the next and back again before it is judged; the others are asked once.
TEST(BroadPhase, only_a_tree_that_is_moved_on_remembers_the_steps) {
  for (const std::string_view name : finder_names())
    EXPECT_EQ(make_finder(name)->moves_on(), name == bullet_step_name) << name;
}

/// A finding as none is.
Finding made_up_finding(std::string finder, double milliseconds) {
  Finding f;
  f.finder = std::move(finder);
  f.pairs = 3;
  f.milliseconds = {milliseconds, milliseconds, milliseconds};
  return f;
}

SurveyRow made_up_row(std::int64_t count, std::vector<Finding> findings) {
  SurveyRow row;
  row.crowd.count = count;
  row.survey = {3, 1, std::move(findings)};
  return row;
}

/// What the experiment makes of these surveys of uniform worlds.
Outcome outcome_of_rows(const std::vector<SurveyRow>& rows) {
  std::string counts;
  std::vector<std::string> results;
  for (const SurveyRow& row : rows) {
    counts += (counts.empty() ? "" : ", ") + std::to_string(row.crowd.count);
    results.push_back(to_text(row.survey));
  }
  const auto run = run_of(broad_phase_experiment(), "speed = [1]\nplacement = ['uniform']\ncount = [" + counts + "]");
  return run->finish(results, std::vector<double>(results.size(), 1));
}

TEST(BroadPhase, tells_of_the_largest_worlds_within_the_terminal) {
  std::vector<SurveyRow> rows;
  for (const std::int64_t count : {10, 100, 10000, 31623, 100000, 316228, 1000000, 10000000})
    rows.push_back(
        made_up_row(count, {made_up_finding("all_ordered_pairs", 1.23456e-9 * std::sqrt(double(count + 20000))),
                            made_up_finding("uniform_grid", 1.5e-4 * double(count + 20000))}));
  const Outcome outcome = outcome_of_rows(rows);  // a table that is too wide throws
  EXPECT_TRUE(holds(outcome.summary, "10,000,000"));
  EXPECT_EQ(outcome.answer.find("Of 10,000,000 uniform balls"), 0U) << outcome.answer;
  EXPECT_EQ(value_of(table_of(outcome, "growth"), 0, "counts"), Value(std::int64_t{6}));
}

TEST(BroadPhase, says_what_its_trials_are) {
  EXPECT_EQ(run_of(broad_phase_experiment(), "rounds = 7")->notes(),
            std::vector<std::string>{"trials are balls; each broad phase is timed in up to 7 rounds (--trials)"});
}

TEST(BroadPhase, self_test_fails_who_misses_a_pair_or_invents_one) {
  std::vector<SurveyRow> rows = {made_up_row(10, {made_up_finding("r_tree", 1)})};
  EXPECT_TRUE(all_right(rows));
  Finding& f = rows[0].survey.findings[0];
  f.extra = 1;
  EXPECT_FALSE(all_right(rows));
  f.is_exact = false;  // Bullet's boxes have a margin
  EXPECT_TRUE(all_right(rows));
  f.missing = 1;
  EXPECT_FALSE(all_right(rows));
  f.is_exact = true;
  EXPECT_FALSE(outcome_of_rows(rows).self_test_passed);
  EXPECT_TRUE(holds(outcome_of_rows(rows).sections[0].text, "r_tree misses 1 and adds 1 of 3 pairs"));
}

TEST(BroadPhase, finds_the_exponent_of_a_power_and_no_interval_where_it_is_exact) {
  std::vector<GrowthPoint> points;
  for (const double n : {1e4, 1e5, 1e6}) points.push_back({n, 3 * std::pow(n, 1.25)});
  const Measured growth = fit_growth(points).value();
  EXPECT_NEAR(growth.value, 1.25, 1e-12);
  EXPECT_NEAR(growth.interval.upper - growth.interval.lower, 0, 1e-6);
  points[1].cost *= 2;
  constexpr double student = 12.706204736;  // of one degree of freedom, 2.5 % to either side
  EXPECT_NEAR(fit_growth(points)->interval.upper, 1.25 + student * std::log10(2) / std::sqrt(3.0), 1e-6);
  points.pop_back();
  EXPECT_FALSE(fit_growth(points));
}

TEST(BroadPhase, fits_only_counts_beyond_the_fixed_costs_and_sees_where_the_loop_ends) {
  std::vector<SurveyRow> rows;
  for (const std::int64_t count : {10, 100, 10000, 100000, 1000000}) {
    const double loop = 1e-6 * double(count) * double(count), grid = 1e-3 * double(count) + (count < 10000 ? 1 : 0);
    rows.push_back(made_up_row(count, {made_up_finding("all_pairs", loop), made_up_finding("uniform_grid", grid)}));
  }
  EXPECT_EQ(loop_is_best_up_to(rows), 100);
  const std::vector<Course> all = courses(rows);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NEAR(all[0].growth.value().value, 2, 1e-9);
  EXPECT_NEAR(all[1].growth.value().value, 1, 1e-9);
  rows.push_back(made_up_row(100, {made_up_finding("all_pairs", 2), made_up_finding("uniform_grid", 1)}));
  EXPECT_EQ(loop_is_best_up_to(rows), 10) << "in every world of so many";
}

TEST(BroadPhase, refuses_a_world_that_nobody_would_look_at) {
  expect_refusals(broad_phase_experiment(),
                  {{"broad_phase = ['all_pairs']\nloops_up_to = 5\ncount = [6]",
                    "'broad_phase': [\"all_pairs\"] is not allowed; at least one that is not left out of 6 balls"}});
}

}  // namespace
}  // namespace thinwall
