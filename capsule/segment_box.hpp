#pragma once
/// The point of a segment that is closest to a box.

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <thinwall/capsule/segment.hpp>
#include <thinwall/discrete/aabb.hpp>

namespace thinwall {

/// The closest_parameter_to_box of a segment that may be nearest along a whole stretch: the middle of that stretch. Sorts the
/// s at which an axis enters or leaves its slab; between these the slope is linear, so two of them bracket its zero.
template <Scalar S> S middle_closest_parameter_to_box(const Vec3<S>& p, const Vec3<S>& d, const Vec3<S>& h) {
  std::array<S, 8> knots{S(0), S(1)};
  std::size_t count = 2;
  Vec3<S> enter = Vec3<S>::Zero(), leave = Vec3<S>::Zero();
  for (int i = 0; i < 3; ++i) {
    if (d[i] == S(0)) continue;
    const S side = d[i] > S(0) ? S(1) : S(-1);
    enter[i] = (-side * h[i] - p[i]) / d[i];
    leave[i] = (side * h[i] - p[i]) / d[i];
    for (const S& knot : {enter[i], leave[i]}) {
      if (!(knot > S(0) && knot < S(1))) continue;
      std::size_t k = count++;
      for (; knots[k - 1] > knot; --k) knots[k] = knots[k - 1];  // kept in order
      knots[k] = knot;
    }
  }
  const auto slope = [&](const S& s) {
    S sum = 0;
    for (int i = 0; i < 3; ++i) {
      if (d[i] == S(0) || (s >= enter[i] && s <= leave[i])) continue;
      const S face = (s < enter[i]) == (d[i] > S(0)) ? S(-h[i]) : h[i];
      sum += (p[i] + s * d[i] - face) * d[i];
    }
    return sum;
  };
  S falling = 0, falling_slope = 0, rising = 1, rising_slope = 0, first_zero = -1, last_zero = -1;
  for (std::size_t k = 0; k < count && rising_slope == S(0); ++k) {
    const S g = slope(knots[k]);
    if (g == S(0)) {
      if (first_zero < S(0)) first_zero = knots[k];
      last_zero = knots[k];
    } else {
      (g < S(0) ? falling : rising) = knots[k];
      (g < S(0) ? falling_slope : rising_slope) = g;
    }
  }
  if (first_zero >= S(0)) return (first_zero + last_zero) / 2;
  if (falling_slope == S(0)) return S(0);
  if (rising_slope == S(0)) return S(1);
  return falling + (rising - falling) * (falling_slope / (falling_slope - rising_slope));
}

/// Half the derivative of the squared distance from p + s * d to the box [-h, h], and by how much it grows with s.
template <Scalar S> struct BoxSlope {
  S slope = 0, growth = 0;
  int sides = 0;                                 ///< which of the box's sides the point is beyond, three values an axis
  S least = std::numeric_limits<S>::infinity();  ///< [length] by which it is, at least

  BoxSlope(const Vec3<S>& p, const Vec3<S>& d, const Vec3<S>& h, const S& s) {
    for (int i = 0; i < 3; ++i) {
      const S x = p[i] + s * d[i];
      const int side = static_cast<int>(x > h[i]) - static_cast<int>(x < -h[i]);
      slope += (x - std::min(h[i], std::max(S(-h[i]), x))) * d[i];
      growth += d[i] * d[i] * S(side * side);
      if (side != 0) least = std::min(least, S(largest(x) - h[i]));
      sides = 3 * sides + side;
    }
  }
};

/// The s in [0, 1] for which p + s * d is closest to the box [-h, h]; the middle of a whole stretch of such s.
/// The slope of the squared distance is continuous, does not decrease, and is linear while the point stays beyond the same
/// sides: Newton's steps end where the sides no longer change.
/// Error: the point is off by a few u (|p| + |d| + |h|). Source: derived here.
template <Scalar S> S closest_parameter_to_box(const Vec3<S>& p, const Vec3<S>& d, const Vec3<S>& h) {
  const S size = largest(p, d, h);
  if (const int e = safe_exponent(size); e != 0)
    return closest_parameter_to_box(times_power_of_two(p, -e), times_power_of_two(d, -e), times_power_of_two(h, -e));
  const BoxSlope<S> start(p, d, h, S(0)), end(p, d, h, S(1));
  const S noise = gap_noise(size);
  // So near a side the slope is that of a rounding, not that of a face from which d hardly leans.
  if (start.least <= noise || end.least <= noise) return middle_closest_parameter_to_box(p, d, h);
  if (start.slope > S(0)) return S(0);
  if (end.slope < S(0)) return S(1);
  if (start.slope < S(0) && end.slope > S(0)) {
    S low = 0, high = 1, s = start.slope / (start.slope - end.slope);
    BoxSlope<S> here(p, d, h, s);
    for (int round = 0; round < 6 && here.slope != S(0) && here.growth > S(0); ++round) {
      (here.slope < S(0) ? low : high) = s;
      const S next = s - here.slope / here.growth;
      if (!(next > low && next < high)) break;
      const BoxSlope<S> there(p, d, h, next);
      if (there.least <= noise) break;
      if (there.sides == here.sides) return next;
      s = next;
      here = there;
    }
  }
  return middle_closest_parameter_to_box(p, d, h);
}

// ---- A segment and a box: the least way out where they cross, and the part of their Minkowski sum that a point is nearest to.

/// The stretch [first, last] of [0, 1] on which p + s * d is between the two faces of the box [-h, h] across each axis but
/// `skipped`. Empty if first > last. No point is computed, whose rounding could put it beside a box without thickness.
template <Scalar S>
std::array<S, 2> stretch_between_faces(const Vec3<S>& p, const Vec3<S>& d, const Vec3<S>& h, int skipped = -1) {
  S first = 0, last = 1;
  for (int i = 0; i < 3; ++i) {
    if (i == skipped) continue;
    if (d[i] == S(0)) {
      if (largest(p[i]) > h[i]) return {S(1), S(0)};
      continue;
    }
    const S side = d[i] > S(0) ? S(1) : S(-1);
    first = std::max(first, S((-side * h[i] - p[i]) / d[i]));
    last = std::min(last, S((side * h[i] - p[i]) / d[i]));
  }
  return {first, last};
}

/// The least translation that parts a segment p + s d from the box [-h, h] that it touches or crosses, as a gap from
/// the segment (relative to its middle) to the box: the smallest overlap along the three face normals and the three
/// products of an edge with d, which are all the faces their Minkowski difference has. The least one ends in the inside of its face: among
/// those as small as each other, to rounding, the one whose points meet is taken.
template <Scalar S> CoreGap<S> segment_through_box(const Vec3<S>& p, const Vec3<S>& d, const Vec3<S>& h) {
  const Vec3<S> middle = p + d / S(2), direction = safe_unit(d);
  const S nearest = closest_parameter_to_box(p, d, h);
  const auto on_box = [&](const S& s) -> Vec3<S> { return Vec3<S>(p + d * s).cwiseMin(h).cwiseMax(-h); };
  CoreGap<S> gap;
  S least = std::numeric_limits<S>::infinity();
  const auto consider = [&](const Vec3<S>& outward, const S& overlap, const S& s, const Vec3<S>& point) {
    const S apart = largest(Vec3<S>((p + d * s) + outward * overlap - point));
    if (!(overlap + apart < least)) return;
    least = overlap + apart;
    gap = {S(-overlap), -outward, d * (s - S(1) / S(2)), point};
  };
  for (int i = 0; i < 3; ++i) {  // the deepest end; the middle of the crossing where the segment runs along the face
    const Vec3<S> outward = axis_vector<S>(i, middle[i] < S(0));
    const auto [first, last] = stretch_between_faces(p, d, h, i);  // an end beyond the face is no deeper than rounding
    const bool at_first = (d[i] > S(0)) == (outward[i] > S(0)), runs_along = d[i] == S(0) || !(first <= last);
    const S s = runs_along ? nearest : at_first ? first : last;
    Vec3<S> point = on_box(s);
    point[i] = outward[i] * h[i];
    consider(outward, S(h[i] + (largest(d[i]) / 2 - largest(middle[i]))), s, point);
  }
  for (int i = 0; i < 3; ++i) {
    const Vec3<S> n = safe_unit(cross(direction, axis_vector<S>(i)));
    if (n == Vec3<S>::Zero()) continue;
    const Vec3<S> outward = middle.dot(n) < S(0) ? Vec3<S>(-n) : n, edge = axis_vector<S>(i) * (h[i] * 2);
    Vec3<S> corner = h;
    for (int k = 0; k < 3; ++k) corner[k] = k == i || outward[k] < S(0) ? S(-h[k]) : h[k];
    const SegmentPair<S> closest = closest_on_segments<S>(corner - p, d, edge);
    consider(outward, S(h.dot(n.cwiseAbs()) - largest(S(middle.dot(n)))), closest.s, corner + edge * closest.t);
  }
  if (gap.distance >= S(0)) {  // they only touch, within rounding
    gap.local_a = d * (nearest - S(1) / S(2));
    gap.local_b = on_box(nearest);
  }
  return gap;
}

/// The part of { y - s * d : y in the box [-h, h], s in [0, 1] } that is closest to x, the start of a segment beside a box.
template <Scalar S> CorePart<S> closest_on_swept_box(const Vec3<S>& x, const Vec3<S>& d, const Vec3<S>& h) {
  const S s = closest_parameter_to_box(x, d, h);
  const Vec3<S> nearest = x + d * s;
  const int end = segment_part(s);
  const S size = largest(x, d, h);
  CorePart<S> part;
  part.gap = excess_of(nearest, h);
  part.id = end;
  int outside = 0, free_axis = 0, fixed_axis = 0;
  Vec3<S> corner = Vec3<S>::Zero();
  for (int i = 0; i < 3; ++i) {
    part.id = 3 * part.id + (part.gap[i] < S(0) ? 1 : part.gap[i] > S(0) ? 2 : 0);
    if (part.gap[i] == S(0)) {
      free_axis = i;
      continue;
    }
    corner[i] = part.gap[i] < S(0) ? S(-h[i]) : h[i];
    fixed_axis = i;
    ++outside;
  }
  // Above the inside of a face no one place of a segment that leans is nearest: it is where the face ends, to rounding.
  if (outside == 1 && end == 0 && d[fixed_axis] != S(0)) {
    const int i = (fixed_axis + 1) % 3, j = (fixed_axis + 2) % 3;
    const auto inside = [&](int axis) { return d[axis] != S(0) ? S(h[axis] - largest(nearest[axis])) : size; };
    const int ends = inside(i) < inside(j) ? i : j;
    if (d[ends] != S(0)) {
      constexpr std::array<int, 3> digit = {9, 3, 1};  // of the axis in `id`
      const bool below = nearest[ends] < S(0);
      part.id += digit[static_cast<std::size_t>(ends)] * (below ? 1 : 2);
      corner[ends] = below ? S(-h[ends]) : h[ends];
      free_axis = ends == i ? j : i;
      ++outside;
    }
  }
  if (outside > 0 && largest(part.gap) <= gap_noise(size)) {  // where it enters the box, to rounding?
    const auto [first, last] = stretch_between_faces(x, d, h);
    if (first <= last) outside = 0;
  }
  if (outside == 0) {  // the segment crosses the box
    const CoreGap<S> crossing = segment_through_box(x, d, h);
    part = {-1, CorePart<S>::face, x + crossing.normal * crossing.distance, crossing.normal};
    part.depth = std::max(S(0), S(-crossing.distance));
    part.gap = -crossing.normal;
    return part;
  }
  part.origin = end == 0 ? corner : Vec3<S>(corner - d * s);
  if (outside == 1) {
    part.kind = CorePart<S>::face;
    part.direction = axis_vector<S>(fixed_axis);
    part.origin = corner - d * s;
  } else if (outside == 2) {
    const Vec3<S> edge = axis_vector<S>(free_axis), swept = cross(edge, d);
    part.kind = CorePart<S>::edge;
    part.direction = edge;
    if (end == 0) {
      const Vec3<S> beside = cross(safe_unit(swept), part.gap);  // zero above the inside of a face
      const bool sliver = largest(swept) <= gap_noise(largest(d)) || largest(beside) > gap_noise(size);
      part.kind = sliver ? CorePart<S>::edge : CorePart<S>::face;
      if (!sliver) part.direction = swept;
      if (sliver) {  // edge and segment parallel, to rounding, or the edge's end: of the two lines there the longer one's
        part.origin = x - part.gap;
        if (largest(d) > 2 * h[free_axis]) part.direction = d;
      }
    }
  } else if (end == 0 && d != Vec3<S>::Zero()) {
    part.kind = CorePart<S>::edge;
    part.direction = d;
  }
  return part;
}

}  // namespace thinwall
