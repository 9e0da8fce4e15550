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

#include <boost/multiprecision/eigen.hpp>
#include <boost/numeric/interval.hpp>
#include <thinwall/experiments/models/oracle.hpp>
#include <thinwall/swept/certified.hpp>
#include <thinwall/swept/members.hpp>

#include "query_sets.hpp"

namespace {

using namespace thinwall;
using namespace thinwall::bench;
using D = double;

// ---- Three sets of queries for the certified time of impact, from what a scene asks to what was made to be hard:
//   random       any_shots() of query_sets.hpp: hits and misses of like number, none of them close
//   mixed        half of them random; a quarter graze, to 1e-2 ... 1e-12 of the reach; a quarter come from 1e1 ... 1e8 away
//   adversarial  half graze to 1e-12 ... 1e-16; a quarter stop where they touch, give or take an ulp; a quarter lie on a
//                lattice of eighths, where touches are exact

constexpr std::size_t hard_query_count = 8'000;

double decades(Uniform& uniform, double low, double high) { return std::pow(10.0, uniform.between(low, high)); }

template <class A, class B> Shot<A, B> any_shot(Uniform& uniform, double distance) {
  const Vec3<double> from = uniform.direction() * (uniform.between(1.5, 3) * distance);
  const Vec3<double> aim = uniform.direction() * uniform.between(0, 2);
  const Vec3<double> drift = uniform.direction() * uniform.between(0, 2);
  const A a = moved<double>(any_shape<A>(uniform), from);
  const B b = any_shape<B>(uniform);
  return {{a, (aim - from) * uniform.between(0.5, 3) + drift}, {b, drift}};
}

/// The shot turned aside until it is `margin` [1] beyond the last hit, or before it.
template <class A, class B> Shot<A, B> grazing_shot(Uniform& uniform, double margin) {
  Shot<A, B> shot = any_shot<A, B>(uniform, 1);
  const Vec3<double> aside = uniform.direction() * 4, drift = shot.b.displacement;
  const Vec3<double> from = center(shot.a.shape);
  const auto aim = [&](double share) { shot.a.displacement = (aside * share - from) * 2.0 + drift; };
  double hit = 0, miss = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (hit + miss) / 2;
    aim(middle);
    (time_of_impact(shot.a, shot.b).status == ToiStatus::apart ? miss : hit) = middle;
  }
  aim(hit * (1 + margin));
  return shot;
}

/// The shot cut off where it first touches, to an ulp.
template <class A, class B> Shot<A, B> touching_shot(Uniform& uniform) {
  Shot<A, B> shot = any_shot<A, B>(uniform, 1);
  const Toi<double> toi = time_of_impact(shot.a, shot.b);
  if (toi.status != ToiStatus::hit) return shot;
  const double length = toi.time * (1 + std::floor(uniform.between(-1, 2)) * std::numeric_limits<double>::epsilon());
  shot.a.displacement *= length;
  shot.b.displacement *= length;
  return shot;
}

/// Every number to the nearest eighth; an oriented box upright.
template <class A> Moving<A> to_eighths(Moving<A> moving) {
  if constexpr (requires { moving.shape.axes; }) moving.shape.axes.setIdentity();
  for_each_number(moving, [](double& x) { x = std::round(x * 8) / 8; });
  return moving;
}
template <class A, class B> Shot<A, B> lattice_shot(Uniform& uniform) {
  const Shot<A, B> shot = any_shot<A, B>(uniform, 1);
  return {to_eighths(shot.a), to_eighths(shot.b)};
}

template <class A, class B> using Queries = std::vector<Shot<A, B>>;

template <class A, class B> const Queries<A, B>& random_queries() { return any_shots<A, B>().queries; }

/// So many, a few at a time: `add(uniform, made)`.
template <class A, class B, class Add> Queries<A, B> hard_queries(const Add& add) {
  Uniform uniform;
  Queries<A, B> made;
  while (made.size() < hard_query_count) add(uniform, made);
  return made;
}

template <class A, class B> const Queries<A, B>& mixed_queries() {
  static const Queries<A, B> set = hard_queries<A, B>([](Uniform& uniform, Queries<A, B>& made) {
    made.push_back(any_shot<A, B>(uniform, 1));
    made.push_back(any_shot<A, B>(uniform, 1));
    made.push_back(any_shot<A, B>(uniform, decades(uniform, 1, 8)));
    const double side = uniform() < 0.5 ? -1 : 1;
    made.push_back(grazing_shot<A, B>(uniform, side * decades(uniform, -12, -2)));
  });
  return set;
}

