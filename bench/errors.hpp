#pragma once
/// What an answer to a set of queries gets wrong, held against the set's truth: as counters of a row, beside its time.

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "floors.hpp"
#include "query_sets.hpp"

namespace thinwall::bench {

struct Errors {
  double missed = 0, false_hits = 0;  ///< of query_count
  double p99 = 0, largest = 0;        ///< [1] |time - truth| of true hits that were found, as a fraction of the step
  double p99_length = 0, largest_length = 0;  ///< [length] the same, times the relative motion: how far off the pose is
};

inline void add_errors(benchmark::State& state, const Errors& errors) {
  state.counters["missed"] = errors.missed;
  state.counters["false"] = errors.false_hits;
  state.counters["p99_error"] = errors.p99;
  state.counters["max_error"] = errors.largest;
  state.counters["p99_length"] = errors.p99_length;
  state.counters["max_length"] = errors.largest_length;
}

/// The 99th percentile and the largest of `values`; 0 of none.
inline std::pair<double, double> tail_of(std::vector<double> values) {
  if (values.empty()) return {0, 0};
  std::sort(values.begin(), values.end());
  return {values[values.size() * 99 / 100], values.back()};
}

/// `answer_of(query)` is as the set's truth: a time or a depth, or over `last_hit` for none;
/// negative for a hit without a number.
template <class Query, class AnswerOf> Errors errors_of(const QuerySet<Query>& set, const AnswerOf& answer_of) {
  Errors errors;
  std::vector<double> times, lengths;
  for (std::size_t k = 0; k < set.queries.size(); ++k) {
    const Query& query = set.queries[k];
    const double answer = answer_of(query), last = last_hit(query);
    const bool hit = answer <= last, truly = set.truth[k] <= last;
    errors.missed += truly && !hit ? 1 : 0;
    errors.false_hits += hit && !truly ? 1 : 0;
    if (!hit || !truly || answer < 0) continue;
    times.push_back(std::abs(answer - set.truth[k]));
    lengths.push_back(times.back() * unit_length(query));
  }
  std::tie(errors.p99, errors.largest) = tail_of(std::move(times));
  std::tie(errors.p99_length, errors.largest_length) = tail_of(std::move(lengths));
  return errors;
}

/// Counted when first asked for: Google Benchmark calls a benchmark several times over, and the errors stay the same.
template <class Count> auto counted_once(const Count& count) {
  return [count, errors = std::make_shared<std::optional<Errors>>()](benchmark::State& state) {
    if (!*errors) *errors = count();
    add_errors(state, **errors);
  };
}

/// Asks one query an iteration, over and over through the list.
template <class Query, class Ask>
void time_queries(benchmark::State& state, const std::vector<Query>& queries, const Ask& ask) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ask(queries[i]));
    i = i + 1 == queries.size() ? 0 : i + 1;
  }
}

/// [ns] to read a query of this list, wherever so many stay. Measured once a list.
template <class Query> double reading_ns(const std::vector<Query>& queries) {
  static std::map<const void*, double> known;
  const auto [found, added] = known.try_emplace(queries.data(), 0.0);
  if (added) {
    found->second = read_ns(queries.data(), queries.size() * sizeof(Query)) / static_cast<double>(queries.size());
  }
  return found->second;
}

/// The floor of a query of this list: to read it, or the operations that it cannot do without.
template <class Query>
void add_query_floor(benchmark::State& state, const std::vector<Query>& queries, const Operations& operations) {
  add_floor(state, std::max(reading_ns(queries), operations.floor_ns()));
}

template <class Run> void add_benchmark(const std::string& name, const Run& run) {
  benchmark::RegisterBenchmark(name.c_str(), run);
}

/// One way to answer a set of queries: `ask` is timed, `answer_of` gives its answer as the set's truth is given.
template <class Query, class Ask, class AnswerOf>
void add_timed(const std::string& name, const QuerySet<Query>& (*set)(), const Operations& least, Ask ask,
               AnswerOf answer_of) {
  const auto count = counted_once([set, answer_of] { return errors_of(set(), answer_of); });
  add_benchmark(name, [set, least, ask, count](benchmark::State& state) {
    time_queries(state, set().queries, ask);
    count(state);
    add_query_floor(state, set().queries, least);
  });
}

/// Half of the queries hit, and the time of a hit is a quotient.
inline constexpr Operations flat_hit{.divisions = 0.5, .roots = 0};
/// Half of the queries hit a round shape: a quotient with a square root in it.
inline constexpr Operations round_hit{.divisions = 0.5, .roots = 0.5};

}  // namespace thinwall::bench
