/// The sets of queries that methods are raced on, each query with its true answer at 50 digits, and the races: every method at every
/// setting on the same queries, errors once, times in rounds that are interleaved.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/accuracy/model.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/work_precision/model.hpp>
#include <thinwall/swept/methods.hpp>

namespace thinwall {

namespace {

template <class A, class B> struct TimedQuery {
  Moving<A> a;
  Moving<B> b;
  bool touches;         ///< during the step; never at its start
  long double time;     ///< [1] of first contact, where they touch
  double conditioning;  ///< [1] kappa t, where they touch
  double path;          ///< [m] length of the relative displacement
};

Vec3<double> random_half_extents(QueryNumbers& u) {
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

/// One of the settings that each method is raced with, from rough to fine along its option, if it has one.
template <class Method> struct Rung {
  Method method;
  std::string label;             ///< "tolerance 1e-06"; empty for a method without an option
  std::optional<double> option;  ///< its value
};

template <class Method>
concept HasTolerance = requires(const Method& method) { method.tolerance; };
template <class Method>
concept HasPoses = requires(const Method& method) { method.n; };

template <class Method, class S> std::vector<Rung<Method>> rungs(const Ladder& ladder) {
  std::vector<Rung<Method>> all;
  if constexpr (HasTolerance<Method>) {
    for (const double tolerance : ladder.tolerances) {
      if (!is_tolerance(static_cast<S>(tolerance))) continue;
      Method method;
      method.tolerance = static_cast<S>(tolerance);
      all.push_back({method, fmt::format("tolerance {:g}", tolerance), tolerance});
    }
  } else if constexpr (HasPoses<Method>) {
    for (const std::int64_t n : ladder.poses) {
      Method method;
      method.n = static_cast<int>(n);
      all.push_back({method, fmt::format("n {}", n), static_cast<double>(n)});
    }
  } else {
    all.push_back({Method{}, "", {}});
  }
  return all;
}

ErrorSpread spread_of(std::span<const double> errors) {
  if (errors.empty()) return {};
  return {quantile(errors, 0.5), quantile(errors, 0.99), quantile(errors, 1)};
}

/// Fills in all of `racer` but its name and times.
template <class Method, class A, class B>
void judge_racer(const Method& method, std::span<const TimedQuery<A, B>> queries, Racer& racer) {
  using S = typename A::Scalar;
  constexpr double unit = static_cast<double>(std::numeric_limits<S>::epsilon()) / 2;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> times, lengths;
  std::int64_t evaluations = 0;
  racer.latest = -infinity;
  racer.earliest = infinity;
  for (const TimedQuery<A, B>& q : queries) {
    const Toi<S> toi = time_of_impact(method, q.a, q.b);
    ++racer.queries;
    evaluations += toi.evaluations;
    racer.most_evaluations = std::max(racer.most_evaluations, std::int64_t{toi.evaluations});
    const bool says_hit = toi.status == ToiStatus::hit || toi.status == ToiStatus::overlapping;
    const bool says_apart = toi.status == ToiStatus::apart;
    racer.touching += q.touches ? 1 : 0;
    racer.gave_up += says_hit || says_apart ? 0 : 1;
    racer.false_hits += says_hit && !q.touches ? 1 : 0;
    racer.missed += says_apart && q.touches ? 1 : 0;
    if (!q.touches) continue;
    const double late = says_hit ? static_cast<double>(static_cast<long double>(toi.time) - q.time) : infinity;
    times.push_back(std::abs(late));
    lengths.push_back(std::abs(late) * q.path);
    if (!says_hit) continue;
    racer.latest = std::max(racer.latest, late);
    racer.earliest = std::min(racer.earliest, late);
    racer.forward = std::max(racer.forward, std::abs(late) / (unit * q.conditioning));
  }
  racer.time = spread_of(times);
  racer.length = spread_of(lengths);
  racer.evaluations = static_cast<double>(evaluations) / static_cast<double>(std::max<std::int64_t>(1, racer.queries));
}

/// A racer and the loop that is timed.
template <class Query> struct Entrant {
  Racer racer;
  std::function<void(std::span<const Query>)> run;
};

template <class Method, class A, class B>
Entrant<TimedQuery<A, B>> entrant_of(const Rung<Method>& rung, std::span<const TimedQuery<A, B>> queries) {
  Entrant<TimedQuery<A, B>> entrant;
  entrant.racer.method = std::string(Method::name);
  entrant.racer.setting = rung.label;
  entrant.racer.option = rung.option;
  judge_racer(rung.method, queries, entrant.racer);
  entrant.run = [method = rung.method](std::span<const TimedQuery<A, B>> some) {
    for (const TimedQuery<A, B>& q : some) keep(time_of_impact(method, q.a, q.b));
  };
  return entrant;
}

template <class Set, class S> std::vector<Racer> race(QueryClass kind, const RaceOptions& options) {
  using Query = decltype(timed_query<Set, S>(RandomStream{}, 0, kind));
  using A = decltype(Query::a.shape);
  using B = decltype(Query::b.shape);
  const std::array<double, 3> factors = {Set::key, static_cast<double>(kind), std::is_same_v<S, float> ? 1.0 : 0.0};
  const RandomStream stream = {options.seed, stream_of(factors)};
  std::vector<Query> queries;
  for (std::int64_t i = 0; i < options.queries; ++i) {
    queries.push_back(timed_query<Set, S>(stream, static_cast<std::uint64_t>(i), kind));
  }
  const std::span<const Query> all(queries);
  std::vector<Entrant<Query>> entrants;
  for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) {
      const auto& names = options.methods;
      if (std::find(names.begin(), names.end(), Method::name) == names.end()) return;
      for (const auto& rung : rungs<Method, S>(options.ladder)) entrants.push_back(entrant_of(rung, all));
    }
  });
  std::vector<TimedLoop<Query>> loops;
  for (const Entrant<Query>& entrant : entrants) loops.push_back({entrant.run});
  constexpr double round_ns = 4e6;
  run_rounds(loops, all, options.rounds, round_ns, stream);
  std::vector<Racer> racers;
  for (std::size_t i = 0; i < entrants.size(); ++i) {
    racers.push_back(std::move(entrants[i].racer));
    racers.back().nanoseconds = std::move(loops[i].nanoseconds);
  }
  return racers;
}

