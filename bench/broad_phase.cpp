/// What does it take to find all pairs of 100 000 moving balls, against the goals, and against Bullet where it is built in?
/// Each broad phase of the list on the worlds of the experiment broad_phase, one step and the next in turn.
/// The floor is to read every box and write every pair, once. For medians: --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/broad_phase/model.hpp>

#include "floors.hpp"

namespace {

using namespace thinwall;
using namespace thinwall::bench;

constexpr double diameter = 2 * crowd_radius;

struct Steps {
  std::vector<Proxy> now, next;
};

Steps steps_of(std::int64_t count, double speed) {
  const Crowd crowd = make_crowd({.placement = "uniform", .speed = speed, .count = count, .density = 0.1}, 1);
  return {proxies_of(crowd), proxies_of(next_step(crowd))};
}

void find_all(benchmark::State& state, std::string_view name, double speed, std::int64_t count) {
  const Steps steps = steps_of(count, speed);
  const std::unique_ptr<Finder> finder = make_finder(name);
  finder->find(steps.now);
  state.counters["pairs"] = static_cast<double>(finder->pairs().size());
  bool odd = false;
  for (auto _ : state) {
    odd = !odd;
    finder->find(odd ? steps.next : steps.now);
  }
  // The floor: to read every box once and write every pair once.
  const auto written = finder->pairs().size() * sizeof(ProxyPair);
  add_floor(state, read_ns(steps.now.data(), steps.now.size() * sizeof(Proxy)) + update_ns(written));
  const double bytes = static_cast<double>(finder->bytes().value_or(0));
  if (bytes > 0) state.counters["bytes_a_ball"] = bytes / static_cast<double>(count);
}

/// Which worlds a broad phase can be asked to look at within a benchmark's patience.
std::vector<std::int64_t> counts_for(std::string_view name) {
  if (name.substr(0, 4) == "all_") return {10000};
  if (name == "sort_and_sweep" || name.substr(0, 6) == "bullet") return {10000, 100000};
  return {10000, 100000, 1000000};
}

std::string key_of(std::string_view name, double speed, std::int64_t count) {
  return "broad_phase/" + std::to_string(count) + (speed < diameter ? "_slow/" : "_fast/") + std::string(name);
}

const bool added = [] {
  for (const std::string_view name : finder_names()) {
    for (const double speed : {diameter / 10, diameter}) {
      for (const std::int64_t count : counts_for(name)) {
        const auto run = [name, speed, count](benchmark::State& state) { find_all(state, name, speed, count); };
        benchmark::RegisterBenchmark(key_of(name, speed, count).c_str(), run)->Unit(benchmark::kMillisecond);
      }
    }
  }
  return true;
}();

/// The goals, with what was measured.
class Goals : public MedianTimes {
 public:
  void Finalize() override {
    for (const double speed : {diameter / 10, diameter}) {
      std::printf("\n100 000 balls, %g of a diameter a step\n", speed / diameter);
      const double grid = at("uniform_grid", speed, 100000), tree = at("r_tree", speed, 100000);
      goal("best (uniform_grid)", grid, 40, "ms");
      goal("r_tree", tree, 100, "ms");
      goal("exponent, best, 1e4 to 1e6", exponent("uniform_grid", speed), 1.15, "");
      goal("exponent, r_tree, 1e4 to 1e6", exponent("r_tree", speed), 1.3, "");
      std::printf("  %-30s %8.3g times\n", "best over its floor", to_floor(key_of("uniform_grid", speed, 100000)));
      const double build = at("bullet_build", speed, 100000), step = at("bullet_step", speed, 100000);
      if (build > 0 && step > 0 && grid > 0) {
        std::printf("  %-30s %8.3g x faster (goal: at least 2)\n", "best against Bullet's quicker",
                    std::min(build, step) / grid);
      }
    }
  }

 private:
  static void goal(const char* what, double measured, double bound, const char* unit) {
    if (measured > 0) std::printf("  %-30s %8.3g %s (goal: at most %g)\n", what, measured, unit, bound);
  }
  double at(std::string_view name, double speed, std::int64_t count) const { return time(key_of(name, speed, count)); }
  double exponent(std::string_view name, double speed) const {
    const double small = at(name, speed, 10000), large = at(name, speed, 1000000);
    return small > 0 && large > 0 ? std::log(large / small) / std::log(100.0) : 0;
  }
};

}  // namespace

int main(int argc, char** argv) { return run_benchmarks<Goals>(argc, argv); }
