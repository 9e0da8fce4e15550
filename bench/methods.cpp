/// What does each way to find a time of impact cost, and how wrong is it?
/// Every method of the list on the same queries, streamed from memory: 100 000 a set, half of them hits. Counters beside
/// the time: missed and false hits against the closed form in long double, and the largest error of the time of a hit,
/// in fractions of the step. `textbook` is the plain quadratic (spheres), the cost everybody knows.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace {

using namespace thinwall;

constexpr std::size_t query_count = 100'000;

/// A reproducible stream of uniform numbers in [0, 1): SplitMix64.
class Uniform {
 public:
  double operator()() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  double between(double low, double high) { return low + (high - low) * (*this)(); }
  Vec3<double> direction() {
    Vec3<double> v;
    do {
      v = {between(-1, 1), between(-1, 1), between(-1, 1)};
    } while (v.squaredNorm() > 1 || v.squaredNorm() < 0.01);
    return v / std::sqrt(v.squaredNorm());
  }

 private:
  std::uint64_t state_ = 1;
};

template <class A, class B> struct Query {
  Moving<A> a;
  Moving<B> b;
  Toi<long double> truth;
};

template <class A, class B> using Queries = std::vector<Query<A, B>>;

/// Fills the set with shots at `make_target`, alternating between hits and misses, apart at the start.
template <class A, class B, class MakeTarget> Queries<A, B> shots(MakeTarget make_target) {
  Uniform uniform;
  Queries<A, B> queries;
  while (queries.size() < query_count) {
    const double radius = uniform.between(0.02, 0.1);
    const Vec3<double> from = uniform.direction() * uniform.between(1, 3);
    const Vec3<double> aim = uniform.direction() * uniform.between(0, 1.5);
    const Vec3<double> drift = uniform.direction() * uniform.between(0, 2);
    const Moving<A> bullet{A{from, radius}, (aim - from) * uniform.between(0.5, 3) + drift};
    const Moving<B> target{make_target(uniform), drift};
    const auto truth = time_of_impact(cast<long double>(bullet), cast<long double>(target));
    const bool wanted = queries.size() % 2 == 0;
    if (separation(bullet.shape, target.shape).distance < 0.02 || (truth.status == ToiStatus::hit) != wanted) continue;
    queries.push_back({bullet, target, truth});
  }
  return queries;
}

const auto& at_thin_walls() {
  static const auto queries = shots<Sphere<double>, Aabb<double>>([](Uniform& uniform) {
    return Aabb<double>{uniform.direction() * 0.1, {uniform.between(0.001, 0.02), 0.7, 0.7}};
  });
  return queries;
}

const auto& at_spheres() {
  static const auto queries = shots<Sphere<double>, Sphere<double>>([](Uniform& uniform) {
    return Sphere<double>{uniform.direction() * 0.1, uniform.between(0.1, 0.5)};
  });
  return queries;
}

/// The quadratic of the textbooks, verdict and time only.
double textbook_time(const Moving<Sphere<double>>& a, const Moving<Sphere<double>>& b) {
  const Vec3<double> p = a.shape.center - b.shape.center, v = a.displacement - b.displacement;
  const double reach = a.shape.radius + b.shape.radius;
  const double A = v.dot(v), B = p.dot(v), C = p.dot(p) - reach * reach;
  const double D = B * B - A * C;
  return D < 0 ? 2 : (-B - std::sqrt(D)) / A;
}

template <class Set, class Answer> void run(benchmark::State& state, const Set& queries, Answer answer) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(answer(queries[i]));
    i = i + 1 == queries.size() ? 0 : i + 1;
  }
  double missed = 0, false_hits = 0, largest_error = 0;
  for (const auto& query : queries) {
    const double time = answer(query);
    const bool hit = time <= 1, truly = query.truth.status == ToiStatus::hit;
    missed += truly && !hit ? 1 : 0;
    false_hits += hit && !truly ? 1 : 0;
    if (hit && truly) largest_error = std::max(largest_error, std::abs(time - static_cast<double>(query.truth.time)));
  }
  state.counters["missed"] = missed;
  state.counters["false"] = false_hits;
  state.counters["max_error"] = largest_error;
}

template <class Set> void add(const std::string& set_name, const Set& (*queries)()) {
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    benchmark::RegisterBenchmark((set_name + "/" + std::string(Method::name)).c_str(),
                                 [queries](benchmark::State& state) {
                                   run(state, queries(), [](const auto& query) {
                                     const auto toi = time_of_impact(Method{}, query.a, query.b);
                                     return toi.status == ToiStatus::apart ? 2 : toi.time;
                                   });
                                 });
  });
}

const bool added = [] {
  add("sphere_thin_wall", &at_thin_walls);
  add("sphere_sphere", &at_spheres);
  benchmark::RegisterBenchmark("sphere_sphere/textbook", [](benchmark::State& state) {
    run(state, at_spheres(), [](const auto& query) { return textbook_time(query.a, query.b); });
  });
  return true;
}();

}  // namespace
