/// Values at the end of what a number can be: refused with the key's name and range, or computed rightly.

#include <algorithm>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <thinwall/experiments/accuracy/model.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/extremes/model.hpp>
#include <thinwall/experiments/models/truth.hpp>
#include <thinwall/swept/methods.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

namespace {

TEST(ExtremeSettings, are_refused_by_key_and_with_what_is_allowed) {
  struct Refused {
    std::string_view experiment;
    std::string text, refusal;
  };
  const std::vector<Refused> all = {
      // Ended in words of Boost.
      {"hitscan", "target = [1e-300]", "target': 1e-300 is not allowed; a list of numbers >= 1e-09 and <= 1000 [m]"},
      // Failed the self-test: the target's place has no such digits left.
      {"hitscan", "target = [1e-9]\nradius = [0]",
       "target': [1e-09] is not allowed; such that target + radius is at least 1e-06 of the range"},
      // Took ceil(1 / path) steps, of which none got anywhere.
      {"plan", "shot_path = [1e-300]", "shot_path': 1e-300 is not allowed; a list of numbers >= 0.01 and <= 1000"},
      {"plan", "shot_path = [1e-9]", "shot_path': 1e-09 is not allowed"},
      // Ended the program by an assertion of ODE.
      {"engines", "step = 1e-300", "step': 1e-300 is not allowed; a number >= 1e-09 and <= 1000 [s]"},
      // In proportion, but without a square.
      {"thin_wall", "thickness = [1e-300]\nradius = [0]\nstep = [1]\nspeed = [1e-300]", "thickness'"},
      {"crossing_bullets", "radius = 1e-300\nstep = 1\nspeed = [1e-300]", "radius'"},
      {"stiff_contact", "thickness = 1e-300\nradius = 0\nspeed = 1e-300", "thickness'"}};
  for (const Refused& c : all) {
    const std::string complaint = refusal_of(called(experiments(), c.experiment), c.text);
    EXPECT_TRUE(complaint.starts_with("test.toml:1: key '" + c.refusal)) << complaint;
  }
}

TEST(ExtremeSettings, of_too_many_cells_are_refused_before_they_are_built) {
  const auto list_of = [](std::string_view key, int count) {
    std::string text = fmt::format("{} = [", key);
    for (int i = 1; i <= count; ++i) text += std::to_string(i) + ",";
    return text + "]\n";
  };
  struct Crowded {
    std::string_view experiment, longest, other;
  };
  for (const auto& [name, longest, other] :
       {Crowded{"thin_wall", "speed", "step"}, Crowded{"swept_bounds", "speed", "turn_deg"},
        Crowded{"crossing_bullets", "offset", "speed"}, Crowded{"hitscan", "range", "wind"},
        Crowded{"broad_phase", "count", "speed"}, Crowded{"engines", "path", "wall_size"},
        Crowded{"bouncing", "step", "restitution"}, Crowded{"plan", "shot_path", "shot_gate"},
        Crowded{"stiff_contact", "stiffness", "step"}}) {
    const std::string complaint =
        refusal_of(called(experiments(), name), list_of(longest, 200000) + list_of(other, 20000));
    EXPECT_TRUE(complaint.starts_with(fmt::format("test.toml:1: key '{}'", longest))) << complaint.substr(0, 200);
    EXPECT_TRUE(holds(complaint, fmt::format("{} (200,000)", longest)));
    EXPECT_TRUE(holds(complaint, fmt::format("{} (20,000)", other)));
    EXPECT_TRUE(complaint.ends_with(" cells; at most 1,000,000")) << complaint;
  }
}

TEST(ExtremeSettings, of_many_values_are_not_too_many) {
  std::string text = "rule = ['closed_form']\nspeed = [10]\nangle_deg = [60]\noffset = [1]\nratio = [";
  for (int i = 1; i <= 100000; ++i) text += std::to_string(i) + "e-5,";
  EXPECT_EQ(run_of(crossing_bullets_experiment(), text + "]")->units().size(), 100001u);
}

TEST(ExtremeSettings, of_accuracy_are_a_thousand_units_a_row) {
  const auto run = run_of(accuracy_experiment(), "pair = ['sphere_sphere']", {.seed = 1, .trials = 1'000'000'000});
  EXPECT_LE(run->units().size(), 1000 * all_inquiries.size());
}

// ---- The precision ladder: who breaks where, known separations, and a self-test that fails a wrong theory.

using enum Precision;

/// The rows of one pair and precision along one axis.
std::vector<ExtremeRow> extreme_rows(std::string_view pair_name, Precision precision, ExtremeAxis axis,
                                     const std::vector<double>& values, std::int64_t queries,
                                     const std::vector<std::string>& methods) {
  const ExtremePair& pair = called(extreme_pairs(), pair_name);
  std::vector<ExtremeRow> rows;
  for (const double value : values) {
    const Place place = {axis, value};
    for (const ExtremeTally& tally : pair.asks[static_cast<std::size_t>(precision)]({place, queries, 1, methods, 1}))
      rows.push_back({&pair, precision, place, tally});
  }
  return rows;
}

ExtremeTally tally_of(std::string_view pair, Precision precision, const Place& place, std::int64_t queries,
                      const std::string& method) {
  return extreme_rows(pair, precision, place.axis, {place.value}, queries, {method}).at(0).tally;
}

/// Two decades of the distance, two balls, the closed form and the foil, in a precision.
std::vector<ExtremeRow> loss_rows(Precision precision, std::vector<double> distances = {10, 100}) {
  return extreme_rows("sphere_sphere", precision, ExtremeAxis::distance, distances, 24, {"textbook", "closed_form"});
}

TEST(Extremes, the_textbook_fails_far_off_and_the_next_precision_takes_it_farther) {
  const auto far_wrong = [](Precision precision, double distance, std::int64_t queries) {
    return tally_of("sphere_sphere", precision, {ExtremeAxis::distance, distance}, queries, "textbook").far_wrong;
  };
  EXPECT_GT(far_wrong(in_float, 1e4, 40), 8) << "u (d/R)^2 = 6";
  EXPECT_EQ(far_wrong(in_double, 1e4, 20), 0);
  EXPECT_GT(far_wrong(in_double, 1e9, 20), 4);
  EXPECT_EQ(far_wrong(at_50_digits, 1e9, 4), 0);
}

TEST(Extremes, the_textbook_breaks_at_scales_whose_squares_are_out_of_range) {
  for (const double scale : {1e-150, 1e150}) {
    const Place place = {ExtremeAxis::scale, scale};
    EXPECT_TRUE(flaw_of(tally_of("sphere_sphere", in_double, place, 10, "textbook"))) << scale;
    const ExtremeTally exact = tally_of("sphere_sphere", in_double, place, 10, "closed_form");
    EXPECT_EQ(exact.queries, 10) << scale;
    EXPECT_EQ(exact.invalid + exact.gave_up + exact.far_wrong, 0) << scale;
    EXPECT_LE(exact.forward_max, 4) << scale;
  }
}

/// The kernel alone, without a wider scalar behind it.
TEST(Extremes, what_turned_boxes_graze_in_float_is_right_to_its_digits) {
  for (const std::string_view pair : {"obb_obb", "aabb_obb"}) {
    const ExtremeTally grazing = tally_of(pair, in_float, {ExtremeAxis::grazing, 1e-6}, 100, "closed_form");
    EXPECT_EQ(grazing.queries, 100);
    EXPECT_LE(grazing.worst_wrong, break_verdict) << pair;
  }
}

/// What rounding the input does is not the method's.
TEST(Extremes, offset_changes_queries_before_any_method_sees_them) {
  const Place place = {ExtremeAxis::offset, 1e8};
  const ExtremeTally in_float_there = tally_of("sphere_sphere", in_float, place, 20, "closed_form");
  EXPECT_GT(in_float_there.changed, 3);
  EXPECT_EQ(in_float_there.far_wrong, 0);
  EXPECT_EQ(tally_of("sphere_sphere", in_double, place, 20, "closed_form").changed, 0);
}

TEST(Extremes, the_end_of_the_step_misses_a_thin_wall_and_the_closed_form_does_not) {
  const Place place = {ExtremeAxis::thickness, 1e-4};
  EXPECT_GT(tally_of("sphere_aabb", in_double, place, 12, "end_of_step").far_wrong, 5);
  EXPECT_EQ(tally_of("sphere_aabb", in_double, place, 12, "closed_form").wrong, 0);
}

template <class A, class B> double core_gap_by_oracle(const A& a, const B& b) {
  const auto problem = oracle::pose<Digits50>(at_rest(a), at_rest(b));
  return static_cast<double>(oracle::signed_gap_at(problem, Digits50(0), Digits50(ldexp(Digits50(1), -140))).core);
}

TEST(ExtremesOracle, knows_how_deep_cores_overlap) {
  const Aabb<double> cube{{0, 0, 0}, {1, 1, 1}};
  EXPECT_NEAR(core_gap_by_oracle(cube, Aabb<double>{{0.5, 0.25, 0}, {1, 1, 1}}), -1.5, 1e-15);
  EXPECT_NEAR(core_gap_by_oracle(cube, Sphere<double>{{0, -0.75, 0}, 7}), -0.25, 1e-15);
  const Triangle<double> flat{{-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}};
  EXPECT_NEAR(core_gap_by_oracle(flat, Capsule<double>{{0, 0, -1}, {0, 0, 1}, 7}), -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(core_gap_by_oracle(flat, Sphere<double>{{0, 0, 0}, 7}), 0, 1e-30) << "it has no inside";
  EXPECT_NEAR(core_gap_by_oracle(flat, Sphere<double>{{-1 - 0x1p-40, 0, 0}, 0}), 0x1p-40, 1e-25)
      << "nor beside its edge";
  const Capsule<double> rod{{-1, 0, 0}, {1, 0, 0}, 0};
  EXPECT_NEAR(core_gap_by_oracle(rod, Capsule<double>{{1 + 0x1p-40, -1, 0}, {1 + 0x1p-40, 1, 0}, 0}), 0x1p-40, 1e-25);
}

/// Where they touch the nearest point has half of the digits that the sine of their edges leaves.
TEST(ExtremesOracle, sees_boxes_meet_whose_edges_are_nearly_parallel) {
  for (int k = 1; k <= 60; ++k) {
    const double tilt = std::ldexp(1.0, -25 - k % 25), aside = 0.03 * k;
    Mat3<double> axes = Mat3<double>::Identity();
    axes.col(0) = safe_unit<double>({1, tilt, 0});
    axes.col(1) = safe_unit<double>({-tilt, 1, 0});
    const Moving<Obb<double>> box{{{3, aside, 0.2}, {1, 1, 1}, axes}, {-2, 0, 0.01}};
    const auto problem = oracle::pose<Digits50>(box, at_rest(Aabb<double>{{0, 0, 0}, {1, 1, 1}}));
    const auto found = oracle::first_contact(problem, Digits50(0), Digits50(ldexp(Digits50(1), -140)));
    EXPECT_EQ(found.verdict, oracle::Verdict::hit) << k;
    EXPECT_NEAR(static_cast<double>(found.time), 0.5, 1e-6) << k;
  }
}

/// A box of 1e-12 of the other's size: its oracle needs more than 50 digits.
TEST(Extremes, the_oracle_is_right_about_very_unequal_boxes) {
  const ExtremeTally tally = tally_of("obb_obb", in_double, {ExtremeAxis::ratio, 1e-12}, 24, "closed_form");
  EXPECT_EQ(tally.changed, 0);
  EXPECT_EQ(tally.wrong, 0);
}

/// A method of the list needs no row here to be asked.
TEST(Extremes, asks_every_method_of_the_list_and_the_foil) {
  const std::vector<std::string_view> names = extreme_method_names();
  const auto rows = extreme_rows("sphere_aabb", in_double, ExtremeAxis::distance, {1}, 1, {names.begin(), names.end()});
  EXPECT_EQ(rows.front().tally.method, "textbook");
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    const auto asked = [](const ExtremeRow& row) { return row.tally.method == Method::name; };
    const bool served = serves<Method, Sphere<double>, Aabb<double>>;
    EXPECT_EQ(std::ranges::any_of(rows, asked), served) << Method::name;
  });
}

/// Where a method breaks along an arm, on rows as none is.
Survival survival_of(std::string_view arm, const std::vector<std::pair<double, ExtremeTally>>& tallies) {
  const Arm& along = called(all_arms, arm);
  std::vector<ExtremeRow> rows;
  for (const auto& [value, tally] : tallies)
    rows.push_back({extreme_pairs().data(), in_double, {along.axis, value}, tally});
  return survival(rows, along);
}

TEST(ExtremeBreaks, are_the_first_outward_and_the_worst_there) {
  const Survival s = survival_of("far", {{1000, {.worst_wrong = 9}},
                                         {1, {.worst_wrong = 3.9, .forward_max = 99}},
                                         {10, {}},
                                         {100, {.forward_max = 101}},
                                         {100, {.invalid = 1, .worst_wrong = 5}},
                                         {100, {.gave_up = 1}}});
  EXPECT_EQ(s.survived, 10);
  EXPECT_EQ(s.broken, 100);
  EXPECT_EQ(s.flaw, Flaw::verdict);
}

TEST(ExtremeBreaks, tell_all_from_none) {
  const Survival never = survival_of("far", {{1, {}}});
  EXPECT_EQ(never.survived, 1);
  EXPECT_FALSE(never.broken);
  const Survival at_once = survival_of("far", {{1, {.invalid = 1}}});
  EXPECT_FALSE(at_once.survived);
  EXPECT_EQ(at_once.broken, 1);
  EXPECT_EQ(at_once.flaw, Flaw::nan);
  EXPECT_FALSE(survival_of("far", {}).is_asked());
}

/// From the usual value, which both sides have, to either side.
TEST(ExtremeBreaks, lie_on_their_arm_outward_from_the_usual) {
  const ExtremeTally none = {}, silent = {.gave_up = 1};
  const Survival small = survival_of("small", {{1e-30, silent}, {1e-10, none}, {1, none}, {1e10, silent}});
  EXPECT_EQ(small.survived, 1e-10);
  EXPECT_EQ(small.broken, 1e-30);
  EXPECT_EQ(survival_of("large", {{1e-30, silent}, {1, none}, {1e10, none}}).survived, 1e10);
  EXPECT_EQ(survival_of("large", {{1e-30, silent}, {1, silent}}).broken, 1);
}

/// One passes over the other, `height` above its center: contact below 2.
template <class A> void expect_margin(const A& shape, double height) {
  const Moving above = {moved(shape, Vec3<double>(-4, height, 0)), Vec3<double>(8, 0, 0)};
  const auto problem = oracle::pose<Digits110>(above, at_rest(shape));
  const Digits110 found = least_margin<Digits110>(problem, ldexp(Digits110(1), -140), ldexp(Digits110(1), -60));
  const double margin = (height - 2) / (height + 2);  // over |n|.(|c| + h) + R
  EXPECT_NEAR(static_cast<double>(found), margin, 1e-3 * std::abs(margin) + 1e-15) << height;
}

TEST(ExtremeTruth, margin_is_the_least_separation_over_its_scale) {
  for (const double height : {1.0, 1.75, 2.0, 3.0}) {
    expect_margin(Sphere<double>{{0, 0, 0}, 1}, height);
    expect_margin(Aabb<double>{{0, 0, 0}, {1, 1, 1}}, height);
  }
}

TEST(ExtremeTruth, judges_a_time_by_how_late_and_by_how_deep) {
  const Sphere<double> ball = {{0, 0, 0}, 1};
  Truth truth(Moving{moved(ball, Vec3<double>(-4, 0, 0)), Vec3<double>(4, 0, 0)}, at_rest(ball),
              Toi<double>{ToiStatus::hit, 1, 0.5});
  ASSERT_EQ(truth.verdict(), oracle::Verdict::hit);
  const AnswerErrors late = truth.errors({ToiStatus::hit, 1, 0.5 + 8 * 0x1p-53});  // kappa t = (4 + 2 + 2) / 4 = 2
  EXPECT_NEAR(late.time.value().forward, 4, 1e-6);
  EXPECT_NEAR(late.time.value().backward, 4, 1e-6);
  EXPECT_FALSE(late.wrong);
  const AnswerErrors missed = truth.errors({ToiStatus::apart, 1});
  EXPECT_TRUE(missed.wrong);
  EXPECT_GT(missed.wrongness, 1e14);
}

bool all_passed(const std::vector<LadderTest>& tests) { return std::ranges::all_of(tests, &LadderTest::passed); }

TEST(ExtremeTheory, holds_in_every_precision) {
  for (const Precision precision : {in_float, in_double, in_long_double}) {
    const auto tests = ladder_tests(loss_rows(precision));
    EXPECT_EQ(tests.size(), 7U);
    for (const LadderTest& t : tests) EXPECT_TRUE(t.passed()) << t.what << " " << t.measured << " at " << t.where;
  }
}

TEST(ExtremeTheory, fails_a_wrong_theory) {
  const std::vector<ExtremeRow> rows = loss_rows(in_double, {10, 100, 1000});
  EXPECT_TRUE(all_passed(ladder_tests(rows)));
  EXPECT_FALSE(all_passed(ladder_tests(rows, {.exponent = 1}))) << "as if it lost u d/R";
  EXPECT_FALSE(all_passed(ladder_tests(rows, {.exponent = 3})));
  EXPECT_FALSE(all_passed(ladder_tests(rows, {.most = 1}))) << "as if only one operation rounded";
}

/// The contract is not so wide that anything keeps it.
TEST(ExtremeTheory, fails_a_closed_form_that_is_the_textbooks) {
  std::vector<ExtremeRow> rows = loss_rows(in_double, {1000});
  std::erase_if(rows, [](const ExtremeRow& row) { return row.tally.method == "closed_form"; });
  rows.at(0).tally.method = "closed_form";
  EXPECT_FALSE(all_passed(ladder_tests(rows)));
}

/// Where contact lasts, and is no graze, by more than rounding.
TEST(ExtremeTheory, holds_the_closed_form_to_what_a_precision_can_tell) {
  const auto passes = [](ExtremeAxis axis, double value) {
    ExtremeTally wrong = {.forward_max = 1e6};
    wrong.method = "closed_form";
    return all_passed(ladder_tests({{extreme_pairs().data(), in_double, {axis, value}, wrong}}));
  };
  EXPECT_FALSE(passes(ExtremeAxis::distance, 1e3));
  EXPECT_TRUE(passes(ExtremeAxis::distance, 1e15));
  EXPECT_FALSE(passes(ExtremeAxis::grazing, 1e-3));
  EXPECT_TRUE(passes(ExtremeAxis::grazing, 1e-15));
}

/// Verdicts that go wrong a hundred times too near are not the theory's.
TEST(ExtremeTheory, knows_where_the_textbooks_verdicts_go_wrong) {
  std::vector<ExtremeRow> rows = loss_rows(in_float, {10, 1e4, 1e5});
  EXPECT_TRUE(all_passed(ladder_tests(rows)));
  EXPECT_GT(rows.at(3).tally.timed, 10) << "what the closed form is held to at 1e4 is not empty";
  for (ExtremeRow& row : rows) {
    if (row.place.value == 10 && row.tally.method == "textbook") row.tally.far_wrong = row.tally.queries;
  }
  EXPECT_FALSE(all_passed(ladder_tests(rows)));
  for (ExtremeRow& row : rows) row.tally.far_wrong = 0;
  EXPECT_FALSE(all_passed(ladder_tests(rows))) << "as if it never went wrong";
}

TEST(ExtremesConfig, trials_override_the_queries_and_few_are_asked_at_50_digits) {
  const auto run = run_of(extremes_experiment(), "pair = ['obb_obb']\nprecision = ['float', '50_digits']",
                          {.seed = 1, .trials = 17});
  for (const Unit& unit : run->units()) EXPECT_EQ(unit.trials, unit.key.find("50_digits") == unit.key.npos ? 17 : 3);
}

TEST(ExtremesConfig, only_boxes_are_thin) {
  for (const Unit& unit : run_of(extremes_experiment(), "axis = ['thickness']")->units())
    EXPECT_TRUE(std::regex_search(unit.key, std::regex("aabb|obb"))) << unit.key;
}

TEST(ExtremesConfig, heat_maps_have_a_cell_for_all_that_is_asked) {
  const Outcome outcome = outcome_of(extremes_experiment(), small_toml("extremes"));
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
  EXPECT_TRUE(holds(outcome.answer, "two balls wrong from 10^4 R apart in float and at no distance in double"));
  EXPECT_TRUE(holds(outcome.answer, "it breaks nowhere"));
}

/// Neither broken nor survived there.
TEST(ExtremesConfig, what_a_precision_cannot_hold_is_in_no_table) {
  const Outcome outcome = outcome_of(extremes_experiment(), small_toml("extremes") + "\nmethod = ['closed_form']");
  const Table& cells = table_of(outcome, "cells");
  for (std::size_t i = 0; i < cells.rows.size(); ++i) EXPECT_EQ(value_of(cells, i, "queries"), Value(std::int64_t{6}));
  const Table& breaks = table_of(outcome, "breaks");
  std::size_t lesser = 0;
  for (std::size_t i = 0; i < breaks.rows.size(); ++i) {
    if (value_of(breaks, i, "side") != Value("lesser")) continue;
    ++lesser;
    const bool in_float_there = value_of(breaks, i, "precision") == Value("float");
    EXPECT_EQ(value_of(breaks, i, "survived"), Value(in_float_there ? 1 : 1e-100));
  }
  EXPECT_GT(cells.rows.size(), 0u);
  EXPECT_GT(lesser, 0u);
}

/// One answer a person can say: three sentences at most, and powers of ten as such.
TEST(ExtremesConfig, answers_any_choice_in_three_sentences) {
  const std::string little = "\nqueries = 4\nprecision = ['double']";
  for (const std::string& text :
       {small_toml("extremes"), "method = ['bisection']\naxis = ['ratio']\nratio = [1]" + little,
        "pair = ['capsule_triangle']\naxis = ['scale']\nscale = [1]" + little,
        "pair = ['sphere_sphere']\naxis = ['distance', 'scale']\ndistance = [1, 1e9]\nscale = [1, 2.5e100]" + little}) {
    const Outcome outcome = outcome_of(extremes_experiment(), text);
    EXPECT_FALSE(outcome.summary.empty()) << text;
    const std::string& answer = outcome.answer;
    const std::regex full_stop("\\.( |$)");
    const auto sentences = std::distance(std::sregex_iterator(answer.begin(), answer.end(), full_stop), {});
    EXPECT_TRUE(1 <= sentences && sentences <= 3) << answer;
    EXPECT_FALSE(std::regex_search(answer, std::regex("[0-9]e[-+]?[0-9]"))) << answer;
  }
}

TEST(ExtremesConfig, refuses_what_cannot_be_asked) {
  expect_refusals(extremes_experiment(), {{"scale = [1e-200]", "key 'scale'"},
                                          {"distance = [0.5]", "key 'distance'"},
                                          {"speed = [0]", "key 'speed'"},
                                          {"thickness = [2]", "key 'thickness'"},
                                          {"offset = [1e13]", "key 'offset'"},
                                          {"grazing = [1]", "key 'grazing'"},
                                          {"ratio = [0]", "key 'ratio'"},
                                          {"tolerance = 0.5", "key 'tolerance'"},
                                          {"one_in_at_50_digits = 0", "key 'one_in_at_50_digits'"},
                                          {"pair = ['capsule_obb']\nprecision = ['50_digits']", "key 'precision'"}});
}

}  // namespace

}  // namespace thinwall
