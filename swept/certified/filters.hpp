#pragma once
/// What a filter can prove in plain arithmetic: balls, and points between slabs.

#include <algorithm>
#include <cmath>

#include <thinwall/swept/certified/certified_toi.hpp>

namespace thinwall {

// ---- Two balls in double, with a bound on every rounding: decides all but near-ties.
//
// With p the center of A seen from B's, v its motion and R the sum of the radii:
//   c = p.p - R^2,  b = p.v,  a = v.v,  D = a R^2 - |p x v|^2,   first contact t = c / (-b + sqrt D).
// c < 0 overlaps at the start; else b >= 0 or D < 0 is a miss. Each constant below is the number of roundings on the longest
// way to that value and a few to spare, those of p, v and R included: derived in docs/certified.md.

/// What a stage returns that leaves the question to the next.
inline constexpr CertifiedToi undecided{ToiStatus::gave_up, 0, 1, DecidedBy::guard};

inline constexpr double roundoff_unit = std::numeric_limits<double>::epsilon() / 2;

/// At least half of the digits of the time are proven. Brackets wider than that go on to the next stage.
THINWALL_HOT bool is_narrow(double lower, double upper) { return upper - lower <= 0x1p-26 * upper; }

/// Requires relative errors of at most one rounding in each p_i, v_i and R. NaN and infinity are left undecided.
THINWALL_HOT CertifiedToi ball_filter(const Vec3<double>& p, const Vec3<double>& v, double R) {
  constexpr double u = roundoff_unit, least = 0x1p-400, most = 0x1p400, tiny = std::numeric_limits<double>::min();
  const auto decided = [](ToiStatus verdict, double lower, double upper) {
    return CertifiedToi{verdict, lower, upper, DecidedBy::filter};
  };
  const double pp = p.squaredNorm(), RR = R * R, a = v.squaredNorm(), size = pp + RR;
  if (!(size >= least && size <= most)) return undecided;

  const double c = pp - RR, c_error = 8 * u * size;
  if (c < -c_error && a <= most) return decided(ToiStatus::overlapping, 0, 0);
  if (!(c > c_error)) return undecided;
  if (!(a >= least && a <= most)) return v == Vec3<double>::Zero() ? decided(ToiStatus::apart, 1, 1) : undecided;

  const double px = p[0] * v[0], py = p[1] * v[1], pz = p[2] * v[2];
  const double b = px + py + pz, b_error = 6 * u * (std::abs(px) + std::abs(py) + std::abs(pz)) + tiny;
  if (b >= b_error) return decided(ToiStatus::apart, 1, 1);

  double mm = 0, products = 0;  // of p x v: its square, and its components times the magnitudes they are made of
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double first = p[j] * v[k], second = p[k] * v[j], m = first - second;
    mm += m * m;
    products += std::abs(m) * (std::abs(first) + std::abs(second));
  }
  const double aRR = a * RR, D = aRR - mm;
  const double D_error = u * (14 * aRR + 6 * mm + 9 * products) + 64 * u * u * (a * pp);
  if (D < -D_error) return decided(ToiStatus::apart, 1, 1);
  if (!(D > D_error && b < -b_error)) return undecided;

  const double lower = (c - c_error) / ((b_error - b) + std::sqrt(D + D_error)) * (1 - 8 * u);
  const double upper = (c + c_error) / ((-b - b_error) + std::sqrt(D - D_error)) * (1 + 8 * u);
  if (lower > 1) return decided(ToiStatus::apart, 1, 1);
  return upper <= 1 && is_narrow(lower, upper) ? decided(ToiStatus::hit, lower, upper) : undecided;
}

// ---- Two boxes along the axes in double, with a bound on every rounding: per axis, an interval for when their shadows begin to
// overlap and one for when they end; a hit where all have begun before any ends.
//
// With p the center of A seen from B's, v its motion and h the sum of the half extents, the shadows on one axis are
//   n = |p| - h  apart, begin to overlap at n / |v| and end at (|p| + h) / |v| where they approach, and end at -n / |v| where
// they part. Each constant counts the roundings on the way: derived in docs/certified.md.

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
