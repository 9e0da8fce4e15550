/// What does each way to find a time of impact cost, and how wrong is it?
/// Every method of the list on the same queries. Counters beside the time: missed and false hits against the closed form in
/// long double, and the largest error of the time of a hit, in fractions of the step.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <thinwall/swept/methods.hpp>

#include "query_sets.hpp"

namespace {

using namespace thinwall;
using namespace thinwall::bench;

/// Times `time_of(query)` (over 1 for a miss) over a set, then compares it with the truth.
template <class Set, class TimeOf> void run(benchmark::State& state, const Set& set, const TimeOf& time_of) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(time_of(set.queries[i]));
    i = i + 1 == query_count ? 0 : i + 1;
  }
  double missed = 0, false_hits = 0, largest_error = 0;
  for (std::size_t k = 0; k < query_count; ++k) {
    const double time = time_of(set.queries[k]);
    const bool hit = time <= 1, truly = set.truth[k] <= 1;
    missed += truly && !hit ? 1 : 0;
    false_hits += hit && !truly ? 1 : 0;
    if (hit && truly) largest_error = std::max(largest_error, std::abs(time - set.truth[k]));
  }
  state.counters["missed"] = missed;
  state.counters["false"] = false_hits;
  state.counters["max_error"] = largest_error;
}

template <class A, class B> void add(const std::string& set_name, const Shots<A, B>& (*set)()) {
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) {
      const std::string name = set_name + "/" + std::string(Method::name);
      benchmark::RegisterBenchmark(name.c_str(), [set](benchmark::State& state) {
        run(state, set(), [](const Shot<A, B>& query) {
          const Toi<double> toi = time_of_impact(Method{}, query.a, query.b);
          return toi.status == ToiStatus::apart ? never : toi.time;
        });
      });
    }
  });
}

const bool added = [] {
  add("sphere_thin_wall", &thin_wall_shots);
  add("sphere_sphere", &any_shots<Sphere<double>, Sphere<double>>);
  return true;
}();

}  // namespace
