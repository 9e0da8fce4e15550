#pragma once
/// The clear rung of a time of impact: straight from two moving shapes to the answer, without a jump that is a coin's toss.

#include <algorithm>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/capsule/clear_segment_box.hpp>
#include <thinwall/discrete/clear/clear_entry.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/triangle.hpp>
#include <thinwall/swept/clear/clear_boxes.hpp>
#include <thinwall/swept/clear/clear_flat.hpp>
#include <thinwall/swept/clear/clear_prism.hpp>
#include <thinwall/swept/clear/clear_walk.hpp>
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
THINWALL_HOT packed::PairMask clear_of_end(const packed::Pair& time, const packed::Pair& closing,
                                           const packed::Pair& noise) {
  using packed::both;
  return (both(2) < time) | (closing * both(packed::near_end) + noise < closing * abs(time - both(1)));
}
THINWALL_HOT packed::PairMask clear_of_end(const packed::Pair& time) {
  return packed::both(packed::near_end) < abs(time - packed::both(1));
}
/// No radius and no gap is negative, or not a number.
THINWALL_HOT packed::PairMask clear_sizes(double r, double s, double gap) {
  using packed::both;
  return both(0) <= min(both(gap), packed::pair(r, s));
}

THINWALL_HOT ClearToi clear_impact(const Moving<Sphere<double>>& a, const Moving<Sphere<double>>& b, double gap) {
  const double r = a.shape.radius, s = b.shape.radius;
  const packed::Lanes center = packed::lanes(a.shape.center), path = packed::lanes(a.displacement);
  const ClearEntry entry = clear_ball_entry(packed::lanes(b.shape.center) - center,
                                            packed::lanes(b.displacement) - path, packed::both(r + s + gap));
  return {packed::both(entry.clear, all_of(clear_sizes(r, s, gap) & clear_of_end(entry.time))), entry.time,
          entry.normal, (center + path * all(entry.time)) + entry.normal * packed::all(r + gap / 2)};
}

THINWALL_HOT ClearToi clear_impact(const Moving<Aabb<double>>& box, const Moving<Sphere<double>>& sphere, double gap) {
  const double r = sphere.shape.radius;
  const packed::Lanes center = packed::lanes(sphere.shape.center), path = packed::lanes(sphere.displacement);
  const ClearEntry entry =
      clear_box_entry<false>(center - packed::lanes(box.shape.center), path - packed::lanes(box.displacement),
                             packed::lanes(box.shape.half_extents), packed::both(r + gap));
  return {packed::both(entry.clear, all_of(clear_sizes(r, r, gap) & clear_of_end(entry.time))), entry.time,
          entry.normal, (center + path * all(entry.time)) - entry.normal * packed::all(r + gap / 2), entry.rounds};
}

THINWALL_HOT ClearToi clear_impact(const Moving<Aabb<double>>& a, const Moving<Aabb<double>>& b, double gap) {
  using packed::Lanes, packed::lanes, packed::all, packed::both;
  const Lanes half_a = lanes(a.shape.half_extents), half_b = lanes(b.shape.half_extents), zero = all(0);
  const Lanes center_a = lanes(a.shape.center), center_b = lanes(b.shape.center);
  const Lanes path_a = lanes(a.displacement), path_b = lanes(b.displacement), v = path_b - path_a;
  const ClearSlabs slabs(center_b - center_a, v, half_a + half_b, zero, ClearEntry::never);
  const Lanes time = all(slabs.first), at_a = center_a + path_a * time, at_b = center_b + path_b * time;
  const Lanes point = (max(at_a - half_a, at_b - half_b) + min(at_a + half_a, at_b + half_b)) * all(0.5);
  const ClearSlabs::Last last = slabs.last_entered();
  const bool sizes = all_of((zero <= min(half_a, half_b)) & slabs.in_range);
  return {both(both(sizes, last.clear), both(all_of(clear_of_end(slabs.time)), gap == 0)), slabs.time,
          clear_face_normal(last.axis, v), point};
}

