/// Values at the end of what a number can be: refused with the key's name and range, or computed rightly.

#include <algorithm>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/extremes/kernels/truth.hpp>
#include <thinwall/experiments/extremes/theory.hpp>
#include <thinwall/swept/methods.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

namespace {

const Experiment& experiment(std::string_view name) {
  return *std::ranges::find(experiments(), name, &Experiment::name);
}

std::string refusal(std::string_view name, const std::string& text) {
  try {
    run_of(experiment(name), text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

struct Refused {
  std::string_view experiment;
  std::string text, refusal;
};

class RefusedSettings : public testing::TestWithParam<Refused> {};

TEST_P(RefusedSettings, name_the_key_and_what_is_allowed) {
  const Refused& c = GetParam();
  const std::string complaint = refusal(c.experiment, c.text);
  EXPECT_TRUE(complaint.starts_with("test.toml:1: key '" + c.refusal)) << complaint;
}

INSTANTIATE_TEST_SUITE_P(
    Extremes, RefusedSettings,
    testing::Values(
        // Ended in words of Boost.
        Refused{"hitscan", "target = [1e-300]",
                "target': 1e-300 is not allowed; a list of numbers >= 1e-09 and <= 1000 [m]"},
        // Failed the self-test: the target's place has no such digits left.
        Refused{"hitscan", "target = [1e-9]\nradius = [0]",
                "target': [1e-09] is not allowed; such that target + radius is at least 1e-06 of the range"},
        // Took ceil(1 / path) steps, of which none got anywhere.
        Refused{"plan", "shot_path = [1e-300]",
                "shot_path': 1e-300 is not allowed; a list of numbers >= 0.01 and <= 1000"},
        Refused{"plan", "shot_path = [1e-9]", "shot_path': 1e-09 is not allowed"},
        // Ended the program by an assertion of ODE.
        Refused{"engines", "step = 1e-300", "step': 1e-300 is not allowed; a number >= 1e-09 and <= 1000 [s]"},
        // In proportion, but without a square.
        Refused{"thin_wall", "thickness = [1e-300]\nradius = [0]\nstep = [1]\nspeed = [1e-300]", "thickness'"},
        Refused{"crossing_bullets", "radius = 1e-300\nstep = 1\nspeed = [1e-300]", "radius'"},
        Refused{"stiff_contact", "thickness = 1e-300\nradius = 0\nspeed = 1e-300", "thickness'"}));

struct Crowded {
  std::string_view experiment, longest, other;
};

class CrowdedSettings : public testing::TestWithParam<Crowded> {};

TEST_P(CrowdedSettings, are_refused_before_they_are_built) {
  const auto list_of = [](int count) {
    std::string text;
    for (int i = 1; i <= count; ++i) text += std::to_string(i) + ",";
    return " = [" + text + "]\n";
  };
  const Crowded& c = GetParam();
  const std::string text = std::string(c.longest) + list_of(200000) + std::string(c.other) + list_of(20000);
  const std::string complaint = refusal(c.experiment, text);
  EXPECT_TRUE(complaint.starts_with("test.toml:1: key '" + std::string(c.longest) + "'")) << complaint.substr(0, 200);
  EXPECT_NE(complaint.find(std::string(c.longest) + " (200,000)"), std::string::npos) << complaint;
  EXPECT_NE(complaint.find(std::string(c.other) + " (20,000)"), std::string::npos) << complaint;
  EXPECT_TRUE(complaint.ends_with(" cells; at most 1,000,000")) << complaint;
}

INSTANTIATE_TEST_SUITE_P(
    Extremes, CrowdedSettings,
    testing::Values(Crowded{"thin_wall", "speed", "step"}, Crowded{"swept_bounds", "speed", "turn_deg"},
                    Crowded{"crossing_bullets", "offset", "speed"}, Crowded{"hitscan", "range", "wind"},
                    Crowded{"broad_phase", "count", "speed"}, Crowded{"engines", "path", "wall_size"},
                    Crowded{"bouncing", "step", "restitution"}, Crowded{"plan", "shot_path", "shot_gate"},
                    Crowded{"stiff_contact", "stiffness", "step"}));

TEST(ExtremeSettings, of_many_values_are_not_too_many) {
  std::string values;
  for (int i = 1; i <= 100000; ++i) values += std::to_string(i) + "e-5,";
  const auto run = run_of(experiment("crossing_bullets"),
                          "rule = ['closed_form']\nspeed = [10]\nangle_deg = [60]\n"
                          "offset = [1]\nratio = [" +
                              values + "]");
  EXPECT_EQ(run->units().size(), 100001u);
}

TEST(ExtremeSettings, of_accuracy_are_a_thousand_units_a_row) {
  const auto run = run_of(experiment("accuracy"), "pair = ['sphere_sphere']", {.seed = 1, .trials = 1'000'000'000});
  EXPECT_LE(run->units().size(), 5000u);
}

// ---- The precision ladder: who breaks where, known separations, and a self-test that fails a wrong theory.

/// Two balls along two axes, small enough for a debug build.
constexpr std::string_view few_extremes = R"(
  axis = ["distance", "scale"]
  distance = [1, 1e4]
  scale = [1e-100, 1]
  pair = ["sphere_sphere"]
  precision = ["float", "double"]
  queries = 6
)";

std::unique_ptr<Run> extreme_run(std::string_view text) {
  return run_of(extremes_experiment(), text, {.seed = 3, .trials = {}});
}
Outcome extreme_outcome(std::string_view text) { return outcome_of(*extreme_run(text)); }

enum : std::size_t { in_float, in_double, in_long_double, at_50_digits };

/// The rows of one pair and precision along one axis.
std::vector<ExtremeRow> extreme_rows(std::string_view pair_name, std::size_t precision, ExtremeAxis axis,
                                     const std::vector<double>& values, std::int64_t queries,
                                     const std::vector<std::string>& methods) {
  const auto pairs = extreme_pairs();
  const auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const ExtremePair& p) { return p.name == pair_name; });
  std::vector<ExtremeRow> rows;
  for (const double value : values) {
    const Place place = {axis, value};
    for (ExtremeTally& tally : pair->ask[precision]({place, queries, 1, methods, 1})) {
      rows.push_back({&*pair, precision, place, std::move(tally)});
    }
  }
  return rows;
}

ExtremeTally tally_of(std::string_view pair, std::size_t precision, const Place& place, std::int64_t queries,
                      const std::string& method) {
  return extreme_rows(pair, precision, place.axis, {place.value}, queries, {method}).at(0).tally;
}

/// Two decades of the distance, two balls, the closed form and the foil, in a precision.
std::vector<ExtremeRow> loss_rows(std::size_t precision, std::vector<double> distances = {10, 100}) {
  return extreme_rows("sphere_sphere", precision, ExtremeAxis::distance, distances, 24, {"textbook", "closed_form"});
}

TEST(Extremes, the_textbook_fails_far_off_in_float_and_the_closed_form_does_not) {
  const Place far = {ExtremeAxis::distance, 1e4};
  const ExtremeTally foil = tally_of("sphere_sphere", in_float, far, 40, "textbook");
  EXPECT_GT(foil.far_wrong, 8) << "u (d/R)^2 = 6";
  const ExtremeTally exact = tally_of("sphere_sphere", in_float, far, 40, "closed_form");
  EXPECT_EQ(exact.far_wrong, 0);
  EXPECT_GT(exact.timed, 20);
  EXPECT_LE(exact.forward_max, 4);
  EXPECT_LE(exact.backward_max, 4);
}

TEST(Extremes, the_next_precision_takes_the_textbook_farther) {
  const Place far = {ExtremeAxis::distance, 1e4};
  EXPECT_EQ(tally_of("sphere_sphere", in_double, far, 20, "textbook").far_wrong, 0);
  const Place farther = {ExtremeAxis::distance, 1e9};
  EXPECT_GT(tally_of("sphere_sphere", in_double, farther, 20, "textbook").far_wrong, 4);
  EXPECT_EQ(tally_of("sphere_sphere", at_50_digits, farther, 4, "textbook").far_wrong, 0);
}

TEST(Extremes, the_textbook_breaks_at_scales_whose_squares_are_out_of_range) {
  for (const double scale : {1e-150, 1e150}) {
    const Place place = {ExtremeAxis::scale, scale};
    const ExtremeTally foil = tally_of("sphere_sphere", in_double, place, 10, "textbook");
    EXPECT_TRUE(flaw_of(foil).has_value()) << scale;
    const ExtremeTally exact = tally_of("sphere_sphere", in_double, place, 10, "closed_form");
    EXPECT_EQ(exact.queries, 10) << scale;
    EXPECT_EQ(exact.invalid + exact.gave_up + exact.far_wrong, 0) << scale;
    EXPECT_LE(exact.forward_max, 4) << scale;
  }
}

TEST(Extremes, asks_nothing_that_a_precision_cannot_hold) {
  const Place place = {ExtremeAxis::scale, 1e-100};
  EXPECT_EQ(tally_of("sphere_sphere", in_float, place, 5, "closed_form").queries, 0);
  EXPECT_EQ(tally_of("sphere_sphere", in_double, place, 5, "closed_form").queries, 5);
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
  std::vector<std::string> asked;
  for (const ExtremeRow& row : rows) asked.push_back(row.tally.method);
  EXPECT_EQ(asked.front(), "textbook");
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, Sphere<double>, Aabb<double>>) {
      EXPECT_NE(std::find(asked.begin(), asked.end(), Method::name), asked.end()) << Method::name;
    }
  });
}

