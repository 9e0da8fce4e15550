#pragma once
/// A body that flies straight and spins, in any numbers: points of it as functions of time, with their first two derivatives. Of the
/// library it takes what the shapes are, no more.

#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/triangle.hpp>
#include <thinwall/swept/turning.hpp>

#include "support/ball.hpp"
#include "support/real.hpp"

namespace thinwall::oracle {

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
    Arc<N> made;
    const N rest = N(1) - now.cosine;
    for (std::size_t i = 0; i < 3; ++i) {
      made.place[i] = a.start[i] + now.sine * a.across[i] + rest * a.inward[i];
      made.speed[i] = angle * N(now.cosine * a.across[i] + now.sine * a.inward[i]);
      made.pull[i] = angle * N(angle * N(now.cosine * a.inward[i] - now.sine * a.across[i]));
    }
    return made;
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
