#pragma once
/// Draws the queries of a place: in doubles, to be rounded to each precision afterwards.

#include <cmath>
#include <optional>

#include <thinwall/experiments/accuracy/draw.hpp>
#include <thinwall/experiments/extremes/axes.hpp>

namespace thinwall {

/// One query, and what it is meant to be before it is rounded.
template <class A, class B> struct ExtremeQuery {
  Moving<A> a;
  Moving<B> b;
  bool meant_to_touch;
};

/// A shape about the origin, whose size is about 1.
template <class A> struct PlainDraw;
template <> struct PlainDraw<Sphere<double>> {
  static Sphere<double> draw(QueryNumbers& u) { return {Vec3<double>::Zero(), u.between(0.5, 1)}; }
};
template <> struct PlainDraw<Aabb<double>> {
  static Aabb<double> draw(QueryNumbers& u) {
    const double x = u.between(0.3, 1), y = u.between(0.3, 1), z = u.between(0.3, 1);
    return {Vec3<double>::Zero(), {x, y, z}};
  }
};
template <> struct PlainDraw<Obb<double>> {
  static Obb<double> draw(QueryNumbers& u) {
    const Vec3<double> half = PlainDraw<Aabb<double>>::draw(u).half_extents;
    return {Vec3<double>::Zero(), half, random_axes(u)};
  }
};
template <> struct PlainDraw<Capsule<double>> {
  static Capsule<double> draw(QueryNumbers& u) {
    const Vec3<double> direction = u.direction();
    const Vec3<double> half = direction * u.between(0.3, 1);
    return {-half, half, u.between(0.2, 0.5)};
  }
};
template <> struct PlainDraw<Triangle<double>> {
  static Triangle<double> draw(QueryNumbers& u) {
    const Vec3<double> a = u.direction(), b = u.direction(), c = u.direction();
    return {a, b, c};
  }
};

/// The shape with every length multiplied by `factor`.
template <class S> Sphere<S> stretched(const Sphere<S>& s, const S& f) { return {s.center * f, s.radius * f}; }
template <class S> Aabb<S> stretched(const Aabb<S>& b, const S& f) { return {b.center * f, b.half_extents * f}; }
template <class S> Obb<S> stretched(const Obb<S>& b, const S& f) { return {b.center * f, b.half_extents * f, b.axes}; }
template <class S> Capsule<S> stretched(const Capsule<S>& c, const S& f) { return {c.a * f, c.b * f, c.radius * f}; }
template <class S> Triangle<S> stretched(const Triangle<S>& t, const S& f) { return {t.a * f, t.b * f, t.c * f}; }

/// The radius of a ball around the shape.
inline double size_of(const Sphere<double>& s) { return s.radius; }
template <class A> double size_of(const A& shape) { return safe_norm(half_widths(shape)); }

template <class B>
concept HasHalfExtents = requires(const B& box) { box.half_extents; };
template <class A>
concept HasRadius = requires(const A& ball) { ball.radius; };

/// True if the axis says something about the pair: only a box can be thin.
template <class A, class B> constexpr bool concerns(ExtremeAxis axis) {
  return axis != ExtremeAxis::thickness || HasHalfExtents<B>;
}

/// A straight pass of A beside B, which rests about the origin.
template <class A, class B> struct ExtremePass {
  A a;
  B b;
  Vec3<double> along;  ///< [1] unit, A's direction
  Vec3<double> aside;  ///< [length] across it, as long as the size
  double size;         ///< [length] R

  Moving<A> whole(double share) const {
    const Vec3<double> start = aside * share - along * (2 * size);
    return {moved(a, start), along * (4 * size)};
  }
  /// [length] From the place nearest to B's center to first contact, along the line; nothing if there is none.
  std::optional<double> contact(double share) const {
    const Toi<double> toi = time_of_impact(whole(share), at_rest(b));
    if (toi.status == ToiStatus::apart) return {};
    return (4 * toi.time - 2) * size;
  }
  /// The share of `aside` at which the pass just touches.
  double threshold() const {
    double hit = 0, miss = 2;
    for (int i = 0; i < 60; ++i) (contact((hit + miss) / 2) ? hit : miss) = (hit + miss) / 2;
    return hit;
  }
};

/// One query in two moves along a coordinate axis beside a body at rest at the origin: so that what rounding does to a far
/// path does not turn it away from what it should meet. The others run any way, and both bodies move.
template <class A, class B> ExtremeQuery<A, B> draw_extreme(QueryNumbers& u, const Extreme& e) {
  ExtremePass<A, B> pass;
  pass.a = stretched(PlainDraw<A>::draw(u), e.ratio);
  pass.b = PlainDraw<B>::draw(u);
  if constexpr (HasHalfExtents<B>) {
    pass.b.half_extents[0] *= e.thickness;
    if constexpr (HasRadius<A>) pass.a.radius *= e.thickness;
  }
  pass.size = size_of(pass.a) + size_of(pass.b);
  const bool upright = u.one_in(2);
  const Vec3<double> any = u.direction(), other = u.direction(), off = u.direction(), drifting = u.direction();
  const int axis = static_cast<int>(3 * u());
  pass.along = upright ? axis_vector<double>(axis, any[0] < 0) : any;
  pass.aside = safe_unit(cross<double>(pass.along, other)) * pass.size;

  const double threshold = pass.threshold();
  const bool touches = u.one_in(e.grazing > 0 ? 2 : 4.0 / 3);
  const double inside = u.between(0, 0.95), outside = u.between(1.05, 1.5), phase = u.between(0.3, 0.9);
  double share = threshold * (touches ? inside : outside);
  if (e.grazing > 0) share = threshold * (touches ? 1 - e.grazing : 1 + e.grazing);
  const double contact = pass.contact(touches ? share : threshold).value_or(0);
  const double lead = e.speed > 0 ? std::min(3.0, phase * e.speed) * pass.size : e.distance * pass.size;
  const double path = e.speed > 0 ? e.speed * pass.size : lead / phase;

  const Vec3<double> origin = e.offset > 0
                                  ? Vec3<double>(off * (e.offset * pass.size))
                                  : Vec3<double>(upright ? Vec3<double>::Zero() : Vec3<double>(off * pass.size));
  const Vec3<double> drift = upright ? Vec3<double>::Zero() : Vec3<double>(drifting * (path / 4));
  const Vec3<double> start = origin + pass.aside * share + pass.along * (contact - lead);
  const A a = moved(pass.a, start);
  const B b = moved(pass.b, origin);
  const Vec3<double> v = pass.along * path + drift;
  return {{stretched(a, e.scale), v * e.scale}, {stretched(b, e.scale), drift * e.scale}, touches};
}

}  // namespace thinwall
