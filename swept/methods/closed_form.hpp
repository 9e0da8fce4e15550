#pragma once
/// The exact time of impact: a ray against the Minkowski sum, one formula a pair.

#include <thinwall/swept/closed_form/boxes_entry.hpp>
#include <thinwall/swept/closed_form/closed_form_capsule.hpp>
#include <thinwall/swept/closed_form/closed_form_parts.hpp>
#include <thinwall/swept/closed_form/rounded_box_entry.hpp>
#include <thinwall/swept/closed_form/sphere_triangle_entry.hpp>

namespace thinwall {

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Sphere<T>>& a, const Moving<Sphere<T>>& b) {
  const T gap(method.min_separation);
  const Entry<T> entry = ball_entry<T>(b.shape.center - a.shape.center, relative_displacement(b, a),
                                       a.shape.radius + b.shape.radius + gap);
  return toi_of(method, a, b, entry, [&](const T& time) { return sphere_point<T>(a, time, entry.normal, gap); });
}

/// When B, a sphere or an upright box of half extents `half_b`, comes within R of an upright box. By which face, where plain times cannot
/// tell, is found without rounding where R is 0, and else left to the wider scalar.
template <class B, Scalar T>
Entry<T> upright_box_entry(const Moving<Aabb<T>>& a, const Moving<B>& b, const Vec3<T>& half_b, const T& R) {
  Entry<T> entry = rounded_box_entry<T>(b.shape.center - a.shape.center, relative_displacement(b, a),
                                        a.shape.half_extents + half_b, R);
  if (R > T(0) || !entry.graze) return entry;
  entry.graze = false;
  if (!is_finite(entry.time)) return entry;
  return exact_box_entry<T>({b.shape.center, a.shape.center}, {b.displacement, a.displacement},
                            {a.shape.half_extents, half_b})
      .value_or(entry);
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Aabb<T>>& box, const Moving<Sphere<T>>& sphere) {
  const T gap(method.min_separation);
  const Entry<T> entry = upright_box_entry<Sphere<T>, T>(box, sphere, Vec3<T>::Zero(), sphere.shape.radius + gap);
  return toi_or_wider(method, box, sphere, entry,
                      [&](const T& time) { return sphere_point<T>(sphere, time, -entry.normal, gap); });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Aabb<T>>& a, const Moving<Aabb<T>>& b) {
  const Entry<T> entry = upright_box_entry<Aabb<T>, T>(a, b, b.shape.half_extents, T(method.min_separation));
  return toi_or_wider(method, a, b, entry,
                      [&](const T& time) -> Vec3<T> {  // the middle of what they share, or of the gap, axis by axis
                        const Vec3<T> middle_a = a.shape.center + a.displacement * time,
                                      middle_b = b.shape.center + b.displacement * time;
                        return ((middle_a - a.shape.half_extents).cwiseMax(middle_b - b.shape.half_extents) +
                                (middle_a + a.shape.half_extents).cwiseMin(middle_b + b.shape.half_extents)) /
                               T(2);
                      });
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Obb<T>>& box, const Moving<Sphere<T>>& sphere) {
  const T gap(method.min_separation);
  const Obb<T>& frame = box.shape;
  const T reach = sphere.shape.radius + gap;
  if (const auto same = sharp_upright(frame, reach)) {
    if (cores_within(frame, sphere.shape, reach)) return overlapping_at_start(box, sphere, 1);
    return toi_by_wider(method, Moving<Aabb<T>>{*same, box.displacement}, sphere);
  }
  const Vec3<T> motion = relative_displacement(sphere, box);
  const NearPath<T> path(sphere.shape.center - frame.center, motion, reach + frame.half_extents.sum());
  Entry<T> entry = rounded_box_entry<T>(into(frame, path.start), into(frame, motion), frame.half_extents, reach);
  entry.come_later(path.base_time);
  entry.normal = freed_of_leans(normal_out_of(frame, entry.normal), frame);
  return toi_of_turned(method, box, sphere, entry,
                       [&](const T& time) { return sphere_point<T>(sphere, time, -entry.normal, gap); });
}

/// The normal of an entry that is in A's axes, in the world's: from the edges of contact as given, where there are any,
/// because a face's normal that is turned twice tilts the face, and so does an axis not quite at right angles to it.
template <Scalar T>
Vec3<T> world_normal(const Obb<T>& a, const Obb<T>& b, const MovingBoxPair<T>& moving, const Entry<T>& entry) {
  const Vec3<T> turned = normal_out_of(a, entry.normal);
  int i = moving.axis_a, j = moving.axis_b;
  if (i < 0 && j < 0 && entry.may_hit()) {  // maybe a face's, to rounding: of two so near the nearer
    const Vec3<T> on_b = moving.pair.axes.transpose() * entry.normal;
    i = axis_along(entry.normal, gap_noise(T(1)));
    j = axis_along(on_b, gap_noise(T(1)));
    const auto sine = [](const Vec3<T>& n, int k) { return largest(n[(k + 1) % 3], n[(k + 2) % 3]); };
    if (i >= 0 && j >= 0) (sine(on_b, j) < sine(entry.normal, i) ? i : j) = -1;
  }
  if (i < 0 && j < 0) {  // across an edge of each, maybe: the longer one has the last word
    const bool a_is_longer = largest(b.half_extents) <= largest(a.half_extents);
    return a_is_longer ? freed_of_leans(freed_of_leans(turned, b), a) : freed_of_leans(freed_of_leans(turned, a), b);
  }
  const Vec3<T> n = j < 0   ? face_normal(a.axes, i)
                    : i < 0 ? face_normal(b.axes, j)
                            : accurate_cross<T>(a.axes.col(i), b.axes.col(j));
  if (largest(n) <= gap_noise(T(1))) return turned;  // parallel edges, crossed by rounding alone
  return safe_unit(n.dot(turned) < T(0) ? Vec3<T>(-n) : n);
}

