#pragma once
/// Judges a certified answer by the oracle, which shares no code with the library.

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <thinwall/experiments/accuracy/oracle.hpp>

#include "support/certified_judge.hpp"

namespace thinwall::testing {

using CertifiedReal =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>, boost::multiprecision::et_off>;

/// Against the oracle. A separation of less than 10^-45 of the numbers it comes from is a touch: doubles that miss miss by more.
template <Shape A, Shape B>
::testing::AssertionResult judge_by_oracle(const Moving<A>& a, const Moving<B>& b, const CertifiedToi& toi) {
  const CertifiedReal touch("1e-45");
  const auto problem = oracle::pose<CertifiedReal>(a, b);
  const CertifiedReal guess = CertifiedReal(toi.lower) * (1 - ldexp(CertifiedReal(1), -20));  // saves rounds, no more
  const auto truth = oracle::first_contact<CertifiedReal>(problem, guess, touch);
  const ToiStatus verdict = truth.verdict == oracle::Verdict::apart ? ToiStatus::apart
                            : truth.verdict == oracle::Verdict::hit ? ToiStatus::hit
                                                                    : ToiStatus::overlapping;
  if (verdict == ToiStatus::apart && toi.verdict == ToiStatus::hit &&
      abs(oracle::verdict_margin<CertifiedReal>(problem, touch)) <= touch) {
    return has_form(toi);  // a touch, whose time the oracle finds but for rounding
  }
  if (verdict != toi.verdict)
    return ::testing::AssertionFailure() << static_cast<int>(toi.verdict) << " but is " << static_cast<int>(verdict);
  if (verdict != ToiStatus::hit) return has_form(toi);
  const CertifiedReal slack("1e-20");  // the touch above, where the approach is slow
  if (CertifiedReal(toi.lower) > truth.time * (1 + slack))
    return ::testing::AssertionFailure() << "late: " << toi.lower << " after " << truth.time;
  if (CertifiedReal(toi.upper) < truth.time * (1 - slack))
    return ::testing::AssertionFailure() << "early: " << toi.upper << " before " << truth.time;
  return has_form(toi);
}

}  // namespace thinwall::testing
