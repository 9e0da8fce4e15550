/// The stiff contact's settings and the form of what it hands over.
#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "experiments/stiff_contact_run.hpp"
#include "support/described_tables.hpp"

namespace thinwall {
namespace {

TEST(StiffConfig, unit_keys_are_unique) {
  std::vector<std::string> keys;
  for (const Unit& unit : stiff_run("")->units()) keys.push_back(unit.key);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST(StiffConfig, trials_override_the_bounces) {
  const Experiment experiment = stiff_contact_experiment();
  const Settings settings(few_contacts, "test.toml", experiment.default_toml);
  EXPECT_EQ(make_stiff_plan(settings, {.seed = 1, .trials = 7}).bounces, 7);
  EXPECT_EQ(make_stiff_plan(settings, {.seed = 1, .trials = {}}).bounces, 100);
}

TEST(StiffConfig, every_row_is_as_long_as_its_columns_and_every_column_is_described) {
  expect_described_tables(stiff_outcome());
}

TEST(StiffConfig, summary_fits_a_terminal) {
  std::istringstream summary(stiff_outcome().summary);
  std::string line;
  while (std::getline(summary, line)) EXPECT_LE(line.size(), 100U) << line;
}

TEST(StiffConfig, the_first_picture_is_the_stability_map) {
  const Outcome outcome = stiff_outcome();
  ASSERT_EQ(outcome.figures.size(), 5U);
  EXPECT_EQ(outcome.figures[0].name, "stability");
  EXPECT_EQ(outcome.figures[0].panels.size(), 3U);
  for (const Figure& figure : outcome.figures) {
    EXPECT_EQ(figure.is_timing, figure.name == "race");
    for (const Panel& panel : figure.panels) EXPECT_FALSE(panel.series.empty()) << figure.name;
  }
}

TEST(StiffConfig, answers_for_the_smallest_of_settings) {
  const Outcome outcome = stiff_outcome(
      "bounces = 1\nstiffness = [100]\ndamping_ratio = [0]\nstep = [1]\nbounce_damping = [2]\nbounce_step = [3]\n"
      "race_step = [1]\nrace_bounces = 1\nrounds = 1");
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_NE(outcome.answer.find("in 3 of 3 springs"), std::string::npos) << outcome.answer;
}

TEST(StiffConfig, refuses_what_cannot_be_asked) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      stiff_run(text);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  for (const std::string key : {"stiffness", "damping_ratio", "step", "bounce_damping", "bounce_step", "race_step"}) {
    for (const char* value : {"[-1]", "[inf]", "[nan]", "[]", "[1, 1]", "1", "['a']", "[1e300]"}) {
      const std::string complaint = refusal(key + " = " + value);
      EXPECT_NE(complaint.find("key '" + key + "'"), std::string::npos) << key << " " << value << ": " << complaint;
      EXPECT_EQ(complaint.find('\n'), std::string::npos);
    }
  }
  for (const std::string key : {"mass", "speed", "radius", "thickness", "blow_up"}) {
    for (const char* value : {"-1", "inf", "nan", "[1]", "1e300"}) {
      EXPECT_NE(refusal(key + " = " + value).find("key '" + key + "'"), std::string::npos) << key << " " << value;
    }
  }
  for (const char* text :
       {"mass = 0", "stiffness = [0]", "stiffness = [1, 0]", "step = [0]", "bounce_step = [0]", "race_step = [0]",
        "race_step = [2.5]", "speed = 0", "blow_up = 1", "bounces = 0", "rounds = 0", "race_bounces = 0",
        "damping_ratio = [1e-6]", "stifness = [1]", "radius = 0\nthickness = 0", "mass = 1e-12\nstiffness = [1e18]"}) {
    EXPECT_NE(refusal(text), "") << text;
  }
  EXPECT_NE(refusal("stiffness = [0]").find("key 'stiffness'"), std::string::npos);
  EXPECT_NE(refusal("stifness = [1]").find("did you mean 'stiffness'?"), std::string::npos);
  EXPECT_NE(refusal("damping_ratio = [1e-6]").find("0, or 1e-05 to 100000"), std::string::npos);
  EXPECT_NE(refusal("radius = 0\nthickness = 0").find("key 'thickness'"), std::string::npos);
}

TEST(StiffTally, survives_its_line) {
  ContactTally tally;
  const auto read = [](const std::string& line) {
    std::istringstream in(line);
    return bounce_tally_from(in);
  };
  EXPECT_EQ(read(to_line(tally)), tally);
  tally = {.returned = 9,
           .escaped = 8,
           .unfinished = 7,
           .contact_steps = 6,
           .blown_up = 5,
           .blow_up_step = 4,
           .slowest = 1.0 / 3,
           .fastest = 1e300,
           .speed_sum = 0.1,
           .square_error = 1e-300,
           .shallowest = 0.2,
           .deepest = 0.3};
  EXPECT_EQ(read(to_line(tally)), tally);
  EXPECT_THROW(read("1 2 3"), std::runtime_error);
  EXPECT_THROW(read("1 2 3 4 5 6 x 0 0 0 0 0"), std::runtime_error);
  const StiffPlan plan = stiff_plan();
  EXPECT_THROW(limit_line(plan, limit_cells(plan).front(), "0x1p0 0x1p1 1 2"), std::runtime_error);
  EXPECT_THROW(bounce_lines(plan, bounce_series(plan).front(), to_line(tally)), std::runtime_error);
}

}  // namespace
}  // namespace thinwall
