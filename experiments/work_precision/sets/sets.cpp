/// The races: every method at every setting on the same queries, errors once, times in rounds that are interleaved.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/work_precision/sets/queries.hpp>
#include <thinwall/swept/methods.hpp>

namespace thinwall {

namespace {

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

/// The methods of the list that serve the pair of a set.
template <class Set> std::vector<std::string_view> methods_that_serve() {
  std::vector<std::string_view> names;
  for_each_type(MethodsOf<Set, double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (takes_part<Set, Method>()) names.push_back(Method::name);
  });
  return names;
}

template <class Set> QuerySet query_set_of() {
  return {Set::name, Set::title, is_turning<Set>, methods_that_serve<Set>(), &race<Set, float>, &race<Set, double>};
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
