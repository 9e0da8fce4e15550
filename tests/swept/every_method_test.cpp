// What holds for every method in the list, the foils included.

#include <string>

#include <gtest/gtest.h>
#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "support/any_number.hpp"
#include "support/draw.hpp"
#include "support/judge.hpp"
#include "support/method_claims.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

template <class S> class EveryMethod : public ::testing::Test {
 protected:
  using Ball = Moving<Sphere<S>>;
  using Box = Moving<Aabb<S>>;

  /// Calls check(method) for each method of the list, default options.
  template <class Check> static void each(const Check& check) {
    for_each_type(Methods<S>{}, [&](auto tag) {
      using Method = typename decltype(tag)::type;
      static_assert(serves<Method, Sphere<S>, Sphere<S>> && serves<Method, Sphere<S>, Aabb<S>> &&
                    serves<Method, Aabb<S>, Sphere<S>>);
      SCOPED_TRACE(std::string(Method::name));
      check(Method{});
    });
  }
  static void expect_invalid(const Toi<S>& toi) {
    EXPECT_EQ(text(toi.status), text(ToiStatus::invalid));
    EXPECT_NE(toi.time, toi.time);
    EXPECT_EQ(toi.normal, Vec3<S>(0, 0, 0));
    EXPECT_EQ(toi.point, Vec3<S>(0, 0, 0));
  }
  template <class Method, class A, class B>
  static void expect_invalid_both_ways(const Method& m, const A& a, const B& b) {
    expect_invalid(time_of_impact(m, a, b));
    expect_invalid(time_of_impact(m, b, a));
  }

  const Ball ball{Sphere<S>{{-4, 0, 0}, 1}, {8, 0, 0}};
  const Ball other = at_rest(Sphere<S>{{0, 0, 0}, 1});
  const Box box = at_rest(Aabb<S>{{0, 0, 0}, {1, 1, 1}});
};
TYPED_TEST_SUITE(EveryMethod, Scalars, ScalarNames);

TYPED_TEST(EveryMethod, bad_numbers_are_invalid) {
  using S = TypeParam;
  this->each([this](const auto& method) {
    const auto check = [&](auto a, auto b) {
      const auto ask = [&](const std::string& name, const S& number) {
        const bool is_size = name == "radius" || name.starts_with("half");
        if (!is_finite(number) || (is_size && number < 0)) this->expect_invalid_both_ways(method, a, b);
      };
      with_every_number<S>(a, ask);
      with_every_number<S>(b, ask);
    };
    check(this->ball, this->other);
    check(this->ball, this->box);
  });
}

TYPED_TEST(EveryMethod, options_out_of_range_are_invalid) {
  using S = TypeParam;
  this->each([this](const auto& usual) {
    auto method = usual;
    const auto expect = [&]<class T>(T& option, const std::vector<std::type_identity_t<T>>& values, bool allowed) {
      const T before = option;
      for (const T& value : values) {
        option = value;
        if (allowed) {
          EXPECT_EQ(text(time_of_impact(method, this->ball, this->box).status), text(ToiStatus::hit)) << value;
        } else {
          this->expect_invalid_both_ways(method, this->ball, this->box);
          this->expect_invalid_both_ways(method, this->ball, this->other);
        }
      }
      option = before;
    };
    [[maybe_unused]] const S finest = std::numeric_limits<S>::epsilon();
    expect(method.min_separation, {S(-1), nan<S>(), infinity<S>()}, false);
    if constexpr (requires { method.tolerance; }) {
      expect(method.tolerance, {S(0), S(-1), S(finest / 2), S(1.5), nan<S>(), infinity<S>()}, false);
      expect(method.tolerance, {finest, S(1)}, true);
    }
    if constexpr (requires { method.margin; }) {
      expect(method.margin, {S(-1), nan<S>(), infinity<S>()}, false);
      expect(method.margin, {std::numeric_limits<S>::max()}, true);
    }
    if constexpr (requires { method.max_evaluations; }) expect(method.max_evaluations, {0, -1}, false);
    if constexpr (requires { method.n; }) expect(method.n, {0, -1}, false);
  });
}

TYPED_TEST(EveryMethod, what_is_long_in_contact_is_found_by_all) {  // at any size, and at that of the largest number
  using S = TypeParam;
  this->each([](const auto& method) {
    for (const S& length : {S(1), S(std::numeric_limits<S>::max() / 16)}) {
      const Vec3<S> from = Vec3<S>(-4, 0, 0) * length;  // into the middle of the box, and no farther
      const auto wall = at_rest(Aabb<S>{{0, 0, 0}, Vec3<S>::Constant(length)});
      const Toi<S> toi = time_of_impact(method, Moving<Sphere<S>>{{from, length}, Vec3<S>(-from)}, wall);
      EXPECT_EQ(text(toi.status), text(ToiStatus::hit));
      const S early = half_digits<S>();  // the default tolerance of those that promise never to be late
      EXPECT_TRUE(toi.time >= S(0.5) - early && toi.time <= S(1)) << toi.time;  // true contact at one half
      EXPECT_TRUE(is_unit(toi.normal));
    }
  });
}

