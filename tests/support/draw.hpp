#pragma once
/// Random shapes and motions, drawn to hit what goes wrong: coordinates on a coarse lattice (ties, touches, parallels),
/// sizes decades apart, and pairs moved until they all but touch.

#include <cstdint>
#include <sstream>

#include <rapidcheck.h>

#include "support/bodies.hpp"
#include "support/oracle.hpp"
#include "support/property.hpp"
#include "support/scalars.hpp"

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

// What a failing case prints.
template <class S> std::string describe(const Sphere<S>& s) {
  std::ostringstream out;
  out.precision(std::numeric_limits<S>::max_digits10);
  out << "sphere " << s.center.transpose() << " r " << s.radius;
  return out.str();
}
template <class S> std::string describe(const Aabb<S>& b) {
  std::ostringstream out;
  out.precision(std::numeric_limits<S>::max_digits10);
  out << "box " << b.center.transpose() << " half " << b.half_extents.transpose();
  return out.str();
}
template <class S> std::string describe(const Capsule<S>& c) {
  std::ostringstream out;
  out.precision(std::numeric_limits<S>::max_digits10);
  out << "capsule " << c.a.transpose() << " to " << c.b.transpose() << " r " << c.radius;
  return out.str();
}
template <class Shape> std::string describe(const Moving<Shape>& m) {
  std::ostringstream out;
  out.precision(std::numeric_limits<typename Shape::Scalar>::max_digits10);
  out << describe(m.shape) << " moves " << m.displacement.transpose();
  return out.str();
}

template <class S> void shift(Sphere<S>& s, const Vec3<S>& by) { s.center += by; }
template <class S> void shift(Aabb<S>& b, const Vec3<S>& by) { b.center += by; }
template <class S> void shift(Capsule<S>& c, const Vec3<S>& by) {
  c.a += by;
  c.b += by;
}
template <class Shape> void shift(Moving<Shape>& m, const Vec3<typename Shape::Scalar>& by) { shift(m.shape, by); }

template <class S> Vec3<S> lower(const oracle::Vector& v) { return {S(v[0]), S(v[1]), S(v[2])}; }

/// Moves B until the two all but touch at `time`: by the separation, rounded to the scalar.
template <class S, class A, class B> void bring_together(const A& a, B& b, const oracle::Real& time) {
  const oracle::Gap there = oracle::gap(oracle::pair(a, b), time);
  shift(b, lower<S>(-there.separation * there.normal));
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

}  // namespace thinwall::testing
