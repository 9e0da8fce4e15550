#pragma once
/// Query sets for the benchmarks: 100 000 shots, half of them hits, in random order, all apart at the start, streamed from
/// memory. A set small or regular enough for the branch predictor to learn would flatter every method. And what an answer to a set
/// gets wrong, held against the set's truth: as counters of a row, beside its time.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <thinwall/discrete/triangle.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "floors.hpp"

namespace thinwall::bench {

inline constexpr std::size_t query_count = 100'000;
inline constexpr double never = std::numeric_limits<double>::infinity();

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
  Mat3<double> axes() {
    Mat3<double> m;
    m.col(0) = direction();
    m.col(1) = safe_unit(cross<double>(m.col(0), direction()));
    m.col(2) = cross<double>(m.col(0), m.col(1));
    return m;
  }

 private:
  std::uint64_t state_ = 1;
};

/// A shape around the origin, of a size between 0.05 and 0.5.
template <class A> A any_shape(Uniform& uniform);
template <> inline Sphere<double> any_shape(Uniform& u) { return {Vec3<double>::Zero(), u.between(0.05, 0.5)}; }
template <> inline Aabb<double> any_shape(Uniform& u) {
  return {Vec3<double>::Zero(), {u.between(0.05, 0.5), u.between(0.05, 0.5), u.between(0.05, 0.5)}};
}
template <> inline Obb<double> any_shape(Uniform& u) {
  return {Vec3<double>::Zero(), any_shape<Aabb<double>>(u).half_extents, u.axes()};
}
template <> inline Capsule<double> any_shape(Uniform& u) {
  const Vec3<double> half = u.direction() * u.between(0.05, 0.5);
  return {-half, half, u.between(0.05, 0.25)};
}
template <> inline Triangle<double> any_shape(Uniform& u) {
  return {u.direction() * u.between(0.2, 0.6), u.direction() * u.between(0.2, 0.6),
          u.direction() * u.between(0.2, 0.6)};
}

template <class A, class B> struct Shot {
  Moving<A> a;
  Moving<B> b;
};

/// A ray at a shape; a hit is within one of its directions.
template <class B> struct RayShot {
  Ray<double> ray;
  B shape;
};

/// Two shapes at one instant.
template <class A, class B> struct Pose {
  A a;
  B b;
};

/// Queries and their true answers in long double, `never` for none: a shot's or a ray's time, a pose's depth.
template <class Query> struct QuerySet {
  std::vector<Query> queries;
  std::vector<double> truth;
};
template <class A, class B> using Shots = QuerySet<Shot<A, B>>;
template <class B> using Rays = QuerySet<RayShot<B>>;
template <class A, class B> using Poses = QuerySet<Pose<A, B>>;

/// The largest answer that is a hit.
template <class A, class B> double last_hit(const Shot<A, B>&) { return 1; }
template <class B> double last_hit(const RayShot<B>&) { return 1; }
template <class A, class B> double last_hit(const Pose<A, B>&) { return std::numeric_limits<double>::max(); }

/// [length] What an answer's unit is worth.
template <class A, class B> double unit_length(const Shot<A, B>& q) {
  return std::sqrt(relative_displacement(q.a, q.b).squaredNorm());
}
template <class B> double unit_length(const RayShot<B>& q) { return std::sqrt(q.ray.direction.squaredNorm()); }
template <class A, class B> double unit_length(const Pose<A, B>&) { return 1; }

/// Shots of shapes made by `make_a` at shapes made by `make_b`, hits as likely as misses, both moving, along `axes` alone.
template <class A, class B, class MakeA, class MakeB>
Shots<A, B> shots(const MakeA& make_a, const MakeB& make_b, const Vec3<double>& axes = {1, 1, 1}) {
  Uniform uniform;
  Shots<A, B> set;
  bool wanted = true;
  while (set.queries.size() < query_count) {
    const auto vector = [&](double least, double most) -> Vec3<double> {
      return (uniform.direction() * uniform.between(least, most)).cwiseProduct(axes);
    };
    const Vec3<double> from = vector(1.5, 3), aim = vector(0, 2), drift = vector(0, 2);
    const Moving<A> a{moved<double>(make_a(uniform), from), (aim - from) * uniform.between(0.5, 3) + drift};
    const Moving<B> b{make_b(uniform), drift};
    const auto truth = time_of_impact(cast<long double>(a), cast<long double>(b));
    const bool hit = truth.status == ToiStatus::hit;
    if (hit != wanted || overlaps_within(a.shape, b.shape, 0.02)) continue;
    wanted = uniform() < 0.5;
    set.queries.push_back({a, b});
    set.truth.push_back(hit ? static_cast<double>(truth.time) : never);
  }
  return set;
}

