/// Hitscan's settings and the form of what it hands over.
#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "experiments/hitscan_run.hpp"
#include "support/described_tables.hpp"

namespace thinwall {
namespace {

std::vector<HitscanCell> cells_of(const char* text) {
  const Experiment experiment = hitscan_experiment();
  return make_hitscan_cells(Settings(text, "test.toml", experiment.default_toml));
}

TEST(HitscanConfig, unit_keys_are_unique) {
  std::vector<std::string> keys;
  for (const Unit& unit : hitscan_run("")->units()) keys.push_back(unit.key);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST(HitscanConfig, trials_override_the_shots) {
  EXPECT_EQ(hitscan_run(few_hitscans, {.seed = 1, .trials = 7})->units().front().trials, 7);
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

TEST(HitscanConfig, every_row_is_as_long_as_its_columns_and_every_column_is_described) {
  expect_described_tables(hitscan_outcome(few_hitscans));
}

TEST(HitscanConfig, summary_fits_a_terminal_and_opens_with_the_known_shots) {
  const std::string text = hitscan_outcome(few_hitscans).summary;
  std::istringstream summary(text);
  std::string line;
  while (std::getline(summary, line)) EXPECT_LE(line.size(), 100U) << line;
  for (const KnownShot& known : known_shots) EXPECT_NE(text.find(known.name), std::string::npos) << known.name;
}

TEST(HitscanConfig, draws_a_picture_of_every_question) {
  const Outcome outcome = hitscan_outcome(few_hitscans);
  ASSERT_EQ(outcome.figures.size(), 3U);
  EXPECT_EQ(outcome.figures[0].name, "missed");
  EXPECT_EQ(outcome.figures[1].name, "path_error");
  EXPECT_EQ(outcome.figures[2].name, "lateness");
  for (const Figure& figure : outcome.figures) {
    for (const Panel& panel : figure.panels) {
      for (const Series& s : panel.series) {
        EXPECT_EQ(s.x.size(), s.y.size()) << figure.name << " " << s.label;
        EXPECT_FALSE(s.x.empty()) << figure.name << " " << s.label;
        EXPECT_TRUE(s.lower.empty() || s.lower.size() == s.x.size()) << figure.name << " " << s.label;
      }
    }
  }
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

TEST(HitscanConfig, refuses_what_cannot_be_asked) {
  const auto refusal = [](const char* text) -> std::string {
    try {
      hitscan_run(text);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  for (const char* text : {"range = [0]",
                           "range = [nan]",
                           "range = []",
                           "range = [0.2]",
                           "speed = [0]",
                           "speed = [-30]",
                           "speed = [3]\nrange = [3]",
                           "radius = [-0.01]",
                           "wind = [-1]",
                           "drag = [-0.1]",
                           "drag = [40]\nspeed = [1000]\nrange = [3]",
                           "step = [0]",
                           "step = [1e-9]",
                           "target = [0]",
                           "target = [2]\nrange = [3]",
                           "gravity = -1",
                           "aim = 1",
                           "aim = inf",
                           "shots = 0",
                           "rule = ['ray']",
                           "rnage = [3]",
                           "speed = [30]\nrange = [100]"}) {
    EXPECT_NE(refusal(text), "") << text;
  }
  EXPECT_NE(refusal("rule = ['next_fram']").find("did you mean 'next_frame'?"), std::string::npos);
  EXPECT_NE(refusal("speed = [3]\nrange = [3]").find("fast enough to fly nearly straight"), std::string::npos);
  EXPECT_NE(refusal("speed = [30]\nrange = [100]").find("a range that some bullet reaches"), std::string::npos);
  EXPECT_NE(refusal("range = [0.2]").find("more than 2 * (target + radius)"), std::string::npos);
  EXPECT_NE(refusal("drag = [40]\nspeed = [1000]\nrange = [3]").find("drag * step at most 0.5"), std::string::npos);
  EXPECT_NE(refusal("step = [1e-9]").find("a path of at least 0.01"), std::string::npos);
  EXPECT_NE(refusal("aim = 1").find("key 'aim'"), std::string::npos);
}

TEST(HitscanTally, survives_its_line) {
  HitscanTally tally;
  EXPECT_EQ(hitscan_tally_from_line(to_line(tally)), tally);
  tally = {.shots = 9,
           .touching = 8,
           .missed = 7,
           .false_hits = 6,
           .lateness = {5, -4, -1.0 / 3, 1e-300},
           .point_error = {3, 2, 0.1, 0.2},
           .path_error = {1, 0, -0.1, 1e300}};
  EXPECT_EQ(hitscan_tally_from_line(to_line(tally)), tally);
  EXPECT_THROW(hitscan_tally_from_line("1 2 3"), std::runtime_error);
  EXPECT_THROW(hitscan_tally_from_line(to_line(tally) + " 4"), std::runtime_error);
}

}  // namespace
}  // namespace thinwall
