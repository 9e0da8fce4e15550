#pragma once
/// Every method at every setting on the same queries: errors once, times in rounds that are interleaved.

#include <algorithm>
#include <array>
#include <functional>

#include <thinwall/experiments/timing/interleaved.hpp>
#include <thinwall/experiments/work_precision/judge_racer.hpp>
#include <thinwall/experiments/work_precision/rungs.hpp>

namespace thinwall {

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

}  // namespace thinwall
