#pragma once
/// Query sets for the benchmarks: 100 000 shots, half of them hits, in random order, all apart at the start, streamed from
/// memory. A set small or regular enough for the branch predictor to learn would flatter every method.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <thinwall/discrete/triangle.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall::bench {

inline constexpr std::size_t query_count = 100'000;
inline constexpr double never = std::numeric_limits<double>::infinity();

/// A reproducible stream of uniform numbers in [0, 1): SplitMix64.
class Uniform {
 public:
  double operator()() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  double between(double low, double high) { return low + (high - low) * (*this)(); }
  Vec3<double> direction() {
    Vec3<double> v;
    do {
      v = {between(-1, 1), between(-1, 1), between(-1, 1)};
    } while (v.squaredNorm() > 1 || v.squaredNorm() < 0.01);
    return v / std::sqrt(v.squaredNorm());
  }
  Mat3<double> axes() {
    Mat3<double> m;
    m.col(0) = direction();
    m.col(1) = safe_unit(cross<double>(m.col(0), direction()));
    m.col(2) = cross<double>(m.col(0), m.col(1));
    return m;
  }

 private:
  std::uint64_t state_ = 1;
};

/// A shape around the origin, of a size between 0.05 and 0.5.
template <class A> A any_shape(Uniform& uniform);
template <> inline Sphere<double> any_shape(Uniform& u) { return {Vec3<double>::Zero(), u.between(0.05, 0.5)}; }
template <> inline Aabb<double> any_shape(Uniform& u) {
  return {Vec3<double>::Zero(), {u.between(0.05, 0.5), u.between(0.05, 0.5), u.between(0.05, 0.5)}};
}
template <> inline Obb<double> any_shape(Uniform& u) {
  return {Vec3<double>::Zero(), any_shape<Aabb<double>>(u).half_extents, u.axes()};
}
template <> inline Capsule<double> any_shape(Uniform& u) {
  const Vec3<double> half = u.direction() * u.between(0.05, 0.5);
  return {-half, half, u.between(0.05, 0.25)};
}
template <> inline Triangle<double> any_shape(Uniform& u) {
  return {u.direction() * u.between(0.2, 0.6), u.direction() * u.between(0.2, 0.6),
          u.direction() * u.between(0.2, 0.6)};
}

template <class A, class B> struct Shot {
  Moving<A> a;
  Moving<B> b;
};

/// A ray at a shape; a hit is within one of its directions.
template <class B> struct RayShot {
  Ray<double> ray;
  B shape;
};

/// Two shapes at one instant.
template <class A, class B> struct Pose {
  A a;
  B b;
};

/// Queries and their true answers in long double, `never` for none: a shot's or a ray's time, a pose's depth.
template <class Query> struct QuerySet {
  std::vector<Query> queries;
  std::vector<double> truth;
};
template <class A, class B> using Shots = QuerySet<Shot<A, B>>;
template <class B> using Rays = QuerySet<RayShot<B>>;
template <class A, class B> using Poses = QuerySet<Pose<A, B>>;

/// The largest answer that is a hit.
template <class A, class B> double last_hit(const Shot<A, B>&) { return 1; }
template <class B> double last_hit(const RayShot<B>&) { return 1; }
template <class A, class B> double last_hit(const Pose<A, B>&) { return std::numeric_limits<double>::max(); }

/// [length] What an answer's unit is worth.
template <class A, class B> double unit_length(const Shot<A, B>& q) {
  return std::sqrt(relative_displacement(q.a, q.b).squaredNorm());
}
template <class B> double unit_length(const RayShot<B>& q) { return std::sqrt(q.ray.direction.squaredNorm()); }
template <class A, class B> double unit_length(const Pose<A, B>&) { return 1; }

/// Shots of shapes made by `make_a` at shapes made by `make_b`, hits as likely as misses, both moving, along `axes` alone.
template <class A, class B, class MakeA, class MakeB>
Shots<A, B> shots(const MakeA& make_a, const MakeB& make_b, const Vec3<double>& axes = {1, 1, 1}) {
  Uniform uniform;
  Shots<A, B> set;
  bool wanted = true;
  while (set.queries.size() < query_count) {
    const auto vector = [&](double least, double most) -> Vec3<double> {
      return (uniform.direction() * uniform.between(least, most)).cwiseProduct(axes);
    };
    const Vec3<double> from = vector(1.5, 3), aim = vector(0, 2), drift = vector(0, 2);
    const Moving<A> a{moved<double>(make_a(uniform), from), (aim - from) * uniform.between(0.5, 3) + drift};
    const Moving<B> b{make_b(uniform), drift};
    const auto truth = time_of_impact(cast<long double>(a), cast<long double>(b));
    const bool hit = truth.status == ToiStatus::hit;
    if (hit != wanted || overlaps_within(a.shape, b.shape, 0.02)) continue;
    wanted = uniform() < 0.5;
    set.queries.push_back({a, b});
    set.truth.push_back(hit ? static_cast<double>(truth.time) : never);
  }
  return set;
}

/// Bullets at thin walls, and any two shapes: the sets are made when first asked for.
template <class A, class B> const Shots<A, B>& any_shots() {
  static const Shots<A, B> set = shots<A, B>([](Uniform& u) { return any_shape<A>(u); },  //
                                             [](Uniform& u) { return any_shape<B>(u); });
  return set;
}
/// A ray along each shot's relative motion, from the center of A.
template <class B> const Rays<B>& any_rays() {
  static const Rays<B> set = [] {
    Rays<B> rays;
    for (const auto& shot : any_shots<Sphere<double>, B>().queries) {
      const Ray<double> ray{shot.a.shape.center, relative_displacement(shot.a, shot.b), 1};
      const Ray<long double> exact{ray.origin.template cast<long double>(), ray.direction.template cast<long double>(),
                                   1};
      const auto hit = raycast(exact, cast<long double>(shot.b.shape));
      rays.queries.push_back({ray, shot.b.shape});
      rays.truth.push_back(hit ? static_cast<double>(hit->t) : never);
    }
    return rays;
  }();
  return set;
}

/// Each shot a little (a twentieth of the time until then) after first contact, or where it ends.
template <class A, class B> const Poses<A, B>& any_poses() {
  static const Poses<A, B> set = [] {
    Poses<A, B> poses;
    const Shots<A, B>& shots = any_shots<A, B>();
    for (std::size_t k = 0; k < shots.queries.size(); ++k) {
      const double time = std::min(1.0, shots.truth[k] * 1.05);
      const A a = pose_at(shots.queries[k].a, time);
      const B b = pose_at(shots.queries[k].b, time);
      const auto gap = separation(cast<long double>(a), cast<long double>(b)).distance;
      poses.queries.push_back({a, b});
      poses.truth.push_back(gap <= 0 ? static_cast<double>(-gap) : never);
    }
    return poses;
  }();
  return set;
}

inline const Shots<Sphere<double>, Aabb<double>>& thin_wall_shots() {
  static const auto set = shots<Sphere<double>, Aabb<double>>(
      [](Uniform& u) {
        return Sphere<double>{Vec3<double>::Zero(), u.between(0.02, 0.1)};
      },
      [](Uniform& u) {
        return Aabb<double>{Vec3<double>::Zero(), {u.between(0.001, 0.02), 0.7, 0.7}};
      });
  return set;
}

}  // namespace thinwall::bench
