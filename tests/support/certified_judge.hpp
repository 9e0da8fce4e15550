#pragma once
/// Judges a certified answer by the exact integers of the last stage, themselves judged in certified_oracle.hpp.

#include <array>
#include <cmath>

#include <gtest/gtest.h>

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

}  // namespace thinwall::testing
