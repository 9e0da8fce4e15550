#pragma once
/// The truth about two shapes that turn: whether and when they first touch, in long double. A gap closes no faster than the fastest point
/// of either moves, so that a step of gap over speed never passes first contact, and many of them come to it. It shares nothing with the
/// methods that it judges: the gap is that of the oracle of straight motion, at a pose; the pose is Rodrigues' formula, here.
///
/// Of balls, rods and boxes: a triangle's corners, which the oracle keeps apart from generators, are not turned.
/// Error of the time: early by what closes a gap of 2^-54 of the sizes; a miss by less is called a hit.

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

#include <thinwall/experiments/models/oracle.hpp>
#include <thinwall/swept/turning.hpp>

namespace thinwall::oracle {

class TurningTruth {
 public:
  using R = long double;

  Verdict verdict = Verdict::apart;
  R time = 1;   ///< [1] of first contact
  R speed = 0;  ///< [length] per step: the relative path, and how far the cores' farthest points turn

  template <class A, class B>
    requires(!std::same_as<A, Triangle<typename A::Scalar>> && !std::same_as<B, Triangle<typename B::Scalar>>)
  TurningTruth(const Turning<A>& a, const Turning<B>& b)
      : start_(pose<R>(Moving{a.shape, a.displacement}, Moving{b.shape, b.displacement})) {
    Problem<R> alone;
    add_core(alone, a.shape, 1);
    spins_ = {Spin(a.rotation, start_, 0, alone.generators.size()),
              Spin(b.rotation, start_, alone.generators.size(), start_.generators.size())};
    speed = length(start_.motion) + spins_[0].speed + spins_[1].speed;
    find();
  }

 private:
  /// How a body turns, and which of the generators are its own.
  struct Spin {
    std::size_t first = 0, end = 0;
    Vec<R> axis{};  // unit
    R angle = 0;    // [rad] a step
    R speed = 0;    // [length] per step, of its corner that is farthest from the axis

    Spin() = default;
    template <class S>
    Spin(const Vec3<S>& rotation, const Problem<R>& problem, std::size_t from, std::size_t to) : first(from), end(to) {
      const Vec<R> by = lift<R>(rotation);
      angle = length(by);
      if (angle > 0) axis = combination(1 / angle, by, R(0), by);
      for (std::size_t signs = 0; signs < std::size_t{1} << (end - first); ++signs) {
        Vec<R> corner{};
        for (std::size_t k = first; k < end; ++k)
          corner = combination(R(1), corner, (signs >> (k - first) & 1) != 0 ? R(-1) : R(1), problem.generators[k]);
        speed = std::max(speed, angle * length(cross(axis, corner)));
      }
    }

    Vec<R> turned(const Vec<R>& v, R at) const {
      const R c = std::cos(angle * at), s = std::sin(angle * at);
      return combination(R(1), combination(c, v, s, cross(axis, v)), (1 - c) * dot(axis, v), axis);
    }
  };

  static R length(const Vec<R>& v) { return std::sqrt(dot(v, v)); }

  Gap<R> gap(R at) const {
    Problem<R> there = start_;
    there.offset = combination(R(1), start_.offset, at, start_.motion);
    for (const Spin& spin : spins_) {
      for (std::size_t k = spin.first; k < spin.end; ++k) there.generators[k] = spin.turned(start_.generators[k], at);
    }
    return gap_at(there, R(0), R(0x1p-60));
  }

  void find() {
    for (R at = 0;;) {
      const Gap<R> now = gap(at);
      const R apart = now.core - start_.reach;
      if (apart <= R(0x1p-54) * now.scale) {
        verdict = at == 0 ? Verdict::overlapping : Verdict::hit;
        time = at;
        return;
      }
      if (!(at + apart / speed <= 1)) return;
      at += apart / speed;
    }
  }

  Problem<R> start_;
  std::array<Spin, 2> spins_;
};

}  // namespace thinwall::oracle
