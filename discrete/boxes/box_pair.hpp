#pragma once
/// Two boxes that do not turn: one seen from the other, their faces, and the gap between them.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/boxes/face_polygon.hpp>
#include <thinwall/discrete/clear/clear_box_axes.hpp>
#include <thinwall/discrete/directions.hpp>
#include <thinwall/discrete/numbers/range.hpp>
#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

// ---- Two boxes, seen from the first one's axes: do they overlap?
//
// The separating axes are the three face normals of each box and the nine products of an edge of each. Every test
// compares true dot products along one vector n: it certifies a gap along n however short n is, so nearly parallel
// edges (whose product is almost zero) need no tolerance.
//
// Source: Ericson, Real-Time Collision Detection, 2005, section 4.4.1.

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

  EdgeAxis(const BoxPair<S>& pair, int axis_a, int axis_b)
      : i(axis_a), u((i + 1) % 3), v((i + 2) % 3), j(axis_b), on_u(-pair.axes(v, j)), on_v(pair.axes(u, j)) {}
  S along(const Vec3<S>& x) const { return x[u] * on_u + x[v] * on_v; }
  /// How far both boxes reach along n. B's true products, not A's turned ones: those are off by more than a thin overlap.
  S reach(const BoxPair<S>& pair) const {
    const int k = (j + 1) % 3, l = (j + 2) % 3;
    return (pair.half_a[u] * largest(on_u) + pair.half_a[v] * largest(on_v)) +
           (pair.half_b[k] * largest(S(pair.axes(u, k) * on_u + pair.axes(v, k) * on_v)) +
            pair.half_b[l] * largest(S(pair.axes(u, l) * on_u + pair.axes(v, l) * on_v)));
  }
};

/// The rounding of a length computed from the two.
template <Scalar S> S box_noise(const BoxPair<S>& pair) {
  return gap_noise(largest(pair.between, pair.half_a, pair.half_b));
}

/// Whether two boxes share a point, and whether roundings decide that.
struct BoxesOverlap {
  bool overlap = true, in_doubt = false;
};

template <Scalar S> BoxesOverlap boxes_overlap(const BoxPair<S>& pair) {
  BoxesOverlap answer;
  const S noise = box_noise(pair);
  const auto parts = [&answer](const S& spare, const S& unsure) {
    if (!(spare < unsure)) return false;  // nearly always, where they overlap
    answer.overlap = answer.overlap && spare >= S(0);
    answer.in_doubt = answer.in_doubt || spare > -unsure;
    return spare < -unsure;
  };
  const Mat3<S> size = pair.axes.cwiseAbs();
  const Vec3<S> spare_a = (pair.half_a + size * pair.half_b) - pair.between.cwiseAbs();
  if (parts(spare_a.minCoeff(), noise)) return {false, false};
  const Vec3<S> on_b = pair.axes.transpose() * pair.between;
  const Vec3<S> spare_b = (pair.half_b + size.transpose() * pair.half_a) - on_b.cwiseAbs();
  if (parts(spare_b.minCoeff(), noise)) return {false, false};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const EdgeAxis<S> axis(pair, i, j);
      const S spare = axis.reach(pair) - largest(axis.along(pair.between));
      if (parts(spare, noise * S(largest(axis.on_u) + largest(axis.on_v)))) return {false, false};
    }
  }
  return answer;
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

// ---- Two boxes whose shortest way out is across a face of one of them: where on that face they meet.
// Source: derived here. The normal of least overlap leads to a point of the face, so that clipping leaves one at
// least.

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

template <Scalar S> BoxPair<S> scaled(const BoxPair<S>& pair, int e) {
  return {times_power_of_two(pair.half_a, e), times_power_of_two(pair.half_b, e), times_power_of_two(pair.between, e),
          pair.axes};
}

/// The face of B that looks most squarely at the face of A across `axis`, clipped to it: seen as its polygons are,
/// x and y along A's next two axes, z the depth below A's face.
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
                                    pair.half_a[u], pair.half_a[v], box_noise(pair));
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

