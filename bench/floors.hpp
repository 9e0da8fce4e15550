#pragma once
/// Floors: the least time that a benchmark's work could take on this machine, measured in the same process.
/// Two of them. *Memory*: what streaming the same bytes takes, on one core. *Arithmetic*: what the divisions and square roots
/// that the formula cannot do without take, one after another but independent, in scalar code. A row's floor is the larger of
/// the two; its counter `to_floor` is its time over that.
///
/// Limits. Additions, multiplications, comparisons and mispredicted jumps are not in the floor: a ratio of 1 is out of reach for
/// most. Vector instructions divide several numbers at once and may go below the scalar floor of arithmetic. A store that
/// bypasses the caches saves reading the line first and may go below the floor of memory by up to a quarter. The best of
/// several passes counts, so a busy machine raises a floor less than it raises a time.

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#if defined(__x86_64__)
#define THINWALL_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define THINWALL_WIDE
#endif

namespace thinwall::bench {

/// [ns] that one call of `pass` takes, the best of at least three and of as many as fit in `budget` [ns].
template <class Pass> double best_ns(const Pass& pass, double budget = 3e7) {
  using Clock = std::chrono::steady_clock;
  double best = std::numeric_limits<double>::infinity(), spent = 0;
  for (int i = 0; i < 3 || spent < budget; ++i) {
    const auto start = Clock::now();
    pass();
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    best = std::min(best, ns);
    spent += ns;
  }
  return best;
}

// The loops that are timed, each as the build says and for AVX2 where the machine has it.

using StreamedRows = std::array<const double*, 7>;

THINWALL_WIDE static void sum_rows(const StreamedRows& in, double* out, std::size_t rows) {
  for (std::size_t i = 0; i < rows; ++i) {
    double sum = in[0][i];
    for (std::size_t k = 1; k < in.size(); ++k) sum += in[k][i];
    out[i] = sum;
  }
}
THINWALL_WIDE static std::uint64_t mix_words(const std::uint64_t* words, std::size_t count) {
  std::uint64_t mixed = 0;
  for (std::size_t i = 0; i < count; ++i) mixed ^= words[i];
  return mixed;
}
THINWALL_WIDE static void add_one(std::uint64_t* words, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) ++words[i];
}

/// [ns] a row, of one core that reads a double from each of so many arrays and writes one to another, as a batch kernel does.
/// 128 MB in all: far more than any cache holds. That the caches read a line before it is written is in the time, not in the bytes.
inline double measure_stream() {
  StreamedRows in{};
  const std::size_t rows = (std::size_t{128} << 20) / (8 * (in.size() + 1));
  std::vector<std::vector<double>> inputs(in.size(), std::vector<double>(rows, 1.0));
  std::vector<double> output(rows);
  for (std::size_t k = 0; k < in.size(); ++k) in[k] = inputs[k].data();
  const double ns = best_ns(
      [&] {
        sum_rows(in, output.data(), rows);
        benchmark::ClobberMemory();
      },
      6e7);
  return ns / static_cast<double>(rows);
}

/// [ns] to read `bytes` from `data`, wherever in the caches or the memory so many bytes stay between passes.
inline double read_ns(const void* data, std::size_t bytes) {
  const auto* words = static_cast<const std::uint64_t*>(data);
  return best_ns([&] { benchmark::DoNotOptimize(mix_words(words, bytes / 8)); }, 5e6);
}

/// [ns] to read so many bytes, change them and write them back.
inline double update_ns(std::size_t bytes) {
  std::vector<std::uint64_t> words(std::max<std::size_t>(1, bytes / 8));
  const std::size_t passes =
      1 + (std::size_t{1} << 14) / words.size();  // a few passes of little, lest the clock be timed
  const double ns = best_ns(
      [&] {
        for (std::size_t i = 0; i < passes; ++i) {
          add_one(words.data(), words.size());
          benchmark::ClobberMemory();
        }
      },
      5e6);
  return ns / static_cast<double>(passes);
}

