#pragma once
/// A table as CSV, as Markdown, LaTeX and HTML, and described for machines.

#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/table.hpp>

namespace thinwall {

/// The column of that name. Throws std::logic_error if the table has none.
std::size_t place_of(const Table& table, std::string_view column);

/// The number in a cell, whole or real; nothing where there is none, or it is not finite.
std::optional<double> finite_number(const Value& value);

// ---- A table as CSV (RFC 4180, lines end in LF), and all tables of a result as a Frictionless Data Package.

/// One field, without quotes: numbers in shortest form that reads back as the same bits; missing and NaN are empty.
std::string exact_text(const Value& value);

/// A text that a spreadsheet would compute stands behind a single quote, as docs/results.md says. Throws std::logic_error, naming
/// the row, if one is not as long as the columns, or a value not of its column's type.
std::string csv_text(const Table& table);

struct CsvRow {
  std::size_t line = 0;  ///< where it begins, from 1
  std::vector<std::string> fields;
};

/// Says what is wrong and in which line.
struct CsvError : std::runtime_error {
  CsvError(std::size_t at, const std::string& what) : std::runtime_error(what), line(at) {}
  std::size_t line;
};

/// Every row, the header too, of a file as `csv_text` writes it. Throws CsvError.
std::vector<CsvRow> read_csv(std::string_view text);

struct PackageInfo {
  std::string name, title, description, version;
};

/// datapackage.json: https://specs.frictionlessdata.io/tabular-data-package/
std::string datapackage_text(const PackageInfo& info, std::span<const Table> tables);

// ---- A table as readers see it, before it is spelled in one format or another: rounded, a value and its interval in one cell,
// and what is the same in every row told in words.

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

// ---- A table for readers: rounded, with units in its header, as Markdown, LaTeX and HTML.

std::string markdown_table(const Table& whole);

/// A `tabular` in the style of booktabs, to `\input` into a `table` environment.
std::string latex_table(const Table& whole);

std::string html_table(const Table& whole);

}  // namespace thinwall