/// As against an aligned box, in the box's own axes. A face that is straight is met as exactly as they are: what turning rounds of a place counts
/// along one. Beside an edge or a corner, or where faces lean, the time is told once more, by the plane of contact, whose normal n is the world's,
/// and g in the box's: what does not count along it goes. Not clear where the plane moves it by more than turning rounds, as that of a long face
/// does whose normal is off, or so far along that the ball curves.
THINWALL_HOT ClearToi clear_impact(const Moving<Obb<double>>& box, const Moving<Sphere<double>>& sphere, double gap) {
  using packed::Lanes, packed::Pair, packed::PairMask, packed::all, packed::both, packed::lanes;
  const double r = sphere.shape.radius;
  const Pair R = both(r + gap);
  const ClearFrame frame(box.shape.axes);
  const Lanes center = lanes(sphere.shape.center), path = lanes(sphere.displacement), h = lanes(box.shape.half_extents);
  const Lanes p = center - lanes(box.shape.center), v = path - lanes(box.displacement);
  // in axes of length a, R is R a and h is h a^2
  const Lanes reach = h + (h + all(R * both(0.5))) * (frame.squares - all(1));
  const ClearEntry entry = clear_box_entry<true>(frame.into(p), frame.into(v), max(reach, all(0)), R);
  Lanes normal = frame.out_of(entry.normal * frame.per_length());  // a face's
  Pair time = entry.time;
  PairMask sure = clear_of_end(time);
  Lanes point = (center + path * all(time)) - normal * all(r + gap / 2);
  const bool is_straight = frame.is_straight(h, p);
  if (entry.rounds > 1 || !is_straight) {
    const Lanes turned = frame.out_of(entry.normal), own = frame.into(turned), none = all(0);
    const packed::LanesMask along = abs(entry.normal) <= none;  // across its axis: what it leans there is rounding
    const Lanes n = turned - frame.out_of(keep(along, own)), g = select(along, none, abs(own)) * h;
    const Pair square = dot(n, n), toward = two_sums(n * p, n * v), closing = both(0) - seconds(toward);
    normal = nearer_unit(n, square);
    const Pair plane = (firsts(toward) - (R * (both(0.5) + square * both(0.5)) + sum(g))) / closing;
    const Pair sizes = two_sums(abs(p) + h, abs(v)), size = firsts(sizes), shift = abs(plane - time);
    const PairMask misses = both(ClearEntry::never) <= time;
    sure = misses | ((shift * closing <= size * both(is_straight ? 0x1p-51 : 0x1p-48)) &
                     (shift * seconds(sizes) <= R * both(0x1p-26)));
    time = select(misses, time, max(plane, both(0)));
    sure = sure & clear_of_end(time, closing, size * both(0x1p-44));
    const Lanes on = held_within(frame.into(p + v * all(time)), h);
    point =
        ((lanes(box.shape.center) + lanes(box.displacement) * all(time)) + frame.out_of(on)) + normal * all(gap / 2);
  }
  return {both(both(entry.clear, all_of(frame.clear() & (all(0) <= h) & (h <= all(packed::most_length)))),
               all_of(clear_sizes(r, r, gap) & sure)),
          time, normal, point, entry.rounds};
}

THINWALL_HOT ClearToi clear_impact(const Moving<Capsule<double>>& capsule, const Moving<Sphere<double>>& sphere,
                                   double gap) {
  using packed::Lanes, packed::all, packed::both, packed::lanes, packed::twice;
  const double r = sphere.shape.radius, s = capsule.shape.radius;
  const auto ends = twice(sphere.shape.center) - packed::side_by_side(capsule.shape.a, capsule.shape.b);
  const auto along = twice(sphere.displacement) - twice(capsule.displacement);
  const ClearSide line(ends, along, twice(capsule.shape.b) - twice(capsule.shape.a), both(r + s + gap));
  const ClearSegmentEntry entry = clear_segment_entry(line, ends, along);
  const Lanes center = lanes(sphere.shape.center), path = lanes(sphere.displacement), a = lanes(capsule.shape.a);
  const Lanes p = center - a, v = path - lanes(capsule.displacement), core = lanes(capsule.shape.b) - a;
  const Lanes time = all(entry.time);
  const ClearSegmentNormal out(entry, line, (p - core * all(entry.on)) + v * time);
  return {all_of(entry.clear & out.clear & clear_sizes(r, s, gap) & clear_of_end(entry.time)), entry.time, out.normal,
          (center + path * time) - out.normal * all(r + gap / 2)};
}

