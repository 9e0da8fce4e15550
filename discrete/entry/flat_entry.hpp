#pragma once
/// When a moving point first meets a flat set of no thickness: the triangle, or the parallelogram of two edges that pass.
///
/// With no radius to round its rim a wrong sign makes a hit a miss, so every decision is the sign of a determinant. By
/// Cramer's rule p + v t = alpha e1 + beta e2 has, with D = v.(e1 x e2),
///
///   t = -p.(e1 x e2) / D,    alpha = (v x p).e2 / D,    beta = -(v x p).e1 / D.
///
/// Plain arithmetic decides almost all; where a sign is within its rounding noise, exact_flat_entry decides.
/// Source: the determinants are those of Moeller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of
/// Graphics Tools 2, 1997; the noise bound is derived in docs/closed_forms.md.

#include <algorithm>
#include <limits>
#include <optional>

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

/// What plain arithmetic decides: the entry, or none; nothing where it does not. Requires lengths and displacements whose products of four are
/// in range.
template <Scalar S>
std::optional<Entry<S>> plain_flat_entry(FlatShape shape, const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& e1,
                                         const Vec3<S>& e2, const S& latest) {
  const S area = largest(e1) * largest(e2), speed = largest(v), reach = largest(p), span = largest(e1, e2);
  const S last =
      is_finite(S(latest * speed * std::max(S(1), S(span * span)))) ? latest : std::numeric_limits<S>::infinity();
  const Vec3<S> normal = accurate_cross(e1, e2);
  const Vec3<S> moment = cross(v, p);
  const S side = v.dot(normal) < S(0) ? S(-1) : S(1);
  const S climb = side * v.dot(normal), start = side * p.dot(normal), end = start + last * climb;
  const S alpha = side * moment.dot(e2), beta = -side * moment.dot(e1);
  const S rest = shape == FlatShape::triangle ? S(climb - alpha - beta) : S(climb - std::max(alpha, beta));
  const S inner = std::min(std::min(alpha, beta), rest);  // > 0: the line of motion passes through the set

  const S unit = 48 * std::numeric_limits<S>::epsilon();
  const S& vanished = constant_power_of_two<S, std::numeric_limits<S>::min_exponent / 4 * 3>();
  const S climb_noise = unit * area * speed + vanished, start_noise = unit * area * reach + vanished;
  const S end_noise = start_noise + last * climb_noise;
  const S inner_noise = climb_noise + unit * speed * reach * span;
  if (start > start_noise) {
    if (climb > climb_noise || end > end_noise) return Entry<S>{};
  } else if (end < -end_noise && start < -start_noise) {
    return Entry<S>{};
  }
  if (!(climb > climb_noise)) return std::nullopt;
  if (inner < -inner_noise) return Entry<S>{};
  if (!(inner > inner_noise && start < -start_noise && (end > end_noise || !is_finite(last)))) return std::nullopt;
  Entry<S> entry;
  entry.time = std::min(last, S(-start / climb));
  entry.normal = safe_unit(normal) * -side;
  return entry;
}

/// First time t in [0, latest] at which p + v t is in the set, touching included; infinity if there is none. `latest` [1] >= 0
/// may be infinite.
/// Error: the verdict is that of the given p, v, e1 and e2 exactly.
/// Degenerate: e1 and e2 may be parallel or zero, v may lie in the plane or be zero.
template <Scalar S>
Entry<S> flat_entry(FlatShape shape, const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& e1, const Vec3<S>& e2,
                    const S& latest) {
  const S size = largest(p, e1, e2), speed = largest(v);
  const SafeScale<S> scale(size, speed);
  const auto plain_at_scale = [&] {
    auto entry = plain_flat_entry<S>(shape, scale.length(p), scale.displacement(v), scale.length(e1), scale.length(e2),
                                     scale.time(latest));
    if (entry) entry->time = scale.time_back(entry->time);
    return entry;
  };
  const auto plain = scale.is_one() ? plain_flat_entry(shape, p, v, e1, e2, latest) : plain_at_scale();
  if (plain) return *plain;
  if (boxes_apart(shape, p, v, e1, e2, latest)) return {};
  return exact_flat_entry_of_any(shape, p, v, e1, e2, latest);
}

/// True if the point p is in the set.
template <Scalar S> bool in_flat_set(FlatShape shape, const Vec3<S>& p, const Vec3<S>& e1, const Vec3<S>& e2) {
  return flat_entry<S>(shape, p, Vec3<S>::Zero(), e1, e2, S(0)).inside;
}

}  // namespace thinwall
