#pragma once
/// The exact time of impact: a ray against the Minkowski sum, one formula a pair.

#include <string_view>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/swept/boxes_entry.hpp>
#include <thinwall/swept/rounded_box_entry.hpp>
#include <thinwall/swept/serves.hpp>

namespace thinwall {

/// Claims: exact to rounding.
/// Error: forward at most 4 u kappa t, backward at most 4 u; the time is late as often as early (docs/closed_forms.md).
/// Degenerate: no relative motion is `apart`, or `overlapping` if they touch.
template <Scalar S> struct ClosedForm {
  static constexpr std::string_view name = "closed_form";
  S min_separation = 0;  ///< [length] >= 0: a gap this small counts as contact
};

/// Turns an entry (its normal from A to B) into the answer; point(time) says where they touch.
template <class A, class B, Scalar T, class Point>
THINWALL_HOT Toi<T> toi_of(const Moving<A>& a, const Moving<B>& b, const Entry<T>& entry, const Point& point) {
  if (entry.inside) return overlapping_at_start(a, b, entry.rounds);
  if (entry.gave_up) return {ToiStatus::gave_up, entry.rounds, std::min(T(1), entry.time)};
  if (!(entry.time <= T(1))) return {ToiStatus::apart, entry.rounds};
  return {ToiStatus::hit, entry.rounds, entry.time, entry.normal, point(entry.time)};
}

/// Where a moving sphere touches something that lies along `outward` at `time`; the middle of the gap if there is one.
template <Scalar T>
Vec3<T> sphere_point(const Moving<Sphere<T>>& s, const T& time, const Vec3<T>& outward, const T& gap) {
  return (s.shape.center + s.displacement * time) + outward * (s.shape.radius + gap / 2);
}

/// The middle of the closest points at `time`.
template <class A, class B, Scalar T> Vec3<T> middle_point(const Moving<A>& a, const Moving<B>& b, const T& time) {
  const Separation<T> closest = separation(pose_at(a, time), pose_at(b, time));
  return (closest.point_a + closest.point_b) / T(2);
}

template <Scalar T> Entry<T> flipped(Entry<T> entry) {
  entry.normal = Vec3<T>::Zero() - entry.normal;
  return entry;
}

template <Scalar S, Scalar T>
THINWALL_HOT Toi<T> impact(const ClosedForm<S>& method, const Moving<Sphere<T>>& a, const Moving<Sphere<T>>& b) {
  const T gap(method.min_separation);
  const Entry<T> entry = ball_entry<T>(b.shape.center - a.shape.center, relative_displacement(b, a),
                                       a.shape.radius + b.shape.radius + gap);
  return toi_of(a, b, entry, [&](const T& time) { return sphere_point<T>(a, time, entry.normal, gap); });
}

template <Scalar S, Scalar T>
THINWALL_HOT Toi<T> impact(const ClosedForm<S>& method, const Moving<Aabb<T>>& box, const Moving<Sphere<T>>& sphere) {
  const T gap(method.min_separation);
  const Entry<T> entry =
      rounded_box_entry<T>(sphere.shape.center - box.shape.center, relative_displacement(sphere, box),
                           box.shape.half_extents, sphere.shape.radius + gap);
  return toi_of(box, sphere, entry, [&](const T& time) { return sphere_point<T>(sphere, time, -entry.normal, gap); });
}

template <Scalar S, Scalar T>
THINWALL_HOT Toi<T> impact(const ClosedForm<S>& method, const Moving<Aabb<T>>& a, const Moving<Aabb<T>>& b) {
  const Entry<T> entry = rounded_box_entry<T>(b.shape.center - a.shape.center, relative_displacement(b, a),
                                              a.shape.half_extents + b.shape.half_extents, T(method.min_separation));
  return toi_of(a, b, entry, [&](const T& time) -> Vec3<T> {  // the middle of what they share, or of the gap, axis by axis
    const Vec3<T> middle_a = a.shape.center + a.displacement * time, middle_b = b.shape.center + b.displacement * time;
    return ((middle_a - a.shape.half_extents).cwiseMax(middle_b - b.shape.half_extents) +
            (middle_a + a.shape.half_extents).cwiseMin(middle_b + b.shape.half_extents)) /
           T(2);
  });
}

template <Scalar S, Scalar T>
THINWALL_HOT Toi<T> impact(const ClosedForm<S>& method, const Moving<Obb<T>>& box, const Moving<Sphere<T>>& sphere) {
  const T gap(method.min_separation);
  const Obb<T>& frame = box.shape;
  const T reach = sphere.shape.radius + gap;
  const Vec3<T> motion = relative_displacement(sphere, box);
  const NearPath<T> path(sphere.shape.center - frame.center, motion, reach + frame.half_extents.sum());
  Entry<T> entry = rounded_box_entry<T>(into(frame, path.start), into(frame, motion), frame.half_extents, reach);
  entry.time += path.base_time;
  entry.normal = out_of(frame, entry.normal);
  return toi_of(box, sphere, entry, [&](const T& time) { return sphere_point<T>(sphere, time, -entry.normal, gap); });
}

/// When two moving boxes come within `gap` of each other; the normal in A's axes.
template <Scalar T> Entry<T> boxes_entry(MovingBoxPair<T>& moving, const T& gap) {
  Entry<T> entry;
  entry.inside = boxes_within(moving.pair, gap);
  if (entry.inside) return entry;
  return gap > T(0) ? rounded_boxes_entry(moving, gap) : sharp_boxes_entry(moving);
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Obb<T>>& a, const Moving<Obb<T>>& b) {
  const T gap(method.min_separation);
  const Vec3<T> motion = relative_displacement(b, a);
  const NearPath<T> path(b.shape.center - a.shape.center, motion,
                         gap + a.shape.half_extents.sum() + b.shape.half_extents.sum());
  MovingBoxPair<T> moving{box_pair(a.shape, b.shape, path.start), into(a.shape, motion), into(b.shape, path.start),
                          into(b.shape, motion)};
  Entry<T> entry = boxes_entry(moving, gap);
  const Vec3<T> touching = moving.touching_point(entry, gap);
  entry.time += path.base_time;
  entry.normal = out_of(a.shape, entry.normal);
  return toi_of(a, b, entry, [&](const T& time) -> Vec3<T> {
    return (a.shape.center + a.displacement * time) + out_of(a.shape, touching);
  });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Obb<T>>& a, const Moving<Aabb<T>>& b) {
  const T gap(method.min_separation);
  const Vec3<T> motion = relative_displacement(a, b);
  const NearPath<T> path(a.shape.center - b.shape.center, motion,
                         gap + a.shape.half_extents.sum() + b.shape.half_extents.sum());
  MovingBoxPair<T> moving{box_pair(b.shape, a.shape, path.start), motion, into(a.shape, path.start),
                          into(a.shape, motion)};
  Entry<T> entry = boxes_entry(moving, gap);
  const Vec3<T> touching = moving.touching_point(entry, gap);
  entry.time += path.base_time;
  return toi_of(a, b, flipped(entry), [&](const T& time) -> Vec3<T> {
    return (b.shape.center + b.displacement * time) + touching;
  });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Triangle<T>>& triangle, const Moving<Sphere<T>>& sphere) {
  const T gap(method.min_separation);
  const Triangle<T>& t = triangle.shape;
  const T reach = sphere.shape.radius + gap;
  const Vec3<T> start = sphere.shape.center - t.a, motion = relative_displacement(sphere, triangle);
  const Vec3<T> e1 = t.b - t.a, e2 = t.c - t.a;
  const Entry<T> entry = reach == T(0) ? flat_entry(FlatShape::triangle, start, motion, e1, e2, T(1))
                                       : rounded_triangle_entry(start, motion, reach, e1, e2);
  return toi_of(triangle, sphere, entry,
                [&](const T& time) { return sphere_point<T>(sphere, time, -entry.normal, gap); });
}

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
  const Entry<T> entry =
      core_entry_at_any_scale<T>(&closest_on_swept_box<T>, capsule.shape.a - box.shape.center,
                                 relative_displacement(capsule, box), capsule.shape.radius + T(method.min_separation),
                                 Vec3<T>(capsule.shape.b - capsule.shape.a), box.shape.half_extents);
  return toi_of(capsule, box, flipped(entry), [&](const T& time) { return middle_point(capsule, box, time); });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Capsule<T>>& capsule, const Moving<Obb<T>>& box) {
  const T reach = capsule.shape.radius + T(method.min_separation);
  const Vec3<T> core = into<T>(box.shape, capsule.shape.b - capsule.shape.a);
  const Vec3<T> motion = relative_displacement(capsule, box);
  const NearPath<T> path(capsule.shape.a - box.shape.center, motion,
                         reach + largest(core) + box.shape.half_extents.sum());
  Entry<T> entry = core_entry_at_any_scale<T>(&closest_on_swept_box<T>, into(box.shape, path.start),
                                              into(box.shape, motion), reach, core, box.shape.half_extents);
  entry.time += path.base_time;
  entry.normal = -out_of(box.shape, entry.normal);
  return toi_of(capsule, box, entry, [&](const T& time) { return middle_point(capsule, box, time); });
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
