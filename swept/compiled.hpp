#pragma once
/// What discrete/compiled.hpp is for questions without motion, for times of impact: the closed form of every pair but the
/// quickest, and what all of them turn to in doubt.

#include <thinwall/capsule/compiled.hpp>
#include <thinwall/swept/methods/closed_form.hpp>

namespace thinwall {

// NOLINTBEGIN(bugprone-macro-parentheses): what they are given are types.
#define THINWALL_OF_SCALAR(S)                                                                                        \
  THINWALL_INSTANTIATION Entry<S> rounded_box_entry<S>(const Vec3<S>&, const Vec3<S>&, const Vec3<S>&, const S&);    \
  THINWALL_INSTANTIATION Entry<S> rounded_boxes_entry<S>(const MovingBoxPair<S>&, const S&);                         \
  THINWALL_INSTANTIATION Entry<S> sharp_boxes_entry<S>(MovingBoxPair<S>&);                                           \
  THINWALL_INSTANTIATION Entry<S> capsule_box_entry<S>(const Vec3<S>&, const Vec3<S>&, const S&, const Vec3<S>&,     \
                                                       const Vec3<S>&);                                              \
  THINWALL_INSTANTIATION Entry<S> sphere_triangle_entry<S>(const Vec3<S>&, const Vec3<S>&, const S&, const Vec3<S>&, \
                                                           const Vec3<S>&);                                          \
  THINWALL_INSTANTIATION SharedTime<S> segment_and_box_share<S>(                                                     \
      const Vec3<S>&, const Vec3<S>&, const Vec3<S>&, const Vec3<S>&, const S&, const Mat3<S>&, const Mat3<S>&)

THINWALL_OF_SCALAR(float);
THINWALL_OF_SCALAR(double);
THINWALL_OF_SCALAR(long double);
#undef THINWALL_OF_SCALAR

// A method keeps its own scalar where a query goes on in a wider one.
#define THINWALL_OF_PAIR(S, T, A, B) \
  THINWALL_INSTANTIATION Toi<T> impact<S, T>(const ClosedForm<S>&, const Moving<A<T>>&, const Moving<B<T>>&)
#define THINWALL_OF_SCALARS(S, T)           \
  THINWALL_OF_PAIR(S, T, Obb, Aabb);        \
  THINWALL_OF_PAIR(S, T, Obb, Obb);         \
  THINWALL_OF_PAIR(S, T, Triangle, Sphere); \
  THINWALL_OF_PAIR(S, T, Capsule, Sphere);  \
  THINWALL_OF_PAIR(S, T, Capsule, Aabb);    \
  THINWALL_OF_PAIR(S, T, Capsule, Obb);     \
  THINWALL_OF_PAIR(S, T, Capsule, Capsule); \
  THINWALL_OF_PAIR(S, T, Capsule, Triangle)

THINWALL_OF_SCALARS(float, float);
THINWALL_OF_SCALARS(double, double);
THINWALL_OF_SCALARS(long double, long double);
#undef THINWALL_OF_SCALARS

THINWALL_OF_PAIR(long double, long double, Sphere, Sphere);
THINWALL_OF_PAIR(long double, long double, Aabb, Sphere);
THINWALL_OF_PAIR(long double, long double, Aabb, Aabb);
THINWALL_OF_PAIR(long double, long double, Obb, Sphere);
#undef THINWALL_OF_PAIR
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace thinwall
