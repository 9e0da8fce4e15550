#pragma once
/// The queries of a set and class, each with its true answer at 50 digits.

#include <cmath>
#include <optional>

#include <thinwall/experiments/accuracy/judge.hpp>
#include <thinwall/experiments/work_precision/query_sets.hpp>

namespace thinwall {

template <class A, class B> struct TimedQuery {
  Moving<A> a;
  Moving<B> b;
  bool touches;         ///< during the step; never at its start
  long double time;     ///< [1] of first contact, where they touch
  double conditioning;  ///< [1] kappa t, where they touch
  double path;          ///< [m] length of the relative displacement
};

inline Vec3<double> random_half_extents(QueryNumbers& u) {
  const double x = u.between(0.1, 1), y = u.between(0.1, 1), z = u.between(0.1, 1);
  return {x, y, z};
}

/// A straight pass of A beside B, which rests at the origin.
template <class A, class B> struct Pass {
  A a;
  B b;
  Vec3<double> along;  ///< [1] unit, A's direction
  Vec3<double> aside;  ///< [m] across it, from B's center to A's line
  double reach;        ///< [m] farther apart than this, centers have no contact

  Moving<A> whole(double share) const {
    const Vec3<double> start = aside * share - along * (2 * reach);
    return {moved(a, start), along * (4 * reach)};
  }
  /// [m] From the place nearest to B's center to first contact, along the line; nothing if there is none.
  std::optional<double> contact(double share) const {
    const Toi<double> toi = time_of_impact(whole(share), at_rest(b));
    if (toi.status == ToiStatus::apart) return {};
    return (4 * toi.time - 2) * reach;
  }
};

/// The share of `aside` at which the pass just touches.
template <class A, class B> double touching_share(const Pass<A, B>& pass) {
  double hit = 0, miss = 4;
  for (int i = 0; i < 50; ++i) (pass.contact((hit + miss) / 2) ? hit : miss) = (hit + miss) / 2;
  return hit;
}

/// One query of the class; both bodies move, and lie anywhere within ten times their size of the origin.
template <class Set> auto draw_of_class(QueryNumbers& u, QueryClass kind, double digits) {
  using A = typename Set::A;
  using B = typename Set::B;
  for (;;) {
    Pass<A, B> pass;
    pass.a = Set::draw_a(u);
    pass.b = Set::draw_b(u);
    pass.along = u.direction();
    pass.reach = safe_norm(half_widths(pass.a)) + safe_norm(half_widths(pass.b));
    const double off = kind == QueryClass::graze ? 1 : (kind == QueryClass::miss ? 2 : 1) * std::sqrt(u());
    pass.aside = safe_unit(cross<double>(pass.along, u.direction())) * (off * pass.reach);
    double share = 1;
    std::optional<double> place = pass.contact(share);
    if (kind == QueryClass::graze) {
      const double threshold = touching_share(pass);
      place = pass.contact(threshold);
      const bool inside = u.one_in(2);
      share = threshold * (1 + (inside ? -1 : 1) * u.decades(-digits, -2));
    } else if (place.has_value() != (kind == QueryClass::hit)) {
      continue;
    }
    const double path = pass.reach * u.decades(-0.5, 1.5), phase = u();
    const double distance = pass.reach * u.between(0, 10), speed = path * u();
    const Vec3<double> origin = u.direction() * distance;
    const Vec3<double> drift = u.direction() * speed;
    const Vec3<double> start = origin + pass.aside * share + pass.along * (place.value_or(0) - phase * path);
    return MovingPair<A, B>{{moved(pass.a, start), pass.along * path + drift}, {moved(pass.b, origin), drift}};
  }
}

/// The truth, from the shapes' own numbers. Nothing if they overlap at the start, or are not of the class.
template <class A, class B>
std::optional<TimedQuery<A, B>> with_truth(const Moving<A>& a, const Moving<B>& b, QueryClass kind) {
  const Digits50 tolerance = ldexp(Digits50(1), -140);
  const auto problem = oracle::pose<Digits50>(a, b);
  const auto truth = oracle::first_contact(problem, Digits50(0), tolerance);
  const bool touches = truth.verdict == oracle::Verdict::hit;
  if (truth.verdict == oracle::Verdict::overlapping) return {};
  if (kind != QueryClass::graze && touches != (kind == QueryClass::hit)) return {};
  using S = typename A::Scalar;
  const Vec3<S> path = a.displacement - b.displacement;
  return TimedQuery<A, B>{a,
                          b,
                          touches,
                          static_cast<long double>(truth.time),
                          static_cast<double>(truth.conditioning),
                          static_cast<double>(safe_norm(path))};
}

/// Query `i` of the stream, in S.
template <class Set, class S> auto timed_query(const RandomStream& stream, std::uint64_t i, QueryClass kind) {
  QueryNumbers numbers(stream, i);
  for (;;) {
    const auto drawn = draw_of_class<Set>(numbers, kind, std::is_same_v<S, float> ? 3 : 8);
    if (const auto query = with_truth(cast<S>(drawn.a), cast<S>(drawn.b), kind)) return *query;
  }
}

}  // namespace thinwall
