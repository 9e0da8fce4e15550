#include <thinwall/experiments/speed/model.hpp>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 11> kept_counters = {"missed",     "false",      "p99_error", "max_error",
                                                            "p99_length", "max_length", "p99_width", "max_width",
                                                            "floor_ns",   "to_floor",   "call_ns"};

/// [ns] of one answer. A row that answers many at once says so, or how many items it answers a second.
double nanoseconds_of(const Json& row) {
  if (const auto each = row.find("ns_row"); each != row.end()) return each->get<double>();
  if (const auto rate = row.find("items_per_second"); rate != row.end()) return 1e9 / rate->get<double>();
  const auto unit = row.at("time_unit").get<std::string>();
  const double scale = unit == "s" ? 1e9 : unit == "ms" ? 1e6 : unit == "us" ? 1e3 : 1;
  return scale * row.at("cpu_time").get<double>();
}

/// Without what Google Benchmark adds to a name; rows of batches are named by their pair alone.
std::string row_name(const std::string& program, std::string name) {
  for (const char* option : {"/iterations:", "/real_time"}) name.resize(std::min(name.find(option), name.size()));
  return program == "batch" && !name.starts_with("batch/") ? "batch/" + name : name;
}

BenchRow row_from(const std::string& program, const Json& json) {
  BenchRow row;
  const std::string name = row_name(program, json.at("run_name").get<std::string>());
  if (json.value("error_occurred", false))
    throw std::runtime_error(name + ": " + json.value("error_message", "it says that it failed"));
  const std::size_t first = name.find('/'), second = name.find('/', std::min(first, name.size() - 1) + 1);
  row.kind = name.substr(0, first);
  if (first != std::string::npos) row.subject = name.substr(first + 1, second - first - 1);
  if (second != std::string::npos) row.way = name.substr(second + 1);
  row.nanoseconds = nanoseconds_of(json);
  if (!std::isfinite(row.nanoseconds) || row.nanoseconds < 0) throw std::runtime_error(name + ": its time is no time");
  for (const std::string_view counter : kept_counters) {
    const auto found = json.find(counter);
    if (found != json.end() && found->is_number()) row.counters.push_back({std::string(counter), found->get<double>()});
  }
  return row;
}

void read_context(const Json& context, BenchOutput& output) {
  for (const auto& [key, value] : context.items()) {
    if (!value.is_string()) continue;
    const auto text = value.get<std::string>();
    if (key.starts_with("floor_")) output.floors.push_back({key.substr(6), std::strtod(text.c_str(), nullptr)});
    if (key.starts_with("peer_") && text == "missing") output.peers_left_out.push_back(key.substr(5));
  }
}

namespace fs = std::filesystem;

/// The last line that is not empty, for a message.
std::string last_words(const std::string& output) {
  const std::size_t end = output.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return "it said nothing";
  const std::size_t before = output.find_last_of('\n', end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return clipped(one_line(output.substr(begin, end + 1 - begin)), 300);
}

std::string how_to_build(const std::string& name) {
  if (name == "peers")
    return "configure with -DTHINWALL_PEERS=ON and build again (Debian: libbullet-dev libode-dev libfcl-dev libccd-dev)";
  return "configure with -DTHINWALL_BUILD_BENCH=ON and build again (Debian: libbenchmark-dev)";
}

}  // namespace

BenchOutput bench_output_from_json(const std::string& program, const std::string& json) {
  BenchOutput output;
  output.program = program;
  try {
    const Json all = Json::parse(json);
    read_context(all.at("context"), output);
    for (const Json& row : all.at("benchmarks")) {
      if (row.value("run_type", "iteration") == "iteration") output.rows.push_back(row_from(program, row));
    }
  } catch (const Json::exception& error) {
    throw std::runtime_error("what it wrote is not Google Benchmark's JSON: " + one_line(error.what()));
  }
  return output;
}

fs::path built_benchmarks() {
  std::error_code ignored;
  const fs::path here = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  const fs::path beside = here / "bench", above = here.parent_path() / "bench";
  return !fs::is_directory(beside, ignored) && fs::is_directory(above, ignored) ? above : beside;
}

bool is_program(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

BenchOutput run_bench_program(const fs::path& folder, const std::string& name, const BenchOptions& options) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const fs::path program = fs::absolute(folder) / name;
  if (!is_program(program)) {
    BenchOutput output;
    output.program = name;
    output.missing = fmt::format("it is not in the folder of the benchmarks: {}", how_to_build(name));
    return output;
  }
  const Workshop scratch(fs::temp_directory_path());
  const fs::path out = scratch.path() / "out.json";
  std::vector<std::string> words = {program.string(), fmt::format("--benchmark_min_time={}", options.seconds),
                                    "--benchmark_out=" + out.string(), "--benchmark_out_format=json"};
  if (!options.filter.empty()) words.push_back("--benchmark_filter=" + options.filter);
  const ProcessResult run = run_process(words, scratch.path());
  if (run.status == -1) throw std::runtime_error(fmt::format("{} was killed by a signal", program.string()));
  if (run.status != 0) {
    throw std::runtime_error(fmt::format("{} ended with status {}: {}", program.string(), run.status,  //
                                         last_words(run.output)));
  }
  try {
    const std::string json = file_text(out);
    if (json.empty() && !options.filter.empty()) return {name, "", {}, {}, {}};  // no row has the filter's text
    return bench_output_from_json(name, json);
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", program.string(), error.what()));
  }
}

}  // namespace thinwall
