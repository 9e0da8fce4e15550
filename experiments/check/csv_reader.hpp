#pragma once
/// CSV as RFC 4180 defines it, but for lines that end in LF.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall {

struct CsvRow {
  std::size_t line = 0;  ///< where it begins, from 1
  std::vector<std::string> fields;
};

/// Says what is wrong and in which line.
struct CsvError : std::runtime_error {
  CsvError(std::size_t at, const std::string& what) : std::runtime_error(what), line(at) {}
  std::size_t line;
};

/// Every row, the header too. Throws CsvError.
std::vector<CsvRow> read_csv(std::string_view text);

}  // namespace thinwall
