#include <sstream>

#include <fmt/format.h>

#include <thinwall/experiments/check/html_tags.hpp>
#include <thinwall/experiments/check/parts.hpp>
#include <thinwall/experiments/figures/plot.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/file_text.hpp>

namespace thinwall {
namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// `1.5e-07` as `1.5e-7`.
std::string short_exponents(const std::string& text) {
  std::string out;
  const auto is_digit = [](char letter) { return '0' <= letter && letter <= '9'; };
  for (std::size_t at = 0; at < text.size(); ++at) {
    out += text[at];
    if (text[at] != 'e' || at == 0 || !is_digit(text[at - 1])) continue;
    const std::string sign = at + 1 < text.size() && text[at + 1] == '-' ? "-" : "";
    std::size_t next = at + 1;
    if (next < text.size() && (text[next] == '-' || text[next] == '+')) ++next;
    if (next == text.size() || !is_digit(text[next])) continue;
    while (next + 1 < text.size() && text[next] == '0' && is_digit(text[next + 1])) ++next;
    out += sign;
    at = next - 1;
  }
  return out;
}

/// A cell as its Markdown has it.
std::string markdown_of(std::string cell) {
  replace_all(cell, "&times;10<sup>", "e");
  replace_all(cell, "&minus;", "-");
  std::string words;
  for (std::size_t at = 0; at < cell.size(); ++at) {
    if (cell[at] != '<') {
      words += cell[at];
    } else if ((at = cell.find('>', at)) == std::string::npos) {
      break;
    }
  }
  return markdown_escaped(html_unescaped(words));
}

/// Every row of every table of the page, a line each.
std::string rows_of_page(const std::string& page) {
  std::string out;
  constexpr std::string_view cell_begin = "<td", cell_end = "</td>", row_end = "</tr>";
  for (auto at = page.find(cell_begin); at != std::string::npos;) {
    const auto begin = page.find('>', at), end = page.find(cell_end, at);
    if (end == std::string::npos || begin > end) break;
    if (out.empty() || out.back() == '\n') out += "|";
    out += " " + markdown_of(page.substr(begin + 1, end - begin - 1)) + " |";
    at = page.find(cell_begin, end);
    if (page.find(row_end, end) < at) out += "\n";
  }
  return short_exponents(out);
}

/// The captions of the page's tables as their Markdown has them, a line each.
std::string captions_of_page(const std::string& page) {
  std::string out = "\n";
  constexpr std::string_view begin = "<p class=\"caption\">", end = " <a href=\"data/";
  for (auto at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
    const auto from = at + begin.size(), to = page.find(end, from);
    if (to != std::string::npos) out += markdown_escaped(html_unescaped(page.substr(from, to - from))) + "\n";
  }
  return out;
}

/// A Markdown table: its caption, and its rows.
struct MarkdownTable {
  std::string caption, rows;
};

MarkdownTable read_markdown(const std::string& text) {
  MarkdownTable out;
  std::istringstream in(text);
  std::getline(in, out.caption);
  bool in_rows = false;
  for (std::string line; std::getline(in, line);) {
    if (in_rows) out.rows += line + "\n";
    in_rows |= line.starts_with("| :--") || line.starts_with("| ---");
  }
  out.rows = short_exponents(out.rows);
  return out;
}

}  // namespace

void check_page_tables(const KeptResult& result, const std::string& page, Faults& faults) {
  const std::string rows = rows_of_page(page), captions = captions_of_page(page);
  for (const auto& [file, hash] : result.hashes) {
    if (!file.starts_with("tables/") || !file.ends_with(".md")) continue;
    const MarkdownTable table = read_markdown(file_text(result.folder / file));
    if (rows.find(table.rows) == std::string::npos || captions.find("\n" + table.caption + "\n") == std::string::npos)
      faults.push_back(fmt::format("{}: does not show the rows and the caption of {}", page_file, one_line(file)));
  }
}

void check_page_figures(const KeptResult& result, const std::string& page, Faults& faults) {
  const auto check = [&](const std::string& file) {
    if (!file.starts_with("plots/") || !file.ends_with(".svg")) return;
    const std::filesystem::path path = result.folder / file;
    const std::string svg = file_text(path);
    const std::string title = title_of_script(file_text(std::filesystem::path(path).replace_extension(".gp")));
    if (svg.empty() || title.empty()) return;  // said of the figures
    if (page.find(inline_svg(svg, path.stem().string(), title)) == std::string::npos)
      faults.push_back(fmt::format("{}: does not show {}", page_file, one_line(file)));
  };
  for (const auto& [file, hash] : result.hashes) check(file);
  for (const std::string& file : result.unhashed) check(file);
}

}  // namespace thinwall
