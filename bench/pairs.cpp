/// What does each pair cost through the front door, and against the plain closed form everybody writes first?
/// Every query returns its whole answer with its input checked; the kernel beneath gives verdict and time only. The table at
/// the end holds the ratios of this run: they carry from machine to machine, nanoseconds do not.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <thinwall/discrete/boxes/box_manifold.hpp>

#include "median_times.hpp"
#include "plain_forms.hpp"

namespace {

using namespace thinwall;
using namespace thinwall::bench;
using D = double;

/// A row of the closing table: medians [ns] by column name, filled in as the benchmarks report.
struct Row {
  std::string name;
  double goal = 0;  ///< [ns] on the reference machine
};
std::vector<Row> rows;

template <class Set, class TimeOf> void time_queries(benchmark::State& state, const Set& set, const TimeOf& time_of) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(time_of(set.queries[i]));
    i = i + 1 == query_count ? 0 : i + 1;
  }
}

/// Counts what `time_of` gets wrong on the whole set.
template <class Set, class TimeOf> void count_errors(benchmark::State& state, const Set& set, const TimeOf& time_of) {
  double missed = 0, false_hits = 0;
  std::vector<double> errors;
  for (std::size_t k = 0; k < query_count; ++k) {
    const double time = time_of(set.queries[k]);
    const bool hit = time <= 1, truly = set.truth[k] <= 1;
    missed += truly && !hit ? 1 : 0;
    false_hits += hit && !truly ? 1 : 0;
    if (hit && truly) errors.push_back(std::abs(time - set.truth[k]));
  }
  std::sort(errors.begin(), errors.end());
  state.counters["missed"] = missed;
  state.counters["false"] = false_hits;
  state.counters["p99_error"] = errors.empty() ? 0 : errors[errors.size() * 99 / 100];
  state.counters["max_error"] = errors.empty() ? 0 : errors.back();
}

template <class Run> void add(const std::string& name, const Run& run) {
  benchmark::RegisterBenchmark(name.c_str(), run);
}

/// Front door, kernel and plain form of one time of impact. `kernel` and `plain` return the time, or over 1 for a miss.
template <class A, class B, class Kernel, class Plain>
void add_impact(const std::string& pair, double goal, const Shots<A, B>& (*set)(), Kernel kernel, Plain plain) {
  const std::string name = "time_of_impact/" + pair;
  rows.push_back({name, goal});
  using Query = Shot<A, B>;
  add(name + "/front_door", [set](benchmark::State& state) {
    time_queries(state, set(), [](const Query& q) { return time_of_impact(q.a, q.b); });
    count_errors(state, set(), [](const Query& q) {
      const auto toi = time_of_impact(q.a, q.b);
      return toi.status == ToiStatus::apart ? never : toi.time;
    });
  });
  add(name + "/kernel", [set, kernel](benchmark::State& state) {
    time_queries(state, set(), kernel);
    count_errors(state, set(), kernel);
  });
  add(name + "/plain", [set, plain](benchmark::State& state) {
    time_queries(state, set(), plain);
    count_errors(state, set(), plain);
  });
}

/// A ray along each query's motion, from the center of A.
template <class A, class B, class Plain>
void add_raycast(const std::string& shape, double goal, const Shots<A, B>& (*set)(), Plain plain) {
  const std::string name = "raycast/" + shape;
  rows.push_back({name, goal});
  using Query = Shot<A, B>;
  const auto ray = [](const Query& q) { return Ray<D>{center(q.a.shape), relative_displacement(q.a, q.b), 1}; };
  add(name + "/front_door", [set, ray](benchmark::State& state) {
    time_queries(state, set(), [ray](const Query& q) { return raycast(ray(q), q.b.shape); });
  });
  add(name + "/plain", [set, ray, plain](benchmark::State& state) {
    time_queries(state, set(), [ray, plain](const Query& q) { return plain(ray(q), q.b.shape); });
  });
}

/// A query at one instant, at the pose of first contact for the shots that hit.
template <class A, class B, class Ask>
void add_discrete(const std::string& what, double goal, const Shots<A, B>& (*set)(), Ask ask) {
  const std::string name = "discrete/" + what;
  rows.push_back({name, goal});
  add(name + "/front_door", [set, ask](benchmark::State& state) {
    static std::vector<std::pair<A, B>> poses;
    if (poses.empty()) {
      for (std::size_t k = 0; k < query_count; ++k) {
        const auto& q = set().queries[k];
        const double time = std::min(1.0, set().truth[k] * 1.05);  // half of them a little inside
        poses.push_back({pose_at(q.a, time), pose_at(q.b, time)});
      }
    }
    std::size_t i = 0;
    for (auto _ : state) {
      benchmark::DoNotOptimize(ask(poses[i].first, poses[i].second));
      i = i + 1 == query_count ? 0 : i + 1;
    }
  });
}

Vec3<D> between(const auto& q) { return center(q.a.shape) - center(q.b.shape); }
Vec3<D> motion(const auto& q) { return relative_displacement(q.a, q.b); }

