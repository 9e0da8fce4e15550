/// The races: what each method's errors must be, whatever its times are; how racers are compared, with made-up ones whose place is
/// known; and what the result says of them.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/work_precision/model.hpp>
#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/turning/turning_methods.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {
namespace {

/// Every method on two sets, small enough for a debug build.
constexpr std::string_view few_races = R"(
  set = ["sphere_wall", "capsule_box"]
  queries = 40
  rounds = 3
  substeps = [8]
  tolerance = [1e-5, 1e-2]
)";

std::unique_ptr<Run> race_run(std::string_view text) {
  return run_of(work_precision_experiment(), text, {.seed = 3, .trials = {}});
}

std::vector<std::string> run_races(std::string_view text) { return results_of(race_run(text)->units()); }

Outcome race_outcome(std::string_view text) { return outcome_of(*race_run(text)); }

constexpr std::string_view few_turning_races = R"(
  set = ["turning_rod_wall", "turning_box_box"]
  scalar = ["double"]
  queries = 40
  rounds = 2
  substeps = [8]
  tolerance = [1e-6]
)";

/// A racer as none is, for the tests of how they are compared.
Racer made_up(std::string method, double p99, std::vector<double> nanoseconds) {
  Racer racer;
  racer.method = std::move(method);
  racer.queries = racer.touching = 100;
  racer.time = {p99 / 2, p99, 2 * p99};
  racer.nanoseconds = std::move(nanoseconds);
  return racer;
}

/// All racers of the small races, run once.
const std::vector<std::vector<Racer>>& races() {
  static const std::vector<std::vector<Racer>> all = [] {
    std::vector<std::vector<Racer>> parsed;
    for (const std::string& line : run_races(few_races)) parsed.push_back(from_text<std::vector<Racer>>(line));
    return parsed;
  }();
  return all;
}

constexpr double rounding = 1e-6;  // [1] of a step: above what float can resolve

TEST(WorkPrecision, every_method_of_the_list_that_serves_the_pair_takes_part_at_every_setting) {
  std::map<std::string, int> settings;
  for (const Racer& r : races()[0]) ++settings[r.method];  // a ball and a wall, in double
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    constexpr bool served = serves<Method, Sphere<double>, Aabb<double>>;
    EXPECT_EQ(settings.contains(std::string(Method::name)), served) << Method::name;
  });
  EXPECT_EQ(settings.at("conservative_advancement"), 2);
  EXPECT_EQ(settings.at("closed_form"), 1);
}

TEST(WorkPrecision, classes_are_what_they_say) {
  for (std::size_t i = 0; i < races().size(); ++i) {
    const std::int64_t touching = races()[i].front().touching;
    if (i % 3 == 0) {
      EXPECT_EQ(touching, 40) << "hits";
    } else if (i % 3 == 1) {
      EXPECT_EQ(touching, 0) << "misses";
    } else {
      EXPECT_TRUE(touching > 5 && touching < 35) << touching << " of 40 grazes";
    }
  }
}

TEST(WorkPrecision, methods_err_as_they_claim) {
  for (const auto& racers : races()) {
    for (const Racer& r : racers) {
      SCOPED_TRACE(r.method + " " + r.setting);
      const bool never_late =
          r.method == "conservative_advancement" || r.method == "inclusion" || r.method == "speculative";
      if (never_late || r.method == "bisection" || r.method == "closed_form" || r.method == "swept_volume_ray") {
        EXPECT_EQ(r.missed, 0);
      }
      if (r.touching == 0 || !finishes(r)) continue;
      if (never_late) {
        EXPECT_LE(r.latest, 0);
      }
      if (r.method == "bisection") {
        EXPECT_LE(r.time.max, *r.option + rounding);
      }
      if (r.method == "inclusion") {
        EXPECT_LE(r.time.median, *r.option) << "the tolerance over the cosine of incidence bounds it only";
      }
      if (r.method == "closed_form") {
        EXPECT_LE(r.forward, 4);
        EXPECT_LE(r.time.p99, 1e-4);
      }
      EXPECT_LE(r.time.median, r.time.p99);
      EXPECT_LE(r.time.p99, r.time.max);
    }
  }
}

/// The poses of n substeps are 1/n apart, so that what is seen is seen that late at most.
TEST(WorkPrecision, substeps_are_late_by_up_to_one_of_them) {
  double latest = 0;
  for (const auto& racers : races()) {
    for (const Racer& r : racers) {
      if (r.method != "substeps" || r.touching == r.missed) continue;
      latest = std::max(latest, r.latest);
      EXPECT_GE(r.earliest, -rounding);
    }
  }
  EXPECT_LE(latest, 1.0 / 8 + rounding);
  EXPECT_GT(latest, 1.0 / 16);
}

TEST(WorkPrecision, a_missed_contact_is_an_infinite_error) {
  for (const Racer& r : races()[0]) {
    if (r.method != "end_of_step") continue;
    EXPECT_GT(r.missed, 20);
    EXPECT_TRUE(std::isinf(r.time.median));
    EXPECT_FALSE(finishes(r));
    return;
  }
  FAIL() << "nobody looks at the end of the step alone";
}

