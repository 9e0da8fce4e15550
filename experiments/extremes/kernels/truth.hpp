#pragma once
/// The truth about one query, at twice its own precision or more: the oracle's answer, and by how much an input would have to
/// change for another one.

#include <algorithm>
#include <cmath>
#include <optional>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include <thinwall/experiments/models/oracle.hpp>

namespace thinwall {

using Digits110 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<110>, boost::multiprecision::et_off>;

using Digits220 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<220>, boost::multiprecision::et_off>;

/// What judges a precision, and how finely it looks. A wall of 1e-16 of its width costs Wolfe's algorithm the square of that,
/// twice: 50 digits are too few.
template <class S> struct JudgeOf {
  using Real = Digits110;
  static constexpr int tolerance_bits = 140;
};
template <> struct JudgeOf<Digits50> {
  using Real = Digits220;
  static constexpr int tolerance_bits = 340;
};

/// The separation at one time, less than zero inside.
template <class R> struct Sounding {
  R gap = 0;      ///< [length]
  R closing = 0;  ///< [length] per step; > 0 while it falls
  R scale = 0;    ///< [length] what one round-off is measured by

  R margin() const { return scale > 0 ? R(gap / scale) : R(0); }  ///< [1] of it, the separation
};

/// Where the cores overlap: how far the nearest face of their Minkowski sum is. Nothing where it has no inside.
template <class R> std::optional<Sounding<R>> depth_at(const oracle::Problem<R>& problem, const R& time) {
  using std::abs;
  using std::sqrt;
  if (!problem.corners.empty()) return {};
  const oracle::Vec<R> at = oracle::combination(R(1), problem.offset, time, problem.motion);
  std::optional<Sounding<R>> nearest;
  for (std::size_t i = 0; i < problem.generators.size(); ++i) {
    for (std::size_t j = i + 1; j < problem.generators.size(); ++j) {
      const oracle::Vec<R>&g = problem.generators[i], &h = problem.generators[j];
      oracle::Vec<R> n{R(g[1] * h[2] - g[2] * h[1]), R(g[2] * h[0] - g[0] * h[2]), R(g[0] * h[1] - g[1] * h[0])};
      const R length = sqrt(oracle::dot(n, n));
      if (length == 0) continue;
      const R sign = oracle::dot(n, at) < 0 ? R(-1) : R(1);
      Sounding<R> face;
      for (std::size_t k = 0; k < 3; ++k) {
        n[k] *= sign / length;
        face.scale += abs(n[k]) * (problem.start_size[k] + time * problem.speed_size[k]);
      }
      R reach = 0;
      for (const oracle::Vec<R>& edge : problem.generators) reach += abs(oracle::dot(n, edge));
      face.gap = oracle::dot(n, at) - reach - problem.reach;
      face.closing = -oracle::dot(n, problem.motion);
      face.scale += problem.reach;
      if (!nearest || face.gap > nearest->gap) nearest = face;
    }
  }
  return nearest;
}

template <class R> Sounding<R> sound(const oracle::Problem<R>& problem, const R& time, const R& tolerance) {
  const oracle::Gap<R> gap = oracle::gap_at(problem, time, tolerance);
  if (gap.core <= tolerance * gap.scale) {
    if (const auto depth = depth_at(problem, time)) return *depth;
    return {R(-problem.reach), gap.closing, gap.scale};
  }
  return {R(gap.core - problem.reach), gap.closing, gap.scale};
}

/// The least separation of the step over its scale, to a thousandth of itself: < 0 where they touch. It is convex, and lies
/// above its tangents. `noise` [1] is what matters to nobody.
template <class R> R least_margin(const oracle::Problem<R>& problem, const R& tolerance, const R& noise) {
  struct Sample {
    R time;
    Sounding<R> there;
  };
  const auto sample = [&](const R& time) { return Sample{time, sound(problem, time, tolerance)}; };
  Sample before = sample(R(0)), after = sample(R(1));
  if (!(before.there.closing > 0)) return before.there.margin();
  if (after.there.closing > 0) return after.there.margin();
  const int rounds = 4 * std::numeric_limits<R>::digits;
  for (int k = 0; k < rounds; ++k) {
    const Sample& best = before.there.gap < after.there.gap ? before : after;
    const R width = after.time - before.time, opening = -after.there.closing;
    const R elapsed = ((before.there.gap - after.there.gap) + opening * width) / R(before.there.closing + opening);
    const R lowest = before.there.gap - before.there.closing * elapsed;
    const R size = best.there.gap < 0 ? R(-best.there.gap) : best.there.gap;
    if (best.there.gap - lowest <= size / 1024 || best.there.gap - lowest <= noise * best.there.scale) break;
    const R crossing = before.time + elapsed, middle = (before.time + after.time) / 2;
    const R next = k % 2 == 0 && crossing > before.time && crossing < after.time ? crossing : middle;
    if (!(next > before.time && next < after.time)) break;
    const Sample between = sample(next);
    (between.there.closing > 0 ? before : after) = between;
  }
  return (before.there.gap < after.there.gap ? before : after).there.margin();
}

/// Errors of one answer. Missing where there is nothing to measure.
struct AnswerErrors {
  bool wrong = false;                ///< hit, apart and overlapping confused
  double wrongness = 0;              ///< [u] how much the input would have to change to make a wrong verdict right
  std::optional<double> forward{};   ///< [u kappa t]
  std::optional<double> backward{};  ///< [u]
  std::optional<double> loss{};  ///< [u (d/R)^2 / 2] the error along the normal over R: the textbook's, for two balls
};

template <class A, class B> class Truth {
 public:
  using S = typename A::Scalar;
  using Real = typename JudgeOf<S>::Real;

  /// `guess` [1] may be any time before first contact, and saves rounds.
  Truth(const Moving<A>& a, const Moving<B>& b, const Real& guess)
      : problem_(oracle::pose<Real>(a, b)),
        rough_(oracle::pose<long double>(a, b)),
        impact_(oracle::first_contact(problem_, guess, tolerance())) {}

  oracle::Verdict verdict() const { return impact_.verdict; }

  AnswerErrors errors(const Toi<S>& toi) {
    using std::abs;
    const Real u = Real(std::numeric_limits<S>::epsilon()) / 2;
    AnswerErrors errors;
    errors.wrong = !agree(toi.status, impact_.verdict);
    if (errors.wrong) {
      errors.wrongness = static_cast<double>(abs(margin(toi.status == ToiStatus::overlapping, u)) / u);
      return errors;
    }
    if (toi.status != ToiStatus::hit) return errors;
    const Real late = abs(Real(Real(toi.time) - impact_.time));
    errors.forward = static_cast<double>(late / (u * impact_.conditioning));
    const Sounding<Real> there = sound(problem_, Real(toi.time), tolerance());
    // Either would make the answer right: a change of the gap at that time, or one along the path.
    errors.backward = std::min(*errors.forward, static_cast<double>(abs(there.gap) / (u * there.scale)));
    if (problem_.reach > 0) {
      const Sounding<Real> contact = sound(problem_, impact_.time, tolerance());
      const Real square = oracle::dot(problem_.offset, problem_.offset);
      errors.loss =
          static_cast<double>(Real(2 * late * contact.scale * problem_.reach / (impact_.conditioning * u * square)));
    }
    return errors;
  }

 private:
  static const Real& tolerance() {
    static const Real value = ldexp(Real(1), -JudgeOf<S>::tolerance_bits);
    return value;
  }

  /// [1] What decides between hit and apart, or at the start; in long double where that is far from close.
  const Real& margin(bool about_start, const Real& u) {
    if (about_start || impact_.verdict == oracle::Verdict::overlapping) {
      if (!at_start_) at_start_ = sound(problem_, Real(0), tolerance()).margin();
      return *at_start_;
    }
    if (!over_step_) {
      constexpr long double close = 0x1p-48L;
      const long double rough = least_margin<long double>(rough_, 0x1p-58L, 0x1p-58L);
      over_step_ = std::abs(rough) > close ? Real(rough) : least_margin<Real>(problem_, tolerance(), Real(u / 64));
    }
    return *over_step_;
  }

  oracle::Problem<Real> problem_;
  oracle::Problem<long double> rough_;
  oracle::Impact<Real> impact_;
  std::optional<Real> at_start_{}, over_step_{};
};

}  // namespace thinwall
