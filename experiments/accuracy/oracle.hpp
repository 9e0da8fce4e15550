#pragma once
/// The oracle: when do two translating shapes first touch, at any precision? It shares no code with the closed forms: all it
/// asks of a shape is which of its points lies farthest in a direction.
///
/// The separation is convex along a translation. Newton's method from before the first contact never passes it, and
/// converges to it; where the separation stops falling first, there is none.

#include <array>
#include <cmath>
#include <vector>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/experiments/accuracy/nearest_point.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall::oracle {

/// B's center moves past the Minkowski difference of the cores, A's less B's, and touches it within `reach`.
template <class R> struct Problem {
  Vec<R> offset{}, motion{};         ///< [length] from A's center to B's at the start; B's displacement less A's
  std::vector<Vec<R>> generators{};  ///< [length] half edges: all sums of them with factors of -1 to 1
  std::vector<Vec<R>> corners{};     ///< [length] of a triangle, to add one of; empty: none
  R reach = 0;                       ///< [length] the sum of the radii
  Vec<R> start_size{},
      speed_size{};  ///< [length] what a computation adds up along each axis: |cA| + |cB| + h, |vA| + |vB|

  void add(const Vec<R>& generator) { generators.push_back(generator); }
};

template <class R, class S> Vec<R> lift(const Vec3<S>& v) { return {R(v[0]), R(v[1]), R(v[2])}; }

/// Adds a shape's core to the problem; `sign` is -1 for B. Returns its center.
template <class R, class S> Vec<R> add_core(Problem<R>& problem, const Sphere<S>& s, int) {
  problem.reach += R(s.radius);
  return lift<R>(s.center);
}
template <class R, class S> Vec<R> add_core(Problem<R>& problem, const Aabb<S>& box, int) {
  for (std::size_t i = 0; i < 3; ++i) {
    Vec<R> edge{};
    edge[i] = R(box.half_extents[static_cast<int>(i)]);
    problem.add(edge);
  }
  return lift<R>(box.center);
}
template <class R, class S> Vec<R> add_core(Problem<R>& problem, const Obb<S>& box, int) {
  for (int i = 0; i < 3; ++i) {
    problem.add(combination(R(box.half_extents[i]), lift<R>(Vec3<S>(box.axes.col(i))), R(0), {}));
  }
  return lift<R>(box.center);
}
template <class R, class S> Vec<R> add_core(Problem<R>& problem, const Capsule<S>& c, int) {
  const R half = R(1) / 2;
  problem.add(combination(half, lift<R>(c.b), R(-half), lift<R>(c.a)));
  problem.reach += R(c.radius);
  return combination(half, lift<R>(c.a), half, lift<R>(c.b));
}
template <class R, class S> Vec<R> add_core(Problem<R>& problem, const Triangle<S>& t, int sign) {
  const Vec<R> a = lift<R>(t.a);
  for (const Vec3<S>& corner : {t.a, t.b, t.c}) {
    problem.corners.push_back(combination(R(sign), lift<R>(corner), R(-sign), a));
  }
  return a;
}

template <class R, class A, class B> Problem<R> pose(const Moving<A>& a, const Moving<B>& b) {
  Problem<R> problem;
  const Vec<R> from = add_core(problem, a.shape, 1), to = add_core(problem, b.shape, -1);
  problem.offset = combination(R(1), to, R(-1), from);
  const Vec<R> v_a = lift<R>(a.displacement), v_b = lift<R>(b.displacement);
  problem.motion = combination(R(1), v_b, R(-1), v_a);
  const auto size = [](const R& x) { return x < 0 ? R(-x) : x; };
  for (std::size_t i = 0; i < 3; ++i) {
    problem.start_size[i] = size(from[i]) + size(to[i]);
    problem.speed_size[i] = size(v_a[i]) + size(v_b[i]);
    for (const Vec<R>& g : problem.generators) problem.start_size[i] += size(g[i]);
    R widest = 0;
    for (const Vec<R>& c : problem.corners) widest = size(c[i]) > widest ? size(c[i]) : widest;
    problem.start_size[i] += widest;
  }
  return problem;
}

