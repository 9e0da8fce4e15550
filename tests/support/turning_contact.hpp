#pragma once
/// Proofs that two shapes that turn touch at a time: a point of each core, named by somebody, whose distance a ball bounds; or an edge of
/// one core that goes through the other, which shows that cores meet when nothing is around them.

#include <algorithm>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/spinner.hpp"

namespace thinwall::oracle {

/// The triangle's point nearest to `wanted`, as shares of its corners.
template <class N> std::vector<N> shares_of_triangle(const std::vector<Triple<N>>& arms, const Triple<N>& wanted) {
  using std::clamp;
  const Triple<N> e1 = arms[1] - arms[0], e2 = arms[2] - arms[0], p = wanted - arms[0];
  const N a = dot(e1, e1), b = dot(e1, e2), c = dot(e2, e2), det = a * c - b * b;
  if (det > N(0)) {
    const N s = N((c * dot(p, e1) - b * dot(p, e2)) / det), t = N((a * dot(p, e2) - b * dot(p, e1)) / det);
    if (s >= N(0) && t >= N(0) && s + t <= N(1)) return {N(N(1) - s - t), s, t};
  }
  std::vector<N> nearest;
  N least = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const Triple<N> edge = arms[next] - arms[k], from = wanted - arms[k];
    const N square = dot(edge, edge);
    const N along = square > N(0) ? N(clamp(N(dot(from, edge) / square), N(0), N(1))) : N(0);
    const Triple<N> rest = from - along * edge;
    const N distance = dot(rest, rest);
    if (!nearest.empty() && !(distance < least)) continue;
    least = distance;
    nearest.assign(3, N(0));
    nearest[k] = N(N(1) - along);
    nearest[next] = along;
  }
  return nearest;
}

/// The core's point nearest to `wanted`, [length] from its center, as shares of its arms, of which none is more than `most`. A box's arms are at
/// right angles but for rounding, which a few sweeps mend.
template <class N>
std::vector<N> shares(const Spinner<N>& body, const std::vector<Triple<N>>& arms, const Triple<N>& wanted,
                      const N& most) {
  using std::clamp;
  if (body.corners) return shares_of_triangle(arms, wanted);
  std::vector<N> made(arms.size(), N(0));
  Triple<N> rest = wanted;
  for (int sweep = 0; sweep < (arms.size() > 1 ? 4 : 1); ++sweep) {
    for (std::size_t k = 0; k < arms.size(); ++k) {
      const N square = dot(arms[k], arms[k]);
      if (!(square > N(0))) continue;
      const N share = N(clamp(N(made[k] + dot(rest, arms[k]) / square), N(-most), most));
      rest = rest - N(share - made[k]) * arms[k];
      made[k] = share;
    }
  }
  return made;
}

/// The point that has these shares, [length] from the body's center; nothing if they are no point's of the core.
template <class M, class N>
std::optional<Triple<M>> point(const Spinner<M>& body, const std::vector<Triple<M>>& arms, const std::vector<N>& x) {
  Triple<M> sum = {M(0), M(0), M(0)};
  if (body.corners) {
    for (std::size_t k = 1; k < 3; ++k) {
      if (x[k] < N(0)) return std::nullopt;
      sum = sum + as<M>(x[k]) * (arms[k] - arms[0]);
    }
    const M both = as<M>(x[1]) + as<M>(x[2]);
    bool beyond = false;  // by rounding
    if constexpr (std::is_same_v<M, Ball>) {
      beyond = !(Ball(1) - both).is_not_negative();
    } else {
      beyond = both > M(1);
    }
    if (beyond) sum = {sum[0] / both, sum[1] / both, sum[2] / both};
    return arms[0] + sum;
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k] > N(1) || x[k] < N(-1)) return std::nullopt;
    sum = sum + as<M>(x[k]) * arms[k];
  }
  return sum;
}

/// What lies on a line, |t| <= 1: middle + t half.
template <class N> struct Edge {
  Triple<N> middle, half;
};

/// A core at one time, around its center.
template <class N> struct Core {
  bool corners = false;
  std::vector<Triple<N>> arms;

  Core(const Spinner<N>& body, const N& time) : corners(body.corners) {
    const Phase<N> now = body.phase(time);
    for (const Arm<N>& arm : body.arms) arms.push_back(body.place(arm, now));
  }
  std::vector<Edge<N>> edges() const {
    std::vector<Edge<N>> made;
    const std::size_t count = arms.size();
    if (corners) {
      for (std::size_t k = 0; k < count; ++k) {
        const Triple<N>&p = arms[k], &q = arms[(k + 1) % count];
        made.push_back({N(0.5) * (p + q), N(0.5) * (q - p)});
      }
      return made;
    }
    for (std::size_t along = 0; along < count; ++along) {
      for (std::size_t signs = 0; signs < std::size_t{1} << count; ++signs) {
        if ((signs >> along & 1) != 0) continue;
        Triple<N> middle = {N(0), N(0), N(0)};
        for (std::size_t k = 0; k < count; ++k) {
          if (k != along) middle = (signs >> k & 1) == 0 ? middle + arms[k] : middle - arms[k];
        }
        made.push_back({middle, arms[along]});
      }
    }
    return made;
  }
};

