#pragma once
/// Every method at every setting on the same queries: errors once, times in rounds that are interleaved, so that whatever
/// else the machine does befalls all of them alike.

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <numeric>

#include <thinwall/experiments/work_precision/judge_racer.hpp>
#include <thinwall/experiments/work_precision/rungs.hpp>

namespace thinwall {

/// Keeps a whole answer from being optimized away.
template <class T> void keep(const T& value) { asm volatile("" : : "m"(value) : "memory"); }

/// A racer and the loop that is timed.
template <class Query> struct Entrant {
  Racer racer;
  std::function<void(std::span<const Query>)> run;
  std::size_t slice = 0;  ///< queries a round: all, or for a slow one as many as take about 4 ms
};

template <class Query> double nanoseconds_a_query(const Entrant<Query>& entrant, std::span<const Query> queries) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  entrant.run(queries);
  const std::chrono::duration<double, std::nano> spent = Clock::now() - start;
  return spent.count() / static_cast<double>(queries.size());
}

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

/// A round of every entrant, in an order of its own, each on the slice of the queries that is next.
template <class Query>
void run_rounds(std::vector<Entrant<Query>>& entrants, std::span<const Query> queries, const RaceOptions& options,
                const RandomStream& stream) {
  constexpr double round_ns = 4e6;
  constexpr std::size_t least = 50;
  for (Entrant<Query>& entrant : entrants) {  // warms up, too
    const double fits = round_ns / std::max(1.0, nanoseconds_a_query(entrant, queries));
    entrant.slice = std::clamp(static_cast<std::size_t>(fits), std::min(least, queries.size()), queries.size());
  }
  std::vector<std::size_t> order(entrants.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::uint64_t round = 0; round < static_cast<std::uint64_t>(options.rounds); ++round) {
    for (std::size_t i = order.size(); i > 1; --i) {
      const double place = uniform(random_words(stream, round, i)[0]) * static_cast<double>(i);
      std::swap(order[i - 1], order[static_cast<std::size_t>(place)]);
    }
    for (const std::size_t i : order) {
      Entrant<Query>& entrant = entrants[i];
      const std::size_t slices = queries.size() / entrant.slice;
      const auto some = queries.subspan(round % slices * entrant.slice, entrant.slice);
      entrant.racer.nanoseconds.push_back(nanoseconds_a_query(entrant, some));
    }
  }
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
  run_rounds(entrants, all, options, stream);
  std::vector<Racer> racers;
  for (Entrant<Query>& entrant : entrants) racers.push_back(std::move(entrant.racer));
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
