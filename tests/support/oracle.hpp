#pragma once
/// The oracle: when do two translating bodies first touch? Independent of the library in method and precision.
///
/// The separation is convex along a translation. So it is minimized first: a positive minimum is a miss. Otherwise
/// the first contact lies before the minimizer and is bracketed there. (A bullet that crosses a wall shows no change
/// of sign between its end poses; the minimizer finds the wall.) Where the minimum is too near zero for 100 digits,
/// rational arithmetic decides.

#include <algorithm>
#include <vector>

#include "support/pair.hpp"

namespace thinwall::oracle {

// ---- Hit or miss without rounding, for cores that are points or boxes along the axes: the squared distance of a moving point to a box is
// piecewise quadratic in time, with rational breakpoints and minima. The least of them against the squared reach decides, however near
// the two are.

/// Where two bodies come nearest first, and whether they touch there.
struct ExactApproach {
  Rational time = 0;   ///< [1] the first time of least distance, in [0, 1]
  int sign = 0;        ///< of the least separation: -1 overlap, 0 exact touch, +1 apart
  int start_sign = 0;  ///< the same at time 0
};

/// The motion of a point past a box about the origin.
struct ExactMotion {
  Triple<Rational> start, displacement, half;

  Rational coordinate(std::size_t i, const Rational& time) const { return start[i] + time * displacement[i]; }

  /// How far coordinate i is beyond the box; signed, zero within.
  Rational beyond(std::size_t i, const Rational& time) const {
    const Rational x = coordinate(i, time);
    if (x > half[i]) return x - half[i];
    if (x < -half[i]) return x + half[i];
    return 0;
  }
  Rational squared_distance(const Rational& time) const {
    Rational sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Rational excess = beyond(i, time);
      sum += excess * excess;
    }
    return sum;
  }
};

inline Triple<Rational> exact(const Vector& v) { return {exact(v[0]), exact(v[1]), exact(v[2])}; }

inline ExactMotion exact_motion(const Pair& pair) {
  return {exact(pair.b.center) - exact(pair.a.center), exact(pair.b.displacement) - exact(pair.a.displacement),
          exact(pair.a.core.box) + exact(pair.b.core.box)};
}

/// 0, 1, and the times between at which a coordinate passes a face of the box; sorted.
inline std::vector<Rational> breakpoints(const ExactMotion& motion) {
  std::vector<Rational> times{0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    if (motion.displacement[i] == 0) continue;
    for (const int side : {-1, 1}) {
      const Rational time = (side * motion.half[i] - motion.start[i]) / motion.displacement[i];
      if (time > 0 && time < 1) times.push_back(time);
    }
  }
  std::sort(times.begin(), times.end());
  return times;
}

/// Where the quadratic that holds between two breakpoints is least, clamped to them.
inline Rational least_between(const ExactMotion& motion, const Rational& from, const Rational& to) {
  const Rational middle = (from + to) / 2;
  Rational slope = 0, curvature = 0;  // of half the squared distance, at the middle
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational excess = motion.beyond(i, middle);
    if (excess == 0) continue;
    slope += excess * motion.displacement[i];
    curvature += motion.displacement[i] * motion.displacement[i];
  }
  if (curvature == 0) return from;
  const Rational vertex = middle - slope / curvature;
  return std::clamp(vertex, from, to);
}

inline ExactApproach exact_approach(const Pair& pair) {
  const ExactMotion motion = exact_motion(pair);
  const Rational reach = exact(pair.a.radius) + exact(pair.b.radius) + exact(pair.min_separation);
  const Rational square = reach * reach;
  const std::vector<Rational> times = breakpoints(motion);

  Rational best_time = 0, best = motion.squared_distance(0);
  const int start_sign = best.compare(square);
  const auto consider = [&](const Rational& time) {
    const Rational distance = motion.squared_distance(time);
    if (distance >= best) return;
    best = distance;
    best_time = time;
  };
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    consider(least_between(motion, times[i], times[i + 1]));
    consider(times[i + 1]);
  }
  return {best_time, best.compare(square), start_sign};
}

// ---- At 100 digits.

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

// ---- How wrong is a computed time of impact, in units of the rounding error of its scalar?

/// |time - true time| over u * kappa * true time. kappa: how far a relative change of the inputs moves the time,
///   kappa = [sum |n_i| (|cA| + |cB| + h + t (|vA| + |vB|))_i + R] / (t |n.v|).
/// A graze (n.v = 0) has no finite kappa: there the backward error is the measure, and this is zero.
template <class S> Real forward_error_in_u_kappa(const Impact& truth, const S& time) {
  if (truth.conditioning == 0) return 0;
  return abs(lift(time) - truth.time) / (unit_roundoff<S>() * truth.conditioning);
}

