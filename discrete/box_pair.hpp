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

}  // namespace thinwall
