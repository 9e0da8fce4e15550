/// How racers are compared, with made-up ones whose place is known; and what the result says of them.

#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>

#include <thinwall/experiments/work_precision/summary.hpp>

#include "experiments/work_precision_run.hpp"

namespace thinwall {
namespace {

Heat heat_of(std::vector<Racer> racers) { return {query_sets().data(), QueryClass::hit, "double", std::move(racers)}; }

std::vector<std::string> names(const std::vector<const Racer*>& racers) {
  std::vector<std::string> all;
  for (const Racer* r : racers) all.push_back(r->method);
  return all;
}

using Names = std::vector<std::string>;

TEST(WorkPrecisionHeat, the_front_is_those_that_nobody_beats_in_both) {
  Racer misses = made_up("misses", 1e-9, {1, 1, 1});
  misses.missed = 1;
  const Heat heat = heat_of({made_up("rough", 1e-2, {10, 10, 10}), made_up("beaten", 1e-3, {60, 60, 60}),
                             made_up("fine", 1e-15, {50, 50, 50}), misses, made_up("middle", 1e-6, {20, 20, 20})});
  EXPECT_EQ(names(pareto_front(heat)), (Names{"fine", "middle", "rough"}));
}

TEST(WorkPrecisionHeat, a_method_stands_with_its_roughest_setting_that_is_fine_or_its_finest) {
  const Heat heat = heat_of({made_up("a", 1e-3, {1}), made_up("a", 1e-13, {2}), made_up("a", 1e-15, {1}),
                             made_up("b", 1e-3, {1}), made_up("b", 1e-5, {9})});
  const auto chosen = one_a_method(heat);
  ASSERT_EQ(names(chosen), (Names{"a", "b"}));
  EXPECT_EQ(chosen[0]->time.p99, 1e-13);
  EXPECT_EQ(chosen[1]->time.p99, 1e-5);
}

TEST(WorkPrecisionHeat, slowdown_is_taken_round_by_round) {
  const Estimate ratio = slowdown(made_up("a", 0, {20, 200, 40}), made_up("b", 0, {10, 100, 20}));
  EXPECT_EQ(ratio.median, 2);
  EXPECT_EQ(ratio.interval.lower, 2);
  EXPECT_EQ(ratio.interval.upper, 2);
}

TEST(WorkPrecisionHeat, who_is_fine_and_faster_than_the_closed_form_is_named) {
  const std::vector<Racer> racers = {made_up("closed_form", 1e-16, {50, 51, 49}), made_up("quick", 1e-13, {40, 41, 39}),
                                     made_up("noisy", 1e-13, {30, 60, 52}), made_up("rough", 1e-9, {10, 10, 10})};
  const Heat heat = heat_of(racers);
  EXPECT_EQ(names(fine_and_faster(heat)), Names{"quick"});
  EXPECT_NE(work_precision_answer({heat}).find("In 0 of 1 races on hits"), std::string::npos);
  EXPECT_NE(work_precision_answer({heat}).find("quick is faster on sphere_wall in double"), std::string::npos);
  EXPECT_NE(heat_text(heat).find("quick is as fine and faster than the closed form"), std::string::npos);
  const Heat without = heat_of({racers[0], racers[2], racers[3]});
  EXPECT_NE(work_precision_answer({without}).find("In 1 of 1 races on hits no method"), std::string::npos);
}

TEST(WorkPrecisionHeat, says_where_the_curves_cross_and_by_how_much) {
  const Heat heat = heat_of({made_up("closed_form", 1e-16, {50, 50, 50}), made_up("rough", 1e-2, {10, 10, 10})});
  const std::string text = heat_text(heat);
  EXPECT_NE(text.find("closed_form is the finest (99th percentile error 1.0e-16 of a step) and the cheapest, at 50 ns"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("where 1.0e-02 is good enough the curves cross and rough is, in 0.20 of that"), std::string::npos)
      << text;
}

TEST(WorkPrecisionHeat, false_hits_are_those_among_the_misses) {
  Heat hits = heat_of({made_up("rash", 1e-3, {1}), made_up("other", 1e-3, {1})});
  Heat misses = hits;
  misses.kind = QueryClass::miss;
  misses.racers[0].false_hits = 25;
  EXPECT_EQ(false_share({hits, misses}, hits, hits.racers[0]), 0.25);
  EXPECT_EQ(false_share({hits, misses}, hits, hits.racers[1]), 0.0);
  EXPECT_FALSE(false_share({hits}, hits, hits.racers[0]));
}

TEST(WorkPrecisionHeat, a_closed_form_that_errs_fails_the_self_test) {
  Racer exact = made_up("closed_form", 1e-16, {50});
  exact.forward = 3.9;
  EXPECT_TRUE(keeps_contract(heat_of({exact})));
  exact.forward = 4.1;
  EXPECT_FALSE(keeps_contract(heat_of({exact})));
  exact.forward = 1;
  exact.false_hits = 1;
  EXPECT_FALSE(keeps_contract(heat_of({exact})));
}

TEST(WorkPrecisionResult, is_whole_and_keeps_times_out_of_what_is_hashed) {
  const Outcome outcome = race_outcome(few_races);
  EXPECT_TRUE(outcome.self_test_passed);
  for (const Table& table : outcome.tables) {
    for (const auto& row : table.rows) ASSERT_EQ(row.size(), table.columns.size()) << table.name;
    EXPECT_EQ(table.is_timing, table.name != "errors") << table.name;
  }
  for (const Figure& figure : outcome.figures) {
    EXPECT_EQ(figure.panels.size(), 2u) << figure.name;
    EXPECT_EQ(figure.is_timing, !figure.name.ends_with("evaluations")) << figure.name;
  }
  std::istringstream summary(outcome.summary);
  for (std::string line; std::getline(summary, line);) EXPECT_LE(line.size(), 110u) << line;
}

void expect_refusal(const std::string& text, const std::vector<std::string>& said) {
  try {
    race_run(text);
    FAIL() << "taken: " << text;
  } catch (const UsageError& error) {
    for (const std::string& part : said)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(WorkPrecisionConfig, refuses_what_no_method_can_take) {
  expect_refusal("tolerance = [0]", {"key 'tolerance'", "2.220446049250313e-16"});
  expect_refusal("tolerance = [-1e-3]", {"key 'tolerance'"});
  expect_refusal("tolerance = [nan]", {"key 'tolerance'", "nan"});
  expect_refusal("tolerance = [1e-17]", {"key 'tolerance'"});
  expect_refusal("tolerance = [1e-9]\nscalar = [\"float\"]", {"key 'tolerance'", "float"});
  expect_refusal("substeps = [0]", {"key 'substeps'"});
  expect_refusal("rounds = 0", {"key 'rounds'"});
  expect_refusal("method = [\"closed_from\"]", {"closed_form"});
  expect_refusal("set = [\"box_box\"]\nmethod = [\"swept_volume_ray\"]",
                 {"key 'method'", "box_box", "conservative_advancement", "closed_form", "swept_volume_ray"});
}

TEST(WorkPrecisionResult, leaves_out_pictures_of_nothing) {  // gnuplot minds
  const Outcome outcome = race_outcome("method = [\"end_of_step\"]\nset = [\"sphere_wall\"]\nqueries = 40\nrounds = 2");
  for (const Figure& figure : outcome.figures) {
    for (const Panel& panel : figure.panels) {
      bool any = false;
      for (const Series& series : panel.series) any = any || (series.mark == Mark::points && !series.x.empty());
      EXPECT_TRUE(any) << figure.name;
    }
  }
}

TEST(WorkPrecisionConfig, leaves_out_what_is_not_served_where_all_are_asked_for) {
  const auto run = race_run("set = [\"all\"]\nmethod = [\"swept_volume_ray\"]\nscalar = [\"double\"]");
  EXPECT_EQ(run->units().size(), 2u * 3) << "the two sets with a ball";
}

}  // namespace
}  // namespace thinwall
