#pragma once
/// What discrete/compiled.hpp is for the shapes of discrete, for those with a capsule.

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/compiled.hpp>

namespace thinwall {

// NOLINTBEGIN(bugprone-macro-parentheses): what they are given are types.
#define THINWALL_OF_SCALAR(S)                                                                                         \
  THINWALL_INSTANTIATION Entry<S> rounded_segment_entry<S>(const Vec3<S>&, const Vec3<S>&, const Vec3<S>&, const S&); \
  THINWALL_INSTANTIATION CoreGap<S> segment_through_box<S>(const Vec3<S>&, const Vec3<S>&, const Vec3<S>&);           \
  THINWALL_INSTANTIATION S closest_parameter_to_box<S>(const Vec3<S>&, const Vec3<S>&, const Vec3<S>&);               \
  THINWALL_INSTANTIATION SegmentPair<S> closest_on_segments<S>(const Vec3<S>&, const Vec3<S>&, const Vec3<S>&);       \
  THINWALL_INSTANTIATION PrismPart<S> closest_on_swept_triangle<S>(const Vec3<S>&, const Vec3<S>&, const Vec3<S>&,    \
                                                                   const Vec3<S>&);                                   \
  THINWALL_INSTANTIATION std::optional<RayHit<S>> ray_entry<S>(const Ray<S>&, const Capsule<S>&);                     \
  THINWALL_INSTANTIATION CoreGap<S> core_gap<S>(const Capsule<S>&, const Sphere<S>&);                                 \
  THINWALL_INSTANTIATION CoreGap<S> core_gap<S>(const Capsule<S>&, const Capsule<S>&);                                \
  THINWALL_INSTANTIATION CoreGap<S> core_gap<S>(const Capsule<S>&, const Aabb<S>&);                                   \
  THINWALL_INSTANTIATION CoreGap<S> core_gap<S>(const Capsule<S>&, const Triangle<S>&)

THINWALL_OF_SCALAR(float);
THINWALL_OF_SCALAR(double);
THINWALL_OF_SCALAR(long double);
#undef THINWALL_OF_SCALAR
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace thinwall
