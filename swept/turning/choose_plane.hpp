#pragma once
/// Which plane to attach, seen from the closest points: along a face of either, square to an edge of each, along an edge, or none.

#include <array>

#include <thinwall/swept/turning/attached_plane.hpp>

namespace thinwall {

/// The edges of a core that lie square to a normal, to 1e-6: two of them span a face. One without length bounds nothing.
template <Scalar S> struct SquareEdges {
  std::array<Vec3<S>, 3> edge;  ///< [length] in the body's frame at the start of the step
  int count = 0;

  SquareEdges(const CoreVectors<S>& core, const Vec3<S>& normal) {
    const S square_sine = constant_power_of_two<S, -40>();
    for (int k = 0; k < core.count; ++k) {
      const auto next = static_cast<std::size_t>((k + 1) % 3), here = static_cast<std::size_t>(k);
      const Vec3<S> along = core.corners ? Vec3<S>(core.v[next] - core.v[here]) : core.v[here];
      const S length = along.squaredNorm(), on = normal.dot(along);
      if (length > S(0) && on * on <= square_sine * length) edge[static_cast<std::size_t>(count++)] = along;
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

/// The plane for closest points with this normal, a unit vector from A to B in the world.
template <Scalar S>
AttachedPlane<S> plane_from(const TurningPair<S>& pair, const TurningInstant<S>& now, const Vec3<S>& normal) {
  const Vec3<S> seen_by_a = pair.a.seen(now.turn_a, normal), seen_by_b = pair.b.seen(now.turn_b, normal);
  const SquareEdges<S> of_a(pair.a.core, seen_by_a), of_b(pair.b.core, seen_by_b);
  if (of_a.count == 1 && of_b.count == 1) {
    const Vec3<S> a = safe_unit(of_a.edge[0]), b = safe_unit(of_b.edge[0]);
    const Vec3<S> product = cross<S>(pair.a.in_world(now.turn_a, a), pair.b.in_world(now.turn_b, b));
    constexpr S least_sine = S(1) / S(20);
    if (product.squaredNorm() > least_sine * least_sine)
      return plane_of_edges<S>(pair, a, product.dot(normal) < S(0) ? Vec3<S>(-b) : b);
  }
  if (of_a.count > 0 && of_a.count >= of_b.count) return plane_riding(pair, Rides::a, of_a.snapped(seen_by_a));
  if (of_b.count > 0) return plane_riding(pair, Rides::b, of_b.snapped(seen_by_b));
  return plane_riding(pair, Rides::world, normal);
}

/// The plane of the axis along which two boxes are farthest apart: it names a face of either, or an edge of each. A third of the price of closest
/// points, and where the gap between the shadows is what there is, as good.
template <Scalar S>
AttachedPlane<S> plane_across(const TurningPair<S>& pair, const TurningInstant<S>& now, const Obb<S>& a,
                              const Obb<S>& b, const LeastOverlap<S>& axis, const Vec3<S>& normal) {
  const auto edge = [](const Obb<S>& box, int k) { return safe_unit(Vec3<S>(box.axes.col(k))); };
  const auto from_a_to_b = [&](const Vec3<S>& v, const Vec3<S>& in_world) {
    return in_world.dot(normal) < S(0) ? Vec3<S>(-v) : v;
  };
  if (axis.axis_b < 0) {
    const Vec3<S> face = edge(a, axis.axis_a);
    return plane_riding(pair, Rides::a, from_a_to_b(face, pair.a.in_world(now.turn_a, face)));
  }
  if (axis.axis_a < 0) {
    const Vec3<S> face = edge(b, axis.axis_b);
    return plane_riding(pair, Rides::b, from_a_to_b(face, pair.b.in_world(now.turn_b, face)));
  }
  const Vec3<S> of_a = edge(a, axis.axis_a), of_b = edge(b, axis.axis_b);
  const Vec3<S> product = cross<S>(pair.a.in_world(now.turn_a, of_a), pair.b.in_world(now.turn_b, of_b));
  return plane_of_edges<S>(pair, of_a, from_a_to_b(of_b, product));
}

}  // namespace thinwall
