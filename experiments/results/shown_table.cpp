#include <thinwall/experiments/results/shown_table.hpp>

#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/results/csv.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {
namespace {

constexpr int shown_digits = 4;
constexpr const char* missing = "\u2013";  // an en dash

bool is_right_aligned(const Column& column) {
  return column.type == ColumnType::integer || column.type == ColumnType::number;
}

std::string header(const Column& column) {
  std::string text = column.name;
  for (char& letter : text) {
    if (letter == '_') letter = ' ';
  }
  return column.unit.empty() || column.unit == "1" ? text : fmt::format("{} [{}]", text, column.unit);
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

std::string markdown_table(const Table& table) {
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
  return fmt::format("{}\n\n{}\n{}\n{}", table.description, names, rule, out);
}

std::string latex_table(const Table& table) {
  std::string align, names, out;
  for (const Column& column : table.columns) {
    align += is_right_aligned(column) ? 'r' : 'l';
    names += (names.empty() ? "" : " & ") + latex_escaped(header(column));
  }
  for (const auto& row : table.rows) {
    std::string line;
    for (std::size_t j = 0; j < row.size(); ++j) {
      const std::string text = shown_text(row[j]);
      line += (j > 0 ? " & " : "") + (text == missing ? "--" : latex_escaped(text));
    }
    out += "  " + line + " \\\\\n";
  }
  return fmt::format(
      "% {}\n% Needs \\usepackage{{booktabs}}.\n\\begin{{tabular}}{{{}}}\n  \\toprule\n  {} \\\\\n  \\midrule\n{}"
      "  \\bottomrule\n\\end{{tabular}}\n",
      one_line(table.description), align, names, out);
}

std::string html_table(const Table& table) {
  const auto number_class = [&](std::size_t j) { return is_right_aligned(table.columns[j]) ? " class=\"n\"" : ""; };
  std::string names, out;
  for (std::size_t j = 0; j < table.columns.size(); ++j) {
    const Column& column = table.columns[j];
    names += fmt::format("<th scope=\"col\"{} title=\"{}\">{}</th>", number_class(j), html_escaped(column.description),
                         html_escaped(header(column)));
  }
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t j = 0; j < row.size(); ++j) {
      out += fmt::format("<td{}>{}</td>", number_class(j), html_escaped(shown_text(row[j])));
    }
    out += "</tr>\n";
  }
  return fmt::format(
      "<div class=\"wide\" tabindex=\"0\"><table>\n<caption>{}</caption>\n<thead><tr>{}</tr></thead>\n<tbody>\n{}"
      "</tbody>\n</table></div>\n",
      html_escaped(table.description), names, out);
}

}  // namespace thinwall
