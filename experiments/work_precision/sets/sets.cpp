/// The races: every method at every setting on the same queries, errors once, times in rounds that are interleaved.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/models/oracle.hpp>
#include <thinwall/experiments/models/queries.hpp>
#include <thinwall/experiments/work_precision/model.hpp>
#include <thinwall/experiments/work_precision/sets/turning_truth.hpp>
#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

namespace thinwall {

namespace {

// ---- The sets of queries that methods are raced on, each query with its true answer: at 50 digits where nothing turns, in long double
// where something does.

/// What is true of a query.
struct FirstTouch {
  oracle::Verdict verdict;
  long double time;     ///< [1] of first contact, where they touch
  double conditioning;  ///< [1] kappa t, where they touch; infinite of what turns, which no closed form answers
  double path;          ///< [m] length of the relative displacement; of what turns, the speed bound over a step
};

/// A and B move straight, or turn. They never touch at the start of the step.
template <class A, class B> struct TimedQuery {
  A a;
  B b;
  FirstTouch truth;
  bool touches() const { return truth.verdict == oracle::Verdict::hit; }
};

/// As it is on a stretch of a pass: of `length` [m], `from` [m] on. `spin` [rad/m] turns it, if anything turns.
template <bool spins, class A>
auto on_stretch(const A& shape, const Vec3<double>& spin, double from, double length, const Vec3<double>& start,
                const Vec3<double>& displacement) {
  if constexpr (spins) {
    const A there = turned(shape, rotation_about<double>(safe_unit(spin), safe_norm(spin) * from));
    return Turning<A>{moved(there, start), displacement, spin * length};
  } else {
    return Moving<A>{moved(shape, start), displacement};
  }
}

struct QuarterTurns {
  static constexpr double most_turn_a = std::numbers::pi / 2, most_turn_b = most_turn_a;  // [rad]
};
template <class Set> constexpr bool is_turning = std::derived_from<Set, QuarterTurns>;

/// Both may turn on the way, and are `a` and `b` where A is nearest.
template <class Set> struct Pass : StraightPass<typename Set::A, typename Set::B> {
  Vec3<double> spin_a = Vec3<double>::Zero();  ///< [rad/m] of A's path
  Vec3<double> spin_b = Vec3<double>::Zero();  ///< [rad/m] of the same

  /// A and B on a stretch of `by` [m], `from` [m] on: A starts at `start` and travels by `path`, B at `origin`, by `drift`.
  auto stretch(double from, double by, const Vec3<double>& start, const Vec3<double>& path, const Vec3<double>& origin,
               const Vec3<double>& drift) const {
    return std::pair(on_stretch<is_turning<Set>>(this->a, spin_a, from, by, start, path),
                     on_stretch<is_turning<Set>>(this->b, spin_b, from, by, origin, drift));
  }
  /// [m] As of a straight pass.
  std::optional<double> contact(double share) const {
    if constexpr (is_turning<Set>) {
      const double from = this->before * this->reach, all = this->length * this->reach;
      const Vec3<double> none = Vec3<double>::Zero();
      const auto moving = stretch(from, all, this->start(share), this->along * all, none, none);
      return this->place_of(time_of_impact(ConservativeAdvancement<double>{1e-10}, moving.first, moving.second));
    } else {
      return StraightPass<typename Set::A, typename Set::B>::contact(share);
    }
  }
};

/// [rad] Up to `most`, about any axis.
Vec3<double> turn_of_a_step(QueryNumbers& u, double most) {
  const Vec3<double> axis = u.direction();
  return axis * u.between(0, most);
}

/// One query of the class; both bodies move, and lie anywhere within ten times their size of the origin.
template <class Set> auto draw_of_class(QueryNumbers& u, QueryClass kind, double digits) {
  for (;;) {
    Pass<Set> pass;
    pass.a = Set::draw_a(u);
    pass.b = Set::draw_b(u);
    pass.along = u.direction();
    pass.reach = safe_norm(half_widths(pass.a)) + safe_norm(half_widths(pass.b));
    const double off = kind == QueryClass::graze ? 1 : (kind == QueryClass::miss ? 2 : 1) * std::sqrt(u());
    pass.aside = safe_unit(cross<double>(pass.along, u.direction())) * (off * pass.reach);
    double path = 0;
    const auto draw_path = [&] { path = pass.reach * u.decades(-0.5, 1.5); };
    if constexpr (is_turning<Set>) {
      draw_path();
      pass.spin_a = turn_of_a_step(u, Set::most_turn_a) / path;
      pass.spin_b = turn_of_a_step(u, Set::most_turn_b) / path;
    }
    double share = 1;
    std::optional<double> place = pass.contact(share);
    if (kind == QueryClass::graze) {
      const double threshold = last_that_touches([&](double x) { return pass.contact(x).has_value(); }, 4, 50);
      place = pass.contact(threshold);
      const bool inside = u.one_in(2);
      share = threshold * (1 + (inside ? -1 : 1) * u.decades(-digits, -2));
    } else if (place.has_value() != (kind == QueryClass::hit)) {
      continue;
    }
    if constexpr (!is_turning<Set>) draw_path();
    const double phase = u();
    const double distance = pass.reach * u.between(0, 10), speed = path * u();
    const Vec3<double> origin = u.direction() * distance;
    const Vec3<double> drift = u.direction() * speed;
    const double from = place.value_or(0) - phase * path;
    const Vec3<double> start = origin + pass.aside * share + pass.along * from;
    return pass.stretch(from, path, start, Vec3<double>(pass.along * path + drift), origin, drift);
  }
}

/// Nothing touches at the start, what hits does so later, and what misses never; a graze may do either.
bool is_of_class(oracle::Verdict verdict, QueryClass kind) {
  if (verdict == oracle::Verdict::overlapping) return false;
  return kind == QueryClass::graze || (verdict == oracle::Verdict::hit) == (kind == QueryClass::hit);
}

/// From the shapes' own numbers.
template <class A, class B> FirstTouch truth_of(const Moving<A>& a, const Moving<B>& b) {
  const Digits50 tolerance = ldexp(Digits50(1), -140);
  const auto truth = oracle::first_contact(oracle::pose<Digits50>(a, b), Digits50(0), tolerance);
  return {truth.verdict, static_cast<long double>(truth.time), static_cast<double>(truth.conditioning),
          static_cast<double>(safe_norm(relative_displacement(a, b)))};
}
template <class A, class B> FirstTouch truth_of(const Turning<A>& a, const Turning<B>& b) {
  const oracle::TurningTruth truth(a, b);
  return {truth.verdict, truth.time, std::numeric_limits<double>::infinity(), static_cast<double>(truth.speed)};
}

/// Query `i` of the stream, in S.
template <class Set, class S> auto timed_query(const RandomStream& stream, std::uint64_t i, QueryClass kind) {
  QueryNumbers numbers(stream, i);
  for (;;) {
    const auto drawn = draw_of_class<Set>(numbers, kind, std::is_same_v<S, float> ? 3 : is_turning<Set> ? 6 : 8);
    const auto a = cast<S>(drawn.first);
    const auto b = cast<S>(drawn.second);
    const TimedQuery<std::remove_const_t<decltype(a)>, std::remove_const_t<decltype(b)>> query = {a, b, truth_of(a, b)};
    if (is_of_class(query.truth.verdict, kind)) return query;
  }
}

Capsule<double> random_capsule(QueryNumbers& u, double longest, double thinnest, double thickest) {
  const double half_length = u.between(0.1, longest);
  const Vec3<double> half = u.vector(half_length);
  return {-half, half, u.between(thinnest, thickest)};
}
Obb<double> random_box(QueryNumbers& u) {
  const Vec3<double> half = random_half_extents(u, 0.1);
  return {Vec3<double>::Zero(), half, random_axes(u)};
}

/// What a set is of.
template <class ShapeA, class ShapeB> struct PairOf {
  using A = ShapeA;
  using B = ShapeB;
};

/// A ball of 1 to 10 cm and a wall of 2 m by 2 m, 0.1 mm to 10 cm thick.
struct SphereWall : PairOf<Sphere<double>, Aabb<double>> {
  static constexpr std::string_view name = "sphere_wall", title = "a small ball and a thin wall";
  static constexpr double key = 1;  // of its random numbers

