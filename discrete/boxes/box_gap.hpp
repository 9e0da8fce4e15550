#pragma once
/// How far apart two boxes are and where, or which way out of each other is shortest.
///
/// Closest points of boxes apart are a corner of one and the other box, or an edge of each; of the edges only the pair
/// that faces each other along their product can serve. Source: derived here.

#include <algorithm>
#include <limits>

#include <thinwall/discrete/boxes/box_faces.hpp>

namespace thinwall {

/// farthest_corner(), but to rounding, and with `side` in place of 0.
template <Scalar S> Vec3<S> facing_corner(const Vec3<S>& n, int side) {
  const S noise = gap_noise(largest(n));
  return n.unaryExpr([&](const S& x) { return x > noise ? S(1) : x < -noise ? S(-1) : S(side); });
}

/// The closest points of the two edges along axes i and j that face each other when n points from A to B. Where n is normal
/// to a face, to rounding, two of its edges face the other box alike: `side_a` and `side_b`, -1 or 1, name one of them, 0
/// the middle of the face.
template <Scalar S>
BoxPoints<S> closest_on_edges(const BoxPair<S>& pair, int i, int j, const Vec3<S>& n, int side_a = 0, int side_b = 0) {
  const Vec3<S> across = pair.direction(i, j), edge_b = pair.axes.col(j);
  Vec3<S> corner_a = pair.half_a.cwiseProduct(facing_corner(n, side_a));
  Vec3<S> corner_b = pair.half_b.cwiseProduct(facing_corner<S>(-(pair.axes.transpose() * n), side_b));
  corner_a[i] = 0;
  corner_b[j] = 0;
  const Vec3<S> start_b = pair.between + pair.axes * corner_b, r = start_b - corner_a;
  const auto clamp = [](const S& x, const S& h) { return std::min(h, std::max(S(-h), x)); };
  BoxPoints<S> points;
  S s = clamp(S(cross(r, edge_b).dot(across) / across.squaredNorm()), pair.half_a[i]);
  const S t = clamp(S(s * edge_b[i] - r.dot(edge_b)), pair.half_b[j]);
  s = clamp(S(r[i] + t * edge_b[i]), pair.half_a[i]);
  points.on_a = corner_a + axis_vector<S>(i) * s;
  points.on_b = start_b + edge_b * t;
  return points;
}

/// How many of a box's edges along `axis` face a box that lies along n: two where n is normal to a face.
template <Scalar S> int edges_facing(const Vec3<S>& n, int axis) {
  const S noise = gap_noise(largest(n));
  return largest(n[(axis + 1) % 3]) > noise && largest(n[(axis + 2) % 3]) > noise ? 1 : 2;
}

/// Closest points of boxes that are apart. Of those as near as each other, to rounding, the ones whose direction parts the
/// boxes best: distances tell directions apart only to the square root of a rounding.
template <Scalar S> BoxPoints<S> closest_points(const BoxPair<S>& pair) {
  BoxPoints<S> best;
  S least = std::numeric_limits<S>::infinity();
  const auto overlap = [&](const Vec3<S>& n) { return pair.overlap(safe_unit(n)); };
  const auto consider = [&](const Vec3<S>& on_a, const Vec3<S>& on_b) {
    const Vec3<S> gap = on_b - on_a;
    const S distance = safe_norm(gap), rounding = 4 * std::numeric_limits<S>::epsilon() * distance;
    const bool ties = largest(S(distance - least)) <= rounding;
    if (ties ? overlap(gap) < overlap(best.on_b - best.on_a) : distance < least) {
      least = distance;
      best = {on_a, on_b};
    }
  };
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3<S> sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    const Vec3<S> of_b = pair.between + pair.axes * pair.half_b.cwiseProduct(sign);
    consider(of_b.cwiseMin(pair.half_a).cwiseMax(-pair.half_a), of_b);
    const Vec3<S> of_a = pair.half_a.cwiseProduct(sign);
    const Vec3<S> in_b = pair.axes.transpose() * (of_a - pair.between);
    consider(of_a, pair.between + pair.axes * in_b.cwiseMin(pair.half_b).cwiseMax(-pair.half_b));
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3<S> n = pair.direction(i, j);
      if (n == Vec3<S>::Zero()) continue;
      const Vec3<S> towards_b = pair.between.dot(n) < S(0) ? Vec3<S>(-n) : n;
      const int sides_a = edges_facing(towards_b, i), sides_b = edges_facing<S>(pair.axes.transpose() * towards_b, j);
      for (int k = 0; k < sides_a * sides_b; ++k) {
        const BoxPoints<S> points =
            closest_on_edges<S>(pair, i, j, towards_b, k % sides_a == 0 ? -1 : 1, k < sides_a ? -1 : 1);
        consider(points.on_a, points.on_b);
      }
    }
  }
  return best;
}

