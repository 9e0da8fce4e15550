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

/// The separation at the computed time over u * [sum |n_i| (...)_i + R]: by how much the inputs would have to
/// change for the time to be exact.
template <class S> Real backward_error_in_u(const Pair& pair, const S& time) {
  const Gap there = gap(pair, lift(time));
  return abs(there.separation) / (unit_roundoff<S>() * scale(pair, lift(time), there.normal));
}

/// By how much the inputs would have to change for the other verdict to be right, in u.
template <class S> Real verdict_margin_in_u(const Impact& truth) { return abs(truth.margin) / unit_roundoff<S>(); }

/// The first time at which the separation is at most `allowance` in u * scale: how early a backward error that
/// small can put a graze. Inflates the reach, which bounds the scale at the true contact.
template <class S> Real earliest_time(Pair pair, const Impact& truth, int allowance) {
  pair.min_separation += allowance * unit_roundoff<S>() * scale(pair, truth.time, truth.normal);
  const Impact inflated = impact(pair);
  return inflated.verdict == Verdict::apart ? truth.time : inflated.time;
}

}  // namespace thinwall::oracle
