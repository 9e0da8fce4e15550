/// The precision ladder's answers: who breaks where.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/extremes/breaks.hpp>
#include <thinwall/swept/methods.hpp>

#include "experiments/extremes_run.hpp"

namespace thinwall {
namespace {

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

/// A method of the list needs no line here to be asked.
TEST(Extremes, asks_every_method_of_the_list_and_the_foil) {
  const std::vector<std::string_view> names = extreme_method_names();
  const auto lines =
      extreme_lines("sphere_aabb", in_double, ExtremeAxis::distance, {1}, 1, {names.begin(), names.end()});
  std::vector<std::string> asked;
  for (const ExtremeLine& line : lines) asked.push_back(line.tally.method);
  EXPECT_EQ(asked.front(), "textbook");
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, Sphere<double>, Aabb<double>>) {
      EXPECT_NE(std::find(asked.begin(), asked.end(), Method::name), asked.end()) << Method::name;
    }
  });
}

/// A line as none is, for the tests of where a method breaks.
ExtremeLine made_up(double distance, std::int64_t queries, double worst_wrong, double forward, std::int64_t invalid) {
  ExtremeLine line = {extreme_pairs().data(), in_double, {ExtremeAxis::distance, distance}, {}};
  line.tally.method = "closed_form";
  line.tally.queries = queries;
  line.tally.worst_wrong = worst_wrong;
  line.tally.forward_max = forward;
  line.tally.invalid = invalid;
  return line;
}
const Arm& far_arm() {
  return *std::find_if(all_arms().begin(), all_arms().end(), [](const Arm& arm) { return arm.name == "far"; });
}

TEST(ExtremeBreaks, are_the_first_outward_and_the_worst_there) {
  const std::vector<ExtremeLine> lines = {made_up(1000, 9, 9, 0, 0), made_up(1, 9, 3.9, 99, 0), made_up(10, 9, 0, 0, 0),
                                          made_up(100, 9, 0, 101, 0), made_up(100, 9, 5, 0, 1)};
  const Survival s = survival(lines, far_arm(), "closed_form", in_double);
  EXPECT_EQ(s.survived, 10);
  EXPECT_EQ(s.broken, 100);
  EXPECT_EQ(s.flaw, Flaw::verdict);
  EXPECT_EQ(short_text(s), "2v");
}

TEST(ExtremeBreaks, skip_what_was_not_asked_and_tell_all_from_none) {
  EXPECT_EQ(
      short_text(survival({made_up(1, 9, 0, 0, 0), made_up(10, 0, 0, 0, 0)}, far_arm(), "closed_form", in_double)),
      "-");
  EXPECT_EQ(short_text(survival({made_up(1, 9, 0, 0, 1)}, far_arm(), "closed_form", in_double)), "alln");
  EXPECT_EQ(short_text(survival({made_up(1, 0, 0, 0, 0)}, far_arm(), "closed_form", in_double)), "");
}

TEST(ExtremeArms, lead_outward_from_the_usual) {
  std::vector<Place> places;
  for (const double value : {1e-30, 1e-10, 1.0, 1e10}) places.push_back({ExtremeAxis::scale, value});
  EXPECT_EQ(values_along(all_arms()[0], places), (std::vector<double>{1, 1e-10, 1e-30}));
  EXPECT_EQ(values_along(all_arms()[1], places), (std::vector<double>{1, 1e10}));
}

}  // namespace
}  // namespace thinwall
