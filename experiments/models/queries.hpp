#pragma once
/// Adversarial queries: two moving shapes, over decades of distance, size ratio, aspect, speed, offset from the origin, and
/// angle down to grazing.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/swept/reach_along.hpp>
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

/// The same, or as engines keep it: of a quaternion, whose roundings have it lean several times as far from right angles.
inline Mat3<double> drawn_axes(QueryNumbers& u) {
  if (u.one_in(2)) return random_axes(u);
  const double w = u.between(-1, 1), x = u.between(-1, 1), y = u.between(-1, 1), z = u.between(-1, 1);
  const double length = std::hypot(std::hypot(w, x), std::hypot(y, z));
  return Eigen::Quaterniond(w / length, x / length, y / length, z / length).toRotationMatrix();
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
  Mat3<double> axes = drawn_axes(u);
  if (u.one_in(4)) {  // next to upright: nearly parallel edges
    const double tilt = u.decades(-16, -2);
    axes.col(0) = safe_unit(Vec3<double>(1, tilt, 0));
    axes.col(1) = safe_unit(Vec3<double>(-tilt, 1, 0));
    axes.col(2) = cross<double>(axes.col(0), axes.col(1));
  }
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

  void move(const Vec3<double>& by) {
    a.shape = moved(a.shape, by);
    b.shape = moved(b.shape, by);
  }
};

/// B rests about the origin, and A passes `place` after that share of its path.
template <class A, class B>
MovingPair<A, B> passing(const A& a, const B& b, const Vec3<double>& place, const Vec3<double>& path, double share,
                         double min_separation) {
  return {{moved(a, Vec3<double>(place - path * share)), path}, at_rest(b), min_separation};
}

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
    query.move(u.vector(length));
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
  return passing(a, b, place, path, u(), min_separation);
}

/// What a scene built by hand is made of: round numbers, many of them one number, its half or its double; and axes along the
/// coordinates or turned about one of them by a multiple of 15 degrees, many by the same, or, one in eight, turned any way.
class UprightNumbers {
 public:
  explicit UprightNumbers(QueryNumbers& u)
      : u_(u), parts_(u.one_in(2) ? 4 : 10), up_(any(3)), turns_(any(24)), common_(round_size()) {}

  /// From 0 to n - 1.
  int any(int n) { return static_cast<int>(u_.between(0, n)); }
  double sign() { return u_.one_in(2) ? 1 : -1; }
  /// [length] > 0.
  double size() {
    const int kind = any(8);
    return kind < 4 ? round_size() : kind < 6 ? common_ : kind < 7 ? common_ / 2 : common_ * 2;
  }
  Vec3<double> sizes() {
    const double x = size(), y = size(), z = size();
    return {x, y, z};
  }
  Mat3<double> axes() {
    const int kind = any(8), turns = kind < 3 ? 0 : kind < 6 ? turns_ : any(24);
    if (kind == 7) return drawn_axes(u_);
    Mat3<double> axes = Mat3<double>::Identity();
    if (turns == 0) return axes;
    const double yaw = turns * std::numbers::pi / 12;  // rounded, as sine and cosine are
    const Vec3<double> x = axes.col((up_ + 1) % 3), y = axes.col((up_ + 2) % 3);
    axes.col((up_ + 1) % 3) = x * std::cos(yaw) + y * std::sin(yaw);
    axes.col((up_ + 2) % 3) = y * std::cos(yaw) - x * std::sin(yaw);
    return axes;
  }

 private:
  double round_size() { return std::max(1.0, std::round(std::exp2(u_.between(-4, 10)) * parts_)) / parts_; }

  QueryNumbers& u_;
  double parts_;  ///< [1] of a unit of length
  int up_, turns_;
  double common_;  ///< [length]
};

/// About the origin. One ball or capsule in eight has no radius.
template <class A> A draw_upright_shape(UprightNumbers& numbers) {
  const Vec3<double> middle = Vec3<double>::Zero(), sizes = numbers.sizes();
  const Mat3<double> axes = numbers.axes();
  const int any = numbers.any(3);
  const Vec3<double> along = axes.col(any) * sizes[0], across = axes.col((any + 1) % 3) * sizes[1];
  const double radius = numbers.any(8) > 0 ? sizes[2] : 0;
  if constexpr (std::is_same_v<A, Sphere<double>>) {
    return {middle, radius};
  } else if constexpr (std::is_same_v<A, Aabb<double>>) {
    return {middle, sizes};
  } else if constexpr (std::is_same_v<A, Obb<double>>) {
    return {middle, sizes, axes};
  } else if constexpr (std::is_same_v<A, Capsule<double>>) {
    return {-along, along, radius};
  } else {
    return {-along - across, along * 2 - across, across * 2 - along};
  }
}

/// A query of which random numbers draw none: shapes of a scene built by hand, with faces, edges or middles level but for roundings,
/// along an axis or from one round place to another. Two in three pass a place where a face of a box around the one touches the other's.
template <class A, class B> MovingPair<A, B> draw_upright_query(QueryNumbers& u) {
  UprightNumbers numbers(u);
  const A a = draw_upright_shape<A>(numbers);
  const B b = draw_upright_shape<B>(numbers);
  const double min_separation = u.one_in(3) ? numbers.size() : 0;
  const Mat3<double> axes = numbers.axes();
  const bool ends_within = u.one_in(3), slides = u.one_in(10);
  const int first = numbers.any(3);
  Vec3<double> place = Vec3<double>::Zero(), path = Vec3<double>::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec3<double> axis = axes.col((first + i) % 3) * numbers.sign();
    const double of_a = reach_along<double>(a, -axis), of_b = reach_along(b, axis);
    const double touching = of_a + of_b + min_separation, beside = numbers.size(), way = numbers.size();
    const int kind = i > 0 ? numbers.any(10) : ends_within ? 9 : 0;
    const double level = kind == 0 ? touching : kind < 3 ? of_b - of_a : kind < 5 ? beside : 0;
    place += axis * level;
    if (i == 0 ? !slides : u.one_in(2)) path -= axis * (i == 0 ? touching - level + way : way);
  }
  MovingPair<A, B> query = passing(a, b, place, path, ends_within ? 1 : numbers.any(9) / 8.0, min_separation);
  if (u.one_in(4)) {
    const Vec3<double> drift = axes * numbers.sizes();
    query.a.displacement += drift;
    query.b.displacement += drift;
  }
  if (u.one_in(5)) {
    const double far = std::pow(10.0, 1 + numbers.any(7));
    const int x = numbers.any(3), y = numbers.any(3), z = numbers.any(3);
    query.move(Vec3<double>(x - 1, y - 1, z - 1) * far);
  }
  return query;
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
