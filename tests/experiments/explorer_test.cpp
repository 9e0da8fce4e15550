/// What the page asks of the library, asked here: the same shots as the experiment's, and what is wrong answered with words.

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/explorer/explorer.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/models/shot_methods.hpp>
#include <thinwall/experiments/thin_wall/results.hpp>

#include "support/said.hpp"

namespace thinwall {
namespace {

std::vector<double> numbers(int count) { return {explorer_numbers(), explorer_numbers() + count}; }

std::vector<std::string> names() {
  const auto offer = nlohmann::json::parse(explorer_describe());
  std::vector<std::string> all;
  for (const auto& method : offer.at("methods")) all.push_back(method.at("name"));
  return all;
}

int number_of(const std::string& name) {
  const std::vector<std::string> all = names();
  return static_cast<int>(std::ranges::find(all, name) - all.begin());
}

void set_bullet() { ASSERT_STREQ(explorer_set(10, 1.0 / 60, 0.02, 0.01, 0, 0), ""); }

TEST(Explorer, describes_every_method_of_the_experiment_and_its_look) {
  const auto offer = nlohmann::json::parse(explorer_describe());
  const std::vector<std::string> all = names();
  for (const std::string_view name : method_names()) {
    const auto is_it = [&](const std::string& one) { return one == name || one.starts_with(std::string(name) + "_"); };
    EXPECT_TRUE(std::ranges::any_of(all, is_it)) << name;
  }
  for (const auto& method : offer.at("methods")) EXPECT_EQ(method.at("color").get<std::string>().size(), 7U);
  EXPECT_EQ(offer.at("factors").size(), 5U);
}

TEST(Explorer, fires_the_shots_of_the_experiment) {
  ASSERT_STREQ(explorer_set(300, 0.002, 0.004, 0.002, 25, 7), "");
  const Cell cell = {300, 0.002, 0.004, 0.002, 25};
  const std::vector<std::string> wanted = {"end_of_step"}, scalars = {"double"};
  const Tally tally = fire(cell, thin_wall_methods(wanted, {}, scalars).front(), {0, 5000}, 7);
  const int method = number_of("end_of_step");
  explorer_fire(method, 2000);
  explorer_fire(method, 3000);
  const std::vector<double> counted = numbers(explorer_tally(method));
  EXPECT_EQ(counted[0], 5000);
  EXPECT_EQ(counted[1], static_cast<double>(tally.tunneled));
  EXPECT_LT(counted[4], counted[3]);
  EXPECT_LT(counted[3], counted[5]);
  const double expected = numbers(explorer_theory(method))[0];
  EXPECT_NEAR(counted[3], expected, 0.03);
  EXPECT_NEAR(numbers(explorer_curve(method, explorer_step_ratio(), 1000, 2))[0], expected, 1e-12);
}

TEST(Explorer, says_what_cannot_be_fired_and_keeps_what_was_set) {
  set_bullet();
  explorer_fire(0, 10);
  const double nan = std::nan("");
  for (const auto& [speed, step, radius, thickness, angle, seed, word] :
       {std::tuple(-1.0, 0.1, 0.1, 0.1, 0.0, 0.0, "speed"),
        {nan, 0.1, 0.1, 0.1, 0.0, 0.0, "speed"},
        {1.0, 0.0, 0.1, 0.1, 0.0, 0.0, "step"},
        {1.0, 0.1, -0.1, 0.1, 0.0, 0.0, "radius"},
        {1.0, 0.1, 0.1, 1e300, 0.0, 0.0, "thickness"},
        {1.0, 0.1, 0.0, 0.0, 0.0, 0.0, "thickness"},
        {1.0, 0.1, 0.1, 0.1, 90.0, 0.0, "angle_deg"},
        {1e9, 1e3, 0.1, 0.1, 0.0, 0.0, "speed"},
        {1.0, 0.1, 0.1, 0.1, 0.0, 0.5, "seed"},
        {1.0, 0.1, 0.1, 0.1, 0.0, -1.0, "seed"}}) {
    const std::string why = explorer_set(speed, step, radius, thickness, angle, seed);
    EXPECT_TRUE(why.starts_with(std::string(word) + ": ")) << why;
  }
  EXPECT_EQ(numbers(explorer_tally(0))[0], 10);
  EXPECT_NEAR(explorer_step_ratio(), 10.0 / 3, 1e-12);
}

TEST(Explorer, shows_where_a_shot_is_seen) {
  set_bullet();
  const std::vector<double> shot =
      numbers(explorer_shot(0.5));  // poses half a step before contact, and half a step behind
  ASSERT_EQ(shot.size(), 7 + names().size());
  EXPECT_NEAR(shot[6] / shot[2], 0.5, 1e-6);
  const auto seen = [&](const char* name) { return shot[7 + static_cast<std::size_t>(number_of(name))]; };
  EXPECT_TRUE(std::isnan(seen("end_of_step")));
  EXPECT_NEAR(seen("closed_form"), shot[6], 1e-12);
  EXPECT_NEAR(seen("centre_ray"), shot[6] + 0.02, 1e-6);
}

TEST(Explorer, races_and_advises) {
  set_bullet();
  const std::vector<double> raced = numbers(explorer_race());
  const std::vector<std::string> all = names();
  ASSERT_EQ(raced.size(), 6 * all.size());
  const auto of = [&](const char* name) { return raced.begin() + 6 * number_of(name); };
  for (std::size_t m = 0; m < all.size(); ++m) EXPECT_GT(raced[6 * m], 0) << all[m];
  EXPECT_EQ(of("closed_form")[3], 0);
  EXPECT_LT(of("closed_form")[5], 1e-14);
  EXPECT_GT(of("end_of_step")[3], 1000);  // 7 of 10 that touch are not seen
  EXPECT_NEAR(of("centre_ray")[5], 0.02, 1e-3);
  EXPECT_TRUE(std::string(explorer_advice(0, 1e-9)).starts_with("Use "));
  EXPECT_TRUE(std::string(explorer_advice(1, -1)).starts_with("Use "));
}

TEST(Explorer, writes_a_configuration_that_the_experiment_takes) {
  ASSERT_STREQ(explorer_set(300, 0.002, 0.004, 0.002, 25, 7), "");
  const ShotPlan plan = make_plan(Settings(explorer_toml(0.2, 0.01), "page", thin_wall_experiment().default_toml), {});
  ASSERT_EQ(plan.cells.size(), 2U);  // the bullet is always there
  EXPECT_EQ(plan.cells[1].speed, 300);
  EXPECT_EQ(plan.cells[1].angle_deg, 25);
  EXPECT_TRUE(holds(explorer_toml(0.2, 0.01),
                    "# Wanted: at most 20 % of the shots tunnel, and none is seen more than 0.01 m past"));
}

TEST(Explorer, flies_rods_that_a_page_can_wait_for) {
  const auto refusal = [](double speed, double length, double spin) {
    return std::string(explorer_rod_set(speed, 0.01, 0.02, 0.01, length, spin, 0));
  };
  EXPECT_EQ(refusal(10, 0.2, 60), "");
  explorer_rod_shot(0);
  EXPECT_NEAR(explorer_rod_numbers()[0], 0.08, 1e-15);  // half the core of a rod of 0.2 m, end to end
  EXPECT_EQ(refusal(10, 0.04, 60), "length: more than twice the radius, end to end; what is shorter is a ball");
  EXPECT_EQ(refusal(10, 0.2, 7e4), "spin: no more than 100 turns a step");
  EXPECT_EQ(refusal(0.001, 0.2, 60), "spin: rods that slow and spinning that fast take more than 2,000 steps to pass");
}

}  // namespace
}  // namespace thinwall
