#pragma once
/// Adversarial queries: two moving shapes, over decades of distance, size ratio, aspect, speed, offset from the origin, and
/// angle down to grazing.

#include <algorithm>
#include <cmath>
#include <optional>

#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

/// The numbers of one query: a stream of its own, so that no query depends on another.
class QueryNumbers {
 public:
  QueryNumbers(const RandomStream& stream, std::uint64_t query) : stream_(stream), query_(query) {}

  double operator()() {
    if (next_ == 4) {
      words_ = random_words(stream_, query_, draw_++);
      next_ = 0;
    }
    return uniform(words_[next_++]);
  }
  double between(double low, double high) { return low + (high - low) * (*this)(); }
  double decades(double low, double high) { return std::pow(10.0, between(low, high)); }
  bool one_in(double n) { return (*this)() * n < 1; }
  Vec3<double> direction() {
    Vec3<double> v;
    do {
      v = {between(-1, 1), between(-1, 1), between(-1, 1)};
    } while (v.squaredNorm() > 1 || v.squaredNorm() < 0.01);
    return safe_unit(v);
  }
  /// Any direction, `length` long: whoever draws the length draws it first, as compilers differ in the order of operands.
  Vec3<double> vector(double length) { return direction() * length; }

 private:
  RandomStream stream_;
  std::uint64_t query_, draw_ = 0;
  RandomWords words_{};
  std::size_t next_ = 4;
};

/// A right-handed frame that is turned any way.
inline Mat3<double> random_axes(QueryNumbers& u) {
  Mat3<double> axes;
  axes.col(0) = u.direction();
  axes.col(1) = safe_unit(cross<double>(axes.col(0), u.direction()));
  axes.col(2) = cross<double>(axes.col(0), axes.col(1));
  return axes;
}

/// From `least` to 1 along each axis.
inline Vec3<double> random_half_extents(QueryNumbers& u, double least) {
  const double x = u.between(least, 1), y = u.between(least, 1), z = u.between(least, 1);
  return {x, y, z};
}

/// Of a size up to this.
template <class A> A draw_shape(QueryNumbers& u, double size);
template <> inline Sphere<double> draw_shape(QueryNumbers& u, double size) {
  return {Vec3<double>::Zero(), size * u.decades(-1, 0)};
}
template <> inline Aabb<double> draw_shape(QueryNumbers& u, double size) {
  const double thinnest = u.one_in(3) ? -6 : -1;
  const double z = u.decades(-1, 0);
  const double y = u.decades(-1, 0);
  const double x = u.decades(thinnest, 0);
  return {Vec3<double>::Zero(), Vec3<double>(x, y, z) * size};
}
template <> inline Obb<double> draw_shape(QueryNumbers& u, double size) {
  const Vec3<double> half = draw_shape<Aabb<double>>(u, size).half_extents;
  Mat3<double> axes = random_axes(u);
  if (u.one_in(4)) {  // next to upright: nearly parallel edges
    const double tilt = u.decades(-16, -2);
    axes.col(0) = safe_unit(Vec3<double>(1, tilt, 0));
    axes.col(1) = safe_unit(Vec3<double>(-tilt, 1, 0));
  }
  axes.col(2) = cross<double>(axes.col(0), axes.col(1));
  return {Vec3<double>::Zero(), half, axes};
}
template <> inline Capsule<double> draw_shape(QueryNumbers& u, double size) {
  const double half_length = size * u.decades(-2, 0);
  const Vec3<double> half = u.vector(half_length);
  const double radius = size * u.decades(-3, 0);
  return {-half, half, radius};
}
template <> inline Triangle<double> draw_shape(QueryNumbers& u, double size) {
  const auto corner = [&] {
    const double from_middle = size * u.decades(-1, 0);
    return u.vector(from_middle);
  };
  const Vec3<double> a = corner();
  const Vec3<double> b = corner();
  const Vec3<double> c = corner();
  return {a, b, c};
}

/// Between the last that touches, from 0 on, and the first that does not, up to `farthest`, `halvings` times halved.
template <class Touches> double last_that_touches(const Touches& touches, double farthest, int halvings) {
  double hit = 0, miss = farthest;
  for (int i = 0; i < halvings; ++i) (touches((hit + miss) / 2) ? hit : miss) = (hit + miss) / 2;
  return hit;
}

/// A straight pass of A beside B, which rests about the origin.
template <class A, class B> struct StraightPass {
  static constexpr double before = -2, length = 4;  // of `reach`: from where to where nothing touches before and after

  A a;
  B b;
  Vec3<double> along;  ///< [1] unit, A's direction
  Vec3<double> aside;  ///< [length] across it, from B's center to A's line
  double reach;        ///< [length] farther apart than this, centers have no contact

  /// Where A's center is at first, with `share` of `aside`.
  Vec3<double> start(double share) const { return aside * share + along * (before * reach); }
  /// [length] Of a first contact, along the line from the place nearest to B's center.
  template <class S> std::optional<double> place_of(const Toi<S>& toi) const {
    if (toi.status == ToiStatus::apart) return {};
    return (length * toi.time + before) * reach;
  }
  std::optional<double> contact(double share) const {
    return place_of(time_of_impact(Moving<A>{moved(a, start(share)), along * (length * reach)}, at_rest(b)));
  }
};

