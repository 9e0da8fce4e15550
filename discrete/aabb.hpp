#pragma once
/// The axis-aligned box, and its pairs with itself and the sphere.

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include <thinwall/discrete/entry/exact_box_entry.hpp>
#include <thinwall/discrete/sphere.hpp>

namespace thinwall {

/// All points within `half_extents` of the center, axis by axis.
template <thinwall::Scalar S> struct Aabb {
  using Scalar = S;
  static constexpr int rank = 1;

  Vec3<S> center;        ///< [length]
  Vec3<S> half_extents;  ///< [length] each >= 0; a 0 makes a plate, a rod or a point
};
template <Scalar S> Aabb(Vec3<S>, Vec3<S>) -> Aabb<S>;

template <Scalar S> Vec3<S> center(const Aabb<S>& box) { return box.center; }
template <Scalar S> S skin_radius(const Aabb<S>&) { return S(0); }
template <Scalar S> S magnitude(const Aabb<S>& box) {
  return box.center.cwiseAbs().sum() + box.half_extents.cwiseAbs().sum();
}
template <Scalar S> bool has_valid_sizes(const Aabb<S>& box) { return box.half_extents.minCoeff() >= S(0); }
template <Scalar S> bool valid(const Aabb<S>& box) {
  return is_finite(box.center) && is_finite(box.half_extents) && has_valid_sizes(box);
}
template <Scalar S> Aabb<S> scaled(const Aabb<S>& box, int e) {
  return {times_power_of_two(box.center, e), times_power_of_two(box.half_extents, e)};
}
template <Scalar T, Scalar S> Aabb<T> cast(const Aabb<S>& box) {
  return {box.center.template cast<T>(), box.half_extents.template cast<T>()};
}
template <Scalar S> Aabb<S> moved(const Aabb<S>& box, const Vec3<S>& by) { return {box.center + by, box.half_extents}; }
template <Scalar S> Vec3<S> half_widths(const Aabb<S>& box) { return box.half_extents; }
/// An axis-aligned box must not turn, so a contact acts at its center and gives it no torque.
template <Scalar S> Vec3<S> contact_point(const Aabb<S>&, const Vec3<S>&, const Vec3<S>&) { return Vec3<S>::Zero(); }

/// How far x lies outside [-h, h] on each axis; zero on the axes where it is inside.
template <Scalar S> THINWALL_HOT Vec3<S> excess_of(const Vec3<S>& x, const Vec3<S>& h) {
  return x - x.cwiseMin(h).cwiseMax(-h);
}

template <Scalar S> bool cores_within(const Aabb<S>& a, const Aabb<S>& b, const S& reach) {
  return within(excess_of<S>(b.center - a.center, a.half_extents + b.half_extents), reach);
}

template <Scalar S> bool cores_within(const Aabb<S>& box, const Sphere<S>& sphere, const S& reach) {
  return within(excess_of<S>(sphere.center - box.center, box.half_extents), reach);
}

/// The gap from the box [-h, h] to a point x, and the way out if x is inside: through the nearest face; ties leave by
/// the lowest axis, on its positive side. `distance` and `normal` (away from the box) are set, nothing else.
template <Scalar S> CoreGap<S> gap_from_box(const Vec3<S>& x, const Vec3<S>& h) {
  CoreGap<S> gap;
  const Vec3<S> excess = excess_of(x, h);
  if (excess != Vec3<S>::Zero()) {
    gap.distance = safe_norm(excess);
    gap.normal = safe_unit(excess);
    return gap;
  }
  int axis = 0;
  const Vec3<S> depth = h - x.cwiseAbs();
  for (int i = 1; i < 3; ++i) {
    if (depth[i] < depth[axis]) axis = i;
  }
  gap.distance = -depth[axis];
  gap.normal = axis_vector<S>(axis, x[axis] < S(0));
  return gap;
}

/// Degenerate: boxes that only touch part along the touching axis of lowest number.
template <Scalar S> CoreGap<S> core_gap(const Aabb<S>& a, const Aabb<S>& b) {
  const Vec3<S> between = b.center - a.center;
  CoreGap<S> gap = gap_from_box<S>(between, a.half_extents + b.half_extents);
  for (int i = 0; i < 3; ++i) {  // the middle of the common interval; the facing ends where there is none
    const S low = std::max(-a.half_extents[i], S(between[i] - b.half_extents[i]));
    const S high = std::min(a.half_extents[i], S(between[i] + b.half_extents[i]));
    const bool faces = gap.normal[i] != S(0);
    const S side = gap.normal[i] < S(0) ? S(-1) : S(1);
    gap.local_a[i] = faces ? S(side * a.half_extents[i]) : S((low + high) / 2);
    gap.local_b[i] = faces ? S(-side * b.half_extents[i]) : S(gap.local_a[i] - between[i]);
  }
  return gap;
}

/// The gap from the box [-h, h] to a point x, with the box's closest point.
template <Scalar S> CoreGap<S> gap_to_point(const Vec3<S>& x, const Vec3<S>& h) {
  CoreGap<S> gap = gap_from_box(x, h);
  gap.local_a = x.cwiseMin(h).cwiseMax(-h);
  for (int i = 0; i < 3 && gap.distance <= S(0); ++i) {
    if (gap.normal[i] != S(0)) gap.local_a[i] = gap.normal[i] * h[i];
  }
  return gap;
}

/// Degenerate: a center inside the box leaves through the nearest face.
template <Scalar S> CoreGap<S> core_gap(const Aabb<S>& box, const Sphere<S>& sphere) {
  return gap_to_point<S>(sphere.center - box.center, box.half_extents);
}

/// The slab method, branching on axes without motion so that 0 * infinity never arises.
template <Scalar S> std::optional<RayHit<S>> ray_entry(const Ray<S>& ray, const Aabb<S>& box) {
  const Vec3<S> start = ray.origin - box.center, &h = box.half_extents, &v = ray.direction;
  Vec3<S> enter = Vec3<S>::Constant(-std::numeric_limits<S>::infinity()), leave = -enter;
  for (int i = 0; i < 3; ++i) {
    if (v[i] == S(0)) {
      if (largest(start[i]) > h[i]) return std::nullopt;
      continue;
    }
    const S near = v[i] > S(0) ? -h[i] : h[i];
    enter[i] = (near - start[i]) / v[i];
    leave[i] = (-near - start[i]) / v[i];
  }
  if (excess_of(start, h) == Vec3<S>::Zero() && ray.max_t >= S(0)) return RayHit<S>{S(0), ray.origin, Vec3<S>::Zero()};
  int axis = 0;
  S t = enter.maxCoeff(&axis);
  if (!(t >= S(0) && t <= std::min(ray.max_t, leave.minCoeff()))) return std::nullopt;
  if (is_last_in_doubt(enter, leave, axis, t)) {
    const Vec3<S> none = Vec3<S>::Zero();
    if (const auto exact = exact_box_entry<S>({ray.origin, box.center}, {v, none}, {h, none})) {
      exact->normal.cwiseAbs().maxCoeff(&axis);
      t = std::min(exact->time, ray.max_t);
    }
  }
  RayHit<S> hit;
  hit.t = t;
  hit.normal = axis_vector<S>(axis, v[axis] > S(0));
  const Vec3<S> offset = start + v * t;
  hit.point = box.center + offset.cwiseMin(h).cwiseMax(-h);
  hit.point[axis] = box.center[axis] + hit.normal[axis] * h[axis];
  return hit;
}

// ---- The clear rung (clear/clear_entry.hpp).

/// The way out of the box [-h, h] from the point x inside: the lowest axis of least depth, and that depth.
struct ClearWayOut {
  packed::Pair depth;
  packed::Lanes normal;

