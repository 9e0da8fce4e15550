// Every time of impact of what turns, judged by the oracle, on motions drawn to be hard: nothing touches before the answered time, a hit
// is near by then, and what is called apart is proven apart.

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "support/numbers_of.hpp"
#include "support/thorough.hpp"
#include "support/turning_motions.hpp"
#include "support/turning_oracle.hpp"

namespace thinwall::testing {
namespace {

using oracle::TurningOracle;

/// [length] a step: no point of either is faster.
template <class A> double fastest(const Turning<A>& m) {
  const oracle::Spinner<double> body(m);
  double far = 0;
  for (const auto& arm : body.arms) {
    const double square = oracle::dot(arm.start, arm.start);
    far = body.corners ? std::max(far, square) : far + square;
  }
  return std::sqrt(m.displacement.squaredNorm()) + body.angle * std::sqrt(far);
}

/// [length] how much a plain computation may be off by: a multiple of the last place of what goes in.
template <class A, class B> double rounding(const Turning<A>& a, const Turning<B>& b) {
  const double turns = 1 + (std::sqrt(a.rotation.squaredNorm()) + std::sqrt(b.rotation.squaredNorm())) / 4;
  return 0x1p-43 * turns * (1 + magnitude(a) + magnitude(b));
}

/// [length] what a method may call near: its tolerance, or what rounding hides, without a radius half the digits of all sizes.
template <class A, class B> double nearness(const Turning<A>& a, const Turning<B>& b, double tolerance) {
  const bool has_radius = skin_radius(a.shape) + skin_radius(b.shape) > 0;
  const double hidden = has_radius ? 0 : half_digits<double>() * (magnitude(a) + magnitude(b));
  return std::max({tolerance * (fastest(a) + fastest(b)), rounding(a, b), hidden});
}

/// What is wrong with an answer of a method that is never late; nothing if all is right.
template <class A, class B>
std::string wrong_with(const Turning<A>& a, const Turning<B>& b, const Toi<double>& toi, double tolerance) {
  TurningOracle<A, B> oracle(a, b);
  if (toi.status == ToiStatus::invalid) return "invalid";
  if (!(toi.time >= 0 && toi.time <= 1)) return "a time out of range";
  if (toi.status == ToiStatus::overlapping) {
    if (toi.time != 0) return "overlapping at a time";
    return oracle.within(0, rounding(a, b)) ? "" : "overlapping what is apart";
  }
  if (toi.status == ToiStatus::apart && toi.time != 1) return "apart before the end";
  if (toi.status == ToiStatus::hit && !oracle.within(toi.time, nearness(a, b, tolerance)))
    return "a hit of what is not near";
  if (toi.time == 0) return "";
  const auto proven = static_cast<double>(oracle.free_until(toi.time));
  if (proven >= toi.time) return "";
  if (oracle.intervals >= oracle.patience) return "out of patience at " + std::to_string(proven);
  return (toi.status == ToiStatus::apart ? "missed, or not proven apart, at " : "late, or not proven free, at ") +
         std::to_string(proven);
}

const std::size_t motions = thorough(slow_build ? 250 : 2'500);  ///< a pair, of eight: ten seconds of one core

/// A motion of each style in turn, aimed in each way in turn.
template <class A, class B> void judge_pair() {
  std::array<std::size_t, 5> answers{};  ///< by status
  std::size_t frantic = 0;               ///< motions of a million radians, of which one may give up as many
  MotionDraw draw(motions);
  for (std::size_t i = 0; i < motions; ++i) {
    const auto style = static_cast<MotionStyle>(i % motion_styles);
    const auto aim = static_cast<Aim>(i / motion_styles % 4);
    const auto [a, b] = draw.motion<A, B>(style, aim);
    const Toi<double> toi = time_of_impact(a, b);
    EXPECT_EQ(wrong_with(a, b, toi, ConservativeAdvancement<double>{}.tolerance), "")
        << "status " << static_cast<int>(toi.status) << " time " << toi.time << "\n"
        << describe(a) << "\n"
        << describe(b);
    ++answers[static_cast<std::size_t>(toi.status)];
    frantic += style == MotionStyle::frantic ? 1 : 0;
  }
  const auto count = [&](ToiStatus status) { return answers[static_cast<std::size_t>(status)]; };
  EXPECT_GT(count(ToiStatus::apart), motions / 10);
  EXPECT_GT(count(ToiStatus::hit), motions / 10);
  EXPECT_LE(count(ToiStatus::gave_up), frantic + motions / 200);
}

TEST(JudgedTurning, sphere_and_sphere) { judge_pair<Sphere<double>, Sphere<double>>(); }
TEST(JudgedTurning, capsule_and_sphere) { judge_pair<Capsule<double>, Sphere<double>>(); }
TEST(JudgedTurning, capsule_and_capsule) { judge_pair<Capsule<double>, Capsule<double>>(); }
TEST(JudgedTurning, box_and_sphere) { judge_pair<Obb<double>, Sphere<double>>(); }
TEST(JudgedTurning, box_and_capsule) { judge_pair<Obb<double>, Capsule<double>>(); }
TEST(JudgedTurning, box_and_box) { judge_pair<Obb<double>, Obb<double>>(); }
TEST(JudgedTurning, triangle_and_sphere) { judge_pair<Triangle<double>, Sphere<double>>(); }
TEST(JudgedTurning, triangle_and_capsule) { judge_pair<Triangle<double>, Capsule<double>>(); }

}  // namespace
}  // namespace thinwall::testing