TEST(WorkPrecision, errors_are_the_same_in_every_run) {
  const std::vector<std::string> again = run_races(few_races);
  for (std::size_t i = 0; i < again.size(); ++i) {
    std::vector<Racer> first = races()[i], second = from_text<std::vector<Racer>>(again[i]);
    for (auto* racers : {&first, &second}) {
      for (Racer& r : *racers) {
        EXPECT_EQ(r.nanoseconds.size(), 3u);
        for (const double t : r.nanoseconds) EXPECT_GT(t, 0);
        r.nanoseconds.clear();
      }
    }
    EXPECT_EQ(to_text(first), to_text(second));
  }
}

Heat heat_of(std::vector<Racer> racers) { return {query_sets().data(), QueryClass::hit, "double", std::move(racers)}; }

/// As methods claim, by a truth that is none of theirs: what leaves the turn out misses, and hits what is not there.
TEST(WorkPrecision, what_turns_is_raced_against_its_own_truth) {
  const std::vector<std::string> lines = run_races(few_turning_races);
  ASSERT_EQ(lines.size(), 6u);
  std::int64_t swept_past = 0, swept_into = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::map<std::string, Racer> racers;
    for (const Racer& r : from_text<std::vector<Racer>>(lines[i])) racers[r.method] = r;
    for_each_type(TurningMethods<double>{}, [&]<class Method>(TypeTag<Method>) {
      EXPECT_TRUE(racers.contains(std::string(Method::name))) << Method::name;
    });
    const Racer& advancement = racers["conservative_advancement"];
    if (i % 3 == 0) {
      EXPECT_EQ(advancement.touching, 40) << "hits";
    } else if (i % 3 == 1) {
      EXPECT_EQ(advancement.touching, 0) << "misses";
    } else {
      EXPECT_TRUE(advancement.touching > 5 && advancement.touching < 35) << advancement.touching << " of 40 grazes";
    }
    EXPECT_EQ(advancement.missed, 0);
    EXPECT_EQ(racers["speculative"].missed, 0);
    if (i % 3 == 0) {
      EXPECT_LE(advancement.latest, 0);
      EXPECT_LE(advancement.time.median, 1e-5);
      EXPECT_LE(racers["speculative"].latest, 0);
      EXPECT_LE(racers["substeps"].latest, 1.0 / 8 + rounding);
      EXPECT_GE(racers["substeps"].earliest, -rounding) << "a pose that touches is no earlier than first contact";
    }
    swept_past += racers["linear_sweep"].missed;
    swept_into += racers["linear_sweep"].false_hits;
  }
  EXPECT_GT(swept_past, 0);
  EXPECT_GT(swept_into, 0);
}

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

/// Where nothing has a closed form, the answer and the self-test are of what is never late.
TEST(WorkPrecisionHeat, of_what_turns_who_claims_to_be_never_late_is_held_to_it) {
  const auto turning = std::ranges::find_if(query_sets(), &QuerySet::turns);
  ASSERT_NE(turning, query_sets().end());
  Racer exact = made_up("conservative_advancement", 1e-9, {1500}), sweep = made_up("linear_sweep", 1e-2, {100});
  exact.latest = -1e-12;
  sweep.missed = 7;
  Heat heat{&*turning, QueryClass::hit, "double", {exact, sweep}};
  EXPECT_TRUE(keeps_contract(heat)) << "a linear sweep claims nothing";
  EXPECT_EQ(
      work_precision_answer({heat}),
      "Of shapes that turn, conservative advancement misses nothing in 1 of 1 races: it comes to 1e-09 of a step in "
      "1.5 to 1.5 us a query. A sweep that leaves the turn out misses 7.0 % of the contacts.");
  heat.racers[0].latest = 1e-15;
  EXPECT_FALSE(keeps_contract(heat)) << "late";
  heat.racers[0].latest = -1e-12;
  heat.racers[0].missed = 1;
  EXPECT_FALSE(keeps_contract(heat)) << "missed";
}

TEST(WorkPrecisionResult, keeps_times_out_of_what_is_hashed) {
  const Outcome outcome = race_outcome(few_races);
  EXPECT_TRUE(outcome.self_test_passed);
  for (const Table& table : outcome.tables) EXPECT_EQ(table.is_timing, table.name != "errors") << table.name;
  for (const Figure& figure : outcome.figures) {
    EXPECT_EQ(figure.panels.size(), 2u) << figure.name;
    EXPECT_EQ(figure.is_timing, !figure.name.ends_with("evaluations")) << figure.name;
  }
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
  expect_refusal("substeps = [0]", {"key 'substeps'"});
  expect_refusal("rounds = 0", {"key 'rounds'"});
  expect_refusal("tolerance = [1e-9]\nscalar = [\"float\"]", {"key 'tolerance'", "float"});
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
  EXPECT_EQ(race_run("method = [\"linear_sweep\"]\nscalar = [\"double\"]")->units().size(), 3u * 3) << "what turns";
}

}  // namespace
}  // namespace thinwall
