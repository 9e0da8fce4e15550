#pragma once
/// The answer of every way to find a time of impact.

#include <limits>

#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

enum class ToiStatus {
  apart,        ///< no contact during the step; time 1, vectors zero
  hit,          ///< first contact at `time`
  overlapping,  ///< in contact at the start already, touching included, whatever the motion; time 0
  gave_up,      ///< out of budget; `time` is the largest time proven free
  invalid,      ///< a shape is not valid(), a displacement not finite, or an option of the method impossible; time NaN
};

template <Scalar S> struct Toi {
  ToiStatus status = ToiStatus::apart;
  int evaluations = 0;               ///< of the pair's separation, overlap or closed form: the machine-independent cost
  S time = 1;                        ///< [1] fraction of the step in [0, 1]; seconds = time * dt
  Vec3<S> normal = Vec3<S>::Zero();  ///< unit, from A to B
  Vec3<S> point = Vec3<S>::Zero();   ///< [length] where they touch, in world space
};

/// The answer to what is no question.
template <Scalar S> Toi<S> invalid_toi() { return {ToiStatus::invalid, 0, std::numeric_limits<S>::quiet_NaN()}; }

/// The same answer with A and B passed the other way round.
template <Scalar S> Toi<S> flipped(const Toi<S>& toi) {
  return {toi.status, toi.evaluations, toi.time, Vec3<S>::Zero() - toi.normal, toi.point};
}

/// The same answer in another scalar, rounded.
template <Scalar T, Scalar S> Toi<T> cast(const Toi<S>& toi) {
  return {toi.status, toi.evaluations, static_cast<T>(toi.time), toi.normal.template cast<T>(),
          toi.point.template cast<T>()};
}

}  // namespace thinwall