/// A row as none is, for the tests of where a method breaks.
ExtremeRow made_up(double distance, std::int64_t queries, double worst_wrong, double forward, std::int64_t invalid) {
  ExtremeRow row = {extreme_pairs().data(), in_double, {ExtremeAxis::distance, distance}, {}};
  row.tally.method = "closed_form";
  row.tally.queries = queries;
  row.tally.worst_wrong = worst_wrong;
  row.tally.forward_max = forward;
  row.tally.invalid = invalid;
  return row;
}
const Arm& far_arm() {
  return *std::find_if(all_arms().begin(), all_arms().end(), [](const Arm& arm) { return arm.name == "far"; });
}

TEST(ExtremeBreaks, are_the_first_outward_and_the_worst_there) {
  const std::vector<ExtremeRow> rows = {made_up(1000, 9, 9, 0, 0), made_up(1, 9, 3.9, 99, 0), made_up(10, 9, 0, 0, 0),
                                        made_up(100, 9, 0, 101, 0), made_up(100, 9, 5, 0, 1)};
  const Survival s = survival(rows, far_arm(), "closed_form", in_double);
  EXPECT_EQ(s.survived, 10);
  EXPECT_EQ(s.broken, 100);
  EXPECT_EQ(s.flaw, Flaw::verdict);
}

