#pragma once
/// The benchmark programs: which there are, where they lie, running one, and what it said.

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {

/// In the order of a round.
inline constexpr std::array<std::string_view, 7> bench_program_names = {"pairs", "methods",     "certified", "batch",
                                                                        "peers", "broad_phase", "world"};

/// bench/ of the build tree that this program lies in; where that does not exist, where it would be.
std::filesystem::path built_benchmarks();

/// True if the file can be run.
bool is_program(const std::filesystem::path& file);

/// A number that a program says, by its name.
struct Counter {
  std::string name;
  double value;
  static constexpr auto fields() { return record(kept("name", &Counter::name), kept("value", &Counter::value)); }
  bool operator==(const Counter&) const = default;
};

/// One row of Google Benchmark's: KIND/SUBJECT/WAY, such as time_of_impact/sphere_aabb/careful.
struct BenchRow {
  std::string kind, subject, way;
  double nanoseconds = 0;         ///< [ns] of the processor, an answer
  std::vector<Counter> counters;  ///< those of the suite: errors, floors

  static constexpr auto fields() {
    using B = BenchRow;
    return record(kept("kind", &B::kind), kept("subject", &B::subject), kept("way", &B::way),
                  kept("nanoseconds", &B::nanoseconds), kept("counters", &B::counters));
  }
};

/// Peers that are npm packages, as `peers` calls them where they are missing.
inline constexpr std::array<std::string_view, 5> npm_peers = {"Rapier", "Jolt", "PhysX", "Havok", "Box2D 3"};

/// What one start of a program said.
struct BenchOutput {
  std::string program;
  std::string missing;                      ///< why there are no rows; empty if the program ran
  std::vector<Counter> floors;              ///< of the machine, as the program measured them
  std::vector<std::string> peers_left_out;  ///< libraries that the program was built without
  std::vector<BenchRow> rows;

  static constexpr auto fields() {
    using B = BenchOutput;
    return record(kept("program", &B::program), kept("missing", &B::missing), kept("floors", &B::floors),
                  kept("peers_left_out", &B::peers_left_out), kept("rows", &B::rows));
  }
};

/// From what `program` wrote to --benchmark_out. Throws std::runtime_error, in one line, if that is not such JSON or a row of it
/// says that it failed.
BenchOutput bench_output_from_json(const std::string& program, const std::string& json);

struct BenchOptions {
  double seconds = 0.02;  ///< [s] each row is timed at least so long
  std::string filter;     ///< regular expression; empty: every row
};

/// Starts FOLDER/NAME and waits for it. One at a time in the whole process, so that none disturbs another. A program that is
/// not there gives an output that says so and what to do. Throws std::runtime_error, in one line, if it fails.
BenchOutput run_bench_program(const std::filesystem::path& folder, const std::string& name,
                              const BenchOptions& options);

}  // namespace thinwall
