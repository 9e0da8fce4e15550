#pragma once
/// manifest.json: where a result came from and what belongs to it.

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/results/record.hpp>
#include <thinwall/experiments/run/identity.hpp>

namespace thinwall {

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
};

/// Throws UsageError in one line, which names `file`, the key, what was found and what is allowed.
Manifest parse_manifest(const std::string& text, const std::string& file);

/// True of a relative path that does not leave the folder it is seen from: of every file of a result.
bool stays_within(const std::string& path);

/// True if `folder` itself holds the file: it is a regular one, and no link leads to it from there.
bool holds_file(const std::filesystem::path& folder, const std::string& file);

}  // namespace thinwall
