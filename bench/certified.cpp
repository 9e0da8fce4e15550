/// What does a proven answer cost, which stage gives it, and what would other ways to be sure cost?
/// On random, mixed and adversarial queries of each pair: the plain closed form, the certified answer, the queries that each
/// stage decided by themselves (what the stages before them tried in vain included), the closed form's kernel at 50 digits,
/// and Boost.Interval for spheres. Counters: the plain form's wrong verdicts, against the proven ones, and how far its times lie
/// outside the proven brackets; how wide those are; and the floor. The table at the end is of one run; its ratios carry from machine to machine.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <thinwall/swept/certified.hpp>

#include "certified_sets.hpp"
#include "errors.hpp"
#include "interval_ball.hpp"
#include "median_times.hpp"

namespace {

using namespace thinwall;
using namespace thinwall::bench;
using D = double;
using Digits50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

constexpr std::array<const char*, 4> stages{"guard", "filter", "certificate", "exact"};

std::vector<std::string> rows;        ///< pair/set, in order of registration
std::map<std::string, double> share;  ///< [1] by row and stage: how much of the set the stage decided

/// The certified answers of a set, asked for once.
template <class A, class B> const std::vector<CertifiedToi>& proven(const Queries<A, B>& queries) {
  static std::map<const void*, std::vector<CertifiedToi>> known;
  std::vector<CertifiedToi>& answers = known[queries.data()];
  if (answers.empty()) {
    for (const auto& query : queries) answers.push_back(certified_time_of_impact(query.a, query.b));
  }
  return answers;
}

/// Verdicts of `time_of` (over 1 for a miss) against the proven ones, and how far its hits lie outside the proven brackets.
template <class Set, class TimeOf> Errors against_proof(const Set& queries, const TimeOf& time_of) {
  Errors errors;
  std::vector<double> times, lengths;
  for (std::size_t k = 0; k < queries.size(); ++k) {
    const auto& query = queries[k];
    const CertifiedToi& truth = proven(queries)[k];
    const double time = time_of(query);
    const bool hit = time <= 1, truly = truth.verdict != ToiStatus::apart;
    errors.missed += truly && !hit ? 1 : 0;
    errors.false_hits += hit && !truly ? 1 : 0;
    if (!hit || !truly) continue;
    times.push_back(std::max({0.0, truth.lower - time, time - truth.upper}));
    lengths.push_back(times.back() * std::sqrt(relative_displacement(query.a, query.b).squaredNorm()));
  }
  std::tie(errors.p99, errors.largest) = tail_of(std::move(times));
  std::tie(errors.p99_length, errors.largest_length) = tail_of(std::move(lengths));
  return errors;
}

/// The widest of the brackets that hold the proven times, and their 99th percentile; of hits that do not overlap at the start.
template <class Set> std::pair<double, double> widths_of(const Set& queries) {
  std::vector<double> widths;
  for (const CertifiedToi& answer : proven(queries)) {
    if (answer.verdict == ToiStatus::hit) widths.push_back(answer.upper - answer.lower);
  }
  return tail_of(std::move(widths));
}

template <class Run> void add(const std::string& name, const Run& run) {
  benchmark::RegisterBenchmark(name.c_str(), run);
}

/// One pair on one set.
/// One pair on one set. `least`: what a query cannot do without.
template <class A, class B>
void add_row(const std::string& row, const Operations& least, const Queries<A, B>& (*set)()) {
  using Query = Shot<A, B>;
  rows.push_back(row);
  const auto certified = [](const Query& q) { return certified_time_of_impact(q.a, q.b); };
  const auto count = counted_once([set] {
    return against_proof(set(), [](const Query& q) {
      const auto toi = time_of_impact(q.a, q.b);
      return toi.status == ToiStatus::apart ? never : toi.time;
    });
  });
  add(row + "/plain", [set, least, count](benchmark::State& state) {
    time_queries(state, set(), [](const Query& q) { return time_of_impact(q.a, q.b); });
    count(state);
    add_query_floor(state, set(), least);
  });
  const auto widths = std::make_shared<std::optional<std::pair<double, double>>>();
  add(row + "/certified", [set, least, certified, widths](benchmark::State& state) {
    time_queries(state, set(), certified);
    if (!*widths) *widths = widths_of(set());
    state.counters["p99_width"] = (*widths)->first;
    state.counters["max_width"] = (*widths)->second;
    add_query_floor(state, set(), least);
  });
  for (const DecidedBy stage : {DecidedBy::filter, DecidedBy::certificate, DecidedBy::exact}) {
    const std::string name = row + "/" + stages[static_cast<std::size_t>(stage)];
    add(name, [set, stage, name, certified](benchmark::State& state) {
      Queries<A, B> decided;
      for (std::size_t k = 0; k < set().size(); ++k) {
        if (proven(set())[k].decided_by == stage) decided.push_back(set()[k]);
      }
      share[name] = static_cast<double>(decided.size()) / static_cast<double>(set().size());
      state.counters["share"] = share[name];
      if (decided.empty()) {
        for (auto _ : state) benchmark::DoNotOptimize(decided.size());
        return;
      }
      time_queries(state, decided, certified);
    });
  }
  add(row + "/50_digits", [set](benchmark::State& state) {
    time_queries(state, set(),
                 [](const Query& q) { return time_of_impact(cast<Digits50>(q.a), cast<Digits50>(q.b)).time; });
  });
  if constexpr (std::is_same_v<A, Sphere<D>> && std::is_same_v<B, Sphere<D>>) {
    add(row + "/interval", [set](benchmark::State& state) {
      time_queries(state, set(), [](const Query& q) { return interval_ball<Interval>(q.a, q.b); });
    });
    add(row + "/interval_unprotected", [set](benchmark::State& state) {
      const Interval::traits_type::rounding rounding;  // set once, not at every operation
      time_queries(state, set(), [](const Query& q) { return interval_ball<UnprotectedInterval>(q.a, q.b); });
    });
  }
}

template <class A, class B> void add_pair(const std::string& pair, const Operations& least) {
  const std::string name = "certified/" + pair;
  add_row<A, B>(name + "/random", least, &random_queries<A, B>);
  add_row<A, B>(name + "/mixed", least, &mixed_queries<A, B>);
  add_row<A, B>(name + "/adversarial", least, &adversarial_queries<A, B>);
}

const bool added = [] {
  add_pair<Sphere<D>, Sphere<D>>("sphere_sphere", round_hit);
  add_pair<Aabb<D>, Aabb<D>>("aabb_aabb", flat_hit);
  add_pair<Sphere<D>, Aabb<D>>("sphere_aabb", flat_hit);
  add_pair<Capsule<D>, Aabb<D>>("capsule_aabb", flat_hit);
  add_pair<Obb<D>, Obb<D>>("obb_obb", flat_hit);
  add_pair<Sphere<D>, Triangle<D>>("sphere_triangle", flat_hit);
  return true;
}();

class TableReporter : public MedianTimes {
 public:
  void Finalize() override {
    std::printf("\n%-36s%9s%10s%8s%8s |%-20s %-20s %-20s |%12s%11s%11s\n", "", "plain", "certified", "", "", " filter",
                " certificate", " exact", "interval", "interval", "50 digits");
    std::printf("%-36s%9s%10s%8s%8s |%8s%12s %8s%12s %8s%12s |%12s%11s%11s\n", "", "[ns]", "[ns]", "x plain", "x floor",
                "share", "x plain", "share", "x plain", "share", "x plain", "unprotected", "x plain", "x plain");
    for (const std::string& row : rows) {
      const double plain = time(row + "/plain");
      if (plain == 0) continue;
      const auto ratio = [&](const std::string& name) { return time(row + name) / plain; };
      std::printf("%-36s%9.1f%10.1f%8.1f%8.1f |", row.c_str(), plain, time(row + "/certified"), ratio("/certified"),
                  to_floor(row + "/certified"));
      for (const char* stage : {"filter", "certificate", "exact"}) {
        const std::string name = std::string("/") + stage;
        const double part = share[row + name];
        std::printf("%7.2f%%%12s ", 100 * part, part > 0 ? number(ratio(name)).c_str() : "-");
      }
      std::printf("|%12s%11s%11s\n", number(ratio("/interval_unprotected")).c_str(), number(ratio("/interval")).c_str(),
                  number(ratio("/50_digits")).c_str());
    }
    std::printf(
        "A stage's cost is that of the queries it decided, what earlier stages tried included. -: none.\n"
        "Plain is the front door, with the normal and the point; a certified answer has neither.\n"
        "Floor: to read a query where so many stay, or a hit's division and square root, whichever is more.\n");
  }

 private:
  static std::string number(double ratio) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), ratio < 100 ? "%.1f" : "%.0f", ratio);
    return ratio > 0 ? text.data() : "-";
  }
};

}  // namespace

int main(int argc, char** argv) {
  TableReporter reporter;
  return run_benchmarks(argc, argv, reporter);
}