TEST(ExtremeBreaks, skip_what_was_not_asked_and_tell_all_from_none) {
  const auto along = [](const std::vector<ExtremeRow>& rows) {
    return survival(rows, far_arm(), "closed_form", in_double);
  };
  const Survival never = along({made_up(1, 9, 0, 0, 0), made_up(10, 0, 0, 0, 0)});
  EXPECT_EQ(never.survived, 1);
  EXPECT_FALSE(never.broken);
  const Survival at_once = along({made_up(1, 9, 0, 0, 1)});
  EXPECT_FALSE(at_once.survived);
  EXPECT_EQ(at_once.broken, 1);
  EXPECT_EQ(at_once.flaw, Flaw::nan);
  const Survival not_asked = along({made_up(1, 0, 0, 0, 0)});
  EXPECT_FALSE(not_asked.survived || not_asked.broken);
}

TEST(ExtremeArms, lead_outward_from_the_usual) {
  std::vector<Place> places;
  for (const double value : {1e-30, 1e-10, 1.0, 1e10}) places.push_back({ExtremeAxis::scale, value});
  EXPECT_EQ(values_along(all_arms()[0], places), (std::vector<double>{1, 1e-10, 1e-30}));
  EXPECT_EQ(values_along(all_arms()[1], places), (std::vector<double>{1, 1e10}));
}

template <class A, class B> double margin_of(const Moving<A>& a, const Moving<B>& b) {
  const auto problem = oracle::pose<Digits110>(a, b);
  return static_cast<double>(least_margin<Digits110>(problem, ldexp(Digits110(1), -140), ldexp(Digits110(1), -60)));
}

/// One passes over the other, `height` above its center: contact below 2.
TEST(ExtremeTruth, margin_is_the_least_separation_over_its_scale) {
  const Sphere<double> ball = {{0, 0, 0}, 1};
  const Aabb<double> box = {{0, 0, 0}, {1, 1, 1}};
  for (const double height : {1.0, 1.75, 2.0, 3.0}) {
    const double margin = (height - 2) / (height + 2);  // over |n|.(|c| + h) + R
    const Moving above = {moved(ball, Vec3<double>(-4, height, 0)), Vec3<double>(8, 0, 0)};
    EXPECT_NEAR(margin_of(above, at_rest(ball)), margin, 1e-3 * std::abs(margin) + 1e-15) << height;
    const Moving boxed = {moved(box, Vec3<double>(-4, height, 0)), Vec3<double>(8, 0, 0)};
    EXPECT_NEAR(margin_of(boxed, at_rest(box)), margin, 1e-3 * std::abs(margin) + 1e-15) << height;
  }
}

