#pragma once
/// Where two versions of a file first differ: a CSV file by row and column, any other by line.

#include <cstdint>
#include <optional>
#include <string>

namespace thinwall {

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

}  // namespace thinwall
