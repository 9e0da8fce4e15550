/// The crossing bullets' answers: who misses, who hits what is not there, and does theory agree?

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/crossing_bullets/model.hpp>
#include <thinwall/experiments/crossing_bullets/rules.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/swept/methods.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

namespace {

std::int64_t count(const char* table, const char* rule, const char* column) {
  return std::get<std::int64_t>(value_of(table_of(small_outcome(crossing_bullets_experiment()), table), rule, column));
}

/// The failure is specified too.
TEST(CrossingBullets, two_bullets_head_on_pass_each_other) {
  EXPECT_EQ(count("head_on", "sweep_then_confirm", "touching"), 1000);
  EXPECT_GT(count("head_on", "sweep_then_confirm", "missed"), 960);
  EXPECT_NEAR(static_cast<double>(count("head_on", "end_of_step", "missed")), 840, 50);
  EXPECT_EQ(count("head_on", "swept_overlap", "missed"), 0);
  EXPECT_EQ(count("head_on", "closed_form", "missed"), 0);
}

TEST(CrossingBullets, sweeping_both_makes_false_hits_and_the_confirmed_are_none) {
  EXPECT_GT(count("rules", "swept_overlap", "false_hits"), 50);
  EXPECT_EQ(count("rules", "swept_overlap", "missed"), 0);
  EXPECT_EQ(count("rules", "sweep_then_confirm", "false_hits"), 0);
  EXPECT_GT(count("rules", "sweep_then_confirm", "missed"), 3000);
  const auto missed = static_cast<double>(count("rules", "sweep_then_confirm", "missed"));
  EXPECT_NEAR(std::get<double>(value_of(table_of(small_outcome(crossing_bullets_experiment()), "rules"),
                                        "sweep_then_confirm", "missed_expected")),
              missed, 0.05 * missed);
  EXPECT_EQ(count("rules", "closed_form", "missed"), 0);
  EXPECT_EQ(count("rules", "closed_form", "false_hits"), 0);
}

/// Rows of a run that is large enough to tell theories apart.
const std::vector<CrossingRow>& measured() {
  static const std::vector<CrossingRow> all = [] {
    const Experiment experiment = crossing_bullets_experiment();
    const Settings settings(R"(rule = ["swept_overlap", "end_of_step", "sweep_then_confirm", "closed_form"]
                               speed = [10, 300]
                               ratio = [0.5, 1]
                               angle_deg = [30, 90, 150]
                               offset = [1, 4])",
                            "test.toml", experiment.default_toml);
    const std::vector<CrossingRule> rules = chosen(settings, "rule", all_crossing_rules());
    std::vector<CrossingRow> rows;
    for (const Crossing& c : make_crossings(settings)) {
      const CrossingTheory theory = theory_of(c);
      for (const CrossingRule& rule : rules)
        rows.push_back({c, rule.name, theory, rule.expects(theory), ask_all(rule, c, 1, 10000)});
    }
    return rows;
  }();
  return all;
}

/// Does the self-test pass if one rule's expected reports are those of another theory?
bool passes(const std::string& rule, const std::function<double(const CrossingRow&)>& theory) {
  std::vector<CrossingRow> rows = measured();
  for (CrossingRow& row : rows) {
    if (row.rule == rule) row.expected.reported = std::min(1.0, theory(row));
  }
  return all_passed(self_test(counts_of(rows)));
}

TEST(CrossingBullets, fails_a_wrong_theory) {
  const auto confirmed = [](const CrossingRow& r) { return r.theory.confirmed.share; };
  EXPECT_TRUE(passes("sweep_then_confirm", confirmed));
  EXPECT_FALSE(passes("sweep_then_confirm", [](const CrossingRow& r) {  // forgets where a step begins and ends
    const double turn = r.cell.angle_deg * (std::numbers::pi / 180), ratio = r.cell.ratio;
    return r.theory.touch * std::sqrt(3.0) / std::numbers::pi * std::sin(turn) /
           std::sqrt(1 + ratio * ratio - 2 * ratio * std::cos(turn));
  }));
  EXPECT_FALSE(passes("sweep_then_confirm", [](const CrossingRow& r) { return r.theory.confirmed.share * 0.95; }));
  EXPECT_FALSE(passes("closed_form", [](const CrossingRow& r) {  // takes the disc for a segment
    return 1 / r.cell.offset;
  }));
  EXPECT_FALSE(passes("swept_overlap", [](const CrossingRow& r) {  // tracks without ends
    const double k = r.cell.offset;
    return 2 / std::numbers::pi * (std::asin(1 / k) + std::sqrt(k * k - 1) / (k * k));
  }));
  EXPECT_FALSE(passes("end_of_step", [](const CrossingRow& r) {  // takes the radius for the contact distance
    return r.theory.touch_at_end / 8;
  }));
}

