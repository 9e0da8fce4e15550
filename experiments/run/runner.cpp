#include <thinwall/experiments/run/runner.hpp>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string_view>
#include <thread>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <thinwall/experiments/run/ranks.hpp>

namespace thinwall {
namespace {

Journal::Row timed(const Unit& unit) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::string result;
  try {
    result = unit.compute();
  } catch (const std::exception& error) {
    throw std::runtime_error("unit '" + unit.key + "' failed: " + error.what());
  }
  return {std::chrono::duration<double>(Clock::now() - start).count(), std::move(result)};
}

std::int64_t total_trials(std::span<const Unit> units) {
  return std::accumulate(units.begin(), units.end(), std::int64_t{0},
                         [](std::int64_t sum, const Unit& unit) { return sum + unit.trials; });
}

void require_unique_keys(std::span<const Unit> units) {
  std::set<std::string_view> keys;
  for (const Unit& unit : units) {
    if (!keys.insert(unit.key).second) throw std::logic_error("two units have the key '" + unit.key + "'");
  }
}

/// Calls `body(i)` for every i below `count`, on `threads` threads, also if the machine has fewer cores.
template <class Body> void parallel_for_each_index(std::size_t count, int threads, const Body& body) {
  namespace tbb = oneapi::tbb;
  const auto width = static_cast<std::size_t>(threads);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, width);
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
        },
        tbb::simple_partitioner());
  });
}

}  // namespace

int default_threads() {
  const int ours = oneapi::tbb::info::default_concurrency(), neighbors = launch_of_this_process().neighbors;
  if (neighbors <= 1) return ours;
  const int fair =
      static_cast<int>(std::thread::hardware_concurrency()) / neighbors;  // mpirun may bind ranks to cores or not
  return std::max(1, std::min(ours, fair));
}

UnitResults compute_units(std::span<const Unit> units, Journal& journal, const RunnerOptions& options) {
  require_unique_keys(units);
  UnitResults out;
  out.results.resize(units.size());
  out.seconds.resize(units.size());
  Progress progress{.units = units.size(), .trials = total_trials(units)};

  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const auto known = journal.finished().find(units[i].key);
    if (known == journal.finished().end()) {
      open.push_back(i);
      continue;
    }
    out.results[i] = known->second.result;
    out.seconds[i] = known->second.seconds;
    progress.trials_resumed += units[i].trials;
  }
  out.resumed = progress.units_done = units.size() - open.size();
  progress.trials_done = progress.trials_resumed;

  std::mutex mutex;
  const auto report = [&] {
    if (options.on_progress) options.on_progress(progress);
  };
  report();
  parallel_for_each_index(open.size(), options.threads, [&](std::size_t k) {
    if (options.stop && options.stop()) return;
    const std::size_t i = open[k];
    Journal::Row row = timed(units[i]);
    journal.add(units[i].key, row);
    const std::scoped_lock lock(mutex);
    out.results[i] = std::move(row.result);
    out.seconds[i] = row.seconds;
    progress.units_done += 1;
    progress.trials_done += units[i].trials;
    report();
  });
  out.complete = progress.units_done == units.size();
  return out;
}

double estimate_seconds(std::span<const Unit> units, int threads, double budget) {
  constexpr std::size_t samples = 16;  // spread over the run: its cells differ in cost
  double seconds = 0;
  std::int64_t trials = 0;
  for (std::size_t k = 0; k < std::min(samples, units.size()) && seconds < budget; ++k) {
    const std::size_t stride = std::max<std::size_t>(units.size() / samples, 1);
    const Unit& unit = units[k * stride];
    seconds += unit.seconds > 0 ? unit.seconds : timed(unit).seconds;
    trials += unit.trials;
  }
  if (trials == 0) return 0;
  return seconds / static_cast<double>(trials) * static_cast<double>(total_trials(units)) / threads;
}

}  // namespace thinwall
