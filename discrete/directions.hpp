#pragma once
/// When two directions count as one: to half the digits for faces and edges that should share a manifold, to rounding
/// for everything that must be exact.

#include <thinwall/discrete/numbers/range.hpp>
#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// The sine up to which directions count as parallel: half the digits of S. A turn this small moves nothing along the
/// direction it turns: its cosine rounds to one.
template <Scalar S> S parallel_sine() { return power_of_two<S>(-(std::numeric_limits<S>::digits / 2)); }

/// True if the unit vectors are parallel, or opposite.
template <Scalar S> bool nearly_parallel(const Vec3<S>& a, const Vec3<S>& b) {
  return largest(cross(a, b)) <= parallel_sine<S>();
}
/// True if the unit vectors are at right angles.
template <Scalar S> bool nearly_perpendicular(const Vec3<S>& a, const Vec3<S>& b) {
  return largest(S(a.dot(b))) <= parallel_sine<S>();
}
/// The coordinate axis the unit vector is parallel to, up to this sine; -1 if there is none.
template <Scalar S> int axis_along(const Vec3<S>& unit, const S& sine) {
  for (int i = 0; i < 3; ++i) {
    if (largest(unit[(i + 1) % 3], unit[(i + 2) % 3]) <= sine) return i;
  }
  return -1;
}

}  // namespace thinwall
