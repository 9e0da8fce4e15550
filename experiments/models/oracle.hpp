#pragma once
/// The oracle: when do two translating shapes first touch, at any precision? It shares no code with the closed forms: all it
/// asks of a shape is which of its points lies farthest in a direction.
///
/// The separation is convex along a translation. Newton's method from before the first contact never passes it, and
/// converges to it; where the separation stops falling first, there is none.
///
/// The nearest point of a convex polytope to the origin: Wolfe, "Finding the nearest point in a polytope", Mathematical Programming
/// 11, 1976. Exact in finitely many steps, but for rounding; at 50 digits rounding is out of sight of a double.

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/swept/moving.hpp>
#include <thinwall/swept/toi.hpp>

namespace thinwall {

/// What the oracle is asked in.
using Digits50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

}  // namespace thinwall

namespace thinwall::oracle {

template <class R> using Vec = std::array<R, 3>;

template <class R> R dot(const Vec<R>& a, const Vec<R>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
template <class R> Vec<R> cross(const Vec<R>& a, const Vec<R>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class R> Vec<R> combination(const R& s, const Vec<R>& a, const R& t, const Vec<R>& b) {
  return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
}

/// Up to four points and the weights that make the nearest point so far of them.
template <class R> struct Corral {
  std::array<Vec<R>, 5> points{};
  std::array<R, 5> weights{};
  std::size_t size = 0;

  Vec<R> point(const std::array<R, 5>& by) const {
    Vec<R> sum{};
    for (std::size_t i = 0; i < size; ++i) sum = combination(R(1), sum, by[i], points[i]);
    return sum;
  }
  void drop(std::size_t i) {
    for (; i + 1 < size; ++i) {
      points[i] = points[i + 1];
      weights[i] = weights[i + 1];
    }
    --size;
  }

  /// The weights, of any sign, of the point nearest to the origin on the flat through all points: with one of them as the
  /// base, a small system of normal equations.
  std::array<R, 5> flat_weights() const {
    const std::size_t n = size - 1;
    std::array<std::array<R, 5>, 4> rows{};
    std::array<Vec<R>, 4> edges{};
    for (std::size_t i = 0; i < n; ++i) edges[i] = combination(R(1), points[i + 1], R(-1), points[0]);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) rows[i][j] = dot(edges[i], edges[j]);
      rows[i][4] = -dot(edges[i], points[0]);
    }
    for (std::size_t column = 0; column < n; ++column) {
      std::size_t pivot = column;
      for (std::size_t i = column + 1; i < n; ++i) {
        if (abs_of(rows[i][column]) > abs_of(rows[pivot][column])) pivot = i;
      }
      std::swap(rows[pivot], rows[column]);
      if (rows[column][column] == 0) continue;
      for (std::size_t i = 0; i < n; ++i) {
        if (i == column) continue;
        const R factor = rows[i][column] / rows[column][column];
        for (std::size_t j = column; j < 5; ++j) rows[i][j] -= factor * rows[column][j];
      }
    }
    std::array<R, 5> result{};
    result[0] = 1;
    for (std::size_t i = 0; i < n; ++i) {
      if (rows[i][i] != 0) result[i + 1] = rows[i][4] / rows[i][i];
      result[0] -= result[i + 1];
    }
    return result;
  }

  static R abs_of(const R& x) { return x < 0 ? R(-x) : x; }
};

/// `support(n)` is a point of the polytope farthest along n; `tolerance` [1] the relative gap at which to stop.
template <class R, class Support> Vec<R> nearest_to_origin(const Support& support, const R& tolerance) {
  using std::sqrt;
  Corral<R> corral;
  corral.points[0] = support(Vec<R>{R(1), R(0), R(0)});
  corral.weights[0] = 1;
  corral.size = 1;
  Vec<R> x = corral.points[0];
  R largest = dot(x, x);
  for (int round = 0; round < 200; ++round) {
    const Vec<R> q = support(Vec<R>{R(-x[0]), R(-x[1]), R(-x[2])});
    const R q_square = dot(q, q);
    if (q_square > largest) largest = q_square;
    const R x_square = dot(x, x);
    const R noise = 64 * std::numeric_limits<R>::epsilon() * sqrt(x_square * largest);  // of the next line's difference
    if (x_square - dot(x, q) <= tolerance * x_square + noise || x_square <= tolerance * tolerance * largest) break;
    corral.points[corral.size] = q;
    corral.weights[corral.size] = 0;
    ++corral.size;
    for (int inner = 0; inner < 8; ++inner) {
      const std::array<R, 5> target = corral.flat_weights();
      R step = 1;
      std::size_t blocking = corral.size;
      for (std::size_t i = 0; i < corral.size; ++i) {
        if (target[i] > 0) continue;
        const R reach = corral.weights[i] / (corral.weights[i] - target[i]);
        if (corral.weights[i] == target[i] || reach < step || blocking == corral.size) {
          step = corral.weights[i] == target[i] ? R(0) : reach;
          blocking = i;
        }
      }
      for (std::size_t i = 0; i < corral.size; ++i) corral.weights[i] += step * (target[i] - corral.weights[i]);
      if (blocking == corral.size) break;
      corral.drop(blocking);
    }
    const Vec<R> next = corral.point(corral.weights);
    if (!(dot(next, next) < x_square)) break;
    x = next;
    if (corral.size == 4) break;  // a tetrahedron around the origin
  }
  return x;
}

/// B's center moves past the Minkowski difference of the cores, A's less B's, and touches it within `reach`.
template <class R> struct Problem {
  Vec<R> offset{}, motion{};         ///< [length] from A's center to B's at the start; B's displacement less A's
  std::vector<Vec<R>> generators{};  ///< [length] half edges: all sums of them with factors of -1 to 1
  std::vector<Vec<R>> corners{};     ///< [length] of a triangle, to add one of; empty: none
  R reach = 0;                       ///< [length] the sum of the radii
  /// [length] What a computation adds up along each axis: |cA| + |cB| + h, |vA| + |vB|.
  Vec<R> start_size{}, speed_size{};

  void add(const Vec<R>& generator) { generators.push_back(generator); }

  /// [length] How far the difference reaches along n, times |n|.
  R support(const Vec<R>& n) const {
    R reached = 0, farthest = 0;
    for (const Vec<R>& g : generators) {
      const R along = dot(n, g);
      reached += along < 0 ? R(-along) : along;
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const R here = dot(corners[i], n);
      if (i == 0 || here > farthest) farthest = here;
    }
    return reached + farthest;
  }
  /// [length] What one round-off is measured by, along the unit vector n.
  R scale(const R& time, const Vec<R>& n) const {
    R spread = 0;
    for (std::size_t i = 0; i < 3; ++i) spread += (n[i] < 0 ? R(-n[i]) : n[i]) * (start_size[i] + time * speed_size[i]);
    return spread + reach;
  }
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
  R core = 0;     ///< [length] distance between the cores; 0 once they meet, or less: see signed_gap_at
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
  Vec<R> n{};
  for (std::size_t i = 0; i < 3 && gap.core > 0; ++i) n[i] = x[i] / gap.core;
  gap.closing = dot(n, problem.motion);
  gap.scale = problem.scale(time, n);
  return gap;
}

/// Of the cores' difference.
template <class R> std::vector<Vec<R>> edges_of(const Problem<R>& problem) {
  std::vector<Vec<R>> edges = problem.generators;
  for (std::size_t i = 0; i < problem.corners.size(); ++i)
    edges.push_back(combination(R(1), problem.corners[(i + 1) % 3], R(-1), problem.corners[i]));
  return edges;
}

/// Calls look(n) with the unit normals, both ways, of every two edges that are not parallel to rounding.
template <class R, class Look> void for_each_face(const std::vector<Vec<R>>& edges, const Look& look) {
  using std::sqrt;
  const R least = 64 * std::numeric_limits<R>::epsilon();  // [1] sine
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      const Vec<R> n = cross(edges[i], edges[j]);
      const R length = sqrt(dot(n, n));
      if (!(length > least * sqrt(dot(edges[i], edges[i]) * dot(edges[j], edges[j])))) continue;
      for (const R& part : {R(R(1) / length), R(R(-1) / length)}) look(Vec<R>{n[0] * part, n[1] * part, n[2] * part});
    }
  }
}