/// A turned box comes down on a level one with an edge, whichever is seen from the other: over a gap of a tolerance the normal is the face's.
TYPED_TEST(EveryMethod, a_normal_across_a_tiny_gap_does_not_lean) {
  using S = TypeParam;
  const S sine = S(5) / S(13), cosine = S(12) / S(13), height = (S(3) * sine + cosine) / S(4);
  const Mat3<S> tilted = turn_in_plane(0, 1, cosine, sine);
  const Obb<S> falling{{S(0.25), height + S(0.0078125), 0}, {S(0.75), S(0.25), S(0.5)}, tilted};
  const Aabb<S> upright{{0, -1, 0}, {2, 1, 2}};
  const auto lands = [&](const auto& method, const auto& moving, const auto& floor) {
    for (const Toi<S>& toi : {time_of_impact(method, moving, floor), flipped(time_of_impact(method, floor, moving))}) {
      if (toi.status != ToiStatus::hit) continue;
      EXPECT_LE(S((toi.normal + Vec3<S>::Unit(1)).norm()), half_digits<S>());
    }
  };
  this->each([&]<class Method>(const Method& method) {
    const Moving moving{falling, {0, S(-0.015625), 0}};
    if constexpr (serves<Method, Obb<S>, Aabb<S>>) lands(method, moving, at_rest(upright));
    if constexpr (serves<Method, Obb<S>, Obb<S>>) lands(method, moving, at_rest(to_obb(upright)));
  });
  lands(ConservativeAdvancement<S>{}, Turning<Obb<S>>{falling, {0, S(-0.015625), 0}, {0, 0, 0}}, at_rest(upright));
}

TYPED_TEST(EveryMethod, at_rest_or_in_the_same_motion_sees_what_is_there) {
  using S = TypeParam;
  this->each([this](const auto& method) {
    for (const Vec3<S>& drift : {Vec3<S>(0, 0, 0), Vec3<S>(1024, -512, 256)}) {
      for (const S& x : {S(-4), S(-2), S(-1), S(0)}) {  // apart, touching, overlapping, one center
        const Moving<Sphere<S>> shot{{{x, 0, 0}, 1}, drift}, beside{this->other.shape, drift};
        const Moving<Aabb<S>> wall{this->box.shape, drift};
        for (const Toi<S>& toi : {time_of_impact(method, shot, wall), time_of_impact(method, shot, beside)}) {
          SCOPED_TRACE(text(toi.status));
          EXPECT_EQ(toi.status == ToiStatus::apart, x == S(-4));
          if (x == S(-4)) continue;
          EXPECT_TRUE(toi.status == ToiStatus::overlapping || !claims_of(method).sees_start);
          EXPECT_EQ(toi.time == S(0), toi.status == ToiStatus::overlapping);
          EXPECT_TRUE(is_unit(toi.normal));
        }
      }
    }
  });
}

/// A miss carries no data; B and A have the same answer, flipped; lengths times a power of two change no bit of time and normal, as far as
/// squares overflow.
template <class A, class B> void expect_form(const Motion<A, B>& motion) {
  using S = typename A::Scalar;
  for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) {
      SCOPED_TRACE(std::string(Method::name));
      const Toi<S> toi = time_of_impact(Method{}, motion.a, motion.b);
      if (toi.status == ToiStatus::apart) {
        EXPECT_EQ(toi.time, S(1));
        EXPECT_EQ(toi.normal, Vec3<S>(0, 0, 0));
        EXPECT_EQ(toi.point, Vec3<S>(0, 0, 0));
      }
      if constexpr (!std::is_same_v<A, B>) {
        EXPECT_TRUE(same_answer(flipped(time_of_impact(Method{}, motion.b, motion.a)), toi));
      }
      // a drawn coordinate may have all digits of S and be 2^-70 of the largest
      constexpr int most = std::numeric_limits<S>::max_exponent > 1000 ? 700 : 30;
      for (const int k : {-most, -1, 1, most}) {
        Toi<S> there = time_of_impact(Method{}, scaled(motion.a, k), scaled(motion.b, k));
        EXPECT_EQ(there.evaluations, toi.evaluations) << k;
        there.point = toi.point;
        EXPECT_TRUE(same_answer(there, toi)) << k;
      }
    }
  });
}

TYPED_TEST(EveryMethod, answers_the_same_from_either_side_and_in_any_unit_of_length) {
  using S = TypeParam;
  Shaker<S> draw(7);
  for (int i = 0; i < 200; ++i) {
    expect_form(drawn_motion<Sphere<S>, Sphere<S>>(draw));
    expect_form(drawn_motion<Aabb<S>, Sphere<S>>(draw));
    expect_form(drawn_motion<Aabb<S>, Aabb<S>>(draw));
  }
}

// ---- The methods that claim never to be late and never to miss, against the oracle at 100 digits.

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
  const S gap = draw_integer(0, 2) == 0 ? draw_shaker<S>(style).sizes()[0] : S(0);
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
