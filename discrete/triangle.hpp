#pragma once
/// The triangle: a wall of no thickness, solid from both sides. Serves spheres and rays here, capsules in capsule/.

#include <array>
#include <limits>
#include <optional>

#include <thinwall/discrete/clear/clear_triangle.hpp>
#include <thinwall/discrete/entry/core_part.hpp>
#include <thinwall/discrete/entry/flat_entry.hpp>
#include <thinwall/discrete/sphere.hpp>

namespace thinwall {

/// All points between three corners.
template <thinwall::Scalar S> struct Triangle {
  using Scalar = S;
  static constexpr int rank = 3;

  Vec3<S> a, b, c;  ///< [length] corners, in any order; on one line they make a segment, in one place a point
};
template <Scalar S> Triangle(Vec3<S>, Vec3<S>, Vec3<S>) -> Triangle<S>;

/// The centroid.
template <Scalar S> Vec3<S> center(const Triangle<S>& t) { return t.a + ((t.b - t.a) + (t.c - t.a)) / S(3); }
template <Scalar S> S skin_radius(const Triangle<S>&) { return S(0); }
template <Scalar S> S magnitude(const Triangle<S>& t) {
  return t.a.cwiseAbs().sum() + t.b.cwiseAbs().sum() + t.c.cwiseAbs().sum();
}
template <Scalar S> bool has_valid_sizes(const Triangle<S>&) { return true; }
template <Scalar S> bool valid(const Triangle<S>& t) { return is_finite(t.a) && is_finite(t.b) && is_finite(t.c); }
template <Scalar S> Triangle<S> scaled(const Triangle<S>& t, int e) {
  return {times_power_of_two(t.a, e), times_power_of_two(t.b, e), times_power_of_two(t.c, e)};
}
template <Scalar T, Scalar S> Triangle<T> cast(const Triangle<S>& t) {
  return {t.a.template cast<T>(), t.b.template cast<T>(), t.c.template cast<T>()};
}
template <Scalar S> Triangle<S> moved(const Triangle<S>& t, const Vec3<S>& by) {
  return {t.a + by, t.b + by, t.c + by};
}
template <Scalar S> Vec3<S> half_widths(const Triangle<S>& t) {
  const Vec3<S> middle = center(t);
  return (t.a - middle).cwiseAbs().cwiseMax((t.b - middle).cwiseAbs()).cwiseMax((t.c - middle).cwiseAbs());
}
template <Scalar S> Vec3<S> contact_point(const Triangle<S>&, const Vec3<S>& core_point, const Vec3<S>&) {
  return core_point;
}

/// The part of the triangle (0, e1, e2) that is closest to x: 0 the face, 1 to 3 the edges e1, e2 - e1, -e2, 4 to 6 the
/// corners they start from. Inside the face by the signs of three areas, else the nearest of the edges. Where a sign may be a rounding
/// it is the face only if its point is one of an edge too, to rounding; a triangle of no area has edges only. Requires lengths whose products
/// of four are in range.
/// Error: a few u (|x| + |e1| + |e2|). Source: derived here.
template <Scalar S> CorePart<S> closest_on_triangle(const Vec3<S>& x, const Vec3<S>& e1, const Vec3<S>& e2) {
  const S epsilon = std::numeric_limits<S>::epsilon();
  Vec3<S> normal = accurate_cross(e1, e2);
  if (const S area = largest(normal); !products_in_range(area))
    normal = times_power_of_two(normal, -binary_exponent(area));
  const std::array<Vec3<S>, 3> from{Vec3<S>::Zero(), e1, e2}, along{e1, e2 - e1, -e2};
  const S noise = S(64) * epsilon * largest(x, e1, e2);  // of a place beside an edge's line
  // outside this edge's line: only such an edge, or its end, can be nearest
  std::array<bool, 3> beyond{true, true, true};
  CorePart<S> face;
  bool sure = true;
  if (normal != Vec3<S>::Zero()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const S inwards = cross(normal, along[k]).dot(x - from[k]);
      beyond[k] = inwards < S(0);
      sure = sure && largest(inwards) > largest(normal) * largest(along[k]) * noise;
    }
    if (!beyond[0] && !beyond[1] && !beyond[2]) {
      const Vec3<S> unit = safe_unit(normal);  // its square may vanish beside a far x
      face = {0, CorePart<S>::face, Vec3<S>::Zero(), normal, unit * x.dot(unit)};
      if (sure) return face;
    }
    if (!sure) beyond = {true, true, true};
  }
  CorePart<S> part;
  S least = std::numeric_limits<S>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!beyond[k]) continue;
    const S length_square = along[k].squaredNorm();
    const Vec3<S> to_x = x - from[k];
    const S projected = along[k].dot(to_x);
    const bool at_end = projected >= length_square && length_square > S(0);
    const bool corner =
        at_end || projected <= S(0) || length_square == S(0);  // too short to have a square beside a far x
    const std::size_t start = at_end ? (k + 1) % 3 : k;
    const Vec3<S> gap = corner ? Vec3<S>(x - from[start]) : Vec3<S>(to_x - along[k] * (projected / length_square));
    const S square = gap.squaredNorm();
    // Equal to rounding: an edge's gap is square to the edge and parts the triangle by all of it, a corner's may not.
    const bool tie = largest(S(square - least)) <= 4 * epsilon * square;
    const bool nearer = tie ? !corner && part.kind == CorePart<S>::corner : !(square >= least);
    if (!nearer) continue;
    least = square;
    part = {static_cast<int>(start) + (corner ? 4 : 1), corner ? CorePart<S>::corner : CorePart<S>::edge, from[start],
            along[start], gap};
  }
  if (face.kind != CorePart<S>::face) return part;
  return largest(Vec3<S>(face.gap - part.gap)) <= noise ? face : part;
}

