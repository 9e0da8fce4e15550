#pragma once
/// Impacts that come in crowds: at one instant, without end, or in tens of millions. Each has an answer of its own to be held
/// against; each is a row of the results and a test. But for the ball on the floor, bodies fly straight between impacts, and each
/// impact comes in turn, at the time that the library finds.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/bouncing/model.hpp>

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

struct BounceScenario {
  std::string name;      ///< what is done
  std::string must;      ///< what must happen
  std::string happened;  ///< what did
  bool passed = false;

  static constexpr auto fields() {
    using S = BounceScenario;
    return record(kept("scenario", &S::name, "", "What is done."), kept("must", &S::must, "", "What must happen."),
                  kept("happened", &S::happened, "", "What did."), kept("passed", &S::passed, "", "It is what must."));
  }
  bool operator==(const BounceScenario&) const = default;
};

/// A ball dropped from 1 m at g = 2 m/s^2 with restitution 1/2 bounces at 1, 2, 2.5, 2.75, ... s, without end before 3 s.
/// Followed by steps of 1/4 s on the exact arc; the times are those of its impacts.
std::vector<double> zeno_times();
std::vector<BounceScenario> zeno_scenarios();

/// A ball that rests on the floor, for each policy, over 1e5 steps.
std::vector<BounceScenario> rest_scenarios();

/// A ball flies into a corner of two walls, and of three, and touches them at one instant; in every order of the walls.
std::vector<BounceScenario> corner_scenarios();

/// A ball between two walls with 2^-20 m of play, for a second at 1 m/s; and a point between a wall and one that closes in.
std::vector<BounceScenario> gap_scenarios();

/// A ball hits another head-on, `ratio` times as heavy; and the other way round.
std::vector<BounceScenario> mass_scenarios(const std::vector<double>& ratios);

/// Five touching balls in a row, and one, two or three of them come in.
std::vector<BounceScenario> cradle_scenarios();

struct BlockCount {
  std::int64_t impacts;
  /// [m^2/s] Of the path of (heavy, light) around the corner where all three touch: |x_heavy v_light - x_light v_heavy|. An impact
  /// only turns its sign, so that it stays what it was, 1. It is what the places say, where the speeds alone decide the count.
  double moment;
};

/// Impacts of a block that stands 1 m from a wall while one 100^digits times as heavy comes in at 1 m/s. S: float or double.
/// Error: right up to 5 digits in float and 7 in double, as measured.
template <class S> BlockCount count_block_impacts(int digits);
std::vector<BounceScenario> digit_scenarios(int most);

}  // namespace thinwall
