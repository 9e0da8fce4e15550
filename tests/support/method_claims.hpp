#pragma once
/// What each method claims, as numbers that a test can hold it to. A method that is not named here claims nothing, and
/// still may not find contact at the start where there is none. The closed form is held to more than this by judge.hpp.

#include <optional>

#include <thinwall/swept/methods.hpp>

namespace thinwall::testing {

/// Every claim but the first is to rounding.
struct Claims {
  bool never_late = false;              ///< nothing touches before the answered time, and no contact is missed
  bool touches = false;                 ///< the shapes touch at the time of a hit
  bool never_misses = false;            ///< a miss is one
  bool sees_start = false;              ///< contact at the start is `overlapping`, at time 0
  std::optional<double> early_by = {};  ///< [1] the gap at the time of a hit is at most this share of the path
  std::optional<double> late_by = {};   ///< [1] the shapes did not touch so long before the time of a hit
};

template <class Method> Claims claims_of(const Method&) { return {}; }
template <Scalar S> Claims claims_of(const EndOfStep<S>&) { return {.touches = true}; }
template <Scalar S> Claims claims_of(const Substeps<S>&) { return {.touches = true}; }
template <Scalar S> Claims claims_of(const SweptVolumeRay<S>&) {
  return {.touches = true, .never_misses = true, .sees_start = true};
}
template <Scalar S> Claims claims_of(const SweepThenConfirm<S>&) { return {.touches = true, .sees_start = true}; }
template <Scalar S> Claims claims_of(const CentreRay<S>&) { return {.sees_start = true}; }
template <Scalar S> Claims claims_of(const Speculative<S>& method) {
  return {.never_late = method.margin >= S(1), .sees_start = true};
}
template <Scalar S> Claims claims_of(const ConservativeAdvancement<S>& method) {
  return {.never_late = true, .sees_start = true, .early_by = static_cast<double>(method.tolerance)};
}
template <Scalar S> Claims claims_of(const Bisection<S>& method) {
  return {.touches = true, .never_misses = true, .sees_start = true, .late_by = static_cast<double>(method.tolerance)};
}
template <Scalar S> Claims claims_of(const Inclusion<S>& method) {
  return {.never_late = true, .sees_start = true, .early_by = static_cast<double>(method.tolerance)};
}
template <Scalar S> Claims claims_of(const ClosedForm<S>&) {
  return {.touches = true, .never_misses = true, .sees_start = true, .late_by = 0};
}

}  // namespace thinwall::testing
