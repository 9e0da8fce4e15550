#pragma once
/// How wrong is a computed time of impact, in units of the rounding error of its scalar?

#include "support/oracle.hpp"

namespace thinwall::oracle {

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