/// The same two points along A's face, brought nearer to where either box has a part: of a sliver that the two share, no wider than a rounding,
/// the middle is off them by as much. Along a side of A they go on until they are within B, if that is not far: in three turns at most, each by
/// 16 times the way straight there at most.
template <Scalar S> void hold_to_both(const BoxPair<S>& pair, int axis, BoxPoints<S>& points) {
  constexpr int turns = 3;
  const S most_farther(16);
  const auto held = [](const Vec3<S>& x, const Vec3<S>& half) -> Vec3<S> { return x.cwiseMin(half).cwiseMax(-half); };
  for (int turn = 0; turn < turns; ++turn) {
    const Vec3<S> in_b = pair.axes.transpose() * (points.on_b - pair.between);
    const Vec3<S> wanted = pair.axes * (held(in_b, pair.half_b) - in_b);
    Vec3<S> along = held(points.on_a + wanted, pair.half_a) - points.on_a;
    along[axis] = 0;
    if (along == Vec3<S>::Zero()) return;
    const S cosine = safe_unit(along).dot(safe_unit(wanted)),
            farther = std::min(most_farther, S(1 / (cosine * cosine)));
    const Vec3<S> step = held(points.on_a + along * farther, pair.half_a) - points.on_a;
    points.on_a += step;
    points.on_b += step;
  }
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
  const int e = safe_exponent(largest(pair.between, pair.half_a, pair.half_b));
  const FacePolygon<S> polygon = facing_polygon(scaled(pair, -e), axis, negative);
  if (polygon.count > 0) {
    const Vec3<S> middle = middle_of_deepest(polygon, times_power_of_two(noise, -e));
    points = points_at<S>(pair, axis, negative, times_power_of_two(middle, e));
    hold_to_both(pair, axis, points);
    return points;
  }
  points.on_a = points.on_a.cwiseMin(pair.half_a).cwiseMax(-pair.half_a);
  return points;
}

/// The same of boxes that lie level, `between` apart, on the face of a across `axis`.
THINWALL_HOT BoxPoints<double> points_on_level_face(const ClearBoxAxes& boxes, const packed::Lanes& between, int axis) {
  const packed::Vectors<packed::Lanes> axes_b = packed::transposed(boxes.rows.x, boxes.rows.y, boxes.rows.z);
  BoxPair<double> pair;
  store(boxes.a, pair.half_a);
  store(boxes.b, pair.half_b);
  store(between, pair.between);
  store(axes_b.x, pair.axes.data());
  store(axes_b.y, pair.axes.data() + 3);
  store(axes_b.z, pair.axes.data() + 6);
  return deepest_points_on_face(pair, axis, pair.between[axis] < 0);
}

// ---- How far apart two boxes are and where, or which way out of each other is shortest.
//
// Closest points of boxes apart are a corner of one and the other box, or an edge of each; of the edges only the pair
// that faces each other along their product can serve. Source: derived here.

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

/// The place of either box that is nearest to x.
template <Scalar S> Vec3<S> nearest_on_a(const BoxPair<S>& pair, const Vec3<S>& x) {
  return x.cwiseMin(pair.half_a).cwiseMax(-pair.half_a);
}
template <Scalar S> Vec3<S> nearest_on_b(const BoxPair<S>& pair, const Vec3<S>& x) {
  const Vec3<S> in_b = pair.axes.transpose() * (x - pair.between);
  return pair.between + pair.axes * in_b.cwiseMin(pair.half_b).cwiseMax(-pair.half_b);
}

/// The place of A that is nearest to the one given of B, and that of B nearest to it: told by coordinates, not by distances.
template <Scalar S> BoxPoints<S> brought_nearer(const BoxPair<S>& pair, const BoxPoints<S>& points) {
  const Vec3<S> on_a = nearest_on_a(pair, points.on_b);
  return {on_a, nearest_on_b(pair, on_a)};
}