/// Any two shapes: the sets are made when first asked for.
template <class A, class B> const Shots<A, B>& any_shots() {
  static const Shots<A, B> set = shots<A, B>([](Uniform& u) { return any_shape<A>(u); },  //
                                             [](Uniform& u) { return any_shape<B>(u); });
  return set;
}
/// A ray along each shot's relative motion, from the center of A.
template <class B> const Rays<B>& any_rays() {
  static const Rays<B> set = [] {
    Rays<B> rays;
    for (const auto& shot : any_shots<Sphere<double>, B>().queries) {
      const Ray<double> ray{shot.a.shape.center, relative_displacement(shot.a, shot.b), 1};
      const Ray<long double> exact{ray.origin.template cast<long double>(), ray.direction.template cast<long double>(),
                                   1};
      const auto hit = raycast(exact, cast<long double>(shot.b.shape));
      rays.queries.push_back({ray, shot.b.shape});
      rays.truth.push_back(hit ? static_cast<double>(hit->t) : never);
    }
    return rays;
  }();
  return set;
}

/// Each shot a little (a twentieth of the time until then) after first contact, or where it ends.
template <class A, class B> const Poses<A, B>& any_poses() {
  static const Poses<A, B> set = [] {
    Poses<A, B> poses;
    const Shots<A, B>& shots = any_shots<A, B>();
    for (std::size_t k = 0; k < shots.queries.size(); ++k) {
      const double time = std::min(1.0, shots.truth[k] * 1.05);
      const A a = pose_at(shots.queries[k].a, time);
      const B b = pose_at(shots.queries[k].b, time);
      const auto gap = separation(cast<long double>(a), cast<long double>(b)).distance;
      poses.queries.push_back({a, b});
      poses.truth.push_back(gap <= 0 ? static_cast<double>(-gap) : never);
    }
    return poses;
  }();
  return set;
}

/// Shots that begin a little (a fiftieth of the step) after their first contact: all overlap at the start.
template <class A, class B> const Shots<A, B>& resting_shots() {
  static const Shots<A, B> set = [] {
    Shots<A, B> resting;
    const Shots<A, B>& shots = any_shots<A, B>();
    for (std::size_t k = 0; resting.queries.size() < query_count; k = (k + 1) % shots.queries.size()) {
      const Shot<A, B>& shot = shots.queries[k];
      const double time = shots.truth[k] + 0.02;
      const Shot<A, B> late{{pose_at(shot.a, time), shot.a.displacement}, {pose_at(shot.b, time), shot.b.displacement}};
      if (shots.truth[k] > 1 || !overlaps(late.a.shape, late.b.shape)) continue;
      resting.queries.push_back(late);
      resting.truth.push_back(0);
    }
    return resting;
  }();
  return set;
}

/// Boxes that lie on each other face to face, as in a stack, turned any way and a little deep.
inline const Shots<Obb<double>, Obb<double>>& level_shots() {
  static const auto set = [] {
    Uniform u;
    Shots<Obb<double>, Obb<double>> level;
    while (level.queries.size() < query_count) {
      const auto below = any_shape<Obb<double>>(u);
      auto above = any_shape<Obb<double>>(u);
      above.axes = below.axes;
      const double height = below.half_extents[2] + above.half_extents[2] - u.between(0.001, 0.01);
      above.center = below.axes * Vec3<double>(u.between(-0.05, 0.05), u.between(-0.05, 0.05), height);
      level.queries.push_back({{below, Vec3<double>::Zero()}, {above, below.axes.col(2) * -0.01}});
      level.truth.push_back(0);
    }
    return level;
  }();
  return set;
}

/// Bullets at thin walls, upright or turned.
template <class Wall> const Shots<Sphere<double>, Wall>& thin_wall_shots() {
  static const auto set = shots<Sphere<double>, Wall>(
      [](Uniform& u) {
        return Sphere<double>{Vec3<double>::Zero(), u.between(0.02, 0.1)};
      },
      [](Uniform& u) {
        const Aabb<double> wall{Vec3<double>::Zero(), {u.between(0.001, 0.02), 0.7, 0.7}};
        if constexpr (std::is_same_v<Wall, Aabb<double>>) {
          return wall;
        } else {
          return Wall{wall.center, wall.half_extents, u.axes()};
        }
      });
  return set;
}

// ---- What is wrong with an answer, and what it takes.

/// Answers as a set's truth is given.
inline double time_of(double time) { return time; }
template <Scalar S> double time_of(const Toi<S>& toi) {
  return toi.status == ToiStatus::apart ? never : static_cast<double>(toi.time);
}
inline double time_of(const std::optional<RayHit<double>>& hit) { return hit ? hit->t : never; }
inline double depth_of(const std::optional<Contact<double>>& found) { return found ? found->penetration : never; }
inline double depth_of(bool overlap) { return overlap ? -1 : never; }

