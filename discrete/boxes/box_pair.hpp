#pragma once
/// Two boxes, seen from the first one's axes: do they overlap?
///
/// The separating axes are the three face normals of each box and the nine products of an edge of each. Every test
/// compares true dot products along one vector n: it certifies a gap along n however short n is, so nearly parallel
/// edges (whose product is almost zero) need no tolerance.
///
/// Source: Ericson, Real-Time Collision Detection, 2005, section 4.4.1.

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

/// The product n of A's axis i and B's axis j, unnormalized, of which two components are left.
template <Scalar S> struct EdgeAxis {
  int i, u, v;  ///< u and v follow i in turn
  int j;
  S on_u, on_v;

  THINWALL_HOT EdgeAxis(const BoxPair<S>& pair, int axis_a, int axis_b)
      : i(axis_a), u((i + 1) % 3), v((i + 2) % 3), j(axis_b), on_u(-pair.axes(v, j)), on_v(pair.axes(u, j)) {}
  THINWALL_HOT S along(const Vec3<S>& x) const { return x[u] * on_u + x[v] * on_v; }
  /// How far both boxes reach along n. B's true products, not A's turned ones: those are off by more than a thin overlap.
  THINWALL_HOT S reach(const BoxPair<S>& pair) const {
    const int k = (j + 1) % 3, l = (j + 2) % 3;
    return (pair.half_a[u] * largest(on_u) + pair.half_a[v] * largest(on_v)) +
           (pair.half_b[k] * largest(S(pair.axes(u, k) * on_u + pair.axes(v, k) * on_v)) +
            pair.half_b[l] * largest(S(pair.axes(u, l) * on_u + pair.axes(v, l) * on_v)));
  }
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
  const Mat3<S> size = pair.axes.cwiseAbs();
  const Vec3<S> reach_a = pair.half_a + size * pair.half_b;
  if ((pair.between.cwiseAbs().array() > reach_a.array()).any()) return false;
  const Vec3<S> reach_b = pair.half_b + size.transpose() * pair.half_a;
  const Vec3<S> on_b = pair.axes.transpose() * pair.between;
  if ((on_b.cwiseAbs().array() > reach_b.array()).any()) return false;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const EdgeAxis<S> axis(pair, i, j);
      if (largest(axis.along(pair.between)) > axis.reach(pair)) return false;
    }
  }
  return true;
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

}  // namespace thinwall
