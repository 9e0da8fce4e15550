/// What does a step of a world cost, by phase, and what does the plan save?
/// Rain: N balls fall on one floor and bounce, at a density of one ball in 8 of their cubes, a quarter of a radius to two
/// radii a step; timed while most are in the air and many hit. The table at the end is of one run, medians of a step's seconds.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/world.hpp>

#include "floors.hpp"

namespace {

using namespace thinwall;

constexpr double step_seconds = 1.0 / 60;
constexpr int steps = 12;  // of one world, then a new one: every row sees the same steps

World rain(std::uint32_t count, const WorldOptions& wanted) {
  const double radius = 0.05, side = std::cbrt(count * 8.0) * 2 * radius;
  const RandomStream key{1, 1};
  std::vector<Body> bodies;
  for (std::uint32_t id = 0; id < count; ++id) {
    const RandomWords words = random_words(key, id, 0), more = random_words(key, id, 1);
    const Vec3<double> place(uniform(words[0]), uniform(words[1]), uniform(words[2]));
    const Vec3<double> velocity(uniform(more[0]) - 0.5, -0.75 - uniform(more[1]) * 5, uniform(more[2]) - 0.5);
    const Sphere<double> ball{place * side + Vec3<double>(0, radius, 0), radius};
    bodies.push_back({.id = id, .name = {}, .shape = ball, .velocity = velocity, .restitution = 0.5});
  }
  const Aabb<double> floor{{side / 2, -0.5, side / 2}, {side, 0.5, side}};
  bodies.push_back({.id = count, .name = {}, .shape = floor, .is_static = true});
  WorldOptions options = wanted;
  options.gravity = {0, -9.81, 0};
  return World(std::move(bodies), options);
}

struct Row {
  std::string name;
  std::uint32_t count;
  std::vector<StepReport> reports;
  double floor_ns = 0;  ///< of a step: to read and write every body once
};
std::vector<Row>& rows() {
  static std::vector<Row> all;
  return all;
}

void add(const std::string& name, std::uint32_t count, const WorldOptions& options) {
  const std::size_t which = rows().size();
  rows().push_back({name, count, {}, 0});
  benchmark::RegisterBenchmark(("world/rain_" + std::to_string(count) + "/" + name).c_str(),
                               [=](benchmark::State& state) {
                                 World world = rain(count, options);
                                 int left = steps;
                                 for (auto _ : state) {
                                   if (left-- == 0) {
                                     state.PauseTiming();
                                     world = rain(count, options);
                                     left = steps - 1;
                                     state.ResumeTiming();
                                   }
                                   rows()[which].reports.push_back(world.step(step_seconds));
                                 }
                                 const double floor = bench::update_ns(count * sizeof(Body));
                                 rows()[which].floor_ns = floor;
                                 bench::add_floor(state, floor);
                               })
      ->Unit(benchmark::kMillisecond)
      ->Iterations(count < 1000 ? 100 * steps : steps);
}

const bool added = [] {
  const auto with = [](TimePolicy policy, int substeps = 1) {
    return WorldOptions{.policy = policy, .substeps = substeps};
  };
  const WorldOptions exact = with(TimePolicy::event_driven);
  for (const std::uint32_t count : {1000U, 10000U, 100000U}) {
    add("discrete", count, with(TimePolicy::discrete));
    add("substeps_4", count, with(TimePolicy::substeps, 4));
    add("clamp", count, with(TimePolicy::clamp));
    add("event_driven", count, exact);
    WorldOptions two = exact, unread = exact, watched = exact, gated = exact;
    two.threads = 2;
    add("event_driven, 2 threads", count, two);
    unread.events = false;
    add("event_driven, events unread", count, unread);
    watched.response = false;
    add("event_driven, no response", count, watched);
    gated.gate = 0.5;
    add("event_driven, gate 0.5", count, gated);
  }
  for (const std::uint32_t count : {16U, 32U, 64U, 128U, 256U}) {  // where does the half loop stop to pay?
    for (const char* broad_phase : {"all_pairs", "uniform_grid"}) {
      WorldOptions options = exact;
      options.broad_phase = broad_phase;
      add(broad_phase, count, options);
    }
  }
  WorldOptions full = exact;
  full.full_plan = true;
  add("planned", 1000, exact);
  add("full plan", 1000, full);
  return true;
}();

void print_table() {
  std::printf("\n%-28s%8s%10s%9s%9s |%10s%8s%8s%10s%8s |%9s%8s%9s\n", "rain", "balls", "ms/step", "ns/body", "x floor",
              "integrate", "broad", "narrow", "response", "events", "pairs", "hits", "MB");
  for (const Row& row : rows()) {
    if (row.reports.empty()) continue;
    const auto of = [&](const auto& value) {
      std::vector<double> values;
      for (const StepReport& report : row.reports) values.push_back(static_cast<double>(value(report)));
      return median(values);
    };
    const double total = of([](const StepReport& r) { return r.seconds.total(); });
    const auto ms = [&](double PhaseSeconds::*phase) {
      return 1e3 * of([&](const StepReport& r) { return r.seconds.*phase; });
    };
    std::printf("%-28s%8u%10.3f%9.0f%9.0f |%10.3f%8.3f%8.3f%10.3f%8.3f |%9.0f%8.0f%9.2f\n", row.name.c_str(), row.count,
                1e3 * total, 1e9 * total / row.count, 1e9 * total / row.floor_ns, ms(&PhaseSeconds::integrate),
                ms(&PhaseSeconds::broad), ms(&PhaseSeconds::narrow), ms(&PhaseSeconds::response),
                ms(&PhaseSeconds::events), of([](const StepReport& r) { return r.pairs; }),
                of([](const StepReport& r) { return r.hits; }), 1e-6 * of([](const StepReport& r) { return r.bytes; }));
  }
  std::printf(
      "Medians over the steps; ms by phase. MB: what the world holds for stepping, bodies not included.\n"
      "Floor: to read and write every body once, where so many stay.\n");
}

}  // namespace

int main(int argc, char** argv) {
  const int code = bench::run_benchmarks(argc, argv);
  print_table();
  return code;
}