TEST(CrossingBullets, fails_wrong_times) {
  const auto passes_with = [](const std::function<void(CrossingRow&)>& change) {
    std::vector<CrossingRow> rows = measured();
    for (CrossingRow& row : rows) change(row);
    return all_passed(timing_test(rows));
  };
  EXPECT_TRUE(passes_with([](CrossingRow&) {}));
  EXPECT_FALSE(passes_with([](CrossingRow& r) { r.theory.confirmed.lateness_mean *= 1.1; }));
  EXPECT_FALSE(passes_with([](CrossingRow& r) { r.tally.widest = 1e-6; }));    // apart at the answered time
  EXPECT_FALSE(passes_with([](CrossingRow& r) { r.tally.deepest = -1e-6; }));  // the closed form would be late
  EXPECT_FALSE(passes_with([](CrossingRow& r) { r.tally.latest = 1; }));       // after contact has ended
}

TEST(CrossingBullets, every_miss_has_a_cause) {
  for (const CrossingRow& row : measured()) {
    const CrossingTally& t = row.tally;
    EXPECT_EQ(t.inside + t.early + t.late + t.beside, row.rule == "sweep_then_confirm" ? row.tally.missed : 0);
  }
}

TEST(CrossingBulletsConfig, opens_with_the_head_on_bullets_and_leaves_out_no_relative_motion) {
  const Experiment experiment = crossing_bullets_experiment();
  const auto cells = make_crossings(Settings("", "test.toml", experiment.default_toml));
  EXPECT_EQ(cells.front(), head_on);
  EXPECT_EQ(std::count(cells.begin(), cells.end(), head_on), 1);
  for (const Crossing& c : cells) EXPECT_GT(relative_path(c).norm(), 0) << crossing_factors.key(c);
}

TEST(CrossingBulletsConfig, asks_every_method_of_the_list_that_serves_two_spheres) {
  const auto names = distinct(all_crossing_rules(), &CrossingRule::name);
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, Sphere<double>, Sphere<double>>) {
      EXPECT_NE(std::find(names.begin(), names.end(), Method::name), names.end()) << Method::name;
    }
  });
  const Outcome outcome = outcome_of(crossing_bullets_experiment(),
                                     "rule = ['all']\nspeed = [10]\nratio = [1]\nangle_deg = [90]\nshots = 20");
  EXPECT_EQ(table_of(outcome, "rules").rows.size(), names.size());
}

TEST(CrossingBulletsConfig, refuses_what_cannot_be_asked) {
  expect_refusals(crossing_bullets_experiment(),
                  {{"speed = [1e-6]", "a path of 0.01 to 10000 contact distances a step"},
                   {"speed = [1e8]", "a path of 0.01 to 10000 contact distances a step"},
                   {"ratio = [1]\nangle_deg = [1e-9]", "not so at ratio 1"},
                   {"ratio = [1]\nangle_deg = [0]", "an angle at which balls of equal speed move against each other"}});
}

// ---- The crossing bullets' encounters, oracle and theory, without any rule: limits that have a formula of their own.

const std::vector<Crossing> crossings = {
    head_on,
    {10, 1.0 / 60, 0.02, 0, 0, 4},
    {10, 1.0 / 60, 0.02, 0.5, 0, 1},
    {300, 1.0 / 60, 0.02, 1, 90, 4},
    {300, 1.0 / 60, 0.02, 0.1, 150, 16},
};

/// A path of 5000 contact distances: where a step begins and ends no longer matters.
Crossing long_path(double ratio, double angle_deg, double offset) {
  return {1000, 0.2, 0.02, ratio, angle_deg, offset};
}