const bool added = [] {
  using S = Sphere<D>;
  using A = Aabb<D>;
  using O = Obb<D>;
  using C = Capsule<D>;
  using T = Triangle<D>;
  add_impact<S, A>(
      "sphere_aabb", 18, &any_shots<S, A>,
      [](const auto& q) {
        return rounded_box_entry<D>(between(q), motion(q), q.b.shape.half_extents, q.a.shape.radius).time;
      },
      [](const auto& q) {
        return plain::rounded_box(between(q), motion(q), q.b.shape.half_extents, q.a.shape.radius);
      });
  add_impact<S, S>(
      "sphere_sphere", 13, &any_shots<S, S>,
      [](const auto& q) { return ball_entry<D>(between(q), motion(q), q.a.shape.radius + q.b.shape.radius).time; },
      [](const auto& q) { return plain::ball(between(q), motion(q), q.a.shape.radius + q.b.shape.radius); });
  add_impact<A, A>(
      "aabb_aabb", 7, &any_shots<A, A>,
      [](const auto& q) {
        return rounded_box_entry<D>(between(q), motion(q), q.a.shape.half_extents + q.b.shape.half_extents, 0).time;
      },
      [](const auto& q) {
        return plain::slabs(between(q), motion(q), q.a.shape.half_extents + q.b.shape.half_extents);
      });
  add_impact<S, C>(
      "sphere_capsule", 30, &any_shots<S, C>,
      [](const auto& q) {
        return rounded_segment_entry<D>(q.a.shape.center - q.b.shape.a, motion(q), q.b.shape.b - q.b.shape.a,
                                        q.a.shape.radius + q.b.shape.radius)
            .time;
      },
      [](const auto& q) {
        return plain::rounded_segment(q.a.shape.center - q.b.shape.a, motion(q), q.b.shape.b - q.b.shape.a,
                                      q.a.shape.radius + q.b.shape.radius);
      });
  add_impact<C, A>(
      "capsule_aabb", 40, &any_shots<C, A>,
      [](const auto& q) {
        return capsule_box_entry<D>(q.a.shape.a - q.b.shape.center, motion(q), q.a.shape.radius,
                                    q.a.shape.b - q.a.shape.a, q.b.shape.half_extents)
            .time;
      },
      [](const auto& q) { return plain::bisection(q.a, q.b); });
  add_impact<A, O>(
      "aabb_obb", 40, &any_shots<A, O>,
      [](const auto& q) {
        MovingBoxPair<D> moving{box_pair(q.a.shape, q.b.shape), -motion(q), into<D>(q.b.shape, -between(q)),
                                into<D>(q.b.shape, -motion(q))};
        return boxes_entry<D>(moving, 0).time;
      },
      [](const auto& q) { return plain::boxes(to_obb(q.a.shape), q.b.shape, -motion(q)); });
  add_impact<S, T>(
      "sphere_triangle", 50, &any_shots<S, T>,
      [](const auto& q) {
        const T& t = q.b.shape;
        return sphere_triangle_entry<D>(q.a.shape.center - t.a, motion(q), q.a.shape.radius, t.b - t.a, t.c - t.a).time;
      },
      [](const auto& q) { return plain::rounded_triangle(q.a.shape.center, motion(q), q.b.shape, q.a.shape.radius); });

  add_raycast<S, S>("sphere", 11, &any_shots<S, S>, [](const Ray<D>& r, const S& s) {
    return plain::ball(r.origin - s.center, r.direction, s.radius);
  });
  add_raycast<S, A>("aabb", 8, &any_shots<S, A>, [](const Ray<D>& r, const A& b) {
    return plain::slabs(r.origin - b.center, r.direction, b.half_extents);
  });
  add_raycast<S, O>("obb", 9, &any_shots<S, O>, [](const Ray<D>& r, const O& b) {
    return plain::slabs(into<D>(b, r.origin - b.center), into(b, r.direction), b.half_extents);
  });
  add_raycast<S, C>("capsule", 28, &any_shots<S, C>, [](const Ray<D>& r, const C& c) {
    return plain::rounded_segment(r.origin - c.a, r.direction, c.b - c.a, c.radius);
  });
  add_raycast<S, T>("triangle", 14, &any_shots<S, T>,
                    [](const Ray<D>& r, const T& t) { return plain::triangle(r.origin, r.direction, t); });

  const auto ask_contact = [](const auto& a, const auto& b) { return contact(a, b); };
  add_discrete<S, S>("sphere_sphere_contact", 6, &any_shots<S, S>, ask_contact);
  add_discrete<A, A>("aabb_aabb_contact", 8, &any_shots<A, A>, ask_contact);
  add_discrete<S, A>("sphere_aabb_contact", 10, &any_shots<S, A>, ask_contact);
  add_discrete<O, O>("obb_obb_overlaps", 14, &any_shots<O, O>, [](const O& a, const O& b) { return overlaps(a, b); });
  add_discrete<O, O>("obb_obb_manifold", 120, &any_shots<O, O>, [](const O& a, const O& b) { return manifold(a, b); });
  add_discrete<C, C>("capsule_capsule_contact", 15, &any_shots<C, C>, ask_contact);

  // What it costs to write a whole Toi where a time would do: the floor of every front door.
  add("stream_toi", [](benchmark::State& state) {
    time_queries(state, any_shots<S, S>(), [](const auto& q) {
      return Toi<D>{ToiStatus::hit, 1, q.a.shape.radius, q.a.displacement, q.b.displacement};
    });
  });
  return true;
}();

class TableReporter : public MedianTimes {
 public:
  void Finalize() override {
    std::printf("\n%-36s %10s %10s %10s %9s %9s %6s\n", "[ns, this run]", "front door", "kernel", "plain", "to kernel",
                "to plain", "goal");
    for (const Row& row : rows) {
      const double front = time(row.name + "/front_door"), kernel = time(row.name + "/kernel");
      const double form = time(row.name + "/plain");
      if (front == 0) continue;
      std::printf("%-36s %10.1f %10.1f %10.1f %9.2f %9.2f %6.0f\n", row.name.c_str(), front, kernel, form,
                  kernel > 0 ? front / kernel : 0, form > 0 ? front / form : 0, row.goal);
    }
    std::printf("Goals are for one core of a 3.6 GHz Zen 5 EPYC. 0.0: not measured, or there is none.\n");
  }
};

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  TableReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
}