TEST(ExtremeTruth, judges_a_time_by_how_late_and_by_how_deep) {
  const Sphere<double> ball = {{0, 0, 0}, 1};
  const Moving a = {moved(ball, Vec3<double>(-4, 0, 0)), Vec3<double>(4, 0, 0)};
  const auto b = at_rest(ball);
  Truth truth(a, b, Digits110(0.5 - 0x1p-30));
  ASSERT_EQ(truth.verdict(), oracle::Verdict::hit);
  const double u = 0x1p-53;
  // At t = 1/2, kappa t = (4 + 2 + 2) / 4 = 2.
  const AnswerErrors late = truth.errors({ToiStatus::hit, 1, 0.5 + 8 * u});
  EXPECT_NEAR(late.forward.value(), 4, 1e-6);
  EXPECT_NEAR(late.backward.value(), 4, 1e-6);
  EXPECT_FALSE(late.wrong);
  const AnswerErrors missed = truth.errors({ToiStatus::apart, 1});
  EXPECT_TRUE(missed.wrong);
  EXPECT_GT(missed.wrongness, 1e14);
}

bool all_passed(const std::vector<LadderTest>& tests) {
  return std::all_of(tests.begin(), tests.end(), [](const LadderTest& t) { return t.passed(); });
}

TEST(ExtremeTheory, holds_in_every_precision) {
  for (const std::size_t precision : {in_float, in_double, in_long_double}) {
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

/// Verdicts that go wrong a hundred times too near are not the theory's.
TEST(ExtremeTheory, knows_where_the_textbooks_verdicts_go_wrong) {
  std::vector<ExtremeRow> rows = loss_rows(in_float, {10, 1e4, 1e5});
  EXPECT_TRUE(all_passed(ladder_tests(rows)));
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
  for (const Unit& unit : run->units()) {
    EXPECT_EQ(unit.trials, unit.key.find("50_digits") == std::string::npos ? 17 : 3) << unit.key;
  }
}

TEST(ExtremesConfig, only_boxes_are_thin) {
  for (const Unit& unit : extreme_run("axis = ['thickness']")->units()) {
    EXPECT_TRUE(unit.key.find("aabb") != std::string::npos || unit.key.find("obb") != std::string::npos) << unit.key;
  }
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

/// One answer a person can say: three sentences at most, and powers of ten as such.
TEST(ExtremesConfig, answers_any_choice_in_three_sentences) {
  const std::string little = "\nqueries = 4\nprecision = ['double']";
  for (const std::string& text :
       {std::string(few_extremes), "method = ['bisection']\naxis = ['ratio']\nratio = [1]" + little,
        "pair = ['capsule_triangle']\naxis = ['scale']\nscale = [1]" + little,
        "pair = ['sphere_sphere']\naxis = ['distance', 'scale']\ndistance = [1, 1e9]\nscale = [1, 2.5e100]" + little}) {
    const Outcome outcome = extreme_outcome(text);
    const std::string& answer = outcome.answer;
    EXPECT_FALSE(outcome.summary.empty()) << text;
    std::size_t sentences = 0;
    for (std::size_t i = 0; i < answer.size(); ++i)
      sentences += answer[i] == '.' && (i + 1 == answer.size() || answer[i + 1] == ' ') ? 1U : 0U;
    EXPECT_TRUE(1 <= sentences && sentences <= 3) << answer;
    EXPECT_FALSE(std::regex_search(answer, std::regex("[0-9]e[-+]?[0-9]"))) << answer;
  }
}

TEST(ExtremesConfig, the_answer_says_where_the_textbook_goes_wrong_and_the_closed_form_does_not) {
  const std::string answer = extreme_outcome(few_extremes).answer;
  EXPECT_NE(answer.find("two balls wrong from 10^4 R apart in float and at no distance in double"), std::string::npos)
      << answer;
  EXPECT_NE(answer.find("it breaks nowhere"), std::string::npos) << answer;
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
  for (const char* text : {"scale = [1e-200]", "distance = [0.5]", "speed = [0]", "thickness = [2]", "offset = [1e13]",
                           "grazing = [1]", "ratio = [0]", "tolerance = 0.5", "one_in_at_50_digits = 0"}) {
    const std::string key(text, std::string_view(text).find(' '));
    EXPECT_NE(refusal(text).find("key '" + key + "'"), std::string::npos) << text;
  }
  EXPECT_NE(refusal("pair = ['capsule_obb']\nprecision = ['50_digits']").find("key 'precision'"), std::string::npos);
}

}  // namespace

}  // namespace thinwall
