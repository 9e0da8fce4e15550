/// What does each pair cost through the front door, and against the plain closed form everybody writes first?
/// Every query returns its whole answer with its input checked; the kernel beneath gives verdict and time only. The table at
/// the end holds the ratios of this run, also to the measured floor: they carry from machine to machine, nanoseconds do not.
/// Counters: what is missed, what is hit in error, and the error of the time as a fraction of the step and as a length.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <thinwall/discrete/boxes/box_manifold.hpp>

#include "errors.hpp"
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

template <class Run> void add(const std::string& name, const Run& run) {
  benchmark::RegisterBenchmark(name.c_str(), run);
}

/// One way to answer a set of queries: `ask` is timed, `answer_of` gives its answer as the set's truth is given.
template <class Query, class Ask, class AnswerOf>
void add_timed(const std::string& name, const QuerySet<Query>& (*set)(), const Operations& least, Ask ask,
               AnswerOf answer_of) {
  const auto count = counted_once([set, answer_of] { return errors_of(set(), answer_of); });
  add(name, [set, least, ask, count](benchmark::State& state) {
    time_queries(state, set().queries, ask);
    count(state);
    add_query_floor(state, set().queries, least);
  });
}

/// Front door, kernel and plain form of one time of impact. `kernel` and `plain` return the time, or over 1 for a miss.
template <class A, class B, class Kernel, class Plain>
void add_impact(const std::string& pair, double goal, const Shots<A, B>& (*set)(), const Operations& least,
                Kernel kernel, Plain plain) {
  const std::string name = "time_of_impact/" + pair;
  rows.push_back({name, goal});
  using Query = Shot<A, B>;
  add_timed(
      name + "/front_door", set, least, [](const Query& q) { return time_of_impact(q.a, q.b); },
      [](const Query& q) {
        const auto toi = time_of_impact(q.a, q.b);
        return toi.status == ToiStatus::apart ? never : toi.time;
      });
  add_timed(name + "/kernel", set, least, kernel, kernel);
  add_timed(name + "/plain", set, least, plain, plain);
}

template <class B, class Plain>
void add_raycast(const std::string& shape, double goal, const Operations& least, Plain plain) {
  const std::string name = "raycast/" + shape;
  rows.push_back({name, goal});
  using Query = RayShot<B>;
  add_timed(
      name + "/front_door", &any_rays<B>, least, [](const Query& q) { return raycast(q.ray, q.shape); },
      [](const Query& q) {
        const auto hit = raycast(q.ray, q.shape);
        return hit ? hit->t : never;
      });
  const auto time_of = [plain](const Query& q) { return plain(q.ray, q.shape); };
  add_timed(name + "/plain", &any_rays<B>, least, time_of, time_of);
}

/// A query at one instant: `ask(a, b)`, and the depth in its answer, or `never`.
template <class A, class B, class Ask, class DepthOf>
void add_discrete(const std::string& what, double goal, Ask ask, DepthOf depth_of) {
  rows.push_back({what, goal});
  using Query = Pose<A, B>;
  add_timed(
      what + "/front_door", &any_poses<A, B>, {}, [ask](const Query& q) { return ask(q.a, q.b); },
      [ask, depth_of](const Query& q) { return depth_of(ask(q.a, q.b)); });
}

Vec3<D> between(const auto& q) { return center(q.a.shape) - center(q.b.shape); }
Vec3<D> motion(const auto& q) { return relative_displacement(q.a, q.b); }

