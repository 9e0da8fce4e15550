#pragma once
/// The library's shapes as the oracle sees them, and its answers held to the oracle's.

#include <cmath>
#include <string_view>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/oracle.hpp"

// ---- Inputs, lifted without rounding.

namespace thinwall::oracle {

template <class S> Body body(const Sphere<S>& s) { return {lift_vector(s.center), {}, lift(s.radius)}; }
template <class S> Body body(const Aabb<S>& box) { return {lift_vector(box.center), {lift_vector(box.half_extents)}}; }
template <class S> Body body(const Capsule<S>& c) {
  const Vector first = lift_vector(c.a), second = lift_vector(c.b);
  return {Real(0.5) * (first + second), {{}, {Real(0.5) * (second - first)}}, lift(c.radius)};
}

template <class Shape> Body body(const Moving<Shape>& moving) {
  Body b = body(moving.shape);
  b.displacement = lift_vector(moving.displacement);
  return b;
}

template <class A, class B> Pair pair(const A& a, const B& b) { return {body(a), body(b), 0}; }

}  // namespace thinwall::oracle

namespace thinwall::testing {

/// True if two bodies are equal but for a factor 2^exponent and an offset: nothing was rounded on the way.
inline bool same_body(const oracle::Body& to, const oracle::Body& from, int exponent, const oracle::Vector& by = {}) {
  const auto grown = [&](const oracle::Vector& v) { return oracle::Real(ldexp(oracle::Real(1), exponent)) * v; };
  if (to.center != grown(from.center) + by || to.displacement != grown(from.displacement)) return false;
  if (to.radius != ldexp(from.radius, exponent) || to.core.box != grown(from.core.box)) return false;
  for (std::size_t i = 0; i < from.core.generators.size(); ++i)
    if (to.core.generators[i] != grown(from.core.generators[i])) return false;
  return true;
}

// ---- Are computed vectors unit, and computed points on the surfaces they should be on?

template <class Vector> bool is_unit(const Vector& v) {
  const oracle::Real error = oracle::length(oracle::lift_vector(v)) - 1;  // NaN compares false
  return abs(error) <= 4 * oracle::unit_roundoff<typename Vector::Scalar>();
}

/// The size of all numbers involved, in any direction: bounds the rounding of a point in space.
inline oracle::Real size_at(const oracle::Pair& pair, const oracle::Real& time) {
  return oracle::scale(pair, time, {1, 1, 1});
}

/// How far a point is from the surface of a body.
inline oracle::Real off_surface(const oracle::Vector& point, const oracle::Body& body) {
  return abs(oracle::gap({body, {point}, 0}, 0).separation);
}

// ---- Judges a computed time of impact against the oracle, to the accuracy contract: forward error at most 4 u kappa t,
// backward error at most 4 u, and no wrong verdict where the inputs decide.

using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;

/// What a test allows, in units of the rounding error of its scalar.
struct Allowance {
  int forward = 4;   ///< [u kappa t]
  int backward = 4;  ///< [u]
  int verdict = 0;   ///< [u] a wrong verdict is forgiven if the inputs are this near to making it right
};

constexpr ToiStatus status_of(oracle::Verdict verdict) { return static_cast<ToiStatus>(verdict); }
constexpr oracle::Verdict verdict_of(ToiStatus status) { return static_cast<oracle::Verdict>(status); }
static_assert(status_of(oracle::Verdict::apart) == ToiStatus::apart &&
              status_of(oracle::Verdict::hit) == ToiStatus::hit &&
              status_of(oracle::Verdict::overlapping) == ToiStatus::overlapping);

inline std::string_view text(ToiStatus status) {
  constexpr const char* names[] = {"apart", "hit", "overlapping", "gave_up", "invalid"};
  return names[static_cast<int>(status)];
}

/// The same bits in all that an answer says.
template <class S> AssertionResult same_answer(const Toi<S>& found, const Toi<S>& expected) {
  if (found.status == expected.status && found.time == expected.time && found.normal == expected.normal &&
      found.point == expected.point)
    return AssertionSuccess();
  AssertionResult failure = AssertionFailure();
  for (const Toi<S>* toi : {&found, &expected}) {
    failure << (toi == &found ? "found " : ", expected ") << text(toi->status) << " at " << toi->time << " along "
            << toi->normal.transpose() << " at " << toi->point.transpose();
  }
  return failure;
}

inline oracle::Body at_time(oracle::Body body, const oracle::Real& time) {
  body.center = body.center + time * body.displacement;
  body.displacement = {};
  return body;
}

/// How far along the path two right answers may lie apart: by the conditioning of the time, and near a graze no more
/// than a surface takes to curve away by a few roundings.
inline oracle::Real slide(const oracle::Pair& pair, const oracle::Impact& truth, const oracle::Real& rounding) {
  const oracle::Real graze = sqrt(64 * rounding * pair.reach());
  if (truth.conditioning == 0) return graze;
  const oracle::Real path = oracle::length(pair.relative_displacement());
  const oracle::Real shift = 8 * truth.conditioning * path * rounding / size_at(pair, truth.time);
  return shift < graze ? shift : graze;
}

/// Is a hit's normal the contact normal at its own time, and its point on both surfaces, within rounding?
template <class S>
AssertionResult judge_contact(const oracle::Pair& pair, const oracle::Impact& truth, const Toi<S>& toi) {
  using namespace oracle;
  if (!is_unit(toi.normal)) return AssertionFailure() << "normal is not unit: " << toi.normal.transpose();
  const Real time = lift(toi.time), rounding = unit_roundoff<S>() * size_at(pair, time);
  const Real allowed = 16 * rounding + slide(pair, truth, rounding);
  const Gap there = gap(pair, time);
  const Real turned = length(lift_vector(toi.normal) - there.normal);
  if (there.core > 0 && turned * there.core > allowed)
    return AssertionFailure() << "normal is off by " << turned * there.core / rounding << " roundings";
  const Vector point = lift_vector(toi.point);
  for (const Body& body : {pair.a, pair.b}) {
    const Real off = off_surface(point, at_time(body, time));
    if (!(off <= allowed + pair.min_separation))
      return AssertionFailure() << "point is off the surface by " << off / rounding << " roundings";
  }
  return AssertionSuccess();
}

template <class S> AssertionResult judge(const oracle::Pair& pair, const Toi<S>& toi, const Allowance& allow = {}) {
  const Vec3<S> zero = Vec3<S>::Zero();
  const oracle::Impact truth = oracle::impact(pair);

  const oracle::Real change = allow.verdict * oracle::unit_roundoff<S>();
  const bool answered = toi.status != ToiStatus::gave_up && toi.status != ToiStatus::invalid;
  if (!answered || !oracle::verdict_is_near(pair, truth, verdict_of(toi.status), change))
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
    default: break;
  }
  if (!(toi.time >= S(0) && toi.time <= S(1))) return AssertionFailure() << "time out of range: " << toi.time;
  const oracle::Real backward = oracle::backward_error_in_u(pair, toi.time);
  if (!(backward <= allow.backward)) return AssertionFailure() << "backward error " << backward << " u";
  if (truth.verdict == oracle::Verdict::hit) {
    const oracle::Real forward = oracle::forward_error_in_u_kappa(truth, toi.time);
    if (!(forward <= allow.forward)) return AssertionFailure() << "forward error " << forward << " u kappa t";
  }
  return judge_contact(pair, truth, toi);
}

}  // namespace thinwall::testing