TEST(CrossingEncounter, first_contact_is_uniform_over_the_step) {
  expect_uniform(50, 50000, [](std::uint64_t i) {
    const TrueContact truth = true_contact(random_encounter(head_on, crossing_factors.stream(head_on, 3), i));
    EXPECT_TRUE(truth.touches);
    return static_cast<double>(truth.time);
  });
}

/// Against poses: the gap closes at the time, is open before, and stays open where the oracle says so.
TEST(CrossingEncounter, oracle_agrees_with_the_gap) {
  for (const Crossing& c : crossings) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const Encounter e = random_encounter(c, crossing_factors.stream(c, 1), i);
      const TrueContact truth = true_contact(e);
      const double end = truth.touches ? static_cast<double>(truth.time) : 1;
      for (int k = 0; k < 200; ++k) ASSERT_GT(gap_at(e, end * k / 200), -1e-12) << crossing_factors.key(c);
      if (truth.touches) {
        ASSERT_NEAR(gap_at(e, end), 0, 1e-12) << crossing_factors.key(c);
      }
    }
  }
}

TEST(CrossingTheory, a_pose_sees_the_mean_chord_over_the_step) {
  const Crossing c = {300, 1.0 / 60, 0.02, 0.5, 60, 4};
  EXPECT_NEAR(theory_of(c).touch_at_end, 4 * contact_distance(c) / 3 / relative_path(c).norm() / 16, 1e-15);
  const Crossing slow = {0.1, 1.0 / 60, 0.02, 0, 0, 1};  // still in contact at the end of almost any step it touches in
  EXPECT_GT(theory_of(slow).touch_at_end, 0.9);
  EXPECT_LT(theory_of(slow).touch_at_end, 1);
}

/// The ray enters where it is within r of the other's line, which is there within sqrt(3) r of the entry, of a disc of 2 r.
TEST(CrossingTheory, on_long_paths_the_rule_confirms_a_share_with_a_formula) {
  for (const double ratio : {0.1, 0.5, 1.0}) {
    for (const double angle : {30.0, 90.0, 150.0}) {
      const CrossingTheory t = theory_of(long_path(ratio, angle, 1));
      const double turn = angle * (std::numbers::pi / 180);
      const double closing = std::sqrt(1 + ratio * ratio - 2 * ratio * std::cos(turn));
      EXPECT_NEAR(t.confirmed.share, std::sqrt(3.0) / std::numbers::pi * std::sin(turn) / closing, 1e-3)
          << ratio << " " << angle;
    }
    EXPECT_LT(theory_of(long_path(ratio, 180, 1)).confirmed.share, 1e-3);
  }
  EXPECT_NEAR(theory_of(long_path(0, 0, 1)).confirmed.share, 0.25, 1e-3);  // a point against r, where 2 r touches
}

/// The tracks overlap where they pass within contact of each other's plane: a strip of the disc.
TEST(CrossingTheory, on_long_paths_swept_overlap_is_a_strip) {
  for (const double k : {2.0, 4.0, 16.0}) {
    const double strip = 2 / std::numbers::pi * (std::asin(1 / k) + std::sqrt(k * k - 1) / (k * k));
    EXPECT_NEAR(theory_of(long_path(1, 90, k)).false_overlap, strip - 1 / (k * k), 1e-3) << k;
  }
  EXPECT_EQ(theory_of(long_path(1, 180, 4)).false_overlap, 0);
  EXPECT_EQ(theory_of(long_path(1, 90, 1)).false_overlap, 0);
}

TEST(CrossingTheory, scales_with_length) {
  const CrossingTheory t = theory_of({10, 1.0 / 60, 0.02, 0.5, 60, 4}),
                       big = theory_of({80, 1.0 / 60, 0.16, 0.5, 60, 4});
  EXPECT_NEAR(t.confirmed.share, big.confirmed.share, 1e-12);
  EXPECT_NEAR(t.false_overlap, big.false_overlap, 1e-12);
  EXPECT_NEAR(t.confirmed.lateness_mean, big.confirmed.lateness_mean, 1e-12);
}

}  // namespace

}  // namespace thinwall
