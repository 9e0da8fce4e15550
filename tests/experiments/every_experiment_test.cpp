/// The rules of the house, for every experiment of the list, on its small configuration.
#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/table_text.hpp>
#include <thinwall_embedded.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {
namespace {

class EveryExperiment : public testing::TestWithParam<std::string_view> {
 protected:
  const Experiment& experiment() const { return called(experiments(), GetParam()); }
  std::string small() const { return small_toml(GetParam()); }
  std::unique_ptr<thinwall::Run> configured(const std::string& text,
                                            RunOptions options = {.seed = 1, .trials = {}}) const {
    return run_of(experiment(), text, options);
  }
  /// It times programs that stand beside our own: tests/experiments/speed_test.cpp has some for it.
  bool needs_programs() const { return GetParam() == "speed"; }
};

#define SKIP_IF_IT_NEEDS_PROGRAMS() \
  if (needs_programs()) GTEST_SKIP() << "it asks benchmark programs, which its own tests stand in for"

TEST_P(EveryExperiment, asks_a_question_and_has_defaults_and_a_page) {
  EXPECT_TRUE(experiment().question.ends_with('?'));
  EXPECT_FALSE(experiment().default_toml.empty());
  const std::string_view page = embedded_page(GetParam());
  for (const char* heading : {"\n## What is asked\n", "\n## Limits\n"}) EXPECT_TRUE(holds(page, heading)) << heading;
}

TEST_P(EveryExperiment, names_every_unit_apart) {
  SKIP_IF_IT_NEEDS_PROGRAMS();
  std::set<std::string> keys;
  for (const Unit& unit : configured(small())->units()) {
    EXPECT_TRUE(keys.insert(unit.key).second) << unit.key;
    EXPECT_EQ(unit.key.find_first_of("\t\n"), std::string::npos) << unit.key;
    EXPECT_GT(unit.trials, 0) << unit.key;
  }
}

TEST_P(EveryExperiment, lets_an_option_choose_the_trials) {
  SKIP_IF_IT_NEEDS_PROGRAMS();
  if (GetParam() == "broad_phase") GTEST_SKIP() << "its trials are rounds of timing, and a unit counts balls";
  const auto trials = [](const thinwall::Run& run) {
    std::int64_t all = 0;
    for (const Unit& unit : run.units()) all += unit.trials;
    return all;
  };
  const auto few = configured(small(), {.seed = 1, .trials = 60}),
             more = configured(small(), {.seed = 1, .trials = 600});
  EXPECT_LT(trials(*few), trials(*more));
  EXPECT_THROW(configured(small(), {.seed = 1, .trials = 0}), UsageError);
}

/// Rows of tables on the small configuration: nothing that is judged is left out.
constexpr std::tuple<std::string_view, std::string_view, std::size_t> table_sizes[] = {
    {"thin_wall", "self_test", 22},  {"thin_wall", "stratified", 11}, {"swept_bounds", "self_test", 24},
    {"bouncing", "self_test", 5},    {"bouncing", "cells", 45},       {"bouncing", "means", 15},
    {"hitscan", "self_test", 13},    {"hitscan", "moments", 8},       {"crossing_bullets", "self_test", 13},
    {"crossing_bullets", "times", 3}};

/// Computed in whatever order, by whatever thread, in whatever time: tables and figures without times are the same to the byte. And
/// what they hold is described.
TEST_P(EveryExperiment, does_not_depend_on_the_order_of_its_units) {
  SKIP_IF_IT_NEEDS_PROGRAMS();
  const auto run = configured(small());
  std::vector<Unit> units = run->units();
  const std::vector<double> seconds(units.size(), 1e-3);
  const Outcome forward = run->finish(results_of(units), seconds);
  std::ranges::reverse(units);
  std::vector<std::string> results = results_of(units);
  std::ranges::reverse(results);
  const Outcome backward = run->finish(results, std::vector<double>(units.size(), 2e-3));
  ASSERT_EQ(forward.tables.size(), backward.tables.size());
  for (std::size_t i = 0; i < forward.tables.size(); ++i) {
    if (forward.tables[i].is_timing) continue;
    EXPECT_EQ(csv_text(forward.tables[i]), csv_text(backward.tables[i])) << forward.tables[i].name;
  }
  ASSERT_EQ(forward.figures.size(), backward.figures.size());
  for (std::size_t i = 0; i < forward.figures.size(); ++i) {
    if (forward.figures[i].is_timing) continue;
    EXPECT_EQ(plot_data(forward.figures[i]), plot_data(backward.figures[i])) << forward.figures[i].name;
  }
  expect_readable(forward);
  for (const auto& [of, table, rows] : table_sizes) {
    if (of != GetParam()) continue;
    EXPECT_EQ(table_of(forward, table).rows.size(), rows) << table;
  }
  EXPECT_TRUE(forward.self_test_passed) << forward.summary;
}

/// A journal of numbers that are none of its own: the results of two units in each other's places, or another length or time everywhere.
/// No count of it fits, or no error is small.
TEST_P(EveryExperiment, fails_the_self_test_of_results_that_are_wrong) {
  SKIP_IF_IT_NEEDS_PROGRAMS();
  if (GetParam() == "broad_phase" || GetParam() == "plan") GTEST_SKIP() << "its own tests make up what its units find";
  const auto run =
      configured(small() + (GetParam() == "engines" ? "engine = ['thinwall']\n" : ""));  // others' are not judged
  const std::vector<std::string> right = results_of(run->units());
  std::vector<std::string> swapped = right, far = right;
  std::swap(swapped[0], swapped[1]);
  for (std::string& result : far) result = std::regex_replace(result, std::regex("-?0x[^ ]+"), "0x1p+30");
  bool all_pass = true;
  for (const std::vector<std::string>& wrong : {swapped, far}) {
    const Outcome outcome = run->finish(wrong, std::vector<double>(wrong.size(), 1e-3));
    EXPECT_FALSE(outcome.self_test_passed && holds(outcome.summary, "FAILED")) << outcome.summary;
    all_pass = all_pass && outcome.self_test_passed;
  }
  EXPECT_FALSE(all_pass);
}

/// The first of the names that a key takes in this build, as the refusal of another lists them: an engine may not be in it.
std::string first_name_of(const Experiment& experiment, std::string_view key) {
  const auto refusal = [&](const std::string& name) {
    return refusal_of(experiment, fmt::format("{} = ['{}']", key, name));
  };
  const std::string known = refusal("no such thing");
  const std::size_t from = known.find("allowed: ") + 9;
  std::istringstream names(known.substr(from, known.find(')', from) - from));
  for (std::string name; names >> name;) {
    if (name.ends_with(',')) name.pop_back();
    if (refusal(name).empty()) return name;
  }
  return "all";
}

/// Of every list of settings the last value alone, and of all names one: what is left has an answer, and each cell the numbers that it has
/// among all.
TEST_P(EveryExperiment, a_cell_keeps_its_numbers_whatever_else_is_asked) {
  SKIP_IF_IT_NEEDS_PROGRAMS();
  toml::table last = toml::parse(experiment().default_toml);
  const toml::table all = toml::parse(small());
  for (const auto& [key, value] : all) last.insert_or_assign(key, value);
  for (auto&& [key, value] : last) {
    toml::array* const list = value.as_array();
    if (list == nullptr || list->empty()) continue;
    list->erase(list->begin(), list->end() - 1);
    if (list->front().value<std::string>() == "all")
      list->replace(list->begin(), first_name_of(experiment(), key.str()));
  }
  std::ostringstream text;
  text << last;
  const Outcome whole = outcome_of(experiment(), small()), part = outcome_of(experiment(), text.str());
  expect_readable(part);
  const std::set<std::string> of_cells = {"bounces", "cells",  "crowds", "errors", "even_phases", "flights",
                                          "gate",    "limits", "pairs",  "passes", "stages",      "ways"};
  std::size_t compared = 0;
  for (const Table& table : part.tables) {
    if (!of_cells.contains(table.name)) continue;
    const std::vector<std::vector<Value>>& rows = table_of(whole, table.name).rows;
    for (const std::vector<Value>& row : table.rows) EXPECT_EQ(std::ranges::count(rows, row), 1) << table.name;
    EXPECT_FALSE(table.is_timing) << table.name;
    compared += table.rows.size();
  }
  EXPECT_GT(compared, 0U) << "the name of its table of cells is missing above";
}

TEST_P(EveryExperiment, refuses_by_name_what_a_key_may_not_be) {
  const toml::table keys = toml::parse(experiment().default_toml);
  for (const auto& [key, value] : keys) {
    if (key.str() == "experiment" || value.is_string()) continue;
    for (const char* wrong : {"nan", "[nan]", "[]", "'no such thing'", "['no such thing']", "-1", "[-1]", "1e300",
                              "[1e300]", "1979-05-27"}) {
      if (value.is_boolean() && std::string_view(wrong) == "nan") continue;
      const std::string text = std::string(key.str()) + " = " + wrong;
      EXPECT_TRUE(holds(refusal_of(experiment(), text), std::string(key.str()))) << text;
    }
  }
  EXPECT_THROW(configured("no_such_key = 1"), UsageError);
}

INSTANTIATE_TEST_SUITE_P(Lab, EveryExperiment, testing::ValuesIn(names_of(experiments())),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace thinwall