template <class A, class B> const Queries<A, B>& adversarial_queries() {
  static const Queries<A, B> set = hard_queries<A, B>([](Uniform& uniform, Queries<A, B>& made) {
    for (const double side : {-1.0, 1.0})
      made.push_back(grazing_shot<A, B>(uniform, side * decades(uniform, -16, -12)));
    made.push_back(touching_shot<A, B>(uniform));
    made.push_back(lattice_shot<A, B>(uniform));
  });
  return set;
}

// ---- Two spheres by interval arithmetic, the way to bound roundings without deriving a bound: the perpendicular quadratic of
// discrete/entry/ball_entry.hpp on Boost.Interval, which switches the processor's rounding mode: at every operation, or,
// unprotected, once for many.

using Interval = boost::numeric::interval<double>;
using UnprotectedInterval = boost::numeric::interval_lib::unprotect<Interval>::type;

/// The verdict and a bracket of the time; `gave_up` where the intervals do not decide.
template <class I> CertifiedToi interval_ball(const Moving<Sphere<double>>& a, const Moving<Sphere<double>>& b) {
  std::array<I, 3> p, v;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    p[k] = I(a.shape.center[i]) - I(b.shape.center[i]);
    v[k] = I(a.displacement[i]) - I(b.displacement[i]);
  }
  const I R = I(a.shape.radius) + I(b.shape.radius), RR = square(R);
  const auto decided = [](ToiStatus verdict, double lower, double upper) {
    return CertifiedToi{verdict, lower, upper, DecidedBy::filter};
  };
  const CertifiedToi undecided = decided(ToiStatus::gave_up, 0, 1);

  const I c = square(p[0]) + square(p[1]) + square(p[2]) - RR;
  if (c.upper() <= 0) return decided(ToiStatus::overlapping, 0, 0);
  if (!(c.lower() > 0)) return undecided;
  const I approach = -(p[0] * v[0] + p[1] * v[1] + p[2] * v[2]);
  if (approach.upper() <= 0) return decided(ToiStatus::apart, 1, 1);
  const I q0 = p[1] * v[2] - p[2] * v[1], q1 = p[2] * v[0] - p[0] * v[2], q2 = p[0] * v[1] - p[1] * v[0];
  const I discriminant = (square(v[0]) + square(v[1]) + square(v[2])) * RR - (square(q0) + square(q1) + square(q2));
  if (discriminant.upper() < 0) return decided(ToiStatus::apart, 1, 1);
  if (!(discriminant.lower() > 0 && approach.lower() > 0)) return undecided;
  const I time = c / (approach + sqrt(discriminant));
  if (time.lower() > 1) return decided(ToiStatus::apart, 1, 1);
  return time.upper() <= 1 ? decided(ToiStatus::hit, time.lower(), time.upper()) : undecided;
}

// ---- The rows.

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

/// One pair on one set. `least`: what a query cannot do without.
template <class A, class B>
void add_row(const std::string& row, const Operations& least, const Queries<A, B>& (*set)()) {
  using Query = Shot<A, B>;
  rows.push_back(row);
  const auto certified = [](const Query& q) { return certified_time_of_impact(q.a, q.b); };
  const auto count = counted_once(
      [set] { return against_proof(set(), [](const Query& q) { return time_of(time_of_impact(q.a, q.b)); }); });
  add_benchmark(row + "/plain", [set, least, count](benchmark::State& state) {
    time_queries(state, set(), [](const Query& q) { return time_of_impact(q.a, q.b); });
    count(state);
    add_query_floor(state, set(), least);
  });
  const auto widths = std::make_shared<std::optional<std::pair<double, double>>>();
  add_benchmark(row + "/certified", [set, least, certified, widths](benchmark::State& state) {
    time_queries(state, set(), certified);
    if (!*widths) *widths = widths_of(set());
    state.counters["p99_width"] = (*widths)->first;
    state.counters["max_width"] = (*widths)->second;
    add_query_floor(state, set(), least);
  });
  for (const DecidedBy stage : {DecidedBy::filter, DecidedBy::certificate, DecidedBy::exact}) {
    const std::string name = row + "/" + stages[static_cast<std::size_t>(stage)];
    add_benchmark(name, [set, stage, name, certified](benchmark::State& state) {
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
  add_benchmark(row + "/50_digits", [set](benchmark::State& state) {
    time_queries(state, set(),
                 [](const Query& q) { return time_of_impact(cast<Digits50>(q.a), cast<Digits50>(q.b)).time; });
  });
  if constexpr (std::is_same_v<A, Sphere<D>> && std::is_same_v<B, Sphere<D>>) {
    add_benchmark(row + "/interval", [set](benchmark::State& state) {
      time_queries(state, set(), [](const Query& q) { return interval_ball<Interval>(q.a, q.b); });
    });
    add_benchmark(row + "/interval_unprotected", [set](benchmark::State& state) {
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

int main(int argc, char** argv) { return run_benchmarks<TableReporter>(argc, argv); }
