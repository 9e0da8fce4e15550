#pragma once
/// Judges a certified answer by the oracle, which shares no code with the library.

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <thinwall/experiments/accuracy/oracle.hpp>

#include "support/certified.hpp"

namespace thinwall::testing {

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

}  // namespace thinwall::testing
