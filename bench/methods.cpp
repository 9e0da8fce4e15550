/// What does each way to find a time of impact cost, and how wrong is it?
/// Every method of the list on the same queries. Counters beside the time: missed and false hits against the closed form in
/// long double, the error of the time of a hit (99th percentile and largest, as a fraction of the step and as a length), and the
/// floor of a query (floors.hpp) with the time over it.

#include <benchmark/benchmark.h>

#include <string>

#include <thinwall/swept/methods.hpp>

#include "query_sets.hpp"

namespace {

using namespace thinwall;
using namespace thinwall::bench;

template <class A, class B>
void add(const std::string& set_name, const Shots<A, B>& (*set)(), const Operations& least) {
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) {
      const std::string name = "time_of_impact/" + set_name + "/" + std::string(Method::name);
      add_timed(name, set, least,
                [](const Shot<A, B>& query) { return time_of(time_of_impact(Method{}, query.a, query.b)); });
    }
  });
}

const bool added = [] {
  add("sphere_thin_wall", &thin_wall_shots<Aabb<double>>, flat_hit);
  add("sphere_sphere", &any_shots<Sphere<double>, Sphere<double>>, round_hit);
  return true;
}();

}  // namespace

int main(int argc, char** argv) { return run_benchmarks(argc, argv); }
