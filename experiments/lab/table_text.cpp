#include <thinwall/experiments/lab/table_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

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

/// A missing value fits every column, and a whole number one of numbers.
bool fits(const Value& value, ColumnType type) {
  constexpr std::array types = {ColumnType::text, ColumnType::integer, ColumnType::number, ColumnType::boolean};
  if (value.index() == 0 || types[value.index() - 1] == type) return true;
  return type == ColumnType::number && std::holds_alternative<std::int64_t>(value);
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

using nlohmann::ordered_json;

ordered_json field(const Column& column) {
  constexpr std::array types = {"string", "integer", "number", "boolean"};  // of a ColumnType, in Table Schema
  ordered_json out = {{"name", column.name}, {"type", types[static_cast<std::size_t>(column.type)]}};
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

/// A column to show, by its place in the table; where it has an interval, the places of the ends.
struct Choice {
  std::size_t at;
  std::optional<std::size_t> lower, upper;
};

bool has_unit(const Column& column) { return !column.unit.empty() && column.unit != "1"; }

/// The column's name in words, without a unit at its end: `angle` for `angle_deg`.
std::string title(const Column& column) {
  const std::string suffix = "_" + column.unit;
  const bool ends_in_unit = has_unit(column) && column.name.ends_with(suffix);
  return spaced(column.name.substr(0, column.name.size() - (ends_in_unit ? suffix.size() : 0)));
}

/// Every column but those that are the end of another's interval.
std::vector<Choice> choices(const Table& table) {
  std::vector<Choice> out;
  std::vector<std::size_t> ends;
  for (std::size_t at = 0; at < table.columns.size(); ++at) {
    Choice choice{at, {}, {}};
    if (const Column& column = table.columns[at]; !column.lower.empty() || !column.upper.empty()) {
      choice.lower = place_of(table, column.lower);
      choice.upper = place_of(table, column.upper);
      ends.insert(ends.end(), {*choice.lower, *choice.upper});
    }
    out.push_back(choice);
  }
  std::erase_if(out, [&](const Choice& choice) { return std::ranges::find(ends, choice.at) != ends.end(); });
  return out;
}

/// What is shown whole, as counts are: a number without a unit that has more digits than are shown, too, as one that is expected stands
/// beside the one counted.
std::optional<std::int64_t> shown_count(const Value& value, const Column& column) {
  if (const auto* count = std::get_if<std::int64_t>(&value)) return *count;
  const auto* number = std::get_if<double>(&value);
  const bool is_long = number && std::abs(*number) >= 1e3 && std::abs(*number) < 1e15;
  return is_long && column.unit == "1" ? std::optional<std::int64_t>(std::llround(*number)) : std::nullopt;
}

/// A value as a reader sees it: four significant digits, thousands apart in counts, a dash where it is missing.
std::string shown_text(const Value& value, const Column& column) {
  constexpr int shown_digits = 4;
  if (const auto count = shown_count(value, column)) return grouped_text(*count);
  if (const auto* number = std::get_if<double>(&value); number && std::isfinite(*number))
    return rounded_text(*number, shown_digits);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "yes" : "no";
  const std::string text = exact_text(value);
  return text.empty() ? missing_text : text;
}

ShownCell cell(const Table& table, const std::vector<Value>& row, const Choice& choice) {
  const Value& value = row[choice.at];
  const Column& column = table.columns[choice.at];
  const bool is_number = std::holds_alternative<double>(value) && !shown_count(value, column);
  ShownCell out{.text = shown_text(value, column), .is_number = is_number, .lower = {}, .upper = {}};
  if (!choice.lower || out.text == missing_text) return out;
  const Value &low = row[*choice.lower], &high = row[*choice.upper];
  if (exact_text(low).empty() && exact_text(high).empty()) return out;
  const auto number = finite_number(value), lower = finite_number(low), upper = finite_number(high);
  if (!number || !lower || !upper || std::holds_alternative<std::int64_t>(value)) {
    return {out.text, out.is_number, shown_text(low, column), shown_text(high, column)};
  }
  const IntervalText text = interval_text(*number, *lower, *upper);
  return {text.value, true, text.lower, text.upper};
}

bool is_same_in_every_row(const Table& table, const Choice& choice) {
  const auto same = [&](std::size_t at) {
    return std::ranges::all_of(table.rows, [&](const auto& row) { return row[at] == table.rows[0][at]; });
  };
  return table.columns[choice.at].type != ColumnType::boolean && table.rows.size() > 1 && same(choice.at) &&
         (!choice.lower || (same(*choice.lower) && same(*choice.upper)));
}

/// `Brackets hold the 95 % Wilson interval.`, as the columns of the lower ends describe it.
std::string bracket_words(const Table& table, const std::vector<Choice>& shown_choices) {
  std::vector<std::string> kinds;
  for (const Choice& choice : shown_choices) {
    if (!choice.lower) continue;
    std::string words = table.columns[*choice.lower].description;
    constexpr std::string_view prefix = "Lower end of ";
    if (words.starts_with(prefix)) words = words.substr(prefix.size());
    if (words.ends_with('.')) words.pop_back();
    if (words.starts_with("Its ")) words[0] = 'i';
    if (std::ranges::find(kinds, words) == kinds.end()) kinds.push_back(words);
  }
  return kinds.empty() ? "" : fmt::format(" Brackets hold {}.", fmt::join(kinds, ", or "));
}

/// `number` with the minus sign of a format, and its exponent between that format's `raise` and `lower`.
std::string typeset(const std::string& number, const std::string& minus, const char* raise, const char* lower) {
  if (number.starts_with('-')) return minus + typeset(number.substr(1), minus, raise, lower);
  const auto at = number.find('e');
  if (at == std::string::npos) return number;
  const int power = std::stoi(number.substr(at + 1));
  return number.substr(0, at) + raise + (power < 0 ? minus : "") + std::to_string(std::abs(power)) + lower;
}

std::string with_interval(const ShownCell& cell) {
  return cell.text + (cell.lower.empty() ? "" : fmt::format(" [{}, {}]", cell.lower, cell.upper));
}

std::string latex_cell(const ShownCell& cell) {
  const auto number = [](const std::string& text) { return typeset(text, "-", "\\times 10^{", "}"); };
  if (cell.text == missing_text) return "--";
  const std::string text = cell.is_number ? "$" + number(cell.text) + "$" : latex_escaped(cell.text);
  if (cell.lower.empty()) return text;
  return fmt::format("{} $[{}, {}]$", text, number(cell.lower), number(cell.upper));
}

std::string html_cell(const ShownCell& cell) {
  const auto number = [](const std::string& text) { return typeset(text, "&minus;", "&times;10<sup>", "</sup>"); };
  const std::string text = cell.is_number ? number(cell.text) : html_escaped(cell.text);
  if (cell.lower.empty()) return text;
  return fmt::format("{} <span class=\"i\">[{}, {}]</span>", text, number(cell.lower), number(cell.upper));
}

/// A unit is not broken over two lines.
std::string header_html(const std::string& header) {
  const auto unit = header.rfind(" [");
  if (unit == std::string::npos) return html_escaped(header);
  return fmt::format("{} <span class=\"u\">{}</span>", html_escaped(header.substr(0, unit)),
                     html_escaped(header.substr(unit + 1)));
}

}  // namespace

std::size_t place_of(const Table& table, std::string_view column) {
  const auto found = std::ranges::find(table.columns, column, &Column::name);
  if (found == table.columns.end())
    throw std::logic_error(fmt::format("table '{}' has no column '{}'", table.name, column));
  return static_cast<std::size_t>(found - table.columns.begin());
}

std::optional<double> finite_number(const Value& value) {
  if (const auto* count = std::get_if<std::int64_t>(&value)) return static_cast<double>(*count);
  const auto* number = std::get_if<double>(&value);
  return number != nullptr && std::isfinite(*number) ? std::optional(*number) : std::nullopt;
}

std::string exact_text(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&value)) return number_field(*number);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  return {};
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

