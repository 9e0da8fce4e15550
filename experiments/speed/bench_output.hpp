#pragma once
/// What one start of a benchmark program said, as Google Benchmark's JSON holds it.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall {

/// One row: KIND/SUBJECT/WAY, such as time_of_impact/sphere_aabb/kernel.
struct BenchRow {
  std::string kind, subject, way;
  double nanoseconds = 0;                  ///< [ns] of the processor, an answer
  std::map<std::string, double> counters;  ///< those of the suite: errors, floors
};

struct BenchOutput {
  std::string program;
  std::string missing;                      ///< why there are no rows; empty if the program ran
  std::map<std::string, double> floors;     ///< of the machine, as the program measured them
  std::vector<std::string> peers_left_out;  ///< libraries that the program was built without
  std::vector<BenchRow> rows;
};

/// From what `program` wrote to --benchmark_out. Throws std::runtime_error, in one line, if that is not such JSON or a row of it
/// says that it failed.
BenchOutput bench_output_from_json(const std::string& program, const std::string& json);

/// For the journal: one line, and back. Throws std::runtime_error.
std::string to_line(const BenchOutput& output);
BenchOutput bench_output_from_line(const std::string& line);

}  // namespace thinwall
