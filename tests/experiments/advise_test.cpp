/// A wish, and advice on it with costs that nobody measured; of a rod that spins, too.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/models/rods.hpp>
#include <thinwall/experiments/models/shots.hpp>
#include <thinwall/experiments/thin_wall/results.hpp>
#include <thinwall/swept/certified.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "support/experiment_run.hpp"
#include "support/reply.hpp"

namespace thinwall {

namespace {

/// The bullet of the textbook: it tunnels 7 times in 10, and a step is 3 1/3 times as long as its contact.
const Wish bullet_wish = {.cell = bullet};

/// Both kinds of steps take `ns`, known to within 1 %.
StepCost costing(double ns) {
  const Measured time = {ns, {0.99 * ns, 1.01 * ns}};
  return {time, time};
}

/// The methods cost 10, 20, 30 ... ns in the order of the list.
Advice advice_on(const Wish& wish) {
  const std::vector<Candidate> methods = candidates(wish);
  std::vector<StepCost> costs;
  for (std::size_t i = 0; i < methods.size(); ++i) costs.push_back(costing(10 * static_cast<double>(i + 1)));
  return advise(wish, methods, costs);
}

const AdviceRow& row_of(const Advice& advice, const std::string& method) {
  const auto row = std::ranges::find_if(advice.rows, [&](const AdviceRow& r) { return r.method.name == method; });
  if (row == advice.rows.end()) throw std::runtime_error("no row of " + method);
  return *row;
}

bool has_row(const Advice& advice, const std::string& method) {
  return std::ranges::any_of(advice.rows, [&](const AdviceRow& row) { return row.method.name == method; });
}

// ---- The choice, with costs that are given: nothing is timed here.

Wish with_step(Wish wish, double step) {
  wish.cell.step = step;
  return wish;
}

TEST(Advice, has_a_row_for_every_method_of_the_list_and_for_the_certified) {
  const Advice advice = advice_on(bullet_wish);
  for (const std::string_view method : method_names()) {
    if (method == "substeps") continue;  // by its numbers of poses
    EXPECT_TRUE(has_row(advice, std::string(method))) << method;
  }
  for (const char* method : {"substeps_2", "substeps_8", "certified"}) EXPECT_TRUE(has_row(advice, method)) << method;
}

TEST(Advice, the_discrete_test_tunnels_by_the_formula) {
  const Advice advice = advice_on(bullet_wish);
  EXPECT_NEAR(*row_of(advice, "end_of_step").theory.probability, 1 - 0.05 / (10.0 / 60), 1e-15);
  EXPECT_FALSE(row_of(advice, "end_of_step").meets);
  EXPECT_EQ(*row_of(advice, "closed_form").theory.probability, 0);
  EXPECT_TRUE(row_of(advice, "closed_form").meets);
  Wish sleek = bullet_wish;
  sleek.cell.radius = 0.001;
  sleek.cell.angle_deg = 60;
  EXPECT_NEAR(*row_of(advice_on(sleek), "end_of_step").theory.probability, 1 - 0.012 / (10.0 / 60 * 0.5), 1e-12);
}

TEST(Advice, offers_the_fewest_poses_that_meet_the_wish) {
  EXPECT_EQ(offered_poses(bullet_wish), (std::vector<std::int64_t>{2, 4, 8}));  // 3 1/3 contacts a step
  Wish wish = bullet_wish;
  wish.miss = 0.11;  // 1 - 3 * 0.3 = 0.1
  EXPECT_EQ(offered_poses(wish), (std::vector<std::int64_t>{2, 3, 8}));
  wish.miss = 0.09;
  EXPECT_EQ(offered_poses(wish), (std::vector<std::int64_t>{2, 4, 8}));
  wish.miss = 0.71;  // the end of the step will do
  EXPECT_EQ(offered_poses(wish), (std::vector<std::int64_t>{2, 8}));
  wish = {.cell = bullet, .late = 0.001};  // 1 mm of 167 mm
  EXPECT_EQ(offered_poses(wish), (std::vector<std::int64_t>{2, 8, 167}));
  wish.late = 1e-6;  // more than the experiment fires
  EXPECT_EQ(offered_poses(wish), (std::vector<std::int64_t>{2, 8}));
}

TEST(Advice, the_longest_step_is_the_formula_turned_round) {
  for (const double miss : {0.0, 0.25, 0.9}) {
    Wish wish = bullet_wish;
    wish.miss = miss;
    const Advice advice = advice_on(wish);
    const double longest = 0.05 / 10 / (1 - miss);
    EXPECT_NEAR(*row_of(advice, "end_of_step").longest_step / longest, 1, 1e-12) << miss;
    EXPECT_NEAR(*row_of(advice, "substeps_8").longest_step / longest, 8, 1e-11) << miss;
    EXPECT_EQ(row_of(advice, "closed_form").longest_step, allowed_step.upper);
  }
}

TEST(Advice, the_longest_step_is_met_and_a_longer_one_is_not) {
  Wish wish = {.cell = bullet, .miss = 0.1, .late = 0.03};
  for (const AdviceRow& row : advice_on(wish).rows) {
    if (!row.longest_step) continue;
    EXPECT_TRUE(meets_wish(wish, row.method.theory(with_step(wish, *row.longest_step).cell))) << row.method.name;
    if (*row.longest_step == allowed_step.upper) continue;
    EXPECT_FALSE(meets_wish(wish, row.method.theory(with_step(wish, *row.longest_step * (1 + 1e-12)).cell)))
        << row.method.name;
  }
}

TEST(Advice, lateness_bounds_the_step_too) {
  const Wish wish = {.cell = bullet, .miss = 1, .late = 0.03};
  const Advice advice = advice_on(wish);
  EXPECT_NEAR(*row_of(advice, "end_of_step").longest_step, 0.003, 1e-15);  // a step of 3 cm
  EXPECT_TRUE(row_of(advice, "centre_ray").meets);                         // late by its radius
  const Advice stricter = advice_on({.cell = bullet, .miss = 1, .late = 0.019});
  EXPECT_FALSE(row_of(stricter, "centre_ray").meets);
  EXPECT_NEAR(*row_of(stricter, "centre_ray").longest_step, 0.0019, 1e-15);
  EXPECT_TRUE(row_of(stricter, "closed_form").meets);
}

TEST(Advice, a_chance_that_is_only_rounding_is_none) {
  EXPECT_TRUE(row_of(advice_on(with_step(bullet_wish, 0.02)), "substeps_4").meets);  // exactly four contacts a step
  EXPECT_EQ(advice_on({.cell = bullet, .miss = 0.7}).advised()->method.name, "end_of_step");
}

TEST(Advice, the_cheapest_that_meets_the_wish_is_advised) {
  const Advice advice = advice_on(bullet_wish);
  EXPECT_EQ(advice.advised()->method.name, "substeps_4");  // the third of the list costs 30, after two that miss
  bool met = true;
  double cost = 0;
  for (const AdviceRow& row : advice.rows) {
    if (met != row.meets) cost = 0;
    EXPECT_TRUE(met || !row.meets) << "what meets the wish comes first";
    EXPECT_GE(row.cost.dearer().value, cost) << "by cost";
    met = row.meets;
    cost = row.cost.dearer().value;
  }
  EXPECT_EQ(advice_on({.cell = bullet, .miss = 1}).advised()->method.name, "end_of_step");
}

/// What is advised on the bullet where every method costs 100 ns but these.
std::string advised_at(const std::map<std::string, StepCost>& costs_of) {
  const std::vector<Candidate> methods = candidates(bullet_wish);
  std::vector<StepCost> costs;
  for (const Candidate& method : methods)
    costs.push_back(costs_of.contains(method.name) ? costs_of.at(method.name) : costing(100));
  return advise(bullet_wish, methods, costs).advised()->method.name;
}

TEST(Advice, the_dearer_kind_of_step_counts) {
  const StepCost clear_is_cheap = {costing(1).clear, costing(200).contact},
                 both_are_not_dear = {costing(90).clear, costing(80).contact};
  EXPECT_EQ(advised_at({{"centre_ray", clear_is_cheap}, {"inclusion", both_are_not_dear}}), "inclusion");
}

TEST(Advice, of_costs_that_cannot_be_told_apart_the_least_late_wins) {
  EXPECT_EQ(advised_at({{"centre_ray", costing(50)}, {"closed_form", costing(50.5)}}), "closed_form");  // within 1 %
  EXPECT_EQ(advised_at({{"centre_ray", costing(50)}, {"closed_form", costing(53)}}), "centre_ray");
}

/// A method that a stranger adds to the list has no theory until he gives one.
TEST(Advice, a_method_without_a_theory_is_listed_and_never_advised) {
  std::vector<Candidate> methods = candidates(bullet_wish);
  methods.push_back({"strangers", 0, true, [](const Cell&) { return Theory{}; }, {}});
  std::vector<StepCost> costs(methods.size(), costing(100));
  costs.back() = costing(1);
  for (const double miss : {0.0, 1.0}) {
    const Advice advice = advise({.cell = bullet, .miss = miss}, methods, costs);
    EXPECT_FALSE(row_of(advice, "strangers").meets);
    EXPECT_FALSE(row_of(advice, "strangers").longest_step);
    EXPECT_NE(advice.advised()->method.name, "strangers");
  }
}

TEST(Advice, a_point_against_a_sheet_is_missed_by_every_pose) {
  Wish wish = bullet_wish;
  wish.cell.radius = wish.cell.thickness = 0;
  const Advice advice = advice_on(wish);
  for (const char* method : {"end_of_step", "substeps_2", "substeps_8"}) {
    EXPECT_EQ(*row_of(advice, method).theory.probability, 1) << method;
    EXPECT_FALSE(row_of(advice, method).longest_step) << method;
  }
  for (const char* method : {"bisection", "sweep_then_confirm"}) {  // measured: 12 % of the shots tunnel
    EXPECT_FALSE(row_of(advice, method).theory.probability) << method;
    EXPECT_FALSE(row_of(advice, method).meets) << method;
  }
  EXPECT_TRUE(row_of(advice, "closed_form").meets);
}

TEST(Advice, of_nothing_is_nothing) { EXPECT_EQ(advise(bullet_wish, {}, {}).advised(), nullptr); }

// ---- What the advice reads like, and what a script gets of it.

std::vector<Wish> all_sorts() {
  std::vector<Wish> wishes(5, bullet_wish);
  wishes[1] = {.cell = {123456.789, 1.0 / 3, 0.0123456789, 1e-9, 89.87654321}, .miss = 0.123456789};
  wishes[1].late = 1.23456789e-7;
  wishes[2].cell.radius = wishes[2].cell.thickness = 0;
  wishes[3].miss = 1;
  wishes[4].cell.speed = 1e-9;
  return wishes;
}

TEST(AdviceText, fits_a_terminal) {
  for (const Wish& wish : all_sorts()) {
    const std::string text = advice_text(advice_on(wish));
    EXPECT_TRUE(text.ends_with(".\n"));
    expect_narrow(text);
  }
}

TEST(AdviceText, has_one_notation_in_a_column) {
  const std::string text = advice_text(advice_on(bullet_wish));
  EXPECT_TRUE(holds(text, "\n  bisection                0          2.48e-09  1.49e-08 "));
  EXPECT_TRUE(holds(text, "\n  end_of_step              70 %       5e-02     3e-01 "));
  EXPECT_TRUE(holds(text, " 0.005 s\n"));
}

TEST(AdviceText, says_what_to_use_and_what_it_costs) {
  EXPECT_EQ(
      advice_sentence(advice_on(bullet_wish)),
      "Use substeps_4: no shot tunnels, none is seen more than 0.0417 m late, and a step takes 30 ns, the least of "
      "the 11 methods here that meet the wish. If a ball in the wall is pushed out the shorter way, 40 % go through, seen "
      "or not. Testing only the end of each step would do from 200 steps a second on.");
  EXPECT_EQ(
      advice_sentence(advice_on({.cell = bullet, .miss = 0.75})),
      "Use end_of_step: 70 % of the shots tunnel, none is seen more than 0.05 m late, and a step takes 10 ns, the "
      "least of the 12 methods here that meet the wish. If a ball in the wall is pushed out the shorter way, 85 % go "
      "through, seen or not.");
  EXPECT_EQ(advice_sentence(advise(bullet_wish, {}, {})), "No method here meets the wish at this step.");
}

TEST(AdviceText, a_bound_is_rounded_to_the_safe_side) {
  EXPECT_EQ(rounded_down_text(0.0199999, 4), "0.01999");
  EXPECT_EQ(rounded_down_text(0.02, 4), "0.02");
  EXPECT_EQ(rounded_down_text(0.005, 4), "0.005");
  EXPECT_EQ(rounded_down_text(999.96, 4), "999.9");
  for (double x = 1e-9; x < 1e9; x *= 1.37) {
    EXPECT_LE(std::stod(rounded_down_text(x, 4)), x);
    EXPECT_GE(std::stod(rounded_down_text(x, 4)), x * 0.9989);
  }
}

TEST(AdviceText, json_has_every_number) {
  const Advice advice = advice_on({.cell = bullet, .late = 0.05});
  const nlohmann::json json = nlohmann::json::parse(advice_json(advice).dump());
  EXPECT_EQ(json["method"], advice.advised()->method.name);
  EXPECT_EQ(json["advice"], advice_sentence(advice));
  EXPECT_EQ(json["step_s"], 1.0 / 60);
  EXPECT_EQ(json["late_m"], 0.05);
  ASSERT_EQ(json["methods"].size(), advice.rows.size());
  for (std::size_t i = 0; i < advice.rows.size(); ++i) {
    const nlohmann::json& row = json["methods"][i];
    EXPECT_EQ(row["method"], advice.rows[i].method.name);
    EXPECT_EQ(row["meets"], advice.rows[i].meets);
    EXPECT_EQ(row["chance"], *advice.rows[i].theory.probability);
    EXPECT_FALSE(row["chance_formula"].get<std::string>().empty()) << row["method"];
    EXPECT_FALSE(row["latest_formula"].get<std::string>().empty()) << row["method"];
    EXPECT_EQ(row["longest_step_s"], *advice.rows[i].longest_step);
    EXPECT_EQ(row["contact_ns"]["median"], advice.rows[i].cost.contact.value);
    EXPECT_EQ(row["clear_ns"]["lower"], advice.rows[i].cost.clear.interval.lower);
  }
}

TEST(AdviceText, json_is_null_where_theory_is_silent) {
  const nlohmann::json json = nlohmann::json::parse(advice_json(advice_on(all_sorts()[2])).dump());
  for (const auto& [method, key] : {std::pair{"bisection", "chance"}, {"end_of_step", "longest_step_s"}}) {
    const auto row = std::ranges::find_if(json.at("methods"), [&](const auto& r) { return r.at("method") == method; });
    ASSERT_NE(row, json.at("methods").end());
    EXPECT_TRUE(row->at(key).is_null()) << method;
  }
}

TEST(AdviceText, the_experiment_refuses_what_it_cannot_fire) {
  Wish wish = bullet_wish;
  wish.cell.radius = wish.cell.thickness = 0;
  const std::string said = error_of<UsageError>([&] { check_config(wish, candidates(wish)); });
  EXPECT_TRUE(said.starts_with("--toml: the experiment cannot fire this")) << said;
}

/// Costs are measured, so that only their form is tested: positive, and inside their interval.
TEST(AdviceCosts, are_medians_with_an_interval) {
  const std::vector<Candidate> methods = candidates(bullet_wish);
  const std::vector<StepCost> costs = measure_costs(bullet, methods, {.queries = 64, .rounds = 5, .round_ns = 1e4});
  ASSERT_EQ(costs.size(), methods.size());
  const Cell slow = all_sorts()[4].cell;  // its step is far too short for the grid of the poses
  EXPECT_EQ(measure_costs(slow, methods, {.queries = 64, .rounds = 1, .round_ns = 1e4}).size(), methods.size());
  for (const StepCost& cost : costs) {
    for (const Measured& time : {cost.clear, cost.contact}) {
      EXPECT_GT(time.interval.lower, 0);
      EXPECT_TRUE(time.interval.contains(time.value));
    }
  }
}

// ---- Advice and experiment agree: the configuration that the advice comes with is fired, and every method is counted within
// what its formula allows.

constexpr std::int64_t shots = 2000;

/// What the experiment found of a method, at the wish's own cell.
struct Found {
  std::int64_t tunneled;
  double latest;  ///< [m]
};

class Fired {
 public:
  explicit Fired(const Wish& wish)
      : wish_(wish),
        outcome_(
            outcome_of(thin_wall_experiment(), check_config(wish, candidates(wish)), {.seed = 3, .trials = shots})) {}

