#pragma once
/// A complete result, read back from its folder.

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
  bool self_test_passed = false;
  std::string reproduce;                      ///< the command line that gives it again
  std::map<std::string, std::string> hashes;  ///< SHA-256 by path
  std::vector<std::string> unhashed;          ///< files that differ from run to run
  SoftwareCitation software;
  ResultCitation citation;
};

/// Nothing if `text` is no manifest of ours.
std::optional<KeptResult> parse_kept_result(const std::string& text);

/// Throws UsageError if `folder` holds no complete result.
KeptResult read_result(const std::filesystem::path& folder);

}  // namespace thinwall