/// Closest points of boxes that are apart. Distances tell directions apart only to the square root of a rounding. So of those as near as each
/// other, to rounding, the ones whose direction parts the boxes by most of their distance; and of boxes far apart, whose points that differ by all
/// of their size may be as near, those that are nearest to each other on either box.
template <Scalar S> BoxPoints<S> closest_points(const BoxPair<S>& pair) {
  BoxPoints<S> best;
  S least = std::numeric_limits<S>::infinity();
  const bool is_far = largest(pair.between) > 64 * largest(pair.half_a, pair.half_b);
  const S rounding = box_noise(pair) / 4, as_near = is_far ? S(4 * rounding) : rounding;
  const auto fault = [&](const BoxPoints<S>& points) -> S {
    const Vec3<S> gap = points.on_b - points.on_a;
    if (!is_far) return safe_norm(gap) + pair.overlap(safe_unit(gap));
    const BoxPoints<S> nearer = brought_nearer(pair, points);
    return largest(Vec3<S>(nearer.on_a - points.on_a)) + largest(Vec3<S>(nearer.on_b - points.on_b));
  };
  const auto consider = [&](const Vec3<S>& on_a, const Vec3<S>& on_b) {
    const S distance = safe_norm<S>(on_b - on_a);
    const bool ties = largest(S(distance - least)) <= as_near && std::min(distance, least) > 4 * rounding;
    if (ties ? fault({on_a, on_b}) < fault(best) : distance < least) {
      least = distance;
      best = {on_a, on_b};
    }
  };
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3<S> sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    const Vec3<S> of_b = pair.between + pair.axes * pair.half_b.cwiseProduct(sign);
    consider(nearest_on_a(pair, of_b), of_b);
    const Vec3<S> of_a = pair.half_a.cwiseProduct(sign);
    consider(of_a, nearest_on_b(pair, of_a));
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
  return is_far ? brought_nearer(pair, brought_nearer(pair, best)) : best;
}

