#pragma once
/// The oracle of what turns: proves in ball arithmetic that two shapes stay apart for a while (turning_planes.hpp), and that they touch
/// at a time (turning_contact.hpp).
///
/// Shares no code with the time of impact it judges: no bound of curvature, no margin, no first root. It asks the separation at one instant
/// for hints.

#include <algorithm>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include <thinwall/discrete/queries.hpp>

#include "support/turning_contact.hpp"
#include "support/turning_planes.hpp"

namespace thinwall::oracle {

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
      if (touch(quick_, *proof_, rounded, gap)) return true;
    }
    const BallPrecision bits(fine_bits);
    make_fine();
    return touch(*fine_, *fine_proof_, time, gap);
  }

  /// The verdict, and when they first touch, to 10^-digits of the step.
  FirstContact first_contact(int digits = 30) {
    using std::pow;
    if (within(0, 0)) return {TurningVerdict::overlapping, 0, 0};
    const Time lower = free_until(1);
    if (lower >= 1) return {TurningVerdict::apart, lower, 1};
    const Time widest = pow(Time(10), -digits);
    for (Time ahead = ldexp(Time(1), -125); ahead <= widest; ahead *= 4) {
      const Time upper = std::min(Time(1), Time(lower + ahead));
      if (within(upper, 0)) return {TurningVerdict::hit, lower, upper};
    }
    return {TurningVerdict::undecided, lower, 1};
  }

 private:
  static constexpr slong quick_bits = 72, fine_bits = 230;

  void make_fine() {
    if (fine_) return;
    fine_.emplace(a_, b_);
    fine_proof_.emplace(a_, b_);
  }

  template <class N> bool touch(const Spinners<N>& pair, const Spinners<Ball>& proof, const N& time, double gap) const {
    const ContactProof<N> contact(pair, proof, time);
    if (contact.one_pierces_the_other()) return true;
    const Separation<N> closest = separation(posed(pair.a, a_.shape, time), posed(pair.b, b_.shape, time));
    const Triple<N> center = pair.a.center_at(time);
    const auto from_center = [&](const Vec3<N>& p) { return Triple<N>{p[0], p[1], p[2]} - center; };
    if (contact.has_near_points(from_center(closest.point_b), gap)) return true;
    if (std::is_same_v<N, double>) return false;  // first in more digits
    return contact.has_near_edges(gap) ||
           contact.has_shared_point(from_center((closest.point_a + closest.point_b) / N(2)));
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

  Turning<A> a_;
  Turning<B> b_;
  Spinners<double> quick_;
  std::optional<Spinners<Ball>> proof_;
  std::optional<Spinners<Time>> fine_;
  std::optional<Spinners<Ball>> fine_proof_;
  std::optional<Triple<Time>> last_;  ///< normal of the last plane that proved something
};

}  // namespace thinwall::oracle
