#pragma once
/// Any two shapes in motion, drawn to go wrong: on a lattice or decades apart in size, aimed at each other, fast, far from
/// the origin, moved until they all but touch at the start or the end, and turned until they all but graze.

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/moving.hpp>

#include "support/shaker.hpp"

namespace thinwall::testing {

template <class A, class B> struct Motion {
  Moving<A> a;
  Moving<B> b;
};

/// Moves B until the two touch at `time`, to rounding; returns the normal there.
template <class A, class B, class S> Vec3<S> bring_together(Motion<A, B>& motion, const S& time) {
  const Separation<S> there = separation(pose_at(motion.a, time), pose_at(motion.b, time));
  motion.b.shape = moved<S>(motion.b.shape, there.normal * -there.distance);
  return there.normal;
}

/// Turns the motion of A until it runs past B at `time`, the pose there kept.
template <class A, class B, class S> void make_graze(Motion<A, B>& motion, const S& time, const Vec3<S>& normal) {
  const Vec3<S> closing = normal * normal.dot(motion.a.displacement - motion.b.displacement);
  motion.a.shape = moved<S>(motion.a.shape, closing * time);
  motion.a.displacement -= closing;
}

template <class A, class B, class S> Motion<A, B> drawn_motion(Shaker<S>& draw) {
  Motion<A, B> motion{at_rest(drawn(draw, TypeTag<A>{})), at_rest(drawn(draw, TypeTag<B>{}))};
  const int size = draw.pick(0, 3) == 0 ? draw.pick(-20, 20) : 0;
  motion.a.shape = scaled(moved<S>(motion.a.shape, -center(motion.a.shape)), size);
  motion.a.shape = moved<S>(motion.a.shape, draw.vector() * power<S>(draw.pick(0, 2) + std::max(0, size)));
  if (draw.pick(0, 1) == 0) motion.b.displacement = draw.vector();
  motion.a.displacement = draw.vector() * power<S>(std::max(0, size) - draw.pick(0, 2));
  if (draw.pick(0, 3) != 0) {  // where B will be
    const Vec3<S> towards = center(motion.b.shape) + motion.b.displacement - center(motion.a.shape);
    motion.a.displacement += towards * (S(draw.pick(1, 8)) / S(4));
  }
  const int speed = draw.pick(0, 9);
  if (speed == 0) motion.a.displacement *= power<S>(10);
  if (speed == 1) motion.a.displacement *= power<S>(-10);
  if (speed == 2) motion.a.displacement[draw.pick(0, 2)] = S(0);
  if (draw.pick(0, 4) == 0) {
    const Vec3<S> offset = draw.vector() * power<S>(draw.pick(4, 20));
    motion.a.shape = moved(motion.a.shape, offset);
    motion.b.shape = moved(motion.b.shape, offset);
  }
  const S time = S(draw.pick(0, 64)) / S(64);
  switch (draw.pick(0, 9)) {
    case 0: bring_together(motion, S(0)); break;
    case 1: bring_together(motion, S(1)); break;
    case 2:
    case 3: make_graze(motion, time, bring_together(motion, time)); break;
    case 4:
      make_graze(motion, time, bring_together(motion, time));
      motion.a.displacement += draw.vector() * power<S>(-draw.pick(4, std::numeric_limits<S>::digits));
      break;
    default: break;
  }
  return motion;
}

}  // namespace thinwall::testing
