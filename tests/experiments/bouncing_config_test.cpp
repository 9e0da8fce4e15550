/// The bouncing ball's settings and the form of what it hands over.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "experiments/bouncing_run.hpp"
#include "support/described_tables.hpp"

namespace thinwall {
namespace {

TEST(BouncingConfig, unit_keys_are_unique) {
  std::vector<std::string> keys;
  for (const Unit& unit : bouncing_run("")->units()) keys.push_back(unit.key);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST(BouncingConfig, trials_override_the_bounces) {
  const std::vector<Unit> units = bouncing_run(few_bounces, {.seed = 1, .trials = 7})->units();
  const auto cells = std::count_if(units.begin(), units.end(), [](const Unit& unit) { return unit.trials == 7; });
  EXPECT_EQ(cells, 3 * 3 * 5);
}

TEST(BouncingConfig, every_row_is_as_long_as_its_columns_and_every_column_is_described) {
  expect_described_tables(few_bounces_outcome());
}

TEST(BouncingConfig, summary_fits_a_terminal) {
  std::istringstream summary(few_bounces_outcome().summary);
  for (std::string line; std::getline(summary, line);) EXPECT_LE(line.size(), 100U) << line;
}

TEST(BouncingConfig, figures_have_panels_and_points) {
  const Outcome& outcome = few_bounces_outcome();
  ASSERT_EQ(outcome.figures.size(), 4U);
  EXPECT_EQ(outcome.figures[0].name, "energy_per_bounce");
  for (const Figure& figure : outcome.figures) {
    ASSERT_FALSE(figure.panels.empty()) << figure.name;
    for (const Panel& panel : figure.panels) {
      ASSERT_FALSE(panel.series.empty()) << figure.name;
      for (const Series& series : panel.series) EXPECT_EQ(series.x.size(), series.y.size()) << figure.name;
    }
  }
}

/// Any policy alone has an answer, tables and pictures.
TEST(BouncingConfig, answers_for_any_one_policy_and_step) {
  for (const std::string_view policy : bounce_policy_names()) {
    const Outcome outcome = bouncing_outcome("policy = ['" + std::string(policy) + R"(']
      step = [0.05]
      restitution = [0.5]
      scenario = ["walls"]
      bounces = 50
      runs = 2
      run_bounces = 2
      rounds = 1)");
    EXPECT_NE(outcome.answer.find(policy), std::string::npos) << outcome.answer;
    EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
    EXPECT_EQ(outcome.figures.size(), 4U);
  }
}

TEST(BouncingConfig, refuses_what_cannot_be_asked) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      bouncing_run(text);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  for (const std::string key : {"gravity", "height", "radius"}) {
    for (const char* value : {"0", "-1", "inf", "nan", "1e7", "'1'", "[1]"}) {
      const std::string complaint = refusal(key + " = " + value);
      EXPECT_NE(complaint.find("key '" + key + "'"), std::string::npos) << key << " = " << value << ": " << complaint;
      EXPECT_EQ(complaint.find('\n'), std::string::npos);
    }
  }
  for (const std::string key : {"step", "restitution", "mass_ratio"}) {
    for (const char* value : {"-1", "inf", "nan", "1e17"}) {
      const std::string complaint = refusal(key + " = [" + value + "]");
      EXPECT_NE(complaint.find("key '" + key + "'"), std::string::npos) << key << " = " << value << ": " << complaint;
      EXPECT_EQ(complaint.find('\n'), std::string::npos);
    }
  }
  for (const char* text : {"step = [0]",
                           "step = []",
                           "step = 0.1",
                           "step = [0.3]",
                           "step = [1e-6]",
                           "step = [0.01, 0.01]",
                           "restitution = [1.01]",
                           "mass_ratio = [0]",
                           "mass_ratio = [0.5]",
                           "bounces = 0",
                           "runs = 1",
                           "runs = 1e6",
                           "run_bounces = 0",
                           "rounds = 0",
                           "digits = 8",
                           "digits = -1",
                           "policy = ['project']",
                           "scenario = ['pi']",
                           "scenario = []",
                           "radius = 1e-4",
                           "radius = 11",
                           "mass = 1",
                           "gravitty = 9"}) {
    EXPECT_NE(refusal(text), "") << text;
  }
  EXPECT_NE(refusal("step = [0.3]").find("gravity adds 0.0001 to 0.5 of the impact speed"), std::string::npos);
  EXPECT_NE(refusal("policy = ['project_flp']").find("did you mean 'project_flip'?"), std::string::npos);
  EXPECT_NE(refusal("radius = 11").find("times the height"), std::string::npos);
}

}  // namespace
}  // namespace thinwall