std::string datapackage_text(const PackageInfo& info, std::span<const Table> tables) {
  ordered_json out = {
      {"profile", "tabular-data-package"}, {"name", info.name},       {"title", info.title},
      {"description", info.description},   {"version", info.version}, {"resources", ordered_json::array()}};
  for (const Table& table : tables) out["resources"].push_back(resource(table));
  return out.dump(2) + "\n";
}

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

std::string header_of(const Column& column) {
  return has_unit(column) ? fmt::format("{} [{}]", title(column), column.unit) : title(column);
}

ShownTable shown(const Table& table) {
  std::vector<Choice> kept;
  std::string same;
  for (const Choice& choice : choices(table)) {
    const Column& column = table.columns[choice.at];
    const bool is_of_a_matrix = column.description.empty();
    if (is_of_a_matrix || !is_same_in_every_row(table, choice)) {
      kept.push_back(choice);
      continue;
    }
    const ShownCell value = cell(table, table.rows[0], choice);
    if (value.text == missing_text) continue;  // nothing in any row
    same += fmt::format("{}{} {}{}", same.empty() ? " In every row: " : ", ", title(column), with_interval(value),
                        has_unit(column) ? " " + column.unit : "");
  }
  if (kept.empty()) {  // every row is like every other
    kept = choices(table);
    same.clear();
  }
  if (!same.empty()) same += ".";
  ShownTable out;
  out.caption = table.description + same + bracket_words(table, kept);
  for (const Choice& choice : kept) {
    const Column& column = table.columns[choice.at];
    const bool right = column.type == ColumnType::integer || column.type == ColumnType::number;
    out.columns.push_back({header_of(column), column.description, right});
  }
  for (const auto& row : table.rows) {
    out.rows.emplace_back();
    for (const Choice& choice : kept) out.rows.back().push_back(cell(table, row, choice));
  }
  return out;
}

