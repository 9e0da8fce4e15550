#pragma once
/// The oracle of what turns: proves in ball arithmetic that two shapes stay apart for a while, and that they touch at a time.
///
/// Apart: somebody names a plane, and a ball proves it. The plane stands still, turns with one of the two, or stays square to an edge of
/// each; who names it, and how badly, cannot make a wrong answer. The gap across it over an interval is its value and its slope at one
/// time within, and its second derivative at all of them at once (the mean value form); every absolute value in it is taken with both signs, unless
/// a ball proves one. Intervals are as long as can be proven.
///
/// Together: a point of each core, named by somebody, whose distance a ball bounds; or one point that a ball finds in both boxes.
///
/// Shares no code with the time of impact it judges: no bound of curvature, no margin, no first root. It asks the separation at one instant
/// for hints.

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include <thinwall/discrete/queries.hpp>

#include "support/spinner.hpp"

namespace thinwall::oracle {

/// A function of time at one time, and its first two derivatives.
template <class N> struct Jet {
  N value = N(0), slope = N(0), bend = N(0);

  Jet& operator+=(const Jet& other) {
    value += other.value;
    slope += other.slope;
    bend += other.bend;
    return *this;
  }
  Jet& operator-=(const Jet& other) {
    value -= other.value;
    slope -= other.slope;
    bend -= other.bend;
    return *this;
  }
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
      if (body.corners && side < 0) along = {-along.value, -along.slope, -along.bend};
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
    const Jet<Ball> opposite = {-term.value, -term.slope, -term.bend};
    const bool up = proves_positive(term, low_, high_), down = !up && proves_positive(opposite, low_, high_);
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

template <class N> Vec3<N> eigen(const Triple<N>& v) { return {v[0], v[1], v[2]}; }

template <class N> Sphere<N> posed(const Spinner<N>& body, const Sphere<double>&, const N& time) {
  return {eigen(body.center_at(time)), body.radius};
}
template <class N> Capsule<N> posed(const Spinner<N>& body, const Capsule<double>&, const N& time) {
  const Triple<N> center = body.center_at(time), half = body.place(body.arms[0], body.phase(time));
  return {eigen(center - half), eigen(center + half), body.radius};
}
template <class N> Obb<N> posed(const Spinner<N>& body, const Obb<double>& box, const N& time) {
  Obb<N> made{eigen(body.center_at(time)), box.half_extents.template cast<N>(), Mat3<N>::Identity()};
  const Phase<N> now = body.phase(time);
  for (int k = 0; k < 3; ++k) made.axes.col(k) = eigen(body.place(body.frame[static_cast<std::size_t>(k)], now));
  return made;
}
template <class N> Triangle<N> posed(const Spinner<N>& body, const Triangle<double>&, const N& time) {
  const Triple<N> center = body.center_at(time);
  const Phase<N> now = body.phase(time);
  const auto corner = [&](std::size_t k) { return eigen(Triple<N>(center + body.place(body.arms[k], now))); };
  return {corner(0), corner(1), corner(2)};
}

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

/// A time at 50 digits: every double is one.
using Time = ::thinwall::testing::Wide;

/// How sure. `undecided` is a graze, or too much for the patience of the oracle.
enum class TurningVerdict { apart, hit, overlapping, undecided };

struct FirstContact {
  TurningVerdict verdict = TurningVerdict::undecided;
  Time lower = 0, upper = 1;  ///< [1] nothing touches before `lower`; of a hit, they touch at `upper`
};

template <class A, class B> class TurningOracle {
 public:
  TurningOracle(const Turning<A>& a, const Turning<B>& b) : a_(a), b_(b), quick_(a, b) {
    const BallPrecision bits(quick_bits);
    proof_.emplace(a, b);
  }

  int intervals = 0;      ///< proven so far
  int patience = 20'000;  ///< of them at most

  /// Until when, `end` at most, they are proven to stay more than `slack` [length] apart, from the start on; 0 if not even at the start.
  Time free_until(const Time& end, double slack = 0) {
    Time time = 0;
    {
      const BallPrecision bits(quick_bits);
      time = march<double>(quick_, *proof_, time, end, slack);
    }
    if (time >= end) return time;
    const BallPrecision bits(fine_bits);
    make_fine();
    return march<Time>(*fine_, *fine_proof_, time, end, slack);
  }

  /// True if at `time` they come within `gap` [length] >= 0 of each other: a proof.
  bool within(const Time& time, double gap) {
    const auto rounded = static_cast<double>(time);
    if (Time(rounded) == time) {
      const BallPrecision bits(quick_bits);
      if (has_near_points(quick_, *proof_, rounded, gap)) return true;
    }
    const BallPrecision bits(fine_bits);
    make_fine();
    return has_near_points(*fine_, *fine_proof_, time, gap) || has_shared_point(time);
  }

  /// The verdict, and when they first touch, to 10^-digits of the step.
  FirstContact first_contact(int digits = 30) {
    using std::pow;
    FirstContact found;
    if (within(0, 0)) {
      found.verdict = TurningVerdict::overlapping;
      found.upper = 0;
      return found;
    }
    found.lower = free_until(1);
    if (found.lower >= 1) {
      found.verdict = TurningVerdict::apart;
      return found;
    }
    const Time widest = pow(Time(10), -digits);
    for (Time ahead = ldexp(Time(1), -125); ahead <= widest && found.lower < 1; ahead *= 4) {
      const Time upper = std::min(Time(1), Time(found.lower + ahead));
      if (!within(upper, 0)) continue;
      found.verdict = TurningVerdict::hit;
      found.upper = upper;
      return found;
    }
    return found;
  }

 private:
  static constexpr slong quick_bits = 72, fine_bits = 230;

  void make_fine() {
    if (fine_) return;
    fine_.emplace(a_, b_);
    fine_proof_.emplace(a_, b_);
  }

  /// Proves interval after interval until nothing more can be proven with hints of these numbers.
  template <class N>
  Time march(const Spinners<N>& pair, const Spinners<Ball>& proof, const Time& start, const Time& stop, double slack) {
    const Ball slack_ball(slack);
    N time = static_cast<N>(start);
    N end = static_cast<N>(stop);
    if (Time(end) > stop) end -= std::numeric_limits<N>::epsilon();
    const N least = std::numeric_limits<N>::epsilon() * (std::is_same_v<N, double> ? 4 : N(1e8));
    while (time < end && intervals < patience) {
      const Separation<N> closest = separation(posed(pair.a, a_.shape, time), posed(pair.b, b_.shape, time));
      std::vector<PlaneHint<N>> hints = hints_of(pair, closest, time);
      if (pair.a.angle + pair.b.angle > N(2)) {
        const Triple<N> normal = {closest.normal[0], closest.normal[1], closest.normal[2]};
        hints.push_back({Kind<N>::orbits, across_orbits(pair, normal, time)});
      }
      for (PlaneHint<N>& hint : hints) hint.until = promise(pair, hint, time, end, N(slack));
      N gained = 0;
      for (;;) {
        PlaneHint<N>& best = *std::max_element(
            hints.begin(), hints.end(), [](const PlaneHint<N>& x, const PlaneHint<N>& y) { return x.until < y.until; });
        if (best.until < least && best.until < end - time) break;
        const N next = best.until >= end - time ? end : N(time + best.until);
        if (next > time && parts(proof, best, time, next, slack_ball)) {
          gained = next - time;
          time = next;
          if (best.kind != Kind<N>::orbits) last_ = as_triple<Time>(plane_at(pair, best, time).place);
          ++intervals;
          break;
        }
        best.until = N(best.until * N(0.5));
      }
      if (!(gained > N(0))) break;
    }
    return Time(time);
  }

  /// Of the closest points, and of the last plane: touching boxes have any closest points.
  template <class N>
  std::vector<PlaneHint<N>> hints_of(const Spinners<N>& pair, const Separation<N>& closest, const N& time) const {
    const Triple<N> normal = {closest.normal[0], closest.normal[1], closest.normal[2]};
    std::vector<PlaneHint<N>> hints = plane_hints(pair, normal, time);
    if (!std::is_same_v<N, Time> || !last_) return hints;
    const std::vector<PlaneHint<N>> more = plane_hints(pair, as_triple<N>(*last_), time);
    hints.insert(hints.end(), more.begin(), more.end());
    return hints;
  }

  /// The core's point nearest to `wanted`, [length] from its center, as shares of its arms, of which none is more than `most`. A box's arms are at
  /// right angles but for rounding, which a few sweeps mend.
  template <class N>
  static std::vector<N> shares(const Spinner<N>& body, const std::vector<Triple<N>>& arms, const Triple<N>& wanted,
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
  template <class N>
  static std::vector<N> shares_of_triangle(const std::vector<Triple<N>>& arms, const Triple<N>& wanted) {
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
  template <class N> static std::vector<Triple<N>> arms_at(const Spinner<N>& body, const N& time) {
    const Phase<N> now = body.phase(time);
    std::vector<Triple<N>> arms;
    for (const Arm<N>& arm : body.arms) arms.push_back(body.place(arm, now));
    return arms;
  }
  /// The point that has these shares, [length] from the body's center; nothing if they are no point's of the core.
  template <class M, class N>
  static std::optional<Triple<M>> point(const Spinner<M>& body, const std::vector<Triple<M>>& arms,
                                        const std::vector<N>& x) {
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

  /// Projects on one core and the other in turn, which makes the way between two points no longer each time.
  template <class N>
  bool has_near_points(const Spinners<N>& pair, const Spinners<Ball>& proof, const N& time, double gap) {
    const Separation<N> closest = separation(posed(pair.a, a_.shape, time), posed(pair.b, b_.shape, time));
    const Triple<N> between = pair.b.center_at(time) - pair.a.center_at(time), center = pair.a.center_at(time);
    const std::vector<Triple<N>> arms_a = arms_at(pair.a, time), arms_b = arms_at(pair.b, time);
    const Ball at(time), reach = proof.a.radius + proof.b.radius + Ball(gap);
    const std::vector<Triple<Ball>> balls_a = arms_at(proof.a, at), balls_b = arms_at(proof.b, at);
    Triple<N> wanted = Triple<N>{closest.point_b[0], closest.point_b[1], closest.point_b[2]} - center;
    const N enough = pair.a.radius + pair.b.radius + N(gap);
    constexpr int rounds =
        std::is_same_v<N, double> ? 1 << 17 : 24;  // a needle aslant in a sliver nears it by a thousandth each
    for (int round = 1; round <= rounds; ++round) {
      const std::vector<N> x = shares(pair.a, arms_a, wanted, N(1));
      const auto near = point(pair.a, arms_a, x);
      if (!near) return false;
      const std::vector<N> y = shares(pair.b, arms_b, *near - between, N(1));
      wanted = between + *point(pair.b, arms_b, y);
      const Triple<N> rest = wanted - *near;
      if (round != rounds && round > 2 && dot(rest, rest) > enough * enough) continue;
      const auto in_a = point(proof.a, balls_a, x), in_b = point(proof.b, balls_b, y);
      if (!in_a || !in_b) return false;
      const Triple<Ball> way = proof.between + at * proof.path + *in_b - *in_a;
      if ((reach * reach - dot(way, way)).is_not_negative()) return true;
    }
    return false;
  }

  /// For two boxes: a point of A that solves to shares of B's arms below 1, or the other way round. It is a corner's, or where two edges
  /// cross, and drawn inside by a guess of how deep that is; or found by projecting on both boxes, shrunk.
  bool has_shared_point(const Time& time) {
    const Spinners<Time>& pair = *fine_;
    if (pair.a.arms.size() != 3 || pair.b.arms.size() != 3 || pair.a.corners || pair.b.corners) return false;
    const Separation<Time> deepest = separation(posed(pair.a, a_.shape, time), posed(pair.b, b_.shape, time));
    const Triple<Time> center = pair.a.center_at(time), between = pair.b.center_at(time) - center;
    const std::vector<Triple<Time>> arms_a = arms_at(pair.a, time), arms_b = arms_at(pair.b, time);
    const Ball at(time);
    const std::vector<Triple<Ball>> balls_a = arms_at(fine_proof_->a, at), balls_b = arms_at(fine_proof_->b, at);
    const Triple<Ball> way = fine_proof_->between + at * fine_proof_->path;
    const auto of_a_in_b = [&](const std::vector<Time>& x) {
      const auto in_a = point(fine_proof_->a, balls_a, x);
      return in_a && solves(balls_b, *in_a - way);
    };
    const auto of_b_in_a = [&](const std::vector<Time>& x) {
      const auto in_b = point(fine_proof_->b, balls_b, x);
      return in_b && solves(balls_a, *in_b + way);
    };
    std::vector<PlaneHint<Time>> hints = hints_of(pair, deepest, time);
    for (PlaneHint<Time>& hint : hints) {
      const GapJets<Time> gap = gap_jets(pair, hint, time, Time(0));
      const Arc<Time> n = plane_at(pair, hint, time);
      hint.until = active(gap).value / sqrt(dot(n.place, n.place));
    }
    std::sort(hints.begin(), hints.end(), [](const auto& x, const auto& y) { return x.until > y.until; });
    hints.resize(std::min(hints.size(), std::size_t{6}));
    for (const PlaneHint<Time>& hint : hints) {
      const Triple<Time> n = plane_at(pair, hint, time).place;
      std::vector<Time> x = extreme_shares(arms_a, n, 1), y = extreme_shares(arms_b, n, -1);
      if (hint.kind == Kind<Time>::edges) {
        cross_edges(arms_a, arms_b, between, x, y, static_cast<std::size_t>(hint.first),
                    static_cast<std::size_t>(hint.second));
      }
      for (Time less = ldexp(Time(1), -2); less > ldexp(Time(1), -140); less = ldexp(less, -6)) {
        std::vector<Time> in_a = x, in_b = y;
        for (std::vector<Time>* both : {&in_a, &in_b}) {
          for (Time& share : *both) share *= Time(1) - less;
        }
        if (of_a_in_b(in_a) || of_b_in_a(in_b)) return true;
      }
    }
    const Vec3<Time> middle = (deepest.point_a + deepest.point_b) / 2;
    for (Time less = ldexp(Time(1), -2); less > ldexp(Time(1), -130); less = ldexp(less, -12)) {
      Triple<Time> wanted = Triple<Time>{middle[0], middle[1], middle[2]} - center;
      for (int round = 0; round < 8; ++round) {
        const std::vector<Time> x = shares(pair.a, arms_a, wanted, Time(1 - less));
        if (of_a_in_b(x)) return true;
        const Triple<Time> near = *point(pair.a, arms_a, x) - between;
        wanted = between + *point(pair.b, arms_b, shares(pair.b, arms_b, near, Time(1 - less)));
      }
    }
    return false;
  }
  /// The corner that is farthest along n, or against it.
  static std::vector<Time> extreme_shares(const std::vector<Triple<Time>>& arms, const Triple<Time>& n, int side) {
    std::vector<Time> made;
    for (const Triple<Time>& arm : arms) made.push_back(Time(side * dot(arm, n) < 0 ? -1 : 1));
    return made;
  }
  /// Where two edges pass nearest to each other.
  static void cross_edges(const std::vector<Triple<Time>>& arms_a, const std::vector<Triple<Time>>& arms_b,
                          const Triple<Time>& between, std::vector<Time>& x, std::vector<Time>& y, std::size_t i,
                          std::size_t j) {
    x[i] = 0;
    y[j] = 0;
    Triple<Time> way = between;
    for (std::size_t k = 0; k < 3; ++k) way = way + y[k] * arms_b[k] - x[k] * arms_a[k];
    const Triple<Time>&p = arms_a[i], &q = arms_b[j];  // the way between the lines is way + s q - r p
    const Time pp = dot(p, p), pq = dot(p, q), qq = dot(q, q), det = pp * qq - pq * pq;
    if (!(det > 0)) return;
    x[i] = (qq * dot(way, p) - pq * dot(way, q)) / det;
    y[j] = (pq * dot(way, p) - pp * dot(way, q)) / det;
  }
  static bool solves(const std::vector<Triple<Ball>>& arms, const Triple<Ball>& from) {
    const Triple<Ball>&x = arms[0], &y = arms[1], &z = arms[2];
    const Ball volume = abs(dot(x, cross(y, z)));
    const auto inside = [&](const Triple<Ball>& face) { return certainly_less(abs(dot(from, face)), volume); };
    return inside(cross(y, z)) && inside(cross(z, x)) && inside(cross(x, y));
  }

  Turning<A> a_;
  Turning<B> b_;
  Spinners<double> quick_;
  std::optional<Spinners<Ball>> proof_;
  std::optional<Spinners<Time>> fine_;
  std::optional<Spinners<Ball>> fine_proof_;
  std::optional<Triple<Time>> last_;  ///< normal of the last plane that proved something
};

}  // namespace thinwall::oracle
