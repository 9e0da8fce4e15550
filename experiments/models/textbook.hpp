#pragma once
/// Closed forms as the textbooks have them, in any scalar: what a careful reader of a textbook would write, with no guard for range or
/// cancellation; infinity for a miss, and a NaN that arises is answered as one. They are the foils that the library's answers and its speed
/// are held against.
///
/// Sources: Ericson, Real-Time Collision Detection, 2005 (slabs 5.3.3, sphere and box 5.5.7, boxes 4.4.1). Written from the
/// formulas.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/swept/serves.hpp>

namespace thinwall::textbook {

/// "Never", as a time.
template <Scalar S> S never() { return std::numeric_limits<S>::infinity(); }

/// First t >= 0 with |p + v t| = R, by the quadratic formula.
template <Scalar S> S ball(const Vec3<S>& p, const Vec3<S>& v, const S& R) {
  using std::sqrt;
  const S a = v.dot(v), b = p.dot(v), c = p.dot(p) - R * R;
  const S discriminant = b * b - a * c;
  if (discriminant < S(0)) return never<S>();
  const S t = (-b - sqrt(discriminant)) / a;
  return t < S(0) ? never<S>() : t;
}

/// First t >= 0 with p + v t in the box [-h, h].
template <Scalar S> S slabs(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& h) {
  S enter = 0, leave = never<S>();
  for (int i = 0; i < 3; ++i) {
    const S inverse = S(1) / v[i];
    const S t1 = (-h[i] - p[i]) * inverse, t2 = (h[i] - p[i]) * inverse;
    enter = std::max(enter, std::min(t1, t2));
    leave = std::min(leave, std::max(t1, t2));
  }
  return enter <= leave ? enter : never<S>();
}

/// First t >= 0 within R of the segment from 0 to d: the infinite cylinder, else the caps.
template <Scalar S> S rounded_segment(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& d, const S& R) {
  using std::sqrt;
  const S dd = d.dot(d), dv = d.dot(v), dp = d.dot(p);
  const S a = dd * v.dot(v) - dv * dv, b = dd * p.dot(v) - dp * dv, c = dd * p.dot(p) - dp * dp - R * R * dd;
  const S discriminant = b * b - a * c;
  if (discriminant < S(0)) return never<S>();
  const S t = (-b - sqrt(discriminant)) / a;
  const S along = dp + t * dv;
  if (along > S(0) && along < dd) return t < S(0) ? never<S>() : t;
  return ball<S>(along <= S(0) ? p : Vec3<S>(p - d), v, R);
}

/// First t >= 0 within R of the box [-h, h]: the widened slabs, then the edges and corners where that point is beside them.
template <Scalar S> S rounded_box(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& h, const S& R) {
  using std::abs;
  const S t = slabs<S>(p, v, h + Vec3<S>::Constant(R));
  if (!(t < never<S>())) return t;
  const Vec3<S> x = p + v * t;
  int outside = 0;
  Vec3<S> corner;
  for (int i = 0; i < 3; ++i) {
    corner[i] = x[i] < S(0) ? S(-h[i]) : h[i];
    outside += abs(x[i]) > h[i] ? 1 : 0;
  }
  if (outside < 2) return t;
  S first = never<S>();
  for (int i = 0; i < 3; ++i) {
    if (outside == 2 && abs(x[i]) > h[i]) continue;
    Vec3<S> edge = Vec3<S>::Zero();
    edge[i] = S(-2) * corner[i];
    first = std::min(first, rounded_segment<S>(p - corner, v, edge, R));
  }
  return first;
}

/// First t >= 0 at which two boxes, B moving by v, overlap on all fifteen axes.
template <Scalar S> S boxes(const Obb<S>& a, const Obb<S>& b, const Vec3<S>& v) {
  using std::abs;
  const Vec3<S> between = b.center - a.center;
  S enter = 0, leave = never<S>();
  const auto axis = [&](const Vec3<S>& n) {
    S reach = 0;
    for (int k = 0; k < 3; ++k) {
      reach += a.half_extents[k] * abs(S(n.dot(a.axes.col(k)))) + b.half_extents[k] * abs(S(n.dot(b.axes.col(k))));
    }
    const S distance = between.dot(n), speed = v.dot(n);
    if (speed == S(0)) {
      if (abs(distance) > reach) leave = -1;
      return;
    }
    const S t1 = (-reach - distance) / speed, t2 = (reach - distance) / speed;
    enter = std::max(enter, std::min(t1, t2));
    leave = std::min(leave, std::max(t1, t2));
  };
  for (int i = 0; i < 3; ++i) {
    axis(a.axes.col(i));
    axis(b.axes.col(i));
    for (int j = 0; j < 3; ++j) axis(cross<S>(a.axes.col(i), b.axes.col(j)));
  }
  return enter <= leave ? enter : never<S>();
}

/// The squared distance from p to the segment from 0 to d.
template <Scalar S> S square_to_segment(const Vec3<S>& p, const Vec3<S>& d) {
  const S along = std::clamp(S(p.dot(d) / d.dot(d)), S(0), S(1));
  return (p - d * along).squaredNorm();
}

/// Time and verdict alone: a foil has no normal.
template <Scalar S> Toi<S> answer(bool at_start, const S& time) {
  if (at_start || time == S(0)) return {ToiStatus::overlapping, 1, S(0)};
  if (!(time == time)) return {ToiStatus::invalid, 1, time};
  if (!(time <= S(1))) return {ToiStatus::apart, 1};
  return {ToiStatus::hit, 1, time};
}

}  // namespace thinwall::textbook

