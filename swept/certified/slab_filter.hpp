#pragma once
/// Two boxes along the axes in double, with a bound on every rounding: per axis, an interval for when their shadows begin to
/// overlap and one for when they end; a hit where all have begun before any ends.
///
/// With p the center of A seen from B's, v its motion and h the sum of the half extents, the shadows on one axis are
///   n = |p| - h  apart, begin to overlap at n / |v| and end at (|p| + h) / |v| where they approach, and end at -n / |v| where
/// they part. Each constant counts the roundings on the way: derived in docs/certified.md.

#include <algorithm>
#include <cmath>

#include <thinwall/swept/certified/ball_filter.hpp>

namespace thinwall {

/// All times in one interval.
struct TimeInterval {
  double low = 0, high = 0;  ///< [1]
};

/// (length -+ error) / speed, rounded outward; speed > 0.
THINWALL_HOT TimeInterval time_interval(double length, double error, double speed) {
  constexpr double u = roundoff_unit, tiny = std::numeric_limits<double>::min();
  const double low = (length - error) / speed, high = (length + error) / speed;
  return {low - (4 * u * std::abs(low) + tiny), high + (4 * u * std::abs(high) + tiny)};
}

/// Requires relative errors of at most one rounding in each p_i, v_i and h_i. NaN and infinity are left undecided.
THINWALL_HOT CertifiedToi slab_filter(const Vec3<double>& p, const Vec3<double>& v, const Vec3<double>& h) {
  constexpr double u = roundoff_unit, infinity = std::numeric_limits<double>::infinity();
  constexpr double tiny = std::numeric_limits<double>::min(), most = 0x1p1000;
  const auto decided = [](ToiStatus verdict, double lower, double upper) {
    return CertifiedToi{verdict, lower, upper, DecidedBy::filter};
  };
  if (!(p.cwiseAbs().sum() + v.cwiseAbs().sum() + h.sum() <= most)) return undecided;

  TimeInterval first{0, 0}, last{infinity, infinity};  // of the overlap on all axes
  bool starts_apart = false, starts_inside = true, sure = true;
  for (int i = 0; i < 3; ++i) {
    const double distance = std::abs(p[i]), far = distance + h[i], apart = distance - h[i], speed = std::abs(v[i]);
    const double error = 4 * u * far + tiny;
    starts_apart = starts_apart || apart > error;
    starts_inside = starts_inside && apart < -error;
    const bool approaches = p[i] > 0 ? v[i] < 0 : p[i] < 0 ? v[i] > 0 : true;  // the same, seen from the other box
    if (speed == 0 || !approaches) {
      if (apart > error) return decided(ToiStatus::apart, 1, 1);
      if (!(apart < -error)) sure = false;
      if (speed == 0) continue;
    }
    if (approaches) {
      const TimeInterval begin = time_interval(apart, error, speed);
      first = {std::max(first.low, begin.low), std::max(first.high, begin.high)};
    }
    const TimeInterval end = time_interval(approaches ? far : -apart, error, speed);
    last = {std::min(last.low, end.low), std::min(last.high, end.high)};
  }
  if (starts_inside) return decided(ToiStatus::overlapping, 0, 0);
  if (first.low > last.high || first.low > 1) return decided(ToiStatus::apart, 1, 1);
  const bool hits =
      sure && starts_apart && first.high <= last.low && first.high <= 1 && is_narrow(first.low, first.high);
  return hits ? decided(ToiStatus::hit, first.low, first.high) : undecided;
}

}  // namespace thinwall