  THINWALL_HOT ClearWayOut(const packed::Lanes& x, const packed::Lanes& h) {
    const packed::Lanes depths = h - abs(x);
    depth = smallest_of(depths);
    normal = keep(packed::lowest(bits(depths <= all(depth))), against(packed::all(-1), x + packed::all(0)));
  }
};

/// Always clear within range: both rungs compare the same sums.
THINWALL_HOT ClearContact clear_contact(const Aabb<double>& a, const Aabb<double>& b) {
  using packed::Lanes, packed::all;
  const Lanes x = packed::lanes(b.center) - packed::lanes(a.center), half_a = packed::lanes(a.half_extents);
  const Lanes half_b = packed::lanes(b.half_extents), h = half_a + half_b, zero = all(0);
  const ClearWayOut out(x, h);
  const packed::LanesMask in_range = (abs(x) + h <= all(packed::most_length)) & (zero <= min(half_a, half_b));
  return {all_of(in_range), all_of(abs(x) <= h), zero, zero, out.normal, out.depth};
}
THINWALL_HOT ClearContact clear_gap(const Aabb<double>& a, const Aabb<double>& b) {
  using packed::Lanes, packed::Pair, packed::all, packed::both;
  const Lanes x = packed::lanes(b.center) - packed::lanes(a.center), half_a = packed::lanes(a.half_extents);
  const Lanes half_b = packed::lanes(b.half_extents), h = half_a + half_b, zero = all(0);
  const Lanes excess = x - held_within(x, h), low = max(zero - half_a, x - half_b), high = min(half_a, x + half_b);
  const Pair square = dot(excess, excess), distance = root(square);
  ClearContact gap = clear_contact(a, b);
  const bool has_square = all_of(both(packed::least_square) <= square) || gap.touching;
  gap.clear = both(gap.clear, has_square);
  if (!gap.touching) gap.normal = excess / all(distance), gap.depth = both(0) - distance;
  const packed::LanesMask faces = zero < abs(gap.normal);
  gap.local_b = select(faces, against(half_b, gap.normal), (low + high) * all(0.5) - x);
  return gap;
}

/// The sphere at x and the box [-h, h], with the place on the box.
THINWALL_HOT ClearContact clear_contact_in_box(const packed::Lanes& x, const packed::Lanes& h, double radius) {
  using packed::Lanes, packed::Pair, packed::PairMask, packed::all, packed::both;
  const Lanes zero = all(0), excess = x - held_within(x, h);
  const Pair r = both(radius), rr = r * r, square = dot(excess, excess), distance = root(square);
  const ClearWayOut out(x, h);
  const PairMask inside = both(0) <= out.depth, has_square = inside | (both(packed::least_square) <= square);
  const PairMask decided = (both(1 / packed::most_length) <= r) & clearly_apart(square, rr) & has_square;
  const packed::LanesMask in_range = (abs(x) + h) + all(r) <= all(packed::most_length), is_inside = all(inside);
  const Lanes outward = select(is_inside, out.normal, excess / all(distance));
  return {both(all_of(decided), all_of(in_range & (zero <= h))),
          all_of(square < rr),
          select(is_inside, x + out.normal * all(out.depth), x - excess),
          (zero - outward) * all(r),
          outward,
          r + select(inside, out.depth, both(0) - distance)};
}
THINWALL_HOT ClearContact clear_contact(const Aabb<double>& box, const Sphere<double>& sphere) {
  ClearContact contact = clear_contact_in_box(packed::lanes(sphere.center) - packed::lanes(box.center),
                                              packed::lanes(box.half_extents), sphere.radius);
  contact.local_a = packed::all(0);  // it acts at the box's center
  return contact;
}

THINWALL_HOT ClearRayHit clear_raycast(const Ray<double>& ray, const Aabb<double>& box) {
  using packed::Lanes, packed::all, packed::both;
  const Lanes center = packed::lanes(box.center), h = packed::lanes(box.half_extents), v = packed::lanes(ray.direction);
  const Lanes p = packed::lanes(ray.origin) - center;
  const ClearSlabs slabs(p, v, h, all(0), ray.max_t);
  const ClearSlabs::Last last = slabs.last_entered();
  const Lanes clamped = held_within(p + v * all(slabs.first), h);
  return {both(both(all_of(slabs.in_range), last.clear), ray.max_t >= 0), last.meets, slabs.first,
          center + select(last.axis, against(h, v), clamped), clear_face_normal(last.axis, v)};
}

}  // namespace thinwall
