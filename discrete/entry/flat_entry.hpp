#pragma once
/// When a moving point first meets a flat set of no thickness: the triangle, or the parallelogram of two edges that pass.
///
/// With no radius to round its rim a wrong sign makes a hit a miss, so every decision is the sign of a determinant. By
/// Cramer's rule p + v t = alpha e1 + beta e2 has, with D = v.(e1 x e2),
///
///   t = -p.(e1 x e2) / D,    alpha = (v x p).e2 / D,    beta = -(v x p).e1 / D.
///
/// Plain arithmetic decides almost all; where a sign is within its rounding noise, exact_flat_entry.hpp decides.
/// Source: the determinants are those of Moeller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of
/// Graphics Tools 2, 1997; the noise bound is derived in docs/closed_forms.md.

#include <algorithm>
#include <limits>

#include <thinwall/discrete/entry/exact_flat_entry.hpp>

namespace thinwall {

/// The path from p to p + v * last lies beyond the set along some axis. No rounding can make this wrong: it is monotone.
template <Scalar S>
bool boxes_apart(FlatShape shape, const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& e1, const Vec3<S>& e2,
                 const S& last) {
  const Vec3<S> zero = Vec3<S>::Zero();
  const Vec3<S> low1 = zero.cwiseMin(e1), low2 = zero.cwiseMin(e2), high1 = zero.cwiseMax(e1),
                high2 = zero.cwiseMax(e2);
  const bool one = shape == FlatShape::triangle;
  const Vec3<S> low = one ? Vec3<S>(low1.cwiseMin(low2)) : Vec3<S>(low1 + low2);
  const Vec3<S> high = one ? Vec3<S>(high1.cwiseMax(high2)) : Vec3<S>(high1 + high2);
  for (int i = 0; i < 3; ++i) {
    const S end = v[i] == S(0) ? p[i] : S(p[i] + v[i] * last);  // 0 * infinity would be NaN
    if ((p[i] < low[i] && end < low[i]) || (p[i] > high[i] && end > high[i])) return true;
  }
  return false;
}

/// The same as flat_entry, for lengths and displacements whose products of four are in range.
template <Scalar S>
Entry<S> flat_entry_in_range(FlatShape shape, const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& e1, const Vec3<S>& e2,
                             const S& last) {
  const S area = largest(e1) * largest(e2), speed = largest(v), reach = largest(p);
  const Vec3<S> normal = accurate_cross(e1, e2);
  const Vec3<S> moment = cross(v, p);
  const S side = v.dot(normal) < S(0) ? S(-1) : S(1);
  const S climb = side * v.dot(normal), start = side * p.dot(normal), end = start + last * climb;
  const S alpha = side * moment.dot(e2), beta = -side * moment.dot(e1);
  const S rest = shape == FlatShape::triangle ? S(climb - alpha - beta) : S(climb - std::max(alpha, beta));
  const S inner = std::min(std::min(alpha, beta), rest);  // > 0: the line of motion passes through the set

  const S unit = 48 * std::numeric_limits<S>::epsilon();
  const S climb_noise = unit * area * speed, start_noise = unit * area * reach;
  const S end_noise = start_noise + last * climb_noise;
  const S inner_noise = climb_noise + unit * speed * reach * largest(e1, e2);
  if (start > start_noise) {
    if (climb > climb_noise || end > end_noise) return {};
  } else if (end < -end_noise && start < -start_noise) {
    return {};
  }
  if (climb > climb_noise) {
    if (inner < -inner_noise) return {};
    if (inner > inner_noise && start < -start_noise && (end > end_noise || !is_finite(last))) {
      Entry<S> entry;
      entry.time = std::min(last, S(-start / climb));
      entry.normal = safe_unit(normal) * -side;
      return entry;
    }
  }
  if (boxes_apart(shape, p, v, e1, e2, last)) return {};
  return exact_flat_entry(shape, p, v, e1, e2, last);
}

/// First time t in [0, last] at which p + v t is in the set, touching included; infinity if there is none. `last` [1] >= 0
/// may be infinite.
/// Error: the verdict is that of the given p, v, e1 and e2 exactly, unless a product underflows.
/// Degenerate: e1 and e2 may be parallel or zero, v may lie in the plane or be zero.
template <Scalar S>
Entry<S> flat_entry(FlatShape shape, const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& e1, const Vec3<S>& e2,
                    const S& last) {
  const S length = largest(p, e1, e2), speed = largest(v);
  const int length_exponent = products_in_range(length) ? 0 : binary_exponent(length);
  const int speed_exponent = products_in_range(speed) ? 0 : binary_exponent(speed);
  if (length_exponent == 0 && speed_exponent == 0) return flat_entry_in_range(shape, p, v, e1, e2, last);
  Entry<S> entry =
      flat_entry_in_range<S>(shape, times_power_of_two(p, -length_exponent), times_power_of_two(v, -speed_exponent),
                             times_power_of_two(e1, -length_exponent), times_power_of_two(e2, -length_exponent),
                             times_power_of_two(last, speed_exponent - length_exponent));
  entry.time = times_power_of_two(entry.time, length_exponent - speed_exponent);
  return entry;
}

/// True if the point p is in the set.
template <Scalar S> bool in_flat_set(FlatShape shape, const Vec3<S>& p, const Vec3<S>& e1, const Vec3<S>& e2) {
  return flat_entry<S>(shape, p, Vec3<S>::Zero(), e1, e2, S(0)).inside;
}

}  // namespace thinwall
