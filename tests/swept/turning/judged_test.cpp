// Every time of impact of what turns, judged by the oracle, on motions drawn to be hard: nothing touches before the answered time, a hit
// is near by then, and what is called apart is proven apart. And the queries that are published.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "support/numbers_of.hpp"
#include "support/portable_draw.hpp"
#include "support/thorough.hpp"
#include "support/turning_oracle.hpp"

namespace thinwall::testing {
namespace {

// ---- Motions that turn, drawn to be hard: what dips in and returns, misses by a hair, touches as the step ends, or is degenerate.

/// What is special about a motion, before it is aimed.
enum class MotionStyle {
  any,
  parallel,     ///< the same axes, and spins about one of them
  spin_only,    ///< nothing flies
  flight_only,  ///< nothing turns
  concentric,   ///< the centers meet during the step, or at its start
  sliver,       ///< no radius, plates and needles
  along_rod,    ///< the spin's axis is the first axis of the shape
  together,     ///< both turn by the same rotation
  many_turns,   ///< 10 to 100 rad
  frantic,      ///< a million rad
  grid,         ///< all numbers are small multiples of 1/4: exact touches
};
constexpr int motion_styles = 11;
constexpr std::array<std::string_view, motion_styles> motion_style_names = {
    "any",       "parallel", "spin_only",  "flight_only", "concentric", "sliver",
    "along_rod", "together", "many_turns", "frantic",     "grid"};

/// Where the two come near each other.
enum class Aim {
  none,
  near_miss,   ///< they miss by 1e-3 to 1e-9 of a length where they were closest
  dip,         ///< they are in each other by as much there, and perhaps nowhere else
  at_the_end,  ///< they are in each other by as much at the end of the step
};
constexpr std::array<std::string_view, 4> aim_names = {"none", "near_miss", "dip", "at_the_end"};

/// The same motions by every compiler: nothing is drawn in an order that the language leaves open.
class MotionDraw : public PortableDraw {
 public:
  using PortableDraw::PortableDraw;

  template <class A, class B> std::pair<Turning<A>, Turning<B>> motion(MotionStyle style, Aim aim) {
    const Mat3<double> axes = turn();
    Turning<A> a = one<A>(style, axes);
    Turning<B> b = one<B>(style, axes);
    if (style == MotionStyle::together) b.rotation = a.rotation;
    if (style == MotionStyle::concentric) {
      const double when = one_in(4) ? 0 : between(0.2, 1);
      shift(b, center(a.shape) - center(b.shape) + (a.displacement - b.displacement) * when);
    }
    if (aim != Aim::none) aim_at(a, b, aim);
    return {a, b};
  }

 private:
  Mat3<double> turn() {
    const Vec3<double> axis = direction();
    return rotation_about<double>(axis, between(0, std::numbers::pi));
  }
  double size(MotionStyle style, double least, double most) {
    if (style == MotionStyle::grid) return (1 + below(4)) * 0.25;
    if (style == MotionStyle::sliver && one_in(2)) return one_in(2) ? 1e-6 : 1e-3;
    return between(least, most);
  }
  Vec3<double> place(MotionStyle style) { return style == MotionStyle::grid ? cells(8) : point(2); }
  Vec3<double> cells(int most) {
    const auto cell = [&] { return (below(2 * most + 1) - most) * 0.25; };
    return {cell(), cell(), cell()};
  }

  Sphere<double> shape(MotionStyle style, const Mat3<double>&, TypeTag<Sphere<double>>) {
    return {place(style), size(style, 0.01, 0.5)};
  }
  Capsule<double> shape(MotionStyle style, const Mat3<double>& axes, TypeTag<Capsule<double>>) {
    const Vec3<double> at = place(style), half = axes.col(0) * size(style, 0.1, 1);
    const double radius = style == MotionStyle::sliver && one_in(2) ? 0 : size(style, 0.01, 0.2);
    return {at - half, at + half, radius};
  }
  Obb<double> shape(MotionStyle style, const Mat3<double>& axes, TypeTag<Obb<double>>) {
    Obb<double> box{place(style), {}, axes};
    for (int k = 0; k < 3; ++k) box.half_extents[k] = size(style, 0.01, 1);
    if (style == MotionStyle::sliver && one_in(4)) box.half_extents[below(3)] = 0;
    return box;
  }
  Triangle<double> shape(MotionStyle style, const Mat3<double>& axes, TypeTag<Triangle<double>>) {
    const Vec3<double> at = place(style), x = axes.col(0), y = axes.col(1);
    const double wide = size(style, 0.1, 1), high = size(style, 0.1, 1), aside = between(-1, 1);
    return {at - x * wide, at + x * wide, at + x * aside + y * high};
  }

