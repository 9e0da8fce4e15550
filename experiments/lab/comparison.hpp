#pragma once
/// What differs between a result and the same run again.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/lab/manifest.hpp>

namespace thinwall {

// ---- Where two versions of a file first differ: a CSV file by row and column, any other by line.

struct FileDifference {
  enum class Kind { cell, row, columns, line, only_recorded, only_rerun };
  std::string file;  ///< its path in the result folder
  Kind kind = Kind::line;
  std::int64_t row = 0;         ///< cell, row: of the data, from 1; line: of the file, from 1
  std::string column;           ///< cell: its name
  std::string recorded, rerun;  ///< what stands there; empty where there is nothing
};

/// Nothing if the two are the same; of a BibTeX file, but for dates, commits and versions, which are those of the program.
std::optional<FileDifference> first_difference(const std::string& file, const std::string& recorded,
                                               const std::string& rerun);

/// `data/cells.csv: row 12, column 'hits': recorded 405, rerun 406`.
std::string to_text(const FileDifference& difference);

// ---- A result and a rerun of it, held against each other file by file.

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
