// Certified answers: the exact cases, bad input; and every pair, on plain motions and on the worst: verdict, bracket, order, and which stage
// decided, tallied.
// THINWALL_THOROUGH=2275 tests_swept --gtest_filter='CertifiedPairs.worst*' judges ten million.

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <thinwall/experiments/models/truth.hpp>

#include "support/any_number.hpp"
#include "support/certified.hpp"
#include "support/exact_cases.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {
namespace {

TEST(Certified, exact_cases_are_proven_by_the_stage_that_can_and_enclose_the_listed_time) {
  const std::map<DecidedBy, std::vector<std::string>> stages = {
      {DecidedBy::filter, {"1 head on", "16 far shot", "11 apart, at rest", "10 same center"}},
      {DecidedBy::certificate, {"29 thin wall", "30 corner on", "47 parallel"}},
      {DecidedBy::exact,
       {"2 exact graze", "3 graze missed by one ulp", "5 touch at the end", "21 least double as the unit",
        "32 edge missed by one ulp", "38 touch, leaving", "45 slides along a face"}}};
  int hits = 0, found = 0;
  for_each_exact_case<double>([&](const auto& c) {
    const CertifiedToi toi = certified_time_of_impact(c.a, c.b);
    EXPECT_EQ(toi.verdict, c.status);
    EXPECT_TRUE(judge_exactly(c.a, c.b, toi));
    EXPECT_EQ(certified_time_of_impact(c.b, c.a), toi);
    for (const auto& [stage, names] : stages) {
      if (std::ranges::find(names, c.name) == names.end()) continue;
      ++found;
      EXPECT_EQ(toi.decided_by, stage);
    }
    if (c.status != ToiStatus::hit) return;
    ++hits;
    EXPECT_LE(toi.lower, c.listed.value() * (1 + 1e-15));
    EXPECT_GE(toi.upper, c.listed.value() * (1 - 1e-15));
    EXPECT_LE(toi.upper - toi.lower, 0x1p-26 * toi.upper);
  });
  EXPECT_EQ(found, 14);
  EXPECT_GT(hits, 30);
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

TEST(Certified, a_face_is_crossed_between_its_sides_alone) {
  const auto crossing = [](const Vec3<double>& middle, const Vec3<double>& by) {
    return crossed_by(middle, {1, 0, 0}, {0, 1, 0}, by, {4, 4, 4});
  };
  EXPECT_GE(crossing({0.5, 0.5, 2}, {0, 0, -4}), 0.5);
  EXPECT_NEAR(crossing({0.5, 0.5, 2}, {0, 0, -4}), 0.5, 1e-13);
  for (const Vec3<double>& beside : {Vec3<double>(1.5, 0, 2), Vec3<double>(0, -1.5, 2)})
    EXPECT_FALSE(is_finite(crossing(beside, {0, 0, -4}))) << beside.transpose();
  EXPECT_FALSE(is_finite(crossing({0.5, 0.5, 2}, {0, 0, 4}))) << "it leads away";
  EXPECT_TRUE(is_within({1 - 0x1p-40, 0, 0}, 1, {1, 1, 1}, 32));
  EXPECT_FALSE(is_within({1 - 0x1p-48, 0, 0}, 1, {1, 1, 1}, 32)) << "within its rounding";
}

void expect_invalid(const CertifiedToi& toi) {
  EXPECT_EQ(toi.verdict, ToiStatus::invalid);
  EXPECT_TRUE(std::isnan(toi.lower) && std::isnan(toi.upper));
  EXPECT_EQ(toi.decided_by, DecidedBy::guard);
}

TEST(Certified, what_is_no_question_is_invalid) {
  for_each_certified_pair([]<class A, class B>(const std::string& name, PairOf<A, B>) {
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

// ---- Judges a certified answer by the oracle, which shares no code with the library.

template <unsigned digits>
using Digits =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<digits>, boost::multiprecision::et_off>;

/// At so many digits. The oracle finds a distance to about the root of its tolerance; nearer than that is a touch.
template <unsigned digits, Shape A, Shape B>
::testing::AssertionResult judge_at(const Moving<A>& a, const Moving<B>& b, const CertifiedToi& toi) {
  using Real = Digits<digits>;
  const Real tolerance = pow(Real(10), -(static_cast<int>(digits) - 12)), touch = 16 * sqrt(tolerance);
  const auto problem = oracle::pose<Real>(a, b);
  const Real guess = Real(toi.lower) * (1 - ldexp(Real(1), -20));  // saves rounds, no more
  const auto truth = oracle::first_contact<Real>(problem, guess, tolerance);
  const ToiStatus verdict = truth.start_margin <= touch               ? ToiStatus::overlapping
                            : truth.verdict == oracle::Verdict::hit   ? ToiStatus::hit
                            : truth.verdict == oracle::Verdict::apart ? ToiStatus::apart
                                                                      : ToiStatus::overlapping;
  if (verdict == ToiStatus::apart && toi.verdict == ToiStatus::hit &&
      abs(least_margin<Real>(problem, tolerance, tolerance)) <= touch) {
    return has_form(toi);  // it touches, but for the oracle's rounding
  }
  if (verdict != toi.verdict)
    return ::testing::AssertionFailure() << static_cast<int>(toi.verdict) << " but is " << static_cast<int>(verdict);
  if (verdict != ToiStatus::hit) return has_form(toi);
  const Real slack = touch * (truth.time + truth.conditioning);
  if (Real(toi.lower) > truth.time + slack)
    return ::testing::AssertionFailure() << "late: " << toi.lower << " after " << truth.time;
  if (Real(toi.upper) < truth.time - slack)
    return ::testing::AssertionFailure() << "early: " << toi.upper << " before " << truth.time;
  return has_form(toi);
}

/// Against the oracle: at 50 digits, and at 150 where that is too close to call.
template <Shape A, Shape B>
::testing::AssertionResult judge_by_oracle(const Moving<A>& a, const Moving<B>& b, const CertifiedToi& toi) {
  return judge_at<50>(a, b, toi) ? has_form(toi) : judge_at<150>(a, b, toi);
}

// ---- Every pair.

void print(const std::string& name, const Tally& tally) {
  std::printf("%-16s filter %5d, certificate %5d, exact %5d\n", name.c_str(), tally.decided(DecidedBy::filter),
              tally.decided(DecidedBy::certificate), tally.decided(DecidedBy::exact));
}

/// Asks `judge` about `cases` motions, or more where thoroughness is asked for, of every pair; the answers must be the same bits the other way round.
template <class DrawMotion, class Judge>
Tally judge_every_pair(std::size_t cases, const DrawMotion& draw_motion, const Judge& judge) {
  Tally all;
  for_each_certified_pair([&]<class A, class B>(const std::string& name, PairOf<A, B> pair) {
    SCOPED_TRACE(name);
    Shaker<double> draw(1);
    Tally tally;
    for (std::size_t i = 0; i < thorough(cases) && !::testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE(i);
      const Motion<A, B> motion = draw_motion(draw, pair);
      const CertifiedToi toi = certified_time_of_impact(motion.a, motion.b);
      tally.count(toi);
      all.count(toi);
      EXPECT_TRUE(judge(motion.a, motion.b, toi));
      EXPECT_EQ(certified_time_of_impact(motion.b, motion.a), toi);
    }
    print(name, tally);
  });
  return all;
}

const auto plain = []<class A, class B>(Shaker<double>& draw, PairOf<A, B>) { return plain_motion<A, B>(draw); };
const auto worst = []<class A, class B>(Shaker<double>& draw, PairOf<A, B>) { return worst_motion<A, B>(draw); };
const auto close = []<class A, class B>(Shaker<double>& draw, PairOf<A, B>) { return drawn_motion<A, B>(draw); };
const auto by_integers = [](const auto& a, const auto& b, const CertifiedToi& toi) { return judge_exactly(a, b, toi); };
const auto by_oracle = [](const auto& a, const auto& b, const CertifiedToi& toi) { return judge_by_oracle(a, b, toi); };

TEST(CertifiedPairs, plain_motions_are_decided_in_double) {
  for_each_certified_pair([]<class A, class B>(const std::string& name, PairOf<A, B>) {
    SCOPED_TRACE(name);
    Shaker<double> draw(7);
    Tally tally;
    std::array<int, 5> verdicts{};
    for (int i = 0; i < 10000; ++i) {
      const Motion<A, B> motion = plain_motion<A, B>(draw);
      const CertifiedToi toi = certified_time_of_impact(motion.a, motion.b);
      tally.count(toi);
      ++verdicts[static_cast<std::size_t>(toi.verdict)];
      EXPECT_TRUE(has_form(toi));
      if (toi.verdict == ToiStatus::hit) {
        EXPECT_LE(toi.upper - toi.lower, 0x1p-26 * toi.upper);
      }
    }
    print(name, tally);
    EXPECT_EQ(tally.decided(DecidedBy::exact), 0);
    const bool same_kind = std::is_same_v<A, B> && has_symmetric_filter<A>;
    EXPECT_EQ(tally.decided(same_kind ? DecidedBy::filter : DecidedBy::certificate), 10000);
    EXPECT_GT(verdicts[0], 500);  // apart
    EXPECT_GT(verdicts[1], 500);  // hit
    EXPECT_GT(verdicts[2], 50);   // overlapping
  });
}

TEST(CertifiedPairs, plain_motions_agree_with_the_integers) { judge_every_pair(100, plain, by_integers); }
TEST(CertifiedPairs, plain_motions_agree_with_the_oracle) { judge_every_pair(40, plain, by_oracle); }
TEST(CertifiedPairs, close_motions_agree_with_the_oracle) { judge_every_pair(60, close, by_oracle); }
TEST(CertifiedPairs, worst_motions_agree_with_the_integers_at_every_stage) {
  const Tally all = judge_every_pair(400, worst, by_integers);
  EXPECT_GT(all.decided(DecidedBy::filter), 80);
  EXPECT_GT(all.decided(DecidedBy::certificate), 400);
  EXPECT_GT(all.decided(DecidedBy::exact), 400);
}

TEST(CertifiedPairs, verdicts_are_the_same_at_every_scale) {  // and the brackets share the contact
  for_each_certified_pair([]<class A, class B>(const std::string& name, PairOf<A, B>) {
    SCOPED_TRACE(name);
    Shaker<double> draw(11);
    for (int i = 0; i < 60; ++i) {
      const Motion<A, B> motion = drawn_motion<A, B>(draw);
      const CertifiedToi toi = certified_time_of_impact(motion.a, motion.b);
      for (const int e : {-600, -300, 300, 600}) {
        const CertifiedToi there = certified_time_of_impact(scaled(motion.a, e), scaled(motion.b, e));
        EXPECT_EQ(there.verdict, toi.verdict) << i << " times 2^" << e;
        if (toi.verdict != ToiStatus::hit) continue;
        EXPECT_LE(there.lower, toi.upper);
        EXPECT_LE(toi.lower, there.upper);
      }
    }
  });
}

}  // namespace
}  // namespace thinwall::testing