  template <class A> Turning<A> one(MotionStyle style, const Mat3<double>& common) {
    using enum MotionStyle;
    Mat3<double> axes = style == parallel ? common : style == grid ? Mat3<double>::Identity() : turn();
    Turning<A> m{shape(style, axes, TypeTag<A>{}), point(2), Vec3<double>::Zero()};
    const double most = one_in(3) ? 0.5 : one_in(3) ? 7 : 3.2;
    if (style == spin_only) m.displacement = Vec3<double>::Zero();
    if (style == grid) m.displacement = cells(8);
    if (!one_in(5)) m.rotation = point(most);
    if (style == spin_only) m.rotation = point(most);
    if (style == parallel) {
      const int about = one_in(2) ? 2 : below(3);
      m.rotation = axes.col(about) * between(-most, most);
    }
    if (style == along_rod) m.rotation = axes.col(0) * between(-most, most);
    if (style == grid) {
      const int about = below(3);
      m.rotation = axis_vector<double>(about) * ((below(9) - 4) * std::numbers::pi / 4);
    }
    if (style == many_turns) {
      const double angle = one_in(2) ? 10 : 100;
      m.rotation = direction() * angle;
    }
    if (style == frantic) m.rotation = direction() * 1e6;
    if (style == flight_only) m.rotation = Vec3<double>::Zero();
    return m;
  }

  template <class A> static void shift(Turning<A>& m, const Vec3<double>& by) { m.shape = moved(m.shape, by); }