  static A draw_a(QueryNumbers& u) { return {Vec3<double>::Zero(), u.between(0.01, 0.1)}; }
  static B draw_b(QueryNumbers& u) { return {Vec3<double>::Zero(), {u.decades(-4, -1) / 2, 1, 1}}; }
};

/// Two balls of 0.1 to 1 m.
struct SphereSphere : PairOf<Sphere<double>, Sphere<double>> {
  static constexpr std::string_view name = "sphere_sphere", title = "two balls";
  static constexpr double key = 2;  // of its random numbers

  static A draw_a(QueryNumbers& u) { return {Vec3<double>::Zero(), u.between(0.1, 1)}; }
  static B draw_b(QueryNumbers& u) { return draw_a(u); }
};

/// A capsule with a core of 0.2 to 2 m and a radius of 5 to 30 cm, and a box of 0.2 to 2 m a side, both turned any way.
struct CapsuleBox : PairOf<Capsule<double>, Obb<double>> {
  static constexpr std::string_view name = "capsule_box", title = "a capsule and a box";
  static constexpr double key = 3;  // of its random numbers

  static A draw_a(QueryNumbers& u) { return random_capsule(u, 1, 0.05, 0.3); }
  static B draw_b(QueryNumbers& u) { return random_box(u); }
};

/// Two boxes of 0.2 to 2 m a side, turned any way.
struct BoxBox : PairOf<Obb<double>, Obb<double>> {
  static constexpr std::string_view name = "box_box", title = "two boxes";
  static constexpr double key = 4;  // of its random numbers

