#pragma once
/// When a moving segment comes within R of a triangle: the walk of core_entry.hpp over the parts of their Minkowski sum, a prism.
/// Where R is zero, what meets the prism from outside meets one of its five faces: two triangles and three parallelograms.

#include <thinwall/capsule/segment_triangle.hpp>
#include <thinwall/discrete/entry/flat_entry.hpp>
#include <thinwall/discrete/numbers/double_word.hpp>
#include <thinwall/swept/closed_form/core_entry.hpp>

namespace thinwall {

/// First time at which the segment p + v t + s * d, s in [0, 1], is within R > 0 of the triangle (0, e1, e2); the normal out of it.
template <Scalar S>
Entry<S> capsule_triangle_entry(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Vec3<S>& d, const Vec3<S>& e1,
                                const Vec3<S>& e2) {
  const auto closest = [](const Vec3<S>& x, const Vec3<S>& core, const Vec3<S>& edge1, const Vec3<S>& edge2) {
    return closest_on_swept_triangle(x, core, edge1, edge2).part;
  };
  return core_entry_at_any_scale<S>(closest, p, v, R, d, e1, e2);
}

/// The first face of the prism that is met; `leaves` if the motion comes out of it there. A face that it comes in by is met before all that
/// it leaves by, whatever roundings of their times say.
template <Scalar S> struct PrismFace {
  Entry<S> entry;
  bool leaves = true;
};

template <Scalar S>
PrismFace<S> first_face_of_prism(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& d, const Vec3<S>& e1,
                                 const Vec3<S>& e2) {
  PrismFace<S> first;
  const auto meet = [&](FlatShape shape, const Vec3<S>& from, const Vec3<S>& side1, const Vec3<S>& side2,
                        const Vec3<S>& inward) {
    if (first.entry.inside) return;
    const Entry<S> entry = flat_entry<S>(shape, from, v, side1, side2, S(1));
    const S outwards = entry.normal.dot(inward), along = largest(S(entry.normal.dot(v)));
    const bool leaves =
        outwards > gap_noise(largest(inward)) && along > gap_noise(largest(v));  // of a flat prism signs are roundings
    const bool is_first = leaves == first.leaves ? entry.time < first.entry.time : first.leaves;
    if (entry.inside || (is_finite(entry.time) && is_first)) first = {entry, leaves};
  };
  meet(FlatShape::triangle, p, e1, e2, -d);
  meet(FlatShape::triangle, p + d, e1, e2, d);
  meet(FlatShape::parallelogram, p, e1, -d, e2);
  meet(FlatShape::parallelogram, p, e2, -d, e1);
  meet(FlatShape::parallelogram, p - e1, e2 - e1, -d, -e1);
  return first;
}

/// x to a multiple of a unit so large that sums of two such vectors no greater than `most` are exact.
template <Scalar S> Vec3<S> with_exact_sums(const Vec3<S>& x, const S& most) {
  using std::floor;
  const int e = binary_exponent(most) + 2 - std::numeric_limits<S>::digits;
  const auto rounded = [&](const S& c) {
    return times_power_of_two(S(floor(times_power_of_two(c, -e) + S(1) / S(2))), e);
  };
  return {rounded(x[0]), rounded(x[1]), rounded(x[2])};
}

template <Scalar S> bool sums_are_exact(const Vec3<S>& a, const Vec3<S>& b) {
  return exact_sum(a[0], b[0]).low == S(0) && exact_sum(a[1], b[1]).low == S(0) && exact_sum(a[2], b[2]).low == S(0);
}

/// The same without a radius, to the end of the step. Faces that share a rim are asked with sums, each rounded for itself, and between them
/// there may be a gap of a rounding, through which the motion comes in or goes out. Where a sum is rounded, and the first face met is one that
/// the motion leaves by, or none is, all is asked again with the last digits rounded, so that no sum is, and the faces close. A hit where there
/// was none counts only if half way through it they do touch.
/// Error: the verdict is that of the given numbers' faces exactly, unless a product underflows or a sum is rounded; else of numbers that are
/// off by 2 u of the largest.
template <Scalar S>
Entry<S> sharp_segment_triangle_entry(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& d, const Vec3<S>& e1,
                                      const Vec3<S>& e2) {
  Entry<S> at_start;
  at_start.inside = segment_meets_triangle(p, d, e1, e2);
  if (at_start.inside) return at_start;
  const PrismFace<S> first = first_face_of_prism(p, v, d, e1, e2);
  const bool is_met = first.entry.inside || first.entry.time <= S(1);
  const bool closes = sums_are_exact<S>(p, d) && sums_are_exact<S>(p, -e1) && sums_are_exact<S>(e2, -e1);
  if (closes || (is_met && !first.leaves)) return first.entry;

  const S most = largest(p, d, e1, e2);
  const auto on_grid = [&](const Vec3<S>& x) { return with_exact_sums(x, most); };
  const Vec3<S> core = on_grid(d), edge1 = on_grid(e1), edge2 = on_grid(e2);
  const auto entry_from = [&](const Vec3<S>& start, const Vec3<S>& by) {
    Entry<S> entry = first_face_of_prism(start, by, core, edge1, edge2).entry;
    if (!entry.inside && !segment_meets_triangle(start, core, edge1, edge2)) return entry;
    entry.inside = false;  // by a rounding: it does not touch yet
    entry.time = S(0);
    entry.normal = -safe_unit(by);
    return entry;
  };
  const Entry<S> entry = entry_from(on_grid(p), v);
  if (is_met || !(entry.time <= S(1))) return is_met ? entry : first.entry;
  const S back = entry_from(on_grid(p + v), -v).time;
  if (!(back <= S(1))) return first.entry;
  const S half_way = (entry.time + (S(1) - back)) / S(2);
  return segment_meets_triangle<S>(p + v * half_way, d, e1, e2) ? entry : first.entry;
}

}  // namespace thinwall