/// The deepest points of boxes that part along the unit vector n, found on the axes (i, j). Edges whose product is
/// normal to a face, to rounding, meet on that face; and edges all but parallel where they do not meet along n, on the face nearest to it.
template <Scalar S> BoxPoints<S> deepest_points(const BoxPair<S>& pair, int i, int j, const Vec3<S>& n) {
  BoxFace face;
  if (j < 0) {
    face = {i, false, n[i] < S(0)};
  } else if (i < 0) {
    face = {j, true, pair.axes.col(j).dot(n) > S(0)};
  } else {
    face = face_along(pair, n, gap_noise(S(1)));
  }
  if (face.axis < 0) {
    const BoxPoints<S> points = closest_on_edges(pair, i, j, n);
    const Vec3<S> way = points.on_b - points.on_a;
    const bool lie_along_n = largest(Vec3<S>(way - n * way.dot(n))) <= box_noise(pair);
    if (!lie_along_n) face = face_along(pair, n, parallel_sine<S>());
    if (face.axis < 0) return points;
  }
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

/// One of the fifteen: A's faces, B's faces, edges.
template <Scalar S> LeastOverlap<S> overlap_on(const BoxPair<S>& pair, int k) {
  const int i = k < 3 ? k : k < 6 ? -1 : k / 3 - 2, j = k < 3 ? -1 : k % 3;
  const Vec3<S> n = pair.direction(i, j), towards_b = pair.between.dot(n) < S(0) ? Vec3<S>(-n) : n;
  const S length = safe_norm(n);
  if (length == S(0)) return {};
  return {pair.overlap(n) / length, i, j, towards_b / length};
}

/// Of equal ones the first.
template <Scalar S> LeastOverlap<S> least_overlap(const BoxPair<S>& pair) {
  LeastOverlap<S> least;
  for (int k = 0; k < 15; ++k) {
    const LeastOverlap<S> here = overlap_on(pair, k);
    if (here.overlap < least.overlap) least = here;
  }
  return least;
}
/// The same in lanes, of axes made of unit length.
inline LeastOverlap<double> least_overlap(const BoxPair<double>& pair) {
  using packed::Lanes, packed::all;
  const auto column = [&](int j) { return packed::lanes(pair.axes.data() + 3 * std::ptrdiff_t{j}); };
  const packed::Vectors<Lanes> rows = packed::transposed(column(0), column(1), column(2));
  const Lanes per_b = all(1.5) - dot(rows, rows) * all(0.5), half_a = packed::lanes(pair.half_a);
  const ClearOverlaps overlaps({rows * per_b, half_a, packed::lanes(pair.half_b) / per_b, all(0)},
                               packed::lanes(pair.between));
  const unsigned axes = overlaps.least().axes;
  return overlap_on(pair, axes == 0 ? 0 : std::countr_zero(axes));
}

/// The axis along which boxes that touch or overlap part soonest, and their deepest points.
template <Scalar S> struct BoxTouch {
  LeastOverlap<S> axis;
  BoxPoints<S> points;

  BoxTouch(const BoxPair<S>& pair, const LeastOverlap<S>& along)
      : axis(along), points(deepest_points(pair, along.axis_a, along.axis_b, along.normal)) {}
  /// True if the points lie along the axis from each other.
  bool faces(const S& noise) const {
    const Vec3<S> way = points.on_b - points.on_a;
    return largest(Vec3<S>(way - axis.normal * way.dot(axis.normal))) <= noise;
  }
};

/// Of axes that rounding tells apart the first whose points face each other. If there is none boxes that hardly touch have their closest
/// points: which corner is the deepest is then a rounding.
template <Scalar S> BoxTouch<S> touch_of(const BoxPair<S>& pair, const LeastOverlap<S>& least) {
  const S noise = box_noise(pair);
  BoxTouch<S> touch(pair, least);
  if (touch.faces(noise)) return touch;
  for (int k = 0; k < 15; ++k) {
    const LeastOverlap<S> axis = overlap_on(pair, k);
    if (!(axis.overlap <= touch.axis.overlap + noise)) continue;
    const BoxTouch<S> other(pair, axis);
    if (other.faces(noise)) return other;
  }
  if (largest(touch.axis.overlap) <= noise) touch.points = closest_points(pair);
  return touch;
}

/// The direction n out of the box [-h, h] at a point of its surface, without what rounding has put in: at a corner it does not lean inwards,
/// on an edge or a face not along it.
template <Scalar S> Vec3<S> leaning_outwards(const Vec3<S>& n, const Vec3<S>& point, const Vec3<S>& h, const S& noise) {
  Vec3<S> outwards = n;
  for (int i = 0; i < 3; ++i) {
    const bool on_side = largest(point[i]) >= h[i] - noise, leans_in = (n[i] > S(0)) != (point[i] > S(0));
    if (h[i] > noise && (!on_side || leans_in)) outwards[i] = 0;
  }
  return outwards;
}

/// The unit vector n from one of two near points to the other, each on its box, or what is left of it without what it leans by rounding, if
/// that parts the boxes more: over a gap hardly wider than a rounding the line through two points is hardly a direction.
template <Scalar S> Vec3<S> straightened(const BoxPair<S>& pair, const BoxPoints<S>& points, const Vec3<S>& n) {
  const S noise = box_noise(pair);
  const Vec3<S> on_b = pair.axes.transpose() * (points.on_b - pair.between);
  Vec3<S> best = n, next = n;
  const auto out_of_b = [&](const Vec3<S>& way) {
    return leaning_outwards<S>(-(pair.axes.transpose() * way), on_b, pair.half_b, noise);
  };
  for (int turn = 0; turn < 4; ++turn) {  // each box has its say twice
    next = safe_unit(turn % 2 == 0 ? Vec3<S>(-(pair.axes * out_of_b(next)))
                                   : leaning_outwards(next, points.on_a, pair.half_a, noise));
    if (next != Vec3<S>::Zero() && pair.overlap(next) < pair.overlap(best)) best = next;
  }
  return best;
}

/// The gap from A to B in A's axes, with B's point relative to B's center.
/// Degenerate: among axes of equal overlap the first wins: A's faces, B's faces, edges; coincident centers go positive.
template <Scalar S> CoreGap<S> box_gap(const BoxPair<S>& pair) {
  CoreGap<S> gap;
  BoxPoints<S> points;
  if (!boxes_overlap(pair).overlap) {
    points = closest_points(pair);
    gap.distance = safe_norm<S>(points.on_b - points.on_a);
    gap.normal = straightened(pair, points, safe_unit<S>(points.on_b - points.on_a));
  }
  if (gap.distance <= box_noise(pair)) {
    const BoxTouch<S> touch = touch_of(pair, least_overlap(pair));
    points = touch.points;
    gap.normal = touch.axis.normal;
    gap.distance = -touch.axis.overlap;
  }
  gap.local_a = points.on_a;
  gap.local_b = points.on_b - pair.between;
  return gap;
}

/// The same with the normal of a plane that parts the boxes by all of the gap, and how far it parts them. Beside nearly parallel
/// faces or edges many points are as near as rounding can tell, and an axis may part them more.
template <Scalar S> CoreGap<S> parting_gap(const BoxPair<S>& pair) {
  CoreGap<S> gap = box_gap(pair);
  if (!(gap.distance > S(0))) return gap;
  const LeastOverlap<S> axis = least_overlap(pair);
  const S along = pair.overlap(gap.normal), least = pair.overlap(axis.normal);
  if (least < along) gap.normal = axis.normal;
  gap.distance = -std::min(along, least);
  return gap;
}

}  // namespace thinwall
