#pragma once
/// Benchmark programs that are not, and runs of the experiment speed over them.

#include <filesystem>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <thinwall/experiments/experiment_list.hpp>

#include "support/experiment_run.hpp"
#include "support/program.hpp"

namespace thinwall {

/// A program FOLDER/NAME that runs `body`; $out is the file that --benchmark_out names.
inline void write_program(const std::filesystem::path& folder, const std::string& name, const std::string& body) {
  write_script(folder / name,
               "for word in \"$@\"; do case $word in --benchmark_out=*) out=${word#*=} ;; esac; done\n" + body);
}

/// It writes `json` and succeeds.
inline void write_bench(const std::filesystem::path& folder, const std::string& name, const std::string& json) {
  write_program(folder, name, "cat >\"$out\" <<'END'\n" + json + "\nEND");
}

inline std::string bench_row(std::string_view name, double nanoseconds, int missed, int false_hits, double length) {
  return fmt::format(
      R"({{"name": "{0}", "run_name": "{0}", "run_type": "iteration", "cpu_time": {1}, "time_unit": "ns", "missed": {2}, "false": {3}, )"
      R"("p99_error": {4}, "max_error": {4}, "p99_length": {4}, "max_length": {4}, "floor_ns": 2, "to_floor": {5}}})",
      name, nanoseconds, missed, false_hits, length, nanoseconds / 2);
}

inline std::string bench_json(std::string_view rows, std::string_view context = R"("floor_division_ns": "1.5")") {
  return fmt::format(R"({{"context": {{{}}}, "benchmarks": [{}]}})", context, rows);
}

/// The experiment over the programs in `folder`, in two rounds; `more` are further settings.
inline std::unique_ptr<Run> speed_run(const std::filesystem::path& folder, const std::string& more = "") {
  return run_of(speed_experiment(), fmt::format("benchmarks = \"{}\"\nrounds = 2\n{}", folder.string(), more));
}

}  // namespace thinwall
