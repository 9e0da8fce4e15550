#pragma once
/// Two spheres by interval arithmetic, the way to bound roundings without deriving a bound: the perpendicular quadratic of
/// discrete/entry/ball_entry.hpp on Boost.Interval, which switches the processor's rounding mode: at every operation, or,
/// unprotected, once for many.

#include <boost/numeric/interval.hpp>
#include <thinwall/swept/certified/certified_toi.hpp>

#include "query_sets.hpp"

namespace thinwall::bench {

using Interval = boost::numeric::interval<double>;
using UnprotectedInterval = boost::numeric::interval_lib::unprotect<Interval>::type;

/// The verdict and a bracket of the time; `gave_up` where the intervals do not decide.
template <class I> CertifiedToi interval_ball(const Moving<Sphere<double>>& a, const Moving<Sphere<double>>& b) {
  std::array<I, 3> p, v;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    p[k] = I(a.shape.center[i]) - I(b.shape.center[i]);
    v[k] = I(a.displacement[i]) - I(b.displacement[i]);
  }
  const I R = I(a.shape.radius) + I(b.shape.radius), RR = square(R);
  const auto decided = [](ToiStatus verdict, double lower, double upper) {
    return CertifiedToi{verdict, lower, upper, DecidedBy::filter};
  };
  const CertifiedToi undecided = decided(ToiStatus::gave_up, 0, 1);

  const I c = square(p[0]) + square(p[1]) + square(p[2]) - RR;
  if (c.upper() <= 0) return decided(ToiStatus::overlapping, 0, 0);
  if (!(c.lower() > 0)) return undecided;
  const I approach = -(p[0] * v[0] + p[1] * v[1] + p[2] * v[2]);
  if (approach.upper() <= 0) return decided(ToiStatus::apart, 1, 1);
  const I q0 = p[1] * v[2] - p[2] * v[1], q1 = p[2] * v[0] - p[0] * v[2], q2 = p[0] * v[1] - p[1] * v[0];
  const I D = (square(v[0]) + square(v[1]) + square(v[2])) * RR - (square(q0) + square(q1) + square(q2));
  if (D.upper() < 0) return decided(ToiStatus::apart, 1, 1);
  if (!(D.lower() > 0 && approach.lower() > 0)) return undecided;
  const I time = c / (approach + sqrt(D));
  if (time.lower() > 1) return decided(ToiStatus::apart, 1, 1);
  return time.upper() <= 1 ? decided(ToiStatus::hit, time.lower(), time.upper()) : undecided;
}

}  // namespace thinwall::bench
