#pragma once
/// For those who link thinwall::compiled: what asks much of a compiler is instantiated there, once, for float, double and long
/// double, and not again in every file that asks a question. The answers are the same to the bit. Included by the headers
/// themselves where THINWALL_COMPILED is defined.

#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/queries.hpp>
#include <thinwall/discrete/triangle.hpp>

#ifndef THINWALL_INSTANTIATION  // the compiled.cpp define it as `template`
#define THINWALL_INSTANTIATION extern template
#endif

namespace thinwall {

// NOLINTBEGIN(bugprone-macro-parentheses): what they are given are types.
#define THINWALL_OF_SCALAR(S)                                                                              \
  THINWALL_INSTANTIATION S norm_out_of_range<S>(const Vec3<S>&);                                           \
  THINWALL_INSTANTIATION Vec3<S> unit_out_of_range<S>(const Vec3<S>&);                                     \
  THINWALL_INSTANTIATION Vec3<S> arbitrary_normal<S>(const Vec3<S>&);                                      \
  THINWALL_INSTANTIATION S accurate_discriminant<S>(const Vec3<S>&, const Vec3<S>&, const S&);             \
  THINWALL_INSTANTIATION Entry<S> ball_entry<S>(const Vec3<S>&, const Vec3<S>&, const S&);                 \
  THINWALL_INSTANTIATION CoreGap<S> gap_from_box<S>(const Vec3<S>&, const Vec3<S>&);                       \
  THINWALL_INSTANTIATION BoxesOverlap boxes_overlap<S>(const BoxPair<S>&);                                 \
  THINWALL_INSTANTIATION BoxPoints<S> closest_points<S>(const BoxPair<S>&);                                \
  THINWALL_INSTANTIATION CoreGap<S> box_gap<S>(const BoxPair<S>&);                                         \
  THINWALL_INSTANTIATION Vec3<S> gap_from_triangle<S>(const Vec3<S>&, const Triangle<S>&);                 \
  THINWALL_INSTANTIATION Entry<S> flat_entry<S>(FlatShape, const Vec3<S>&, const Vec3<S>&, const Vec3<S>&, \
                                                const Vec3<S>&, const S&);                                 \
  THINWALL_INSTANTIATION std::optional<RayHit<S>> ray_entry<S>(const Ray<S>&, const Sphere<S>&);           \
  THINWALL_INSTANTIATION std::optional<RayHit<S>> ray_entry<S>(const Ray<S>&, const Aabb<S>&);             \
  THINWALL_INSTANTIATION std::optional<RayHit<S>> ray_entry<S>(const Ray<S>&, const Obb<S>&);              \
  THINWALL_INSTANTIATION std::optional<RayHit<S>> ray_entry<S>(const Ray<S>&, const Triangle<S>&);         \
  THINWALL_INSTANTIATION CoreGap<S> core_gap<S>(const Sphere<S>&, const Sphere<S>&);                       \
  THINWALL_INSTANTIATION CoreGap<S> core_gap<S>(const Aabb<S>&, const Sphere<S>&);                         \
  THINWALL_INSTANTIATION CoreGap<S> core_gap<S>(const Aabb<S>&, const Aabb<S>&);                           \
  THINWALL_INSTANTIATION CoreGap<S> core_gap<S>(const Obb<S>&, const Sphere<S>&);                          \
  THINWALL_INSTANTIATION CoreGap<S> core_gap<S>(const Triangle<S>&, const Sphere<S>&)

THINWALL_OF_SCALAR(float);
THINWALL_OF_SCALAR(double);
THINWALL_OF_SCALAR(long double);
#undef THINWALL_OF_SCALAR
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace thinwall
