#pragma once
/// Bodies that fly straight between impacts, and each impact in turn, at the time that the library finds.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

/// Two bodies on one line after an impact: speeds and masses before, restitution in [0, 1].
/// The change of each is its own product, so that neither is lost beside the other at any ratio of the masses.
template <class S> struct LineSpeeds {
  S a, b;  ///< [m/s]
};
template <class S> LineSpeeds<S> after_impact(LineSpeeds<S> before, S mass_a, S mass_b, S restitution) {
  const S closing = (S(1) + restitution) * (before.a - before.b), mass = mass_a + mass_b;
  return {before.a - closing * (mass_b / mass), before.b + closing * (mass_a / mass)};
}

/// A ball, or a wall that nothing moves out of its way.
template <class Shape> struct FlyingBody {
  Shape shape;
  Vec3<double> velocity;                                          ///< [m/s]
  Moving<Shape> motion() const { return {shape, velocity * 1}; }  ///< in a second
  void fly(double seconds) { shape = moved(shape, Vec3<double>(velocity * seconds)); }
};
using FlyingBall = FlyingBody<Sphere<double>>;
using FlyingWall = FlyingBody<Aabb<double>>;

/// The next impact within a second of bodies that approach each other; a pair in touch that parts is none.
template <class A, class B> std::optional<Toi<double>> next_impact(const FlyingBody<A>& a, const FlyingBody<B>& b) {
  const Toi<double> toi = time_of_impact(a.motion(), b.motion());
  const bool meets = toi.status == ToiStatus::hit || toi.status == ToiStatus::overlapping;
  if (!meets || !((a.velocity - b.velocity).dot(toi.normal) > 0)) return std::nullopt;
  return toi;
}

/// Lets a ball bounce between walls for `seconds`, without loss. Impacts at one instant come one after the other, at times of
/// impact of 0, until it parts from all. Returns how many impacts there were.
std::int64_t fly_between(FlyingBall& ball, std::span<FlyingWall> walls, double seconds);

/// Lets balls of one mass bounce off each other without loss, in any order of the list. Returns how many impacts there were.
std::int64_t fly_together(std::vector<FlyingBall>& balls, double seconds);

}  // namespace thinwall