const bool added = [] {
  using S = Sphere<D>;
  using A = Aabb<D>;
  using O = Obb<D>;
  using C = Capsule<D>;
  using T = Triangle<D>;
  const auto ball_at_box = [](const auto& q) {
    return rounded_box_entry<D>(between(q), motion(q), q.b.shape.half_extents, q.a.shape.radius).time;
  };
  const auto plain_ball_at_box = [](const auto& q) {
    return plain::rounded_box(between(q), motion(q), q.b.shape.half_extents, q.a.shape.radius);
  };
  add_impact<S, A>("sphere_thin_wall", 18, &thin_wall_shots, flat_hit, ball_at_box, plain_ball_at_box);
  add_impact<S, A>("sphere_aabb", 18, &any_shots<S, A>, flat_hit, ball_at_box, plain_ball_at_box);
  add_impact<S, S>(
      "sphere_sphere", 13, &any_shots<S, S>, round_hit,
      [](const auto& q) { return ball_entry<D>(between(q), motion(q), q.a.shape.radius + q.b.shape.radius).time; },
      [](const auto& q) { return plain::ball(between(q), motion(q), q.a.shape.radius + q.b.shape.radius); });
  add_impact<A, A>(
      "aabb_aabb", 7, &any_shots<A, A>, flat_hit,
      [](const auto& q) {
        return rounded_box_entry<D>(between(q), motion(q), q.a.shape.half_extents + q.b.shape.half_extents, 0).time;
      },
      [](const auto& q) {
        return plain::slabs(between(q), motion(q), q.a.shape.half_extents + q.b.shape.half_extents);
      });
  add_impact<S, C>(
      "sphere_capsule", 30, &any_shots<S, C>, round_hit,
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
      "capsule_aabb", 40, &any_shots<C, A>, flat_hit,
      [](const auto& q) {
        return capsule_box_entry<D>(q.a.shape.a - q.b.shape.center, motion(q), q.a.shape.radius,
                                    q.a.shape.b - q.a.shape.a, q.b.shape.half_extents)
            .time;
      },
      [](const auto& q) { return plain::bisection(q.a, q.b); });
  add_impact<A, O>(
      "aabb_obb", 40, &any_shots<A, O>, flat_hit,
      [](const auto& q) {
        MovingBoxPair<D> moving{box_pair(q.a.shape, q.b.shape), -motion(q), into<D>(q.b.shape, -between(q)),
                                into<D>(q.b.shape, -motion(q))};
        return boxes_entry<D>(moving, 0).time;
      },
      [](const auto& q) { return plain::boxes(to_obb(q.a.shape), q.b.shape, -motion(q)); });
  add_impact<S, T>(
      "sphere_triangle", 50, &any_shots<S, T>, flat_hit,
      [](const auto& q) {
        const T& t = q.b.shape;
        return sphere_triangle_entry<D>(q.a.shape.center - t.a, motion(q), q.a.shape.radius, t.b - t.a, t.c - t.a).time;
      },
      [](const auto& q) { return plain::rounded_triangle(q.a.shape.center, motion(q), q.b.shape, q.a.shape.radius); });

  add_raycast<S>("sphere", 11, round_hit,
                 [](const Ray<D>& r, const S& s) { return plain::ball(r.origin - s.center, r.direction, s.radius); });
  add_raycast<A>("aabb", 8, flat_hit, [](const Ray<D>& r, const A& b) {
    return plain::slabs(r.origin - b.center, r.direction, b.half_extents);
  });
  add_raycast<O>("obb", 9, flat_hit, [](const Ray<D>& r, const O& b) {
    return plain::slabs(into<D>(b, r.origin - b.center), into(b, r.direction), b.half_extents);
  });
  add_raycast<C>("capsule", 28, round_hit, [](const Ray<D>& r, const C& c) {
    return plain::rounded_segment(r.origin - c.a, r.direction, c.b - c.a, c.radius);
  });
  add_raycast<T>("triangle", 14, flat_hit,
                 [](const Ray<D>& r, const T& t) { return plain::triangle(r.origin, r.direction, t); });

  const auto ask_contact = [](const auto& a, const auto& b) { return contact(a, b); };
  const auto depth_of_contact = [](const auto& found) { return found ? found->penetration : never; };
  add_discrete<S, S>("contact/sphere_sphere", 6, ask_contact, depth_of_contact);
  add_discrete<A, A>("contact/aabb_aabb", 8, ask_contact, depth_of_contact);
  add_discrete<S, A>("contact/sphere_aabb", 10, ask_contact, depth_of_contact);
  add_discrete<C, C>("contact/capsule_capsule", 15, ask_contact, depth_of_contact);
  add_discrete<O, O>(
      "manifold/obb_obb", 120, [](const O& a, const O& b) { return manifold(a, b); },
      [](const auto& found) {
        double depth = found.empty() ? never : 0;
        for (const auto& point : found) depth = std::max(depth, point.penetration);
        return depth;
      });
  add_discrete<O, O>(
      "overlaps/obb_obb", 14, [](const O& a, const O& b) { return overlaps(a, b); },
      [](bool overlap) { return overlap ? -1 : never; });

  // What it costs to write a whole Toi where a time would do: the floor of every front door.
  add("stream_toi", [](benchmark::State& state) {
    const auto& queries = any_shots<S, S>().queries;
    time_queries(state, queries, [](const auto& q) {
      return Toi<D>{ToiStatus::hit, 1, q.a.shape.radius, q.a.displacement, q.b.displacement};
    });
    add_query_floor(state, queries, {});
  });
  return true;
}();

class TableReporter : public MedianTimes {
 public:
  void Finalize() override {
    std::printf("\n%-36s %10s %10s %10s %9s %9s %9s %6s\n", "[ns, this run]", "front door", "kernel", "plain",
                "to kernel", "to plain", "to floor", "goal");
    for (const Row& row : rows) {
      const double front = time(row.name + "/front_door"), kernel = time(row.name + "/kernel");
      const double form = time(row.name + "/plain");
      if (front == 0) continue;
      std::printf("%-36s %10.1f %10.1f %10.1f %9.2f %9.2f %9.1f %6.0f\n", row.name.c_str(), front, kernel, form,
                  kernel > 0 ? front / kernel : 0, form > 0 ? front / form : 0, to_floor(row.name + "/front_door"),
                  row.goal);
    }
    std::printf("Floor: to read a query where so many stay, or a hit's division and square root, whichever is more.\n");
    std::printf("Goals are for one core of a 3.6 GHz Zen 5 EPYC. 0.0: not measured, or there is none.\n");
  }
};

}  // namespace

int main(int argc, char** argv) {
  TableReporter reporter;
  return run_benchmarks(argc, argv, reporter);
}
