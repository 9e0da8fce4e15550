#include <thinwall/experiments/tables/shown_table.hpp>

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include <thinwall/experiments/tables/csv.hpp>
#include <thinwall/experiments/tables/shown.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {
namespace {

constexpr int shown_digits = 4;

/// `number` with the minus sign of a format, and its exponent between that format's `raise` and `lower`.
std::string typeset(const std::string& number, const std::string& minus, const char* raise, const char* lower) {
  if (number.starts_with('-')) return minus + typeset(number.substr(1), minus, raise, lower);
  const auto at = number.find('e');
  if (at == std::string::npos) return number;
  const int power = std::stoi(number.substr(at + 1));
  return number.substr(0, at) + raise + (power < 0 ? minus : "") + std::to_string(std::abs(power)) + lower;
}

std::string markdown_cell(const ShownCell& cell) {
  const std::string interval = cell.lower.empty() ? "" : fmt::format(" [{}, {}]", cell.lower, cell.upper);
  return markdown_escaped(cell.text + interval);
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

std::string shown_text(const Value& value) {
  if (const auto* count = std::get_if<std::int64_t>(&value)) return grouped_text(*count);
  if (const auto* number = std::get_if<double>(&value); number && std::isfinite(*number)) {
    return rounded_text(*number, shown_digits);
  }
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "yes" : "no";
  const std::string text = exact_text(value);
  return text.empty() ? missing_text : text;
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
    for (const ShownCell& cell : row) out += fmt::format(" {} |", markdown_cell(cell));
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
