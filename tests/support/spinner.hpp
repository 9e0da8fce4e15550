#pragma once
/// A body that flies straight and spins, in any numbers: points of it as functions of time, with their first two derivatives. Of the
/// library it takes what the shapes are, no more.

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <arb.h>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/triangle.hpp>
#include <thinwall/swept/turning.hpp>

#include "support/real.hpp"

namespace thinwall::oracle {

// ---- Numbers that know how wrong they are: a midpoint and a radius, by the library Arb. Whatever is computed from balls encloses whatever
// could be computed from the numbers in them, so that a ball above zero is a proof.

class Ball {
 public:
  Ball() { arb_init(x_); }
  Ball(const Ball& other) : Ball() { arb_set(x_, other.x_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(x_, other.x_); }
  Ball& operator=(Ball other) noexcept {
    arb_swap(x_, other.x_);
    return *this;
  }
  ~Ball() { arb_clear(x_); }

  /// The very number, whatever its digits: a sum of doubles.
  template <class N> explicit Ball(const N& number) : Ball() {
    if constexpr (std::is_same_v<N, double> || std::is_integral_v<N>) {
      arb_set_d(x_, static_cast<double>(number));
    } else {
      N rest = number;
      while (rest != N(0)) {
        const auto part = static_cast<double>(rest);
        rest -= N(part);
        const Ball exact(part);
        arb_add(x_, x_, exact.x_, ARF_PREC_EXACT);
      }
    }
  }
  /// The least ball that holds both.
  static Ball hull(const Ball& a, const Ball& b) {
    Ball both;
    arb_union(both.x_, a.x_, b.x_, precision());
    return both;
  }

  /// [bits] that midpoints are rounded to, from now on and in this thread.
  static slong& precision() {
    thread_local slong bits = 64;
    return bits;
  }

  friend Ball operator+(const Ball& a, const Ball& b) { return made(arb_add, a, b); }
  friend Ball operator-(const Ball& a, const Ball& b) { return made(arb_sub, a, b); }
  friend Ball operator*(const Ball& a, const Ball& b) { return made(arb_mul, a, b); }
  friend Ball operator/(const Ball& a, const Ball& b) { return made(arb_div, a, b); }
  Ball operator-() const { return made(negated); }
  Ball& operator+=(const Ball& other) { return *this = *this + other; }
  Ball& operator-=(const Ball& other) { return *this = *this - other; }
  friend Ball sqrt(const Ball& a) { return a.made(arb_sqrtpos); }
  friend Ball abs(const Ball& a) { return a.made(without_sign); }
  friend Ball max(const Ball& a, const Ball& b) { return made(arb_max, a, b); }
  friend Ball min(const Ball& a, const Ball& b) { return made(arb_min, a, b); }
  friend std::pair<Ball, Ball> sine_and_cosine(const Ball& a) {
    std::pair<Ball, Ball> both;
    arb_sin_cos(both.first.x_, both.second.x_, a.x_, precision());
    return both;
  }

  /// For certain: of every number in it.
  bool is_positive() const { return arb_is_positive(x_) != 0; }
  bool is_negative() const { return arb_is_negative(x_) != 0; }
  bool is_not_negative() const { return arb_is_nonnegative(x_) != 0; }
  bool is_zero() const { return arb_is_zero(x_) != 0; }
  bool is_finite() const { return arb_is_finite(x_) != 0; }
  friend bool certainly_less(const Ball& a, const Ball& b) { return arb_lt(a.x_, b.x_) != 0; }

  /// Near the midpoint.
  double rough() const { return arf_get_d(arb_midref(x_), ARF_RND_NEAR); }
  /// So many digits, of which the last may be off by one; fewer where the ball is wider than that.
  std::string digits(int count) const {
    char* text = arb_get_str(x_, count, ARB_STR_NO_RADIUS);
    std::string copy = text;
    flint_free(text);
    return copy;
  }

 private:
  static void negated(arb_t made, const arb_t x, slong) { arb_neg(made, x); }
  static void without_sign(arb_t made, const arb_t x, slong) { arb_abs(made, x); }
  template <class F> Ball made(const F& f) const {
    Ball result;
    f(result.x_, x_, precision());
    return result;
  }
  template <class F> static Ball made(const F& f, const Ball& a, const Ball& b) {
    Ball result;
    f(result.x_, a.x_, b.x_, precision());
    return result;
  }

  arb_t x_;
};

/// So many bits for as long as it lives.
class BallPrecision {
 public:
  explicit BallPrecision(slong bits) : before_(std::exchange(Ball::precision(), bits)) {}
  ~BallPrecision() { Ball::precision() = before_; }
  BallPrecision(const BallPrecision&) = delete;
  BallPrecision& operator=(const BallPrecision&) = delete;

