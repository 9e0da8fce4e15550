#pragma once
/// When a point crosses a face of a zonotope, checked in double: the proof of contact where there is no radius to hide in.
///
/// The face is c + alpha g + beta h with |alpha|, |beta| <= 1, and moves by v. It meets the origin at s where
///   c + alpha g + beta h + s v = 0:   s = -det(g, h, c) / det(g, h, v),  and alpha and beta by Cramer's rule as well.
/// Every determinant comes with a bound on its rounding; if the face holds the origin at s, the shapes touch by then.
/// Constants: docs/certified.md.

#include <thinwall/swept/certified/witness_proof.hpp>

namespace thinwall {

/// a . (b x c), and how far off it may be.
struct BoundedDeterminant {
  double value = 0, error = 0;

  /// `size_a` bounds the magnitude of a, coordinate by coordinate, where a itself is off by up to 14 u of it.
  BoundedDeterminant(const Vec3<double>& a, const Vec3<double>& size_a, const Vec3<double>& b, const Vec3<double>& c) {
    double products = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double first = b[j] * c[k], second = b[k] * c[j];
      value += a[i] * (first - second);
      products += size_a[i] * (std::abs(first) + std::abs(second));
    }
    error = 28 * roundoff_unit * products + 0x1p-900;
  }
  double largest() const { return std::abs(value) + error; }
  double least() const { return std::abs(value) - error; }
};

/// A time by which the face c +- g +- h has met the origin, rounded up; infinity if that is not proven.
inline double crossed_by(const Vec3<double>& c, const Vec3<double>& g, const Vec3<double>& h, const Vec3<double>& v,
                         const Vec3<double>& size) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const BoundedDeterminant speed(v, v.cwiseAbs(), g, h), distance(c, size, g, h);
  if (!(speed.least() > 0) || !(distance.least() > 0) || (speed.value > 0) == (distance.value > 0)) return never;
  const BoundedDeterminant alpha(c, size, h, v), beta(c, size, v, g);
  if (!(alpha.largest() <= speed.least()) || !(beta.largest() <= speed.least())) return never;
  return distance.largest() / speed.least() * (1 + 4 * roundoff_unit);
}

}  // namespace thinwall
