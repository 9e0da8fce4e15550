#pragma once
/// The exact time of impact of a capsule with every shape.

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/swept/closed_form/capsule_box_entry.hpp>
#include <thinwall/swept/closed_form/closed_form_parts.hpp>

namespace thinwall {

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& capsule, const Moving<Sphere<T>>& sphere) {
  const T gap(method.min_separation);
  const T reach = capsule.shape.radius + sphere.shape.radius + gap;
  const Vec3<T> core = capsule.shape.b - capsule.shape.a, motion = relative_displacement(sphere, capsule);
  const NearPath<T> path(sphere.shape.center - capsule.shape.a, motion, reach + largest(core));
  Entry<T> entry = rounded_segment_entry<T>(path.start, motion, core, reach);
  entry.time += path.base_time;
  return toi_of(capsule, sphere, gap, entry,
                [&](const T& time) { return sphere_point<T>(sphere, time, -entry.normal, gap); });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& a, const Moving<Capsule<T>>& b) {
  const T reach = a.shape.radius + b.shape.radius + T(method.min_separation);
  const Vec3<T> start = b.shape.a - a.shape.a, motion = relative_displacement(b, a);
  const Vec3<T> core_a = a.shape.b - a.shape.a, core_b = b.shape.b - b.shape.a;
  const NearPath<T> path(start, motion, reach + largest(core_a) + largest(core_b));
  Entry<T> entry;
  if (reach == T(0)) {
    entry = flat_entry<T>(FlatShape::parallelogram, start, motion, core_a, -core_b, T(1));
  } else {
    entry = core_entry_at_any_scale(&closest_on_parallelogram<T>, path.start, motion, reach, core_a, core_b);
    entry.time += path.base_time;
  }
  return toi_of(a, b, T(method.min_separation), entry, [&](const T& time) { return middle_point(a, b, time); });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& capsule, const Moving<Aabb<T>>& box) {
  const T gap(method.min_separation);
  const Vec3<T> core = capsule.shape.b - capsule.shape.a, &h = box.shape.half_extents;
  const Vec3<T> motion = relative_displacement(capsule, box);
  const T reach = capsule.shape.radius + gap;
  const NearPath<T> path(capsule.shape.a - box.shape.center, motion, reach + largest(core) + h.sum());
  const Entry<T> own = capsule_box_entry<T>(path.start, motion, reach, core, h);
  Entry<T> entry = flipped(own);
  entry.time += path.base_time;
  return toi_of(capsule, box, gap, entry, [&](const T& time) -> Vec3<T> {
    return (box.shape.center + box.displacement * time) +
           (point_on_box<T>(path.start + motion * own.time, core, h) + own.normal * (gap / 2));
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
  return toi_of_turned(method, capsule, box, entry, [&](const T& time) -> Vec3<T> {
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
  const Vec3<T> core = capsule.shape.b - capsule.shape.a, e1 = t.b - t.a, e2 = t.c - t.a;
  const Vec3<T> motion = relative_displacement(capsule, triangle);
  const T reach = capsule.shape.radius + T(method.min_separation);
  const NearPath<T> path(capsule.shape.a - t.a, motion, reach + largest(core) + largest(e1, e2));
  Entry<T> entry = core_entry_at_any_scale<T>(closest, path.start, motion, reach, core, e1, e2);
  entry.time += path.base_time;
  return toi_of(capsule, triangle, T(method.min_separation), flipped(entry),
                [&](const T& time) { return middle_point(capsule, triangle, time); });
}

}  // namespace thinwall