  /// Moves B along the closest points' normal, so that the gap there becomes what is wanted.
  template <class A, class B> void aim_at(const Turning<A>& a, Turning<B>& b, Aim aim) {
    const auto at = [&](double time) { return separation(pose_at(a, time), pose_at(b, time)); };
    double when = 1;
    Separation<double> closest = at(1);
    if (aim != Aim::at_the_end) {
      constexpr int poses = 24;
      for (int k = 1; k < poses; ++k) consider(k / double{poses}, at, when, closest);
      for (double step = 0.5 / poses; step > 1e-5; step /= 2) {
        const double middle = when;
        if (middle - step > 0) consider(middle - step, at, when, closest);
        if (middle + step < 1) consider(middle + step, at, when, closest);
      }
    }
    const double by = std::pow(10, -between(3, 9));
    const double wanted = aim == Aim::near_miss ? by : -by;
    shift(b, Vec3<double>(closest.normal * (wanted - closest.distance)));
  }
  template <class At> static void consider(double time, const At& at, double& when, Separation<double>& closest) {
    const Separation<double> there = at(time);
    if (there.distance < closest.distance) {
      closest = there;
      when = time;
    }
  }
};

// ---- Every answer, judged.

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

// ---- The published queries of what turns (docs/data/turning): what draws, proves and writes them, and rows of them proven again. To write
// them:
//   THINWALL_WRITE_TURNING=docs/data/turning build/release/tests/tests_swept --gtest_filter='PublishedTurning.*'

constexpr int queries = 1250;  ///< a pair, of which there are eight

template <class A, class B> struct PublishedPair {
  const char* name;
  std::uint64_t number;
};

template <class F> void each_pair(const F& f) {
  using Ball = Sphere<double>;
  using Rod = Capsule<double>;
  using Box = Obb<double>;
  using Plate = Triangle<double>;
  f(PublishedPair<Ball, Ball>{"sphere_sphere", 0});
  f(PublishedPair<Rod, Ball>{"capsule_sphere", 1});
  f(PublishedPair<Rod, Rod>{"capsule_capsule", 2});
  f(PublishedPair<Box, Ball>{"obb_sphere", 3});
  f(PublishedPair<Box, Rod>{"obb_capsule", 4});
  f(PublishedPair<Box, Box>{"obb_obb", 5});
  f(PublishedPair<Plate, Ball>{"triangle_sphere", 6});
  f(PublishedPair<Plate, Rod>{"triangle_capsule", 7});
}

/// 30 decimals of a time in [0, 1], rounded down.
std::string time_text(const oracle::Time& time) {
  constexpr std::size_t decimals = 30;
  std::string digits =
      oracle::Time(floor(time * pow(oracle::Time(10), static_cast<int>(decimals)))).convert_to<oracle::Integer>().str();
  if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
  return digits.insert(digits.size() - decimals, ".");
}

/// A power of ten that they are proven to stay more than apart, one of the largest; 0 if that is less than 1e-12.
template <class A, class B>
std::string clearance_text(const Turning<A>& a, const Turning<B>& b, oracle::TurningOracle<A, B>& oracle) {
  double seen = separation(a.shape, b.shape).distance;
  for (int k = 1; k <= 64; ++k) seen = std::min(seen, separation(pose_at(a, k / 64.0), pose_at(b, k / 64.0)).distance);
  int exponent = 0;
  while (exponent > -12 && !(std::pow(10, exponent) < seen)) --exponent;
  for (; exponent >= -12; --exponent) {
    oracle.intervals = 0;
    if (oracle.free_until(1, std::pow(10, exponent)) >= 1) return "1e" + std::to_string(exponent);
  }
  return "0";
}

/// Nothing where the oracle cannot decide.
template <class A, class B> std::optional<TurningAnswer> proven_answer(const Turning<A>& a, const Turning<B>& b) {
  using enum oracle::TurningVerdict;
  oracle::TurningOracle<A, B> oracle(a, b);
  const oracle::FirstContact contact = oracle.first_contact(31);
  if (contact.verdict == apart) return TurningAnswer{"apart", "", clearance_text(a, b, oracle)};
  if (contact.verdict == hit) return TurningAnswer{"hit", time_text(contact.lower), ""};
  if (contact.verdict == overlapping) return TurningAnswer{"overlapping", "0", ""};
  return {};
}

/// The line of a query: of every style and aim in turn, but none of a million turns; few in contact from the start.
template <class A, class B> std::string published_row(const PublishedPair<A, B>& pair, int query) {
  constexpr int styles = motion_styles - 1;
  const int nth = query % styles, frantic = static_cast<int>(MotionStyle::frantic);
  const int style = nth < frantic ? nth : nth + 1, aim = query / styles % 4;
  MotionDraw draw(pair.number << 32 | static_cast<std::uint64_t>(query));
  for (int tries = 1;; ++tries) {
    const auto [a, b] = draw.motion<A, B>(static_cast<MotionStyle>(style), static_cast<Aim>(aim));
    if (query % 16 != 0 && tries < 8 && overlaps(a.shape, b.shape)) continue;
    if (const auto answer = proven_answer(a, b)) {
      return turning_row(query, motion_style_names[static_cast<std::size_t>(style)],
                         aim_names[static_cast<std::size_t>(aim)], *answer, a, b);
    }
  }
}

template <class A, class B> std::string header_of(const PublishedPair<A, B>&) {
  MotionDraw draw(0);
  const auto [a, b] = draw.motion<A, B>(MotionStyle::any, Aim::none);
  return turning_header(a, b);
}

TEST(PublishedTurning, are_written_where_asked) {
  const char* folder = std::getenv("THINWALL_WRITE_TURNING");
  if (folder == nullptr) GTEST_SKIP() << "THINWALL_WRITE_TURNING names no folder";
  each_pair([&](const auto& pair) {
    std::ofstream out(std::filesystem::path(folder) / (std::string(pair.name) + ".csv"), std::ios::binary);
    out << header_of(pair) << "\n";
    for (int query = 0; query < queries; ++query) out << published_row(pair, query) << "\n";
    EXPECT_TRUE(out.flush()) << pair.name;
  });
}

/// A part of them, the same for every pair; THINWALL_THOROUGH=160 is all.
TEST(PublishedTurning, are_drawn_and_proven_again_to_the_byte) {
  const int every = std::max(1, 160 / static_cast<int>(thorough(1)));
  each_pair([&](const auto& pair) {
    std::ifstream in(std::string(THINWALL_TURNING_QUERIES) + "/" + pair.name + ".csv", std::ios::binary);
    std::string line;
    ASSERT_TRUE(std::getline(in, line)) << pair.name;
    EXPECT_EQ(line, header_of(pair));
    int query = 0;
    for (; std::getline(in, line); ++query) {
      if (query % every != query / every % every) continue;
      EXPECT_EQ(line, published_row(pair, query)) << pair.name;
    }
    EXPECT_EQ(query, queries) << pair.name;
  });
}

}  // namespace
}  // namespace thinwall::testing
