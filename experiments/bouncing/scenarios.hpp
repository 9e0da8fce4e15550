#pragma once
/// Impacts that come in crowds: at one instant, without end, or in tens of millions. Each has an answer of its own to be held
/// against; each is a row of the results. But for the ball on the floor, bodies fly straight between impacts, and each
/// impact comes in turn, at the time that the library finds.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/bouncing/model.hpp>

namespace thinwall {

/// A ball, or a wall that nothing moves out of its way.
template <class Shape> struct FlyingBody {
  Shape shape;
  Vec3<double> velocity;  ///< [m/s]
  void fly(double seconds) { shape = moved(shape, Vec3<double>(velocity * seconds)); }
};
using FlyingBall = FlyingBody<Sphere<double>>;
using FlyingWall = FlyingBody<Aabb<double>>;

/// The next impact within a second of bodies that approach each other; a pair in touch that parts is none.
template <class A, class B> std::optional<Toi<double>> next_impact(const FlyingBody<A>& a, const FlyingBody<B>& b) {
  const Toi<double> toi = time_of_impact(Moving{a.shape, a.velocity}, Moving{b.shape, b.velocity});
  const bool meets = toi.status == ToiStatus::hit || toi.status == ToiStatus::overlapping;
  if (!meets || !((a.velocity - b.velocity).dot(toi.normal) > 0)) return std::nullopt;
  return toi;
}

/// Lets balls of one mass bounce off each other and off walls for `seconds`, without loss. Impacts at one instant come one after the
/// other, at times of impact of 0, until all part. Returns how many impacts there were.
std::int64_t fly(std::span<FlyingBall> balls, std::span<FlyingWall> walls, double seconds);

struct BounceScenario {
  std::string name;      ///< what is done
  std::string must;      ///< what must happen
  std::string happened;  ///< what did
  bool passed = false;
  std::string group = {};  ///< the kind that it is of

  static constexpr auto fields() {
    using S = BounceScenario;
    return record(kept("group", &S::group, "", "Kind of scenario."), kept("scenario", &S::name, "", "What is done."),
                  kept("must", &S::must, "", "What must happen."), kept("happened", &S::happened, "", "What did."),
                  kept("passed", &S::passed, "", "It is what must."));
  }
};

/// What happens in each, and what must, is told in docs/bouncing.md.
inline constexpr std::array<std::string_view, 7> scenario_groups = {"zeno",   "rest",   "walls", "gap",
                                                                    "masses", "cradle", "digits"};

/// All of one group: masses `mass_ratios` apart, and up to `digits` <= 7 digits of pi after its first, in float at most 5.
std::vector<BounceScenario> bounce_scenarios(std::string_view group, const std::vector<double>& mass_ratios,
                                             int digits);

}  // namespace thinwall