/// Two boxes, `a` by its half extents and its axes, and the answer from a to b.
template <class FrameA, class BoxA>
THINWALL_HOT ClearToi clear_boxes_impact(const FrameA& of_a, const BoxA& a, const ClearFrame& of_b,
                                         const Moving<Obb<double>>& b, const packed::Vectors<packed::Lanes>& rows,
                                         double gap) {
  using packed::Lanes, packed::all, packed::both, packed::lanes;
  const Lanes center = lanes(a.shape.center), path = lanes(a.displacement), ha = lanes(a.shape.half_extents);
  const Lanes between = lanes(b.shape.center) - center, v = lanes(b.displacement) - path,
              hb = lanes(b.shape.half_extents);
  const ClearBoxes boxes(of_a, ha, of_b, hb, rows, between, v);
  const packed::PairMask in_time =
      clear_of_end(boxes.time, both(0) - dot(boxes.normal, v), sum(abs(between) + (ha + hb)) * both(0x1p-44));
  return {both(both(boxes.clear, gap == 0), all_of(in_time)), boxes.time, boxes.normal,
          (center + path * all(boxes.time)) + boxes.from_a};
}
THINWALL_HOT ClearToi clear_impact(const Moving<Obb<double>>& b, const Moving<Aabb<double>>& a, double gap) {
  const ClearFrame of_b(b.shape.axes);
  ClearToi toi = clear_boxes_impact(ClearUpright{}, a, of_b, b, of_b.rows, gap);
  toi.normal = packed::all(0) - toi.normal;
  return toi;
}
THINWALL_HOT ClearToi clear_impact(const Moving<Obb<double>>& a, const Moving<Obb<double>>& b, double gap) {
  const ClearFrame of_a(a.shape.axes), of_b(b.shape.axes);
  return clear_boxes_impact(of_a, a, of_b, b, of_b.into(of_a), gap);
}

THINWALL_HOT ClearToi clear_impact(const Moving<Capsule<double>>& a, const Moving<Capsule<double>>& b, double gap) {
  using packed::Lanes, packed::all, packed::both, packed::lanes;
  const double r = a.shape.radius, s = b.shape.radius;
  const Lanes start = lanes(a.shape.a), path = lanes(a.displacement), from_b = lanes(b.shape.a);
  const Lanes p = from_b - start, v = lanes(b.displacement) - path, core = lanes(a.shape.b) - start;
  const ClearFlatEntry entry(ClearFlat::parallelogram(core, from_b - lanes(b.shape.b)), p, v, both(r + s + gap));
  const packed::PairMask one = entry.broad | (both(1) < entry.time);
  return {both(entry.clear, all_of(one & clear_sizes(r, s, gap) & clear_of_end(entry.time))), entry.time, entry.normal,
          ((start + path * all(entry.time)) + core * all(entry.s)) + entry.normal * all(r + gap / 2)};
}

THINWALL_HOT ClearToi clear_impact(const Moving<Triangle<double>>& triangle, const Moving<Sphere<double>>& sphere,
                                   double gap) {
  using packed::Lanes, packed::all, packed::both, packed::lanes;
  const double r = sphere.shape.radius;
  const Lanes center = lanes(sphere.shape.center), path = lanes(sphere.displacement), a = lanes(triangle.shape.a);
  const ClearFlat core = ClearFlat::triangle({lanes(triangle.shape.b) - a, lanes(triangle.shape.c) - a});
  const ClearFlatEntry entry(core, center - a, path - lanes(triangle.displacement), both(r + gap));
  return {both(entry.clear, all_of(clear_sizes(r, r, gap) & clear_of_end(entry.time))), entry.time, entry.normal,
          (center + path * all(entry.time)) - entry.normal * all(r + gap / 2)};
}

