#pragma once
/// The arc of a bullet fired level, with a drag that grows as the speed: dv/dt = -k (v - wind) + gravity. A constant
/// wind acts as a constant pull k * wind, so gravity and wind add up to one pull `a`, and the arc lies in one plane:
///
///   tau = (1 - exp(-k t)) / k,   x = v tau,   s = a (t - tau) / k.
///
/// Derived in docs/hitscan.md.

#include <cmath>
#include <cstdint>
#include <limits>

#include <boost/math/special_functions/log1p.hpp>
#include <boost/math/tools/toms748_solve.hpp>

namespace thinwall {

template <class Real> struct Arc {
  Real speed;  ///< [m/s] > 0, at the muzzle
  Real drag;   ///< [1/s] >= 0
  Real pull;   ///< [m/s^2] >= 0, across the line of fire
};

/// [s] tau: the time in which a bullet without drag would get as far. t >= 0.
template <class Real> Real undragged_time(const Real& drag, const Real& t) {
  using std::expm1;
  const Real kt = drag * t;
  return kt < std::numeric_limits<Real>::epsilon() ? t : Real(-expm1(-kt) / drag);
}

/// [s] The other way round. 0 <= drag * tau < 1.
template <class Real> Real dragged_time(const Real& drag, const Real& tau) {
  using std::log1p;
  const Real y = drag * tau;
  return y < std::numeric_limits<Real>::epsilon() ? tau : Real(-log1p(-y) / drag);
}

/// [s^2] (t - tau) / k as a function of tau: the deflection of a pull of 1. With y = k tau it is (-log(1 - y) - y) /
/// k^2, a sum of positive terms tau^2 (1/2 + y/3 + ...), so that it loses no digits where the subtraction would.
/// Error: a few units of round-off for 0 <= y <= 0.99.
template <class Real> Real pull_factor(const Real& drag, const Real& tau) {
  using std::log1p;
  const Real y = drag * tau;
  if (y < std::numeric_limits<Real>::epsilon()) return tau * tau / 2;
  if (y < Real(1) / 2) return -boost::math::log1pmx(Real(-y)) / (drag * drag);
  return (-log1p(-y) - y) / (drag * drag);
}

/// Where the bullet is, and how it moves, after a time or at a distance: along the line of fire, and across, along the
/// pull.
template <class Real> struct ArcPoint {
  Real x, s;    ///< [m]
  Real vx, vs;  ///< [m/s]
};

template <class Real> ArcPoint<Real> after_undragged(const Arc<Real>& arc, const Real& tau) {
  return {arc.speed * tau, arc.pull * pull_factor(arc.drag, tau), arc.speed * (1 - arc.drag * tau), arc.pull * tau};
}
template <class Real> ArcPoint<Real> after(const Arc<Real>& arc, const Real& t) {
  return after_undragged(arc, undragged_time(arc.drag, t));
}
/// Requires drag * x < speed.
template <class Real> ArcPoint<Real> at_distance(const Arc<Real>& arc, const Real& x) {
  return after_undragged(arc, Real(x / arc.speed));
}
/// [s] From the muzzle to distance x >= 0. Requires drag * x < speed.
template <class Real> Real time_to(const Arc<Real>& arc, const Real& x) {
  return dragged_time(arc.drag, Real(x / arc.speed));
}

/// Where a function that is negative at the one end and positive at the other is zero, to so many binary digits.
template <class Real, class Function>
Real root(const Function& f, const Real& lower, const Real& upper,
          unsigned digits = std::numeric_limits<Real>::digits - 2) {
  const boost::math::tools::eps_tolerance<Real> tolerance(digits);
  std::uintmax_t most = 200;
  const auto bracket = boost::math::tools::toms748_solve(f, lower, upper, tolerance, most);
  return bracket.first + (bracket.second - bracket.first) / 2;
}

}  // namespace thinwall