/// The deepest points of boxes that part along the unit vector n, found on the axes (i, j). Edges whose product is
/// normal to a face, to rounding, meet on that face.
template <Scalar S> BoxPoints<S> deepest_points(const BoxPair<S>& pair, int i, int j, const Vec3<S>& n) {
  BoxFace face;
  if (j < 0) {
    face = {i, false, n[i] < S(0)};
  } else if (i < 0) {
    face = {j, true, pair.axes.col(j).dot(n) > S(0)};
  } else {
    face = face_along(pair, n, gap_noise(S(1)));
  }
  if (face.axis < 0) return closest_on_edges(pair, i, j, n);
  if (!face.of_b) return deepest_points_on_face(pair, face.axis, face.negative);
  const BoxPoints<S> seen = deepest_points_on_face(seen_from_b(pair), face.axis, face.negative);
  return {pair.between + pair.axes * seen.on_b, pair.between + pair.axes * seen.on_a};
}

/// The axis, of the fifteen, along which the shadows overlap least: the most negative where the boxes are apart.
template <Scalar S> struct LeastOverlap {
  S overlap = std::numeric_limits<S>::infinity();  ///< [length]
  int axis_a = 0, axis_b = -1;                     ///< as direction(); an axis whatever the numbers
  Vec3<S> normal = axis_vector<S>(0);              ///< unit, from A to B
};

/// Of equal ones the first: A's faces, B's faces, edges.
template <Scalar S> LeastOverlap<S> least_overlap(const BoxPair<S>& pair) {
  LeastOverlap<S> least;
  each_separating_axis([&](int i, int j) {
    const Vec3<S> n = pair.direction(i, j);
    const S length = safe_norm(n);
    if (length == S(0)) return true;
    const S overlap = pair.overlap(n) / length;
    if (overlap < least.overlap) {
      least = {overlap, i, j, (pair.between.dot(n) < S(0) ? Vec3<S>(-n) : n) / length};
    }
    return true;
  });
  return least;
}

/// The gap from A to B in A's axes, with B's point relative to B's center.
/// Degenerate: among axes of equal overlap the first wins: A's faces, B's faces, edges; coincident centers go positive.
template <Scalar S> CoreGap<S> box_gap(const BoxPair<S>& pair) {
  CoreGap<S> gap;
  BoxPoints<S> points;
  if (!boxes_overlap(pair)) {
    points = closest_points(pair);
    gap.distance = safe_norm<S>(points.on_b - points.on_a);
    gap.normal = safe_unit<S>(points.on_b - points.on_a);
  }
  if (gap.distance <= box_noise(pair)) {
    const LeastOverlap<S> least = least_overlap(pair);
    gap.normal = least.normal;
    points = deepest_points(pair, least.axis_a, least.axis_b, gap.normal);
    gap.distance = -least.overlap;
  }
  gap.local_a = points.on_a;
  gap.local_b = points.on_b - pair.between;
  return gap;
}

/// The same with the normal of a plane that parts the boxes by all of the gap. Beside nearly parallel faces or edges many
/// points are as near as rounding can tell, and the line through two of them may lean: then an axis parts them more.
template <Scalar S> CoreGap<S> parting_gap(const BoxPair<S>& pair) {
  CoreGap<S> gap = box_gap(pair);
  if (gap.distance > S(0)) {
    const LeastOverlap<S> axis = least_overlap(pair);
    if (axis.overlap < pair.overlap(gap.normal)) gap.normal = axis.normal;
  }
  return gap;
}

}  // namespace thinwall
