#pragma once
/// The capsule: a segment rounded by a radius. It is also the volume a sphere sweeps in one step.

#include <optional>

#include <thinwall/capsule/clear_segment_box.hpp>
#include <thinwall/capsule/clear_segment_entry.hpp>
#include <thinwall/capsule/clear_segment_triangle.hpp>
#include <thinwall/capsule/clear_segments.hpp>
#include <thinwall/capsule/ray_capsule.hpp>
#include <thinwall/capsule/segment.hpp>
#include <thinwall/capsule/segment_box.hpp>
#include <thinwall/capsule/segment_triangle.hpp>
#include <thinwall/discrete/directions.hpp>
#include <thinwall/discrete/entry/flat_entry.hpp>
#include <thinwall/discrete/obb.hpp>

namespace thinwall {

/// All points within `radius` of the segment [a, b].
template <thinwall::Scalar S> struct Capsule {
  using Scalar = S;
  static constexpr int rank = 4;

  Vec3<S> a, b;  ///< [length] ends of the core segment; a == b is a ball
  S radius;      ///< [length] >= 0; 0 is a segment
};
template <Scalar S> Capsule(Vec3<S>, Vec3<S>, S) -> Capsule<S>;

/// The middle of the core segment.
template <Scalar S> Vec3<S> center(const Capsule<S>& c) { return c.a + (c.b - c.a) / S(2); }
template <Scalar S> S skin_radius(const Capsule<S>& c) { return c.radius; }
template <Scalar S> S magnitude(const Capsule<S>& c) {
  return c.a.cwiseAbs().sum() + c.b.cwiseAbs().sum() + largest(c.radius);
}
template <Scalar S> bool has_valid_sizes(const Capsule<S>& c) { return c.radius >= S(0); }
template <Scalar S> bool valid(const Capsule<S>& c) {
  return is_finite(c.a) && is_finite(c.b) && is_finite(c.radius) && has_valid_sizes(c);
}
template <Scalar S> Capsule<S> scaled(const Capsule<S>& c, int e) {
  return {times_power_of_two(c.a, e), times_power_of_two(c.b, e), times_power_of_two(c.radius, e)};
}
template <Scalar T, Scalar S> Capsule<T> cast(const Capsule<S>& c) {
  return {c.a.template cast<T>(), c.b.template cast<T>(), static_cast<T>(c.radius)};
}
template <Scalar S> Capsule<S> moved(const Capsule<S>& c, const Vec3<S>& by) { return {c.a + by, c.b + by, c.radius}; }
template <Scalar S> Vec3<S> half_widths(const Capsule<S>& c) {
  return Vec3<S>((c.b - c.a).cwiseAbs() / S(2)) + Vec3<S>::Constant(c.radius);
}
template <Scalar S> Vec3<S> contact_point(const Capsule<S>& c, const Vec3<S>& core_point, const Vec3<S>& outward) {
  return core_point + outward * c.radius;
}

/// The capsule in an oriented box's own axes, around its center, and the box there.
template <Scalar S> Capsule<S> into(const Obb<S>& box, const Capsule<S>& c) {
  return {into<S>(box, c.a - box.center), into<S>(box, c.b - box.center), c.radius};
}
template <Scalar S> Aabb<S> own_aabb(const Obb<S>& box) { return {Vec3<S>::Zero(), box.half_extents}; }

/// The parameter in [0, 1] of the core's point that is closest to the other shape's core; docs of segment.hpp.
template <Scalar S> S closest_core_parameter(const Capsule<S>& capsule, const Sphere<S>& sphere) {
  return closest_parameter<S>(sphere.center - capsule.a, capsule.b - capsule.a);
}
template <Scalar S> S closest_core_parameter(const Capsule<S>& capsule, const Aabb<S>& box) {
  return closest_parameter_to_box<S>(capsule.a - box.center, capsule.b - capsule.a, box.half_extents);
}
template <Scalar S> S closest_core_parameter(const Capsule<S>& capsule, const Obb<S>& box) {
  return closest_core_parameter(into(box, capsule), own_aabb(box));
}
template <Scalar S> S closest_core_parameter(const Capsule<S>& a, const Capsule<S>& b) {
  return closest_on_segments<S>(b.a - a.a, a.b - a.a, b.b - b.a).s;
}

template <Scalar S> bool cores_within(const Capsule<S>& capsule, const Sphere<S>& sphere, const S& reach) {
  const S s = closest_core_parameter(capsule, sphere);
  return within<S>((sphere.center - capsule.a) - (capsule.b - capsule.a) * s, reach);
}

/// From the box [-h, h] to the nearest of the segment p + s d; zero where that pierces the box, be it a plate without thickness.
template <Scalar S> Vec3<S> excess_of_segment(const Vec3<S>& p, const Vec3<S>& d, const Vec3<S>& h) {
  const auto [first, last] = stretch_between_faces(p, d, h);
  if (first <= last) return Vec3<S>::Zero();
  return excess_of<S>(p + d * closest_parameter_to_box(p, d, h), h);
}

/// Whether the segment p + s d comes within `reach` of the box [-h, h]; where roundings decide, what wider() says.
template <Scalar S, class Wide>
bool segment_within(const Vec3<S>& p, const Vec3<S>& d, const Vec3<S>& h, const S& reach, const Wide& wider) {
  const Vec3<S> excess = excess_of_segment(p, d, h);
  const bool in_doubt = largest(S(safe_norm(excess) - reach)) <= gap_noise(largest(p, d, h));
  return has_wider<S> && in_doubt ? wider() : within(excess, reach);
}

template <Scalar S> bool cores_within(const Capsule<S>& capsule, const Aabb<S>& box, const S& reach) {
  using W = Wider<S>;
  return segment_within<S>(capsule.a - box.center, capsule.b - capsule.a, box.half_extents, reach,
                           [&] { return cores_within(cast<W>(capsule), cast<W>(box), W(reach)); });
}

/// The same in the wider scalar, of the box as its axes span it, whatever they lean.
template <Scalar W, Scalar S> bool cores_within_wider(const Capsule<S>& capsule, const Obb<S>& box, const S& reach) {
  const Capsule<W> core = cast<W>(capsule);
  const Obb<W> given = cast<W>(box);
  const auto along_axes = [&](const Vec3<W>& v) -> Vec3<W> {  // axes * x is v, but for squares of what they lean
    const Vec3<W> x = into(given, v);
    return x + into<W>(given, v - out_of(given, x));
  };
  const Vec3<W> p = along_axes(core.a - given.center), d = along_axes(core.b - core.a);
  return within(out_of(given, excess_of_segment(p, d, given.half_extents)), W(reach));
}

template <Scalar S> bool cores_within(const Capsule<S>& capsule, const Obb<S>& box, const S& reach) {
  const Capsule<S> own = into(box, capsule);
  return segment_within<S>(own.a, own.b - own.a, box.half_extents, reach,
                           [&] { return cores_within_wider<Wider<S>>(capsule, box, reach); });
}

template <Scalar S> bool cores_within(const Capsule<S>& a, const Capsule<S>& b, const S& reach) {
  const Vec3<S> between = b.a - a.a, core_a = a.b - a.a, core_b = b.b - b.a;
  if (reach == S(0)) return in_flat_set<S>(FlatShape::parallelogram, between, core_a, -core_b);
  return within(closest_on_segments<S>(between, core_a, core_b).gap, reach);
}

/// Degenerate: a center on the core leaves sideways; the direction is the caller's.
template <Scalar S> CoreGap<S> core_gap(const Capsule<S>& capsule, const Sphere<S>& sphere) {
  const Vec3<S> from_a = sphere.center - capsule.a, core = capsule.b - capsule.a;
  const S s = closest_core_parameter(capsule, sphere);
  const Vec3<S> between = from_a - core * s;
  CoreGap<S> gap;
  gap.distance = safe_norm(between);
  gap.local_a = core * (s - S(1) / S(2));
  gap.along = core;
  if (gap.distance > gap_noise(largest(from_a, core)))
    gap.normal = S(0) < s && s < S(1) ? unit_across(safe_unit(between), safe_unit(core)) : safe_unit(between);
  return gap;
}

/// Degenerate: cores that cross part along the normal of the plane they span, cores on one line sideways.
template <Scalar S> CoreGap<S> core_gap(const Capsule<S>& a, const Capsule<S>& b) {
  const Vec3<S> between = b.a - a.a, core_a = a.b - a.a, core_b = b.b - b.a;
  const SegmentPair<S> closest = closest_on_segments(between, core_a, core_b);
  CoreGap<S> gap;
  gap.distance = safe_norm(closest.gap);
  gap.local_a = core_a * (closest.s - S(1) / S(2));
  gap.local_b = core_b * (closest.t - S(1) / S(2));
  const Vec3<S> unit_a = safe_unit(core_a), unit_b = safe_unit(core_b), across = accurate_cross<S>(unit_a, unit_b);
  if (gap.distance > gap_noise(largest(between, core_a, core_b))) {
    const bool on_a = S(0) < closest.s && closest.s < S(1), on_b = S(0) < closest.t && closest.t < S(1);
    gap.normal = safe_unit(closest.gap);
    if (on_a && on_b && largest(across) > parallel_sine<S>()) {
      gap.normal = safe_unit(gap.normal.dot(across) < S(0) ? Vec3<S>(-across) : across);
    } else if (on_a || on_b) {
      gap.normal = unit_across(gap.normal, on_a ? unit_a : unit_b);
    }
    return gap;
  }
  gap.along = core_a == Vec3<S>::Zero() ? core_b : core_a;
  if (largest(across) <= gap_noise(S(1))) return gap;
  gap.normal = towards_positive<S>(safe_unit(across));
  return gap;
}

/// Degenerate: a core that touches or crosses the box parts from it along the axis of least penetration.
template <Scalar S> CoreGap<S> core_gap(const Capsule<S>& capsule, const Aabb<S>& box) {
  const Vec3<S> start = capsule.a - box.center, core = capsule.b - capsule.a;
  const S s = closest_core_parameter(capsule, box);
  const Vec3<S> along = core * s, nearest = start + along;
  const Vec3<S> excess = excess_of(nearest, box.half_extents);
  CoreGap<S> gap;
  gap.distance = safe_norm(excess);
  const S noise = gap_noise(largest(start, along, box.half_extents));
  if (gap.distance <= noise) return segment_through_box(start, core, box.half_extents);
  // Across what the core does outside the slabs, if it is but for rounding: not of a stretch that is all as near.
  const Vec3<S> out = safe_unit(excess), outside = safe_unit<S>(excess.cwiseSign().cwiseAbs().cwiseProduct(core));
  const bool across = S(0) < s && s < S(1) && largest(S(excess.dot(outside))) <= noise;
  gap.normal = across ? Vec3<S>(-unit_across(out, outside)) : Vec3<S>(-out);
  gap.local_a = core * (s - S(1) / S(2));
  gap.local_b = nearest.cwiseMin(box.half_extents).cwiseMax(-box.half_extents);
  return gap;
}

template <Scalar S> CoreGap<S> core_gap(const Capsule<S>& capsule, const Obb<S>& box) {
  return out_of(box, core_gap(into(box, capsule), own_aabb(box)));
}

/// The closest points of a capsule's core and a triangle, at any scale; `gap` from the triangle.
template <Scalar S> PrismPart<S> closest_on_core_and_triangle(const Capsule<S>& capsule, const Triangle<S>& triangle) {
  const Vec3<S> x = capsule.a - triangle.a, core = capsule.b - capsule.a;
  const Vec3<S> e1 = triangle.b - triangle.a, e2 = triangle.c - triangle.a;
  const S size = largest(x, core, e1, e2);
  const int e = safe_exponent(size);
  if (e == 0) return closest_on_swept_triangle(x, core, e1, e2);
  PrismPart<S> closest = closest_on_swept_triangle(times_power_of_two(x, -e), times_power_of_two(core, -e),
                                                   times_power_of_two(e1, -e), times_power_of_two(e2, -e));
  closest.on_triangle = times_power_of_two(closest.on_triangle, e);
  if (closest.part.contains_point()) {
    closest.part.depth = times_power_of_two(closest.part.depth, e);
  } else {
    closest.part.gap = times_power_of_two(closest.part.gap, e);
  }
  return closest;
}

template <Scalar S> bool cores_within(const Capsule<S>& capsule, const Triangle<S>& triangle, const S& reach) {
  if (reach == S(0)) {
    const Vec3<S> x = capsule.a - triangle.a, core = capsule.b - capsule.a;
    const Vec3<S> e1 = triangle.b - triangle.a, e2 = triangle.c - triangle.a;
    if (prism_is_exact(x, core, e1, e2)) return segment_meets_triangle(x, core, e1, e2);
  }
  const CorePart<S> part = closest_on_core_and_triangle(capsule, triangle).part;
  return part.contains_point() || within(part.gap, reach);
}

/// Degenerate: a core that pierces the triangle leaves past its nearer end or the nearest edge; one that only touches it
/// along the plane's normal, or across the edge it touches.
template <Scalar S> CoreGap<S> core_gap(const Capsule<S>& capsule, const Triangle<S>& triangle) {
  PrismPart<S> closest = closest_on_core_and_triangle(capsule, triangle);
  const Vec3<S> core = capsule.b - capsule.a;
  CoreGap<S> gap;
  gap.distance = closest.part.distance();
  closest.part.gap = safe_unit(closest.part.gap);  // at any scale
  gap.local_a = core * (closest.s - S(1) / S(2));
  gap.local_b = closest.on_triangle - (center(triangle) - triangle.a);
  const Vec3<S> x = capsule.a - triangle.a, e1 = triangle.b - triangle.a, e2 = triangle.c - triangle.a;
  gap.along = core != Vec3<S>::Zero() ? core : largest(e1) < largest(e2) ? e2 : e1;
  const S noise = gap_noise(largest(x, core, e1, e2));
  const bool clear = closest.part.depth > S(0) || gap.distance > noise;
  gap.normal = clear ? Vec3<S>(-closest.part.outward()) : parting_normal(x, core, e1, e2, noise);
  return gap;
}

template <Scalar S> std::optional<RayHit<S>> ray_entry(const Ray<S>& ray, const Capsule<S>& capsule) {
  const Vec3<S> core = capsule.b - capsule.a;
  const NearPath<S> path(ray.origin - capsule.a, ray.direction, capsule.radius + largest(core), S(64));
  const Entry<S> entry = rounded_segment_entry(path.start, ray.direction, core, capsule.radius);
  if (entry.inside && ray.max_t >= S(0)) return RayHit<S>{S(0), ray.origin, Vec3<S>::Zero()};
  const S time = entry.time + path.base_time;
  if (entry.inside || !(time <= ray.max_t) || !is_finite(time)) return std::nullopt;
  const S s = closest_parameter<S>(path.start + ray.direction * entry.time, core);
  return RayHit<S>{time, capsule.a + core * s + entry.normal * capsule.radius, entry.normal};
}

// ---- The clear rung (discrete/clear/clear_entry.hpp).

THINWALL_HOT ClearContact clear_contact(const Capsule<double>& capsule, const Sphere<double>& sphere) {
  using packed::all, packed::lanes, packed::both;
  const packed::Lanes a = lanes(capsule.a), x = lanes(sphere.center) - a;
  const ClearSegment core(lanes(capsule.b) - a);
  const ClearNearest nearest = core.nearest(x);
  ClearContact contact = clear_core_contact(core, nearest, x, capsule.radius, sphere.radius);
  contact.local_a = core.d * all(nearest.place - both(0.5)) + contact.normal * all(capsule.radius);
  contact.local_b = contact.normal * all(-sphere.radius);
  return contact;
}

THINWALL_HOT ClearContact clear_contact(const Capsule<double>& first, const Capsule<double>& second) {
  using packed::all, packed::lanes, packed::both;
  const packed::Lanes a = lanes(first.a), b = lanes(second.a), x = b - a;
  const ClearSegments core(lanes(first.b) - a, b - lanes(second.b));
  const ClearNearest nearest = core.nearest(x);
  ClearContact contact = clear_core_contact(core, nearest, x, first.radius, second.radius);
  const packed::Lanes on_a = core.d * all(firsts(nearest.place)), on_b = on_a - nearest.at;  // from their starts
  contact.local_a = (on_a - core.d * all(0.5)) + contact.normal * all(first.radius);
  contact.local_b = (on_b + core.e * all(0.5)) - contact.normal * all(second.radius);
  return contact;
}

/// In the box's own axes, from the box to the capsule. Not clear if the core pierces the box, or lies along what is nearest to it, all but level:
/// then where they touch is for rounding to say.
template <class Frame>
THINWALL_HOT ClearContact clear_box_capsule(const Frame& frame, const Vec3<double>& center, const Vec3<double>& half,
                                            const Capsule<double>& capsule) {
  using packed::all, packed::lanes, packed::both;
  const packed::Lanes a = lanes(capsule.a), d = lanes(capsule.b) - a, h = lanes(half);
  const packed::Lanes x = frame.into(a - lanes(center));
  const ClearSegmentBox core(frame.into(d), h, all(0));
  const ClearNearest nearest = core.nearest(x);
  ClearContact contact = clear_core_contact(core, nearest, x, 0, capsule.radius);
  const packed::Lanes gap = abs(nearest.gap), out = keep(all(largest_of(gap)) < gap * all(0x1p20), core.d);
  const bool leans = all_of(dot(d, d) * both(0x1p-40) <= dot(out, out));
  contact.clear = both(both(contact.clear, leans), all_of(frame.clear() & (all(0) <= h)));
  contact.normal = nearer_unit(frame.out_of(contact.normal));
  contact.local_a = frame.out_of(nearest.at + core.d * all(nearest.place));
  contact.local_b = d * all(nearest.place - both(0.5)) - contact.normal * all(capsule.radius);
  return contact;
}
THINWALL_HOT ClearContact clear_contact(const Obb<double>& box, const Capsule<double>& capsule) {
  return clear_box_capsule(ClearFrame(box.axes), box.center, box.half_extents, capsule);
}
/// Its contact acts at the box's center.
THINWALL_HOT ClearContact clear_contact(const Aabb<double>& box, const Capsule<double>& capsule) {
  ClearContact contact = clear_box_capsule(ClearUpright{}, box.center, box.half_extents, capsule);
  contact.local_a = packed::all(0);
  return contact;
}

/// Not clear of a needle or a core that is level with the triangle, or where they cross.
THINWALL_HOT ClearContact clear_contact(const Capsule<double>& capsule, const Triangle<double>& triangle) {
  using packed::Lanes, packed::Pair, packed::all, packed::both, packed::lanes;
  const Lanes a = lanes(triangle.a), start = lanes(capsule.a), x = start - a;
  const ClearSegmentTriangle core(lanes(triangle.b) - a, lanes(triangle.c) - a, lanes(capsule.b) - start);
  const ClearNearest nearest = core.nearest(x);
  ClearContact contact = clear_core_contact(core, nearest, x, capsule.radius, 0);
  const Pair size = sum(abs(x)) + core.length, lean = size * size * both(0x1p-96) / dot(nearest.gap, nearest.gap);
  contact.clear = both(contact.clear, core.is_behind(nearest.at, contact.normal, size, lean));
  const Lanes along = core.d * all(nearest.place);
  contact.local_a = (nearest.at + along) - (core.face.d + core.face.f) / all(3);
  contact.local_b = (along - core.d * all(0.5)) - contact.normal * all(capsule.radius);
  return flipped(contact);
}

THINWALL_HOT ClearRayHit clear_raycast(const Ray<double>& ray, const Capsule<double>& capsule) {
  using packed::Lanes, packed::all, packed::lanes, packed::twice;
  const auto ends = twice(ray.origin) - packed::side_by_side(capsule.a, capsule.b), along = twice(ray.direction);
  const ClearSide line(ends, along, twice(capsule.b) - twice(capsule.a), packed::both(capsule.radius));
  if (all_of(line.passes() & line.aslant() & line.in_range())) return ClearRayHit::miss();
  const ClearSegmentEntry entry = clear_segment_entry(line, ends, along);
  const Lanes a = lanes(capsule.a), v = lanes(ray.direction), p = lanes(ray.origin) - a;
  const Lanes on_core = (lanes(capsule.b) - a) * all(entry.on);
  const ClearSegmentNormal out(entry, line, (p - on_core) + v * all(entry.time));
  const ClearEntry at{all_of(entry.clear & out.clear), entry.time, out.normal};
  return clear_ray_hit(at, firsts(line.square), line.speed, ray.max_t, a + on_core, capsule.radius);
}

}  // namespace thinwall

#ifdef THINWALL_COMPILED
#include <thinwall/capsule/compiled.hpp>
#endif