std::string markdown_table(const Table& whole) {
  const ShownTable table = shown(whole);
  std::string names = "|", rule = "|", out;
  for (const ShownColumn& column : table.columns) {
    names += fmt::format(" {} |", markdown_escaped(column.header));
    rule += column.right ? " ---: |" : " :--- |";
  }
  for (const auto& row : table.rows) {
    out += "|";
    for (const ShownCell& cell : row) out += fmt::format(" {} |", markdown_escaped(with_interval(cell)));
    out += "\n";
  }
  return fmt::format("{}\n\n{}\n{}\n{}", markdown_escaped(table.caption), names, rule, out);
}

std::string latex_table(const Table& whole) {
  const ShownTable table = shown(whole);
  std::string align, names, out;
  for (const ShownColumn& column : table.columns) {
    align += column.right ? 'r' : 'l';
    names += (names.empty() ? "" : " & ") + latex_escaped(column.header);
  }
  for (const auto& row : table.rows) {
    std::string line;
    for (std::size_t j = 0; j < row.size(); ++j) line += (j > 0 ? " & " : "") + latex_cell(row[j]);
    out += "  " + line + " \\\\\n";
  }
  return fmt::format(
      "% {}\n% Needs \\usepackage{{booktabs}}.\n\\begin{{tabular}}{{{}}}\n  \\toprule\n  {} \\\\\n  \\midrule\n{}"
      "  \\bottomrule\n\\end{{tabular}}\n",
      one_line(table.caption), align, names, out);
}

std::string html_table(const Table& whole) {
  const ShownTable table = shown(whole);
  const auto number_class = [](const ShownColumn& column) { return column.right ? " class=\"n\"" : ""; };
  std::string names, out;
  for (const ShownColumn& column : table.columns) {
    names += fmt::format("<th scope=\"col\"{} title=\"{}\">{}</th>", number_class(column),
                         html_escaped(column.description), header_html(column.header));
  }
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t j = 0; j < row.size(); ++j) {
      out += fmt::format("<td{}>{}</td>", number_class(table.columns[j]), html_cell(row[j]));
    }
    out += "</tr>\n";
  }
  return fmt::format(
      "<p class=\"caption\">{} <a href=\"data/{}.csv\">CSV</a></p>\n"
      "<div class=\"wide\" tabindex=\"0\"><table{} aria-label=\"{}\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{}"
      "</tbody>\n</table></div>\n",
      html_escaped(table.caption), html_escaped(whole.name), table.columns.size() > 10 ? " class=\"many\"" : "",
      html_escaped(whole.description), names, out);
}

}  // namespace thinwall
