/// What does a row cost in a batch, beside the scalar code, at every width of vector, in the first cache and from memory?
/// One obstacle against many moving shapes, three in ten of them hits, and pairs row by row. Rows that rounding might turn are
/// asked again in scalar code, and their share is a counter. The floor of a row in the first cache is that of the divisions and
/// square roots of scalar code (floors.hpp), which vectors may go below; from memory it is the time to stream its bytes,
/// measured in the same run.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

#include <thinwall/swept/batch.hpp>
#include <thinwall/swept/batch/run.hpp>
#include <thinwall/swept/batch/table.hpp>
#include <thinwall/swept/certified_batch.hpp>

#include "floors.hpp"
#include "query_sets.hpp"

namespace {

using namespace thinwall;
using namespace thinwall::bench;

constexpr std::size_t few_rows = 512;        // answers and all lie in the first cache
constexpr std::size_t many_rows = 1U << 21;  // and here in none

/// One shape of a size of about half against many, aimed so that three in ten hit.
template <class A, class B> struct BatchSet {
  using S = typename A::Scalar;
  Moving<A> obstacle;
  RowTable<Moving<A>> obstacles;  ///< the same for every row
  RowTable<Moving<B>> rows;
  double hits = 0;  ///< [1] share of the rows

  explicit BatchSet(std::size_t count) {
    using DoubleA = decltype(cast<double>(std::declval<A>()));
    using DoubleB = decltype(cast<double>(std::declval<B>()));
    Uniform uniform;
    obstacle = at_rest(cast<S>(any_shape<DoubleA>(uniform)));
    obstacles.reserve(count);
    rows.reserve(count);
    std::size_t hit_rows = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const bool wants_hit = uniform() < 0.3;
      for (;;) {
        const Vec3<double> from = uniform.direction() * uniform.between(1.5, 3);
        const Vec3<double> aim = uniform.direction() * uniform.between(0, 2);
        const Moving<DoubleB> ball{moved<double>(any_shape<DoubleB>(uniform), from),
                                   (aim - from) * uniform.between(0.5, 3)};
        const Moving<B> row = cast<S>(ball);
        const ToiStatus status = time_of_impact(obstacle, row).status;
        if (status == ToiStatus::overlapping || (status == ToiStatus::hit) != wants_hit) continue;
        obstacles.push_back(obstacle);
        rows.push_back(row);
        if (wants_hit) ++hit_rows;
        break;
      }
    }
    hits = static_cast<double>(hit_rows) / static_cast<double>(count);
  }
};

template <class A, class B> const BatchSet<A, B>& batch_set(std::size_t count) {
  static const BatchSet<A, B> few(few_rows), many(many_rows);
  return count == few_rows ? few : many;
}

/// [ns] to stream a row of so many scalars in, and a time and a status out.
template <class S> double stream_ns(std::size_t columns) {
  return floors().stream_row_ns / 64 * static_cast<double>((columns + 1) * sizeof(S) + sizeof(ToiStatus));
}