/// Of boxes apart at the start, in A's axes.
template <Scalar S, Scalar T>
Toi<T> impact_of_apart(const ClosedForm<S>& method, const Moving<Obb<T>>& a, const Moving<Obb<T>>& b) {
  const T gap(method.min_separation);
  const Vec3<T> motion = relative_displacement(b, a);
  const NearPath<T> path(b.shape.center - a.shape.center, motion,
                         gap + a.shape.half_extents.sum() + b.shape.half_extents.sum());
  MovingBoxPair<T> moving{box_pair(a.shape, b.shape, path.start), into(a.shape, motion), into(b.shape, path.start),
                          into(b.shape, motion)};
  Entry<T> entry = gap > T(0) ? rounded_boxes_entry(moving, gap) : sharp_boxes_entry(moving);
  const Vec3<T> touching = moving.touching_point(entry);
  entry.come_later(path.base_time);
  entry.normal = world_normal(a.shape, b.shape, moving, entry);
  return toi_of_turned(method, a, b, entry, [&](const T& time) -> Vec3<T> {
    return (a.shape.center + a.displacement * time) + out_of(a.shape, touching);
  });
}

/// In the axes that are exact, or of the larger one, as what is turned into those of the other is off by a rounding of its size.
template <Scalar S, Scalar T, AnyBox B>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Obb<T>>& a, const Moving<B>& b) {
  const T gap(method.min_separation);
  if (cores_within(a.shape, b.shape, gap)) return overlapping_at_start(a, b, 1);
  const Moving<Obb<T>> other{to_obb(b.shape), b.displacement};
  const auto same_a = sharp_upright(a.shape, gap), same_b = sharp_upright(other.shape, gap);
  if (same_a && same_b)
    return toi_by_wider(method, Moving<Aabb<T>>{*same_a, a.displacement}, Moving<Aabb<T>>{*same_b, b.displacement});
  const bool in_axes_of_b = std::is_same_v<B, Aabb<T>> || largest(b.shape.half_extents) > largest(a.shape.half_extents);
  return in_axes_of_b ? flipped(impact_of_apart(method, other, a)) : impact_of_apart(method, a, other);
}

/// The triangle with the corner that is nearest to x first where it is so large, beside what it meets there, that a place
/// seen from a far corner would lose digits that count.
template <Scalar T> Triangle<T> nearest_corner_first(const Triangle<T>& t, const Vec3<T>& x, const T& reach) {
  const T from_a = largest(Vec3<T>(t.a - x)), from_b = largest(Vec3<T>(t.b - x)), from_c = largest(Vec3<T>(t.c - x));
  const bool is_large = std::max({from_a, from_b, from_c}) > 1024 * reach;
  if (!is_large || (from_a <= from_b && from_a <= from_c)) return t;
  return from_b <= from_c ? Triangle<T>{t.b, t.c, t.a} : Triangle<T>{t.c, t.a, t.b};
}

template <Scalar S, Scalar T>
Toi<T> impact(const ClosedForm<S>& method, const Moving<Triangle<T>>& triangle, const Moving<Sphere<T>>& sphere) {
  const T gap(method.min_separation);
  const Triangle<T> t = nearest_corner_first<T>(triangle.shape, sphere.shape.center, sphere.shape.radius + gap);
  const Vec3<T> e1 = t.b - t.a, e2 = t.c - t.a, motion = relative_displacement(sphere, triangle);
  const T reach = sphere.shape.radius + gap;
  const NearPath<T> path(sphere.shape.center - t.a, motion, reach + largest(e1, e2));
  Entry<T> entry;
  if (reach == T(0)) {
    entry = flat_entry<T>(FlatShape::triangle, sphere.shape.center - t.a, motion, e1, e2, T(1));
  } else {
    entry = sphere_triangle_entry<T>(path.start, motion, reach, e1, e2);
    entry.come_later(path.base_time);
  }
  return toi_or_wider(method, triangle, sphere, entry,
                      [&](const T& time) { return sphere_point<T>(sphere, time, -entry.normal, gap); });
}

}  // namespace thinwall

#ifdef THINWALL_COMPILED
#include <thinwall/swept/compiled.hpp>
#endif