/// True if the point, from the box's center, lies inside it: its shares of the arms, by Cramer's rule, are below 1.
inline bool holds(const Core<Ball>& box, const Triple<Ball>& point) {
  const Triple<Ball>&x = box.arms[0], &y = box.arms[1], &z = box.arms[2];
  const Ball volume = abs(dot(x, cross(y, z)));
  const auto inside = [&](const Triple<Ball>& face) { return certainly_less(abs(dot(point, face)), volume); };
  return inside(cross(y, z)) && inside(cross(z, x)) && inside(cross(x, y));
}

/// About the middle of the edge's part in the box; nothing if it misses the box.
template <class N> std::optional<N> middle_within(const Edge<N>& edge, const Core<N>& box) {
  using std::abs, std::max, std::min;
  N low = N(-1), high = N(1);
  for (std::size_t k = 0; k < 3; ++k) {
    const Triple<N> face = cross(box.arms[(k + 1) % 3], box.arms[(k + 2) % 3]);
    const N volume = N(abs(dot(box.arms[k], face))), from = dot(edge.middle, face), along = dot(edge.half, face);
    if (along == N(0)) {
      if (!(abs(from) < volume)) return std::nullopt;
      continue;
    }
    const N first = N((-volume - from) / along), second = N((volume - from) / along);
    low = max(low, min(first, second));
    high = min(high, max(first, second));
  }
  if (!(low < high)) return std::nullopt;
  return N(low + (high - low) / N(2));
}

/// True if the edge goes through a triangle or a box of two arms: middle + t half = origin + x u + y v, by Cramer's rule.
inline bool goes_through(const Edge<Ball>& edge, const Core<Ball>& flat) {
  const std::vector<Triple<Ball>>& arms = flat.arms;
  const Triple<Ball> u = flat.corners ? arms[1] - arms[0] : arms[0], v = flat.corners ? arms[2] - arms[0] : arms[1];
  const Triple<Ball> from = flat.corners ? edge.middle - arms[0] : edge.middle;
  const Triple<Ball> normal = cross(u, v);
  const Ball volume = dot(edge.half, normal), size = abs(volume);
  if (!certainly_less(abs(dot(from, normal)), size)) return false;
  Ball x = dot(from, cross(v, edge.half)), y = dot(from, cross(edge.half, u));
  if (!flat.corners) return certainly_less(abs(x), size) && certainly_less(abs(y), size);
  if (volume.is_negative()) {
    x = -x;
    y = -y;
  }
  return x.is_positive() && y.is_positive() && certainly_less(x + y, size);
}

/// About the shares of two edges at which they are nearest; of parallel ones, two of those.
template <class N> std::pair<N, N> nearest_shares(const Edge<N>& e, const Edge<N>& f) {
  using std::clamp;
  const auto share = [](const N& along, const N& square) {
    return square > N(0) ? N(clamp(N(along / square), N(-1), N(1))) : N(0);
  };
  const Triple<N> way = f.middle - e.middle;
  const N ee = dot(e.half, e.half), ff = dot(f.half, f.half), ef = dot(e.half, f.half);
  N s = share(N(ff * dot(way, e.half) - ef * dot(way, f.half)), N(ee * ff - ef * ef));
  const N t = share(N(s * ef - dot(way, f.half)), ff);
  s = share(N(dot(way, e.half) + t * ef), ee);
  return {s, t};
}

