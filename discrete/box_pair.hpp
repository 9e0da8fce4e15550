#pragma once
/// Two boxes, seen from the first one's axes: do they overlap, how far apart are they, and which way out is shortest.
///
/// The separating axes are the three face normals of each box and the nine products of an edge of each. Every test
/// compares true dot products along one vector n: it certifies a gap along n however short n is, so nearly parallel
/// edges (whose product is almost zero) need no tolerance. Closest points of boxes apart are a corner of one and the
/// other box, or an edge of each; of the edges only the pair that faces each other along their product can serve.
///
/// Source: Ericson, Real-Time Collision Detection, 2005, section 4.4.1, for the axes; closest points derived here.

#include <algorithm>
#include <limits>

#include <thinwall/discrete/aabb.hpp>

namespace thinwall {

template <Scalar S> struct BoxPair {
  Vec3<S> half_a, half_b;  ///< [length] half extents
  Vec3<S> between;         ///< [length] from A's center to B's, in A's axes
  Mat3<S> axes;            ///< B's axes in A's axes, as columns

  /// The product of A's axis i and B's axis j, or of one axis with itself where the other index is -1: n, unnormalized.
  Vec3<S> direction(int i, int j) const {
    if (j < 0) return axis_vector<S>(i);
    if (i < 0) return axes.col(j);
    return cross<S>(axis_vector<S>(i), axes.col(j));
  }
  S reach_a(const Vec3<S>& n) const { return half_a.dot(n.cwiseAbs()); }
  S reach_b(const Vec3<S>& n) const {
    return half_b[0] * largest(S(n.dot(axes.col(0)))) + half_b[1] * largest(S(n.dot(axes.col(1)))) +
           half_b[2] * largest(S(n.dot(axes.col(2))));
  }
  /// |n| times the overlap of the two shadows on n; < 0 where they are apart.
  S overlap(const Vec3<S>& n) const { return (reach_a(n) + reach_b(n)) - largest(S(between.dot(n))); }
};

/// Calls visit(i, j) for the 15 axes, the faces' first, until it returns false.
template <class Visit> bool each_separating_axis(const Visit& visit) {
  for (int i = 0; i < 3; ++i) {
    if (!visit(i, -1)) return false;
  }
  for (int j = 0; j < 3; ++j) {
    if (!visit(-1, j)) return false;
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!visit(i, j)) return false;
    }
  }
  return true;
}

template <Scalar S> bool boxes_overlap(const BoxPair<S>& pair) {
  return each_separating_axis([&](int i, int j) { return pair.overlap(pair.direction(i, j)) >= S(0); });
}

/// A point of each box, in A's axes, relative to A's center.
template <Scalar S> struct BoxPoints {
  Vec3<S> on_a = Vec3<S>::Zero();
  Vec3<S> on_b = Vec3<S>::Zero();
};

/// The corner signs of a box that lies farthest along n, whose components in the box's axes are given; 0 where n is
/// at right angles to an axis.
template <Scalar S> Vec3<S> farthest_corner(const Vec3<S>& n) {
  return n.unaryExpr([](const S& x) { return x > S(0) ? S(1) : x < S(0) ? S(-1) : S(0); });
}

/// The closest points of the two edges along axes i and j that face each other when n points from A to B.
template <Scalar S> BoxPoints<S> closest_on_edges(const BoxPair<S>& pair, int i, int j, const Vec3<S>& n) {
  const Vec3<S> across = pair.direction(i, j), edge_b = pair.axes.col(j);
  Vec3<S> corner_a = pair.half_a.cwiseProduct(farthest_corner(n));
  Vec3<S> corner_b = pair.half_b.cwiseProduct(farthest_corner<S>(-(pair.axes.transpose() * n)));
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

/// Closest points of boxes that are apart.
template <Scalar S> BoxPoints<S> closest_points(const BoxPair<S>& pair) {
  BoxPoints<S> best;
  S least = std::numeric_limits<S>::infinity();
  const auto consider = [&](const Vec3<S>& on_a, const Vec3<S>& on_b) {
    const S distance = safe_norm<S>(on_b - on_a);
    if (distance < least) {
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
      const BoxPoints<S> points = closest_on_edges<S>(pair, i, j, pair.between.dot(n) < S(0) ? Vec3<S>(-n) : n);
      consider(points.on_a, points.on_b);
    }
  }
  return best;
}

/// The deepest points of boxes that part along n, found on the axes (i, j).
template <Scalar S>
BoxPoints<S> deepest_points(const BoxPair<S>& pair, int i, int j, const Vec3<S>& n, const S& depth) {
  if (i >= 0 && j >= 0) return closest_on_edges(pair, i, j, n);
  BoxPoints<S> points;
  if (j < 0) {  // a face of A: the corner of B that is farthest inside, the middle of an edge or face alongside
    const Vec3<S> sign = farthest_corner<S>(-(pair.axes.transpose() * n));
    const Vec3<S> nearest = -(pair.axes.transpose() * pair.between);
    Vec3<S> own = nearest.cwiseMin(pair.half_b).cwiseMax(-pair.half_b);
    for (int k = 0; k < 3; ++k) own[k] = sign[k] == S(0) ? own[k] : S(sign[k] * pair.half_b[k]);
    points.on_b = pair.between + pair.axes * own;
    points.on_a = points.on_b + n * depth;
  } else {  // a face of B
    const Vec3<S> sign = farthest_corner(n);
    points.on_a = pair.between.cwiseMin(pair.half_a).cwiseMax(-pair.half_a);
    for (int k = 0; k < 3; ++k) points.on_a[k] = sign[k] == S(0) ? points.on_a[k] : S(sign[k] * pair.half_a[k]);
    points.on_b = points.on_a - n * depth;
  }
  return points;
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
  if (gap.distance <= gap_noise(largest(pair.between, pair.half_a, pair.half_b))) {
    S least = std::numeric_limits<S>::infinity();
    int face_a = -1, face_b = -1;
    each_separating_axis([&](int i, int j) {
      const Vec3<S> n = pair.direction(i, j);
      const S length = safe_norm(n);
      if (length == S(0)) return true;
      const S overlap = pair.overlap(n) / length;
      if (overlap < least) {
        least = overlap;
        face_a = i;
        face_b = j;
        gap.normal = (pair.between.dot(n) < S(0) ? Vec3<S>(-n) : n) / length;
      }
      return true;
    });
    points = deepest_points(pair, face_a, face_b, gap.normal, least);
    gap.distance = -least;
  }
  gap.local_a = points.on_a;
  gap.local_b = points.on_b - pair.between;
  return gap;
}

}  // namespace thinwall
