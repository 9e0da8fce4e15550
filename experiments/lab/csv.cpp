#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/sha256.hpp>
#include <thinwall/experiments/lab/table_text.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

std::size_t place_of(const Table& table, std::string_view column) {
  const auto found = std::ranges::find(table.columns, column, &Column::name);
  if (found == table.columns.end())
    throw std::logic_error(fmt::format("table '{}' has no column '{}'", table.name, column));
  return static_cast<std::size_t>(found - table.columns.begin());
}

namespace {

std::string number_field(double value) {
  if (std::isnan(value)) return {};
  if (std::isinf(value)) return value > 0 ? "INF" : "-INF";  // as Table Schema spells them
  return exact_text(value);
}

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  return '"' + replaced(field, {{'"', "\"\""}}) + '"';
}

/// A spreadsheet computes what begins so and goes on; behind a quote it is text. A text that begins with a quote gets one too, so
/// that whoever takes one off has every text back.
std::string guarded(const std::string& text) {
  const bool is_formula = text.size() > 1 && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos;
  return is_formula || text.starts_with('\'') ? "'" + text : text;
}

std::string field(const Value& value) {
  const auto* const text = std::get_if<std::string>(&value);
  return quoted(text ? guarded(*text) : exact_text(value));
}

bool fits(const Value& value, ColumnType type) {
  if (std::holds_alternative<std::monostate>(value)) return true;
  switch (type) {
    case ColumnType::text: return std::holds_alternative<std::string>(value);
    case ColumnType::integer: return std::holds_alternative<std::int64_t>(value);
    case ColumnType::number:
      return std::holds_alternative<double>(value) || std::holds_alternative<std::int64_t>(value);
    case ColumnType::boolean: return std::holds_alternative<bool>(value);
  }
  return false;
}

void require_shape(const Table& table) {
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto& row = table.rows[i];
    const std::string where = "table '" + table.name + "', row " + std::to_string(i + 1);
    if (row.size() != table.columns.size()) throw std::logic_error(where + ": not as long as the columns");
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (fits(row[j], table.columns[j].type)) continue;
      throw std::logic_error(where + ": '" + table.columns[j].name + "' has another type than its column");
    }
  }
}

}  // namespace

std::string exact_text(const Value& value) {
  struct Visitor {
    std::string operator()(std::monostate) const { return {}; }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(std::int64_t number) const { return std::to_string(number); }
    std::string operator()(double number) const { return number_field(number); }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
  };
  return std::visit(Visitor{}, value);
}

std::string csv_text(const Table& table) {
  require_shape(table);
  std::string out;
  for (std::size_t j = 0; j < table.columns.size(); ++j) out += (j > 0 ? "," : "") + quoted(table.columns[j].name);
  out += "\n";
  for (const auto& row : table.rows) {
    for (std::size_t j = 0; j < row.size(); ++j) out += (j > 0 ? "," : "") + field(row[j]);
    out += "\n";
  }
  return out;
}

namespace {

using nlohmann::ordered_json;

const char* type_name(ColumnType type) {
  switch (type) {
    case ColumnType::text: return "string";
    case ColumnType::integer: return "integer";
    case ColumnType::number: return "number";
    case ColumnType::boolean: return "boolean";
  }
  return "any";
}

ordered_json field(const Column& column) {
  ordered_json out = {{"name", column.name}, {"type", type_name(column.type)}};
  if (!column.unit.empty()) out["unit"] = column.unit;
  out["description"] = column.description;
  return out;
}

ordered_json resource(const Table& table) {
  ordered_json out = {
      {"name", table.name},
      {"path", "data/" + table.name + ".csv"},
      {"profile", "tabular-data-resource"},
      {"description", table.description},
      {"format", "csv"},
      {"mediatype", "text/csv"},
      {"encoding", "utf-8"},
      {"dialect", {{"delimiter", ","}, {"lineTerminator", "\n"}, {"doubleQuote", true}, {"header", true}}}};
  if (!table.is_timing) {  // timings differ from run to run, and this file should not
    const std::string text = csv_text(table);
    out["bytes"] = text.size();
    out["hash"] = "sha256:" + sha256(text);
  }
  ordered_json fields = ordered_json::array();
  for (const Column& column : table.columns) fields.push_back(field(column));
  out["schema"] = {{"fields", fields}, {"missingValues", {""}}};
  return out;
}

}  // namespace

std::string datapackage_text(const PackageInfo& info, std::span<const Table> tables) {
  ordered_json out = {
      {"profile", "tabular-data-package"}, {"name", info.name},       {"title", info.title},
      {"description", info.description},   {"version", info.version}, {"resources", ordered_json::array()}};
  for (const Table& table : tables) out["resources"].push_back(resource(table));
  return out.dump(2) + "\n";
}

namespace {

/// The field that begins at `at`, which is moved to what ends it: a comma, a line's end, or the end of the text.
std::string read_field(std::string_view text, std::size_t& at, std::size_t line) {
  if (at == text.size() || text[at] != '"') {
    const std::size_t end = std::min(text.find_first_of(",\n", at), text.size());
    const std::string_view field = text.substr(at, end - at);
    if (field.find_first_of("\"\r") != std::string::npos)
      throw CsvError(line, "a quote or a CR in a field without quotes");
    at = end;
    return std::string(field);
  }
  std::string field;
  for (++at; at < text.size(); ++at) {
    if (text[at] != '"') {
      field += text[at];
    } else if (at + 1 < text.size() && text[at + 1] == '"') {
      field += text[at++];
    } else {
      ++at;
      if (at < text.size() && text[at] != ',' && text[at] != '\n') throw CsvError(line, "text behind a closing quote");
      return field;
    }
  }
  throw CsvError(line, "a quote is not closed");
}

}  // namespace

std::vector<CsvRow> read_csv(std::string_view text) {
  std::vector<CsvRow> rows;
  std::size_t line = 1;
  for (std::size_t at = 0; at < text.size(); ++at) {
    CsvRow row{line, {}};
    for (const std::size_t begin = at;; ++at) {
      row.fields.push_back(read_field(text, at, line));
      if (at < text.size() && text[at] == ',') continue;
      line += static_cast<std::size_t>(std::ranges::count(text.substr(begin, at - begin), '\n')) + 1;
      break;
    }
    if (at == text.size()) throw CsvError(row.line, "the last line has no end: the file was cut");
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace thinwall
