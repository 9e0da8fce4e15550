#pragma once
/// What a result was made of: its manifest, the commit and the machine, its configuration, how to cite it.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/journal.hpp>
#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {

// ---- What is known about a run beside its outcome: what was asked, by which program, on which machine, and when.

/// The program, as it was built.
struct BuildRecord {
  std::string version, release_date, compiler;
  std::string flags, build_type;                               ///< the flags but for the warnings
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

struct RunRecord : RunIdentity {
  std::string question;
  bool default_config = false;  ///< true if it is the experiment's own
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

/// SHA-256 of the running program, or of the module that this code was loaded with; empty where it cannot be read.
std::string this_program_sha256();

/// ISO 8601 in UTC, to the second.
std::string utc_text(std::chrono::system_clock::time_point time);

/// The command line that reproduces the run, called from inside its result folder unless `default_config`.
std::string reproduce_line(const RunRecord& run);

/// A short name for the experiment, config, seed and trials together: the start of their SHA-256.
std::string run_id(const RunIdentity& run);

// ---- manifest.json: where a result came from and what belongs to it.

inline constexpr const char* manifest_name = "manifest.json";

/// `hashes`: SHA-256 of each file of the result, by its path in the folder. `unhashed`: the paths of those that differ from
/// run to run.
std::string manifest_text(const RunRecord& run, const Outcome& outcome,
                          const std::map<std::string, std::string>& hashes, const std::vector<std::string>& unhashed);

/// What a manifest says, of this run or of anybody's.
struct Manifest {
  RunIdentity run;
  std::string question, answer, summary;
  std::string run_id, reproduce;  ///< as it gives them; they may not be those of `run`
  std::string finished;           ///< ISO 8601 in UTC
  bool self_test_passed = false;
  std::string version, release_date;                       ///< of the program; the latter is empty if it is not given
  std::string commit;                                      ///< hexadecimal, or "unknown"
  bool dirty = false;                                      ///< tracked files differed from that commit
  std::vector<std::pair<std::string, std::string>> facts;  ///< commit, compiler, libraries, machine: name and value
  std::map<std::string, std::string> hashes;               ///< SHA-256 of each file that must not differ, by path
  std::vector<std::string> unhashed;                       ///< files that differ from run to run

  std::vector<std::string> files() const;  ///< all that it names, by path
};

/// Throws UsageError in one line, which names `file`, the key, what was found and what is allowed.
Manifest parse_manifest(const std::string& text, const std::string& file);

/// True of a relative path that does not leave the folder it is seen from: of every file of a result.
bool stays_within(const std::string& path);

/// True if `folder` itself holds the file: it is a regular one, and no link leads to it from there.
bool holds_file(const std::filesystem::path& folder, const std::string& file);

/// True if it does, and the file has that SHA-256: as the manifest says that the run wrote it.
bool is_unchanged(const std::filesystem::path& folder, const std::string& file, const std::string& hash);

// ---- Where two results came from, held against each other: it may explain why they differ.

/// A fact of which two results differ.
struct FactChange {
  std::string fact, recorded, rerun;
};

/// In the order of the facts. A change of the program alone, with the same commit and build, is one of uncommitted sources.
std::vector<FactChange> changed_facts(const Manifest& recorded, const Manifest& rerun);

// ---- The whole configuration of a run as a TOML file that runs as it is.

std::string resolved_toml(const RunRecord& run);

/// The same without the line that runs it again.
std::string config_toml(const RunIdentity& run);

// ---- BibTeX entries of the software and of one result.

/// What CITATION.cff says of the software.
struct SoftwareCitation {
  std::string title;
  std::string authors;        ///< a BibTeX list
  std::string version, date;  ///< of that release; ISO 8601
  std::string license;        ///< an SPDX name

  static constexpr auto fields() {
    using T = SoftwareCitation;
    return record(kept("title", &T::title), kept("authors", &T::authors), kept("version", &T::version),
                  kept("date", &T::date), kept("license", &T::license));
  }
};

struct ResultCitation {
  std::string experiment, question;
  std::string run_id;  ///< of experiment, config, seed and trials together
  std::uint64_t seed = 0;
  std::string commit;  ///< full git hash of the program, or "unknown"
  bool dirty = false;  ///< tracked files differed from that commit
  std::string date;    ///< ISO 8601, of the day it was finished

  static constexpr auto fields() {
    using T = ResultCitation;
    return record(kept("experiment", &T::experiment), kept("title", &T::question), kept("run_id", &T::run_id),
                  kept("seed", &T::seed), kept("commit", &T::commit), kept("dirty", &T::dirty), kept("date", &T::date));
  }
};

/// This program, as CITATION.cff named it when it was built.
SoftwareCitation this_software();

ResultCitation citation_of(const RunRecord& run);

std::string bibtex(const SoftwareCitation& software);
std::string bibtex(const ResultCitation& result);

/// The whole of cite.bib: the software, then the result.
std::string bibtex(const SoftwareCitation& software, const ResultCitation& result);

}  // namespace thinwall
