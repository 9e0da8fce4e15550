#pragma once
/// Two turning shapes as a proof sees them: centers that fly straight, and around each a core of at most three vectors that turns.

#include <algorithm>
#include <array>
#include <limits>

#include <thinwall/swept/methods/tolerance.hpp>
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

/// The cosine and the sine of an angle that a body has turned by.
template <Scalar S> struct Phase {
  S cosine = 1, sine = 0;
  Phase back() const { return {cosine, -sine}; }
};

/// A vector that turns about an axis: its part along the axis, and where the rest is at the start and a quarter turn on.
template <Scalar S> struct Swing {
  Vec3<S> along, across, ahead;
  Vec3<S> at(const Phase<S>& phase) const { return along + (across * phase.cosine + ahead * phase.sine); }
};

template <Scalar S> struct TurningBody {
  Vec3<S> center, path;                ///< [length] at the start, and what it flies
  CoreVectors<S> core;                 ///< [length] at the start, around the center
  S radius;                            ///< [length] around the core
  Vec3<S> rotation = Vec3<S>::Zero();  ///< [rad] zero for a ball, which may turn as it likes
  Vec3<S> axis = axis_vector<S>(0);    ///< unit, of the rotation
  S angle = 0;                         ///< [rad] >= 0
  S far = 0, off_axis = 0;             ///< [length] the farthest point of the core from the center, and from the axis
  std::array<Swing<S>, 3> swings;      ///< [length] of the core's vectors, where it turns

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
    for (std::size_t k = 0; k < static_cast<std::size_t>(core.count); ++k) swings[k] = swing(core.v[k]);
    CoreVectors<S> ahead = core;
    for (std::size_t k = 0; k < static_cast<std::size_t>(core.count); ++k) ahead.v[k] = swings[k].ahead;
    off_axis = farthest(ahead);
  }
  bool turns() const { return angle > S(0); }
  Swing<S> swing(const Vec3<S>& v) const {
    const Vec3<S> along = axis * axis.dot(v);
    return {along, v - along, cross(axis, v)};
  }
  /// How far it has turned by `time`.
  Phase<S> phase_at(const S& time) const {
    using std::cos, std::sin;
    if (!turns()) return {};
    const S so_far = angle * time;
    return {cos(so_far), sin(so_far)};
  }
  /// What a vector of the start is then.
  Vec3<S> turned(const Phase<S>& phase, const Vec3<S>& v) const { return turns() ? swing(v).at(phase) : v; }
  CoreVectors<S> turned_core(const Phase<S>& phase) const {
    CoreVectors<S> now = core;
    if (turns())
      for (std::size_t k = 0; k < static_cast<std::size_t>(core.count); ++k) now.v[k] = swings[k].at(phase);
    return now;
  }
};

/// [1] How far a box's axes are from orthonormal: closest points take them to be, planes take them as they are.
template <Scalar S> S untruth(const Obb<S>& box) {
  const Mat3<S> gram = box.axes.transpose() * box.axes;
  return (gram - Mat3<S>::Identity()).cwiseAbs().sum();
}
template <Shape A> typename A::Scalar untruth(const A&) { return 0; }

