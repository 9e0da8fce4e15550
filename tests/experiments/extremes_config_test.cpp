/// The precision ladder's settings and the form of what it hands over.
#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "experiments/extremes_run.hpp"

namespace thinwall {
namespace {

TEST(ExtremesConfig, unit_keys_are_unique) {
  std::set<std::string> keys;
  const std::vector<Unit> units = extreme_run("")->units();
  for (const Unit& unit : units) keys.insert(unit.key);
  EXPECT_EQ(keys.size(), units.size());
}

TEST(ExtremesConfig, trials_override_the_queries_and_few_are_asked_at_50_digits) {
  const auto run = run_of(extremes_experiment(), "pair = ['obb_obb']\nprecision = ['float', '50_digits']",
                          {.seed = 1, .trials = 17});
  for (const Unit& unit : run->units()) {
    EXPECT_EQ(unit.trials, unit.key.find("50_digits") == std::string::npos ? 17 : 3) << unit.key;
  }
}

TEST(ExtremesConfig, only_boxes_are_thin) {
  for (const Unit& unit : extreme_run("axis = ['thickness']")->units()) {
    EXPECT_TRUE(unit.key.find("aabb") != std::string::npos || unit.key.find("obb") != std::string::npos) << unit.key;
  }
}

TEST(ExtremesConfig, every_row_is_as_long_as_its_columns_and_every_column_is_described) {
  const Outcome outcome = extreme_outcome(few_extremes);
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_EQ(outcome.tables.size(), 5U);
  for (const Table& t : outcome.tables) {
    EXPECT_FALSE(t.rows.empty()) << t.name;
    for (const std::vector<Value>& row : t.rows) ASSERT_EQ(row.size(), t.columns.size()) << t.name;
    for (const Column& column : t.columns) {
      EXPECT_FALSE(column.description.empty()) << t.name << " " << column.name;
      EXPECT_EQ(column.unit.empty(), column.type == ColumnType::text || column.type == ColumnType::boolean)
          << t.name << " " << column.name;
    }
  }
  std::istringstream summary(outcome.summary);
  for (std::string line; std::getline(summary, line);) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_NE(outcome.answer.find("closed form"), std::string::npos) << outcome.answer;
}

/// What is hashed has no times in it.
TEST(ExtremesConfig, tables_are_the_same_in_any_order_but_for_times) {
  const auto run = extreme_run(few_extremes);
  std::vector<Unit> units = run->units();
  const std::vector<std::string> forward = results_of(units);
  std::reverse(units.begin(), units.end());
  std::vector<std::string> backward = results_of(units);
  std::reverse(backward.begin(), backward.end());
  const Outcome one = run->finish(forward, {}), other = run->finish(backward, {});
  for (std::size_t i = 0; i < one.tables.size(); ++i) {
    if (one.tables[i].is_timing) continue;
    EXPECT_EQ(one.tables[i].rows, other.tables[i].rows) << one.tables[i].name;
  }
  EXPECT_TRUE(table_of(one, "ladder").is_timing);
  EXPECT_TRUE(table_of(one, "timings").is_timing);
}

TEST(ExtremesConfig, heat_maps_have_a_cell_for_all_that_is_asked) {
  const Outcome outcome = extreme_outcome(few_extremes);
  const Figure& verdicts = outcome.figures.front();
  EXPECT_EQ(verdicts.name, "verdicts");
  ASSERT_EQ(verdicts.panels.size(), 2U);            // a precision each
  const std::vector<std::size_t> columns = {3, 4};  // in float, 1e-100 is not asked
  for (std::size_t p = 0; p < 2; ++p) {
    const Panel& panel = verdicts.panels[p];
    std::size_t cells = 0;
    for (const Series& series : panel.series) cells += series.x.size();
    EXPECT_EQ(cells, columns[p] * panel.y_tics.size());
    EXPECT_EQ(panel.x_tics.size(), 4U);
  }
}

TEST(ExtremesConfig, answers_for_any_choice) {
  for (const char* text : {"method = ['bisection']", "method = ['textbook']", "pair = ['capsule_triangle']"}) {
    const Outcome outcome =
        extreme_outcome(std::string(text) + "\naxis = ['ratio']\nratio = [1]\nqueries = 2\nprecision = ['double']");
    EXPECT_FALSE(outcome.answer.empty()) << text;
    EXPECT_FALSE(outcome.summary.empty()) << text;
  }
}

TEST(ExtremesConfig, refuses_what_cannot_be_asked) {
  const auto refusal = [](const char* text) -> std::string {
    try {
      extreme_run(text);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  for (const char* text : {"scale = [0]",          "scale = [1e-200]",
                           "scale = [inf]",        "distance = [0.5]",
                           "distance = [1e16]",    "distance = []",
                           "speed = [0]",          "thickness = [2]",
                           "thickness = [0]",      "offset = [1e13]",
                           "offset = [nan]",       "grazing = [1]",
                           "grazing = [-0.1]",     "ratio = [0]",
                           "queries = 0",          "one_in_at_50_digits = 0",
                           "precision = ['half']", "pair = ['ball_ball']",
                           "method = ['exact']",   "axis = ['time']",
                           "tolerance = 0.5",      "tolerance = 1e7",
                           "scales = [1]",         "pair = ['capsule_obb']\nprecision = ['50_digits']"}) {
    EXPECT_NE(refusal(text), "") << text;
  }
  EXPECT_NE(refusal("grazing = [1]").find("key 'grazing'"), std::string::npos);
  EXPECT_NE(refusal("axis = ['grazin']").find("did you mean 'grazing'?"), std::string::npos);
}

TEST(ExtremeTally, survives_its_line) {
  ExtremeTally a;
  a.method = "closed_form";
  ExtremeTally b = a;
  b = {.method = "textbook",
       .queries = 12,
       .touching = 11,
       .changed = 10,
       .wrong = 9,
       .far_wrong = 8,
       .gave_up = 7,
       .invalid = 6,
       .timed = 5,
       .worst_wrong = 1e50,
       .forward_median = 1.0 / 3,
       .forward_max = 4,
       .backward_median = 0.1,
       .backward_max = 1e300,
       .loss_rms = 2e-9,
       .loss_max = 7,
       .nanoseconds = 12.5};
  EXPECT_EQ(extreme_tallies_from_line(to_line({a, b})), (std::vector<ExtremeTally>{a, b}));
  EXPECT_TRUE(extreme_tallies_from_line("").empty());
  EXPECT_THROW(extreme_tallies_from_line("closed_form 1 2 3"), std::runtime_error);
  EXPECT_THROW(extreme_tallies_from_line(to_line({a}) + " 4"), std::runtime_error);
}

}  // namespace
}  // namespace thinwall