/// The counters of a benchmark of so many rows; what a row needs at least in the first cache, and to be streamed.
void count_rows(benchmark::State& state, std::size_t count, const BatchReport& report, double hits,
                const Operations& least, double streamed_ns) {
  const double rows = static_cast<double>(count);
  state.counters["ns_row"] =
      benchmark::Counter(1e-9 * rows, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["asked_again"] = static_cast<double>(report.asked_again) / rows;
  state.counters["hits"] = hits;
  add_floor(state, rows * (count == few_rows ? least.floor_ns() : streamed_ns), rows);
}

/// Times `by_batch()`, or else `row(i)` of each row; what the batch reports.
template <class ByBatch, class Row>
BatchReport time_rows(benchmark::State& state, bool is_batch, std::size_t count, const ByBatch& by_batch,
                      const Row& row) {
  BatchReport report;
  for (auto _ : state) {
    if (is_batch) {
      report = by_batch();
    } else {
      for (std::size_t i = 0; i < count; ++i) row(i);
    }
    benchmark::ClobberMemory();
  }
  return report;
}

enum class Way { scalar, one_to_many, row_by_row };

template <class A, class B>
void time_batch(benchmark::State& state, Way way, std::size_t count, const std::string& target, const Operations& least,
                int threads) {
  using S = typename A::Scalar;
  const std::size_t columns = (way == Way::row_by_row ? batch::width<Moving<A>> : 0) + batch::width<Moving<B>>;
  const BatchSet<A, B>& set = batch_set<A, B>(count);
  std::vector<ToiStatus> status(count);
  std::vector<S> time(count);
  const ToiRows<S> out{status, time};
  use_vectors(target);
  const auto by_batch = [&] {
    if (way == Way::one_to_many) return time_of_impact(set.obstacle, set.rows.rows(), out, {threads});
    return time_of_impact(set.obstacles.rows(), set.rows.rows(), out, {threads});
  };
  const BatchReport report = time_rows(state, way != Way::scalar, count, by_batch, [&](std::size_t i) {
    const Toi<S> toi = time_of_impact(set.obstacle, set.rows[i]);
    status[i] = toi.status;
    time[i] = toi.time;
  });
  use_vectors("");
  count_rows(state, count, report, set.hits, least, stream_ns<S>(columns));
}

/// The same of certified spheres.
void time_certified(benchmark::State& state, bool by_vectors, std::size_t count) {
  const auto& set = batch_set<Sphere<double>, Sphere<double>>(count);
  std::vector<ToiStatus> verdict(count);
  std::vector<double> lower(count), upper(count);
  const auto by_batch = [&] {
    return certified_time_of_impact(set.obstacle, set.rows.rows(), {verdict, lower, upper});
  };
  const BatchReport report = time_rows(state, by_vectors, count, by_batch, [&](std::size_t i) {
    const CertifiedToi toi = certified_time_of_impact(set.obstacle, set.rows[i]);
    verdict[i] = toi.verdict;
    lower[i] = toi.lower;
    upper[i] = toi.upper;
  });
  count_rows(state, count, report, set.hits, {2, 2}, stream_ns<double>(8));
}

template <class A, class B> void add(const std::string& pair, const Operations& least) {
  const std::string scalar = sizeof(typename A::Scalar) == 8 ? "f64" : "f32";
  const auto add_one = [&](const std::string& name, Way way, std::size_t count, const std::string& target,
                           int threads) {
    const std::string where = count == few_rows ? "cache" : "memory";
    auto* const row = benchmark::RegisterBenchmark(
        (pair + "/" + scalar + "/" + where + "/" + name).c_str(),
        [=](benchmark::State& state) { time_batch<A, B>(state, way, count, target, least, threads); });
    if (threads > 1) row->UseRealTime();
  };
  for (const std::size_t count : {few_rows, many_rows}) {
    add_one("scalar", Way::scalar, count, "", 1);
    for (const std::string& target : vector_targets()) add_one(target, Way::one_to_many, count, target, 1);
    add_one("row_by_row", Way::row_by_row, count, "", 1);
  }
  add_one("two_threads", Way::one_to_many, many_rows, "", 2);
}

/// Rays along the ways of the spheres, at the box.
template <class S> void time_rays(benchmark::State& state, bool by_vectors, std::size_t count) {
  const auto& set = batch_set<Aabb<S>, Sphere<S>>(count);
  RowTable<Ray<S>> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const auto ball = set.rows[i];
    rays.push_back({ball.shape.center, ball.displacement, S(1)});
  }
  std::vector<ToiStatus> status(count);
  std::vector<S> time(count);
  const auto by_batch = [&] { return raycast(rays.rows(), set.obstacle.shape, ToiRows<S>{status, time}); };
  const BatchReport report = time_rows(state, by_vectors, count, by_batch, [&](std::size_t i) {
    const auto hit = raycast(rays[i], set.obstacle.shape);
    time[i] = hit ? hit->t : S(1);
  });
  const auto hits = static_cast<double>(std::count(status.begin(), status.end(), ToiStatus::hit));
  count_rows(state, count, report, hits / static_cast<double>(count), {3, 0}, stream_ns<S>(7));
}

void add_rays_and_certified() {
  for (const std::size_t count : {few_rows, many_rows}) {
    for (const bool by_vectors : {false, true}) {
      const std::string way = (count == few_rows ? "cache/" : "memory/") + (by_vectors ? vectors_in_use() : "scalar");
      const std::string name = "certified_sphere_sphere/f64/" + way;
      benchmark::RegisterBenchmark(name.c_str(),
                                   [=](benchmark::State& state) { time_certified(state, by_vectors, count); });
      benchmark::RegisterBenchmark(("ray_aabb/f64/" + way).c_str(),
                                   [=](benchmark::State& state) { time_rays<double>(state, by_vectors, count); });
      benchmark::RegisterBenchmark(("ray_aabb/f32/" + way).c_str(),
                                   [=](benchmark::State& state) { time_rays<float>(state, by_vectors, count); });
    }
  }
}

template <class S> void add_pairs() {
  add<Sphere<S>, Sphere<S>>("sphere_sphere", {1, 1});
  add<Aabb<S>, Sphere<S>>("aabb_sphere", {3, 0.2});
  add<Obb<S>, Sphere<S>>("obb_sphere", {3, 0.2});
  add<Capsule<S>, Sphere<S>>("capsule_sphere", {2, 2});
  add<Aabb<S>, Aabb<S>>("aabb_aabb", {3, 0});
}

}  // namespace

int main(int argc, char** argv) {
  add_pairs<double>();
  add_rays_and_certified();
  add_pairs<float>();
  return run_benchmarks(argc, argv);
}
