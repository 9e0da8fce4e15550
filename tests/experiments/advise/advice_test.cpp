/// The choice, with costs that are given: nothing is timed here.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <thinwall/experiments/thin_wall/model.hpp>

#include "experiments/advise/given_costs.hpp"

namespace thinwall {
namespace {

Wish with_step(Wish wish, double step) {
  wish.cell.step = step;
  return wish;
}

TEST(Advice, has_a_row_for_every_method_of_the_list_and_for_the_certified) {
  const Advice advice = advice_on(bullet_wish);
  for (const std::string_view method : method_names()) {
    if (method == "substeps") continue;  // by its numbers of poses
    EXPECT_TRUE(has_row(advice, std::string(method))) << method;
  }
  for (const char* method : {"substeps_2", "substeps_8", "certified"}) EXPECT_TRUE(has_row(advice, method)) << method;
}

TEST(Advice, the_discrete_test_tunnels_by_the_formula) {
  const Advice advice = advice_on(bullet_wish);
  EXPECT_NEAR(*row_of(advice, "end_of_step").theory.probability, 1 - 0.05 / (10.0 / 60), 1e-15);
  EXPECT_FALSE(row_of(advice, "end_of_step").meets);
  EXPECT_EQ(*row_of(advice, "closed_form").theory.probability, 0);
  EXPECT_TRUE(row_of(advice, "closed_form").meets);
}

TEST(Advice, a_sleeker_ball_and_a_slanted_path_count) {
  Wish wish = bullet_wish;
  wish.cell.radius = 0.001;
  wish.cell.angle_deg = 60;
  EXPECT_NEAR(*row_of(advice_on(wish), "end_of_step").theory.probability, 1 - 0.012 / (10.0 / 60 * 0.5), 1e-12);
}

TEST(Advice, offers_the_fewest_poses_that_meet_the_wish) {
  EXPECT_EQ(offered_poses(bullet_wish), (std::vector<std::int64_t>{2, 4, 8}));  // 3 1/3 contacts a step
  Wish wish = bullet_wish;
  wish.miss = 0.11;  // 1 - 3 * 0.3 = 0.1
  EXPECT_EQ(offered_poses(wish), (std::vector<std::int64_t>{2, 3, 8}));
  wish.miss = 0.09;
  EXPECT_EQ(offered_poses(wish), (std::vector<std::int64_t>{2, 4, 8}));
  wish.miss = 0.71;  // the end of the step will do
  EXPECT_EQ(offered_poses(wish), (std::vector<std::int64_t>{2, 8}));
  wish = {.cell = bullet, .late = 0.001};  // 1 mm of 167 mm
  EXPECT_EQ(offered_poses(wish), (std::vector<std::int64_t>{2, 8, 167}));
  wish.late = 1e-6;  // more than the experiment fires
  EXPECT_EQ(offered_poses(wish), (std::vector<std::int64_t>{2, 8}));
}

TEST(Advice, the_longest_step_is_the_formula_turned_round) {
  for (const double miss : {0.0, 0.25, 0.9}) {
    Wish wish = bullet_wish;
    wish.miss = miss;
    const Advice advice = advice_on(wish);
    const double longest = 0.05 / 10 / (1 - miss);
    EXPECT_NEAR(*row_of(advice, "end_of_step").longest_step / longest, 1, 1e-12) << miss;
    EXPECT_NEAR(*row_of(advice, "substeps_8").longest_step / longest, 8, 1e-11) << miss;
    EXPECT_EQ(row_of(advice, "closed_form").longest_step, allowed_step.upper);
  }
}

TEST(Advice, the_longest_step_is_met_and_a_longer_one_is_not) {
  Wish wish = {.cell = bullet, .miss = 0.1, .late = 0.03};
  for (const AdviceRow& row : advice_on(wish).rows) {
    if (!row.longest_step) continue;
    EXPECT_TRUE(meets_wish(wish, row.method.theory(with_step(wish, *row.longest_step).cell))) << row.method.name;
    if (*row.longest_step == allowed_step.upper) continue;
    EXPECT_FALSE(meets_wish(wish, row.method.theory(with_step(wish, *row.longest_step * (1 + 1e-12)).cell)))
        << row.method.name;
  }
}

TEST(Advice, lateness_bounds_the_step_too) {
  const Wish wish = {.cell = bullet, .miss = 1, .late = 0.03};
  const Advice advice = advice_on(wish);
  EXPECT_NEAR(*row_of(advice, "end_of_step").longest_step, 0.003, 1e-15);  // a step of 3 cm
  EXPECT_TRUE(row_of(advice, "centre_ray").meets);                         // late by its radius
  const Advice stricter = advice_on({.cell = bullet, .miss = 1, .late = 0.019});
  EXPECT_FALSE(row_of(stricter, "centre_ray").meets);
  EXPECT_NEAR(*row_of(stricter, "centre_ray").longest_step, 0.0019, 1e-15);
  EXPECT_TRUE(row_of(stricter, "closed_form").meets);
}

TEST(Advice, a_chance_that_is_only_rounding_is_none) {
  EXPECT_TRUE(row_of(advice_on(with_step(bullet_wish, 0.02)), "substeps_4").meets);  // exactly four contacts a step
  EXPECT_EQ(advice_on({.cell = bullet, .miss = 0.7}).advised()->method.name, "end_of_step");
}

TEST(Advice, the_cheapest_that_meets_the_wish_is_advised) {
  const Advice advice = advice_on(bullet_wish);
  EXPECT_EQ(advice.advised()->method.name, "substeps_4");  // the third of the list costs 30, after two that miss
  bool met = true;
  double cost = 0;
  for (const AdviceRow& row : advice.rows) {
    if (met != row.meets) cost = 0;
    EXPECT_TRUE(met || !row.meets) << "what meets the wish comes first";
    EXPECT_GE(row.cost.dearer().median, cost) << "by cost";
    met = row.meets;
    cost = row.cost.dearer().median;
  }
  EXPECT_EQ(advice_on({.cell = bullet, .miss = 1}).advised()->method.name, "end_of_step");
}

TEST(Advice, the_dearer_kind_of_step_counts) {
  const std::vector<Candidate> methods = candidates(bullet_wish);
  std::vector<StepCost> costs(methods.size(), costing(100));
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (methods[i].name == "centre_ray") costs[i] = {costing(1).clear, costing(200).contact};
    if (methods[i].name == "inclusion") costs[i] = {costing(90).clear, costing(80).contact};
  }
  EXPECT_EQ(advise(bullet_wish, methods, costs).advised()->method.name, "inclusion");
}

TEST(Advice, of_costs_that_cannot_be_told_apart_the_least_late_wins) {
  const std::vector<Candidate> methods = candidates(bullet_wish);
  std::vector<StepCost> costs(methods.size(), costing(100));
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (methods[i].name == "centre_ray") costs[i] = costing(50);
    if (methods[i].name == "closed_form") costs[i] = costing(50.5);  // within 1 % of it
  }
  EXPECT_EQ(advise(bullet_wish, methods, costs).advised()->method.name, "closed_form");
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (methods[i].name == "closed_form") costs[i] = costing(53);
  }
  EXPECT_EQ(advise(bullet_wish, methods, costs).advised()->method.name, "centre_ray");
}

