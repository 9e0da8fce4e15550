#pragma once
/// A complete result, read back from its folder.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/results/citation.hpp>

namespace thinwall {

/// What manifest.json says of a result to someone who did not run it.
struct KeptResult {
  std::filesystem::path folder;
  std::string answer, summary;
  std::string config;                  ///< canonical JSON
  std::optional<std::int64_t> trials;  ///< as given on the command line
  bool self_test_passed = false;
  std::string reproduce;                      ///< the command line that gives it again
  std::map<std::string, std::string> hashes;  ///< SHA-256 by path
  std::vector<std::string> unhashed;          ///< files that differ from run to run
  SoftwareCitation software;
  ResultCitation citation;
};

/// What the manifest in `folder` says. Throws UsageError, naming it as `file`, if it is damaged or not ours.
KeptResult kept_result(const std::filesystem::path& folder, const std::string& file);

/// `1/3` if `folder` holds a finished shard of a run; empty if not.
std::string shard_in(const std::filesystem::path& folder);

/// Throws UsageError if `folder` holds no complete result.
KeptResult read_result(const std::filesystem::path& folder);

}  // namespace thinwall
