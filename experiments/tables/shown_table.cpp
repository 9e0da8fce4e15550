#include <thinwall/experiments/tables/shown_table.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include <thinwall/experiments/tables/csv.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {
namespace {

constexpr int shown_digits = 4;
constexpr const char* missing = "\u2013";  // an en dash

bool is_right_aligned(const Column& column) {
  return column.type == ColumnType::integer || column.type == ColumnType::number;
}

bool has_unit(const Column& column) { return !column.unit.empty() && column.unit != "1"; }

std::string words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// The column's name in words, without a unit at its end: `angle` for `angle_deg`.
std::string title(const Column& column) {
  const std::string suffix = "_" + column.unit;
  const bool ends_in_unit = has_unit(column) && column.name.ends_with(suffix);
  return words(column.name.substr(0, column.name.size() - (ends_in_unit ? suffix.size() : 0)));
}

std::string header(const Column& column) {
  return has_unit(column) ? fmt::format("{} [{}]", title(column), column.unit) : title(column);
}

/// `number` with the minus sign of a format, and its exponent between that format's `raise` and `lower`.
std::string typeset(const std::string& number, const std::string& minus, const char* raise, const char* lower) {
  if (number.starts_with('-')) return minus + typeset(number.substr(1), minus, raise, lower);
  const auto at = number.find('e');
  if (at == std::string::npos) return number;
  const int power = std::stoi(number.substr(at + 1));
  return number.substr(0, at) + raise + (power < 0 ? minus : "") + std::to_string(std::abs(power)) + lower;
}

std::string latex_cell(const Value& value) {
  const std::string text = shown_text(value);
  if (text == missing) return "--";
  if (!std::holds_alternative<double>(value)) return latex_escaped(text);
  return "$" + typeset(text, "-", "\\times 10^{", "}") + "$";
}

std::string html_cell(const Value& value) {
  const std::string text = shown_text(value);
  if (text == missing || !std::holds_alternative<double>(value)) return html_escaped(text);
  return typeset(text, "&minus;", "&times;10<sup>", "</sup>");
}

/// A table as readers see it. A column of one value in every row is told in words instead.
struct Shown {
  Table table;
  std::string same;  ///< `In every row: speed 10 m/s, wall infinite.`; may be empty
};

bool is_same_in_every_row(const Table& table, std::size_t j) {
  return table.columns[j].type != ColumnType::boolean && table.rows.size() > 1 &&
         std::ranges::all_of(table.rows, [&](const auto& row) { return row[j] == table.rows[0][j]; });
}

Shown shown(const Table& table) {
  Shown out{.table = table, .same = {}};
  out.table.columns.clear();
  for (auto& row : out.table.rows) row.clear();
  for (std::size_t j = 0; j < table.columns.size(); ++j) {
    const Column& column = table.columns[j];
    if (is_same_in_every_row(table, j)) {
      const Value& value = table.rows[0][j];
      if (exact_text(value).empty()) continue;  // nothing in any row
      out.same += fmt::format("{}{} {}{}{}", out.same.empty() ? "In every row: " : ", ", title(column),
                              shown_text(value), has_unit(column) ? " " : "", has_unit(column) ? column.unit : "");
      continue;
    }
    out.table.columns.push_back(column);
    for (std::size_t i = 0; i < table.rows.size(); ++i) out.table.rows[i].push_back(table.rows[i][j]);
  }
  if (out.table.columns.empty()) return {.table = table, .same = {}};
  if (!out.same.empty()) out.same += ".";
  return out;
}

}  // namespace

std::string shown_text(const Value& value) {
  if (const auto* count = std::get_if<std::int64_t>(&value)) return grouped_text(*count);
  if (const auto* number = std::get_if<double>(&value); number && std::isfinite(*number)) {
    return rounded_text(*number, shown_digits);
  }
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "yes" : "no";
  const std::string text = exact_text(value);
  return text.empty() ? missing : text;
}

std::string markdown_table(const Table& whole) {
  const auto [table, same] = shown(whole);
  std::string names = "|", rule = "|", out;
  for (const Column& column : table.columns) {
    names += fmt::format(" {} |", markdown_escaped(header(column)));
    rule += is_right_aligned(column) ? " ---: |" : " :--- |";
  }
  for (const auto& row : table.rows) {
    out += "|";
    for (const Value& value : row) out += fmt::format(" {} |", markdown_escaped(shown_text(value)));
    out += "\n";
  }
  return fmt::format("{}{}{}\n\n{}\n{}\n{}", table.description, same.empty() ? "" : " ", same, names, rule, out);
}

std::string latex_table(const Table& whole) {
  const auto [table, same] = shown(whole);
  std::string align, names, out;
  for (const Column& column : table.columns) {
    align += is_right_aligned(column) ? 'r' : 'l';
    names += (names.empty() ? "" : " & ") + latex_escaped(header(column));
  }
  for (const auto& row : table.rows) {
    std::string line;
    for (std::size_t j = 0; j < row.size(); ++j) {
      line += (j > 0 ? " & " : "") + latex_cell(row[j]);
    }
    out += "  " + line + " \\\\\n";
  }
  return fmt::format(
      "% {} {}\n% Needs \\usepackage{{booktabs}}.\n\\begin{{tabular}}{{{}}}\n  \\toprule\n  {} \\\\\n  \\midrule\n{}"
      "  \\bottomrule\n\\end{{tabular}}\n",
      one_line(table.description), same, align, names, out);
}

std::string html_table(const Table& whole) {
  const auto [table, same] = shown(whole);
  const auto number_class = [](const Column& column) { return is_right_aligned(column) ? " class=\"n\"" : ""; };
  std::string names, out;
  for (const Column& column : table.columns) {
    names += fmt::format("<th scope=\"col\"{} title=\"{}\">{}</th>", number_class(column),
                         html_escaped(column.description), html_escaped(header(column)));
  }
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t j = 0; j < row.size(); ++j) {
      out += fmt::format("<td{}>{}</td>", number_class(table.columns[j]), html_cell(row[j]));
    }
    out += "</tr>\n";
  }
  return fmt::format(
      "<p class=\"caption\">{0} {1} <a href=\"data/{2}.csv\">CSV</a></p>\n"
      "<div class=\"wide\" tabindex=\"0\"><table aria-label=\"{0}\">\n<thead><tr>{3}</tr></thead>\n<tbody>\n{4}"
      "</tbody>\n</table></div>\n",
      html_escaped(table.description), html_escaped(same), html_escaped(table.name), names, out);
}

}  // namespace thinwall