/// True if three of the edges span a volume, by more than rounding: what is flat, or a line, has no inside.
template <class R> bool has_inside(const std::vector<Vec<R>>& edges) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const R volume = dot(cross(edges[i], edges[j]), edges[k]);
        const R squares = dot(edges[i], edges[i]) * dot(edges[j], edges[j]) * dot(edges[k], edges[k]);
        if (volume * volume > std::numeric_limits<R>::epsilon() * squares) return true;
      }
    }
  }
  return false;
}

/// The same, but of cores that meet, and whose difference has an inside, `core` is less than 0: the least translation that parts them. Beside
/// nearly parallel edges `gap_at` has few digits left of what is nearly 0; on which side of every face it lies tells more.
template <class R> Gap<R> signed_gap_at(const Problem<R>& problem, const R& time, const R& tolerance) {
  const Gap<R> gap = gap_at(problem, time, tolerance);
  if (gap.core * gap.core > tolerance * gap.scale * gap.scale) return gap;
  const std::vector<Vec<R>> edges = edges_of(problem);
  if (!has_inside(edges)) return gap;
  const Vec<R> at = combination(R(1), problem.offset, time, problem.motion);
  std::optional<Gap<R>> nearest;
  for_each_face(edges, [&](const Vec<R>& n) {
    const R core = dot(n, at) - problem.support(n);
    if (!nearest || core > nearest->core) nearest = {core, R(-dot(n, problem.motion)), problem.scale(time, n)};
  });
  return nearest->core > 0 ? gap : *nearest;
}