/// The unit normal of the plane, on the side of +x, then +y, then +z; zero for a triangle of no area.
template <Scalar S> Vec3<S> plane_normal(const Triangle<S>& t) {
  return towards_positive<S>(safe_unit(accurate_cross<S>(safe_unit<S>(t.b - t.a), safe_unit<S>(t.c - t.a))));
}

/// The part of the triangle that is closest to x, relative to corner a, at any scale; the part's `gap` alone is set.
template <Scalar S> Vec3<S> gap_from_triangle(const Vec3<S>& x, const Triangle<S>& t) {
  const Vec3<S> e1 = t.b - t.a, e2 = t.c - t.a;
  const S size = largest(x, e1, e2);
  const int e = safe_exponent(size);
  if (e == 0) return closest_on_triangle(x, e1, e2).gap;
  const CorePart<S> part =
      closest_on_triangle(times_power_of_two(x, -e), times_power_of_two(e1, -e), times_power_of_two(e2, -e));
  return times_power_of_two(part.gap, e);
}

template <Scalar S> bool cores_within(const Triangle<S>& triangle, const Sphere<S>& sphere, const S& reach) {
  const Vec3<S> x = sphere.center - triangle.a;
  if (reach == S(0)) return in_flat_set<S>(FlatShape::triangle, x, triangle.b - triangle.a, triangle.c - triangle.a);
  return within<S>(gap_from_triangle<S>(x, triangle), reach);
}

/// Degenerate: a center on the triangle leaves along the plane's normal; on a triangle of no area sideways.
template <Scalar S> CoreGap<S> core_gap(const Triangle<S>& triangle, const Sphere<S>& sphere) {
  const Vec3<S> x = sphere.center - triangle.a, e1 = triangle.b - triangle.a, e2 = triangle.c - triangle.a;
  const Vec3<S> between = gap_from_triangle(x, triangle);
  CoreGap<S> gap;
  gap.distance = safe_norm(between);
  gap.local_a = (x - between) - (e1 + e2) / S(3);
  gap.normal = gap.distance > gap_noise(largest(x, e1, e2)) ? safe_unit(between) : plane_normal(triangle);
  gap.along = largest(e1) < largest(e2) ? e2 : e1;
  return gap;
}

