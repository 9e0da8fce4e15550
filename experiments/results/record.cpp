#include <thinwall/experiments/results/record.hpp>

#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <thread>

#include <fmt/format.h>

#include <thinwall/experiments/text/sha256.hpp>
#include <thinwall_build_info.hpp>

namespace thinwall {
namespace {

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const auto value = line.find(": ");
    if (value != std::string::npos) return line.substr(value + 2);
  }
  return "unknown";
}

}  // namespace

BuildRecord this_build() {
  BuildRecord out{.version = std::string(build_version),
                  .release_date = std::string(build_release_date),
                  .compiler = std::string(build_compiler),
                  .flags = std::string(build_flags),
                  .build_type = std::string(build_type),
                  .commit = std::string(build_commit),
                  .dirty = build_dirty,
                  .libraries = {}};
  for (const auto& [name, version] : build_libraries) out.libraries.emplace_back(name, version);
  return out;
}

MachineRecord this_machine() {
  MachineRecord out{
      .cpu = cpu_model(), .system = "unknown", .cores = static_cast<int>(std::thread::hardware_concurrency())};
  if (utsname name{}; uname(&name) == 0) out.system = fmt::format("{} {} {}", name.sysname, name.release, name.machine);
  return out;
}

std::string this_program_sha256() {
  static const std::string hash = sha256_of_file("/proc/self/exe");
  return hash;
}

std::string utc_text(std::chrono::system_clock::time_point time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday,
                     parts.tm_hour, parts.tm_min, parts.tm_sec);
}

std::string reproduce_line(const RunRecord& run) {
  std::string line = "thinwall run ";
  line += run.default_config ? run.experiment : "resolved.toml";
  line += fmt::format(" --seed {}", run.seed);
  if (run.trials) line += fmt::format(" --trials {}", *run.trials);
  return line + (run.default_config ? " --out again" : " --out ../again");  // a result within a result is none of it
}

std::string run_id(const RunRecord& run) {
  const std::string trials = run.trials ? std::to_string(*run.trials) : "default";
  return sha256(fmt::format("{}\n{}\n{}\n{}", run.experiment, run.config, run.seed, trials)).substr(0, 12);
}

}  // namespace thinwall
