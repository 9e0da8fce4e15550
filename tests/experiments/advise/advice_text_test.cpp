/// What the advice reads like, and what a script gets of it.

#include <gtest/gtest.h>

#include <sstream>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/advise/advice.hpp>

#include "experiments/advise/given_costs.hpp"

namespace thinwall {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<Wish> all_sorts() {
  std::vector<Wish> wishes(5, bullet_wish);
  wishes[1] = {.cell = {123456.789, 1.0 / 3, 0.0123456789, 1e-9, 89.87654321, Wall::infinite, 0}, .miss = 0.123456789};
  wishes[1].late = 1.23456789e-7;
  wishes[2].cell.radius = wishes[2].cell.thickness = 0;
  wishes[3].miss = 1;
  wishes[4].cell.speed = 1e-9;
  return wishes;
}

TEST(AdviceText, fits_a_terminal) {
  for (const Wish& wish : all_sorts()) {
    const std::string text = advice_text(advice_on(wish));
    EXPECT_TRUE(text.ends_with(".\n"));
    for (const std::string& line : lines_of(text)) EXPECT_LE(line.size(), 100U) << line;
  }
}

TEST(AdviceText, says_what_to_use_and_what_it_costs) {
  EXPECT_EQ(
      advice_sentence(advice_on(bullet_wish)),
      "Use substeps_4: no shot tunnels, none is seen more than 0.0417 m late, and a step takes 30 ns, the least of "
      "the 11 methods here that meet the wish. If a ball in the wall is pushed out the shorter way, 40 % go through, seen "
      "or not. Testing only the end of each step would do from 200 steps a second on.");
  EXPECT_EQ(
      advice_sentence(advice_on({.cell = bullet, .miss = 0.75})),
      "Use end_of_step: 70 % of the shots tunnel, none is seen more than 0.05 m late, and a step takes 10 ns, the "
      "least of the 12 methods here that meet the wish. If a ball in the wall is pushed out the shorter way, 85 % go "
      "through, seen or not.");
  EXPECT_EQ(advice_sentence(advise(bullet_wish, {}, {})), "No method here meets the wish at this step.");
}

TEST(AdviceText, a_point_against_a_sheet_is_explained) {
  const std::string text = advice_text(advice_on(all_sorts()[2]));
  EXPECT_NE(text.find("A point and a wall of no thickness are in contact for an instant"), std::string::npos);
  EXPECT_NE(text.find("end of each step would not do at any step"), std::string::npos);
  EXPECT_NE(text.find("no formula"), std::string::npos);
}

TEST(AdviceText, a_bound_is_rounded_to_the_safe_side) {
  EXPECT_EQ(rounded_down_text(0.0199999, 4), "0.01999");
  EXPECT_EQ(rounded_down_text(0.02, 4), "0.02");
  EXPECT_EQ(rounded_down_text(0.005, 4), "0.005");
  EXPECT_EQ(rounded_down_text(999.96, 4), "999.9");
  for (double x = 1e-9; x < 1e9; x *= 1.37) {
    EXPECT_LE(std::stod(rounded_down_text(x, 4)), x);
    EXPECT_GE(std::stod(rounded_down_text(x, 4)), x * 0.9989);
  }
}

TEST(AdviceText, json_has_every_number) {
  const Advice advice = advice_on({.cell = bullet, .late = 0.05});
  const nlohmann::json json = nlohmann::json::parse(advice_json(advice).dump());
  EXPECT_EQ(json["method"], advice.advised()->method.name);
  EXPECT_EQ(json["advice"], advice_sentence(advice));
  EXPECT_EQ(json["step_s"], 1.0 / 60);
  EXPECT_EQ(json["late_m"], 0.05);
  ASSERT_EQ(json["methods"].size(), advice.rows.size());
  for (std::size_t i = 0; i < advice.rows.size(); ++i) {
    const nlohmann::json& row = json["methods"][i];
    EXPECT_EQ(row["method"], advice.rows[i].method.name);
    EXPECT_EQ(row["meets"], advice.rows[i].meets);
    EXPECT_EQ(row["chance"], *advice.rows[i].theory.probability);
    EXPECT_FALSE(row["chance_formula"].get<std::string>().empty()) << row["method"];
    EXPECT_FALSE(row["latest_formula"].get<std::string>().empty()) << row["method"];
    EXPECT_EQ(row["longest_step_s"], *advice.rows[i].longest_step);
    EXPECT_EQ(row["contact_ns"]["median"], advice.rows[i].cost.contact.median);
    EXPECT_EQ(row["clear_ns"]["lower"], advice.rows[i].cost.clear.spread.lower);
  }
}

TEST(AdviceText, json_is_null_where_theory_is_silent) {
  const nlohmann::json json = nlohmann::json::parse(advice_json(advice_on(all_sorts()[2])).dump());
  for (const nlohmann::json& row : json["methods"]) {
    if (row["method"] == "bisection") {
      EXPECT_TRUE(row["chance"].is_null());
    }
    if (row["method"] == "end_of_step") {
      EXPECT_TRUE(row["longest_step_s"].is_null());
    }
  }
}

TEST(AdviceText, the_experiment_refuses_what_it_cannot_fire) {
  Wish wish = bullet_wish;
  wish.cell.radius = wish.cell.thickness = 0;
  try {
    check_config(wish, candidates(wish));
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("--toml: the experiment cannot fire this")) << error.what();
  }
}

/// Costs are measured, so that only their form is tested: positive, and inside their interval.
TEST(AdviceCosts, are_medians_with_an_interval) {
  const std::vector<Candidate> methods = candidates(bullet_wish);
  const std::vector<StepCost> costs = measure_costs(bullet, methods, {.queries = 64, .rounds = 5, .round_ns = 1e4});
  ASSERT_EQ(costs.size(), methods.size());
  const Cell slow = all_sorts()[4].cell;  // its step is far too short for the grid of the poses
  EXPECT_EQ(measure_costs(slow, methods, {.queries = 64, .rounds = 1, .round_ns = 1e4}).size(), methods.size());
  for (const StepCost& cost : costs) {
    for (const QueryTime& time : {cost.clear, cost.contact}) {
      EXPECT_GT(time.spread.lower, 0);
      EXPECT_TRUE(time.spread.contains(time.median));
    }
  }
}

}  // namespace
}  // namespace thinwall