struct Errors {
  double missed = 0, false_hits = 0;  ///< of query_count
  double p99 = 0, largest = 0;        ///< [1] |time - truth| of true hits that were found, as a fraction of the step
  double p99_length = 0, largest_length = 0;  ///< [length] the same, times the relative motion: how far off the pose is
};

inline void add_errors(benchmark::State& state, const Errors& errors) {
  state.counters["missed"] = errors.missed;
  state.counters["false"] = errors.false_hits;
  state.counters["p99_error"] = errors.p99;
  state.counters["max_error"] = errors.largest;
  state.counters["p99_length"] = errors.p99_length;
  state.counters["max_length"] = errors.largest_length;
}

/// The 99th percentile and the largest of `values`; 0 of none.
inline std::pair<double, double> tail_of(std::vector<double> values) {
  if (values.empty()) return {0, 0};
  std::sort(values.begin(), values.end());
  return {values[values.size() * 99 / 100], values.back()};
}

/// `answer_of(query)` is as the set's truth: a time or a depth, or over `last_hit` for none;
/// negative for a hit without a number.
template <class Query, class AnswerOf> Errors errors_of(const QuerySet<Query>& set, const AnswerOf& answer_of) {
  Errors errors;
  std::vector<double> times, lengths;
  for (std::size_t k = 0; k < set.queries.size(); ++k) {
    const Query& query = set.queries[k];
    const double answer = answer_of(query), last = last_hit(query);
    const bool hit = answer <= last, truly = set.truth[k] <= last;
    errors.missed += truly && !hit ? 1 : 0;
    errors.false_hits += hit && !truly ? 1 : 0;
    if (!hit || !truly || answer < 0) continue;
    times.push_back(std::abs(answer - set.truth[k]));
    lengths.push_back(times.back() * unit_length(query));
  }
  std::tie(errors.p99, errors.largest) = tail_of(std::move(times));
  std::tie(errors.p99_length, errors.largest_length) = tail_of(std::move(lengths));
  return errors;
}

/// Counted when first asked for: Google Benchmark calls a benchmark several times over, and the errors stay the same.
template <class Count> auto counted_once(const Count& count) {
  return [count, errors = std::make_shared<std::optional<Errors>>()](benchmark::State& state) {
    if (!*errors) *errors = count();
    add_errors(state, **errors);
  };
}

/// Asks one query an iteration, over and over through the list.
template <class Query, class Ask>
void time_queries(benchmark::State& state, const std::vector<Query>& queries, const Ask& ask) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ask(queries[i]));
    i = i + 1 == queries.size() ? 0 : i + 1;
  }
}

/// [ns] to read a query of this list, wherever so many stay. Measured once a list.
template <class Query> double reading_ns(const std::vector<Query>& queries) {
  static std::map<const void*, double> known;
  const auto [found, added] = known.try_emplace(queries.data(), 0.0);
  if (added) {
    found->second = read_ns(queries.data(), queries.size() * sizeof(Query)) / static_cast<double>(queries.size());
  }
  return found->second;
}

/// The floor of a query of this list: to read it, or the operations that it cannot do without.
template <class Query>
void add_query_floor(benchmark::State& state, const std::vector<Query>& queries, const Operations& operations) {
  add_floor(state, std::max(reading_ns(queries), operations.floor_ns()));
}

template <class Run> void add_benchmark(const std::string& name, const Run& run) {
  benchmark::RegisterBenchmark(name.c_str(), run);
}

/// One way to answer a set of queries: `ask` is timed, `answer_of` gives its answer as the set's truth is given.
template <class Query, class Ask, class AnswerOf>
void add_timed(const std::string& name, const QuerySet<Query>& (*set)(), const Operations& least, Ask ask,
               AnswerOf answer_of) {
  const auto count = counted_once([set, answer_of] { return errors_of(set(), answer_of); });
  add_benchmark(name, [set, least, ask, count](benchmark::State& state) {
    time_queries(state, set().queries, ask);
    count(state);
    add_query_floor(state, set().queries, least);
  });
}

/// The same of an answer that time_of() reads.
template <class Query, class Ask>
void add_timed(const std::string& name, const QuerySet<Query>& (*set)(), const Operations& least, Ask ask) {
  add_timed(name, set, least, ask, [ask](const Query& query) { return time_of(ask(query)); });
}

/// Half of the queries hit, and the time of a hit is a quotient.
inline constexpr Operations flat_hit{.divisions = 0.5, .roots = 0};
/// Half of the queries hit a round shape: a quotient with a square root in it.
inline constexpr Operations round_hit{.divisions = 0.5, .roots = 0.5};

}  // namespace thinwall::bench