/// [ns] of `operation` on a double, in scalar code, independent of the one before.
template <class Operation> double measure_operation(const Operation& operation) {
  constexpr int rounds = 20000;
  std::array<double, 8> numbers{1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8};
  const double ns = best_ns([&] {
    for (int i = 0; i < rounds; ++i) {
      for (double& number : numbers) {
        benchmark::DoNotOptimize(number);
        double result = operation(number);
        benchmark::DoNotOptimize(result);
      }
    }
  });
  return ns / (rounds * 8.0);
}

struct Floors {
  double stream_row_ns;  ///< [ns] to read 7 doubles and write one, streaming: measure_stream()
  double division_ns;    ///< [ns] a division of doubles, throughput
  double root_ns;        ///< [ns] a square root of a double, throughput

  double bytes_a_ns() const { return 64 / stream_row_ns; }
};

/// Measured at the first call, in about a fifth of a second.
inline const Floors& floors() {
  static const Floors measured = {measure_stream(), measure_operation([](double x) { return 3.7 / x; }),
                                  measure_operation([](double x) { return std::sqrt(x); })};
  return measured;
}

/// The operations that a formula cannot do without, a query on average.
struct Operations {
  double divisions = 0, roots = 0;
  double floor_ns() const { return divisions * floors().division_ns + roots * floors().root_ns; }
};

/// Adds the counters `floor_ns` and `to_floor` to a row. `ns`: the floor of one iteration; `queries`: how many it answers, where
/// `floor_ns` should be of one.
inline void add_floor(benchmark::State& state, double ns, double queries = 1) {
  using benchmark::Counter;
  state.counters["floor_ns"] = ns / queries;
  state.counters["to_floor"] = Counter(1e-9 * ns, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

/// Says the machine's floors in what every benchmark program prints first, and in its JSON's context.
inline void add_floors_to_context() {
  benchmark::AddCustomContext("floor_stream_bytes_per_ns", std::to_string(floors().bytes_a_ns()));
  benchmark::AddCustomContext("floor_division_ns", std::to_string(floors().division_ns));
  benchmark::AddCustomContext("floor_root_ns", std::to_string(floors().root_ns));
}

/// For the terminal: as Google Benchmark's own, but what counts per row is a number, where that one takes it for seconds.
class FloorReporter : public benchmark::ConsoleReporter {
 public:
  FloorReporter() : ConsoleReporter(isatty(STDOUT_FILENO) != 0 ? OO_ColorTabular : OO_Tabular) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<Run> shown = runs;
    for (Run& run : shown) {
      for (auto& [name, counter] : run.counters) {
        if ((counter.flags & benchmark::Counter::kInvert) != 0) counter.flags = benchmark::Counter::kDefaults;
      }
    }
    ConsoleReporter::ReportRuns(shown);
  }
};

/// Prints as that one does and keeps each time, for a closing table.
class MedianTimes : public FloorReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    FloorReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Aggregate && run.aggregate_name != "median") continue;
      times_[run.run_name.function_name] = run.GetAdjustedCPUTime();
      if (const auto ratio = run.counters.find("to_floor"); ratio != run.counters.end())
        to_floor_[run.run_name.function_name] = ratio->second.value;
    }
  }

 protected:
  /// [ns] by benchmark name, the median if it was repeated; 0 if it was not run.
  double time(const std::string& name) const { return value(times_, name); }

  /// [1] its time over its floor, the same way.
  double to_floor(const std::string& name) const { return value(to_floor_, name); }

 private:
  using Values = std::map<std::string, double>;
  static double value(const Values& values, const std::string& name) {
    const auto found = values.find(name);
    return found == values.end() ? 0 : found->second;
  }

  Values times_, to_floor_;
};

/// What main() of a benchmark program does.
template <class Reporter = FloorReporter> int run_benchmarks(int argc, char** argv) {
  Reporter reporter;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  add_floors_to_context();
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}

}  // namespace thinwall::bench