  static A draw_a(QueryNumbers& u) { return random_box(u); }
  static B draw_b(QueryNumbers& u) { return random_box(u); }
};

/// A rod with a core of 0.2 to 1 m and a radius of 1 to 5 cm, and a wall that stands: of 2 m by 2 m, 0.1 mm to 10 cm thick.
struct TurningRodWall : PairOf<Capsule<double>, Obb<double>>, QuarterTurns {
  static constexpr std::string_view name = "turning_rod_wall", title = "a rod that turns and a thin wall";
  static constexpr double most_turn_b = 0;
  static constexpr double key = 5;  // of its random numbers

  static A draw_a(QueryNumbers& u) { return random_capsule(u, 0.5, 0.01, 0.05); }
  static B draw_b(QueryNumbers& u) { return to_obb(SphereWall::draw_b(u)); }
};

/// The same capsules and boxes as where nothing turns.
struct TurningCapsuleBox : CapsuleBox, QuarterTurns {
  static constexpr std::string_view name = "turning_capsule_box", title = "a capsule and a box that turn";
  static constexpr double key = 6;  // of its random numbers
};

/// The same boxes as where nothing turns.
struct TurningBoxBox : BoxBox, QuarterTurns {
  static constexpr std::string_view name = "turning_box_box", title = "two boxes that turn";
  static constexpr double key = 7;  // of its random numbers
};

// ---- The races.

/// A method at each setting it is raced with, from rough to fine along its option, if it has one; the racers are yet to be judged.
template <class Method, class S> std::vector<std::pair<Method, Racer>> rungs(const RaceOptions& options) {
  std::vector<std::pair<Method, Racer>> all;
  Method method;
  const auto add = [&](std::string setting, std::optional<double> option) {
    all.emplace_back(method,
                     Racer{.method = std::string(Method::name), .setting = std::move(setting), .option = option});
  };
  if constexpr (requires { method.tolerance; }) {
    for (const double tolerance : options.tolerances) {
      if (!is_tolerance<S>(static_cast<S>(tolerance))) continue;
      method.tolerance = static_cast<S>(tolerance);
      add(fmt::format("tolerance {:g}", tolerance), tolerance);
    }
  } else if constexpr (requires { method.n; }) {
    for (const std::int64_t n : options.poses) {
      method.n = static_cast<int>(n);
      add(fmt::format("n {}", n), static_cast<double>(n));
    }
  } else {
    add("", {});
  }
  return all;
}

ErrorSpread spread_of(std::span<const double> errors) {
  if (errors.empty()) return {};
  return {quantile(errors, 0.5), quantile(errors, 0.99), quantile(errors, 1)};
}

/// Fills in all but the times.
template <class Method, class A, class B>
void judge_racer(const Method& method, std::span<const TimedQuery<A, B>> queries, Racer& racer) {
  using S = typename decltype(A::shape)::Scalar;
  constexpr double unit = static_cast<double>(std::numeric_limits<S>::epsilon()) / 2;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> times, lengths;
  std::int64_t evaluations = 0;
  for (const TimedQuery<A, B>& q : queries) {
    const Toi<S> toi = time_of_impact(method, q.a, q.b);
    ++racer.queries;
    evaluations += toi.evaluations;
    racer.most_evaluations = std::max(racer.most_evaluations, std::int64_t{toi.evaluations});
    const bool says_hit = toi.status == ToiStatus::hit || toi.status == ToiStatus::overlapping;
    const bool says_apart = toi.status == ToiStatus::apart;
    racer.touching += q.touches() ? 1 : 0;
    racer.gave_up += says_hit || says_apart ? 0 : 1;
    racer.false_hits += says_hit && !q.touches() ? 1 : 0;
    racer.missed += says_apart && q.touches() ? 1 : 0;
    if (!q.touches()) continue;
    const double late = says_hit ? static_cast<double>(static_cast<long double>(toi.time) - q.truth.time) : infinity;
    times.push_back(std::abs(late));
    lengths.push_back(std::abs(late) * q.truth.path);
    if (!says_hit) continue;
    racer.latest = std::max(racer.latest, late);
    racer.earliest = std::min(racer.earliest, late);
    racer.forward = std::max(racer.forward, std::abs(late) / (unit * q.truth.conditioning));
  }
  racer.time = spread_of(times);
  racer.length = spread_of(lengths);
  racer.evaluations = static_cast<double>(evaluations) / static_cast<double>(std::max<std::int64_t>(1, racer.queries));
}

template <class Set, class S> using MethodsOf = std::conditional_t<is_turning<Set>, TurningMethods<S>, Methods<S>>;
template <class Set, class Method> constexpr bool takes_part() {
  if constexpr (is_turning<Set>) {
    return serves_turning<Method, typename Set::A, typename Set::B>;
  } else {
    return serves<Method, typename Set::A, typename Set::B>;
  }
}

template <class Set, class S> std::vector<Racer> race(QueryClass kind, const RaceOptions& options) {
  using Query = decltype(timed_query<Set, S>(RandomStream{}, 0, kind));
  const std::array<double, 3> factors = {Set::key, static_cast<double>(kind), std::is_same_v<S, float> ? 1.0 : 0.0};
  const RandomStream stream = {options.seed, stream_of(factors)};
  std::vector<Query> queries;
  for (std::int64_t i = 0; i < options.queries; ++i)
    queries.push_back(timed_query<Set, S>(stream, static_cast<std::uint64_t>(i), kind));
  const std::span<const Query> all(queries);
  std::vector<Racer> racers;
  std::vector<TimedLoop<Query>> loops;
  for_each_type(MethodsOf<Set, S>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (takes_part<Set, Method>()) {
      if (std::ranges::find(options.methods, Method::name) == options.methods.end()) return;
      for (auto& [method, racer] : rungs<Method, S>(options)) {
        judge_racer(method, all, racer);
        racers.push_back(std::move(racer));
        loops.push_back({[method = method](std::span<const Query> some) {
          for (const Query& q : some) keep(time_of_impact(method, q.a, q.b));
        }});
      }
    }
  });
  constexpr double round_ns = 4e6;
  run_rounds(loops, all, options.rounds, round_ns, stream);
  for (std::size_t i = 0; i < racers.size(); ++i) racers[i].nanoseconds = std::move(loops[i].nanoseconds);
  return racers;
}

template <class Set> QuerySet query_set_of() {
  const auto names = type_names(MethodsOf<Set, double>{}, []<class M>(TypeTag<M>) { return takes_part<Set, M>(); });
  return {Set::name, Set::title, is_turning<Set>, names, &race<Set, float>, &race<Set, double>};
}

}  // namespace

std::span<const QuerySet> query_sets() {
  static const std::array list = {query_set_of<SphereWall>(),     query_set_of<SphereSphere>(),
                                  query_set_of<CapsuleBox>(),     query_set_of<BoxBox>(),
                                  query_set_of<TurningRodWall>(), query_set_of<TurningCapsuleBox>(),
                                  query_set_of<TurningBoxBox>()};
  return list;
}

}  // namespace thinwall
