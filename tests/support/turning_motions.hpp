#pragma once
/// Motions that turn, drawn to be hard: what dips in and returns, misses by a hair, touches as the step ends, or is degenerate.

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/queries.hpp>
#include <thinwall/discrete/triangle.hpp>
#include <thinwall/discrete/type_list.hpp>
#include <thinwall/swept/turning.hpp>

#include "support/portable_draw.hpp"

namespace thinwall::testing {

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
inline constexpr int motion_styles = 11;
inline constexpr std::array<std::string_view, motion_styles> motion_style_names = {
    "any",       "parallel", "spin_only",  "flight_only", "concentric", "sliver",
    "along_rod", "together", "many_turns", "frantic",     "grid"};

/// Where the two come near each other.
enum class Aim {
  none,
  near_miss,   ///< they miss by 1e-3 to 1e-9 of a length where they were closest
  dip,         ///< they are in each other by as much there, and perhaps nowhere else
  at_the_end,  ///< they are in each other by as much at the end of the step
};
inline constexpr std::array<std::string_view, 4> aim_names = {"none", "near_miss", "dip", "at_the_end"};

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
    const double x = cell(), y = cell();
    return {x, y, cell()};
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

}  // namespace thinwall::testing
