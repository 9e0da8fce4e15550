#pragma once
/// Manifolds of the capsule. Where its core runs along the face of contact of a box or a triangle, or along the core of
/// another capsule, they touch along a line: the two ends of the stretch they share are the points of contact. (Cores
/// may be skew by half the digits of S; the two points of an end then lie on one line along the normal to that.)
/// Source: derived here.

#include <algorithm>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/boxes/box_manifold.hpp>

namespace thinwall {

/// The stretch [first, last] of a segment's parameters; empty if first > last.
template <Scalar S> struct Stretch {
  S first = 0;  ///< [1]
  S last = 1;   ///< [1]

  /// The part inside a plane, given how far inside the segment's ends lie; within `noise` [length] of it is inside.
  Stretch inside(const S& start, const S& end, const S& noise) const {
    if (start >= -noise && end >= -noise) return *this;
    if (start < -noise && end < -noise) return {S(1), S(0)};
    const S crossing = clamp01(S(start / (start - end)));
    return start < end ? Stretch{std::max(first, crossing), last} : Stretch{first, std::min(last, crossing)};
  }
};

/// The point of another core that a point of the capsule's core faces along the contact normal.
template <Scalar S> struct FacingPoint {
  S height;       ///< [length] from the capsule's core, along the normal
  Vec3<S> local;  ///< [length] relative to the other shape's center
};

/// The contacts at both ends of the stretch, the deeper one first. Ends that lie apart are left out; empty if the
/// stretch is no longer than `noise` [length]. The normal is at right angles to the core; facing(s) is the point
/// across.
template <Scalar S, class Facing>
Manifold<S> ends_of_stretch(const Capsule<S>& capsule, const S& other_radius, const Vec3<S>& normal,
                            const Stretch<S>& stretch, const S& noise, const Facing& facing) {
  const Vec3<S> core = capsule.b - capsule.a;
  Manifold<S> manifold;
  if (!((stretch.last - stretch.first) * safe_norm(core) > noise)) return manifold;
  for (const S& s : {stretch.first, stretch.last}) {
    const FacingPoint<S> other = facing(s);
    const S penetration = capsule.radius + other_radius - other.height;
    if (penetration < -noise) continue;
    manifold.contacts[static_cast<std::size_t>(manifold.count++)] = {core * (s - S(1) / S(2)) + normal * capsule.radius,
                                                                     other.local - normal * other_radius, normal,
                                                                     std::max(S(0), penetration)};
  }
  if (manifold.count == 2 && manifold[1].penetration > manifold[0].penetration) {
    std::swap(manifold.contacts[0], manifold.contacts[1]);
  }
  return manifold;
}

template <Scalar S> Manifold<S> touching_manifold(const Capsule<S>& capsule, const Aabb<S>& box) {
  const CoreGap<S> gap = core_gap(capsule, box);
  const Vec3<S> core = capsule.b - capsule.a, start = capsule.a - box.center, end = capsule.b - box.center;
  const Vec3<S>& h = box.half_extents;
  const int face = axis_along(gap.normal, parallel_sine<S>());
  if (face < 0 || !nearly_perpendicular(safe_unit(core), axis_vector<S>(face))) return single_point(capsule, box, gap);
  const S side = gap.normal[face] < S(0) ? S(-1) : S(1), noise = gap_noise(largest(start, core, h));
  Stretch<S> stretch;
  for (int i = 0; i < 3; ++i) {
    if (i != face)
      stretch = stretch.inside(h[i] - start[i], h[i] - end[i], noise).inside(h[i] + start[i], h[i] + end[i], noise);
  }
  const Manifold<S> ends = ends_of_stretch<S>(capsule, S(0), axis_vector<S>(face, side < S(0)), stretch, noise,
                                              [&](const S& s) -> FacingPoint<S> {
                                                Vec3<S> point = Vec3<S>(start + core * s).cwiseMin(h).cwiseMax(-h);
                                                point[face] = -side * h[face];
                                                return {-h[face] - side * (start[face] + core[face] * s), point};
                                              });
  return ends.empty() ? single_point(capsule, box, gap) : ends;
}

template <Scalar S> Manifold<S> touching_manifold(const Capsule<S>& capsule, const Obb<S>& box) {
  return out_of(box, touching_manifold(into(box, capsule), own_aabb(box)));
}

template <Scalar S> Manifold<S> touching_manifold(const Capsule<S>& capsule, const Triangle<S>& triangle) {
  const CoreGap<S> gap = core_gap(capsule, triangle);
  const Vec3<S> core = capsule.b - capsule.a, start = capsule.a - triangle.a, up = plane_normal(triangle);
  if (up == Vec3<S>::Zero() || !nearly_parallel(gap.normal, up) || !nearly_perpendicular(safe_unit(core), up)) {
    return single_point(capsule, triangle, gap);
  }
  const Vec3<S> normal = gap.normal.dot(up) < S(0) ? Vec3<S>(-up) : up;
  const std::array<Vec3<S>, 3> corners{Vec3<S>::Zero(), triangle.b - triangle.a, triangle.c - triangle.a};
  const S noise = gap_noise(largest(start, core, corners[1], corners[2]));
  Stretch<S> stretch;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3<S>& corner = corners[k];
    Vec3<S> inward = cross(up, safe_unit<S>(corners[(k + 1) % 3] - corner));
    if (inward.dot(corners[(k + 2) % 3] - corner) < S(0)) inward = -inward;
    stretch = stretch.inside(inward.dot(start - corner), inward.dot(start + core - corner), noise);
  }
  // Past the tip of a needle, whose sides are all but parallel, rounding would let a core that runs along it out.
  const Vec3<S> ahead = safe_unit(core);
  const auto [low, high] = std::minmax({S(0), S(ahead.dot(corners[1])), S(ahead.dot(corners[2]))});
  const S from = ahead.dot(start), to = ahead.dot(start + core);
  stretch = stretch.inside(from - low, to - low, noise).inside(high - from, high - to, noise);
  const Vec3<S> middle = center(triangle) - triangle.a;
  bool faces = true;  // of a triangle that is hardly wider than rounding the core may run beside it
  const Manifold<S> ends = ends_of_stretch<S>(capsule, S(0), normal, stretch, noise, [&](const S& s) -> FacingPoint<S> {
    const Vec3<S> point = start + core * s;
    const S height = -point.dot(normal);
    const Vec3<S> foot = point + normal * height;
    faces = faces && largest(gap_from_triangle<S>(foot, {corners[0], corners[1], corners[2]})) <= 4 * noise;
    return {height, foot - middle};
  });
  return ends.empty() || !faces ? single_point(capsule, triangle, gap) : ends;
}

