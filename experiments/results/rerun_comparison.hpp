#pragma once
/// A result and a rerun of it, held against each other file by file.

#include <filesystem>
#include <string>
#include <vector>

#include <thinwall/experiments/results/file_difference.hpp>
#include <thinwall/experiments/results/provenance.hpp>

namespace thinwall {

/// Files of a result that are not what its manifest says they were: changed by hand since, or lost.
std::vector<std::string> files_changed_since(const std::filesystem::path& result, const Manifest& recorded);

struct RerunComparison {
  int files = 0;                            ///< compared: all that either manifest hashes
  std::vector<FileDifference> differences;  ///< the first of each file
  std::vector<FactChange> facts;            ///< that may explain them
  bool explained_by_hand = false;           ///< every difference is in a file that was changed since it was written
};

/// `changed`: as `files_changed_since` found them. Throws std::system_error if a file cannot be read.
RerunComparison compare_rerun(const std::filesystem::path& result, const Manifest& recorded,
                              const std::vector<std::string>& changed, const std::filesystem::path& rerun,
                              const Manifest& again);

}  // namespace thinwall
