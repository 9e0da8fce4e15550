#pragma once
/// Judges what a method answered by what it claims, at 50 digits.
///
/// The referee is experiments/accuracy/oracle.hpp, which shares no code with the library: it knows a shape only by its
/// farthest point in a direction, and says how far apart two shapes are at one time, exactly as given. That is a tenth of a
/// millisecond's work. The gap is convex in time: if it is open and closing at some time, it was open before. Only where
/// this does not decide does the referee search for the first contact.

#include <sstream>

#include <gtest/gtest.h>

#include <thinwall/experiments/accuracy/oracle.hpp>
#include <thinwall/swept/moving.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>
#include <thinwall/swept/toi.hpp>

#include "support/method_claims.hpp"
#include "support/property.hpp"
#include "support/real.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {

template <class A, class B> class Referee {
  using S = typename A::Scalar;

 public:
  Referee(const Moving<A>& a, const Moving<B>& b, const S& min_separation) : problem_(oracle::pose<Wide>(a, b)) {
    problem_.reach += Wide(min_separation);
    path_ = sqrt(oracle::dot(problem_.motion, problem_.motion));
    for (std::size_t i = 0; i < 3; ++i) size_ += problem_.start_size[i] + problem_.speed_size[i];
    size_ += problem_.reach;
    noise_ = 64 * Wide(unit<S>()) * size_;
  }

  bool touches() const { return first_contact().verdict != oracle::Verdict::apart; }
  Wide gap(const S& time) const { return at(time).core - problem_.reach; }
  Wide path() const { return path_; }
  Wide noise() const { return noise_; }  ///< [length] what rounding may hide

  /// [length] A gap so small that the direction of its rounded closest points may miss the gap altogether: off by e over
  /// the gap g, it loses up to the size times e / g.
  Wide blur() const { return sqrt(noise_ * size_) / 2; }

  /// True if the shapes touch before `time`.
  bool touches_before(const S& time) const {
    if (time == S(0)) return false;
    const oracle::Gap<Wide> there = at(time);
    const Wide open = there.core - problem_.reach;
    if (open < -Wide(1e-40) * size_) return true;
    if (there.core > 0 && there.closing > 0) return false;
    const oracle::Impact<Wide> first = first_contact();
    return first.verdict != oracle::Verdict::apart && first.time < Wide(time) * Wide(1 - 1e-30);
  }

  /// There is contact, but not by more than the noise: shapes that much smaller do not touch, or not for long.
  bool barely_touches() const {
    const oracle::Impact<Wide> first = first_contact();
    Wide low = first.time, high = 1;
    for (int round = 0; round < 60; ++round) {  // to the deepest time
      const Wide middle = (low + high) / 2;
      (oracle::gap_at(problem_, middle, tolerance()).closing > 0 ? low : high) = middle;
    }
    return oracle::gap_at(problem_, low, tolerance()).core - problem_.reach >= -noise_ || problem_.reach <= noise_;
  }

 private:
  static Wide tolerance() { return Wide(1e-45); }
  oracle::Gap<Wide> at(const S& time) const { return oracle::gap_at(problem_, Wide(time), tolerance()); }
  oracle::Impact<Wide> first_contact() const { return oracle::first_contact(problem_, Wide(0), tolerance()); }

  oracle::Problem<Wide> problem_;
  Wide path_ = 0, size_ = 0, noise_ = 0;
};

template <class A, class B, class S>
::testing::AssertionResult judge_claims(const Claims& claims, const Referee<A, B>& referee, const Toi<S>& toi) {
  using ::testing::AssertionFailure;
  if (toi.status == ToiStatus::invalid) return AssertionFailure() << "invalid";
  if (!(toi.time >= S(0) && toi.time <= S(1))) return AssertionFailure() << "time out of range: " << toi.time;
  if (toi.status == ToiStatus::overlapping) {
    if (referee.gap(S(0)) > referee.noise()) return AssertionFailure() << "overlapping, yet apart at the start";
    return ::testing::AssertionSuccess();
  }
  if (toi.status == ToiStatus::apart) {
    if ((claims.never_late || claims.never_misses) && referee.touches()) {
      const bool exact = claims.never_late && referee.path() != 0;  // at rest the discrete test decides
      if (exact || !referee.barely_touches()) return AssertionFailure() << "missed";
    }
    return ::testing::AssertionSuccess();
  }
  if (claims.never_late && referee.touches_before(toi.time)) return AssertionFailure() << "late: " << toi.time;
  if (toi.status == ToiStatus::gave_up) return ::testing::AssertionSuccess();
  const Wide gap = claims.touches || claims.early_by ? referee.gap(toi.time) : Wide(0);
  if (claims.touches && gap > referee.noise()) return AssertionFailure() << "apart by " << gap << " at a hit";
  if (claims.early_by && gap > Wide(*claims.early_by) * referee.path() + referee.noise() + referee.blur())
    return AssertionFailure() << "early: a gap of " << gap << " of a path of " << referee.path();
  if (claims.late_by && toi.time > S(*claims.late_by) &&
      referee.gap(S(toi.time - S(*claims.late_by))) < -referee.noise())
    return AssertionFailure() << "late by more than the tolerance";
  return ::testing::AssertionSuccess();
}

}  // namespace thinwall::testing

// ---- Every method of the list on the same random motions, held to what it claims.

namespace thinwall::testing {

/// One motion of a pair, a third of them with a gap that counts as contact.
template <class A, class B> void every_method_keeps_its_claims() {
  using S = typename A::Scalar;
  const int seed = draw_integer(0, 1 << 30);
  Shaker<S> draw(static_cast<unsigned>(seed));
  const Motion<A, B> motion = drawn_motion<A, B>(draw);
  const S gap = draw.pick(0, 2) == 0 ? draw.sizes()[0] * power<S>(-draw.pick(0, 10)) : S(0);
  const Referee<A, B> referee(motion.a, motion.b, gap);
  for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) {
      Method method;
      method.min_separation = gap;
      const Toi<S> toi = time_of_impact(method, motion.a, motion.b);
      const auto judgment = judge_claims(claims_of(method), referee, toi);
      if (judgment) return;
      std::ostringstream out;
      out << Method::name << " on seed " << seed << ", min_separation " << gap << ": " << judgment.message();
      RC_FAIL(out.str());
    }
  });
}

/// `runs` motions of every pair of shapes that is served.
template <class S> void check_every_pair(int runs) {
  for_each_type(Shapes<S>{}, [&]<class A>(TypeTag<A>) {
    for_each_type(Shapes<S>{}, [&]<class B>(TypeTag<B>) {
      if constexpr (ServedPair<A, B> && A::rank >= B::rank) {
        SCOPED_TRACE(std::to_string(A::rank) + " and " + std::to_string(B::rank));
        check_property(runs, every_method_keeps_its_claims<A, B>);
      }
    });
  });
}

}  // namespace thinwall::testing
