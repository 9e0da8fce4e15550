#pragma once
/// Two boxes whose shortest way out is across a face of one of them: where on that face they meet.
/// Source: derived here. The normal of least overlap leads to a point of the face, so that clipping leaves one at
/// least.

#include <thinwall/discrete/boxes/box_pair.hpp>
#include <thinwall/discrete/boxes/face_polygon.hpp>
#include <thinwall/discrete/directions.hpp>

namespace thinwall {

/// The same two boxes, A and B exchanged, in B's axes.
template <Scalar S> BoxPair<S> seen_from_b(const BoxPair<S>& pair) {
  return {pair.half_b, pair.half_a, -(pair.axes.transpose() * pair.between), pair.axes.transpose()};
}

/// A face of one of the two boxes.
struct BoxFace {
  int axis = -1;          ///< the axis across the face, 0 to 2; -1: no face
  bool of_b = false;      ///< whose
  bool negative = false;  ///< on the negative side of that axis
};

/// The face that the unit vector n, from A to B, is normal to, up to this sine; one of A's before one of B's.
template <Scalar S> BoxFace face_along(const BoxPair<S>& pair, const Vec3<S>& n, const S& sine) {
  const int axis_a = axis_along(n, sine);
  if (axis_a >= 0) return {axis_a, false, n[axis_a] < S(0)};
  const Vec3<S> outward_b = -(pair.axes.transpose() * n);
  const int axis_b = axis_along(outward_b, sine);
  return axis_b < 0 ? BoxFace{} : BoxFace{axis_b, true, outward_b[axis_b] < S(0)};
}

/// The rounding of a length computed from the two.
template <Scalar S> S box_noise(const BoxPair<S>& pair) {
  return gap_noise(largest(pair.between, pair.half_a, pair.half_b));
}

/// The face of B that looks most squarely at the face of A across `axis`, clipped to it: in the coordinates of
/// face_polygon.hpp, x and y along A's next two axes, z the depth below A's face.
template <Scalar S> FacePolygon<S> facing_polygon(const BoxPair<S>& pair, int axis, bool negative) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  int incident = 0;
  for (int j = 1; j < 3; ++j) {
    if (largest(pair.axes(axis, j)) > largest(pair.axes(axis, incident))) incident = j;
  }
  const auto over_face = [&](const Vec3<S>& p) -> Vec3<S> { return {p[u], p[v], negative ? p[axis] : S(-p[axis])}; };
  const auto half_edge = [&](int j) -> Vec3<S> { return over_face(pair.axes.col(j)) * pair.half_b[j]; };
  const Vec3<S> outward = half_edge(incident);
  Vec3<S> middle = over_face(pair.between) + (outward[2] < S(0) ? Vec3<S>(-outward) : outward);
  middle[2] += pair.half_a[axis];
  return parallelogram_over_face<S>(middle, half_edge((incident + 1) % 3), half_edge((incident + 2) % 3),
                                    pair.half_a[u], pair.half_a[v]);
}

/// A point of such a polygon, on B, and the point of A's face above it.
template <Scalar S> BoxPoints<S> points_at(const BoxPair<S>& pair, int axis, bool negative, const Vec3<S>& over_face) {
  const S side = negative ? S(-1) : S(1);
  BoxPoints<S> points;
  points.on_a[(axis + 1) % 3] = over_face[0];
  points.on_a[(axis + 2) % 3] = over_face[1];
  points.on_b = points.on_a;
  points.on_a[axis] = side * pair.half_a[axis];
  points.on_b[axis] = side * (pair.half_a[axis] - over_face[2]);
  return points;
}

/// The deepest points of boxes that part along the face of A across `axis`: the corner of B that is farthest inside, or
/// where B lies along the face, to rounding, the middle of what the two share. A corner beside the face (the axes of a box
/// given in float are not quite at right angles in double) counts as lying along it.
template <Scalar S> BoxPoints<S> deepest_points_on_face(const BoxPair<S>& pair, int axis, bool negative) {
  const S side = negative ? S(-1) : S(1), noise = box_noise(pair);
  const Vec3<S> inward = pair.axes.row(axis).transpose() * -side;
  BoxPoints<S> points;
  points.on_b = pair.between + pair.axes * pair.half_b.cwiseProduct(farthest_corner(inward));
  points.on_a = points.on_b;
  points.on_a[axis] = side * pair.half_a[axis];
  bool alongside = false;
  for (int k = 0; k < 3; ++k) {
    alongside = alongside || (pair.half_b[k] > S(0) && largest(inward[k]) * pair.half_b[k] <= noise) ||
                largest(points.on_a[k]) > pair.half_a[k] + noise;
  }
  if (!alongside) return points;
  const FacePolygon<S> polygon = facing_polygon(pair, axis, negative);
  return polygon.count > 0 ? points_at(pair, axis, negative, middle_of_deepest(polygon, noise)) : points;
}

}  // namespace thinwall
