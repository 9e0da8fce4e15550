#pragma once
/// Answers a query by the closed form, by the oracle, and counts the difference.

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <thinwall/experiments/accuracy/draw.hpp>
#include <thinwall/experiments/accuracy/oracle.hpp>
#include <thinwall/experiments/accuracy/tally.hpp>

namespace thinwall {

using Digits50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// The kernel itself, in the shapes' own scalar: what the front door calls, without the promotion to double.
template <Shape A, Shape B> Toi<typename A::Scalar> kernel_impact(const Moving<A>& a, const Moving<B>& b) {
  if constexpr (A::rank < B::rank) {
    return flipped(impact(ClosedForm<typename A::Scalar>{}, b, a));
  } else {
    return impact(ClosedForm<typename A::Scalar>{}, a, b);
  }
}

inline bool agree(ToiStatus status, oracle::Verdict verdict) {
  switch (status) {
    case ToiStatus::apart: return verdict == oracle::Verdict::apart;
    case ToiStatus::hit: return verdict == oracle::Verdict::hit;
    case ToiStatus::overlapping: return verdict == oracle::Verdict::overlapping;
    default: return false;
  }
}

/// By how much the input would have to change, in u, to make a wrong verdict right.
template <class R, class S>
double wrongness(const oracle::Problem<R>& problem, const Toi<S>& toi, const oracle::Impact<R>& truth,
                 const R& tolerance) {
  const bool about_start = toi.status == ToiStatus::overlapping || truth.verdict == oracle::Verdict::overlapping;
  const R margin = about_start ? truth.start_margin : oracle::verdict_margin(problem, tolerance);
  return std::abs(static_cast<double>(margin)) / (static_cast<double>(std::numeric_limits<S>::epsilon()) / 2);
}

/// Times and verdict against the oracle at 50 digits.
template <class A, class B, class S = typename A::Scalar>
void judge_answer(const Moving<A>& a, const Moving<B>& b, const Toi<S>& toi, AccuracyTally& tally) {
  const Digits50 tolerance = ldexp(Digits50(1), -140);
  const auto problem = oracle::pose<Digits50>(a, b);
  const bool timed = toi.status == ToiStatus::hit;
  const Digits50 guess =
      timed ? Digits50(toi.time) * (1 - ldexp(Digits50(1), -std::numeric_limits<S>::digits / 2)) : Digits50(0);
  const auto truth = oracle::first_contact(problem, guess, tolerance);
  ++tally.queries;
  tally.hits += truth.verdict == oracle::Verdict::hit ? 1 : 0;
  tally.overlapping += truth.verdict == oracle::Verdict::overlapping ? 1 : 0;
  tally.gave_up += toi.status == ToiStatus::gave_up ? 1 : 0;
  if (!agree(toi.status, truth.verdict)) {
    ++tally.wrong_verdicts;
    tally.largest_wrong = std::max(tally.largest_wrong, wrongness(problem, toi, truth, tolerance));
    return;
  }
  if (!timed) return;
  const Digits50 u = Digits50(std::numeric_limits<S>::epsilon()) / 2;
  const double forward = static_cast<double>(abs(Digits50(toi.time) - truth.time) / (u * truth.conditioning));
  const auto there = oracle::gap_at(problem, Digits50(toi.time), tolerance);
  const double backward =
      there.core > 0 ? static_cast<double>(abs(there.core - problem.reach) / (u * there.scale)) : forward;
  tally.forward.add(forward);
  tally.backward.add(backward);
}

/// The verdict alone, first against the oracle in long double, and at 50 digits where that is too close to call.
template <class A, class B> void judge_verdict(const Moving<A>& a, const Moving<B>& b, AccuracyTally& tally) {
  const auto toi = time_of_impact(a, b);
  const long double tolerance = std::ldexp(1.0L, -56);
  const auto problem = oracle::pose<long double>(a, b);
  const auto rough = oracle::first_contact<long double>(
      problem, toi.status == ToiStatus::hit ? static_cast<long double>(toi.time) * (1 - 0x1p-26L) : 0.0L, tolerance);
  if (agree(toi.status, rough.verdict)) {
    ++tally.queries;
    tally.hits += rough.verdict == oracle::Verdict::hit ? 1 : 0;
    tally.overlapping += rough.verdict == oracle::Verdict::overlapping ? 1 : 0;
    return;
  }
  judge_answer(a, b, toi, tally);
}

}  // namespace thinwall