 private:
  slong before_;
};

// ---- A body that flies straight and spins.

template <class N> std::pair<N, N> sine_and_cosine(const N& x) {
  using std::sin, std::cos;
  return {N(sin(x)), N(cos(x))};
}
template <class M, class N> M as(const N& x) {
  if constexpr (std::is_same_v<M, N>) {
    return x;
  } else {
    return static_cast<M>(x);
  }
}
template <class M, class V> Triple<M> as_triple(const V& v) { return {as<M>(v[0]), as<M>(v[1]), as<M>(v[2])}; }

/// A vector that turns with a body.
template <class N> struct Arm {
  Triple<N> start;           ///< [length] at the start of the step
  Triple<N> across, inward;  ///< [length] axis x start, axis x across
};

/// Something that moves, at one time: where it is, and its first two derivatives.
template <class N> struct Arc {
  Triple<N> place, speed, pull;
};

/// How far a body has turned.
template <class N> struct Phase {
  N sine = N(0), cosine = N(1);
};

/// center + path t + R(t) (core), and a radius around. The core is all sums of x_k arm_k with |x_k| <= 1, or lies between three corners.
template <class N> struct Spinner {
  Triple<N> center, path;
  bool turns = false;
  Triple<N> axis;
  N angle = N(0);
  N radius = N(0);
  bool corners = false;
  std::vector<Arm<N>> arms;
  std::vector<Arm<N>> edges;  ///< those of some length
  std::vector<Arm<N>> frame;  ///< a box's axes

  Spinner() = default;
  template <class A> explicit Spinner(const Turning<A>& m) : path(as_triple<N>(m.displacement)) {
    using std::sqrt;
    turns = m.rotation[0] != 0 || m.rotation[1] != 0 || m.rotation[2] != 0;
    if (turns) {
      const Triple<N> rotation = as_triple<N>(m.rotation);
      angle = N(sqrt(dot(rotation, rotation)));
      axis = {N(rotation[0] / angle), N(rotation[1] / angle), N(rotation[2] / angle)};
    }
    take(m.shape);
  }

  Arm<N> arm(const Triple<N>& v) const {
    const Triple<N> across = cross(axis, v);
    return {v, across, cross(axis, across)};
  }
  Phase<N> phase(const N& time) const {
    if (!turns) return {};
    auto [sine, cosine] = sine_and_cosine(N(angle * time));
    return {std::move(sine), std::move(cosine)};
  }
  Arc<N> arc(const Arm<N>& a, const Phase<N>& now) const {
    if (!turns) return {a.start, {N(0), N(0), N(0)}, {N(0), N(0), N(0)}};
    return {place(a, now), angle * (now.cosine * a.across + now.sine * a.inward),
            angle * (angle * (now.cosine * a.inward - now.sine * a.across))};
  }
  Triple<N> place(const Arm<N>& a, const Phase<N>& now) const {
    if (!turns) return a.start;
    return a.start + now.sine * a.across + N(N(1) - now.cosine) * a.inward;
  }
  /// A vector of the world at that phase, as the body had it at the start.
  Triple<N> seen(const Triple<N>& v, const Phase<N>& now) const {
    return place(arm(v), {N(N(0) - now.sine), now.cosine});
  }
  Triple<N> center_at(const N& time) const { return center + time * path; }

 private:
  void take(const Sphere<double>& s) {
    center = as_triple<N>(s.center);
    radius = N(s.radius);
  }
  void take(const Capsule<double>& c) {
    const Triple<N> a = as_triple<N>(c.a), b = as_triple<N>(c.b);
    center = N(0.5) * (a + b);
    radius = N(c.radius);
    arms.push_back(arm(N(0.5) * (b - a)));
    if (c.a != c.b) edges = arms;
  }
  void take(const Obb<double>& box) {
    center = as_triple<N>(box.center);
    for (int k = 0; k < 3; ++k) {
      const Triple<N> column = as_triple<N>(Vec3<double>(box.axes.col(k)));
      frame.push_back(arm(column));
      if (box.half_extents[k] == 0) continue;
      arms.push_back(arm(N(box.half_extents[k]) * column));
    }
    edges = arms;
  }
  void take(const Triangle<double>& t) {
    const Triple<N> a = as_triple<N>(t.a), b = as_triple<N>(t.b), c = as_triple<N>(t.c), sum = a + b + c;
    center = {N(sum[0] / N(3)), N(sum[1] / N(3)), N(sum[2] / N(3))};
    corners = true;
    for (const Triple<N>& corner : {a, b, c}) arms.push_back(arm(corner - center));
    if (t.a != t.b) edges.push_back(arm(b - a));
    if (t.b != t.c) edges.push_back(arm(c - b));
    if (t.c != t.a) edges.push_back(arm(a - c));
  }
};

/// Both, and the way between their centers.
template <class N> struct Spinners {
  Spinner<N> a, b;
  Triple<N> between, path;

  template <class A, class B>
  Spinners(const Turning<A>& of_a, const Turning<B>& of_b)
      : a(of_a), b(of_b), between(b.center - a.center), path(b.path - a.path) {}
};

}  // namespace thinwall::oracle
