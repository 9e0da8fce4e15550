#pragma once
/// A segment and a box: the least way out where they cross, and the part of their Minkowski sum that a point is nearest to.

#include <algorithm>
#include <array>
#include <limits>

#include <thinwall/capsule/segment_near_box.hpp>
#include <thinwall/discrete/aabb.hpp>

namespace thinwall {

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
/// products of an edge with d, which are all the faces their Minkowski difference has.
template <Scalar S> CoreGap<S> segment_through_box(const Vec3<S>& p, const Vec3<S>& d, const Vec3<S>& h) {
  const Vec3<S> middle = p + d / S(2);
  const Vec3<S> direction = safe_unit(d);
  CoreGap<S> gap;
  S least = std::numeric_limits<S>::infinity();
  int edge = -1, face = -1;
  Vec3<S> outward = Vec3<S>::Zero();
  for (int i = 0; i < 3; ++i) {
    const S overlap = h[i] + (largest(d[i]) / 2 - largest(middle[i]));
    if (overlap < least) {
      least = overlap;
      face = i;
      outward = axis_vector<S>(i, middle[i] < S(0));
    }
  }
  for (int i = 0; i < 3; ++i) {
    const Vec3<S> n = safe_unit(cross(direction, axis_vector<S>(i)));
    if (n == Vec3<S>::Zero()) continue;
    const S overlap = h.dot(n.cwiseAbs()) - largest(S(middle.dot(n)));
    if (overlap < least) {
      least = overlap;
      edge = i;
      outward = middle.dot(n) < S(0) ? Vec3<S>(-n) : n;
    }
  }
  gap.distance = -least;
  gap.normal = -outward;
  S s = closest_parameter_to_box(p, d, h);
  if (least <= S(0)) {  // they only touch, within rounding
    gap.local_b = Vec3<S>(p + d * s).cwiseMin(h).cwiseMax(-h);
  } else if (edge < 0) {  // the deepest end; the middle of the crossing where the segment runs along the face
    const auto [first, last] =
        stretch_between_faces(p, d, h, face);  // an end beyond the face is no deeper than rounding
    if (first <= last && d[face] != S(0)) s = (d[face] > S(0)) == (outward[face] > S(0)) ? first : last;
    gap.local_b = Vec3<S>(p + d * s).cwiseMin(h).cwiseMax(-h);
    gap.local_b[face] = outward[face] * h[face];
  } else {
    Vec3<S> corner = h;
    for (int i = 0; i < 3; ++i) corner[i] = i == edge || outward[i] < S(0) ? S(-h[i]) : h[i];
    const Vec3<S> along = axis_vector<S>(edge) * (h[edge] * 2);
    const SegmentPair<S> closest = closest_on_segments<S>(corner - p, d, along);
    s = closest.s;
    gap.local_b = corner + along * closest.t;
  }
  gap.local_a = d * (s - S(1) / S(2));
  return gap;
}

/// The part of { y - s * d : y in the box [-h, h], s in [0, 1] } that is closest to x, the start of a segment beside a box.
template <Scalar S> CorePart<S> closest_on_swept_box(const Vec3<S>& x, const Vec3<S>& d, const Vec3<S>& h) {
  const S s = closest_parameter_to_box(x, d, h);
  const Vec3<S> nearest = x + d * s;
  const int end = segment_part(s);
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
  if (outside > 0 && largest(part.gap) <= gap_noise(largest(x, d, h))) {  // where it enters the box, to rounding?
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
      const bool sliver = largest(swept) <= gap_noise(largest(d)) || largest(beside) > gap_noise(largest(x, d, h));
      part.kind = sliver ? CorePart<S>::edge : CorePart<S>::face;
      if (!sliver) part.direction = swept;
      if (sliver && largest(d) > 2 * h[free_axis]) {  // edge and segment parallel, to rounding: the longer one is left
        part.direction = d;
        part.origin = x - part.gap;
      }
    }
  } else if (end == 0 && d != Vec3<S>::Zero()) {
    part.kind = CorePart<S>::edge;
    part.direction = d;
  }
  return part;
}

}  // namespace thinwall
