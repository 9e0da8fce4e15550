// Every pair, on plain motions and on the worst: verdict, bracket, order, and which stage decided, tallied.
// THINWALL_THOROUGH=2275 tests_swept --gtest_filter='CertifiedPairs.worst*' judges ten million.

#include <cstdio>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <thinwall/experiments/models/oracle.hpp>

#include "support/certified.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {
namespace {

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
      abs(oracle::verdict_margin<Real>(problem, tolerance)) <= touch) {
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

void print(const char* name, const Tally& tally) {
  std::printf("%-16s filter %5d, certificate %5d, exact %5d\n", name, tally.decided(DecidedBy::filter),
              tally.decided(DecidedBy::certificate), tally.decided(DecidedBy::exact));
}

/// Asks `judge` about `cases` motions, or more where thoroughness is asked for, of every pair; the answers must be the same bits the other way round.
template <class DrawMotion, class Judge>
Tally judge_every_pair(std::size_t cases, const DrawMotion& draw_motion, const Judge& judge) {
  Tally all;
  for_each_certified_pair([&]<class A, class B>(const char* name, PairOf<A, B> pair) {
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
  for_each_certified_pair([]<class A, class B>(const char* name, PairOf<A, B>) {
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
  for_each_certified_pair([]<class A, class B>(const char* name, PairOf<A, B>) {
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