using Verdict = ToiStatus;  ///< apart, hit or overlapping

template <class R> struct Impact {
  Verdict verdict = Verdict::apart;
  R time = 1;          ///< [1] of first contact
  R conditioning = 0;  ///< [1] kappa t = scale / |n.v|: a relative change u of the input moves the time by u times this
  R start_margin = 0;  ///< [1] separation over scale at the start
};

/// Where to start Newton's method: any time before the first contact; a good one saves rounds and changes nothing else.
template <class R> Impact<R> first_contact(const Problem<R>& problem, const R& guess, const R& tolerance) {
  using std::ldexp;
  Impact<R> impact;
  Gap<R> gap = signed_gap_at(problem, R(0), tolerance);
  const R start = gap.core - problem.reach;
  impact.start_margin = gap.scale > 0 ? R(start / gap.scale) : R(0);
  if (start <= tolerance * gap.scale) {
    impact.verdict = Verdict::overlapping;
    impact.time = 0;
    return impact;
  }
  R time = 0, conditioning = 0;
  const auto hit = [&](const R& at) { return Impact<R>{Verdict::hit, at, conditioning, impact.start_margin}; };
  if (guess > 0 && guess < 1) {
    const Gap<R> near = gap_at(problem, guess, tolerance);
    if (near.core - problem.reach > tolerance * near.scale && near.closing > 0) {
      time = guess;
      gap = near;
    }
  }
  for (int round = 0; round < 400; ++round) {
    if (!(gap.closing > 0)) {
      const auto reaches = [&](const Gap<R>& at, const R& margin) {
        return at.core - problem.reach <= margin * at.scale;
      };
      const R touch = 4096 * tolerance;  // where cores touch to the last digits the side they do it from is rounding:
      bool touches = round > 0 && reaches(gap, touch);
      const bool may_meet = round > 0 && gap.core * gap.core <= tolerance * gap.scale * gap.scale;
      for (int k = 20; k <= 100 && may_meet && !touches; k += 20) {  // what comes next tells
        const R later = time + ldexp(R(1), -k);
        touches = reaches(signed_gap_at(problem, later < 1 ? later : R(1), tolerance), R(-touch));
      }
      return touches ? hit(time) : impact;
    }
    conditioning = gap.scale / gap.closing;
    const R next = time + (gap.core - problem.reach) / gap.closing;
    if (next > 1) return impact;  // the tangent bounds the separation from below, all the way to the end
    const Gap<R> there = gap_at(problem, next, tolerance);
    if (there.core - problem.reach <= tolerance * there.scale || there.core == 0 || next == time) return hit(next);
    time = next;
    gap = there;
  }
  return hit(time);  // a double root, approached by halves: closer than any input could tell
}

}  // namespace thinwall::oracle