namespace thinwall {

/// The same in the form of a method, so that they are asked what methods are.
template <Scalar S> struct Textbook {
  static constexpr std::string_view name = "textbook";
  S min_separation = 0;  ///< [length] not looked at
};

template <Scalar S> Toi<S> impact(const Textbook<S>&, const Moving<Sphere<S>>& a, const Moving<Sphere<S>>& b) {
  const Vec3<S> p = a.shape.center - b.shape.center, v = relative_displacement(a, b);
  const S R = a.shape.radius + b.shape.radius;
  return textbook::answer<S>(p.squaredNorm() <= R * R, textbook::ball<S>(p, v, R));
}

template <Scalar S> Toi<S> impact(const Textbook<S>&, const Moving<Aabb<S>>& box, const Moving<Sphere<S>>& sphere) {
  const Vec3<S> p = sphere.shape.center - box.shape.center, v = relative_displacement(sphere, box);
  const Vec3<S>& h = box.shape.half_extents;
  const S R = sphere.shape.radius;
  return textbook::answer<S>(excess_of<S>(p, h).squaredNorm() <= R * R, textbook::rounded_box<S>(p, v, h, R));
}

template <Scalar S> Toi<S> impact(const Textbook<S>&, const Moving<Aabb<S>>& a, const Moving<Aabb<S>>& b) {
  const Vec3<S> p = a.shape.center - b.shape.center, v = relative_displacement(a, b);
  return textbook::answer<S>(false, textbook::slabs<S>(p, v, a.shape.half_extents + b.shape.half_extents));
}

template <Scalar S> Toi<S> impact(const Textbook<S>&, const Moving<Obb<S>>& a, const Moving<Obb<S>>& b) {
  return textbook::answer<S>(false, textbook::boxes<S>(a.shape, b.shape, relative_displacement(b, a)));
}

template <Scalar S>
Toi<S> impact(const Textbook<S>&, const Moving<Capsule<S>>& capsule, const Moving<Sphere<S>>& sphere) {
  const Vec3<S> p = sphere.shape.center - capsule.shape.a, v = relative_displacement(sphere, capsule);
  const Vec3<S> d = capsule.shape.b - capsule.shape.a;
  const S R = sphere.shape.radius + capsule.shape.radius;
  return textbook::answer<S>(textbook::square_to_segment<S>(p, d) <= R * R, textbook::rounded_segment<S>(p, v, d, R));
}

}  // namespace thinwall
