#pragma once
/// The exact time of impact of a capsule with every shape.

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/swept/closed_form/capsule_box_entry.hpp>
#include <thinwall/swept/closed_form/capsule_triangle_entry.hpp>
#include <thinwall/swept/closed_form/closed_form_parts.hpp>
#include <thinwall/swept/closed_form/core_entry.hpp>

namespace thinwall {

/// The capsule with its nearer end first where its core is so long, beside what it meets at x, that a place seen from the
/// farther end would lose digits that count.
template <Scalar T> Capsule<T> nearer_end_first(const Capsule<T>& capsule, const Vec3<T>& x, const T& reach) {
  const bool is_long = largest(Vec3<T>(capsule.b - capsule.a)) > 1024 * reach;
  const bool swaps = is_long && largest(Vec3<T>(capsule.b - x)) < largest(Vec3<T>(capsule.a - x));
  return swaps ? Capsule<T>{capsule.b, capsule.a, capsule.radius} : capsule;
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& capsule, const Moving<Sphere<T>>& sphere) {
  const T gap(method.min_separation);
  const T reach = capsule.shape.radius + sphere.shape.radius + gap;
  const Capsule<T> shape = nearer_end_first(capsule.shape, sphere.shape.center, reach);
  const Vec3<T> core = shape.b - shape.a, motion = relative_displacement(sphere, capsule);
  const Vec3<T> start = sphere.shape.center - shape.a;
  Entry<T> entry;
  if (reach == T(0)) {
    entry = flat_entry<T>(FlatShape::parallelogram, start, motion, core, Vec3<T>::Zero(), T(1));
  } else {
    const NearPath<T> path(start, motion, reach + largest(core));
    entry = rounded_segment_entry<T>(path.start, motion, core, reach);
    entry.come_later(path.base_time);
  }
  return toi_or_wider(method, capsule, sphere, entry,
                      [&](const T& time) { return sphere_point<T>(sphere, time, -entry.normal, gap); });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& a, const Moving<Capsule<T>>& b) {
  const T reach = a.shape.radius + b.shape.radius + T(method.min_separation);
  const Capsule<T> first = nearer_end_first<T>(a.shape, b.shape.a, reach);
  const Capsule<T> second = nearer_end_first<T>(b.shape, first.a, reach);
  const Vec3<T> start = second.a - first.a, motion = relative_displacement(b, a);
  const Vec3<T> core_a = first.b - first.a, core_b = second.b - second.a;
  const NearPath<T> path(start, motion, reach + largest(core_a) + largest(core_b));
  Entry<T> entry;
  if (reach == T(0)) {
    entry = flat_entry<T>(FlatShape::parallelogram, start, motion, core_a, -core_b, T(1));
  } else {
    entry = core_entry_at_any_scale(&closest_on_parallelogram<T>, path.start, motion, reach, core_a, core_b);
    entry.come_later(path.base_time);
  }
  return toi_or_wider(method, a, b, entry, [&](const T& time) { return middle_point(a, b, time); });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& capsule, const Moving<Aabb<T>>& box) {
  const T gap(method.min_separation);
  const Vec3<T>& h = box.shape.half_extents;
  const T reach = capsule.shape.radius + gap;
  if (cores_within(capsule.shape, box.shape, reach)) return overlapping_at_start(capsule, box, 1);
  const Capsule<T> shape = nearer_end_first<T>(capsule.shape, box.shape.center, reach + h.sum());
  const Vec3<T> core = shape.b - shape.a, motion = relative_displacement(capsule, box);
  const Vec3<T> start = shape.a - box.shape.center;  // without a radius nothing need round
  const NearPath<T> path =
      reach > T(0) ? NearPath<T>(start, motion, reach + largest(core) + h.sum()) : NearPath<T>(start);
  const Entry<T> own = capsule_box_entry<T>(path.start, motion, reach, core, h);
  if constexpr (has_wider<T>) {
    if (own.inside) return toi_by_wider(method, capsule, box);  // by roundings
  }
  Entry<T> entry = flipped(own);
  entry.come_later(path.base_time);
  return toi_or_wider(method, capsule, box, entry, [&](const T& time) -> Vec3<T> {
    return (box.shape.center + box.displacement * time) +
           (point_on_box<T>(path.start + motion * own.time, core, h) + own.normal * (gap / 2));
  });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& capsule, const Moving<Obb<T>>& box) {
  const T gap(method.min_separation), reach = capsule.shape.radius + gap;
  if (cores_within(capsule.shape, box.shape, reach)) return overlapping_at_start(capsule, box, 1);
  if (const auto same = sharp_upright(box.shape, reach))
    return toi_by_wider(method, capsule, Moving<Aabb<T>>{*same, box.displacement});
  const Vec3<T>& h = box.shape.half_extents;
  const Capsule<T> shape = nearer_end_first<T>(capsule.shape, box.shape.center, reach + h.sum());
  const Vec3<T> edge = shape.b - shape.a, core = into(box.shape, edge), motion = relative_displacement(capsule, box);
  const NearPath<T> path(shape.a - box.shape.center, motion, reach + largest(core) + h.sum());
  const Vec3<T> start = into(box.shape, path.start), own_motion = into(box.shape, motion);
  const auto sharp = [&box](const Vec3<T>& p, const Vec3<T>& v, const T&, const Vec3<T>& d, const Vec3<T>& half) {
    return sharp_segment_box_entry(p, v, d, half, box.shape.axes);
  };
  const Entry<T> own = reach > T(0) ? capsule_box_entry<T>(start, own_motion, reach, core, h)
                                    : entry_at_safe_scale<T>(sharp, path.start, motion, reach, edge, h);
  if constexpr (has_wider<T>) {
    if (own.inside) return toi_by_wider(method, capsule, box);  // by roundings
  }
  Entry<T> entry = own;
  entry.come_later(path.base_time);
  if (reach > T(0)) {  // across an edge of the box, maybe, and the core: the longer one has the last word
    const Vec3<T> n = normal_out_of(box.shape, own.normal);
    entry.normal = largest(edge) < 2 * largest(h) ? freed_of_leans<T>(freed_of_lean(n, edge), box.shape)
                                                  : freed_of_lean<T>(freed_of_leans(n, box.shape), edge);
  }
  entry.normal = -entry.normal;
  return toi_of_turned(method, capsule, box, entry, [&](const T& time) -> Vec3<T> {
    return (box.shape.center + box.displacement * time) +
           out_of<T>(box.shape, point_on_box<T>(start + own_motion * (own.time + (time - entry.time)), core, h) +
                                    own.normal * (gap / 2));
  });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& capsule, const Moving<Triangle<T>>& triangle) {
  const Triangle<T>& t = triangle.shape;
  const Vec3<T> e1 = t.b - t.a, e2 = t.c - t.a, motion = relative_displacement(capsule, triangle);
  const T reach = capsule.shape.radius + T(method.min_separation);
  if constexpr (has_wider<T>) {  // nothing is round: which of the parts that are met at once is for more digits to tell
    if (reach == T(0)) return toi_by_wider(method, capsule, triangle);
  }
  const Capsule<T> shape = nearer_end_first<T>(capsule.shape, t.a, reach + largest(e1, e2));
  const Vec3<T> core = shape.b - shape.a;
  const NearPath<T> path(shape.a - t.a, motion, reach + largest(core) + largest(e1, e2));
  Entry<T> entry;
  if (reach == T(0) && prism_is_exact<T>(shape.a - t.a, core, e1, e2)) {
    entry = sharp_segment_triangle_entry<T>(shape.a - t.a, motion, core, e1, e2);
  } else {
    entry = capsule_triangle_entry<T>(path.start, motion, reach, core, e1, e2);
    entry.come_later(path.base_time);
  }
  const auto point = [&](const T& time) { return middle_point(capsule, triangle, time); };
  if constexpr (has_wider<T>) {  // as if it were turned: a core all but level with a face is met by either's plane
    return toi_of_turned(method, capsule, triangle, flipped(entry), point);
  } else {
    return toi_or_wider(method, capsule, triangle, flipped(entry), point);
  }
}

}  // namespace thinwall