/// The methods of the list that serve the pair of a set.
template <class Set> std::vector<std::string_view> methods_that_serve() {
  std::vector<std::string_view> names;
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, typename Set::A, typename Set::B>) names.push_back(Method::name);
  });
  return names;
}

template <class Set> QuerySet query_set_of() {
  return {Set::name, Set::title, methods_that_serve<Set>(), &race<Set, float>, &race<Set, double>};
}

/// A ball of 1 to 10 cm and a wall of 2 m by 2 m, 0.1 mm to 10 cm thick.
struct SphereWall {
  using A = Sphere<double>;
  using B = Aabb<double>;
  static constexpr std::string_view name = "sphere_wall", title = "a small ball and a thin wall";
  static constexpr double key = 1;  // of its random numbers

  static A draw_a(QueryNumbers& u) { return {Vec3<double>::Zero(), u.between(0.01, 0.1)}; }
  static B draw_b(QueryNumbers& u) { return {Vec3<double>::Zero(), {u.decades(-4, -1) / 2, 1, 1}}; }
};

/// Two balls of 0.1 to 1 m.
struct SphereSphere {
  using A = Sphere<double>;
  using B = Sphere<double>;
  static constexpr std::string_view name = "sphere_sphere", title = "two balls";
  static constexpr double key = 2;  // of its random numbers

  static A draw_a(QueryNumbers& u) { return {Vec3<double>::Zero(), u.between(0.1, 1)}; }
  static B draw_b(QueryNumbers& u) { return draw_a(u); }
};

/// A capsule with a core of 0.2 to 2 m and a radius of 5 to 30 cm, and a box of 0.2 to 2 m a side, both turned any way.
struct CapsuleBox {
  using A = Capsule<double>;
  using B = Obb<double>;
  static constexpr std::string_view name = "capsule_box", title = "a capsule and a box";
  static constexpr double key = 3;  // of its random numbers

  static A draw_a(QueryNumbers& u) {
    const double half_length = u.between(0.1, 1);
    const Vec3<double> half = u.direction() * half_length;
    return {-half, half, u.between(0.05, 0.3)};
  }
  static B draw_b(QueryNumbers& u) {
    const Vec3<double> half = random_half_extents(u);
    return {Vec3<double>::Zero(), half, random_axes(u)};
  }
};

/// Two boxes of 0.2 to 2 m a side, turned any way.
struct BoxBox {
  using A = Obb<double>;
  using B = Obb<double>;
  static constexpr std::string_view name = "box_box", title = "two boxes";
  static constexpr double key = 4;  // of its random numbers

  static A draw_a(QueryNumbers& u) {
    const Vec3<double> half = random_half_extents(u);
    return {Vec3<double>::Zero(), half, random_axes(u)};
  }
  static B draw_b(QueryNumbers& u) { return draw_a(u); }
};

}  // namespace

std::span<const QuerySet> query_sets() {
  static const std::array list = {query_set_of<SphereWall>(), query_set_of<SphereSphere>(), query_set_of<CapsuleBox>(),
                                  query_set_of<BoxBox>()};
  return list;
}

}  // namespace thinwall
