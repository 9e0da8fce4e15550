#pragma once
/// Proofs that two shapes that turn stay apart for a while.
///
/// Somebody names a plane, and a ball proves it. The plane stands still, turns with one of the two, or stays square to an edge of
/// each; who names it, and how badly, cannot make a wrong answer. The gap across it over an interval is its value and its slope at one
/// time within, and its second derivative at all of them at once (the mean value form); every absolute value in it is taken with both
/// signs, unless a ball proves one. Intervals are as long as can be proven.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "support/spinner.hpp"

namespace thinwall::oracle {

/// A function of time at one time, and its first two derivatives.
template <class N> struct Jet {
  N value = N(0), slope = N(0), bend = N(0);

  Jet operator-() const { return {-value, -slope, -bend}; }
  Jet& operator+=(const Jet& other) {
    value += other.value;
    slope += other.slope;
    bend += other.bend;
    return *this;
  }
  Jet& operator-=(const Jet& other) { return *this += -other; }
};

template <class N> Jet<N> product(const Arc<N>& p, const Arc<N>& q) {
  return {dot(p.place, q.place), N(dot(p.speed, q.place) + dot(p.place, q.speed)),
          N(dot(p.pull, q.place) + N(2) * dot(p.speed, q.speed) + dot(p.place, q.pull))};
}

/// Where a plane comes from. Whoever fills this in needs no trust.
template <class N> struct PlaneHint {
  enum class Kind { world, with_a, with_b, edges, orbits } kind = Kind::world;
  Triple<N> normal{};           ///< in the frame, at the start, of what it turns with; may have any length
  int first = -1, second = -1;  ///< edges it is square to, of the body it turns with; or one of A and one of B
  bool flipped = false;         ///< the product of the two points from B to A
  N until = N(0);               ///< [1] how long it may part them
};
template <class N> using Kind = typename PlaneHint<N>::Kind;

/// The gap across a plane: apart - sum |either| - max corners_a - max corners_b.
template <class N> struct GapJets {
  Jet<N> apart;
  std::vector<Jet<N>> either, corners_a, corners_b;
};

template <class N, class M> Triple<N> plane_normal(const Spinner<N>& body, const PlaneHint<M>& hint) {
  const Triple<N> normal = as_triple<N>(hint.normal);
  if (hint.first < 0) return normal;
  const Triple<N>& first = body.edges[static_cast<std::size_t>(hint.first)].start;
  if (hint.second < 0) return normal - N(dot(normal, first) / dot(first, first)) * first;
  const Triple<N>& second = body.edges[static_cast<std::size_t>(hint.second)].start;
  return hint.flipped ? cross(second, first) : cross(first, second);
}

/// How far a core that stands still reaches along n from its center; `side` -1 is the other way.
template <class N> N core_support(const Spinner<N>& body, const Triple<N>& n, int side) {
  using std::abs, std::max;
  N sum = N(0);
  for (std::size_t k = 0; k < body.arms.size(); ++k) {
    const N along = N(side) * dot(n, body.arms[k].start);
    if (body.corners) {
      sum = k == 0 ? along : N(max(sum, along));
    } else {
      sum += N(abs(along));
    }
  }
  return sum;
}

/// The plane's normal, of any length.
template <class N, class M> Arc<N> plane_at(const Spinners<N>& pair, const PlaneHint<M>& hint, const N& time) {
  const Spinner<N>&a = pair.a, &b = pair.b;
  const Triple<N> zero = {N(0), N(0), N(0)};
  switch (hint.kind) {
    case Kind<M>::with_a: return a.arc(a.arm(plane_normal(a, hint)), a.phase(time));
    case Kind<M>::with_b: return b.arc(b.arm(plane_normal(b, hint)), b.phase(time));
    case Kind<M>::edges: {
      const auto first = static_cast<std::size_t>(hint.first), second = static_cast<std::size_t>(hint.second);
      Arc<N> p = a.arc(a.edges[first], a.phase(time)), q = b.arc(b.edges[second], b.phase(time));
      if (hint.flipped) std::swap(p, q);
      return {cross(p.place, q.place), cross(p.speed, q.place) + cross(p.place, q.speed),
              cross(p.pull, q.place) + N(2) * cross(p.speed, q.speed) + cross(p.place, q.pull)};
    }
    default: return {as_triple<N>(hint.normal), zero, zero};
  }
}

/// The gap across the plane in the neighborhood of a time; with a ball of times, of each of them.
template <class N, class M>
GapJets<N> gap_jets(const Spinners<N>& pair, const PlaneHint<M>& hint, const N& time, const N& slack) {
  using std::sqrt;
  const Spinner<N>&a = pair.a, &b = pair.b;
  const Phase<N> of_a = a.phase(time), of_b = b.phase(time);
  const Triple<N> zero = {N(0), N(0), N(0)};
  const N radius = a.radius + b.radius + slack;
  const bool with_a = hint.kind == Kind<M>::with_a, with_b = hint.kind == Kind<M>::with_b;
  const bool edges = hint.kind == Kind<M>::edges;
  GapJets<N> gap;
  const Arc<N> n = plane_at(pair, hint, time);
  if (edges) {
    const N length = sqrt(dot(n.place, n.place)), rate = dot(n.place, n.speed) / length;
    const N bend = N(dot(n.speed, n.speed) + dot(n.place, n.pull) - rate * rate) / length;
    gap.apart -= {N(radius * length), N(radius * rate), N(radius * bend)};
  } else {
    const Triple<N> normal = with_b ? plane_normal(b, hint) : plane_normal(a, hint);
    N reach = radius * N(sqrt(dot(normal, normal)));
    if (with_a) reach += core_support(a, normal, 1);
    if (with_b) reach += core_support(b, normal, -1);
    gap.apart.value -= reach;
  }
  gap.apart += product(n, {pair.between + time * pair.path, pair.path, zero});
  const auto take = [&](const Spinner<N>& body, const Phase<N>& now, int edge, int side, std::vector<Jet<N>>& corners) {
    for (std::size_t k = 0; k < body.arms.size(); ++k) {
      if (edges && !body.corners && static_cast<int>(k) == edge) continue;  // square to it
      Jet<N> along = product(n, body.arc(body.arms[k], now));
      if (body.corners && side < 0) along = -along;
      (body.corners ? corners : gap.either).push_back(std::move(along));
    }
  };
  if (!with_a) take(a, of_a, hint.first, 1, gap.corners_a);
  if (!with_b) take(b, of_b, hint.second, -1, gap.corners_b);
  return gap;
}

/// The gap across a plane that stands still, between whole orbits of what turns.
template <class N> N gap_of_orbits(const Spinners<N>& pair, const Triple<N>& n, const N& time, const N& slack) {
  using std::sqrt, std::abs, std::max;
  N gap = dot(n, pair.between + time * pair.path) - N(pair.a.radius + pair.b.radius + slack) * N(sqrt(dot(n, n)));
  for (const Spinner<N>* body : {&pair.a, &pair.b}) {
    if (!body->turns) {
      gap -= core_support(*body, n, body == &pair.a ? 1 : -1);
      continue;
    }
    const Triple<N> off = cross(body->axis, n);
    const N on_axis = N(abs(dot(body->axis, n))), off_axis = N(sqrt(dot(off, off)));
    const auto orbit = [&](const Triple<N>& v) {
      const Triple<N> aside = cross(body->axis, v);
      return N(on_axis * N(abs(dot(body->axis, v))) + off_axis * N(sqrt(dot(aside, aside))));
    };
    N reach = N(0);
    const std::size_t count = body->arms.size(), signs = body->corners ? count : std::size_t{1} << count;
    for (std::size_t s = 0; s < signs; ++s) {
      Triple<N> point = {N(0), N(0), N(0)};
      for (std::size_t k = 0; k < count; ++k) {
        if (body->corners && k != s) continue;
        const Triple<N>& v = body->arms[k].start;
        point = body->corners || (s >> k & 1) == 0 ? point + v : point - v;
      }
      reach = N(max(reach, orbit(point)));
    }
    gap -= reach;
  }
  return gap;
}

/// True if the jet is positive from `low` to `high` around its time; its second derivative holds all over.
inline bool proves_positive(const Jet<Ball>& jet, const Ball& low, const Ball& high) {
  const Ball bend = min(jet.bend, Ball(0)) * Ball(0.5);
  const auto at = [&](const Ball& x) { return (jet.value + x * (jet.slope + bend * x)).is_positive(); };
  return at(low) && at(high);
}

/// The same of a gap: whatever its signs and corners, unless a ball proves them.
class GapProof {
 public:
  GapProof(const GapJets<Ball>& gap, const Ball& low, const Ball& high) : gap_(gap), low_(low), high_(high) {}
  bool positive() const { return from(gap_.apart, 0); }

