#pragma once
/// What every query at one instant must fulfil, whatever the shapes.

#include <cmath>

#include <thinwall/capsule/capsule_manifold.hpp>
#include <thinwall/discrete/boxes/box_manifold.hpp>
#include <thinwall/discrete/manifold.hpp>

#include "fuzz/exhibit.hpp"
#include "fuzz/finding.hpp"
#include "fuzz/moderate.hpp"

namespace thinwall::fuzz {

/// |n| = 1 to a few units of round-off.
template <Scalar S> bool is_unit(const Vec3<S>& n) {
  const Vec3<long double> wide = n.template cast<long double>();
  return std::abs(std::sqrt(wide.squaredNorm()) - 1) <= 8 * static_cast<long double>(std::numeric_limits<S>::epsilon());
}
template <Scalar S> bool is_zero(const Vec3<S>& v) { return v == Vec3<S>(Vec3<S>::Zero()); }

/// NaN, infinity, a negative size, axes that are not orthonormal: false, nothing, NaN.
template <class A, class B> void check_bad_shapes(const Scene<A, B>& scene) {
  using S = typename A::Scalar;
  const Check check(scene);
  const A& a = scene.a.shape;
  const B& b = scene.b.shape;
  const bool overlap = overlaps(a, b), back = overlaps(b, a);
  const auto touch = contact(a, b);
  const auto points = manifold(a, b);
  const Separation<S> gap = separation(a, b);
  if (valid(a) && valid(b)) return;  // their motion alone is bad
  check(!overlap && !back, "a shape that is not valid overlaps");
  check(!touch && points.empty(), "a shape that is not valid is in contact");
  check(gap.distance != gap.distance, "a shape that is not valid has a distance");
}

template <class A, class B> void check_discrete(const Scene<A, B>& scene) {
  using S = typename A::Scalar;
  const Check check(scene);
  const A& a = scene.a.shape;
  const B& b = scene.b.shape;
  const bool ordinary = is_ordinary(S(magnitude(a) + magnitude(b)));
  const bool overlap = overlaps(a, b);
  const auto touch = contact(a, b), touch_back = contact(b, a);
  const auto points = manifold(a, b);
  const Separation<S> gap = separation(a, b), gap_back = separation(b, a);

  check(touch.has_value() == overlap, "contact() and overlaps() differ");
  check(points.empty() != overlap, "manifold() and overlaps() differ");
  check(is_unit(gap.normal), "separation(): normal is not unit", [&] { return text(gap.normal); });
  if (ordinary) {
    check(is_finite(gap.distance) && is_finite(gap.point_a) && is_finite(gap.point_b), "separation() is not finite",
          [&] { return text(gap.distance) + " " + text(gap.point_a) + " " + text(gap.point_b); });
  }
  if (touch) {
    check(is_unit(touch->normal), "contact(): normal is not unit", [&] { return text(touch->normal); });
    check(touch->penetration >= S(0), "contact(): penetration is negative or NaN");
    check(touch->normal == gap.normal, "contact() and separation() differ in their normals",
          [&] { return text(touch->normal) + " " + text(gap.normal); });
  }
  check(points.size() <= 4, "manifold(): too many points");
  for (const Contact<S>& point : points) {
    check(point.normal == points[0].normal && is_unit(point.normal), "manifold(): normals differ or are not unit",
          [&] { return text(point.normal) + " " + text(points[0].normal); });
    check(point.penetration >= S(0) && point.penetration <= points[0].penetration,
          "manifold(): the deepest point is not the first",
          [&] { return text(point.penetration) + " " + text(points[0].penetration); });
    if (ordinary) check(is_finite(point.local_a) && is_finite(point.local_b), "manifold(): a point is not finite");
  }
  if (touch && !points.empty() && is_judged(scene)) {  // the same, but where a face is all but the normal of contact
    const S rounding = 32 * std::numeric_limits<S>::epsilon() * S(magnitude(a) + magnitude(b));
    check(largest(Vec3<S>(points[0].normal - touch->normal)) <= 4 * parallel_sine<S>() || gap.distance >= -rounding,
          "manifold() and contact() differ in their normals",
          [&] { return text(points[0].normal) + " " + text(touch->normal); });
    check(largest(S(points[0].penetration - touch->penetration)) <= rounding,
          "manifold() and contact() differ in their penetrations",
          [&] { return text(points[0].penetration) + " " + text(touch->penetration); });
  }
  check(touch_back.has_value() == touch.has_value() || std::is_same_v<A, B>, "the other way round contact() differs");
  if constexpr (!std::is_same_v<A, B>) {
    check(overlaps(b, a) == overlap, "the other way round overlaps() differs");
    check(gap_back.distance == gap.distance || !is_finite(gap.distance), "the other way round separation() differs",
          [&] { return text(gap.distance) + " " + text(gap_back.distance); });
    if (touch && touch_back) check(touch->penetration == touch_back->penetration, "the other way round depths differ");
  }
}

/// Distance, sign and normal against the oracle.
template <class A, class B> void judge_discrete(const Scene<A, B>& scene) {
  if (!is_judged(scene)) return;
  const auto gap = separation(scene.a.shape, scene.b.shape);
  const Judgment judgment =
      judge_separation(exhibit(at_rest(scene.a.shape), at_rest(scene.b.shape)), double{gap.distance},
                       gap.normal.template cast<double>(), overlaps(scene.a.shape, scene.b.shape));
  Check(scene).no_fault(judgment, "", [] { return std::string(); });
}

/// A ray along A's displacement from A's center, against B.
template <class A, class B> void check_raycast(const Scene<A, B>& scene) {
  using S = typename A::Scalar;
  const Check check(scene);
  const Ray<S> ray{center(scene.a.shape), scene.a.displacement, S(1)};
  const auto hit = raycast(ray, scene.b.shape);
  if (!valid(ray) || !valid(scene.b.shape)) {
    check(!hit, "raycast(): a hit though the input is not valid");
    return;
  }
  const Moving<Sphere<S>> point{{ray.origin, S(0)}, ray.direction};
  const Moving<B> still = at_rest(scene.b.shape);
  Toi<S> toi;
  if (hit) {
    const bool inside = is_zero(hit->normal);
    check(hit->t >= S(0) && hit->t <= S(1), "raycast(): t out of range", [&] { return text(hit->t); });
    check(inside ? hit->t == S(0) : is_unit(hit->normal), "raycast(): normal is not unit",
          [&] { return text(hit->normal) + " at " + text(hit->t); });
    check(!inside || !is_ordinary(S(magnitude(point) + magnitude(still))) || hit->point == ray.origin,
          "raycast(): inside, but the point is not the origin");
    if (is_ordinary(S(magnitude(point) + magnitude(still))))
      check(is_finite(hit->point), "raycast(): point is not finite");
    toi = {inside ? ToiStatus::overlapping : ToiStatus::hit, 1, hit->t, hit->normal, hit->point};
  }
  if (!is_judged(scene)) return;
  check.no_fault(judge_impact(exhibit(point, still), toi.status, double{toi.time}, 4),
                 "raycast(): ", [&] { return text(toi) + ": "; });
}

}  // namespace thinwall::fuzz
