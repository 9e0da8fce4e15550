// The methods that claim never to be late and never to miss, against the oracle at 100 digits and at every scalar.

#include <gtest/gtest.h>

#include "support/draw.hpp"
#include "support/judge.hpp"
#include "support/method_claims.hpp"

namespace thinwall::testing {
namespace {

constexpr int runs = 250;

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

TYPED_TEST(NeverLate, sphere_and_sphere) {
  check_property(2 * runs, conservative_methods_are_never_late<Sphere<TypeParam>, Sphere<TypeParam>>);
}
TYPED_TEST(NeverLate, box_and_sphere) {
  check_property(2 * runs, conservative_methods_are_never_late<Aabb<TypeParam>, Sphere<TypeParam>>);
}
TYPED_TEST(NeverLate, box_and_box) {
  check_property(2 * runs, conservative_methods_are_never_late<Aabb<TypeParam>, Aabb<TypeParam>>);
}
TYPED_TEST(NeverLate, capsule_and_sphere) {
  check_property(runs / 5, conservative_methods_are_never_late<Capsule<TypeParam>, Sphere<TypeParam>>);
}
TYPED_TEST(NeverLate, capsule_and_box) {
  check_property(runs / 5, conservative_methods_are_never_late<Capsule<TypeParam>, Aabb<TypeParam>>);
}
TYPED_TEST(NeverLate, capsule_and_capsule) {
  check_property(runs / 5, conservative_methods_are_never_late<Capsule<TypeParam>, Capsule<TypeParam>>);
}

}  // namespace
}  // namespace thinwall::testing
