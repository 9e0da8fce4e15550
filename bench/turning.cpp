/// What does a time of impact of shapes that turn cost, how wrong is it, and how many looks at the closest points does it take?
/// Every method of the list on the same queries, spinning up to a quarter turn a step, half of them hits; and beside them conservative advancement
/// with Mirtich's bound, the usual one: gap over the fastest point's speed. Counters: missed and false hits and errors of the time against the
/// proven brackets, and the mean of the looks. Run one pair by --benchmark_filter=capsule_capsule.

#include <benchmark/benchmark.h>

#include <string>

#include <thinwall/swept/certified/turning_certified.hpp>

#include "query_sets.hpp"

namespace thinwall::bench {

/// Two bodies that fly and spin, both up to a quarter turn.
template <class A, class B> struct Spin {
  Turning<A> a;
  Turning<B> b;
};
template <class A, class B> double last_hit(const Spin<A, B>&) { return 1; }
template <class A, class B> double unit_length(const Spin<A, B>& q) { return TurningPair<double>(q.a, q.b, 0).speed; }

/// Mirtich's: the gap shrinks along its normal no faster than the paths do along it and the farthest points turn.
template <Scalar S> struct MirtichAdvancement {
  static constexpr std::string_view name = "mirtich";
  S tolerance = half_digits<S>();
  int max_evaluations = 10'000;
  S min_separation = 0;
};
template <Scalar S, Shape A, Shape B>
Toi<double> impact(const MirtichAdvancement<S>& method, const Turning<A>& a, const Turning<B>& b) {
  const TurningPair<double> pair(a, b, 0);
  const double near = method.tolerance * pair.speed;
  double time = 0;
  for (int k = 1; k <= method.max_evaluations; ++k) {
    const Separation<double> closest = separation_unchecked(pose_at(a, time), pose_at(b, time));
    if (closest.distance <= near) return {ToiStatus::hit, k, time, closest.normal, middle(closest)};
    const double closing =
        pair.a.angle * pair.a.off_axis + pair.b.angle * pair.b.off_axis - closest.normal.dot(pair.path);
    if (!(closing > 0) || time + closest.distance / closing > 1) return {ToiStatus::apart, k};
    time += closest.distance / closing;
  }
  return {ToiStatus::gave_up, method.max_evaluations, time};
}

constexpr std::size_t spin_count = 20'000;

/// Drawn until half of them hit, the proven verdict deciding.
template <class A, class B> const QuerySet<Spin<A, B>>& any_spins() {
  static const QuerySet<Spin<A, B>> set = [] {
    Uniform uniform;
    QuerySet<Spin<A, B>> drawn;
    std::size_t hits = 0;
    while (drawn.queries.size() < spin_count) {
      Spin<A, B> q{{any_shape<A>(uniform), {}, {}}, {any_shape<B>(uniform), {}, {}}};
      const Vec3<double> start = uniform.direction() * uniform.between(0.5, 3),
                         aim = uniform.direction() * uniform.between(0, 1);
      q.a.shape = moved(q.a.shape, start);
      q.a.displacement = (aim - start) * uniform.between(0, 2);
      q.b.displacement = Vec3<double>::Zero();
      constexpr double quarter_turn = 1.5707963267948966;
      q.a.rotation = uniform.direction() * uniform.between(0, quarter_turn);
      q.b.rotation = uniform.direction() * uniform.between(0, quarter_turn);
      const CertifiedToi proven = certified_time_of_impact(q.a, q.b);
      if (proven.verdict != ToiStatus::hit && proven.verdict != ToiStatus::apart) continue;
      const bool hit = proven.verdict == ToiStatus::hit;
      if (hit ? 2 * hits >= spin_count : 2 * (drawn.queries.size() - hits) >= spin_count) continue;
      hits += hit ? 1 : 0;
      drawn.queries.push_back(q);
      drawn.truth.push_back(hit ? (proven.lower + proven.upper) / 2 : never);
    }
    return drawn;
  }();
  return set;
}

template <class Method, class A, class B>
void add_method(const std::string& pair, const std::string& shown, const Method& method) {
  const auto set = &any_spins<A, B>;
  const auto ask = [method](const Spin<A, B>& q) { return time_of(time_of_impact(method, q.a, q.b)); };
  const auto count = counted_once([set, ask] { return errors_of(set(), ask); });
  benchmark::RegisterBenchmark(("turning/" + pair + "/" + shown).c_str(), [=](benchmark::State& state) {
    time_queries(state, set().queries, ask);
    count(state);
    double looks = 0;
    for (const Spin<A, B>& q : set().queries) looks += time_of_impact(method, q.a, q.b).evaluations;
    state.counters["looks"] = looks / static_cast<double>(set().queries.size());
  });
}

template <class A, class B> void add_pair(const std::string& pair) {
  constexpr double tolerance = 1e-6;  // [1] of the step
  for_each_type(TurningMethods<double>{}, [&]<class Method>(TypeTag<Method>) {
    Method method;
    if constexpr (requires { method.tolerance; }) method.tolerance = tolerance;
    add_method<Method, A, B>(pair, std::string(Method::name), method);
  });
  MirtichAdvancement<double> mirtich;
  mirtich.tolerance = tolerance;
  add_method<MirtichAdvancement<double>, A, B>(pair, std::string(mirtich.name), mirtich);
}

const bool added = [] {
  using Ball = Sphere<double>;
  using Rod = Capsule<double>;
  using Box = Obb<double>;
  add_pair<Rod, Ball>("sphere_capsule");
  add_pair<Box, Ball>("sphere_obb");
  add_pair<Rod, Rod>("capsule_capsule");
  add_pair<Rod, Box>("capsule_obb");
  add_pair<Box, Box>("obb_obb");
  add_pair<Triangle<double>, Ball>("sphere_triangle");
  add_pair<Rod, Triangle<double>>("capsule_triangle");
  return true;
}();

}  // namespace thinwall::bench

int main(int argc, char** argv) { return thinwall::bench::run_benchmarks(argc, argv); }
