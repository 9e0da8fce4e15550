#pragma once
/// Which plane to attach, seen from the closest points: along a face of either, square to an edge of each, along an edge, or none.

#include <array>
#include <limits>

#include <thinwall/swept/turning/attached_plane.hpp>

namespace thinwall {

/// The edges of a core that lie square to a normal, to 1e-6: two of them span a face. One without length bounds nothing, and of a triangle
/// that is a segment one is enough.
template <Scalar S> struct SquareEdges {
  std::array<Vec3<S>, 3> edge;  ///< [length] as it is now
  int count = 0;

  SquareEdges(const CoreVectors<S>& core, const Vec3<S>& normal) {
    const S square_sine = constant_power_of_two<S, -40>();
    for (int k = 0; k < core.count; ++k) {
      const auto next = static_cast<std::size_t>((k + 1) % 3), here = static_cast<std::size_t>(k);
      const Vec3<S> along = core.corners ? Vec3<S>(core.v[next] - core.v[here]) : core.v[here];
      const S length = along.squaredNorm(), on = normal.dot(along);
      if (!(length > S(0) && on * on <= square_sine * length)) continue;
      if (core.corners && count > 0 &&
          cross(edge[0], along).squaredNorm() <= square_sine * edge[0].squaredNorm() * length)
        continue;
      edge[static_cast<std::size_t>(count++)] = along;
    }
  }
  /// The normal made square to what is nearly so: one given to rounding would turn away from its face.
  Vec3<S> snapped(const Vec3<S>& normal) const {
    if (count > 1) {
      const Vec3<S> face = safe_unit<S>(cross(edge[0], edge[1]));
      if (face != Vec3<S>::Zero()) return face.dot(normal) < S(0) ? Vec3<S>(-face) : face;
    }
    if (count == 0) return normal;
    return safe_unit<S>(normal - edge[0] * (edge[0].dot(normal) / edge[0].squaredNorm()));
  }
};

/// The plane for closest points with this normal, a unit vector from A to B.
template <Scalar S>
AttachedPlane<S> plane_from(const TurningPair<S>& pair, const TurningInstant<S>& now, const Vec3<S>& normal) {
  const SquareEdges<S> of_a(now.core_a, normal), of_b(now.core_b, normal);
  if (of_a.count == 1 && of_b.count == 1) {
    const Vec3<S> a = safe_unit(of_a.edge[0]), b = safe_unit(of_b.edge[0]), product = cross(a, b);
    const S least_sine = S(1) / S(20);
    if (product.squaredNorm() > least_sine * least_sine)
      return plane_of_edges<S>(pair, now, a, product.dot(normal) < S(0) ? Vec3<S>(-b) : b);
  }
  // What rolls about its own core takes a plane away from it: one that stands still stays as near, and bends nothing.
  const auto with = [](const TurningBody<S>& body, Rides rides) {
    const bool rolls = body.turns() && body.off_axis <= S(16) * std::numeric_limits<S>::epsilon() * body.far;
    return rolls ? Rides::world : rides;
  };
  if (of_a.count > 0 && of_a.count >= of_b.count)
    return plane_riding(pair, now, with(pair.a, Rides::a), of_a.snapped(normal));
  if (of_b.count > 0) return plane_riding(pair, now, with(pair.b, Rides::b), of_b.snapped(normal));
  return plane_riding(pair, now, Rides::world, normal);
}

/// The plane of the axis along which two boxes are farthest apart: it names a face of either, or an edge of each. A third of the price of closest
/// points, and where the gap between the shadows is what there is, as good. The boxes as they are now.
template <Scalar S>
AttachedPlane<S> plane_across(const TurningPair<S>& pair, const TurningInstant<S>& now, const Obb<S>& a,
                              const Obb<S>& b, const LeastOverlap<S>& axis) {
  const Vec3<S> normal = a.axes * axis.normal;
  const auto edge = [](const Obb<S>& box, int k) { return safe_unit(Vec3<S>(box.axes.col(k))); };
  const auto towards_b = [&](const Vec3<S>& v) { return v.dot(normal) < S(0) ? Vec3<S>(-v) : v; };
  if (axis.axis_b < 0) return plane_riding(pair, now, Rides::a, towards_b(edge(a, axis.axis_a)));
  if (axis.axis_a < 0) return plane_riding(pair, now, Rides::b, towards_b(edge(b, axis.axis_b)));
  const Vec3<S> of_a = edge(a, axis.axis_a), of_b = edge(b, axis.axis_b);
  return plane_of_edges<S>(pair, now, of_a, cross(of_a, of_b).dot(normal) < S(0) ? Vec3<S>(-of_b) : of_b);
}

}  // namespace thinwall
