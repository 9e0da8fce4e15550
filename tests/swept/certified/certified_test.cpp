// The exact cases, bad input, and what holds of every certified answer.

#include <gtest/gtest.h>

#include "support/any_number.hpp"
#include "support/certified.hpp"
#include "support/exact_cases.hpp"
#include "support/judge.hpp"
#include "support/pair.hpp"

namespace thinwall::testing {
namespace {

TEST(Certified, exact_cases_have_the_listed_verdict_and_enclose_the_listed_time) {
  int hits = 0;
  for_each_exact_case<double>([&](const auto& c) {
    const CertifiedToi toi = certified_time_of_impact(c.a, c.b);
    EXPECT_EQ(text(toi.verdict), text(c.status));
    EXPECT_TRUE(has_form(toi));
    EXPECT_EQ(certified_time_of_impact(c.b, c.a), toi);
    if (c.status != ToiStatus::hit) return;
    ++hits;
    const oracle::Real time = oracle::impact(oracle::pair(c.a, c.b)).time, slack("1e-80");
    EXPECT_LE(oracle::Real(toi.lower), time * (1 + slack));
    EXPECT_GE(oracle::Real(toi.upper), time * (1 - slack));
    EXPECT_LE(toi.upper - toi.lower, 0x1p-26 * toi.upper);
  });
  EXPECT_GT(hits, 30);
}

TEST(Certified, exact_cases_are_decided_by_the_stage_that_can) {
  const auto stage_of = [](const auto& cases, const std::string& name) {
    for (const auto& c : cases) {
      if (c.name == name) return certified_time_of_impact(c.a, c.b).decided_by;
    }
    ADD_FAILURE() << name;
    return DecidedBy::guard;
  };
  const auto balls = sphere_cases<double>();
  EXPECT_EQ(stage_of(balls, "1 head on"), DecidedBy::filter);
  EXPECT_EQ(stage_of(balls, "16 far shot"), DecidedBy::filter);
  EXPECT_EQ(stage_of(balls, "11 apart, at rest"), DecidedBy::filter);
  EXPECT_EQ(stage_of(balls, "10 same center"), DecidedBy::filter);
  EXPECT_EQ(stage_of(balls, "2 exact graze"), DecidedBy::exact);
  EXPECT_EQ(stage_of(balls, "3 graze missed by one ulp"), DecidedBy::exact);
  EXPECT_EQ(stage_of(balls, "5 touch at the end"), DecidedBy::exact);
  EXPECT_EQ(stage_of(balls, "21 least double as the unit"), DecidedBy::exact);
  const auto boxes = box_cases<double>();
  EXPECT_EQ(stage_of(boxes, "29 thin wall"), DecidedBy::certificate);
  EXPECT_EQ(stage_of(boxes, "30 corner on"), DecidedBy::certificate);
  EXPECT_EQ(stage_of(boxes, "32 edge missed by one ulp"), DecidedBy::exact);
  EXPECT_EQ(stage_of(boxes, "38 touch, leaving"), DecidedBy::exact);
  EXPECT_EQ(stage_of(box_pair_cases<double>(), "45 slides along a face"), DecidedBy::exact);
  EXPECT_EQ(stage_of(capsule_pair_cases<double>(), "47 parallel"), DecidedBy::certificate);
}

TEST(Certified, boxes_turned_by_next_to_nothing_overlap) {  // case 51
  Obb<double> turned{{1.99, 0, 0}, {1, 1, 1}, Mat3<double>::Identity()};
  turned.axes(0, 1) = -1e-15;
  turned.axes(1, 0) = 1e-15;
  const auto toi = certified_time_of_impact(at_rest(Aabb<double>{{0, 0, 0}, {1, 1, 1}}), at_rest(turned));
  EXPECT_EQ(toi.verdict, ToiStatus::overlapping);
  EXPECT_EQ(toi.decided_by, DecidedBy::certificate);
}

TEST(Certified, a_box_is_what_its_axes_span_though_they_lean) {  // by 2^-31: its corner is at x = 1 + 2^-31
  Obb<double> sheared{{0, 0, 0}, {1, 1, 1}, Mat3<double>::Identity()};
  sheared.axes(0, 1) = 0x1p-31;
  const auto at_height = [&](double y) {
    return certified_time_of_impact(Moving{Sphere<double>{{1 + 0x1p-32, y, 0}, 0}, {-0x1p-33, 0, 0}}, at_rest(sheared));
  };
  EXPECT_EQ(at_height(1).verdict, ToiStatus::overlapping);
  EXPECT_EQ(at_height(0).verdict, ToiStatus::apart);  // there it ends at x = 1
}

void expect_invalid(const CertifiedToi& toi) {
  EXPECT_EQ(text(toi.verdict), text(ToiStatus::invalid));
  EXPECT_TRUE(std::isnan(toi.lower) && std::isnan(toi.upper));
  EXPECT_EQ(toi.decided_by, DecidedBy::guard);
}

TEST(Certified, what_is_no_question_is_invalid) {
  for_each_certified_pair([]<class A, class B>(const char* name, PairOf<A, B>) {
    SCOPED_TRACE(name);
    Moving<A> a{usual(TypeTag<A>{}), {6, 0.25, 0.125}};
    Moving<B> b = at_rest(moved(usual(TypeTag<B>{}), Vec3<double>(5, 0.25, 0.125)));
    const auto ask = [&] {
      if (valid(a) && valid(b)) return;
      expect_invalid(certified_time_of_impact(a, b));
      expect_invalid(certified_time_of_impact(b, a));
    };
    with_every_number<double>(a, ask);
    with_every_number<double>(b, ask);
  });
  Obb<double> leaning{{0, 0, 0}, {1, 1, 1}, Mat3<double>::Identity()};
  leaning.axes(2, 1) = 1e-8;
  expect_invalid(certified_time_of_impact(at_rest(Sphere<double>{{-4, 0, 0}, 1}), at_rest(leaning)));
}

TEST(Certified, the_largest_doubles_are_a_question) {
  const double most = std::numeric_limits<double>::max();
  const Moving shot{Sphere<double>{{-most, 0, 0}, most}, {most, 0, 0}};
  EXPECT_EQ(certified_time_of_impact(shot, at_rest(Sphere<double>{{most, 0, 0}, 0})).verdict, ToiStatus::hit);
  const auto graze = certified_time_of_impact(shot, at_rest(Sphere<double>{{most, 0, 0}, most}));
  EXPECT_EQ(graze.verdict, ToiStatus::overlapping);
  const Moving fast{Sphere<double>{{-most, 0, 0}, 0}, {most, 0, 0}};
  const auto wall = at_rest(Aabb<double>{{0, 0, 0}, {std::numeric_limits<double>::denorm_min(), most, most}});
  EXPECT_EQ(certified_time_of_impact(fast, wall).verdict, ToiStatus::hit);
}

}  // namespace
}  // namespace thinwall::testing
