#pragma once
/// Random shapes and motions, drawn to hit what goes wrong: coordinates on a coarse lattice (ties, touches, parallels),
/// sizes decades apart, and pairs moved until they all but touch.

#include <cstdint>
#include <utility>

#include <rapidcheck.h>

#include <thinwall/swept/moving.hpp>

#include "support/bodies.hpp"
#include "support/numbers_of.hpp"
#include "support/oracle.hpp"
#include "support/property.hpp"
#include "support/real.hpp"
#include "support/shaker.hpp"

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

template <class S> Sphere<S> drawn(Style style, TypeTag<Sphere<S>>) {
  return {draw_vector<S>(style), draw_size<S>(style)};
}
template <class S> Aabb<S> drawn(Style style, TypeTag<Aabb<S>>) {
  return {draw_vector<S>(style), draw_vector<S>(style).cwiseAbs()};
}
template <class S> Capsule<S> drawn(Style style, TypeTag<Capsule<S>>) {
  return {draw_vector<S>(style), draw_vector<S>(style), draw_size<S>(style)};
}

template <class S> Vec3<S> lower(const oracle::Vector& v) { return {S(v[0]), S(v[1]), S(v[2])}; }

/// Moves B until the two all but touch at `time`: by the separation, rounded to the scalar.
template <class S, class A, class B> void bring_together(const A& a, B& b, const oracle::Real& time) {
  const oracle::Gap there = oracle::gap(oracle::pair(a, b), time);
  b = translated(b, lower<S>(-there.separation * there.normal));
}

/// Two shapes at rest, a third of them all but touching.
template <class P> std::pair<typename P::A, typename P::B> draw_pair(Style style = draw_style()) {
  const auto a = drawn(style, TypeTag<typename P::A>{});
  auto b = drawn(style, TypeTag<typename P::B>{});
  if (draw_integer(0, 2) == 0) bring_together<typename P::S>(a, b, 0);
  RC_LOG() << describe(a) << "\n" << describe(b) << "\n";
  return {a, b};
}

// ---- Random motions: plain ones, and ones that all but graze, all but touch at the start or all but touch at the end.

/// The displacement that takes `from` about to where `to` will be, so that hits are not rare.
template <class S> Vec3<S> towards(const oracle::Body& from, const oracle::Body& to, const S& lengths) {
  return lower<S>(oracle::lift(lengths) * (to.center + to.displacement - from.center));
}

template <class P> Motion<typename P::A, typename P::B> draw_moving_pair(Style style = draw_style()) {
  using S = typename P::S;
  Motion<typename P::A, typename P::B> pair{at_rest(drawn(style, TypeTag<typename P::A>{})),
                                            at_rest(drawn(style, TypeTag<typename P::B>{}))};
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
}  // namespace thinwall::testing
