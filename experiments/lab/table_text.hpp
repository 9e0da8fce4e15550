#pragma once
/// A table as CSV, as Markdown, LaTeX and HTML, and described for machines.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/table.hpp>

namespace thinwall {

// ---- A table as CSV (RFC 4180, lines end in LF), and all tables of a result as a Frictionless Data Package.

/// One field, without quotes: numbers in shortest form that reads back as the same bits; missing and NaN are empty.
std::string exact_text(const Value& value);

/// A text that a spreadsheet would compute stands behind a single quote, as docs/results.md says. Throws std::logic_error, naming the row, if one is not as long as the columns, or a value not of its column's type.
std::string csv_text(const Table& table);

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

/// A value as a reader sees it: four significant digits, thousands apart in counts, a dash where it is missing.
std::string shown_text(const Value& value);

std::string markdown_table(const Table& whole);

/// A `tabular` in the style of booktabs, to `\input` into a `table` environment.
std::string latex_table(const Table& whole);

std::string html_table(const Table& whole);

// ---- A narrower table, for a report: what a reader looks at, in the order in which it stood.

/// Removes the columns of these names, each of which must be there.
Table without_columns(const Table& table, std::span<const std::string_view> names);

}  // namespace thinwall
