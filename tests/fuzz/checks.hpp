#pragma once
/// What every query at one instant must fulfil, whatever the shapes.

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include <thinwall/capsule/capsule_manifold.hpp>
#include <thinwall/discrete/boxes/box_manifold.hpp>
#include <thinwall/discrete/manifold.hpp>
#include <thinwall/swept/methods.hpp>

#include "fuzz/finding.hpp"
#include "support/method_claims.hpp"

namespace thinwall::fuzz {

/// |n| = 1 to a few units of round-off.
template <Scalar S> bool is_unit(const Vec3<S>& n) {
  const Vec3<long double> wide = n.template cast<long double>();
  return std::abs(std::sqrt(wide.squaredNorm()) - 1) <= 8 * static_cast<long double>(std::numeric_limits<S>::epsilon());
}
template <Scalar S> bool is_zero(const Vec3<S>& v) { return v == Vec3<S>(Vec3<S>::Zero()); }
template <Scalar S> bool is_no_vector(const Vec3<S>& v) { return v[0] != v[0] && v[1] != v[1] && v[2] != v[2]; }

/// By how much contact() and separation() may differ in their normals. The clear rung answers contacts of capsules in double, by cores that
/// are 2^-20 of their size apart and, where there are two, 2^-10 from parallel: their nearest points, and so the direction from one to
/// the other, are that much less certain than a number. All others calculate one normal for both, where their numbers are of like enough
/// size: contact() asks the clear rung at a size near 1, where the smallest may leave the range, and separation() does not.
template <class A, class B>
inline constexpr typename A::Scalar normals_apart =
    std::is_same_v<typename A::Scalar, double> &&
            (std::is_same_v<A, Capsule<double>> || std::is_same_v<B, Capsule<double>>)
        ? (std::is_same_v<A, B> ? 0x1p-10 : 0x1p-28)
        : 0;

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
  check(is_no_vector(gap.normal) && is_no_vector(gap.point_a) && is_no_vector(gap.point_b),
        "a shape that is not valid has a normal or a nearest point");
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
    check(!is_judged(scene) || largest(Vec3<S>(touch->normal - gap.normal)) <= normals_apart<A, B>,
          "contact() and separation() differ in their normals",
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

/// A ray against B; returns its answer as a time of impact.
template <class A, class B>
Toi<typename A::Scalar> check_ray(const Scene<A, B>& scene, const Ray<typename A::Scalar>& ray) {
  using S = typename A::Scalar;
  const Check check(scene);
  const auto hit = raycast(ray, scene.b.shape);
  const auto show = [&] { return "ray" + numbers_of(ray); };
  if (!valid(ray) || !valid(scene.b.shape)) check(!hit, "raycast(): a hit though the input is not valid", show);
  if (!hit) return {};
  const bool inside = is_zero(hit->normal), ordinary = is_ordinary(S(magnitude(ray) + magnitude(scene.b.shape)));
  check(hit->t >= S(0) && hit->t <= ray.max_t && is_finite(hit->t), "raycast(): t out of range", show);
  check(inside ? hit->t == S(0) : is_unit(hit->normal), "raycast(): normal is not unit",
        [&] { return text(hit->normal) + " at " + text(hit->t) + ", " + show(); });
  check(!inside || !ordinary || hit->point == ray.origin, "raycast(): inside, but the point is not the origin", show);
  check(!ordinary || is_finite(hit->point), "raycast(): point is not finite", show);
  return {inside ? ToiStatus::overlapping : ToiStatus::hit, 1, hit->t, hit->normal, hit->point};
}

/// A ray along A's displacement from A's center, against B.
template <class A, class B> void check_raycast(const Scene<A, B>& scene) {
  using S = typename A::Scalar;
  const Ray<S> ray{center(scene.a.shape), scene.a.displacement, S(1)};
  const Toi<S> toi = check_ray(scene, ray);
  if (!is_judged(scene)) return;
  const Moving<Sphere<S>> point{{ray.origin, S(0)}, ray.direction};
  Check(scene).no_fault(judge_impact(exhibit(point, at_rest(scene.b.shape)), toi.status, double{toi.time}, 4),
                        "raycast(): ", [&] { return text(toi) + ": "; });
}

// ---- What every time of impact must fulfil, whatever the shapes and motions.

/// Status, time, normal and point belong together.
template <class A, class B>
void check_answer(const Scene<A, B>& scene, const std::string& method, const Toi<typename A::Scalar>& toi) {
  using S = typename A::Scalar;
  const Check check(scene);
  const auto show = [&] { return text(toi); };
  const auto expect = [&](bool holds, const char* property) { check(holds, method + ": " + property, show); };
  const bool ordinary = is_ordinary(scene.size());
  expect(toi.evaluations >= 0, "the count of evaluations is negative");
  if (!scene.is_valid()) {
    expect(toi.status == ToiStatus::invalid, "bad input is not invalid");
    expect(toi.time != toi.time, "invalid with a time");
    return;
  }
  switch (toi.status) {
    case ToiStatus::apart:
      expect(toi.time == S(1) && is_zero(toi.normal) && is_zero(toi.point), "apart with data");
      break;
    case ToiStatus::overlapping:
      expect(toi.time == S(0), "overlapping after the start");
      expect(is_unit(toi.normal), "overlapping, and the normal is not unit");
      break;
    case ToiStatus::hit:
      expect(toi.time >= S(0) && toi.time <= S(1), "hit, and the time is out of range");
      expect(is_unit(toi.normal), "hit, and the normal is not unit");
      break;
    case ToiStatus::gave_up:
      expect(toi.time >= S(0) && toi.time <= S(1), "gave up, and the time is out of range");
      break;
    case ToiStatus::invalid: expect(false, "good input is invalid"); break;
  }
  if (ordinary) expect(is_finite(toi.point), "the point is not finite");
}

/// The closed form: it always answers, unless numbers 2^50 apart leave no digits to walk by; the other way round says the same.
template <class A, class B> Toi<typename A::Scalar> check_closed_form(const Scene<A, B>& scene) {
  using S = typename A::Scalar;
  const Check check(scene);
  const Toi<S> there = time_of_impact(scene.a, scene.b), back = time_of_impact(scene.b, scene.a);
  check_answer(scene, "closed form", there);
  check(there.status != ToiStatus::gave_up || !is_moderate(scene, 25), "closed form: gave up",
        [&] { return text(there); });
  const auto both = [&] { return text(there) + "\n  " + text(back); };
  if constexpr (std::is_same_v<A, B>) {
    check_answer(scene, "closed form, the other way round", back);
  } else if (scene.is_valid()) {
    check(there.status == back.status && there.time == back.time, "closed form: the other way round differs", both);
    check(there.point == back.point || !is_finite(there.point), "closed form: the other way round the point differs",
          both);
    check(there.normal == -back.normal, "closed form: the other way round the normal does not flip", both);
  }
  return there;
}

/// Verdict and time to 4 u, both ways round.
template <class A, class B> void judge_closed_form(const Scene<A, B>& scene, const Toi<typename A::Scalar>& toi) {
  const Check check(scene);
  const auto judge_one = [&](const std::string& way, const auto& a, const auto& b, const auto& answer) {
    const Judgment judgment = judge_impact(exhibit(a, b), answer.status, double{answer.time}, 4);
    check.no_fault(judgment, way, [&] { return text(answer) + ": "; });
  };
  if (toi.status == ToiStatus::gave_up || toi.status == ToiStatus::invalid || !is_judged(scene)) return;
  judge_one("closed form: ", scene.a, scene.b, toi);
  if constexpr (std::is_same_v<A, B>) {
    judge_one("closed form, the other way round: ", scene.b, scene.a, time_of_impact(scene.b, scene.a));
  }
}

/// The edges of a shape that has any of its own: vectors whose squares are asked for.
template <class A> std::vector<Vec3<typename A::Scalar>> edges(const A& shape) {
  using S = typename A::Scalar;
  if constexpr (std::is_same_v<A, Capsule<S>>) {
    return {shape.b - shape.a};
  } else if constexpr (std::is_same_v<A, Triangle<S>>) {
    return {shape.b - shape.a, shape.c - shape.b, shape.a - shape.c};
  } else {
    return {};
  }
}

/// An edge, or the way the two shapes move by, is below 2^-60 of all sizes: last bits of a time of impact may change with
/// the scale (docs/closed_forms.md).
template <class A, class B> bool hides_a_part(const Scene<A, B>& scene) {
  using S = typename A::Scalar;
  const auto sizes = [](const auto& x) { return extent(x.shape) + x.displacement.cwiseAbs().sum(); };
  std::vector<Vec3<S>> parts = edges(scene.a.shape);
  for (const Vec3<S>& edge : edges(scene.b.shape)) parts.push_back(edge);
  parts.push_back(relative_displacement(scene.a, scene.b));
  const S least = constant_power_of_two<S, -60>() * (sizes(scene.a) + sizes(scene.b));
  return std::any_of(parts.begin(), parts.end(), [&](const Vec3<S>& part) {
    const S length = part.cwiseAbs().maxCoeff();
    return length > 0 && length < least;
  });
}

/// Lengths times 2^k change no bit, as long as no product of them leaves the range of the scalar.
template <class A, class B> void check_scale(const Scene<A, B>& scene, int choice) {
  using S = typename A::Scalar;
  constexpr bool in_float = std::is_same_v<S, float>;
  constexpr int most = in_float ? 4 : 24;
  constexpr std::array<int, 8> steps = in_float ? std::array<int, 8>{-90, -60, -2, -1, 1, 2, 60, 90}
                                                : std::array<int, 8>{-700, -500, -30, -1, 1, 30, 500, 700};
  if (!is_moderate(scene, most)) return;
  const Check check(scene);
  const int k = steps[static_cast<std::size_t>(choice) % steps.size()];
  const Scene<A, B> other{scaled(scene.a, k), scaled(scene.b, k)};
  const Toi<S> here = time_of_impact(scene.a, scene.b), there = time_of_impact(other.a, other.b);
  const std::string factor = "times 2^" + std::to_string(k) + ": ";
  const bool bits_may_change = hides_a_part(scene);
  check(here.status == there.status && (bits_may_change || here.time == there.time),
        "closed form: scale changes the time", [&] { return text(here) + "\n  " + factor + text(there); });
  check(bits_may_change || (here.normal == there.normal && times_power_of_two(here.point, k) == there.point),
        "closed form: scale changes the normal or the point",
        [&] { return text(here) + "\n  " + factor + text(there); });
  const Separation<S> near = separation(scene.a.shape, scene.b.shape), far = separation(other.a.shape, other.b.shape);
  check(times_power_of_two(near.distance, k) == far.distance && near.normal == far.normal,
        "separation(): scale changes it", [&] {
          return text(near.distance) + " " + text(near.normal) + "\n  " + factor + text(far.distance) + " " +
                 text(far.normal);
        });
  check(overlaps(scene.a.shape, scene.b.shape) == overlaps(other.a.shape, other.b.shape),
        "overlaps(): scale changes it", [&] { return factor; });
}

/// The certified answer, and the plain one beside it.
template <class A, class B> void check_certified(const Scene<A, B>& scene, const Toi<typename A::Scalar>& toi) {
  Check(scene).no_fault(judge_certified(exhibit(scene.a, scene.b), toi.status, double{toi.time}, is_judged(scene)), "",
                        [&] { return text(toi) + ";\n  "; });
}

/// f(tag) of one of those that for_each(f) visits: number `which`, counted round and round.
template <class ForEach, class F> void visit_one(const ForEach& for_each, int which, const F& f) {
  int count = 0, index = 0;
  for_each([&](auto) { ++count; });
  for_each([&](auto tag) {
    if (index++ == which % count) f(tag);
  });
}

/// One of the methods: its answer is whole, and one that claims never to be late is not.
template <class A, class B> void check_methods(const Scene<A, B>& scene, int choice) {
  using S = typename A::Scalar;
  const Check check(scene);
  const auto for_each_method = [](const auto& f) {
    for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method> tag) {
      if constexpr (serves<Method, A, B>) f(tag);
    });
  };
  visit_one(for_each_method, choice, [&]<class Method>(TypeTag<Method>) {
    const Toi<S> toi = time_of_impact(Method{}, scene.a, scene.b);
    check_answer(scene, std::string(Method::name), toi);
    if (!testing::claims_of(Method{}).never_late || !is_judged(scene)) return;
    const Judgment judgment = judge_never_late(exhibit(scene.a, scene.b), toi.status, double{toi.time});
    check.no_fault(judgment, std::string(Method::name) + ": ", [&] { return text(toi) + ", "; });
  });
}

}  // namespace thinwall::fuzz
