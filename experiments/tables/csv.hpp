#pragma once
/// A table as CSV (RFC 4180, lines end in LF), and all tables of a result as a Frictionless Data Package.

#include <span>
#include <string>

#include <thinwall/experiments/table.hpp>

namespace thinwall {

/// One field, without quotes: numbers in shortest form that reads back as the same bits; missing and NaN are empty.
std::string exact_text(const Value& value);

/// A text that a spreadsheet would compute stands behind a single quote, as docs/results.md says. Throws std::logic_error, naming the row, if one is not as long as the columns, or a value not of its column's type.
std::string csv_text(const Table& table);

struct PackageInfo {
  std::string name, title, description, version;
};

/// datapackage.json: https://specs.frictionlessdata.io/tabular-data-package/
std::string datapackage_text(const PackageInfo& info, std::span<const Table> tables);

}  // namespace thinwall