  bool self_test_passed() const { return outcome_.self_test_passed; }

  Found found(const std::string& method) const {
    const Table& table = table_of(outcome_, "cells");
    for (std::size_t row = table.rows.size(); row-- > 0;) {  // the bullet of the textbook comes first
      if (value_of(table, row, "method") != Value(method)) continue;
      EXPECT_EQ(value_of(table, row, "speed"), Value(wish_.cell.speed));
      EXPECT_EQ(value_of(table, row, "step"), Value(wish_.cell.step));
      EXPECT_EQ(value_of(table, row, "radius"), Value(wish_.cell.radius));
      EXPECT_EQ(value_of(table, row, "thickness"), Value(wish_.cell.thickness));
      EXPECT_EQ(value_of(table, row, "angle_deg"), Value(wish_.cell.angle_deg));
      EXPECT_EQ(value_of(table, row, "wall"), Value(std::string("infinite")));
      EXPECT_EQ(value_of(table, row, "shots"), Value(shots));
      const Value& latest = value_of(table, row, "lateness_max");
      return {std::get<std::int64_t>(value_of(table, row, "tunneled")),
              std::holds_alternative<double>(latest) ? std::get<double>(latest) : 0};
    }
    throw std::runtime_error(method + " was not fired");
  }

 private:
  Wish wish_;
  Outcome outcome_;
};

/// The counts that a chance allows in all but one run in 10 000.
Interval counts_of(double chance) {
  if (chance <= no_chance) return {0, 0};
  if (chance == 1) return {double{shots}, double{shots}};
  return binomial_range(shots, chance, 0.9999);
}

/// The experiment rounds the wall up and the step down by one part in 2^20, and times are known to rounding.
double rounded_up(double length, const Cell& cell) { return length + 0x1p-20 * (length + 1e-6 * step_length(cell)); }

void expect_agreement(const Wish& wish) {
  SCOPED_TRACE(cell_factors.key(wish.cell));
  const Fired fired(wish);
  EXPECT_TRUE(fired.self_test_passed());
  const Advice advice = advice_on(wish);
  for (const AdviceRow& row : advice.rows) {
    if (!row.method.fired || !row.theory.probability) continue;
    const Found found = fired.found(row.method.name);
    EXPECT_TRUE(counts_of(*row.theory.probability).contains(static_cast<double>(found.tunneled)))
        << row.method.name << ": " << found.tunneled << " of " << shots << ", theory " << *row.theory.probability;
    if (const auto latest = row.theory.largest_lateness()) {
      EXPECT_LE(found.latest, rounded_up(*latest, wish.cell)) << row.method.name;
    }
    if (!row.meets) continue;
    EXPECT_LE(static_cast<double>(found.tunneled), counts_of(wish.miss).upper) << row.method.name;
    if (wish.late) {
      EXPECT_LE(found.latest, rounded_up(*wish.late, wish.cell)) << row.method.name;
    }
  }
}

TEST(AdviceAgreement, is_there_whatever_is_wished) {
  expect_agreement(bullet_wish);
  expect_agreement({.cell = {700, 1.0 / 240, 0.003, 0.02, 35}, .miss = 0.95});    // slanted and fast
  expect_agreement({.cell = {10, 1.0 / 60, 0, 0.01, 0}, .miss = 0.5});            // a point and a wall
  expect_agreement({.cell = {50, 0.01, 0.05, 0, 70}, .miss = 0.2, .late = 0.1});  // a sheet
  expect_agreement({.cell = {10, 0.001, 0.02, 0.01, 0}});                         // a step shorter than the contact
}

/// What docs/advise.md says of a ball that is in contact when it starts, uniformly along its path in the wall.
TEST(AdviceAgreement, a_start_in_contact_is_lost_on_tested_poses_alone) {
  Cell cell = bullet;
  cell.step = 0.0025;  // half the contact: none that starts before the wall is missed
  const Target aimed = target(cell);
  for (const ThinWallMethod& method : thin_wall_methods(std::vector<std::int64_t>{2})) {
    Tally tally;
    for (std::uint64_t i = 0; i < shots; ++i) {
      const double share = uniform(random_words({7, 7}, i, 0)[0]);
      const Vec3<double> start = {-aimed.half_extents[0] - aimed.radius + share * slab_chord(cell), 0, 0};
      method.fire(aimed, start, tally);
    }
    const double lost = method.poses_per_step > 0 ? 0.5 / method.poses_per_step : 0;
    EXPECT_TRUE(counts_of(lost).contains(static_cast<double>(tally.tunneled))) << method.name << ": " << tally.tunneled;
  }
}

/// The certified answers are not in the method list and so not in the experiment: its shots are put to them here.
TEST(AdviceAgreement, certified_answers_miss_no_shot_and_are_never_late) {
  const Target aimed = target(bullet);
  const auto wall = at_rest(Aabb<double>{Vec3<double>::Zero(), aimed.half_extents});
  const Theory theory = row_of(advice_on(bullet_wish), "certified").theory;
  EXPECT_EQ(*theory.probability, 0);
  EXPECT_EQ(*theory.largest_lateness(), 0);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Vec3<double> start = random_start(aimed, random_stream(bullet, 5), i);
    const Moving ball{Sphere<double>{start, aimed.radius}, aimed.displacement};
    const CertifiedToi toi = certified_time_of_impact(ball, wall);
    ASSERT_EQ(toi.verdict, ToiStatus::hit);
    const double contact = path_to_contact(aimed, start) / aimed.step_length;
    EXPECT_LE(toi.lower, contact * (1 + 1e-15));
    EXPECT_LE(contact - toi.lower, theory.widest / aimed.step_length + 1e-15);
  }
}

// ---- Advice on a rod that spins: the theory of docs/spinning_rod.md in a wish's own units, and what is refused.

/// 0.6 m end to end, half a meter of core and 5 cm around, at a wall of 5 cm; a step of s m, 90 deg in it.
Wish tumbling(double s) { return {.cell = {10 * s, 0.1, 0.05, 0.05, 0}, .rod = TumblingRod{0.6, 900}}; }

double chance(const Wish& wish, const std::string& method) {
  for (const Candidate& c : rod_candidates(wish))
    if (c.name == method) return c.theory(wish.cell).probability.value_or(-1);
  return -2;
}

TEST(RodAdvice, long_steps_see_the_mean_width_alone) {
  Wish wish = tumbling(2);  // 1 - (w + 2 r + 2 c / pi) / s
  const double expected = 1 - (0.15 + 1 / std::numbers::pi) / 2;
  EXPECT_NEAR(chance(wish, "end_of_step"), expected, 1e-12);
  wish.rod->spin = 0;
  EXPECT_NEAR(chance(wish, "end_of_step"), expected, 1e-12) << "spin drops out";
  wish.cell.angle_deg = 60;  // half as far along the normal
  EXPECT_NEAR(chance(wish, "end_of_step"), 1 - (0.15 + 1 / std::numbers::pi), 1e-12);
}

TEST(RodAdvice, spin_shields_on_short_steps) {
  Wish wish = tumbling(0.39);  // w + 2 r + c sin(90 deg) / 2 = 0.4
  EXPECT_EQ(chance(wish, "end_of_step"), 0);
  wish.rod->spin = 0;
  EXPECT_GT(chance(wish, "end_of_step"), 0.05);
  for (const char* method : {"linear_sweep", "speculative", "conservative_advancement", "certified"})
    EXPECT_EQ(chance(wish, method), 0) << method;
}

/// What is advised by formula is what the rod's own flights do.
TEST(RodAdvice, agrees_with_flights) {
  const Wish wish = tumbling(0.8);
  const RodFlight flight = {
      .half_length = 0.25, .radius = 0.05, .thickness = 0.05, .tilt_deg = 90, .spin_deg = 90, .step_ratio = 0.8 / 0.65};
  const std::vector<std::string> names = {"end_of_step"};
  const RodTally tally = fly(flight, rod_methods(names, {})[0], 20'000, 5);
  const double p = chance(wish, "end_of_step");
  EXPECT_NEAR(static_cast<double>(tally.tunneled) / 20'000, p, 4 * std::sqrt(p * (1 - p) / 20'000));
}

/// The latest that poses see rods of 1 m, 1 cm around, at a wall of 1 cm: a fast one touches, parts and touches again between them.
TEST(RodAdvice, no_flight_is_seen_later_than_the_bound) {
  const auto latest = [](double spin_deg, double ratio, std::int64_t poses) {
    const RodFlight flight = {0.49, 0.01, 0.01, 90, spin_deg, ratio};
    const std::vector<std::string> names = {poses == 1 ? "end_of_step" : "substeps"};
    const std::array all = {poses};
    const double measured = fly(flight, rod_methods(names, all)[0], 4000, 7).latest * step_length(flight);
    const Wish wish = {.cell = {step_length(flight), 1, 0.01, 0.01, 0}, .late = 0.06, .rod = TumblingRod{1, spin_deg}};
    double bound = 0, up_to_its_spin = 0;
    for (const Candidate& c : rod_candidates(wish)) {
      if (c.poses != poses) continue;
      bound = c.theory(wish.cell).latest.value_or(-1);
      up_to_its_spin = c.up_to_its_spin(wish.cell).latest.value_or(-1);
    }
    EXPECT_LE(measured, bound) << spin_deg << " deg, " << ratio << ", " << poses;
    EXPECT_EQ(bound, up_to_its_spin);
    return measured / (step_length(flight) / static_cast<double>(poses));
  };
  for (const double spin : {0.0, 2.0, 10.0, 90.0, 720.0})
    for (const double ratio : {0.0505, 0.3, 3.0})
      for (const std::int64_t poses : {1, 2, 8}) latest(spin, ratio, poses);
  EXPECT_GT(latest(90, 0.0505, 1), 3);  // spacings: a bound of one would be wrong
  EXPECT_LE(latest(2, 0.0505, 1), 1);
}

TEST(RodAdvice, what_hits_falsely_is_not_advised) {
  Wish wish = tumbling(0.8);
  const std::vector<Candidate> all = rod_candidates(wish);
  std::vector<StepCost> costs;
  for (const Candidate& c : all) costs.push_back(costing(c.hits_falsely ? 1 : 100));
  const Advice advice = advise(wish, all, costs);
  ASSERT_NE(advice.advised(), nullptr);
  EXPECT_FALSE(advice.advised()->method.hits_falsely);
  EXPECT_TRUE(holds(advice_text(advice), "These meet it too, with false hits:\n  "));
  EXPECT_TRUE(holds(advice_sentence(advice), " methods here that meet the wish without false hits."));
}

TEST(RodAdvice, says_of_poses_that_they_do_at_their_own_spin) {
  const Wish wish = {.cell = {20, 1.0 / 60, 0.02, 0.01, 0}, .rod = TumblingRod{0.6, 1800}};
  const std::vector<Candidate> all = rod_candidates(wish);
  std::vector<StepCost> costs;
  for (const Candidate& c : all) costs.push_back(costing(c.poses == 4 ? 1 : 100));
  const Advice advice = advise(wish, all, costs);
  EXPECT_LT(*advice.advised()->longest_step, wish.cell.step);
  EXPECT_TRUE(holds(advice_sentence(advice), " At any slower spin it meets the wish up to steps of 0.01 s."));
  EXPECT_TRUE(holds(advice_text(advice), " 0.01 s *\n"));
  EXPECT_TRUE(holds(advice_text(advice), "\n* At this spin it meets the wish at this step;"));
}

/// A rod whose ends are no faster than it flies touches over one stretch: short steps see it in time, whatever the step. Without spin a sweep is
/// exact.
TEST(RodAdvice, a_slow_spin_leaves_a_longest_step_and_sweeps_true) {
  Wish wish = tumbling(2);
  wish.rod->spin = 300;  // 1.3 m/s at the ends
  wish.late = 0.05;
  for (const Candidate& c : rod_candidates(wish)) {
    if (c.name == "end_of_step") {
      EXPECT_NEAR(longest_step(wish, c.up_to_its_spin).value_or(-1), 0.05 / 20, 1e-12);
    }
    EXPECT_EQ(c.hits_falsely, c.name == "linear_sweep" || c.name == "speculative");
  }
  wish.rod->spin = 0;
  for (const Candidate& c : rod_candidates(wish)) {
    EXPECT_FALSE(c.hits_falsely) << c.name;
    if (c.name == "linear_sweep") {
      EXPECT_EQ(c.theory(wish.cell).latest, 0);
    }
  }
}

/// At last of a rod with 1e8 steps to the wall, ten turns in each.
TEST(RodAdvice, steps_are_before_the_wall_and_at_it) {
  const auto all_are = [](const Wish& wish, std::int64_t back, ToiStatus status) {
    return std::ranges::all_of(rod_steps(wish, 100, back), [&](const RodStep& step) {
      return time_of_impact(step.rod, step.wall).status == status;
    });
  };
  EXPECT_TRUE(all_are(tumbling(0.8), 0, ToiStatus::hit));
  EXPECT_TRUE(all_are(tumbling(0.8), 1, ToiStatus::apart));
  Wish slow = tumbling(1e-9);
  slow.rod->spin = 36000;
  EXPECT_TRUE(all_are(slow, 0, ToiStatus::hit));
}

/// [s] A longest step does at any spin, and at the spin of the wish all the more.
TEST(RodAdvice, the_longest_step_is_safe_up_to_its_spin) {
  Wish wish = tumbling(0.8);
  wish.miss = 0.1;
  for (const Candidate& c : rod_candidates(wish)) {
    const auto longest = longest_step(wish, c.up_to_its_spin);
    ASSERT_TRUE(longest) << c.name;
    if (*longest == allowed_step.upper) continue;
    for (const double spin : {0.0, 300.0, 900.0, 2000.0}) {
      Wish other = wish;
      other.rod->spin = spin;
      other.cell.step = *longest;
      EXPECT_LE(chance(other, c.name), 0.1 + 1e-12) << c.name << " " << spin;
    }
  }
}

TEST(RodAdvice, is_asked_for_by_length_and_spin) {
  const Words question = {"advise", "--speed", "20", "--radius", "0.05", "--thickness", "0.05", "--fps", "10"};
  const Reply reply = call_program(joined(question, {"--length", "0.6", "--spin", "900", "--json"}));
  EXPECT_EQ(reply.status, 0) << reply.err;
  const auto json = nlohmann::json::parse(reply.out);
  EXPECT_EQ(json["length_m"], 0.6);
  EXPECT_EQ(json["spin_deg_s"], 900);
  EXPECT_NEAR(json["contact_m"], 0.15 + 1 / std::numbers::pi, 1e-12);
  EXPECT_EQ(json["methods"].size(), 8U);
  const auto refused = [&](const Words& more, const std::string& why) {
    EXPECT_EQ(refusal(call_program(joined(question, more))), why + "\n");
  };
  refused({"--spin", "3"}, "--spin: a ball looks the same however it spins; of a rod, give --length [m] too");
  refused({"--length", "0.1"},
          "--length: a rod 0.1 m long, end to end, is no longer than it is wide, 0.1 m; without --length it is a ball");
  refused({"--length", "1", "--spin", "-1"}, "--spin: '-1' is not allowed; a number >= 0 and <= 1000000000 [deg/s]");
  refused({"--length", "inf"}, "--length: 'inf' is not allowed; a number > 0 and <= 1000 [m]");
  refused({"--length", "1", "--spin", "1e6"}, "--spin 1000000: in a step of 0.1 s that is 278 turns; at most 100");
  refused({"--length", "1", "--toml", "-"},
          "--toml: thin_wall fires balls; rods are fired by thinwall run spinning_rod");
}

}  // namespace

}  // namespace thinwall
