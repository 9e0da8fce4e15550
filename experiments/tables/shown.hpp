#pragma once
/// A table as readers see it, before it is spelled in one format or another: rounded, a value and its interval in one cell,
/// and what is the same in every row told in words.

#include <string>
#include <vector>

#include <thinwall/experiments/table.hpp>

namespace thinwall {

inline constexpr const char* missing_text = "\u2013";  ///< an en dash

struct ShownCell {
  std::string text;
  bool is_number = false;    ///< may have an exponent, as in 1.5e-07
  std::string lower, upper;  ///< the ends of its interval, numbers too; or both empty
};

struct ShownColumn {
  std::string header;       ///< with its unit, if that is not 1
  std::string description;  ///< as the table gives it
  bool right = false;       ///< aligned so
};

struct ShownTable {
  std::vector<ShownColumn> columns;
  std::vector<std::vector<ShownCell>> rows;
  std::string caption;  ///< what the table is, what is the same in every row, and what stands in brackets
};

/// The column's name in words, and its unit if it has one: `step ratio`, `angle [deg]`.
std::string header_of(const Column& column);

/// Throws std::logic_error if a column names an end of its interval that is not there.
ShownTable shown(const Table& table);

}  // namespace thinwall
