#pragma once
/// The benchmark programs: which there are, where they lie, and running one.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <thinwall/experiments/speed/bench_output.hpp>

namespace thinwall {

/// In the order of a round.
std::span<const std::string_view> bench_program_names();

/// bench/ of the build tree that this program lies in; where that does not exist, where it would be.
std::filesystem::path built_benchmarks();

/// True if the file can be run.
bool is_program(const std::filesystem::path& file);

struct BenchOptions {
  double seconds = 0.02;  ///< [s] each row is timed at least so long
  std::string filter;     ///< regular expression; empty: every row
};

/// Starts FOLDER/NAME and waits for it. One at a time in the whole process, so that none disturbs another. A program that is
/// not there gives an output that says so and what to do. Throws std::runtime_error, in one line, if it fails.
BenchOutput run_bench_program(const std::filesystem::path& folder, const std::string& name,
                              const BenchOptions& options);

}  // namespace thinwall
