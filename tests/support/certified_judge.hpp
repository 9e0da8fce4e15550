#pragma once
/// Judges a certified answer: by exact integers for the stages in double, and by the oracle, which shares no code with either.

#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <thinwall/experiments/accuracy/oracle.hpp>
#include <thinwall/swept/certified.hpp>

namespace thinwall::testing {

/// How often each stage decided.
struct Tally {
  std::array<int, 4> by{};

  void count(const CertifiedToi& toi) { ++by[static_cast<std::size_t>(toi.decided_by)]; }
  int decided(DecidedBy stage) const { return by[static_cast<std::size_t>(stage)]; }
};

template <Shape A, Shape B> ExactCore exact_core_of(const Moving<A>& a, const Moving<B>& b) {
  if constexpr (A::rank < B::rank) {
    return exact_core(b, a);
  } else {
    return exact_core(a, b);
  }
}

/// The form every answer has, whatever the truth.
inline ::testing::AssertionResult has_form(const CertifiedToi& toi) {
  switch (toi.verdict) {
    case ToiStatus::apart:
      if (toi.lower == 1 && toi.upper == 1) return ::testing::AssertionSuccess();
      break;
    case ToiStatus::overlapping:
      if (toi.lower == 0 && toi.upper == 0) return ::testing::AssertionSuccess();
      break;
    case ToiStatus::hit:
      if (toi.lower >= 0 && toi.lower <= toi.upper && toi.upper <= 1) return ::testing::AssertionSuccess();
      break;
    default: break;
  }
  return ::testing::AssertionFailure() << "verdict " << static_cast<int>(toi.verdict) << " with [" << toi.lower << ", "
                                       << toi.upper << "]";
}

/// Against the integers: one predicate at the start, the end, and either side of the bracket.
template <Shape A, Shape B>
::testing::AssertionResult judge_exactly(const Moving<A>& a, const Moving<B>& b, const CertifiedToi& toi) {
  const ExactCore core = exact_core_of(a, b);
  const ToiStatus truth = touched_by(core, 0)   ? ToiStatus::overlapping
                          : touched_by(core, 1) ? ToiStatus::hit
                                                : ToiStatus::apart;
  if (truth != toi.verdict)
    return ::testing::AssertionFailure() << static_cast<int>(toi.verdict) << " but is " << static_cast<int>(truth);
  if (truth != ToiStatus::hit) return has_form(toi);
  if (!touched_by(core, toi.upper)) return ::testing::AssertionFailure() << "no contact by upper " << toi.upper;
  if (toi.lower > 0 && touched_by(core, std::nextafter(toi.lower, 0.0)))
    return ::testing::AssertionFailure() << "contact before lower " << toi.lower;
  return has_form(toi);
}

using CertifiedReal =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

/// Against the oracle. A separation of less than 10^-70 of the numbers it comes from is a touch: doubles that miss miss by more.
template <Shape A, Shape B>
::testing::AssertionResult judge_by_oracle(const Moving<A>& a, const Moving<B>& b, const CertifiedToi& toi) {
  const CertifiedReal touch("1e-70");
  const auto problem = oracle::pose<CertifiedReal>(a, b);
  const auto truth = oracle::first_contact<CertifiedReal>(problem, CertifiedReal(0), touch);
  const ToiStatus verdict = truth.verdict == oracle::Verdict::apart ? ToiStatus::apart
                            : truth.verdict == oracle::Verdict::hit ? ToiStatus::hit
                                                                    : ToiStatus::overlapping;
  if (verdict != toi.verdict)
    return ::testing::AssertionFailure() << static_cast<int>(toi.verdict) << " but is " << static_cast<int>(verdict);
  if (verdict != ToiStatus::hit) return has_form(toi);
  const CertifiedReal slack("1e-30");  // the touch above, where the approach is slow
  if (CertifiedReal(toi.lower) > truth.time * (1 + slack))
    return ::testing::AssertionFailure() << "late: " << toi.lower << " after " << truth.time;
  if (CertifiedReal(toi.upper) < truth.time * (1 - slack))
    return ::testing::AssertionFailure() << "early: " << toi.upper << " before " << truth.time;
  return has_form(toi);
}

}  // namespace thinwall::testing
