#pragma once
/// The truth about one query, at twice its own precision or more: the oracle's answer, and by how much an input would have to
/// change for another one.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include <thinwall/experiments/models/oracle.hpp>

namespace thinwall {

using Digits110 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<110>, boost::multiprecision::et_off>;

using Digits220 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<220>, boost::multiprecision::et_off>;

/// What judges a precision. A wall of 1e-16 of its width costs Wolfe's algorithm the square of that, twice: 50 digits are too few.
template <class S> using JudgeOf = std::conditional_t<std::is_same_v<S, Digits50>, Digits220, Digits110>;

/// [1] How finely it looks.
template <class S> const JudgeOf<S>& judge_tolerance() {
  static const JudgeOf<S> value = ldexp(JudgeOf<S>(1), std::is_same_v<S, Digits50> ? -340 : -140);
  return value;
}

/// A time before first contact to start the oracle at, if that is about where an answer has it: it saves rounds.
template <class Real, class S> Real guess_from(const Toi<S>& toi) {
  using std::ldexp;
  if (toi.status != ToiStatus::hit) return Real(0);
  return Real(toi.time) * (1 - ldexp(Real(1), -std::numeric_limits<S>::digits / 2));
}

/// The separation at one time, less than zero inside.
template <class R> struct Sounding {
  R time = 0;     ///< [1]
  R gap = 0;      ///< [length]
  R closing = 0;  ///< [length] per step; > 0 while it falls
  R scale = 0;    ///< [length] what one round-off is measured by

  R margin() const { return scale > 0 ? R(gap / scale) : R(0); }  ///< [1] of it, the separation
};

template <class R> Sounding<R> sound(const oracle::Problem<R>& problem, const R& time, const R& tolerance) {
  const oracle::Gap<R> gap = oracle::signed_gap_at(problem, time, tolerance);
  return {time, R(gap.core - problem.reach), gap.closing, gap.scale};
}

/// The least separation of the step over its scale, to a thousandth of itself: < 0 where they touch. It is convex, and lies
/// above its tangents. `noise` [1] is what matters to nobody. Where they are deepest between two faces, one before and one after, either parts
/// them: the one of which less of the input has to change.
template <class R> R least_margin(const oracle::Problem<R>& problem, const R& tolerance, const R& noise) {
  Sounding<R> before = sound(problem, R(0), tolerance), after = sound(problem, R(1), tolerance);
  if (!(before.closing > 0)) return before.margin();
  if (after.closing > 0) return after.margin();
  const int rounds = 4 * std::numeric_limits<R>::digits;
  for (int k = 0; k < rounds; ++k) {
    const Sounding<R>& best = before.gap < after.gap ? before : after;
    const R width = after.time - before.time, opening = -after.closing;
    const R elapsed = ((before.gap - after.gap) + opening * width) / R(before.closing + opening);
    const R lowest = before.gap - before.closing * elapsed;
    const R size = best.gap < 0 ? R(-best.gap) : best.gap;
    if (best.gap - lowest <= size / 1024 || best.gap - lowest <= noise * best.scale) break;
    const R crossing = before.time + elapsed, middle = (before.time + after.time) / 2;
    const R next = k % 2 == 0 && crossing > before.time && crossing < after.time ? crossing : middle;
    if (!(next > before.time && next < after.time)) break;
    const Sounding<R> between = sound(problem, next, tolerance);
    (between.closing > 0 ? before : after) = between;
  }
  const Sounding<R>& best = before.gap < after.gap ? before : after;
  const bool both = 2 * std::max(before.gap, after.gap) <= best.gap && best.gap < 0;
  return both ? R(best.gap / std::max(before.scale, after.scale)) : best.margin();
}

/// Errors of the time of a hit that is one.
struct TimeErrors {
  double forward = 0;   ///< [u kappa t]
  double backward = 0;  ///< [u]
  /// [u (d/R)^2 / 2] the error along the normal over R: the textbook's, for two balls; missing where no radius is.
  std::optional<double> loss{};
};

/// Errors of one answer.
struct AnswerErrors {
  bool wrong = false;    ///< hit, apart and overlapping confused
  double wrongness = 0;  ///< [u] how much the input would have to change to make a wrong verdict right
  std::optional<TimeErrors> time{};
};

template <class A, class B> class Truth {
 public:
  using S = typename A::Scalar;
  using Real = JudgeOf<S>;

  /// `near` is an answer that may be right: see `guess_from`.
  Truth(const Moving<A>& a, const Moving<B>& b, const Toi<S>& near)
      : problem_(oracle::pose<Real>(a, b)),
        rough_(oracle::pose<long double>(a, b)),
        impact_(oracle::first_contact(problem_, guess_from<Real>(near), judge_tolerance<S>())) {}

  oracle::Verdict verdict() const { return impact_.verdict; }

  AnswerErrors errors(const Toi<S>& toi) {
    using std::abs;
    const Real u = Real(std::numeric_limits<S>::epsilon()) / 2;
    if (toi.status != impact_.verdict) {
      const Real& input = margin(toi.status == ToiStatus::overlapping, u);
      return {.wrong = true, .wrongness = static_cast<double>(abs(input) / u)};
    }
    if (toi.status != ToiStatus::hit) return {};
    const Real late = abs(Real(Real(toi.time) - impact_.time));
    TimeErrors time = {.forward = static_cast<double>(late / (u * impact_.conditioning))};
    const Sounding<Real> there = sounding(Real(toi.time));
    // Either would make the answer right: a change of the gap at that time, or one along the path.
    time.backward = std::min(time.forward, static_cast<double>(abs(there.gap) / (u * there.scale)));
    if (problem_.reach > 0) {
      const Real square = oracle::dot(problem_.offset, problem_.offset), scale = sounding(impact_.time).scale;
      time.loss = static_cast<double>(Real(2 * late * scale * problem_.reach / (impact_.conditioning * u * square)));
    }
    return {.time = time};
  }

 private:
  Sounding<Real> sounding(const Real& at) const { return sound(problem_, at, judge_tolerance<S>()); }

  /// [1] What decides between hit and apart, or at the start; in long double where that is far from close.
  const Real& margin(bool about_start, const Real& u) {
    if (about_start || impact_.verdict == oracle::Verdict::overlapping) {
      if (!at_start_) at_start_ = sounding(Real(0)).margin();
      return *at_start_;
    }
    if (!over_step_) {
      constexpr long double close = 0x1p-48L;
      const long double rough = least_margin<long double>(rough_, 0x1p-58L, 0x1p-58L);
      over_step_ =
          std::abs(rough) > close ? Real(rough) : least_margin<Real>(problem_, judge_tolerance<S>(), Real(u / 64));
    }
    return *over_step_;
  }

  oracle::Problem<Real> problem_;
  oracle::Problem<long double> rough_;
  oracle::Impact<Real> impact_;
  std::optional<Real> at_start_{}, over_step_{};
};

}  // namespace thinwall