/// Both, and what every bound between them is made of.
template <Scalar S> struct TurningPair {
  TurningBody<S> a, b;
  Vec3<S> between, path;  ///< [length] from the center of A to that of B at the start, and how that changes
  S reach;                ///< [length] both radii and the minimal separation
  S turn;                 ///< [rad] both angles
  S cross_rate = 0;       ///< [rad^2] |u x v| + |u - v|^2 of the rotations u and v, where both are any
  S axes_sine = 0;        ///< [1] between their axes
  S speed;                ///< [length] per step: no two points near each other faster
  S margin;               ///< [length] what rounding may take from a gap (docs/turning.md, "Rounding")
  S hidden;  ///< [length] a gap that roundings and untrue axes may hide; without a radius the direction across it is lost before
  S first = 0, last = 1;  ///< [1] only between them do the balls meet within which the shapes turn; first > last: never

  template <Shape A, Shape B>
  TurningPair(const Turning<A>& of_a, const Turning<B>& of_b, const S& min_separation)
      : a(of_a),
        b(of_b),
        between(b.center - a.center),
        path(b.path - a.path),
        reach(a.radius + b.radius + min_separation),
        turn(a.angle + b.angle),
        speed(safe_norm(path) + a.angle * a.off_axis + b.angle * b.off_axis) {
    S size = reach;
    for (const TurningBody<S>* body : {&a, &b}) {
      size += body->center.cwiseAbs().sum() + body->path.cwiseAbs().sum();
      for (const Vec3<S>& v : body->core) size += v.cwiseAbs().sum();
    }
    if (a.turns() && b.turns()) {
      cross_rate = norm<S>(cross(a.rotation, b.rotation)) + (a.rotation - b.rotation).squaredNorm();
      axes_sine = across(a.axis, b.axis);
    }
    const S u = std::numeric_limits<S>::epsilon() / 2;
    margin = S(64) * u * (S(1) + turn / S(4)) * size;
    hidden = std::max(S(S(32) * margin), reach > S(0) ? S(0) : S(half_digits<S>() * size));
    hidden += S(2) * (untruth(of_a.shape) + untruth(of_b.shape)) * (a.far + b.far + reach);
    when_balls_meet();
  }

 private:
  /// |between + path t| <= R, with R so much larger than it is that no rounding of the squares matters; not asked where it would.
  void when_balls_meet() {
    using std::sqrt;
    const S radius = (a.far + b.far + reach) * (S(1) + constant_power_of_two<S, -16>()) + S(16) * margin;
    const S apart = between.squaredNorm() - radius * radius, speed_square = path.squaredNorm();
    const S far_away = 4096, fastest = largest(path);
    if (!(between.squaredNorm() + speed_square < far_away * far_away * radius * radius)) return;
    if (!products_in_range(radius) || (fastest > S(0) && !products_in_range(fastest))) return;
    const S approach = -between.dot(path), under_root = approach * approach - speed_square * apart;
    if (apart > S(0) && (approach <= S(0) || under_root < S(0))) {
      first = S(2);
      return;
    }
    if (speed_square == S(0)) return;
    const S root = sqrt(std::max(S(0), under_root));
    if (apart > S(0)) first = apart / (approach + root);
    last = std::min(S(1), S((approach + root) / speed_square));
  }
};

/// The two at one time: how far they have turned, their cores then, and the way between the centers.
template <Scalar S> struct TurningInstant {
  S time;
  Phase<S> phase_a, phase_b;
  CoreVectors<S> core_a, core_b;
  Vec3<S> between;
};
template <Scalar S> TurningInstant<S> instant(const TurningPair<S>& pair, const S& time) {
  const Phase<S> phase_a = pair.a.phase_at(time), phase_b = pair.b.phase_at(time);
  return {time,
          phase_a,
          phase_b,
          pair.a.turned_core(phase_a),
          pair.b.turned_core(phase_b),
          pair.between + pair.path * time};
}

/// The shape with its center elsewhere, its core turned by `phase` into `core`.
template <Scalar S>
Sphere<S> pose_of(const Sphere<S>& ball, const TurningBody<S>&, const Phase<S>&, const CoreVectors<S>&,
                  const Vec3<S>& center) {
  return {center, ball.radius};
}
template <Scalar S>
Capsule<S> pose_of(const Capsule<S>& capsule, const TurningBody<S>&, const Phase<S>&, const CoreVectors<S>& core,
                   const Vec3<S>& center) {
  return {center - core.v[0], center + core.v[0], capsule.radius};
}
template <Scalar S>
Triangle<S> pose_of(const Triangle<S>&, const TurningBody<S>&, const Phase<S>&, const CoreVectors<S>& core,
                    const Vec3<S>& center) {
  return {center + core.v[0], center + core.v[1], center + core.v[2]};
}
template <Scalar S>
Obb<S> pose_of(const Obb<S>& box, const TurningBody<S>& body, const Phase<S>& phase, const CoreVectors<S>&,
               const Vec3<S>& center) {
  Obb<S> pose{center, box.half_extents, box.axes};
  for (int k = 0; k < 3; ++k) pose.axes.col(k) = body.turned(phase, box.axes.col(k));
  return pose;
}

}  // namespace thinwall