/// Two cores at a time, in numbers that name points and in balls that prove.
template <class N> class ContactProof {
 public:
  ContactProof(const Spinners<N>& pair, const Spinners<Ball>& proof, const N& time)
      : pair_(pair),
        proof_(proof),
        between_(pair.between + time * pair.path),
        way_(proof.between + Ball(time) * proof.path),
        core_a_(pair.a, time),
        core_b_(pair.b, time),
        ball_a_(proof.a, Ball(time)),
        ball_b_(proof.b, Ball(time)) {}

  /// True if an edge of one goes through the other, or ends in it.
  bool one_pierces_the_other() const {
    return pierces(core_a_, ball_a_, core_b_, ball_b_, N(-1) * between_, Ball(-1) * way_) ||
           pierces(core_b_, ball_b_, core_a_, ball_a_, between_, way_);
  }

  /// True if points of the cores are as near as the radii and `gap` [length]. They are found from `wanted` on, [length] from A's center,
  /// by projecting on one core and the other in turn, which makes the way between two points no longer each time.
  bool has_near_points(Triple<N> wanted, double gap) const {
    const Ball reach = proof_.a.radius + proof_.b.radius + Ball(gap);
    const N enough = pair_.a.radius + pair_.b.radius + N(gap);
    constexpr int rounds =
        std::is_same_v<N, double> ? 1 << 17 : 24;  // a needle aslant in a sliver nears it by a thousandth each
    for (int round = 1; round <= rounds; ++round) {
      const std::vector<N> x = shares(pair_.a, core_a_.arms, wanted, N(1));
      const auto near = point(pair_.a, core_a_.arms, x);
      if (!near) return false;
      const std::vector<N> y = shares(pair_.b, core_b_.arms, *near - between_, N(1));
      wanted = between_ + *point(pair_.b, core_b_.arms, y);
      const Triple<N> rest = wanted - *near;
      if (round != rounds && round > 2 && dot(rest, rest) > enough * enough) continue;
      const auto in_a = point(proof_.a, ball_a_.arms, x), in_b = point(proof_.b, ball_b_.arms, y);
      if (!in_a || !in_b) return false;
      const Triple<Ball> way = way_ + *in_b - *in_a;
      if ((reach * reach - dot(way, way)).is_not_negative()) return true;
    }
    return false;
  }

  /// The same of the points where two edges are nearest: projections are slow on what is aslant, and no good on a sliver.
  bool has_near_edges(double gap) const {
    const Ball reach = proof_.a.radius + proof_.b.radius + Ball(gap);
    const std::vector<Edge<N>> of_a = core_a_.edges(), of_b = core_b_.edges();
    const std::vector<Edge<Ball>> balls_a = ball_a_.edges(), balls_b = ball_b_.edges();
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      for (std::size_t k = 0; k < of_b.size(); ++k) {
        const auto [s, t] = nearest_shares(of_a[i], Edge<N>{between_ + of_b[k].middle, of_b[k].half});
        const Triple<Ball> way =
            way_ + (balls_b[k].middle + Ball(t) * balls_b[k].half) - (balls_a[i].middle + Ball(s) * balls_a[i].half);
        if ((reach * reach - dot(way, way)).is_not_negative()) return true;
      }
    }
    return false;
  }

  /// True of two boxes if a point of one lies inside the other: found by projecting on both, shrunk. Faces in one plane need it.
  bool has_shared_point(const Triple<N>& from) const {
    if (!solid(core_a_) || !solid(core_b_)) return false;
    for (N less = ldexp(N(1), -2); less > ldexp(N(1), -130); less = ldexp(less, -12)) {
      Triple<N> wanted = from;
      for (int round = 0; round < 8; ++round) {
        const std::vector<N> x = shares(pair_.a, core_a_.arms, wanted, N(1 - less));
        const auto in_a = point(proof_.a, ball_a_.arms, x);
        if (in_a && holds(ball_b_, *in_a - way_)) return true;
        const Triple<N> near = *point(pair_.a, core_a_.arms, x) - between_;
        wanted = between_ + *point(pair_.b, core_b_.arms, shares(pair_.b, core_b_.arms, near, N(1 - less)));
      }
    }
    return false;
  }

 private:
  template <class M> static bool solid(const Core<M>& core) { return !core.corners && core.arms.size() == 3; }
  template <class M> static bool flat(const Core<M>& core) { return core.corners || core.arms.size() == 2; }

  /// `offset` [length] from the center of what may be pierced to the other's.
  static bool pierces(const Core<N>& core, const Core<Ball>& ball, const Core<N>& other, const Core<Ball>& other_ball,
                      const Triple<N>& offset, const Triple<Ball>& ball_offset) {
    if (!solid(other) && !flat(other)) return false;
    const std::vector<Edge<N>> edges = core.edges();
    const std::vector<Edge<Ball>> balls = ball.edges();
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Edge<Ball> edge = {ball_offset + balls[k].middle, balls[k].half};
      if (flat(other)) {
        if (goes_through(edge, other_ball)) return true;
        continue;
      }
      const std::optional<N> t = middle_within(Edge<N>{offset + edges[k].middle, edges[k].half}, other);
      if (t && holds(other_ball, edge.middle + Ball(*t) * edge.half)) return true;
    }
    return false;
  }

  const Spinners<N>& pair_;
  const Spinners<Ball>& proof_;
  Triple<N> between_;  ///< from A's center to B's
  Triple<Ball> way_;   ///< the same
  Core<N> core_a_, core_b_;
  Core<Ball> ball_a_, ball_b_;
};

}  // namespace thinwall::oracle
