#pragma once
/// The plain closed forms that everybody writes first: no checks, no rescaling, verdict and time only, infinity for a
/// miss. They are what the library's speed is held against, and their errors are counted beside it.
///
/// Sources: Ericson, Real-Time Collision Detection, 2005 (slabs 5.3.3, sphere and box 5.5.7, boxes 4.4.1); Moeller, Trumbore,
/// "Fast, Minimum Storage Ray/Triangle Intersection", 1997. Written from the formulas.

#include <algorithm>
#include <cmath>

#include "query_sets.hpp"

namespace thinwall::bench::plain {

using Vec = Vec3<double>;

/// First t >= 0 with |p + v t| = R, by the quadratic formula.
inline double ball(const Vec& p, const Vec& v, double R) {
  const double a = v.dot(v), b = p.dot(v), c = p.dot(p) - R * R;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return never;
  const double t = (-b - std::sqrt(discriminant)) / a;
  return t >= 0 ? t : never;
}

/// First t >= 0 with p + v t in the box [-h, h].
inline double slabs(const Vec& p, const Vec& v, const Vec& h) {
  double enter = 0, leave = never;
  for (int i = 0; i < 3; ++i) {
    const double inverse = 1 / v[i];
    const double t1 = (-h[i] - p[i]) * inverse, t2 = (h[i] - p[i]) * inverse;
    enter = std::max(enter, std::min(t1, t2));
    leave = std::min(leave, std::max(t1, t2));
  }
  return enter <= leave ? enter : never;
}

/// First t >= 0 within R of the segment from 0 to d: the infinite cylinder, else the caps.
inline double rounded_segment(const Vec& p, const Vec& v, const Vec& d, double R) {
  const double dd = d.dot(d), dv = d.dot(v), dp = d.dot(p);
  const double a = dd * v.dot(v) - dv * dv, b = dd * p.dot(v) - dp * dv, c = dd * p.dot(p) - dp * dp - R * R * dd;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return never;
  const double t = (-b - std::sqrt(discriminant)) / a;
  const double along = dp + t * dv;
  if (along > 0 && along < dd) return t >= 0 ? t : never;
  return ball(along <= 0 ? p : Vec(p - d), v, R);
}

/// First t >= 0 within R of the box [-h, h]: the widened slabs, then the edges and corners where that point is beside them.
inline double rounded_box(const Vec& p, const Vec& v, const Vec& h, double R) {
  const double t = slabs(p, v, h + Vec::Constant(R));
  if (t == never) return never;
  const Vec x = p + v * t;
  int outside = 0;
  Vec corner;
  for (int i = 0; i < 3; ++i) {
    corner[i] = x[i] < 0 ? -h[i] : h[i];
    outside += std::abs(x[i]) > h[i] ? 1 : 0;
  }
  if (outside < 2) return t;
  double first = never;
  for (int i = 0; i < 3; ++i) {
    if (outside == 2 && std::abs(x[i]) > h[i]) continue;
    Vec edge = Vec::Zero();
    edge[i] = -2 * corner[i];
    first = std::min(first, rounded_segment(p - corner, v, edge, R));
  }
  return first;
}

/// First t >= 0 at which two boxes, B moving by v, overlap on all fifteen axes.
inline double boxes(const Obb<double>& a, const Obb<double>& b, const Vec& v) {
  const Vec between = b.center - a.center;
  double enter = 0, leave = never;
  const auto axis = [&](const Vec& n) {
    double reach = 0;
    for (int k = 0; k < 3; ++k) {
      reach += a.half_extents[k] * std::abs(n.dot(a.axes.col(k))) + b.half_extents[k] * std::abs(n.dot(b.axes.col(k)));
    }
    const double distance = between.dot(n), speed = v.dot(n);
    if (std::abs(speed) < 1e-300) {
      if (std::abs(distance) > reach) leave = -1;
      return;
    }
    const double t1 = (-reach - distance) / speed, t2 = (reach - distance) / speed;
    enter = std::max(enter, std::min(t1, t2));
    leave = std::min(leave, std::max(t1, t2));
  };
  for (int i = 0; i < 3; ++i) {
    axis(a.axes.col(i));
    axis(b.axes.col(i));
    for (int j = 0; j < 3; ++j) axis(cross<double>(a.axes.col(i), b.axes.col(j)));
  }
  return enter <= leave ? enter : never;
}

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
  return std::min({rounded_segment(p - t.a, v, t.b - t.a, R), rounded_segment(p - t.b, v, t.c - t.b, R),
                   rounded_segment(p - t.c, v, t.a - t.c, R)});
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