/// Degenerate: a ray in the plane meets the nearest edge, the normal then in the plane; a triangle of no area is met
/// only exactly. Source: flat_entry.hpp.
template <Scalar S> std::optional<RayHit<S>> ray_entry(const Ray<S>& ray, const Triangle<S>& triangle) {
  const Entry<S> entry = flat_entry<S>(FlatShape::triangle, ray.origin - triangle.a, ray.direction,
                                       triangle.b - triangle.a, triangle.c - triangle.a, ray.max_t);
  if (entry.inside && ray.max_t >= S(0)) return RayHit<S>{S(0), ray.origin, Vec3<S>::Zero()};
  if (entry.inside || !(entry.time <= ray.max_t) || !is_finite(entry.time)) return std::nullopt;
  return RayHit<S>{entry.time, ray.origin + ray.direction * entry.time, entry.normal};
}

// ---- The clear rung (clear/clear_entry.hpp).

THINWALL_HOT ClearContact clear_contact(const Triangle<double>& triangle, const Sphere<double>& sphere) {
  using packed::Lanes, packed::all, packed::lanes;
  const Lanes a = lanes(triangle.a), x = lanes(sphere.center) - a;
  const ClearTriangle core(lanes(triangle.b) - a, lanes(triangle.c) - a);
  const ClearNearest nearest = core.nearest(x);
  ClearContact contact = clear_core_contact(core, nearest, x, 0, sphere.radius);
  contact.local_a = nearest.at - (core.d + core.f) / all(3);
  contact.local_b = contact.normal * all(-sphere.radius);
  return contact;
}

/// By the volumes of the line's moment with the edges: Moeller and Trumbore, Fast, minimum storage ray-triangle intersection, 1997. Not
/// of a needle, whose plane roundings tilt; nor where one of the volumes, or the way to the plane, could be of either sign.
THINWALL_HOT ClearRayHit clear_raycast(const Ray<double>& ray, const Triangle<double>& triangle) {
  using packed::Lanes, packed::Pair, packed::PairMask, packed::all, packed::both, packed::lanes;
  const Lanes a = lanes(triangle.a), e1 = lanes(triangle.b) - a, e2 = lanes(triangle.c) - a;
  const Lanes p = lanes(ray.origin) - a, v = lanes(ray.direction), n = cross(e1, e2), moment = cross(p, v);
  const Pair plane = two_sums(n * p, n * v), edges = two_sums(moment * e1, moment * e2);
  const Pair sizes = two_sums(abs(p), abs(v)), lengths = two_sums(abs(e1), abs(e2));
  const Pair side = select(seconds(plane) < both(0), both(-1), both(1)), volume = seconds(plane) * side;
  const Pair height = firsts(plane) * side;  // below the plane where negative: the ray rises to it
  const Pair in2 = firsts(edges) * side, in1 = (both(0) - seconds(edges)) * side, in0 = volume - (in1 + in2);
  const Pair length = firsts(lengths) + seconds(lengths);
  const Pair area = length * length * both(0x1p-48), noise = firsts(sizes) * seconds(sizes) * length * both(0x1p-48);
  const Pair noise0 = noise + seconds(sizes) * area, least = min(in1 - noise, min(in2 - noise, in0 - noise0));
  const Pair most = min(in1 + noise, min(in2 + noise, in0 + noise0));  // the least of the three, at most
  const Pair t = (both(0) - height) / volume, end = both(ray.max_t);
  const Pair above = firsts(sizes) * area, late = above + abs(t) * seconds(sizes) * area, rest = (end - t) * volume;
  const PairMask hits = (both(0) < least) & (height < both(0) - above) & (late < rest);
  const PairMask misses = (most < both(0)) | (above < height) | (rest < both(0) - late);
  const PairMask flat = seconds(sizes) * area < volume;
  const Pair nn = dot(n, n), size = firsts(sizes) + length;
  const PairMask in_range = (max(size, seconds(sizes)) <= both(packed::most_length)) &
                            (both(1 / packed::most_length) <= min(length, seconds(sizes))) & (both(0) <= end) &
                            (both(packed::least_time) <= noise);
  const PairMask broad = both(0x1p-8) * (dot(e1, e1) * dot(e2, e2)) < nn;
  return {all_of(in_range & ((hits & flat & broad) | (misses & flat))), all_of(hits), t, lanes(ray.origin) + v * all(t),
          n * all((both(0) - side) / root(nn))};
}

}  // namespace thinwall

#ifdef THINWALL_COMPILED
#include <thinwall/discrete/compiled.hpp>
#endif
