// The methods that claim never to be late and never to miss, against the oracle at 100 digits and at every scalar.

#include <gtest/gtest.h>

#include "support/draw.hpp"
#include "support/judge.hpp"
#include "support/method_claims.hpp"

namespace thinwall::testing {
namespace {

template <class S> AssertionResult judge_never_late(const oracle::Impact& truth, const Toi<S>& toi) {
  if (toi.status == ToiStatus::invalid) return AssertionFailure() << "invalid";
  if (toi.status == ToiStatus::apart) {
    if (truth.verdict == oracle::Verdict::apart) return AssertionSuccess();
    return AssertionFailure() << "missed by a margin of " << truth.margin / oracle::unit_roundoff<S>() << " u";
  }
  if (!(toi.time >= S(0) && toi.time <= S(1))) return AssertionFailure() << "time out of range: " << toi.time;
  if (truth.verdict == oracle::Verdict::apart || toi.time == S(0)) return AssertionSuccess();
  const oracle::Real late = oracle::lift(toi.time) - truth.time;
  if (late <= 0) return AssertionSuccess();
  return AssertionFailure() << "late by " << late / oracle::unit_roundoff<S>() << " u of " << truth.time;
}

template <class A, class B> void conservative_methods_are_never_late() {
  using S = typename A::Scalar;
  const Style style = draw_style();
  const auto [a, b] = draw_moving_pair<PairOf<A, B>>(style);
  const S gap = draw_integer(0, 2) == 0 ? draw_size<S>(style) : S(0);
  RC_LOG() << "min_separation " << gap << "\n";
  oracle::Pair pair = oracle::pair(a, b);
  pair.min_separation = oracle::lift(gap);
  const oracle::Impact truth = oracle::impact(pair);
  for_each_type(Methods<S>{}, [&, &first = a, &second = b]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) {
      Method method;
      if (!claims_of(method).never_late) return;
      method.min_separation = gap;
      RC_LOG() << Method::name << "\n";
      THINWALL_PROPERTY(judge_never_late(truth, time_of_impact(method, first, second)));
    }
  });
}

template <class S> class NeverLate : public ::testing::Test {};
TYPED_TEST_SUITE(NeverLate, Scalars, ScalarNames);

TYPED_TEST(NeverLate, of_every_pair_that_the_oracle_knows) {  // it is slow where a core lies oblique
  using S = TypeParam;
  check_property(500, conservative_methods_are_never_late<Sphere<S>, Sphere<S>>);
  check_property(500, conservative_methods_are_never_late<Aabb<S>, Sphere<S>>);
  check_property(500, conservative_methods_are_never_late<Aabb<S>, Aabb<S>>);
  check_property(50, conservative_methods_are_never_late<Capsule<S>, Sphere<S>>);
  check_property(50, conservative_methods_are_never_late<Capsule<S>, Aabb<S>>);
  check_property(50, conservative_methods_are_never_late<Capsule<S>, Capsule<S>>);
}

}  // namespace
}  // namespace thinwall::testing