 private:
  bool from(Jet<Ball> jet, std::size_t k) const {
    if (k == gap_.either.size()) return past_corners(jet, gap_.corners_a, &gap_.corners_b);
    const Jet<Ball>& term = gap_.either[k];
    const bool up = proves_positive(term, low_, high_), down = !up && proves_positive(-term, low_, high_);
    if (!up) {
      Jet<Ball> other = jet;
      other += term;
      if (!from(std::move(other), k + 1)) return false;
    }
    if (down) return true;
    jet -= term;
    return from(std::move(jet), k + 1);
  }
  bool past_corners(const Jet<Ball>& jet, const std::vector<Jet<Ball>>& corners,
                    const std::vector<Jet<Ball>>* next) const {
    if (corners.empty()) return next == nullptr ? proves_positive(jet, low_, high_) : past_corners(jet, *next, nullptr);
    return std::all_of(corners.begin(), corners.end(), [&](const Jet<Ball>& corner) {
      Jet<Ball> other = jet;
      other -= corner;
      return next == nullptr ? proves_positive(other, low_, high_) : past_corners(other, *next, nullptr);
    });
  }

  const GapJets<Ball>& gap_;
  const Ball &low_, &high_;
};

/// True if the plane parts the shapes by more than `slack` from `start` to `end`: a proof.
template <class N>
bool parts(const Spinners<Ball>& pair, const PlaneHint<N>& hint, const N& start, const N& end, const Ball& slack) {
  const Ball first(start), last(end);
  if (hint.kind == Kind<N>::orbits) {
    const Triple<Ball> n = as_triple<Ball>(hint.normal);  // what is linear between is positive if both ends are
    return gap_of_orbits(pair, n, first, slack).is_positive() && gap_of_orbits(pair, n, last, slack).is_positive();
  }
  const Ball middle(N(start + (end - start) / 2));
  GapJets<Ball> gap = gap_jets(pair, hint, middle, slack);
  const GapJets<Ball> all = gap_jets(pair, hint, Ball::hull(first, last), slack);
  const auto bend = [](std::vector<Jet<Ball>>& at, const std::vector<Jet<Ball>>& of) {
    for (std::size_t k = 0; k < at.size(); ++k) at[k].bend = of[k].bend;
  };
  gap.apart.bend = all.apart.bend;
  bend(gap.either, all.either);
  bend(gap.corners_a, all.corners_a);
  bend(gap.corners_b, all.corners_b);
  return GapProof(gap, first - middle, last - middle).positive();
}
// ---- Who names planes and points: the separation at one instant. None of this needs trust.

/// The gap in plain numbers.
template <class N> Jet<N> active(const GapJets<N>& gap) {
  Jet<N> sum = gap.apart;
  for (const Jet<N>& term : gap.either) {
    if (term.value < N(0)) {
      sum += term;
    } else {
      sum -= term;
    }
  }
  for (const std::vector<Jet<N>>* corners : {&gap.corners_a, &gap.corners_b}) {
    if (corners->empty()) continue;
    sum -= *std::max_element(corners->begin(), corners->end(),
                             [](const Jet<N>& x, const Jet<N>& y) { return x.value < y.value; });
  }
  return sum;
}

/// Planes that may part the two at a time when their closest points have this normal.
template <class N>
std::vector<PlaneHint<N>> plane_hints(const Spinners<N>& pair, const Triple<N>& normal, const N& time) {
  using std::sqrt;
  std::vector<PlaneHint<N>> hints = {{Kind<N>::world, normal}};
  const Phase<N> of_a = pair.a.phase(time), of_b = pair.b.phase(time);
  const auto cosine = [&](const Triple<N>& v, const Triple<N>& n) {
    return N(dot(v, n) / sqrt(N(dot(v, v) * dot(n, n))));
  };
  const N aligned = N(0.9), square = N(0.3);
  for (const bool with_a : {true, false}) {
    const Spinner<N>& body = with_a ? pair.a : pair.b;
    const Triple<N> seen = body.seen(normal, with_a ? of_a : of_b);
    const Kind<N> kind = with_a ? Kind<N>::with_a : Kind<N>::with_b;
    const int count = static_cast<int>(body.edges.size());
    for (int i = 0; i < count; ++i) {
      const Triple<N>& first = body.edges[static_cast<std::size_t>(i)].start;
      const N along = cosine(first, seen);
      if (along * along < square * square) hints.push_back({kind, seen, i});
      for (int j = i + 1; j < count; ++j) {
        const N facing = cosine(cross(first, body.edges[static_cast<std::size_t>(j)].start), seen);
        if (facing * facing > aligned * aligned) hints.push_back({kind, seen, i, j, facing < N(0)});
      }
    }
  }
  for (int i = 0; i < static_cast<int>(pair.a.edges.size()); ++i) {
    const Triple<N> first = pair.a.place(pair.a.edges[static_cast<std::size_t>(i)], of_a);
    for (int j = 0; j < static_cast<int>(pair.b.edges.size()); ++j) {
      const Triple<N> second = pair.b.place(pair.b.edges[static_cast<std::size_t>(j)], of_b);
      const N facing = cosine(cross(first, second), normal);
      if (facing * facing > aligned * aligned) hints.push_back({Kind<N>::edges, normal, i, j, facing < N(0)});
    }
  }
  return hints;
}

/// The unit normal, from this one on, across which whole orbits are farthest apart: uphill in ever smaller steps.
template <class N> Triple<N> across_orbits(const Spinners<N>& pair, const Triple<N>& from, const N& time) {
  using std::sqrt;
  const auto unit = [](const Triple<N>& v) { return N(N(1) / N(sqrt(dot(v, v)))) * v; };
  const auto gap = [&](const Triple<N>& n) { return gap_of_orbits(pair, n, time, N(0)); };
  Triple<N> best = from;
  N most = gap(best);
  const Triple<N> way = pair.between + time * pair.path;
  if (dot(way, way) > N(0)) {
    const N between = gap(unit(way));
    if (between > most) {
      most = between;
      best = unit(way);
    }
  }
  for (N step = N(0.5); step > N(1e-3);) {
    bool better = false;
    for (int k = 0; k < 6; ++k) {
      Triple<N> other = best;
      other[static_cast<std::size_t>(k / 2)] += k % 2 == 0 ? step : N(-step);
      if (!(dot(other, other) > N(0))) continue;
      other = unit(other);
      const N there = gap(other);
      if (!(there > most)) continue;
      most = there;
      best = other;
      better = true;
    }
    if (!better) step = N(step / N(2));
  }
  return best;
}

/// For how long the plane may part them, from `time` on, `end` at most.
template <class N>
N promise(const Spinners<N>& pair, const PlaneHint<N>& hint, const N& time, const N& end, const N& slack) {
  using std::sqrt, std::abs, std::min, std::max;
  const N left = end - time;
  if (hint.kind == Kind<N>::orbits) {
    const N now = gap_of_orbits(pair, hint.normal, time, slack), then = gap_of_orbits(pair, hint.normal, end, slack);
    if (!(now > N(0))) return N(0);
    return then > N(0) ? left : N(left * now / (now - then) * N(0.999));
  }
  const GapJets<N> gap = gap_jets(pair, hint, time, slack);
  const Jet<N> now = active(gap);
  if (!(now.value > N(0))) return N(0);
  N bend = abs(gap.apart.bend);
  for (const auto* terms : {&gap.either, &gap.corners_a, &gap.corners_b}) {
    for (const Jet<N>& term : *terms) bend += N(abs(term.bend));
  }
  const N root = sqrt(N(now.slope * now.slope + N(2) * bend * now.value));
  N ahead = left;
  if (root > now.slope) ahead = min(ahead, N(N(2) * now.value / (root - now.slope)));
  const N fastest = max(pair.a.angle, pair.b.angle);
  if (fastest * ahead > N(1)) ahead = N(N(1) / fastest);
  for (int k = 0; k < 40; ++k) {  // in small steps, then in large ones: a corner may turn at once
    if (active(gap_jets(pair, hint, N(time + ahead), slack)).value > N(0)) return ahead;
    ahead = N(ahead * (k < 12 ? N(0.7) : N(0.2)));
  }
  return N(0);
}

}  // namespace thinwall::oracle
