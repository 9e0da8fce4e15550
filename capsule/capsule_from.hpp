#pragma once
/// A capsule by its height, as a body is measured.

#include <thinwall/capsule/capsule.hpp>

namespace thinwall {

/// The capsule around `center` that stands along `axis`, of any length but zero. `height` is measured end to end, so
/// the core is height - 2 radius long; `height` and `radius` are lengths. A height of less than two radii, a negative
/// radius, an axis without length, a NaN and an infinity make no capsule: the answer is then all NaN, which valid()
/// refuses, no query takes for contact, and time_of_impact calls `invalid`.
template <Scalar S>
Capsule<S> capsule_from(const Vec3<S>& center, const Vec3<S>& axis, const S& height, const S& radius) {
  const S half_core = height / 2 - radius;
  const bool possible = is_finite(center) && is_finite(axis) && is_finite(height) && radius >= S(0) &&
                        half_core >= S(0) && axis != Vec3<S>::Zero();
  if (!possible) return {nan_vector<S>(), nan_vector<S>(), nan_vector<S>()[0]};
  const Vec3<S> half = safe_unit(axis) * half_core;
  return {center - half, center + half, radius};
}

}  // namespace thinwall
