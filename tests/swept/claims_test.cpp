// What every method of the list claims, on random motions of every pair that it serves: 24 000 in double, 12 000 in float.
// RC_PARAMS="max_success=1000" makes it ten times as many.
//
// A cross-check of support/judge.hpp by the other oracle (fuzz/referee.hpp), at 50 digits. What it says of one time is a tenth of a
// millisecond's work. The gap is convex in time: if it is open and closing at some time, it was open before. Only where this does not
// decide does it search for the first contact.

#include <sstream>

#include <gtest/gtest.h>

#include <thinwall/swept/time_of_impact.hpp>

#include "fuzz/referee.hpp"
#include "support/any_number.hpp"
#include "support/method_claims.hpp"
#include "support/property.hpp"
#include "support/real.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

/// Of an answer about the shapes of `exhibit`.
::testing::AssertionResult judge_claims(const Claims& claims, const fuzz::Exhibit& exhibit, ToiStatus status,
                                        double time) {
  using ::testing::AssertionFailure;
  const fuzz::Referee<Wide> referee(exhibit);
  const auto gap_at = [&](double t) { return referee.at(Wide(t)).gap; };
  const Wide size = referee.size_at(1), noise = 64 * Wide(exhibit.u) * size;  // [length] what rounding may hide
  if (status == ToiStatus::invalid) return AssertionFailure() << "invalid";
  if (!(time >= 0 && time <= 1)) return AssertionFailure() << "time out of range: " << time;
  if (status == ToiStatus::overlapping) {
    if (gap_at(0) > noise) return AssertionFailure() << "overlapping, yet apart at the start";
    return ::testing::AssertionSuccess();
  }
  if (status == ToiStatus::apart) {
    if (!claims.never_late && !claims.never_misses) return ::testing::AssertionSuccess();
    const auto first = referee.first_contact(0);
    if (first.verdict == oracle::Verdict::apart) return ::testing::AssertionSuccess();
    const bool at_rest = exhibit.displacement_a == exhibit.displacement_b;  // then the discrete test decides
    if (claims.never_late && !at_rest) return AssertionFailure() << "missed";
    if (referee.deepest(first.time).gap < -noise) return AssertionFailure() << "missed by more than rounding";
    return ::testing::AssertionSuccess();
  }
  const auto there = referee.at(Wide(time));
  if (claims.never_late && time > 0 && !(there.gap > 0 && there.closing > 0)) {
    const auto first = referee.first_contact(0);
    if (first.verdict != oracle::Verdict::apart && first.time < Wide(time) * Wide(1 - 1e-30))
      return AssertionFailure() << "late: " << time;
  }
  if (status == ToiStatus::gave_up) return ::testing::AssertionSuccess();
  if (claims.touches && there.gap > noise) return AssertionFailure() << "apart by " << there.gap << " at a hit";
  // The direction of rounded closest points, off by e over their gap g, loses the size times e / g: near a gap of the root, all of it.
  const Wide blur = sqrt(noise * size) / 2;
  if (claims.early_by && there.gap > Wide(*claims.early_by) * referee.path() + noise + blur)
    return AssertionFailure() << "early: a gap of " << there.gap << " of a path of " << referee.path();
  if (claims.late_by && time > *claims.late_by && gap_at(time - *claims.late_by) < -noise)
    return AssertionFailure() << "late by more than the tolerance";
  return ::testing::AssertionSuccess();
}

// ---- Every method of the list on the same random motions, held to what it claims.

/// One motion of a pair, a third of them with a gap that counts as contact.
template <class A, class B> void every_method_keeps_its_claims() {
  using S = typename A::Scalar;
  const int seed = draw_integer(0, 1 << 30);
  Shaker<S> draw(static_cast<unsigned>(seed));
  const Motion<A, B> motion = drawn_motion<A, B>(draw);
  const S gap = draw.pick(0, 2) == 0 ? draw.sizes()[0] * power<S>(-draw.pick(0, 10)) : S(0);
  const fuzz::Exhibit exhibit = fuzz::exhibit(motion.a, motion.b, double{gap});
  for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) {
      Method method;
      method.min_separation = gap;
      const Toi<S> toi = time_of_impact(method, motion.a, motion.b);
      const auto judgment = judge_claims(claims_of(method), exhibit, toi.status, double{toi.time});
      if (judgment) return;
      std::ostringstream out;
      out << Method::name << " on seed " << seed << ", min_separation " << gap << ": " << judgment.message();
      RC_FAIL(out.str());
    }
  });
}

/// `runs` motions of every pair of shapes that is served.
template <class S> void check_every_pair(int runs) {
  for_each_served_pair<S>(
      [&]<class A, class B>(TypeTag<A>, TypeTag<B>) { check_property(runs, every_method_keeps_its_claims<A, B>); });
}

TEST(Claims, are_kept_on_every_pair_in_double) { check_every_pair<double>(2000); }
/// Computed in double: the answer must be no later after it is rounded to float.
TEST(Claims, are_kept_on_every_pair_in_float) { check_every_pair<float>(1000); }

}  // namespace
}  // namespace thinwall::testing
