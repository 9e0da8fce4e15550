#pragma once
/// The plain forms that everybody writes first, beside those of the textbook: no checks, no rescaling, verdict and time only, infinity for
/// a miss. They are what the library's speed is held against, and their errors are counted beside it.
///
/// Source: Moeller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997. Written from the formulas.

#include <algorithm>
#include <cmath>

#include <thinwall/experiments/models/textbook.hpp>

#include "query_sets.hpp"

namespace thinwall::bench::plain {

using Vec = Vec3<double>;

/// First t at which a ray meets a triangle.
inline double triangle(const Vec& origin, const Vec& direction, const Triangle<double>& t) {
  const Vec e1 = t.b - t.a, e2 = t.c - t.a, q = cross(direction, e2);
  const double determinant = e1.dot(q);
  if (determinant == 0) return never;
  const Vec s = origin - t.a, r = cross(s, e1);
  const double u = s.dot(q) / determinant, w = direction.dot(r) / determinant, time = e2.dot(r) / determinant;
  return u >= 0 && w >= 0 && u + w <= 1 && time >= 0 ? time : never;
}

/// First t >= 0 at which a moving sphere touches a triangle: the two faces moved out by R, else the three edges.
inline double rounded_triangle(const Vec& p, const Vec& v, const Triangle<double>& t, double R) {
  const Vec n = safe_unit(cross<double>(t.b - t.a, t.c - t.a));
  const double face = triangle(p - n * ((p - t.a).dot(n) < 0 ? -R : R), v, t);
  if (face != never) return face;
  return std::min({textbook::rounded_segment<double>(p - t.a, v, t.b - t.a, R),
                   textbook::rounded_segment<double>(p - t.b, v, t.c - t.b, R),
                   textbook::rounded_segment<double>(p - t.c, v, t.a - t.c, R)});
}

/// First t in [0, 1] at which the separation of two shapes is no more than zero: sampled, then bisected.
template <class A, class B> double bisection(const Moving<A>& a, const Moving<B>& b) {
  const auto gap = [&](double t) { return separation(pose_at(a, t), pose_at(b, t)).distance; };
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {  // the separation is convex: first to its minimum, by thirds
    const double third = (high - low) / 3, left = gap(low + third), right = gap(high - third);
    if (left <= 0 || right <= 0) {
      high = left <= 0 ? low + third : high - third;
      break;
    }
    (left < right ? high : low) = left < right ? high - third : low + third;
  }
  if (gap(high) > 0) return never;
  for (low = 0; high - low > 1e-15;) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    (gap(middle) > 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace thinwall::bench::plain
