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

std::unique_ptr<Run> race_run(std::string_view text) {
  return run_of(work_precision_experiment(), text, {.seed = 3, .trials = {}});
}

using Racers = std::vector<Racer>;

/// All racers of the races that the settings ask for: of each set and scalar those of hits, misses and grazes.
std::vector<Racers> run_races(std::string_view text) {
  std::vector<Racers> races;
  for (const std::string& line : results_of(race_run(text)->units())) races.push_back(from_text<Racers>(line));
  return races;
}

/// Those of every method on two sets, run once.
const std::vector<Racers>& races() {
  static const std::vector<Racers> all = run_races(small_toml("work_precision"));
  return all;
}

const Racer& racer_of(const Racers& racers, std::string_view method) {
  return *std::ranges::find(racers, method, &Racer::method);
}

/// Race `i` is of hits, misses and grazes in turn.
void expect_class(std::size_t i, std::int64_t touching) {
  const std::int64_t least = i % 3 == 0 ? 40 : i % 3 == 1 ? 0 : 6, most = i % 3 == 0 ? 40 : i % 3 == 1 ? 0 : 34;
  EXPECT_TRUE(least <= touching && touching <= most) << touching << " of 40 in race " << i;
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

/// The poses of n substeps are 1/n apart, so that what is seen is seen that late at most.
TEST(WorkPrecision, methods_err_as_they_claim) {
  double latest = 0;
  for (std::size_t i = 0; i < races().size(); ++i) {
    expect_class(i, races()[i].front().touching);
    for (const Racer& r : races()[i]) {
      SCOPED_TRACE(r.method + " " + r.setting);
      const bool never_late =
          r.method == "conservative_advancement" || r.method == "inclusion" || r.method == "speculative";
      if (never_late || r.method == "bisection" || r.method == "closed_form" || r.method == "swept_volume_ray") {
        EXPECT_EQ(r.missed, 0);
      }
      EXPECT_EQ(r.nanoseconds.size(), 3u);
      EXPECT_GT(std::ranges::min(r.nanoseconds), 0);
      if (r.method == "substeps" && r.touching > r.missed) {
        latest = std::max(latest, r.latest);
        EXPECT_GE(r.earliest, -rounding) << "a pose that touches is no earlier than first contact";
      }
      if (r.touching == 0 || !finishes(r)) continue;
      EXPECT_LE(r.latest, never_late ? 0 : 1);
      EXPECT_LE(r.time.max, r.method == "bisection" ? *r.option + rounding : 1);
      EXPECT_LE(r.time.median, r.method == "inclusion" ? *r.option : 1)
          << "the tolerance over the cosine of incidence bounds it only";
      if (r.method == "closed_form") {
        EXPECT_LE(r.forward, 4);
        EXPECT_LE(r.time.p99, 1e-4);
      }
      EXPECT_LE(r.time.median, r.time.p99);
      EXPECT_LE(r.time.p99, r.time.max);
    }
  }
  EXPECT_LE(latest, 1.0 / 8 + rounding);
  EXPECT_GT(latest, 1.0 / 16);
}

TEST(WorkPrecision, a_missed_contact_is_an_infinite_error) {
  const Racer& r = racer_of(races()[0], "end_of_step");
  EXPECT_GT(r.missed, 20);
  EXPECT_TRUE(std::isinf(r.time.median));
  EXPECT_FALSE(finishes(r));
}

/// As methods claim, by a truth that is none of theirs: what leaves the turn out misses, and hits what is not there.
TEST(WorkPrecision, what_turns_is_raced_against_its_own_truth) {
  const std::vector<Racers> turning = run_races(R"(
    set = ["turning_rod_wall", "turning_box_box"]
    scalar = ["double"]
    queries = 40
    rounds = 2
    substeps = [8]
    tolerance = [1e-6]
  )");
  ASSERT_EQ(turning.size(), 6u);
  std::int64_t swept_past = 0, swept_into = 0;
  for (std::size_t i = 0; i < turning.size(); ++i) {
    for_each_type(TurningMethods<double>{}, [&]<class Method>(TypeTag<Method>) {
      EXPECT_TRUE(std::ranges::count(turning[i], Method::name, &Racer::method)) << Method::name;
    });
    const Racer& advancement = racer_of(turning[i], "conservative_advancement");
    const Racer& speculative = racer_of(turning[i], "speculative");
    const Racer& substeps = racer_of(turning[i], "substeps");
    expect_class(i, advancement.touching);
    EXPECT_EQ(advancement.missed, 0);
    EXPECT_EQ(speculative.missed, 0);
    if (i % 3 == 0) {
      EXPECT_LE(advancement.latest, 0);
      EXPECT_LE(advancement.time.median, 1e-5);
      EXPECT_LE(speculative.latest, 0);
      EXPECT_LE(substeps.latest, 1.0 / 8 + rounding);
      EXPECT_GE(substeps.earliest, -rounding);
    }
    swept_past += racer_of(turning[i], "linear_sweep").missed;
    swept_into += racer_of(turning[i], "linear_sweep").false_hits;
  }
  EXPECT_GT(swept_past, 0);
  EXPECT_GT(swept_into, 0);
}

/// A racer as none is, for the tests of how they are compared.
Racer made_up(std::string method, double p99, std::vector<double> nanoseconds) {
  Racer racer;
  racer.method = std::move(method);
  racer.queries = racer.touching = 100;
  racer.time = {p99 / 2, p99, 2 * p99};
  racer.nanoseconds = std::move(nanoseconds);
  return racer;
}

Heat heat_of(Racers racers) { return {query_sets().data(), QueryClass::hit, "double", std::move(racers)}; }

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
  const Measured ratio = slowdown(made_up("a", 0, {20, 200, 40}), made_up("b", 0, {10, 100, 20}));
  EXPECT_EQ(ratio.value, 2);
  EXPECT_EQ(ratio.interval.lower, 2);
  EXPECT_EQ(ratio.interval.upper, 2);
}

