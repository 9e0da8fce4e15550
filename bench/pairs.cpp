/// What does each pair cost through the front door, and against the plain closed form everybody writes first?
/// Every query returns its whole answer with its input checked, by the ladder; beside it the careful rung alone, and what share of the
/// queries the clear rung decides. The table at the end holds the ratios of this run, also to the measured floor: they carry from machine
/// to machine, nanoseconds do not.
/// Counters: what is missed, what is hit in error, and the error of the time as a fraction of the step and as a length.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <thinwall/discrete/boxes/box_manifold.hpp>
#include <thinwall/experiments/models/textbook.hpp>

#include "query_sets.hpp"

namespace {

using namespace thinwall;
using namespace thinwall::bench;
using D = double;

/// The plain forms that everybody writes first, beside those of the textbook: no checks, no rescaling, verdict and time only, infinity for
/// a miss. They are what the library's speed is held against, and their errors are counted beside it.
///
/// Source: Moeller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997. Written from the formulas.
namespace plain {

using Vec = Vec3<D>;

/// First t at which a ray meets a triangle.
double triangle(const Vec& origin, const Vec& direction, const Triangle<D>& t) {
  const Vec e1 = t.b - t.a, e2 = t.c - t.a, q = cross(direction, e2);
  const double determinant = e1.dot(q);
  if (determinant == 0) return never;
  const Vec s = origin - t.a, r = cross(s, e1);
  const double u = s.dot(q) / determinant, w = direction.dot(r) / determinant, time = e2.dot(r) / determinant;
  return u >= 0 && w >= 0 && u + w <= 1 && time >= 0 ? time : never;
}

/// First t >= 0 at which a moving sphere touches a triangle: the two faces moved out by R, else the three edges.
double rounded_triangle(const Vec& p, const Vec& v, const Triangle<D>& t, double R) {
  const Vec n = safe_unit(cross<D>(t.b - t.a, t.c - t.a));
  const double face = triangle(p - n * ((p - t.a).dot(n) < 0 ? -R : R), v, t);
  if (face != never) return face;
  return std::min({textbook::rounded_segment<D>(p - t.a, v, t.b - t.a, R),
                   textbook::rounded_segment<D>(p - t.b, v, t.c - t.b, R),
                   textbook::rounded_segment<D>(p - t.c, v, t.a - t.c, R)});
}

/// First t in [0, 1] at which the separation of two shapes is no more than zero: sampled, then bisected.
template <class A, class B> double bisection(const Moving<A>& a, const Moving<B>& b) {
  const auto gap = [&](double t) { return separation(pose_at(a, t), pose_at(b, t)).distance; };
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {  // the separation is convex: first to its minimum, by thirds
    const double third = (high - low) / 3, left = gap(low + third), right = gap(high - third);
    if (left <= 0 || right <= 0) {
      high = left <= 0 ? low + third : high - third;
      break;
    }
    (left < right ? high : low) = left < right ? high - third : low + third;
  }
  if (gap(high) > 0) return never;
  for (low = 0; high - low > 1e-15;) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    (gap(middle) > 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace plain

/// A row of the closing table: medians [ns] by column name, filled in as the benchmarks report.
struct Row {
  std::string name;
  double goal = 0;                ///< [ns] on the reference machine
  std::function<double()> clear;  ///< [1] the share of the queries that the clear rung decides
};
std::vector<Row> rows;

/// The share of a set's queries of which is_clear() says so.
template <class Query, class IsClear>
std::function<double()> share_of(const QuerySet<Query>& (*set)(), const IsClear& is_clear) {
  return [set, is_clear] {
    const auto& queries = set().queries;
    return static_cast<double>(std::count_if(queries.begin(), queries.end(), is_clear)) / query_count;
  };
}

/// ask(a, b) with the shape of later rank first, as the rungs are asked.
template <class A, class B, class Ask> auto in_order(const Shot<A, B>& q, const Ask& ask) {
  if constexpr (A::rank < B::rank) {
    return ask(q.b, q.a);
  } else {
    return ask(q.a, q.b);
  }
}

/// The front door, asked the same in float: it answers in double.
template <class A, class B> void add_in_float(const std::string& name, const Shots<A, B>& (*set)()) {
  const auto in_float = [](const Shot<A, B>& q) { return std::pair(cast<float>(q.a), cast<float>(q.b)); };
  const auto count = counted_once([set, in_float] {
    return errors_of(set(), [in_float](const Shot<A, B>& q) {
      const auto [a, b] = in_float(q);
      return time_of(time_of_impact(a, b));
    });
  });
  add_benchmark(name, [set, in_float, count](benchmark::State& state) {
    std::vector<decltype(in_float(set().queries[0]))> queries;
    std::ranges::transform(set().queries, std::back_inserter(queries), in_float);
    time_queries(state, queries, [](const auto& q) { return time_of_impact(q.first, q.second); });
    count(state);
  });
}

/// Front door, careful rung and plain form of one time of impact. `plain` returns the time, or over 1 for a miss.
template <class A, class B, class Plain>
void add_impact(const std::string& pair, double goal, const Shots<A, B>& (*set)(), const Operations& least,
                Plain plain) {
  const std::string name = "time_of_impact/" + pair;
  using Query = Shot<A, B>;
  rows.push_back({name, goal, share_of<Query>(set, [](const Query& q) {
                    return in_order(q, [](const auto& a, const auto& b) { return clear_impact(a, b, 0).clear; });
                  })});
  add_timed(name + "/front_door", set, least, [](const Query& q) { return time_of_impact(q.a, q.b); });
  add_in_float(name + "/in_float", set);
  add_timed(name + "/careful", set, least, [](const Query& q) {
    return in_order(q, [](const auto& a, const auto& b) { return careful_impact({}, a, b); });
  });
  add_timed(name + "/plain", set, least, plain);
}

/// The gap as the clear rung has it, from either to the other.
template <class A, class B> ClearContact clear_gap_either_way(const A& a, const B& b) {
  if constexpr (HasClearContact<A, B>) {
    return clear_gap(a, b);
  } else {
    return clear_gap(b, a);
  }
}

/// The front door and the careful rung of what overlaps at the start.
template <class A, class B>
void add_resting(const std::string& pair, const Shots<A, B>& (*set)() = &resting_shots<A, B>) {
  const std::string name = "overlapping/" + pair;
  using Query = Shot<A, B>;
  rows.push_back(
      {name, 0, share_of<Query>(set, [](const Query& q) { return clear_gap_either_way(q.a.shape, q.b.shape).clear; })});
  add_timed(name + "/front_door", set, {}, [](const Query& q) { return time_of_impact(q.a, q.b); });
  add_timed(name + "/careful", set, {}, [](const Query& q) {
    return in_order(q, [](const auto& a, const auto& b) { return careful_impact({}, a, b); });
  });
}

template <class B, class Plain>
void add_raycast(const std::string& shape, double goal, const Operations& least, Plain plain) {
  const std::string name = "raycast/" + shape;
  using Query = RayShot<B>;
  rows.push_back(
      {name, goal, share_of<Query>(&any_rays<B>, [](const Query& q) { return clear_raycast(q.ray, q.shape).clear; })});
  add_timed(name + "/front_door", &any_rays<B>, least, [](const Query& q) { return raycast(q.ray, q.shape); });
  add_timed(name + "/careful", &any_rays<B>, least, [](const Query& q) { return careful_raycast(q.ray, q.shape); });
  add_timed(name + "/plain", &any_rays<B>, least, [plain](const Query& q) { return plain(q.ray, q.shape); });
}

/// A query at one instant: `ask(a, b)`, and the depth in its answer, or `never`; beside it the careful rung, and what the clear one says.
template <class A, class B, class Ask, class Clear, class Careful, class DepthOf>
void add_rungs(const std::string& what, double goal, Ask ask, Clear clear, Careful careful, DepthOf depth_of) {
  using Query = Pose<A, B>;
  rows.push_back(
      {what, goal, share_of<Query>(&any_poses<A, B>, [clear](const Query& q) { return clear(q.a, q.b).clear; })});
  const auto add = [&](const std::string& name, const auto& by) {
    add_timed(
        what + name, &any_poses<A, B>, {}, [by](const Query& q) { return by(q.a, q.b); },
        [by, depth_of](const Query& q) { return depth_of(by(q.a, q.b)); });
  };
  add("/front_door", ask);
  add("/careful", careful);
}
template <class A, class B> void add_contact(const std::string& pair, double goal = 0) {
  add_rungs<A, B>(
      "contact/" + pair, goal, [](const A& a, const B& b) { return contact(a, b); },
      [](const A& a, const B& b) { return clear_contact_either_way(a, b); },
      [](const A& a, const B& b) { return careful_contact(a, b); }, [](const auto& found) { return depth_of(found); });
}
template <class A, class B> void add_overlaps(const std::string& pair, double goal = 0) {
  add_rungs<A, B>(
      "overlaps/" + pair, goal, [](const A& a, const B& b) { return overlaps(a, b); },
      [](const A& a, const B& b) { return clear_overlap_either_way(a, b); },
      [](const A& a, const B& b) { return careful_overlaps(a, b); }, [](bool overlap) { return depth_of(overlap); });
}
template <class A, class B> void add_separation(const std::string& pair) {
  add_rungs<A, B>(
      "separation/" + pair, 0, [](const A& a, const B& b) { return separation(a, b); },
      [](const A& a, const B& b) { return clear_gap_either_way(a, b); },
      [](const A& a, const B& b) { return careful_separation(a, b); },
      [](const auto& found) { return found.distance <= 0 ? -found.distance : never; });
}

Vec3<D> between(const auto& q) { return center(q.a.shape) - center(q.b.shape); }
Vec3<D> motion(const auto& q) { return relative_displacement(q.a, q.b); }

const bool added = [] {
  using S = Sphere<D>;
  using A = Aabb<D>;
  using O = Obb<D>;
  using C = Capsule<D>;
  using T = Triangle<D>;
  const auto plain_ball_at_box = [](const auto& q) {
    return textbook::rounded_box<D>(between(q), motion(q), q.b.shape.half_extents, q.a.shape.radius);
  };
  const auto plain_ball_at_turned_box = [](const auto& q) {
    return textbook::rounded_box<D>(into<D>(q.b.shape, between(q)), into<D>(q.b.shape, motion(q)),
                                    q.b.shape.half_extents, q.a.shape.radius);
  };
  add_impact<S, A>("sphere_thin_wall", 14, &thin_wall_shots<A>, flat_hit, plain_ball_at_box);
  add_impact<S, O>("sphere_turned_wall", 18, &thin_wall_shots<O>, flat_hit, plain_ball_at_turned_box);
  add_impact<S, A>("sphere_aabb", 0, &any_shots<S, A>, flat_hit, plain_ball_at_box);
  add_impact<S, S>("sphere_sphere", 12, &any_shots<S, S>, round_hit, [](const auto& q) {
    return textbook::ball<D>(between(q), motion(q), q.a.shape.radius + q.b.shape.radius);
  });
  add_impact<A, A>("aabb_aabb", 7.5, &any_shots<A, A>, flat_hit, [](const auto& q) {
    return textbook::slabs<D>(between(q), motion(q), q.a.shape.half_extents + q.b.shape.half_extents);
  });
  add_impact<S, C>("sphere_capsule", 25, &any_shots<S, C>, round_hit, [](const auto& q) {
    return textbook::rounded_segment<D>(q.a.shape.center - q.b.shape.a, motion(q), q.b.shape.b - q.b.shape.a,
                                        q.a.shape.radius + q.b.shape.radius);
  });
  add_impact<C, A>("capsule_aabb", 43, &any_shots<C, A>, flat_hit,
                   [](const auto& q) { return plain::bisection(q.a, q.b); });
  add_impact<C, C>("capsule_capsule", 35, &any_shots<C, C>, flat_hit,
                   [](const auto& q) { return plain::bisection(q.a, q.b); });
  add_impact<S, O>("sphere_obb", 0, &any_shots<S, O>, flat_hit, plain_ball_at_turned_box);
  add_impact<A, O>("aabb_obb", 36, &any_shots<A, O>, flat_hit,
                   [](const auto& q) { return textbook::boxes<D>(to_obb(q.a.shape), q.b.shape, -motion(q)); });
  add_impact<O, O>("obb_obb", 55, &any_shots<O, O>, flat_hit,
                   [](const auto& q) { return textbook::boxes<D>(q.a.shape, q.b.shape, -motion(q)); });
  add_impact<S, T>("sphere_triangle", 50, &any_shots<S, T>, flat_hit, [](const auto& q) {
    return plain::rounded_triangle(q.a.shape.center, motion(q), q.b.shape, q.a.shape.radius);
  });
  add_impact<C, T>("capsule_triangle", 0, &any_shots<C, T>, flat_hit,
                   [](const auto& q) { return plain::bisection(q.a, q.b); });

  add_resting<S, S>("sphere_sphere");
  add_resting<S, A>("sphere_aabb");
  add_resting<A, A>("aabb_aabb");
  add_resting<S, C>("sphere_capsule");
  add_resting<C, A>("capsule_aabb");
  add_resting<C, C>("capsule_capsule");
  add_resting<S, O>("sphere_obb");
  add_resting<O, O>("obb_obb");
  add_resting("level_obb_obb", &level_shots);
  add_resting<S, T>("sphere_triangle");
  add_resting<C, T>("capsule_triangle");

  add_raycast<S>("sphere", 13, round_hit, [](const Ray<D>& r, const S& s) {
    return textbook::ball<D>(r.origin - s.center, r.direction, s.radius);
  });
  add_raycast<A>("aabb", 10, flat_hit, [](const Ray<D>& r, const A& b) {
    return textbook::slabs<D>(r.origin - b.center, r.direction, b.half_extents);
  });
  add_raycast<O>("obb", 12.5, flat_hit, [](const Ray<D>& r, const O& b) {
    return textbook::slabs<D>(into<D>(b, r.origin - b.center), into(b, r.direction), b.half_extents);
  });
  add_raycast<C>("capsule", 25, round_hit, [](const Ray<D>& r, const C& c) {
    return textbook::rounded_segment<D>(r.origin - c.a, r.direction, c.b - c.a, c.radius);
  });
  add_raycast<T>("triangle", 14, flat_hit,
                 [](const Ray<D>& r, const T& t) { return plain::triangle(r.origin, r.direction, t); });

  add_contact<S, S>("sphere_sphere", 4);
  add_contact<A, A>("aabb_aabb", 3.5);
  add_contact<S, A>("sphere_aabb", 5.5);
  add_contact<C, C>("capsule_capsule", 15);
  add_contact<S, O>("sphere_obb");
  add_contact<S, T>("sphere_triangle");
  add_contact<C, T>("capsule_triangle");
  add_contact<C, A>("capsule_aabb");
  add_contact<C, O>("capsule_obb");
  add_contact<A, O>("aabb_obb");
  add_contact<O, O>("obb_obb");
  add_rungs<O, O>(
      "manifold/obb_obb", 120, [](const O& a, const O& b) { return manifold(a, b); },
      [](const O& a, const O& b) {
        Manifold<D> made;
        return ClearOverlap{clear_manifold(a, b, made), !made.empty()};
      },
      [](const O& a, const O& b) { return careful_manifold(a, b); },
      [](const auto& found) { return found.empty() ? never : found[0].penetration; });
  add_overlaps<O, O>("obb_obb", 14);
  add_overlaps<A, A>("aabb_aabb");
  add_overlaps<C, C>("capsule_capsule");
  add_overlaps<S, T>("sphere_triangle");
  add_overlaps<C, T>("capsule_triangle");
  add_separation<S, S>("sphere_sphere");
  add_separation<S, A>("sphere_aabb");
  add_separation<S, C>("sphere_capsule");
  add_separation<C, C>("capsule_capsule");
  add_separation<A, A>("aabb_aabb");
  add_separation<S, O>("sphere_obb");
  add_separation<S, T>("sphere_triangle");
  add_separation<C, T>("capsule_triangle");
  add_separation<C, A>("capsule_aabb");
  add_separation<O, O>("obb_obb");

  // What it costs to write a whole Toi where a time would do: the floor of every front door.
  add_benchmark("stream_toi", [](benchmark::State& state) {
    const auto& queries = any_shots<S, S>().queries;
    time_queries(state, queries, [](const auto& q) {
      return Toi<D>{ToiStatus::hit, 1, q.a.shape.radius, q.a.displacement, q.b.displacement};
    });
    add_query_floor(state, queries, {});
  });
  return true;
}();

std::string percent(double share) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.2f%%", 100 * share);
  return text.data();
}

class TableReporter : public MedianTimes {
 public:
  void Finalize() override {
    std::printf("\n%-36s %10s %10s %10s %10s %10s %9s %9s %6s %8s\n", "[ns, this run]", "front door", "in float",
                "careful", "plain", "to careful", "to plain", "to floor", "goal", "clear");
    for (const Row& row : rows) {
      const double front = time(row.name + "/front_door"), careful = time(row.name + "/careful");
      const double form = time(row.name + "/plain");
      if (front == 0) continue;
      std::printf("%-36s %10.1f %10.1f %10.1f %10.1f %10.2f %9.2f %9.1f %6.1f ", row.name.c_str(), front,
                  time(row.name + "/in_float"), careful, form, careful > 0 ? front / careful : 0,
                  form > 0 ? front / form : 0, to_floor(row.name + "/front_door"), row.goal);
      std::printf("%8s\n", percent(row.clear()).c_str());
    }
    std::printf("Floor: to read a query where so many stay, or a hit's division and square root, whichever is more.\n");
    std::printf("Goals are for one core of a 3.6 GHz Zen 5 EPYC. 0.0: not measured, or there is none.\n");
  }
};

}  // namespace

int main(int argc, char** argv) { return run_benchmarks<TableReporter>(argc, argv); }
