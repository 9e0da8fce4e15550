#pragma once
/// Manifolds of two boxes of any kind.
///
/// Where the contact normal is normal to a face of A or B, that face is the reference. The face of the other box that
/// looks at it most squarely, the incident face, is clipped against the reference's four sides; its corners at or below
/// the reference are the points of contact, each as deep as it lies below. Of up to eight, four are kept. Where the
/// normal is that of two edges, they meet in one point.
///
/// Source: derived here. The normal of least overlap leads to a point of the reference face, so at least one point is
/// left.

#include <thinwall/discrete/boxes/box_pair.hpp>
#include <thinwall/discrete/manifold.hpp>
#include <thinwall/discrete/obb.hpp>

namespace thinwall {

/// The manifold of face `axis` of A, towards B on the positive or negative side, in A's axes.
template <Scalar S> Manifold<S> face_manifold(const BoxPair<S>& pair, int axis, bool negative) {
  const FacePolygon<S> below = corners_below(facing_polygon(pair, axis, negative), box_noise(pair));
  const CornerChoice<S> choice = chosen_corners(below, box_noise(pair));
  Manifold<S> manifold;
  for (; manifold.count < choice.count; ++manifold.count) {
    const auto slot = static_cast<std::size_t>(manifold.count);
    const Vec3<S>& corner = below[choice.index[slot]];
    const BoxPoints<S> points = points_at(pair, axis, negative, corner);
    manifold.contacts[slot] = {points.on_a, points.on_b - pair.between, axis_vector<S>(axis, negative),
                               std::max(S(0), corner[2])};
  }
  return manifold;
}

/// A contact in B's axes, with A and B exchanged, as seen from A's axes.
template <Scalar S> Contact<S> seen_from_a(const BoxPair<S>& pair, const Contact<S>& c) {
  return {pair.axes * c.local_b, pair.axes * c.local_a, -safe_unit<S>(pair.axes * c.normal), c.penetration};
}

/// Of boxes that part along that face, in A's axes; empty if rounding leaves no point.
template <Scalar S> Manifold<S> manifold_on(const BoxFace& face, const BoxPair<S>& pair) {
  if (!face.of_b) return face_manifold(pair, face.axis, face.negative);
  return changed(face_manifold(seen_from_b(pair), face.axis, face.negative),
                 [&](const Contact<S>& c) { return seen_from_a(pair, c); });
}

/// The manifold of boxes that touch or overlap, in A's axes. Requires lengths whose products of two are in range.
template <Scalar S> Manifold<S> boxes_manifold_in_range(const BoxPair<S>& pair) {
  const LeastOverlap<S> least = least_overlap(pair);
  const BoxFace face = face_along(pair, least.normal, parallel_sine<S>());
  if (face.axis >= 0) {
    const Manifold<S> manifold = manifold_on(face, pair);
    if (!manifold.empty()) return manifold;
  }
  const BoxTouch<S> touch = touch_of(pair, least);
  Manifold<S> point;
  point.contacts[0] = {touch.points.on_a, touch.points.on_b - pair.between, touch.axis.normal,
                       std::max(S(0), touch.axis.overlap)};
  point.count = 1;
  return point;
}

/// The same at any scale.
template <Scalar S> Manifold<S> boxes_manifold(const BoxPair<S>& pair) {
  const S size = largest(pair.between, pair.half_a, pair.half_b);
  const int e = safe_exponent(size);
  if (e == 0) return boxes_manifold_in_range(pair);
  return scaled(boxes_manifold_in_range(scaled(pair, -e)), e);
}

/// A manifold given in the box's own axes, in the world's.
template <Scalar S> const Manifold<S>& out_of(const Aabb<S>&, const Manifold<S>& manifold) { return manifold; }
template <Scalar S> Manifold<S> out_of(const Obb<S>& box, const Manifold<S>& manifold) {
  return changed(manifold, [&](const Contact<S>& c) -> Contact<S> {
    return {out_of(box, c.local_a), out_of(box, c.local_b), normal_out_of(box, c.normal), c.penetration};
  });
}

template <Scalar S> Manifold<S> touching_manifold(const Obb<S>& a, const Obb<S>& b) {
  return out_of(a, boxes_manifold(box_pair(a, b)));
}
template <Scalar S> Manifold<S> touching_manifold(const Obb<S>& a, const Aabb<S>& b) {
  return flipped(boxes_manifold(box_pair(b, a)));
}

/// The clear rung: true if `made`, empty before, holds the answer. Which axis is that of least overlap is clear if it is one alone, but for
/// roundings; of a face the rest is the careful rung's, and edges meet in the point of clear_contact(), unless their product is all but normal
/// to a face.
template <class BoxA> bool clear_box_manifold(const BoxA& a, const Obb<double>& b, Manifold<double>& made) {
  const auto boxes = clear_two_boxes(a, b);
  const ClearOverlaps overlaps(boxes.pair.axes(), boxes.pair.d);
  if (!boxes.pair.clear || overlaps.apart()) return boxes.pair.clear;
  const unsigned least = boxes.pair.axes().one_axis_of(overlaps.least().axes);
  const ClearAxis& axis = ClearAxis::of(least);
  if (!overlaps.within() || !axis.alone) return false;
  if (axis.edge_a == 0) {
    const BoxPair<double> pair = box_pair(a, b);
    const bool of_b = axis.its > 0;
    const double to_b = of_b ? pair.between.dot(pair.axes.col(axis.b)) : pair.between[axis.a];
    if (!all_of(boxes.pair.noise < abs(packed::both(to_b)))) return false;  // either side: contact() tells which
    made = out_of(a, manifold_on<double>({of_b ? axis.b : axis.a, of_b, (to_b > 0) == of_b}, pair));
    return !made.empty();
  }
  const ClearFeatures edges(boxes.pair, least);
  const packed::Lanes &n = edges.facing.n, sine = packed::all(0x1p-25);
  const bool off_faces =
      bits(abs(n) <= sine) == axis.edge_a && bits(abs(dot(spread(n), boxes.pair.rows)) <= sine) == axis.edge_b;
  if (!edges.edges_face || !edges.facing.clear || !off_faces) return false;
  made.contacts[0] = *boxes.contact(true, edges.facing, boxes.pair.overlap(n)).contact();
  made.count = 1;
  return true;
}
inline bool clear_manifold(const Obb<double>& a, const Obb<double>& b, Manifold<double>& made) {
  return clear_box_manifold(a, b, made);
}
inline bool clear_manifold(const Obb<double>& a, const Aabb<double>& b, Manifold<double>& made) {
  if (!clear_box_manifold(b, a, made)) return false;
  made = flipped(made);
  return true;
}

/// The corners of the rectangle that the two facing sides share.
template <Scalar S> Manifold<S> touching_manifold(const Aabb<S>& a, const Aabb<S>& b) {
  const CoreGap<S> gap = core_gap(a, b);
  const Vec3<S> between = b.center - a.center;
  const S noise = gap_noise(largest(between, a.half_extents, b.half_extents));
  Manifold<S> manifold = single_point(a, b, gap);
  for (int i = 0; i < 3; ++i) {
    if (gap.normal[i] != S(0)) continue;
    const S low = std::max(S(-a.half_extents[i]), S(between[i] - b.half_extents[i]));
    const S high = std::min(a.half_extents[i], S(between[i] + b.half_extents[i]));
    if (!(high - low > noise)) continue;  // the middle that is there already
    for (std::size_t k = 0, known = manifold.size(); k < known; ++k) {
      Contact<S>& first = manifold.contacts[k];
      Contact<S>& second = manifold.contacts[known + k];
      second = first;
      first.local_a[i] = low;
      second.local_a[i] = high;
      first.local_b[i] = low - between[i];
      second.local_b[i] = high - between[i];
    }
    manifold.count *= 2;
  }
  return manifold;
}

}  // namespace thinwall
