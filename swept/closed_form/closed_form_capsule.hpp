#pragma once
/// The exact time of impact of a capsule with every shape.

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/swept/closed_form/capsule_box_entry.hpp>
#include <thinwall/swept/closed_form/closed_form_parts.hpp>

namespace thinwall {

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& capsule, const Moving<Sphere<T>>& sphere) {
  const T gap(method.min_separation);
  const Entry<T> entry =
      rounded_segment_entry<T>(sphere.shape.center - capsule.shape.a, relative_displacement(sphere, capsule),
                               capsule.shape.b - capsule.shape.a, capsule.shape.radius + sphere.shape.radius + gap);
  return toi_of(capsule, sphere, entry,
                [&](const T& time) { return sphere_point<T>(sphere, time, -entry.normal, gap); });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& a, const Moving<Capsule<T>>& b) {
  const T reach = a.shape.radius + b.shape.radius + T(method.min_separation);
  const Vec3<T> start = b.shape.a - a.shape.a, motion = relative_displacement(b, a);
  const Vec3<T> core_a = a.shape.b - a.shape.a, core_b = b.shape.b - b.shape.a;
  const Entry<T> entry =
      reach == T(0) ? flat_entry<T>(FlatShape::parallelogram, start, motion, core_a, -core_b, T(1))
                    : core_entry_at_any_scale(&closest_on_parallelogram<T>, start, motion, reach, core_a, core_b);
  return toi_of(a, b, entry, [&](const T& time) { return middle_point(a, b, time); });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& capsule, const Moving<Aabb<T>>& box) {
  const T gap(method.min_separation);
  const Vec3<T> start = capsule.shape.a - box.shape.center, motion = relative_displacement(capsule, box);
  const Vec3<T> core = capsule.shape.b - capsule.shape.a, &h = box.shape.half_extents;
  const Entry<T> entry = capsule_box_entry<T>(start, motion, capsule.shape.radius + gap, core, h);
  return toi_of(capsule, box, flipped(entry), [&](const T& time) -> Vec3<T> {
    return (box.shape.center + box.displacement * time) +
           (point_on_box<T>(start + motion * time, core, h) + entry.normal * (gap / 2));
  });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& capsule, const Moving<Obb<T>>& box) {
  const T gap(method.min_separation), reach = capsule.shape.radius + gap;
  const Vec3<T> core = into<T>(box.shape, capsule.shape.b - capsule.shape.a), &h = box.shape.half_extents;
  const Vec3<T> motion = relative_displacement(capsule, box);
  const NearPath<T> path(capsule.shape.a - box.shape.center, motion, reach + largest(core) + h.sum());
  const Vec3<T> start = into(box.shape, path.start), own_motion = into(box.shape, motion);
  const Entry<T> own = capsule_box_entry<T>(start, own_motion, reach, core, h);
  Entry<T> entry = own;
  entry.time += path.base_time;
  entry.normal = -out_of(box.shape, own.normal);
  return toi_of(capsule, box, entry, [&](const T& time) -> Vec3<T> {
    return (box.shape.center + box.displacement * time) +
           out_of<T>(box.shape, point_on_box<T>(start + own_motion * own.time, core, h) + own.normal * (gap / 2));
  });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& capsule, const Moving<Triangle<T>>& triangle) {
  const Triangle<T>& t = triangle.shape;
  const auto closest = [](const Vec3<T>& x, const Vec3<T>& d, const Vec3<T>& e1, const Vec3<T>& e2) {
    return closest_on_swept_triangle(x, d, e1, e2).part;
  };
  const Entry<T> entry =
      core_entry_at_any_scale<T>(closest, capsule.shape.a - t.a, relative_displacement(capsule, triangle),
                                 capsule.shape.radius + T(method.min_separation),
                                 Vec3<T>(capsule.shape.b - capsule.shape.a), Vec3<T>(t.b - t.a), Vec3<T>(t.c - t.a));
  return toi_of(capsule, triangle, flipped(entry),
                [&](const T& time) { return middle_point(capsule, triangle, time); });
}

}  // namespace thinwall
