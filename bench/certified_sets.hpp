#pragma once
/// Three sets of queries for the certified time of impact, from what a scene asks to what was made to be hard:
///   random       any_shots() of query_sets.hpp: hits and misses of like number, none of them close
///   mixed        half of them random; a quarter graze, to 1e-2 ... 1e-12 of the reach; a quarter come from 1e1 ... 1e8 away
///   adversarial  half graze to 1e-12 ... 1e-16; a quarter stop where they touch, give or take an ulp; a quarter lie on a
///                lattice of eighths, where touches are exact

#include <cmath>

#include "query_sets.hpp"

namespace thinwall::bench {

inline constexpr std::size_t hard_query_count = 8'000;

inline double decades(Uniform& uniform, double low, double high) { return std::pow(10.0, uniform.between(low, high)); }

template <class A, class B> Shot<A, B> any_shot(Uniform& uniform, double distance) {
  const Vec3<double> from = uniform.direction() * (uniform.between(1.5, 3) * distance);
  const Vec3<double> aim = uniform.direction() * uniform.between(0, 2);
  const Vec3<double> drift = uniform.direction() * uniform.between(0, 2);
  const A a = moved<double>(any_shape<A>(uniform), from);
  const B b = any_shape<B>(uniform);
  return {{a, (aim - from) * uniform.between(0.5, 3) + drift}, {b, drift}};
}

/// The shot turned aside until it is `margin` [1] beyond the last hit, or before it.
template <class A, class B> Shot<A, B> grazing_shot(Uniform& uniform, double margin) {
  Shot<A, B> shot = any_shot<A, B>(uniform, 1);
  const Vec3<double> aside = uniform.direction() * 4, drift = shot.b.displacement;
  const Vec3<double> from = center(shot.a.shape);
  const auto aim = [&](double share) { shot.a.displacement = (aside * share - from) * 2.0 + drift; };
  double hit = 0, miss = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (hit + miss) / 2;
    aim(middle);
    (time_of_impact(shot.a, shot.b).status == ToiStatus::apart ? miss : hit) = middle;
  }
  aim(hit * (1 + margin));
  return shot;
}

/// The shot cut off where it first touches, to an ulp.
template <class A, class B> Shot<A, B> touching_shot(Uniform& uniform) {
  Shot<A, B> shot = any_shot<A, B>(uniform, 1);
  const Toi<double> toi = time_of_impact(shot.a, shot.b);
  if (toi.status != ToiStatus::hit) return shot;
  const double length = toi.time * (1 + std::floor(uniform.between(-1, 2)) * std::numeric_limits<double>::epsilon());
  shot.a.displacement *= length;
  shot.b.displacement *= length;
  return shot;
}

/// Every coordinate to the nearest eighth; an oriented box upright.
inline Vec3<double> to_eighths(const Vec3<double>& v) { return (v * 8).array().round().matrix() / 8; }
inline Sphere<double> to_eighths(const Sphere<double>& s) {
  return {to_eighths(s.center), std::round(s.radius * 8) / 8};
}
inline Aabb<double> to_eighths(const Aabb<double>& b) { return {to_eighths(b.center), to_eighths(b.half_extents)}; }
inline Obb<double> to_eighths(const Obb<double>& b) {
  return {to_eighths(b.center), to_eighths(b.half_extents), Mat3<double>::Identity()};
}
inline Capsule<double> to_eighths(const Capsule<double>& c) {
  return {to_eighths(c.a), to_eighths(c.b), std::round(c.radius * 8) / 8};
}
inline Triangle<double> to_eighths(const Triangle<double>& t) {
  return {to_eighths(t.a), to_eighths(t.b), to_eighths(t.c)};
}
template <class A, class B> Shot<A, B> lattice_shot(Uniform& uniform) {
  const Shot<A, B> shot = any_shot<A, B>(uniform, 1);
  return {{to_eighths(shot.a.shape), to_eighths(shot.a.displacement)},
          {to_eighths(shot.b.shape), to_eighths(shot.b.displacement)}};
}

template <class A, class B> using Queries = std::vector<Shot<A, B>>;

template <class A, class B> const Queries<A, B>& random_queries() { return any_shots<A, B>().queries; }

template <class A, class B> const Queries<A, B>& mixed_queries() {
  static const Queries<A, B> set = [] {
    Uniform uniform;
    Queries<A, B> made;
    while (made.size() < hard_query_count) {
      made.push_back(any_shot<A, B>(uniform, 1));
      made.push_back(any_shot<A, B>(uniform, 1));
      made.push_back(any_shot<A, B>(uniform, decades(uniform, 1, 8)));
      const double side = uniform() < 0.5 ? -1 : 1;
      made.push_back(grazing_shot<A, B>(uniform, side * decades(uniform, -12, -2)));
    }
    return made;
  }();
  return set;
}

template <class A, class B> const Queries<A, B>& adversarial_queries() {
  static const Queries<A, B> set = [] {
    Uniform uniform;
    Queries<A, B> made;
    while (made.size() < hard_query_count) {
      for (const double side : {-1.0, 1.0}) {
        made.push_back(grazing_shot<A, B>(uniform, side * decades(uniform, -16, -12)));
      }
      made.push_back(touching_shot<A, B>(uniform));
      made.push_back(lattice_shot<A, B>(uniform));
    }
    return made;
  }();
  return set;
}

}  // namespace thinwall::bench
