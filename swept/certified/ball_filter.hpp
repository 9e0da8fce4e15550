#pragma once
/// Two balls in double, with a bound on every rounding: decides all but near-ties.
///
/// With p the center of A seen from B's, v its motion and R the sum of the radii:
///   c = p.p - R^2,  b = p.v,  a = v.v,  D = a R^2 - |p x v|^2,   first contact t = c / (-b + sqrt D).
/// c < 0 overlaps at the start; else b >= 0 or D < 0 is a miss. Each constant below is the number of roundings on the longest
/// way to that value and a few to spare, those of p, v and R included: derived in docs/certified.md.

#include <cmath>

#include <thinwall/swept/certified/certified_toi.hpp>

namespace thinwall {

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

}  // namespace thinwall