TEST(WorkPrecisionHeat, who_is_fine_and_faster_than_the_closed_form_is_named) {
  const Racers racers = {made_up("closed_form", 1e-16, {50, 51, 49}), made_up("quick", 1e-13, {40, 41, 39}),
                         made_up("noisy", 1e-13, {30, 60, 52}), made_up("rough", 1e-9, {10, 10, 10})};
  const Heat heat = heat_of(racers);
  EXPECT_EQ(names(fine_and_faster(heat)), Names{"quick"});
  EXPECT_TRUE(holds(work_precision_answer({heat}), "In 0 of 1 races on hits"));
  EXPECT_TRUE(holds(work_precision_answer({heat}), "quick is faster on sphere_wall in double"));
  EXPECT_TRUE(holds(heat_text(heat), "quick is as fine and faster than the closed form"));
  const Heat without = heat_of({racers[0], racers[2], racers[3]});
  EXPECT_TRUE(holds(work_precision_answer({without}), "In 1 of 1 races on hits no method"));
}

TEST(WorkPrecisionHeat, says_where_the_curves_cross_and_by_how_much) {
  const std::string text =
      heat_text(heat_of({made_up("closed_form", 1e-16, {50, 50, 50}), made_up("rough", 1e-2, {10, 10, 10})}));
  EXPECT_TRUE(
      holds(text, "closed_form is the finest (99th percentile error 1.0e-16 of a step) and the cheapest, at 50 ns"));
  EXPECT_TRUE(holds(text, "where 1.0e-02 is good enough the curves cross and rough is, in 0.20 of that"));
}

TEST(WorkPrecisionHeat, false_hits_are_those_among_the_misses) {
  const Heat hits = heat_of({made_up("rash", 1e-3, {1}), made_up("other", 1e-3, {1})});
  Heat misses = hits;
  misses.kind = QueryClass::miss;
  misses.racers[0].false_hits = 25;
  EXPECT_EQ(false_share({hits, misses}, hits, hits.racers[0]), 0.25);
  EXPECT_EQ(false_share({hits, misses}, hits, hits.racers[1]), 0.0);
  EXPECT_FALSE(false_share({hits}, hits, hits.racers[0]));
}

TEST(WorkPrecisionHeat, a_closed_form_that_errs_fails_the_self_test) {
  const auto keeps = [](double forward, std::int64_t false_hits) {
    Racer exact = made_up("closed_form", 1e-16, {50});
    exact.forward = forward;
    exact.false_hits = false_hits;
    return keeps_contract(heat_of({exact}));
  };
  EXPECT_TRUE(keeps(3.9, 0));
  EXPECT_FALSE(keeps(4.1, 0));
  EXPECT_FALSE(keeps(1, 1));
}

/// Where nothing has a closed form, the answer and the self-test are of what is never late.
TEST(WorkPrecisionHeat, of_what_turns_who_claims_to_be_never_late_is_held_to_it) {
  Racer exact = made_up("conservative_advancement", 1e-9, {1500}), sweep = made_up("linear_sweep", 1e-2, {100});
  exact.latest = -1e-12;
  sweep.missed = 7;
  Heat heat{&*std::ranges::find_if(query_sets(), &QuerySet::turns), QueryClass::hit, "double", {exact, sweep}};
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

TEST(WorkPrecisionResult, leaves_out_pictures_of_nothing) {  // gnuplot minds
  const auto run = race_run("method = [\"end_of_step\"]\nset = [\"sphere_wall\"]\nqueries = 40\nrounds = 2");
  for (const Figure& figure : outcome_of(*run).figures) {
    for (const Panel& panel : figure.panels) {
      const auto is_seen = [](const Series& series) { return series.mark == Mark::points && !series.x.empty(); };
      EXPECT_TRUE(std::ranges::any_of(panel.series, is_seen)) << figure.name;
    }
  }
}

TEST(WorkPrecisionConfig, refuses_what_no_method_can_take) {
  const char* unserved = "set = ['box_box']\nmethod = ['swept_volume_ray']";
  expect_refusals(work_precision_experiment(),
                  {{"tolerance = [0]", "2.220446049250313e-16"},
                   {"substeps = [0]", "key 'substeps'"},
                   {"rounds = 0", "key 'rounds'"},
                   {"tolerance = [1e-9]\nscalar = ['float']", "for scalar \"float\" at least one of 1.1"},
                   {unserved, "key 'method'"},
                   {unserved, "for the set \"box_box\" one of"},
                   {unserved, "closed_form; \"swept_volume_ray\" does not serve that pair"}});
}

TEST(WorkPrecisionConfig, leaves_out_what_is_not_served_where_all_are_asked_for) {
  const auto units = [](std::string_view text) { return race_run(text)->units().size(); };
  EXPECT_EQ(units("method = [\"swept_volume_ray\"]\nscalar = [\"double\"]"), 2u * 3) << "the two sets with a ball";
  EXPECT_EQ(units("method = [\"linear_sweep\"]\nscalar = [\"double\"]"), 3u * 3) << "what turns";
}

}  // namespace
}  // namespace thinwall