THINWALL_HOT ClearToi clear_impact(const Moving<Capsule<double>>& capsule, const Moving<Triangle<double>>& triangle,
                                   double gap) {
  using packed::Lanes, packed::all, packed::both, packed::lanes;
  const double r = capsule.shape.radius;
  const Lanes a = lanes(triangle.shape.a), path = lanes(triangle.displacement);
  const Lanes start = lanes(capsule.shape.a), end = lanes(capsule.shape.b), v = lanes(capsule.displacement) - path;
  const ClearPrism prism(lanes(triangle.shape.b) - a, lanes(triangle.shape.c) - a, end - start);
  const ClearPrismEntry entry(prism, start - a, end - a, v, both(r + gap));
  return {both(entry.clear, all_of(clear_sizes(r, r, gap) & clear_of_end(entry.time))), entry.time,
          all(0) - entry.normal, ((a + path * all(entry.time)) + entry.on) + entry.normal * all(gap / 2),
          std::max(entry.rounds, 1)};
}

/// In the box's own axes; and where they are turned, the time once more by the plane of contact, as of a sphere and an oriented box.
template <class Frame, class Box>
THINWALL_HOT ClearToi clear_capsule_box(const Moving<Capsule<double>>& capsule, const Frame& frame, const Box& box,
                                        double gap) {
  using packed::Lanes, packed::Pair, packed::all, packed::both, packed::lanes;
  const double r = capsule.shape.radius;
  const Lanes center = lanes(box.shape.center), path = lanes(box.displacement);
  const Lanes a = lanes(capsule.shape.a), d = lanes(capsule.shape.b) - a;
  const Lanes p = a - center, v = lanes(capsule.displacement) - path, h = lanes(box.shape.half_extents);
  const ClearSegmentBox core(frame.into(d), h, frame.into(v));
  const Lanes start = frame.into(p);
  const ClearWalk walk = clear_walk(core, start, both(r + gap));
  const Lanes on = held_within((start + core.v * all(walk.time)) + core.d * all(walk.nearest.place), h);
  Lanes normal = walk.normal;
  Pair time = walk.time, closing = walk.closing;
  if constexpr (Frame::is_turned) {
    const Lanes n = frame.out_of(walk.normal), g = frame.into(n);
    const Pair toward = two_sums(n * (p + d * all(walk.nearest.place)), n * v), sums = two_sums(n * n, g * on);
    const Pair length = root(firsts(sums));
    closing = both(0) - seconds(toward);
    const Pair plane = (firsts(toward) - (both(r + gap) * length + seconds(sums))) / closing;
    time = select(walk.time < both(ClearEntry::never), max(plane, both(0)), walk.time);
    normal = n / all(length);
  }
  const bool plain = all_of(clear_sizes(r, r, gap) & clear_of_end(time, closing, walk.noise));
  return {both(both(walk.clear, plain), all_of(frame.clear() & (all(0) <= h))), time, all(0) - normal,
          ((center + path * all(time)) + frame.out_of(on)) + normal * all(gap / 2), walk.rounds};
}
THINWALL_HOT ClearToi clear_impact(const Moving<Capsule<double>>& capsule, const Moving<Aabb<double>>& box,
                                   double gap) {
  return clear_capsule_box(capsule, ClearUpright{}, box, gap);
}
THINWALL_HOT ClearToi clear_impact(const Moving<Capsule<double>>& capsule, const Moving<Obb<double>>& box, double gap) {
  return clear_capsule_box(capsule, ClearFrame(box.shape.axes), box, gap);
}

/// This pair has a clear rung.
template <class A, class B>
concept HasClearImpact = requires(const Moving<A>& a, const Moving<B>& b) { clear_impact(a, b, 0.0); };

}  // namespace thinwall
