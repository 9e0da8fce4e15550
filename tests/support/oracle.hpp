#pragma once
/// The oracle: when do two translating bodies first touch? Independent of the library in method and precision.
///
/// The separation is convex along a translation. So it is minimized first: a positive minimum is a miss. Otherwise
/// the first contact lies before the minimizer and is bracketed there. (A bullet that crosses a wall shows no change
/// of sign between its end poses; the minimizer finds the wall.) Where the minimum is too near zero for 100 digits,
/// rational arithmetic decides.

#include "support/exact_verdict.hpp"
#include "support/pair.hpp"

namespace thinwall::oracle {

enum class Verdict { apart, hit, overlapping };

struct Impact {
  Verdict verdict = Verdict::apart;
  Real margin = 0;        ///< [1] least separation over scale(); 0 is an exact touch
  Real start_margin = 0;  ///< [1] the same at time 0
  Real time = 1;          ///< [1] of first contact; apart: of closest approach
  Vector normal{};        ///< unit, from A to B, at that time
  Real conditioning = 0;  ///< [1] kappa * time: a relative change u of the inputs moves the time by u times this
};

/// Halves [low, high] until it is narrow, keeping the step of a monotone predicate inside. `guess` names where the
/// step may be; a good guess saves rounds, a bad one costs them, and neither changes the answer.
template <class Reached, class Guess> void bracket(Real& low, Real& high, const Reached& reached, const Guess& guess) {
  const auto probe = [&](const Real& time) {
    if (time <= low || time >= high) return;
    (reached(time) ? high : low) = time;
  };
  for (int round = 0; round < 20000 && high - low > ldexp(high, -290); ++round) {
    const Real center = guess(low, high);
    const Real near = ldexp(high - low, -20);
    probe(center - near);
    probe(center + near);
    probe((low + high) / 2);
  }
}

/// Half the derivative of the squared core distance; zero where the cores meet. Piecewise linear in time.
inline Real approach_slope(const Pair& pair, const Zonotope& core, const Real& time) {
  const Vector offset = pair.offset(time);
  const Vector across = offset - nearest(core, offset);
  return length(across) <= noise(core, offset) ? Real(0) : dot(across, pair.relative_displacement());
}

/// The first time in [0, 1] at which the separation is least, from the sign of its derivative.
inline Real closest_approach(const Pair& pair) {
  const Zonotope core = pair.core();
  if (approach_slope(pair, core, 0) >= 0) return 0;
  if (approach_slope(pair, core, 1) < 0) return 1;
  Real low = 0, high = 1;
  bracket(
      low, high, [&](const Real& time) { return approach_slope(pair, core, time) >= 0; },
      [&](const Real& from, const Real& to) {
        const Real beside = ldexp(to - from, -60);  // the slope is linear there
        const Real start = approach_slope(pair, core, from), next = approach_slope(pair, core, from + beside);
        return Real(next == start ? to : from - start * beside / (next - start));
      });
  return high;
}

inline Real closing_speed(const Pair& pair, const Vector& normal) {
  return abs(dot(normal, pair.relative_displacement()));
}

/// The first contact before `closest`, a time at which the bodies touch.
inline Impact first_contact(const Pair& pair, const Real& closest, const Real& margin, const Real& start_margin) {
  Real low = 0, high = closest;
  bracket(
      low, high, [&](const Real& time) { return touching(pair, time); },
      [&](const Real& from, const Real& to) {
        const Gap start = gap(pair, from);
        const Real speed = closing_speed(pair, start.normal);
        return speed == 0 ? to : Real(from + start.separation / speed);
      });
  const Gap before = gap(pair, low);  // at contact itself, cores without a radius have no normal
  const Real speed = closing_speed(pair, before.normal);
  const Real conditioning = speed == 0 ? Real(0) : Real(scale(pair, high, before.normal) / speed);
  return {Verdict::hit, margin, start_margin, high, before.normal, conditioning};
}

/// The tri-state verdict, the time and how well conditioned both are.
inline Impact impact(const Pair& pair) {
  const auto margin_at = [&](const Real& time, const Gap& there) {
    const Real size = scale(pair, time, there.normal);
    return size == 0 ? Real(0) : Real(there.separation / size);  // two points that rest at the origin
  };
  const bool fractions = pair.core().generators.empty();
  const Real touch = ldexp(Real(1), fractions ? -200 : -260);  // a margin below is decided by fractions, or is a touch

  const Gap start = gap(pair, 0);
  Real start_margin = margin_at(0, start);
  Real closest = closest_approach(pair);
  Gap there = gap(pair, closest);
  Real margin = margin_at(closest, there);
  int start_sign = start_margin > touch ? 1 : start_margin < -touch ? -1 : 0;
  int sign = margin > touch ? 1 : margin < -touch ? -1 : 0;
  if (fractions && (start_sign == 0 || sign == 0)) {
    const ExactApproach exactly = exact_approach(pair);
    start_sign = exactly.start_sign;
    sign = exactly.sign;
    if (sign == 0) closest = Real(exactly.time);
    if (sign == 0) margin = 0;
    if (start_sign == 0) start_margin = 0;
  }
  if (start_sign <= 0) return {Verdict::overlapping, margin, start_margin, 0, start.normal, 0};
  if (sign > 0) return {Verdict::apart, margin, start_margin, closest, there.normal, 0};
  return first_contact(pair, closest, margin, start_margin);
}

}  // namespace thinwall::oracle
