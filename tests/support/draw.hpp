#pragma once
/// Random shapes and motions, drawn to hit what goes wrong: coordinates on a coarse lattice (ties, touches, parallels),
/// sizes decades apart, and pairs moved until they all but touch.

#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <rapidcheck.h>

#include <thinwall/discrete/broad_phase/proxy.hpp>
#include <thinwall/swept/moving.hpp>

#include "support/bodies.hpp"
#include "support/numbers_of.hpp"
#include "support/oracle.hpp"
#include "support/property.hpp"
#include "support/real.hpp"
#include "support/shaker.hpp"
#include "support/transforms.hpp"

namespace thinwall::testing {

/// How the coordinates of one case are drawn.
enum class Style { lattice, plain, decades };

inline std::ostream& operator<<(std::ostream& out, Style style) {
  return out << (style == Style::lattice ? "lattice" : style == Style::plain ? "plain" : "decades");
}

inline Style draw_style() { return *rc::gen::element(Style::lattice, Style::plain, Style::plain, Style::decades); }

/// A coordinate of magnitude about one; with Style::decades down to 2^-30 and up to 2^30.
template <class S> S draw_coordinate(Style style) {
  using std::ldexp;
  if (style == Style::lattice) return S(draw_integer(-4, 4)) / S(2);
  const std::int64_t most = std::int64_t{1} << 53;
  const auto mantissa = *rc::gen::noShrink(rc::gen::resize(rc::kNominalSize, rc::gen::inRange(-most, most)));
  const int decade = style == Style::plain ? draw_integer(-1, 2) : draw_integer(-30, 30);
  return S(ldexp(S(mantissa), decade - 53));
}

template <class S> S draw_size(Style style) {
  using std::abs;
  return S(abs(draw_coordinate<S>(style)));
}

template <class S> Vec3<S> draw_vector(Style style) {
  const S x = draw_coordinate<S>(style), y = draw_coordinate<S>(style), z = draw_coordinate<S>(style);
  return {x, y, z};
}

/// Draws one shape; specialized for each.
template <class Shape> struct Draw;

template <class S> struct Draw<Sphere<S>> {
  static Sphere<S> shape(Style style) {
    const Vec3<S> center = draw_vector<S>(style);
    return {center, draw_size<S>(style)};
  }
};
template <class S> struct Draw<Aabb<S>> {
  static Aabb<S> shape(Style style) {
    const Vec3<S> center = draw_vector<S>(style);
    return {center, Vec3<S>(draw_vector<S>(style).cwiseAbs())};
  }
};
template <class S> struct Draw<Capsule<S>> {
  static Capsule<S> shape(Style style) {
    const Vec3<S> a = draw_vector<S>(style);
    const Vec3<S> b = draw_vector<S>(style);
    return {a, b, draw_size<S>(style)};
  }
};

/// What a failing case prints.
template <class Thing> std::string describe(const Thing& thing) {
  std::ostringstream out;
  each_number(thing, [&]<class S>(const std::string& name, const S& number) {
    out.precision(std::numeric_limits<S>::max_digits10);
    out << name << " " << number << " ";
  });
  return out.str();
}

template <class S> Vec3<S> lower(const oracle::Vector& v) { return {S(v[0]), S(v[1]), S(v[2])}; }

/// Moves B until the two all but touch at `time`: by the separation, rounded to the scalar.
template <class S, class A, class B> void bring_together(const A& a, B& b, const oracle::Real& time) {
  const oracle::Gap there = oracle::gap(oracle::pair(a, b), time);
  b = translated(b, lower<S>(-there.separation * there.normal));
}

/// Two shapes at rest, a third of them all but touching.
template <class A, class B> std::pair<A, B> draw_pair(Style style) {
  const A a = Draw<A>::shape(style);
  B b = Draw<B>::shape(style);
  if (draw_integer(0, 2) == 0) bring_together<typename A::Scalar>(a, b, 0);
  RC_LOG() << describe(a) << "\n" << describe(b) << "\n";
  return {a, b};
}
template <class A, class B> std::pair<A, B> draw_pair() { return draw_pair<A, B>(draw_style()); }

// ---- Random motions: plain ones, and ones that all but graze, all but touch at the start or all but touch at the end.

template <class A, class B> struct MovingPair {
  Moving<A> a;
  Moving<B> b;
};

/// The displacement that takes `from` about to where `to` will be, so that hits are not rare.
template <class S> Vec3<S> towards(const oracle::Body& from, const oracle::Body& to, const S& lengths) {
  return lower<S>(oracle::lift(lengths) * (to.center + to.displacement - from.center));
}

template <class A, class B> MovingPair<A, B> draw_moving_pair(Style style) {
  using S = typename A::Scalar;
  MovingPair<A, B> pair{at_rest(Draw<A>::shape(style)), at_rest(Draw<B>::shape(style))};
  if (draw_integer(0, 1) == 0) pair.b.displacement = draw_vector<S>(style);
  pair.a.displacement = draw_vector<S>(style);
  if (draw_integer(0, 2) == 0)
    pair.a.displacement += towards(oracle::body(pair.a), oracle::body(pair.b), S(draw_integer(1, 8)) / S(4));
  const int speed = draw_integer(0, 7);
  if (speed == 0) pair.a.displacement *= S(1024);
  if (speed == 1) pair.a.displacement[draw_integer(0, 2)] = S(0);
  if (draw_integer(0, 3) == 0) {  // far from the origin
    const Vec3<S> offset = draw_vector<S>(style) * S(256);
    pair.a = translated(pair.a, offset);
    pair.b = translated(pair.b, offset);
  }
  switch (draw_integer(0, 8)) {
    case 0: bring_together<S>(pair.a, pair.b, 0); break;
    case 1: bring_together<S>(pair.a, pair.b, 1); break;
    case 2:
    case 3: bring_together<S>(pair.a, pair.b, oracle::closest_approach(oracle::pair(pair.a, pair.b))); break;
    default: break;
  }
  RC_LOG() << describe(pair.a) << "\n" << describe(pair.b) << "\n";
  return pair;
}
template <class A, class B> MovingPair<A, B> draw_moving_pair() { return draw_moving_pair<A, B>(draw_style()); }

// ---- Random worlds of boxes, drawn to hit what goes wrong in a broad phase.

/// Lattice coordinates (ties and touching boxes), points, plates, sizes decades apart, one place for all, far outliers,
/// infinite boxes, worlds far from the origin; now and then static, masked and skipped bodies.
inline std::vector<Proxy> drawn_proxies(Shaker<double>& draw, int most) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const int count = draw.pick(0, most), style = draw.pick(0, 9), roles = draw.pick(0, 2);
  const double extent = std::ldexp(1.0, draw.pick(0, 5)), far_off = draw.pick(0, 3) == 0 ? std::ldexp(1.0, 40) : 0;
  std::vector<Proxy> proxies(static_cast<std::size_t>(count));
  for (Proxy& p : proxies) {
    Vec3<double> corner = draw.vector() * extent;
    Vec3<double> sides = draw.sizes();
    const int chance = draw.pick(0, 15), axis = draw.pick(0, 2);
    if (style == 0) corner.setZero();                                                    // all at one point
    if (style == 1) sides.setZero();                                                     // points
    if (style == 2) sides *= std::ldexp(1.0, draw.pick(-40, 12));                        // sizes decades apart
    if (style == 3 && chance == 0) corner[axis] = std::ldexp(1.0, draw.pick(60, 1020));  // bodies that escaped
    if (style == 4) sides[axis] = chance < 8 ? 0 : 1000;                                 // plates and rods
    if (style == 5) corner[axis] = 0;                                                    // mostly flat
    if (style == 6) {  // on a lattice of touching cubes
      corner = {double(draw.pick(-2, 2)), double(draw.pick(-2, 2)), double(draw.pick(-2, 2))};
      sides.setOnes();
    }
    if (style == 7) sides *= std::ldexp(1.0, -300), corner *= std::ldexp(1.0, -300);  // tiny
    if (style == 8) sides *= std::ldexp(1.0, 1000), corner *= std::ldexp(1.0, 1000);  // huge
    p.low = corner.array() + far_off;
    p.high = p.low + sides;
    if (style == 9 && chance == 0) p.high[axis] = infinity;
    if (style == 9 && chance == 1) p.low[axis] = -infinity;
    if (style == 9 && chance == 2) p.low.setConstant(infinity), p.high.setConstant(infinity);
    if (style == 9 && chance == 3) p.low.setConstant(-infinity), p.high.setConstant(infinity);
    if (roles == 0) continue;
    p.is_static = draw.pick(0, 3) == 0;
    p.skipped = draw.pick(0, 7) == 0;
    if (p.skipped && draw.pick(0, 1) == 0) p.low[axis] = std::numeric_limits<double>::quiet_NaN();
    if (roles == 1) continue;
    p.group = static_cast<std::uint32_t>(draw.pick(0, 3));
    p.mask = static_cast<std::uint32_t>(draw.pick(0, 3));
  }
  return proxies;
}

inline std::string describe(const std::vector<Proxy>& proxies) {
  std::ostringstream out;
  out.precision(17);
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const Proxy& p = proxies[i];
    out << i << ": low " << p.low.transpose() << " high " << p.high.transpose() << " group " << p.group << " mask "
        << p.mask << (p.is_static ? " static" : "") << (p.skipped ? " skipped" : "") << "\n";
  }
  return out.str();
}

}  // namespace thinwall::testing