/// The separation at one time, and how fast it falls.
template <class R> struct Gap {
  R core = 0;     ///< [length] distance between the cores; 0 once they meet
  R closing = 0;  ///< [length] per step; > 0 while the cores come nearer
  R scale = 0;  ///< [length] sum |n_i| (|cA| + |cB| + h + t (|vA| + |vB|))_i + reach: what one round-off is measured by
};

template <class R> Gap<R> gap_at(const Problem<R>& problem, const R& time, const R& tolerance) {
  using std::sqrt;
  const Vec<R> at = combination(R(1), problem.offset, time, problem.motion);
  const Vec<R> x = nearest_to_origin<R>(
      [&](const Vec<R>& n) {
        Vec<R> point{R(-at[0]), R(-at[1]), R(-at[2])};
        for (const Vec<R>& g : problem.generators) point = combination(R(1), point, R(dot(g, n) < 0 ? -1 : 1), g);
        const Vec<R>* farthest = nullptr;
        for (const Vec<R>& c : problem.corners) {
          if (farthest == nullptr || dot(c, n) > dot(*farthest, n)) farthest = &c;
        }
        return farthest == nullptr ? point : combination(R(1), point, R(1), *farthest);
      },
      tolerance);
  Gap<R> gap;
  gap.core = sqrt(dot(x, x));
  R spread = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const R weight = gap.core > 0 ? R(x[i] / gap.core) : R(0);
    spread += (weight < 0 ? R(-weight) : weight) * (problem.start_size[i] + time * problem.speed_size[i]);
    gap.closing += weight * problem.motion[i];
  }
  gap.scale = spread + problem.reach;
  return gap;
}

enum class Verdict { apart, hit, overlapping };

template <class R> struct Impact {
  Verdict verdict = Verdict::apart;
  R time = 1;          ///< [1] of first contact
  R conditioning = 0;  ///< [1] kappa t = scale / |n.v|: a relative change u of the input moves the time by u times this
  R start_margin = 0;  ///< [1] separation over scale at the start
};

/// Where to start Newton's method: any time before the first contact; a good one saves rounds and changes nothing else.
template <class R> Impact<R> first_contact(const Problem<R>& problem, const R& guess, const R& tolerance) {
  Impact<R> impact;
  Gap<R> gap = gap_at(problem, R(0), tolerance);
  const R start = gap.core - problem.reach;
  impact.start_margin = gap.scale > 0 ? R(start / gap.scale) : R(0);
  if (start <= tolerance * gap.scale) {
    impact.verdict = Verdict::overlapping;
    impact.time = 0;
    return impact;
  }
  R time = 0;
  if (guess > 0 && guess < 1) {
    const Gap<R> near = gap_at(problem, guess, tolerance);
    if (near.core - problem.reach > tolerance * near.scale && near.closing > 0) {
      time = guess;
      gap = near;
    }
  }
  R conditioning = 0;
  for (int round = 0; round < 400; ++round) {
    if (!(gap.closing > 0)) return impact;
    conditioning = gap.scale / gap.closing;
    const R next = time + (gap.core - problem.reach) / gap.closing;
    if (next > 1) return impact;  // the tangent bounds the separation from below, all the way to the end
    const Gap<R> there = gap_at(problem, next, tolerance);
    if (there.core - problem.reach <= tolerance * there.scale || there.core == 0 || next == time) {
      impact.verdict = Verdict::hit;
      impact.time = next;
      impact.conditioning = conditioning;
      return impact;
    }
    time = next;
    gap = there;
  }
  impact.verdict = Verdict::hit;  // a double root, approached by halves: closer than any input could tell
  impact.time = time;
  impact.conditioning = conditioning;
  return impact;
}

/// The least of |separation| / scale by which the verdict, hit or miss, is decided; > 0 apart, < 0 in contact.
template <class R> R verdict_margin(const Problem<R>& problem, const R& tolerance) {
  R low = 0, high = 1;
  if (gap_at(problem, high, tolerance).closing > 0) {
    low = high;
  } else {
    for (int round = 0; round < 200 && high - low > tolerance; ++round) {
      const R middle = (low + high) / 2;
      const Gap<R> gap = gap_at(problem, middle, tolerance);
      (gap.closing > 0 ? low : high) = middle;
    }
  }
  const Gap<R> gap = gap_at(problem, low, tolerance);
  return (gap.core - problem.reach) / (gap.scale > 0 ? gap.scale : R(1));
}

}  // namespace thinwall::oracle
