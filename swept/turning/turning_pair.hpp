#pragma once
/// Two turning shapes as a proof sees them: centers that fly straight, and around each a core of at most three vectors that turns.

#include <algorithm>
#include <array>
#include <limits>

#include <thinwall/swept/turning.hpp>

namespace thinwall {

/// A core around its center: all sums of x_k v_k with |x_k| <= 1 (none for a ball, one for a rod, three for a box), or the triangle between
/// three corners.
template <Scalar S> struct CoreVectors {
  std::array<Vec3<S>, 3> v;
  int count = 0;
  bool corners = false;

  void add(const Vec3<S>& vector) { v[static_cast<std::size_t>(count++)] = vector; }
  auto begin() const { return v.begin(); }
  auto end() const { return v.begin() + count; }
};

/// What f makes of each vector.
template <Scalar S, class F> CoreVectors<S> mapped(const CoreVectors<S>& core, const F& f) {
  CoreVectors<S> made;
  made.corners = core.corners;
  for (const Vec3<S>& v : core) made.add(f(v));
  return made;
}

/// [length] how far the farthest point of a core is from its center.
template <Scalar S> S farthest(const CoreVectors<S>& core) {
  using std::sqrt;
  S most = 0;
  const int signs = core.corners ? core.count : core.count > 1 ? 1 << (core.count - 1) : core.count;
  for (int s = 0; s < signs; ++s) {
    Vec3<S> sum = Vec3<S>::Zero();
    for (int k = 0; k < core.count; ++k) {
      const Vec3<S>& v = core.v[static_cast<std::size_t>(k)];
      if (core.corners) {
        if (k == s) sum = v;
      } else if ((s >> k & 1) == 0) {
        sum += v;
      } else {
        sum -= v;
      }
    }
    most = std::max(most, S(sum.squaredNorm()));
  }
  return sqrt(most);
}

/// How far a core reaches from its center along n.
template <Scalar S> S core_reach(const CoreVectors<S>& core, const Vec3<S>& n) {
  S reach = 0;
  if (core.corners) reach = std::max({n.dot(core.v[0]), n.dot(core.v[1]), n.dot(core.v[2])});
  if (!core.corners)
    for (const Vec3<S>& v : core) reach += largest(S(n.dot(v)));
  return reach;
}

template <Scalar S> CoreVectors<S> core_vectors(const Sphere<S>&) { return {}; }
template <Scalar S> CoreVectors<S> core_vectors(const Capsule<S>& capsule) {
  CoreVectors<S> core;
  core.add((capsule.b - capsule.a) / S(2));
  return core;
}
template <Scalar S> CoreVectors<S> core_vectors(const Obb<S>& box) {
  CoreVectors<S> core;
  for (int k = 0; k < 3; ++k) core.add(box.axes.col(k) * box.half_extents[k]);
  return core;
}
template <Scalar S> CoreVectors<S> core_vectors(const Triangle<S>& t) {
  const Vec3<S> middle = center(t);
  CoreVectors<S> core;
  core.corners = true;
  core.add(t.a - middle);
  core.add(t.b - middle);
  core.add(t.c - middle);
  return core;
}

/// |x| of a vector whose square is in range: the front door sees to it.
template <Scalar S> S norm(const Vec3<S>& v) {
  using std::sqrt;
  return sqrt(v.squaredNorm());
}
/// How much of x is across a unit vector.
template <Scalar S> S across(const Vec3<S>& axis, const Vec3<S>& x) { return norm<S>(cross(axis, x)); }

template <Scalar S> struct TurningBody {
  Vec3<S> center, path;                ///< [length] at the start, and what it flies
  CoreVectors<S> core;                 ///< [length] at the start, around the center
  S radius;                            ///< [length] around the core
  Vec3<S> rotation = Vec3<S>::Zero();  ///< [rad] zero for a ball, which may turn as it likes
  Vec3<S> axis = axis_vector<S>(0);    ///< unit, of the rotation
  S angle = 0;                         ///< [rad] >= 0
  S far = 0, off_axis = 0;             ///< [length] the farthest point of the core from the center, and from the axis

  template <Shape A>
  explicit TurningBody(const Turning<A>& m)
      : center(thinwall::center(m.shape)),
        path(m.displacement),
        core(core_vectors(m.shape)),
        radius(skin_radius(m.shape)) {
    if (core.count == 0) return;
    far = farthest(core);
    if (m.rotation == Vec3<S>::Zero()) return;
    rotation = m.rotation;
    angle = safe_norm(rotation);
    axis = safe_unit(rotation);
    off_axis = farthest(mapped(core, [this](const Vec3<S>& v) { return cross(axis, v); }));
  }
  bool turns() const { return angle > S(0); }
  /// A vector of the world as the body sees it, and one of its own in the world.
  Vec3<S> seen(const Mat3<S>& turn, const Vec3<S>& v) const {
    return turns() ? Vec3<S>(turn.col(0).dot(v), turn.col(1).dot(v), turn.col(2).dot(v)) : v;
  }
  Vec3<S> in_world(const Mat3<S>& turn, const Vec3<S>& v) const {
    return turns() ? Vec3<S>(turn.col(0) * v[0] + turn.col(1) * v[1] + turn.col(2) * v[2]) : v;
  }
  /// The rotation since the start.
  Mat3<S> turn_at(const S& time) const {
    return turns() ? rotation_about<S>(axis, angle * time) : Mat3<S>(Mat3<S>::Identity());
  }
};

/// Both, and what every bound between them is made of.
template <Scalar S> struct TurningPair {
  TurningBody<S> a, b;
  Vec3<S> between, path;  ///< [length] from the center of A to that of B at the start, and how that changes
  S reach;                ///< [length] both radii and the minimal separation
  S turn;                 ///< [rad] both angles
  S cross_rate = 0;       ///< [rad^2] |u x v| + |u - v|^2 of the rotations u and v, where both are any
  S speed;                ///< [length] per step: no two points near each other faster
  S margin;               ///< [length] what rounding may take from a gap (docs/turning.md, "Rounding")

  template <Shape A, Shape B>
  TurningPair(const Turning<A>& of_a, const Turning<B>& of_b, const S& min_separation)
      : a(of_a),
        b(of_b),
        between(b.center - a.center),
        path(b.path - a.path),
        reach(a.radius + b.radius + min_separation),
        turn(a.angle + b.angle),
        speed(norm(path) + a.angle * a.off_axis + b.angle * b.off_axis) {
    S size = reach;
    for (const TurningBody<S>* body : {&a, &b}) {
      size += body->center.cwiseAbs().sum() + body->path.cwiseAbs().sum();
      for (const Vec3<S>& v : body->core) size += v.cwiseAbs().sum();
    }
    if (a.turns() && b.turns())
      cross_rate = norm<S>(cross(a.rotation, b.rotation)) + (a.rotation - b.rotation).squaredNorm();
    constexpr S u = std::numeric_limits<S>::epsilon() / 2;
    margin = S(64) * u * (S(1) + turn / S(4)) * size;
  }
};

/// The two at one time: their rotations since the start, and the way between the centers.
template <Scalar S> struct TurningInstant {
  S time;
  Mat3<S> turn_a, turn_b;
  Vec3<S> between;
};
template <Scalar S> TurningInstant<S> instant(const TurningPair<S>& pair, const S& time) {
  return {time, pair.a.turn_at(time), pair.b.turn_at(time), pair.between + pair.path * time};
}

}  // namespace thinwall
