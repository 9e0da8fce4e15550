#include <thinwall/experiments/lab/terminal.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/table_text.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {
namespace {

/// Letters, not bytes: what UTF-8 continues does not count.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

/// What stands in brackets is one word: a unit is not broken over two lines.
std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
    const std::size_t bracket = text[at] == '[' ? text.find(']', at) : at;
    end = std::min(text.find(' ', bracket == std::string_view::npos ? at : bracket), text.size());
    if (end > at) words.push_back(text.substr(at, end - at));
  }
  return words;
}

/// The words on lines of at most `most` letters, a longer word on a line of its own.
std::vector<std::string> broken(std::string_view text, std::size_t most) {
  std::vector<std::string> lines;
  for (const std::string_view word : words_of(text)) {
    if (lines.empty() || width(lines.back()) + 1 + width(word) > most) {
      lines.emplace_back(word);
    } else {
      lines.back().append(" ").append(word);
    }
  }
  return lines;
}

std::string padded(const std::string& text, std::size_t to, bool right) {
  const std::string spaces(to - std::min(to, width(text)), ' ');
  return right ? spaces + text : text + spaces;
}

/// The columns of these names alone, in this order, and the ends of their intervals.
Table only_columns(const Table& table, std::initializer_list<std::string_view> names) {
  Table out = table;
  out.columns.clear();
  for (auto& row : out.rows) row.clear();
  const auto take = [&](std::string_view name) {
    const std::size_t j = place_of(table, name);
    out.columns.push_back(table.columns[j]);
    for (std::size_t i = 0; i < table.rows.size(); ++i) out.rows[i].push_back(table.rows[i][j]);
  };
  for (const std::string_view name : names) {
    take(name);
    const Column column = out.columns.back();
    if (!column.lower.empty()) take(column.lower);
    if (!column.upper.empty()) take(column.upper);
  }
  return out;
}

}  // namespace

std::string wrapped(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const auto lines = broken(text.substr(at, end - at), terminal_width);
    for (const std::string& line : lines) out += line + "\n";
    if (lines.empty()) out += "\n";
    at = end + 1;
  }
  return out;
}

std::string terminal(const Table& table, std::initializer_list<std::string_view> names) {
  ShownTable all = shown(names.size() == 0 ? table : only_columns(table, names));
  std::vector<std::vector<std::string>> headers;
  std::vector<std::size_t> widths;
  std::size_t height = 0, whole = 0;
  for (std::size_t j = 0; j < all.columns.size(); ++j) {
    std::size_t widest = 0;
    std::vector<std::string*> numbers;
    for (auto& row : all.rows) numbers.push_back(&row[j].text);
    const auto tiny = std::ranges::count_if(numbers, [](const std::string* text) {
      const double size = std::abs(std::strtod(text->c_str(), nullptr));
      return size > 0 && size < 1e-5;
    });
    // a few that are rounding alone are none to write all others by
    if (tiny == 0 || 4 * tiny >= std::ssize(numbers)) in_one_notation(numbers);
    for (const auto& row : all.rows) widest = std::max(widest, width(row[j].text));
    for (const std::string_view word : words_of(all.columns[j].header)) widest = std::max(widest, width(word));
    whole += widest + (j > 0 ? 2 : 0);
    if (j > 0 && whole > terminal_width) break;  // the file has them all
    headers.push_back(broken(all.columns[j].header, widest));
    height = std::max(height, headers.back().size());
    widths.push_back(widest);
  }
  const auto line = [&](const auto& text_of) {
    std::string out;
    for (std::size_t j = 0; j < widths.size(); ++j)
      out += (j > 0 ? "  " : "") + padded(text_of(j), widths[j], all.columns[j].right);
    out.erase(out.find_last_not_of(' ') + 1);
    return out + "\n";
  };
  std::string out = wrapped(all.caption.substr(0, all.caption.find(" Brackets hold ")));
  for (std::size_t k = 0; k < height; ++k) {
    out += line([&](std::size_t j) {
      const std::size_t first = height - headers[j].size();  // the last words stand on the rows
      return k < first ? std::string() : headers[j][k - first];
    });
  }
  for (const auto& row : all.rows) out += line([&](std::size_t j) { return one_line(row[j].text); });
  std::string left;
  for (std::size_t j = widths.size(); j < all.columns.size(); ++j)
    left += (left.empty() ? "" : ", ") + all.columns[j].header;
  return out + (left.empty() ? "" : wrapped(fmt::format("And {} in data/{}.csv.", left, table.name)));
}

}  // namespace thinwall
