/// The crossing bullets' settings and the form of what they hand over.
#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/swept/methods.hpp>

#include "experiments/crossing_bullets_run.hpp"

namespace thinwall {
namespace {

TEST(CrossingBulletsConfig, unit_keys_are_unique) {
  std::vector<std::string> keys;
  for (const Unit& unit : crossing_run("")->units()) keys.push_back(unit.key);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST(CrossingBulletsConfig, trials_override_the_shots) {
  EXPECT_EQ(crossing_run(few_crossings, {.seed = 1, .trials = 7})->units().front().trials, 7);
}

TEST(CrossingBulletsConfig, opens_with_the_head_on_bullets_and_leaves_out_no_relative_motion) {
  const Experiment experiment = crossing_bullets_experiment();
  const auto cells = make_crossings(Settings("", "test.toml", experiment.default_toml));
  EXPECT_EQ(cells.front(), head_on);
  EXPECT_EQ(std::count(cells.begin(), cells.end(), head_on), 1);
  for (const Crossing& c : cells) EXPECT_GT(relative_path(c).norm(), 0) << key(c);
}

TEST(CrossingBulletsConfig, every_row_is_as_long_as_its_columns_and_every_column_is_described) {
  for (const Table& t : crossing_outcome(few_crossings).tables) {
    for (const std::vector<Value>& row : t.rows) ASSERT_EQ(row.size(), t.columns.size()) << t.name;
    for (const Column& column : t.columns) {
      EXPECT_FALSE(column.description.empty()) << t.name << " " << column.name;
      EXPECT_EQ(column.unit.empty(), column.type == ColumnType::text || column.type == ColumnType::boolean)
          << t.name << " " << column.name;
    }
  }
}

TEST(CrossingBulletsConfig, summary_fits_a_terminal_and_opens_with_the_head_on_bullets) {
  std::istringstream summary(crossing_outcome(few_crossings).summary);
  std::string line;
  for (int number = 0; std::getline(summary, line); ++number) {
    EXPECT_LE(line.size(), 100U) << line;
    if (number == 0) {
      EXPECT_NE(line.find("head-on"), std::string::npos);
    }
  }
}

/// A method of the list needs no line here to be asked.
TEST(CrossingBulletsConfig, asks_every_method_of_the_list_that_serves_two_spheres) {
  const auto names = crossing_rule_names();
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, Sphere<double>, Sphere<double>>) {
      EXPECT_NE(std::find(names.begin(), names.end(), Method::name), names.end()) << Method::name;
    }
  });
  const Outcome outcome = crossing_outcome("rule = ['all']\nspeed = [10]\nratio = [1]\nangle_deg = [90]\nshots = 20");
  EXPECT_EQ(table_of(outcome, "rules").rows.size(), names.size());
}

/// Without the rules of the question there is still an answer.
TEST(CrossingBulletsConfig, answers_for_any_choice_of_rules) {
  const Outcome outcome =
      crossing_outcome("rule = ['bisection']\nspeed = [10]\nratio = [1]\nangle_deg = [90]\nshots = 20");
  EXPECT_NE(outcome.answer.find("bisection misses 0 of"), std::string::npos) << outcome.answer;
  EXPECT_TRUE(outcome.figures.empty());
}

TEST(CrossingBulletsConfig, refuses_what_cannot_be_asked) {
  const auto refusal = [](const char* text) -> std::string {
    try {
      crossing_run(text);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  for (const char* text : {"speed = [0]",
                           "speed = [nan]",
                           "speed = []",
                           "step = 0",
                           "step = [0.1]",
                           "radius = 0",
                           "radius = -1",
                           "ratio = [1.5]",
                           "ratio = [-0.1]",
                           "angle_deg = [181]",
                           "angle_deg = [-1]",
                           "offset = [0.5]",
                           "offset = [inf]",
                           "shots = 0",
                           "rule = ['sweep']",
                           "ofset = [1]",
                           "speed = [1e-6]",
                           "speed = [1e8]",
                           "ratio = [1]\nangle_deg = [1e-9]",
                           "ratio = [1]\nangle_deg = [0]"}) {
    EXPECT_NE(refusal(text), "") << text;
  }
  EXPECT_NE(refusal("rule = ['sweep_then_confrm']").find("did you mean 'sweep_then_confirm'?"), std::string::npos);
  EXPECT_NE(refusal("speed = [1e8]").find("a path of 0.01 to 10000 contact distances a step"), std::string::npos);
  EXPECT_NE(refusal("ratio = [1]\nangle_deg = [1e-9]").find("not so at ratio 1"), std::string::npos);
  EXPECT_NE(refusal("angle_deg = [181]").find("key 'angle_deg'"), std::string::npos);
}

TEST(CrossingTally, survives_its_line) {
  CrossingTally tally;
  EXPECT_EQ(crossing_tally_from_line(to_line(tally)), tally);
  tally = {.shots = 9,
           .touching = 8,
           .missed = 7,
           .false_hits = 6,
           .undecided = 5,
           .evaluations = 4,
           .timed = 3,
           .lateness = -2,
           .causes = {.inside = 1, .too_early = 2, .too_late = 3, .beside = 4},
           .latest = 1.0 / 3,
           .earliest = -1e-300,
           .widest = -0.1,
           .deepest = -0.2};
  EXPECT_EQ(crossing_tally_from_line(to_line(tally)), tally);
  EXPECT_THROW(crossing_tally_from_line("1 2 3"), std::runtime_error);
  EXPECT_THROW(crossing_tally_from_line(to_line(tally) + " 4"), std::runtime_error);
}

}  // namespace
}  // namespace thinwall