/// Degenerate: cores that cross touch in one point; so do cores that share no more than skewness feigns.
template <Scalar S> Manifold<S> touching_manifold(const Capsule<S>& a, const Capsule<S>& b) {
  const CoreGap<S> gap = core_gap(a, b);
  const Vec3<S> between = b.a - a.a, core_a = a.b - a.a, core_b = b.b - b.a;
  const Vec3<S> unit = safe_unit(core_a);
  const Vec3<S> normal = gap.normal == Vec3<S>::Zero() ? arbitrary_normal(gap.along) : gap.normal;
  if (!nearly_parallel(unit, safe_unit(core_b)) || !nearly_perpendicular(normal, unit)) return single_point(a, b, gap);
  const S first = closest_parameter(between, core_a), last = closest_parameter<S>(between + core_b, core_a);
  const Stretch<S> stretch{std::min(first, last), std::max(first, last)};
  const S size = largest(between, core_a, core_b);
  if (!((stretch.last - stretch.first) * safe_norm(core_a) > parallel_sine<S>() * size)) return single_point(a, b, gap);
  const Manifold<S> ends = ends_of_stretch<S>(
      a, b.radius, normal, stretch, gap_noise(largest(size, a.radius, b.radius)), [&](const S& s) -> FacingPoint<S> {
        const S t = closest_parameter<S>(core_a * s - between, core_b);
        return {(between + core_b * t - core_a * s).dot(normal), core_b * (t - S(1) / S(2))};
      });
  return ends.empty() ? single_point(a, b, gap) : ends;
}

}  // namespace thinwall
