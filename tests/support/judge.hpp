#pragma once
/// Judges a computed time of impact against the oracle, to the accuracy contract: forward error at most 4 u kappa t,
/// backward error at most 4 u, and no wrong verdict where the inputs decide.

#include <thinwall/swept/time_of_impact.hpp>

#include "support/bodies.hpp"
#include "support/errors.hpp"
#include "support/judge_vectors.hpp"
#include "support/scalars.hpp"

namespace thinwall::testing {

using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;

/// What a test allows, in units of the rounding error of its scalar.
struct Allowance {
  int forward = 4;   ///< [u kappa t]
  int backward = 4;  ///< [u]
  int verdict = 0;   ///< [u] a wrong verdict is forgiven if the inputs are this near to making it right
};

inline ToiStatus status_of(oracle::Verdict verdict) {
  switch (verdict) {
    case oracle::Verdict::apart: return ToiStatus::apart;
    case oracle::Verdict::hit: return ToiStatus::hit;
    default: return ToiStatus::overlapping;
  }
}

inline const char* text(ToiStatus status) {
  constexpr const char* names[] = {"apart", "hit", "overlapping", "gave_up", "invalid"};
  return names[static_cast<int>(status)];
}

inline oracle::Body at_time(oracle::Body body, const oracle::Real& time) {
  body.center = body.center + time * body.displacement;
  body.displacement = {};
  return body;
}

/// Is a hit's normal the contact normal at its own time, and its point on both surfaces, within rounding?
template <class S> AssertionResult judge_contact(const oracle::Pair& pair, const Toi<S>& toi) {
  using namespace oracle;
  if (!is_unit(toi.normal)) return AssertionFailure() << "normal is not unit: " << toi.normal.transpose();
  const Real time = lift(toi.time), rounding = unit_roundoff<S>() * size_at(pair, time);
  const Gap there = gap(pair, time);
  const Real reach = pair.reach();
  const Real turned = length(lift_vector(toi.normal) - there.normal);
  if (reach > 0 && there.core > 0 && turned * there.core > 16 * rounding)
    return AssertionFailure() << "normal is off by " << turned * there.core / rounding << " roundings";
  const Vector point = lift_vector(toi.point);
  for (const Body& body : {pair.a, pair.b}) {
    const Real off = off_surface(point, at_time(body, time));
    if (!(off <= 16 * rounding + pair.min_separation))
      return AssertionFailure() << "point is off the surface by " << off / rounding << " roundings";
  }
  return AssertionSuccess();
}

/// True if the other verdict is within `allowed` u of the inputs.
template <class S> bool is_close_call(const oracle::Impact& truth, ToiStatus status, int allowed) {
  const bool about_start = status == ToiStatus::overlapping || truth.verdict == oracle::Verdict::overlapping;
  const oracle::Real margin = about_start ? truth.start_margin : truth.margin;
  return abs(margin) <= allowed * oracle::unit_roundoff<S>();
}

template <class S> AssertionResult judge(const oracle::Pair& pair, const Toi<S>& toi, const Allowance& allow = {}) {
  const Vec3<S> zero = Vec3<S>::Zero();
  const oracle::Impact truth = oracle::impact(pair);

  if (toi.status != status_of(truth.verdict) && !is_close_call<S>(truth, toi.status, allow.verdict))
    return AssertionFailure() << text(toi.status) << " but is " << text(status_of(truth.verdict)) << " by a margin of "
                              << truth.margin / oracle::unit_roundoff<S>() << " u at " << truth.time;
  switch (toi.status) {
    case ToiStatus::apart:
      if (toi.time != S(1) || toi.normal != zero || toi.point != zero)
        return AssertionFailure() << "apart, yet with data";
      return AssertionSuccess();
    case ToiStatus::overlapping:
      if (toi.time != S(0)) return AssertionFailure() << "overlapping at time " << toi.time;
      if (!is_unit(toi.normal)) return AssertionFailure() << "normal is not unit: " << toi.normal.transpose();
      return AssertionSuccess();
    case ToiStatus::hit: break;
    default: return AssertionFailure() << "gave up or called it invalid";
  }
  if (!(toi.time >= S(0) && toi.time <= S(1))) return AssertionFailure() << "time out of range: " << toi.time;
  const oracle::Real backward = oracle::backward_error_in_u(pair, toi.time);
  if (!(backward <= allow.backward)) return AssertionFailure() << "backward error " << backward << " u";
  if (truth.verdict == oracle::Verdict::hit) {
    const oracle::Real forward = oracle::forward_error_in_u_kappa(truth, toi.time);
    if (!(forward <= allow.forward)) return AssertionFailure() << "forward error " << forward << " u kappa t";
  }
  return judge_contact(pair, toi);
}

}  // namespace thinwall::testing
