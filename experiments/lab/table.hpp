#pragma once
/// Typed, unit-bearing tables: what an experiment hands over instead of writing files.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace thinwall {

/// One cell of a table. `std::monostate` is a missing value: an empty field in CSV.
using Value = std::variant<std::monostate, std::string, std::int64_t, double, bool>;

enum class ColumnType { text, integer, number, boolean };

struct Column {
  std::string name;  ///< snake_case, unique in its table
  ColumnType type = ColumnType::number;
  std::string unit;         ///< "m/s", "deg", "1"; empty for text
  std::string description;  ///< one sentence
  /// The names of the columns of the same table that hold the ends of its interval; empty if it has none. A table for readers
  /// shows the three in one cell, rounded to what the interval supports.
  std::string lower = {}, upper = {};
};

struct Table {
  std::string name;         ///< the file is data/<name>.csv
  std::string description;  ///< one sentence
  std::vector<Column> columns;
  std::vector<std::vector<Value>> rows;  ///< every row as long as `columns`
  bool is_timing = false;                ///< differs from run to run: left out of the manifest's hashes
  bool in_report = false;                ///< shown whole in the report; otherwise only linked
};

}  // namespace thinwall
