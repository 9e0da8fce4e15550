#pragma once
/// manifest.json: where a result came from and what belongs to it.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/results/record.hpp>

namespace thinwall {

/// `hashes`: SHA-256 of each file of the result, by its path in the folder. `unhashed`: the paths of those that differ from
/// run to run.
std::string manifest_text(const RunRecord& run, const Outcome& outcome,
                          const std::map<std::string, std::string>& hashes, const std::vector<std::string>& unhashed);

/// What a rerun needs to know of the result that a folder holds.
struct Manifest {
  std::string identity;  ///< identity_text of its run
  std::string answer, summary;
  bool self_test_passed = false;
  std::map<std::string, std::string> hashes;
  std::vector<std::string> unhashed;  ///< files that differ from run to run
};

/// True of a relative path that does not leave the folder it is seen from: of every file of a result.
bool stays_within(const std::string& path);

/// Nothing if `text` is no manifest of ours.
std::optional<Manifest> parse_manifest(const std::string& text);

}  // namespace thinwall
