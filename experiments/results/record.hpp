#pragma once
/// What is known about a run beside its outcome: what was asked, by which program, on which machine, and when.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace thinwall {

/// The program, as it was built.
struct BuildRecord {
  std::string version, release_date, compiler, flags, build_type;
  std::string commit;                                          ///< full git hash, or "unknown"
  bool dirty = false;                                          ///< tracked files differed from that commit
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name and version
};

struct MachineRecord {
  std::string cpu, system;  ///< the model's name; the operating system's name, release and architecture
  int cores = 0;            ///< hardware threads
};

/// Where and when a shard was computed.
struct ShardRecord {
  std::string shard;              ///< as in `2/4`
  std::string cpu, system;        ///< of its machine
  std::string started, finished;  ///< ISO 8601 in UTC
};

struct RunRecord {
  std::string experiment, question;
  std::string config;           ///< canonical JSON
  bool default_config = false;  ///< true if it is the experiment's own
  std::uint64_t seed = 0;
  std::optional<std::int64_t> trials;  ///< as given on the command line
  std::vector<std::string> argv;
  int threads = 1;
  std::size_t units = 0, resumed_units = 0;
  std::int64_t total_trials = 0;
  std::chrono::system_clock::time_point started, finished;
  BuildRecord build;
  MachineRecord machine;
  int ranks = 1;                         ///< processes that computed it together
  std::vector<ShardRecord> shards = {};  ///< that it was merged from
};

BuildRecord this_build();
MachineRecord this_machine();

/// SHA-256 of the running program; empty where it cannot be read.
std::string this_program_sha256();

/// ISO 8601 in UTC, to the second.
std::string utc_text(std::chrono::system_clock::time_point time);

/// The command line that reproduces the run, called from inside its result folder unless `default_config`.
std::string reproduce_line(const RunRecord& run);

/// A short name for the experiment, config, seed and trials together: the start of their SHA-256.
std::string run_id(const RunRecord& run);

}  // namespace thinwall
