#include <thinwall/experiments/validate/query_file.hpp>

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t columns = 7;
constexpr std::size_t most_digits = 10'000;  // of an integer; the largest ratio a double needs has 324

std::vector<std::string_view> fields_of(std::string_view row) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = row.find(',');
    fields.push_back(row.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    row.remove_prefix(comma + 1);
  }
}

bool is_integer(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Boost takes a leading zero for octal.
Integer integer(std::string_view text) {
  const bool negative = text.starts_with('-');
  const std::size_t first = text.find_first_not_of("-0");
  if (first == std::string_view::npos) return 0;
  const Integer value(std::string(text.substr(first)));
  return negative ? -value : value;
}

std::string shown(const fs::path& path) { return one_line(path.string()); }

}  // namespace

std::string_view name(Primitives primitives) {
  return primitives == Primitives::vertex_face ? "vertex-face" : "edge-edge";
}

QueryFile::QueryFile(const fs::path& file) : shown_(shown(file)), in_(file, std::ios::binary) {
  if (!in_) throw UsageError(shown_ + ": cannot be read");
  bool found = false;
  for (const fs::path& part : fs::absolute(file)) {
    for (const Primitives primitives : {Primitives::vertex_face, Primitives::edge_edge}) {
      if (part != name(primitives)) continue;
      primitives_ = primitives;
      found = true;
    }
  }
  if (!found) throw UsageError(shown_ + ": is in no folder named vertex-face or edge-edge, so what meets is not known");
}

void QueryFile::refuse(const std::string& reason) const {
  throw UsageError(fmt::format("{}:{}: {}", shown_, line_, reason));
}

bool QueryFile::next_row(RationalPoint& vertex, bool& answer) {
  std::string row;
  if (!std::getline(in_, row)) {
    if (in_.bad()) throw UsageError(shown_ + ": cannot be read");
    return false;
  }
  ++line_;
  if (row.ends_with('\r')) row.pop_back();
  const std::vector<std::string_view> fields = fields_of(row);
  if (fields.size() != columns) refuse(fmt::format("{} columns; 7 are needed", fields.size()));
  for (std::size_t i = 0; i + 1 < columns; ++i) {
    const std::string_view field = fields[i];
    if (field.size() > most_digits) refuse(fmt::format("column {}: more than {} digits", i + 1, most_digits));
    if (!is_integer(field)) {
      refuse(fmt::format("column {}: '{}' is not an integer", i + 1, one_line(clipped(field, 40))));
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto denominator = integer(fields[2 * i + 1]);
    if (denominator == 0) refuse(fmt::format("column {}: a denominator of zero", 2 * i + 2));
    vertex[i] = Rational(integer(fields[2 * i])) / Rational(denominator);  // whose sign may be either
  }
  const std::string_view last = fields[columns - 1];
  if (last != "0" && last != "1") refuse(fmt::format("column 7: '{}'; 0 or 1", one_line(clipped(last, 40))));
  answer = last == "1";
  return true;
}

std::optional<PublishedQuery> QueryFile::next() {
  PublishedQuery query;
  for (std::size_t row = 0; row < 8; ++row) {
    RationalPoint& vertex = row < 4 ? query.at_start[row] : query.at_end[row - 4];
    bool answer = false;
    if (!next_row(vertex, answer)) {
      if (row > 0) refuse(fmt::format("the file ends after {} of the 8 rows of a query", row));
      if (line_ == 0) throw UsageError(shown_ + ":1: the file is empty; 8 rows a query");
      return std::nullopt;
    }
    if (row > 0 && answer != query.collides) refuse("column 7: differs within the 8 rows of a query");
    if (row == 0) query.line = line_;
    query.collides = answer;
  }
  return query;
}

std::vector<fs::path> query_files(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) throw UsageError(shown(folder) + ": there is no such folder");
  if (!fs::is_directory(folder, error)) throw UsageError(shown(folder) + ": is not a folder");
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() != ".csv") continue;
    if (!entry->is_regular_file(error))
      throw UsageError(shown(entry->path()) + ": is not a regular file; no other is read");
    files.push_back(entry->path());
  }
  if (error) throw UsageError(shown(folder) + ": cannot be read: " + error.message());
  if (files.empty()) throw UsageError(shown(folder) + ": has no CSV files of queries");
  std::ranges::sort(files);
  return files;
}

}  // namespace thinwall
