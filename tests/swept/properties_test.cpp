// The closed form against the oracle on random and adversarial motions.

#include <algorithm>

#include <gtest/gtest.h>

#include <thinwall/swept/time_of_impact.hpp>

#include "support/draw.hpp"
#include "support/judge.hpp"
#include "support/property.hpp"

namespace thinwall::testing {
namespace {

template <class P> class SweptPair : public ::testing::Test {
 protected:
  /// The oracle takes milliseconds where a core lies oblique.
  static constexpr int runs = std::is_same_v<typename P::A, Capsule<typename P::S>> ? 100 : 2500;
};
using Pairs = ::testing::Types<PairOf<Sphere<float>, Sphere<float>>, PairOf<Sphere<double>, Sphere<double>>,
                               PairOf<Sphere<long double>, Sphere<long double>>, PairOf<Sphere<Wide>, Sphere<Wide>>,
                               PairOf<Aabb<float>, Sphere<float>>, PairOf<Aabb<double>, Sphere<double>>,
                               PairOf<Aabb<long double>, Sphere<long double>>, PairOf<Aabb<Wide>, Sphere<Wide>>,
                               PairOf<Aabb<float>, Aabb<float>>, PairOf<Aabb<double>, Aabb<double>>,
                               PairOf<Capsule<float>, Sphere<float>>, PairOf<Capsule<double>, Sphere<double>>,
                               PairOf<Capsule<float>, Aabb<float>>, PairOf<Capsule<double>, Aabb<double>>,
                               PairOf<Capsule<float>, Capsule<float>>, PairOf<Capsule<double>, Capsule<double>>>;
TYPED_TEST_SUITE(SweptPair, Pairs);

/// The accuracy contract; a verdict may be wrong only where 1 u of the inputs makes it right.
constexpr Allowance contract{4, 4, 1};

/// The front door, from either side, a third of the time with a gap that counts as contact; and the kernel, which computes in the shapes'
/// own scalar, where the front door would promote float to double. A discrete test at the pose of a hit agrees within rounding.
TYPED_TEST(SweptPair, time_of_impact_meets_the_contract) {
  using S = typename TypeParam::S;
  check_property(this->runs, [] {
    const Style style = draw_style();
    const auto [a, b] = draw_moving_pair<TypeParam>(style);
    const ClosedForm<S> method{.min_separation = draw_integer(0, 2) == 0 ? draw_shaker<S>(style).sizes()[0] : S(0)};
    RC_LOG() << "min_separation " << method.min_separation << "\n";
    oracle::Pair pair = oracle::pair(a, b), pair_back = oracle::pair(b, a);
    pair.min_separation = pair_back.min_separation = oracle::lift(method.min_separation);
    const Toi<S> toi = time_of_impact(method, a, b), back = time_of_impact(method, b, a);
    THINWALL_PROPERTY(judge(pair, toi, contract));
    THINWALL_PROPERTY(judge(pair, impact(method, a, b), {4, 4, 4}));
    if constexpr (std::is_same_v<typename TypeParam::A, typename TypeParam::B>) {
      THINWALL_PROPERTY(judge(pair_back, back, contract));
    } else if (toi.status == ToiStatus::overlapping) {  // whose normal may be any
      RC_ASSERT(back.status == ToiStatus::overlapping);
    } else {
      THINWALL_PROPERTY(same_answer(flipped(back), toi));
    }
    if (toi.status != ToiStatus::hit && toi.status != ToiStatus::overlapping) return;
    const oracle::Real rounding = oracle::unit_roundoff<S>() * size_at(pair, oracle::lift(toi.time));
    const oracle::Real gap = oracle::lift(separation(pose_at(a, toi.time), pose_at(b, toi.time)).distance);
    RC_ASSERT(gap <= pair.min_separation + 16 * rounding);
    if (toi.status == ToiStatus::hit) RC_ASSERT(gap >= pair.min_separation - 16 * rounding);
  });
}

/// The clear rung of the ladder answers.
template <class A, class B> bool is_clear(const Moving<A>& a, const Moving<B>& b) {
  if constexpr (HasClearImpact<A, B>) return clear_impact(a, b, 0).clear;
  return false;
}

/// Lengths times 2^k leave time and normal as they are, to the bit; displacements times 2^k divide the time: to the bit too, unless
/// another rung of the ladder answers, or a walk, which keep the contract.
TYPED_TEST(SweptPair, powers_of_two_change_no_bits) {
  using S = typename TypeParam::S;
  using A = typename TypeParam::A;
  using B = typename TypeParam::B;
  check_property(this->runs, [] {
    const auto [a, b] = draw_moving_pair<TypeParam>(*rc::gen::element(Style::lattice, Style::plain));
    const int k = draw_scale<S>();
    const auto large_a = scaled(a, k);
    const auto large_b = scaled(b, k);
    const Toi<S> here = time_of_impact(a, b);
    if (same_body(oracle::body(large_a), oracle::body(a), k) && same_body(oracle::body(large_b), oracle::body(b), k)) {
      Toi<S> expected = here;
      expected.point = times_power_of_two(here.point, k);
      THINWALL_PROPERTY(same_answer(time_of_impact(large_a, large_b), expected));
    }
    if (here.status != ToiStatus::hit) return;
    const int speed = *rc::gen::element(1, 5, 40);
    const Moving<A> faster_a{a.shape, times_power_of_two(a.displacement, speed)};
    const Moving<B> faster_b{b.shape, times_power_of_two(b.displacement, speed)};
    const Toi<S> faster = time_of_impact(faster_a, faster_b);
    // A walk ends elsewhere along a faster motion, by roundings of its guesses.
    constexpr int least = std::min(A::rank, B::rank), most = std::max(A::rank, B::rank);
    constexpr bool walks = most == Triangle<S>::rank || (most == Capsule<S>::rank && least > Sphere<S>::rank);
    if (walks || is_clear(a, b) != is_clear(faster_a, faster_b)) {
      THINWALL_PROPERTY(judge(oracle::pair(faster_a, faster_b), faster, contract));
      return;
    }
    RC_ASSERT(faster.status == ToiStatus::hit);
    const S expected = times_power_of_two(here.time, -speed), later = expected * (S(1) + times_power_of_two(S(1), -40));
    const bool put_at_end =
        here.time == S(1) && faster.time > expected && faster.time < later;  // else a rounding behind it
    RC_ASSERT(faster.time == expected || put_at_end);
    RC_ASSERT(faster.normal == here.normal);
  });
}

}  // namespace
}  // namespace thinwall::testing