/// True if a relative change of the inputs by at most `change`, each coordinate by itself, makes the bodies touch
/// without overlap at `time`.
inline bool touch_is_near(const Pair& pair, const Real& time, const Real& change) {
  const Vector offset = pair.offset(time);
  const Vector play = change * sizes(pair, time);
  Zonotope wider = pair.core();
  wider.box = wider.box + play;
  if (length(offset - nearest(wider, offset)) > pair.reach() * (1 + change)) return false;  // still apart
  for (unsigned corner = 0; corner < 8; ++corner) {  // the distance is convex: it is largest at a corner
    Vector moved = offset;
    for (std::size_t i = 0; i < 3; ++i) moved[i] += (corner >> i & 1U) != 0 ? play[i] : -play[i];
    const Real distance = length(moved - nearest(pair.core(), moved));
    if (distance > 0 && distance >= pair.reach() * (1 - change)) return true;
  }
  return false;
}

/// By how much the inputs would have to change, in u, for `time` to be the exact time of contact.
/// To first order it is the separation at that time over [sum |n_i| (...)_i + R]. Where that is more than one u, the
/// change is found by bisection: a step many radii long turns the normal within one rounding of the time.
template <class S> Real backward_error_in_u(const Pair& pair, const S& time) {
  const Gap there = gap(pair, lift(time));
  if (there.separation == 0) return 0;
  const Real u = unit_roundoff<S>();
  const Real first_order = abs(there.separation) / (u * scale(pair, lift(time), there.normal));
  if (first_order <= 1) return first_order;
  Real low = 0, high = 1;
  while (!touch_is_near(pair, lift(time), high * u) && high < 1 / u) high *= 2;
  for (int i = 0; i < 12; ++i) {
    const Real middle = (low + high) / 2;
    (touch_is_near(pair, lift(time), middle * u) ? high : low) = middle;
  }
  return high;
}

/// True if a relative change of the inputs by at most `change`, each coordinate by itself, makes the bodies touch: the
/// cores grow by all that the inputs may give.
inline bool touch_is_possible(Pair pair, const Impact& truth, const Real& change, bool at_start) {
  const Vector play = change * sizes(pair, at_start ? Real(0) : truth.time);
  pair.a.core.box = pair.a.core.box + play;
  pair.min_separation += change * pair.reach();
  return at_start ? touching(pair, 0) : impact(pair).verdict != Verdict::apart;
}

/// True if such a change makes `verdict` right, which is not the one where they touch sooner. Tries the corners of the
/// box of inputs: what lies beyond a touch stays so farther out.
inline bool miss_is_possible(const Pair& pair, Verdict verdict, const Real& change) {
  const Vector place = change * sizes(pair, 0);
  const Vector path = change * (magnitude(pair.a.displacement) + magnitude(pair.b.displacement));
  for (unsigned corner = 0; corner < 64; ++corner) {
    const auto sign = [&](std::size_t bit) { return (corner >> bit & 1U) != 0 ? 1 : -1; };
    Pair changed = pair;
    changed.min_separation -= change * pair.reach();
    for (std::size_t i = 0; i < 3; ++i) {
      changed.b.center[i] += sign(i) * place[i];
      changed.b.displacement[i] += sign(i + 3) * path[i];
    }
    if (impact(changed).verdict == verdict) return true;
  }
  return false;
}

/// True if `verdict` is right but for a relative change of the inputs by at most `change`.
inline bool verdict_is_near(const Pair& pair, const Impact& truth, Verdict verdict, const Real& change) {
  if (verdict == truth.verdict) return true;
  if (change == 0) return false;
  if (verdict == Verdict::overlapping) return touch_is_possible(pair, truth, change, true);
  if (truth.verdict == Verdict::apart) return touch_is_possible(pair, truth, change, false);
  return miss_is_possible(pair, verdict, change);
}

/// The first time at which the separation is at most `allowance` in u * scale: how early a backward error that
/// small can put a graze. Inflates the reach, which bounds the scale at the true contact.
template <class S> Real earliest_time(Pair pair, const Impact& truth, int allowance) {
  pair.min_separation += allowance * unit_roundoff<S>() * scale(pair, truth.time, truth.normal);
  const Impact inflated = impact(pair);
  return inflated.verdict == Verdict::apart ? truth.time : inflated.time;
}

}  // namespace thinwall::oracle
