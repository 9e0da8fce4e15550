#include <thinwall/experiments/speed/bench_output.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/text/escape.hpp>

namespace thinwall {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 10> kept_counters = {"missed",     "false",      "p99_error", "max_error",
                                                            "p99_length", "max_length", "p99_width", "max_width",
                                                            "floor_ns",   "to_floor"};

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
    if (found != json.end() && found->is_number()) row.counters[std::string(counter)] = found->get<double>();
  }
  return row;
}

void read_context(const Json& context, BenchOutput& output) {
  for (const auto& [key, value] : context.items()) {
    if (!value.is_string()) continue;
    const auto text = value.get<std::string>();
    if (key.starts_with("floor_")) output.floors[key.substr(6)] = std::strtod(text.c_str(), nullptr);
    if (key.starts_with("peer_") && text == "missing") output.peers_left_out.push_back(key.substr(5));
  }
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

std::string to_line(const BenchOutput& output) {
  Json line = {{"program", output.program},
               {"missing", output.missing},
               {"floors", output.floors},
               {"peers_left_out", output.peers_left_out}};
  line["rows"] = Json::array();
  for (const BenchRow& row : output.rows)
    line["rows"].push_back({row.kind, row.subject, row.way, row.nanoseconds, row.counters});
  return line.dump();
}

BenchOutput bench_output_from_line(const std::string& line) {
  try {
    const Json json = Json::parse(line);
    BenchOutput output{json.at("program"), json.at("missing"), json.at("floors"), json.at("peers_left_out"), {}};
    for (const Json& row : json.at("rows"))
      output.rows.push_back({row.at(0), row.at(1), row.at(2), row.at(3), row.at(4)});
    return output;
  } catch (const Json::exception& error) {
    throw std::runtime_error("not the output of a benchmark: " + one_line(error.what()));
  }
}

}  // namespace thinwall
