#pragma once
/// Random motions: plain ones, and ones that all but graze, all but touch at the start or all but touch at the end.

#include <thinwall/swept/moving.hpp>

#include "support/draw.hpp"

namespace thinwall::testing {

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
    shift(pair.a, offset);
    shift(pair.b, offset);
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

}  // namespace thinwall::testing