template <class A, class B> struct MovingPair {
  Moving<A> a;
  Moving<B> b;
  double min_separation = 0;  ///< [length]
};

/// One query. `digits` [1] is how many decades of distance and offset the scalar can take: 8 for double, 3 for float.
template <class A, class B> MovingPair<A, B> draw_query(QueryNumbers& u, double digits) {
  const double small = u.one_in(3) ? u.decades(-digits, 0) : u.decades(-1, 0);
  const bool a_small = u.one_in(2);
  const A a = draw_shape<A>(u, a_small ? small : 1.0);
  const B b = draw_shape<B>(u, a_small ? 1.0 : small);
  const double reach = safe_norm(half_widths(a)) + safe_norm(half_widths(b));
  const double farthest = u.one_in(3) ? digits : 1;
  const double distance = reach * (1 + u.decades(-3, farthest));
  const Vec3<double> from = u.vector(distance);
  const double offset = reach * u.decades(-1, 0);
  const Vec3<double> aside = u.vector(offset);
  const double stretch = u.one_in(10) ? u.decades(0, 3) : u.between(0.6, 3);
  Vec3<double> drift = Vec3<double>::Zero();
  if (u.one_in(2)) {
    const double length = safe_norm(from) * u.decades(-3, 1);
    drift = u.vector(length);
  }
  const auto aimed = [&](double share) {
    return MovingPair<A, B>{{moved(a, from), (aside * share - from) * stretch + drift}, {b, drift}};
  };
  double share = 1;
  if (u.one_in(2.5)) {  // grazing: between the last hit and the first miss, to a distance of 1e-1 to 1e-15 of the reach
    const auto touches = [&](double tried) {
      const MovingPair<A, B> query = aimed(tried);
      return time_of_impact(query.a, query.b).status != ToiStatus::apart;
    };
    const double threshold = last_that_touches(touches, 4, 50);
    const double side = u.one_in(2) ? 1 : -1;
    share = threshold * (1 + side * u.decades(-15, -1));
  }
  MovingPair<A, B> query = aimed(share);
  if (u.one_in(5)) {
    const double length = reach * u.decades(0, digits);
    const Vec3<double> origin = u.vector(length);
    query.a.shape = moved(query.a.shape, origin);
    query.b.shape = moved(query.b.shape, origin);
  }
  return query;
}

/// [1] The direction of one of its edges; of a ball any.
template <class A> Vec3<double> draw_edge(QueryNumbers& u, const A& shape) {
  const auto any = static_cast<int>(u.between(0, 3));
  if constexpr (std::is_same_v<A, Capsule<double>> || std::is_same_v<A, Triangle<double>>) {
    return safe_unit(Vec3<double>(shape.b - shape.a));
  } else if constexpr (std::is_same_v<A, Obb<double>>) {
    return shape.axes.col(any);
  } else if constexpr (std::is_same_v<A, Aabb<double>>) {
    return Vec3<double>::Unit(any);
  } else {
    return u.direction();
  }
}

/// A query of which random directions draw none: a path all but along an edge, to a place beside it where the two touch; one
/// in three within a `min_separation`.
template <class A, class B> MovingPair<A, B> draw_query_along_edge(QueryNumbers& u) {
  const double size = u.decades(-2, 1);
  const A a = draw_shape<A>(u, size);
  const B b = draw_shape<B>(u, 1.0);
  const double reach = safe_norm(half_widths(a)) + safe_norm(half_widths(b));
  const bool along_a = std::is_same_v<B, Sphere<double>> || (!std::is_same_v<A, Sphere<double>> && u.one_in(2));
  const Vec3<double> edge = along_a ? draw_edge(u, a) : draw_edge(u, b);
  const Vec3<double> out = safe_unit(cross<double>(edge, u.direction())), aside = cross<double>(edge, out);
  const double min_separation = u.one_in(3) ? reach * u.decades(-6, 0) : 0;
  const Vec3<double> beside = edge * (u.between(-1, 1) * reach);
  const auto touches = [&](double height) {
    return time_of_impact(at_rest(moved(a, Vec3<double>(beside + out * height))), at_rest(b)).status ==
           ToiStatus::overlapping;
  };
  const Vec3<double> place = beside + out * (last_that_touches(touches, 2 * reach, 50) + min_separation);
  const double tilt = u.decades(-5, 0), skew = u.decades(-5, 0), side = u.between(-1, 1);
  const double speed = reach * u.decades(-1, 3);
  const Vec3<double> path = (edge + aside * (skew * side) - out * tilt) * speed;
  return {{moved(a, Vec3<double>(place - path * u())), path}, at_rest(b), min_separation};
}

/// A method's kernel itself, in the shapes' own scalar: what the front door calls, without the promotion to double.
template <class Method, Shape A, Shape B>
Toi<typename A::Scalar> kernel_impact(const Method& method, const Moving<A>& a, const Moving<B>& b) {
  if constexpr (A::rank < B::rank) {
    return flipped(impact(method, b, a));
  } else {
    return impact(method, a, b);
  }
}

}  // namespace thinwall