/// A method that a stranger adds to the list has no theory until he gives one.
TEST(Advice, a_method_without_a_theory_is_listed_and_never_advised) {
  std::vector<Candidate> methods = candidates(bullet_wish);
  methods.push_back({"strangers", 0, true, [](const Cell&) { return Theory{}; }, {}});
  std::vector<StepCost> costs(methods.size(), costing(100));
  costs.back() = costing(1);
  for (const double miss : {0.0, 1.0}) {
    const Advice advice = advise({.cell = bullet, .miss = miss}, methods, costs);
    EXPECT_FALSE(row_of(advice, "strangers").meets);
    EXPECT_FALSE(row_of(advice, "strangers").longest_step);
    EXPECT_NE(advice.advised()->method.name, "strangers");
  }
}

TEST(Advice, a_point_against_a_sheet_is_missed_by_every_pose) {
  Wish wish = bullet_wish;
  wish.cell.radius = wish.cell.thickness = 0;
  const Advice advice = advice_on(wish);
  for (const char* method : {"end_of_step", "substeps_2", "substeps_8"}) {
    EXPECT_EQ(*row_of(advice, method).theory.probability, 1) << method;
    EXPECT_FALSE(row_of(advice, method).longest_step) << method;
  }
  for (const char* method : {"bisection", "sweep_then_confirm"}) {  // measured: 12 % of the shots tunnel
    EXPECT_FALSE(row_of(advice, method).theory.probability) << method;
    EXPECT_FALSE(row_of(advice, method).meets) << method;
  }
  EXPECT_TRUE(row_of(advice, "closed_form").meets);
}

TEST(Advice, of_nothing_is_nothing) { EXPECT_EQ(advise(bullet_wish, {}, {}).advised(), nullptr); }

}  // namespace
}  // namespace thinwall
