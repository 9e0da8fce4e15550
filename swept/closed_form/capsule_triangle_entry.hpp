#pragma once
/// When a moving segment comes within R of a triangle: the walk of core_entry.hpp over the parts of their Minkowski sum, a prism.
/// Where R is zero, what meets the prism from outside meets one of its five faces: two triangles and three parallelograms.

#include <thinwall/capsule/segment_triangle.hpp>
#include <thinwall/discrete/entry/flat_entry.hpp>
#include <thinwall/swept/closed_form/core_entry.hpp>

namespace thinwall {

/// First time at which the segment p + v t + s * d, s in [0, 1], is within R > 0 of the triangle (0, e1, e2); the normal out of it.
template <Scalar S>
Entry<S> capsule_triangle_entry(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Vec3<S>& d, const Vec3<S>& e1,
                                const Vec3<S>& e2) {
  const auto closest = [](const Vec3<S>& x, const Vec3<S>& core, const Vec3<S>& edge1, const Vec3<S>& edge2) {
    return closest_on_swept_triangle(x, core, edge1, edge2).part;
  };
  return core_entry_at_any_scale<S>(closest, p, v, R, d, e1, e2);
}

/// The same without a radius, to the end of the step.
/// Error: the verdict is that of the given numbers' faces exactly, unless a product underflows; p + d is rounded.
template <Scalar S>
Entry<S> sharp_segment_triangle_entry(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& d, const Vec3<S>& e1,
                                      const Vec3<S>& e2) {
  Entry<S> first;
  first.inside = segment_meets_triangle(p, d, e1, e2);
  const auto meet = [&](FlatShape shape, const Vec3<S>& from, const Vec3<S>& side1, const Vec3<S>& side2) {
    if (first.inside) return;
    const Entry<S> entry = flat_entry<S>(shape, from, v, side1, side2, S(1));
    if (entry.inside || entry.time < first.time) first = entry;
  };
  meet(FlatShape::triangle, p, e1, e2);
  meet(FlatShape::triangle, p + d, e1, e2);
  meet(FlatShape::parallelogram, p, e1, -d);
  meet(FlatShape::parallelogram, p, e2, -d);
  meet(FlatShape::parallelogram, p - e1, e2 - e1, -d);
  return first;
}

}  // namespace thinwall
