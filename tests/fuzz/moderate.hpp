#pragma once
/// Are the numbers of a scene of like enough size for 50 digits to judge it, or for no product of them to leave the range?

#include <cstdlib>

#include "fuzz/scene.hpp"

namespace thinwall::fuzz {

/// The exponents of all numbers but zeros lie within `most` of 0.
template <class M> bool is_within_decades(const M& values, int most) {
  for (int i = 0; i < values.size(); ++i) {
    const auto x = values.data()[i];
    if (x != 0 && std::abs(binary_exponent(x)) > most) return false;
  }
  return true;
}
template <Scalar S> bool is_moderate(const Sphere<S>& s, int most) {
  return is_within_decades(s.center, most) && is_within_decades(Vec3<S>(Vec3<S>::Constant(s.radius)), most);
}
template <Scalar S> bool is_moderate(const Aabb<S>& b, int most) {
  return is_within_decades(b.center, most) && is_within_decades(b.half_extents, most);
}
template <Scalar S> bool is_moderate(const Obb<S>& b, int most) {
  return is_within_decades(b.center, most) && is_within_decades(b.half_extents, most) &&
         is_within_decades(b.axes, most);
}
template <Scalar S> bool is_moderate(const Triangle<S>& t, int most) {
  return is_within_decades(t.a, most) && is_within_decades(t.b, most) && is_within_decades(t.c, most);
}
template <Scalar S> bool is_moderate(const Capsule<S>& c, int most) {
  return is_within_decades(c.a, most) && is_within_decades(c.b, most) &&
         is_within_decades(Vec3<S>(Vec3<S>::Constant(c.radius)), most);
}

template <class A, class B> bool is_moderate(const Scene<A, B>& scene, int most) {
  return is_moderate(scene.a.shape, most) && is_moderate(scene.b.shape, most) &&
         is_within_decades(scene.a.displacement, most) && is_within_decades(scene.b.displacement, most);
}

/// The oracle at 50 digits, 168 bits, adds up squares: numbers 2^60 apart leave it the digits it needs.
template <class A, class B> bool is_judged(const Scene<A, B>& scene) {
  return scene.is_valid() && is_moderate(scene, 60);
}

}  // namespace thinwall::fuzz
