#pragma once
/// The clear rung of a time of impact: straight from two moving shapes to the answer, without a jump that is a coin's toss.

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/clear/clear_entry.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/swept/clear/clear_boxes.hpp>
#include <thinwall/swept/moving.hpp>
#include <thinwall/swept/toi.hpp>

namespace thinwall {

/// An answer, if that is clear: `apart` or `hit`.
struct ClearToi {
  bool clear;
  packed::Pair time;  ///< [1] after the step's end for a miss
  packed::Lanes normal, point;
  int evaluations = 1;

  THINWALL_HOT Toi<double> toi() const {
    using packed::all, packed::both;
    const packed::LanesMask hit = all(time) <= all(1);
    static_assert(static_cast<ToiStatus>(0U) == ToiStatus::apart && static_cast<ToiStatus>(1U) == ToiStatus::hit);
    Toi<double> toi{static_cast<ToiStatus>(bits(hit) & 1U), evaluations, value(min(time, both(1)))};
    store(keep(hit, normal), toi.normal);
    store(keep(hit, point), toi.point);
    return toi;
  }
};

/// Whether a time is not near the end of the step; nor nearer to it than what roundings move it by, `noise` [length] over the closing
/// speed along its normal.
THINWALL_HOT bool clear_of_end(const packed::Pair& time, const packed::Pair& closing, const packed::Pair& noise) {
  using packed::both;
  return all_of((both(2) < time) | (closing * both(packed::near_end) + noise < closing * abs(time - both(1))));
}
THINWALL_HOT bool clear_of_end(const packed::Pair& time) {
  return all_of(packed::both(packed::near_end) < abs(time - packed::both(1)));
}
/// No radius and no gap is negative, or not a number.
THINWALL_HOT bool clear_sizes(double r, double s, double gap) {
  using packed::both;
  return all_of(both(0) <= min(both(gap), min(both(r), both(s))));
}

THINWALL_HOT ClearToi clear_impact(const Moving<Sphere<double>>& a, const Moving<Sphere<double>>& b, double gap) {
  const double r = a.shape.radius, s = b.shape.radius;
  const packed::Lanes center = packed::lanes(a.shape.center), path = packed::lanes(a.displacement);
  const ClearEntry entry = clear_ball_entry(packed::lanes(b.shape.center) - center,
                                            packed::lanes(b.displacement) - path, packed::both(r + s + gap));
  return {packed::both(entry.clear, packed::both(clear_sizes(r, s, gap), clear_of_end(entry.time))), entry.time,
          entry.normal, (center + path * all(entry.time)) + entry.normal * packed::all(r + gap / 2)};
}

THINWALL_HOT ClearToi clear_impact(const Moving<Aabb<double>>& box, const Moving<Sphere<double>>& sphere, double gap) {
  const double r = sphere.shape.radius;
  const packed::Lanes center = packed::lanes(sphere.shape.center), path = packed::lanes(sphere.displacement);
  const ClearEntry entry =
      clear_box_entry<false>(center - packed::lanes(box.shape.center), path - packed::lanes(box.displacement),
                             packed::lanes(box.shape.half_extents), packed::both(r + gap));
  return {packed::both(entry.clear, packed::both(clear_sizes(r, r, gap), clear_of_end(entry.time))), entry.time,
          entry.normal, (center + path * all(entry.time)) - entry.normal * packed::all(r + gap / 2), entry.rounds};
}

THINWALL_HOT ClearToi clear_impact(const Moving<Aabb<double>>& a, const Moving<Aabb<double>>& b, double gap) {
  using packed::Lanes, packed::lanes, packed::all, packed::both;
  const Lanes half_a = lanes(a.shape.half_extents), half_b = lanes(b.shape.half_extents), zero = all(0);
  const Lanes center_a = lanes(a.shape.center), center_b = lanes(b.shape.center);
  const Lanes path_a = lanes(a.displacement), path_b = lanes(b.displacement), v = path_b - path_a;
  const ClearSlabs slabs(center_b - center_a, v, half_a + half_b, zero, 1);
  const Lanes time = all(slabs.first), at_a = center_a + path_a * time, at_b = center_b + path_b * time;
  const Lanes point = (max(at_a - half_a, at_b - half_b) + min(at_a + half_a, at_b + half_b)) * all(0.5);
  return {both(both(slabs.clear, gap == 0), all_of(zero <= min(half_a, half_b))),
          select(slabs.last < slabs.first, both(ClearEntry::never), slabs.first),
          clear_face_normal(bits(time <= slabs.enter), v), point};
}

/// As against an aligned box, in the box's own axes; and the time once more by the plane of contact, whose normal n is the world's, and g in
/// the box's: turned coordinates have three roundings each, and those that do not count along the normal go.
THINWALL_HOT ClearToi clear_impact(const Moving<Obb<double>>& box, const Moving<Sphere<double>>& sphere, double gap) {
  using packed::Lanes, packed::Pair, packed::all, packed::both, packed::lanes;
  const double r = sphere.shape.radius;
  const ClearFrame frame(box.shape.axes);
  const Lanes center = lanes(sphere.shape.center), path = lanes(sphere.displacement), h = lanes(box.shape.half_extents);
  const Lanes p = center - lanes(box.shape.center), v = path - lanes(box.displacement);
  const ClearEntry entry = clear_box_entry<true>(frame.into(p), frame.into(v), h, both(r + gap));
  const Lanes n = frame.out_of(entry.normal), g = frame.into(n);
  const Pair toward = two_sums(n * p, n * v), sums = two_sums(n * n, abs(g) * h), length = root(firsts(sums));
  const Pair closing = both(0) - seconds(toward);
  const Pair plane = (firsts(toward) - (both(r + gap) * length + seconds(sums))) / closing;
  const Pair time = select(entry.time < both(ClearEntry::never), max(plane, both(0)), both(ClearEntry::never));
  const bool in_time = clear_of_end(time, closing, sum(abs(p) + h) * both(0x1p-44));
  const Lanes normal = n / all(length);
  return {both(both(entry.clear, frame.clear()), both(clear_sizes(r, r, gap), in_time)), time, normal,
          (center + path * all(time)) - normal * all(r + gap / 2), entry.rounds};
}

THINWALL_HOT ClearToi clear_impact(const Moving<Capsule<double>>& capsule, const Moving<Sphere<double>>& sphere,
                                   double gap) {
  using packed::Lanes, packed::all, packed::both, packed::lanes;
  const double r = sphere.shape.radius, s = capsule.shape.radius;
  const Lanes center = lanes(sphere.shape.center), path = lanes(sphere.displacement), a = lanes(capsule.shape.a);
  const Lanes p = center - a, v = path - lanes(capsule.displacement), core = lanes(capsule.shape.b) - a;
  const ClearEntry entry = clear_segment_entry(p, v, core, both(r + s + gap)).entry;
  const bool in_time =
      clear_of_end(entry.time, both(0) - dot(entry.normal, v), sum(abs(p) + abs(core)) * both(0x1p-44));
  return {both(entry.clear, both(clear_sizes(r, s, gap), in_time)), entry.time, entry.normal,
          (center + path * all(entry.time)) - entry.normal * all(r + gap / 2)};
}

THINWALL_HOT ClearToi clear_impact(const Moving<Obb<double>>& b, const Moving<Aabb<double>>& a, double gap) {
  using packed::Lanes, packed::all, packed::both, packed::lanes;
  const Lanes center = lanes(a.shape.center), path = lanes(a.displacement);
  const Lanes between = lanes(b.shape.center) - center, v = lanes(b.displacement) - path;
  const ClearBoxes boxes(a.shape, b.shape, between, v);
  const Lanes sizes = lanes(a.shape.half_extents) + lanes(b.shape.half_extents);
  const bool in_time =
      clear_of_end(boxes.time, both(0) - dot(boxes.normal, v), sum(abs(between) + sizes) * both(0x1p-44));
  return {both(both(boxes.clear, gap == 0), in_time), boxes.time, all(0) - boxes.normal,
          (center + path * all(boxes.time)) + boxes.from_a};
}

/// This pair has a clear rung.
template <class A, class B>
concept HasClearImpact = requires(const Moving<A>& a, const Moving<B>& b) { clear_impact(a, b, 0.0); };

}  // namespace thinwall
