#include <thinwall/experiments/check/check.hpp>

#include <algorithm>
#include <limits>
#include <locale>
#include <memory>
#include <regex>
#include <set>
#include <sstream>

#include <expat.h>
#include <fmt/format.h>
#include <toml++/toml.h>
#include <boost/algorithm/string.hpp>

#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view space = " \t\n\f\r";

/// Moves `at` past the word that ends before one of `ends`, and returns it.
std::string_view take_word(std::string_view page, std::size_t& at, const std::string& ends) {
  const std::size_t begin = at;
  at = std::min(page.find_first_of(ends, begin), page.size());
  return page.substr(begin, at - begin);
}

void skip(std::string_view page, std::size_t& at, const std::string& letters) {
  at = std::min(page.find_first_not_of(letters, at), page.size());
}

std::string_view take_value(std::string_view page, std::size_t& at) {
  if (at < page.size() && (page[at] == '"' || page[at] == '\'')) {
    const std::string quote(1, page[at++]);
    return take_word(page, at, quote);
  }
  return take_word(page, at, std::string(space) + ">");
}

/// For ASCII.
std::string lower_case(std::string_view text) {
  return boost::to_lower_copy(std::string(text), std::locale::classic());
}

/// A tag of an HTML page, read as a browser reads it.
struct HtmlTag {
  std::string name;                                             ///< in lower case
  std::vector<std::pair<std::string, std::string>> attributes;  ///< name in lower case, and value without quotes
};

/// The tag whose name begins at `at`.
HtmlTag tag_at(std::string_view page, std::size_t at) {
  const std::string between(space);
  HtmlTag tag{lower_case(take_word(page, at, between + "/>")), {}};
  for (;;) {
    skip(page, at, between + "/\"'");
    if (at == page.size() || page[at] == '>') return tag;
    const std::size_t begin = at++;  // a name may begin with =
    take_word(page, at, between + "/>=");
    auto& [name, value] = tag.attributes.emplace_back(lower_case(page.substr(begin, at - begin)), "");
    skip(page, at, between);
    if (at == page.size() || page[at] != '=') continue;
    skip(page, ++at, between);
    value = take_value(page, at);
  }
}

/// Every opening tag. One that stands where a browser would not look, as in a comment, counts too.
std::vector<HtmlTag> tags_of(std::string_view page) {
  std::vector<HtmlTag> out;
  for (auto at = page.find('<'); at != std::string_view::npos; at = page.find('<', at + 1)) {
    const std::string letter = lower_case(page.substr(at + 1, 1));
    if (letter >= "a" && letter <= "z") out.push_back(tag_at(page, at + 1));
  }
  return out;
}

void check_content(const KeptResult& result, const std::string& page, Faults& faults) {
  const auto require = [&](const std::string& html, const char* what) {
    if (page.find(html) == std::string::npos) add_fault(faults, page_file, "{}", what);
  };
  require("<h1>" + html_escaped(result.citation.question) + "</h1>", "does not ask the manifest's question");
  require("<p class=\"answer\">", "has no answer");
  std::string first = result.answer.substr(0, result.answer.find("\n\n"));
  require(html_escaped(first), "does not give the manifest's answer");
  require(result.self_test_passed ? ">The self-test passed.<" : "<strong>The self-test failed:</strong>",
          "does not give the manifest's verdict of the self-test");
  if (std::ranges::any_of(result.hashes, [](const auto& file) { return file.first.starts_with("plots/"); }))
    require("<figure>", "has no figure");
  require("<table", "has no table");
  for (const char* section :
       {"Method", "Limits", "How to reproduce", "Configuration", "Provenance", "Files", "How to cite"}) {
    require(fmt::format("<h2>{}</h2>", section), fmt::format("has no section '{}'", section).c_str());
  }
  require(html_escaped(result.reproduce), "does not give the line that reproduces the result");
  require(html_escaped(result.citation.commit), "does not name the commit");
  require(result.citation.run_id, "does not name the run");
}

/// `1.5e-07` as `1.5e-7`.
std::string short_exponents(const std::string& text) {
  static const std::regex exponent(R"(([0-9]e)(?:(-)|\+)?0*(?=[0-9]))");
  return std::regex_replace(text, exponent, "$1$2");
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

/// Each table of tables/ stands in the page, cell for cell.
void check_page_tables(const KeptResult& result, const std::string& page, Faults& faults) {
  const std::string rows = rows_of_page(page), captions = captions_of_page(page);
  for (const auto& [file, hash] : result.hashes) {
    if (!file.starts_with("tables/") || !file.ends_with(".md")) continue;
    const MarkdownTable table = read_markdown(file_text(result.folder / file));
    if (rows.find(table.rows) == std::string::npos || captions.find("\n" + table.caption + "\n") == std::string::npos)
      add_fault(faults, page_file, "does not show the rows and the caption of {}", one_line(file));
  }
}

/// Each SVG that the manifest names stands in the page.
void check_page_figures(const KeptResult& result, const std::string& page, Faults& faults) {
  for (const std::string& file : result.files()) {
    if (!file.starts_with("plots/") || !file.ends_with(".svg")) continue;
    const std::filesystem::path path = result.folder / file;
    const std::string svg = file_text(path);
    const std::string title = title_of_script(file_text(std::filesystem::path(path).replace_extension(".gp")));
    if (svg.empty() || title.empty()) continue;  // said of the figures
    if (page.find(inline_svg(svg, path.stem().string(), title)) == std::string::npos)
      add_fault(faults, page_file, "does not show {}", one_line(file));
  }
}

/// What a report is made of, and the pictures in it; none of it runs, or loads anything but by `href`.
bool is_plain(const std::string& element) {
  static const std::set<std::string> html = {
      "html",  "head",  "meta", "title", "style",  "link",   "body",       "main",    "section",
      "h1",    "h2",    "h3",   "p",     "figure", "strong", "div",        "caption", "figcaption",
      "table", "thead", "tr",   "tbody", "th",     "td",     "a",          "ul",      "li",
      "dl",    "dt",    "dd",   "pre",   "em",     "code",   "span",       "sup",     "sub",
      "b",     "i",     "br",   "hr",    "ol",     "h4",     "blockquote", "details", "summary"};
  static const std::set<std::string> svg = {
      "svg",    "g",    "defs",    "desc",        "use",     "text",        "tspan",          "path",          "rect",
      "circle", "line", "ellipse", "polyline",    "polygon", "clippath",    "mask",           "pattern",       "symbol",
      "filter", "stop", "feflood", "fecomposite", "femerge", "femergenode", "lineargradient", "radialgradient"};
  return html.contains(element) || svg.contains(element);
}

struct AloneCheck {
  const KeptResult& result;
  Faults& faults;
  std::set<std::string> said = {};  // once each

  void add(const std::string& what) {
    if (said.insert(what).second) add_fault(faults, page_file, "{}", one_line(what));
  }

  /// A link within the page or the folder; for the page's icon, which is empty, also `data:`.
  void check_link(const HtmlTag& tag, const std::string& value) {
    if (value.empty() || value.starts_with('#') || (tag.name == "link" && value == "data:,")) return;
    const std::string target = html_unescaped(value);
    if (tag.name != "a" || target.find(':') != std::string::npos || target.starts_with('/') ||
        target.find("..") != std::string::npos) {
      add(fmt::format("asks for '{}'", clipped(target, 60)));
    } else if (const std::string file = target.substr(0, target.find('#'));
               file != played_page && !std::filesystem::exists(result.folder / file)) {
      add(fmt::format("links to '{}', which is not there", clipped(target, 60)));
    }
  }

  void check_tag(const HtmlTag& tag) {
    static const std::set<std::string> loading = {"src",        "srcset", "poster", "action", "formaction",
                                                  "background", "ping",   "data",   "srcdoc"};
    if (!is_plain(tag.name)) add(fmt::format("'<{}' in a page that stands alone", clipped(tag.name, 40)));
    for (const auto& [name, value] : tag.attributes) {
      if (name == "href" || name.ends_with(":href")) check_link(tag, value);
      if (loading.contains(name)) add(fmt::format("asks for '{}'", clipped(value, 60)));
      if (name.starts_with("on") || name == "http-equiv")
        add(fmt::format("attribute '{}' in a page that stands alone", clipped(name, 40)));
    }
  }

  /// Style sheets load by these, and old ones run.
  void check_styles(const std::string& lower) {
    for (const char* never : {"<script", "@import", "image-set(", "javascript:", "expression("}) {
      if (lower.find(never) != std::string::npos) add(fmt::format("'{}' in a page that stands alone", never));
    }
    for (auto at = lower.find("url("); at != std::string::npos; at = lower.find("url(", at + 1)) {
      const std::string target = lower.substr(at + 4, 6);
      if (target.find('#') > 1) add(fmt::format("'url({}...' in a page that stands alone", target));
    }
  }
};

/// Nothing in the page asks a host for anything, or runs; every link leads to something, or to `played_page`.
void check_stands_alone(const KeptResult& result, const std::string& page, Faults& faults) {
  AloneCheck check{result, faults};
  for (const HtmlTag& tag : tags_of(page)) check.check_tag(tag);
  check.check_styles(lower_case(page));
}

/// The string that follows `at`.
std::string quoted_after(const std::string& script, std::size_t at) {
  return gnuplot_unquoted(std::string_view(script).substr(at));
}

/// The title and the labels of the axes, which the script sets as labels 1, 2 and 3.
std::set<std::string> script_words(const std::string& script) {
  std::set<std::string> out;
  for (const char* label : {"\nset label 1 ", "\nset label 2 ", "\nset label 3 "}) {
    for (auto at = script.find(label); at != std::string::npos; at = script.find(label, at + 1))
      out.insert(quoted_after(script, at));
  }
  out.erase("");
  return out;
}

void check_svg(const std::string& svg, const std::string& script, const std::string& file, Faults& faults) {
  const auto last = svg.find_last_not_of(" \n");
  if (svg.find("<svg") == std::string::npos || last == std::string::npos ||
      !svg.substr(0, last + 1).ends_with("</svg>")) {
    add_fault(faults, file, "not a whole SVG");
    return;
  }
  if (const std::string fault = xml_fault(svg); !fault.empty()) {
    add_fault(faults, file, "not well-formed: {}", fault);
    return;
  }
  const std::string shown = html_unescaped(svg);  // gnuplot escapes some of what could be
  const std::set<std::string> words = script_words(script);
  if (words.size() < 3) add_fault(faults, file, "its script does not label both axes");
  for (const std::string& word : words) {
    if (shown.find(word) == std::string::npos) add_fault(faults, file, "does not show '{}'", one_line(word));
  }
}

constexpr const char* toml_file = "resolved.toml";
constexpr const char* bib_file = "cite.bib";

void check_toml(const KeptResult& result, Faults& faults) {
  const std::string text = file_text(result.folder / toml_file);
  if (text.empty()) return;  // said of the files that are missing
  try {
    const toml::table table = toml::parse(text);
    const std::string experiment = table["experiment"].value_or(std::string());
    if (experiment != result.citation.experiment) {
      add_fault(faults, toml_file, "is of experiment '{}', the manifest of '{}'", one_line(experiment),
                one_line(result.citation.experiment));
    }
    if (table != toml::parse(config_toml(result.run)))
      add_fault(faults, toml_file, "is not the configuration that the manifest records");
    if (text.find("\n# " + result.reproduce + "\n") == std::string::npos)
      add_fault(faults, toml_file, "does not give the manifest's line that reproduces the result");
  } catch (const toml::parse_error& error) {
    add_fault(faults, fmt::format("{}:{}", toml_file, error.source().begin.line), "not TOML: {}",
              one_line(error.description()));
  }
}

/// Braces open and close in turn (BibTeX counts escaped ones too), those of a field at the end of its line, and there is an entry for the
/// software and one for the result.
void check_bib(const KeptResult& result, Faults& faults) {
  const std::string text = file_text(result.folder / bib_file);
  if (text.empty()) return;
  int depth = 0;
  bool ends_early = false;
  for (std::size_t i = 0; i < text.size() && depth >= 0; ++i) {
    depth += text[i] == '{' ? 1 : text[i] == '}' ? -1 : 0;
    const std::string_view rest = std::string_view(text).substr(i + 1);
    ends_early |= text[i] == '}' && depth == 1 && !rest.starts_with('\n') && !rest.starts_with(",\n");
  }
  if (depth != 0 || ends_early) add_fault(faults, bib_file, "its braces are not balanced");
  if (text.find("@software{thinwall,") == std::string::npos) add_fault(faults, bib_file, "does not cite the software");
  if (text.find(bibtex(result.citation)) == std::string::npos)
    add_fault(faults, bib_file, "does not cite the result as its manifest says");
}

}  // namespace

std::string xml_fault(std::string_view text) {
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate("UTF-8"), XML_ParserFree);
  XML_UseParserAsHandlerArg(parser.get());
  // A document type may declare entities, elsewhere too, which a reader need not have: a name is all it may be.
  XML_SetStartDoctypeDeclHandler(parser.get(), [](void* itself, const XML_Char*, const XML_Char* elsewhere,
                                                  const XML_Char*, int has_declarations) {
    if (elsewhere != nullptr || has_declarations != 0) XML_StopParser(static_cast<XML_Parser>(itself), XML_FALSE);
  });
  if (text.size() > std::size_t{std::numeric_limits<int>::max()}) return "too long to be read";
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) == XML_STATUS_OK) return {};
  const XML_Error error = XML_GetErrorCode(parser.get());
  return fmt::format("line {}, column {}: {}", XML_GetCurrentLineNumber(parser.get()),
                     XML_GetCurrentColumnNumber(parser.get()) + 1,
                     XML_ErrorString(error == XML_ERROR_ABORTED ? XML_ERROR_UNDEFINED_ENTITY : error));
}

std::string html_unescaped(std::string_view text) {
  std::string out(text);
  for (const auto& [entity, letter] :
       {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}, {"&amp;", "&"}})
    replace_all(out, entity, letter);
  return out;
}

// ---- The page.

void check_page(const KeptResult& result, Faults& faults) {
  if (std::filesystem::is_directory(result.folder / page_file)) {
    add_fault(faults, page_file, "is not a file");
    return;
  }
  const std::string page = file_text(result.folder / page_file);
  if (page.empty()) {
    add_fault(faults, page_file, "missing or empty");
    return;
  }
  if (!page.starts_with("<!DOCTYPE html>") || page.find("</html>") == std::string::npos)
    add_fault(faults, page_file, "not a whole page");
  check_content(result, page, faults);
  check_page_figures(result, page, faults);
  check_page_tables(result, page, faults);
  check_stands_alone(result, page, faults);
}

std::string title_of_script(const std::string& script) {
  const auto at = script.find("\nset label 1 ");
  return at == std::string::npos ? "" : quoted_after(script, at);
}

void check_figures(const fs::path& folder, Faults& faults) {
  if (!fs::is_directory(folder / "plots")) return;
  std::set<fs::path> scripts;
  for (const auto& entry : fs::directory_iterator(folder / "plots")) {
    if (entry.path().extension() == ".gp") scripts.insert(entry.path());
  }
  for (const fs::path& script : scripts) {
    const std::string name = "plots/" + script.stem().string();
    if (!fs::exists(folder / (name + ".dat"))) faults.push_back(one_line(name) + ".dat: missing; the script reads it");
    if (!fs::exists(folder / (name + ".svg"))) {
      faults.push_back(fmt::format("{}.svg: was not drawn; to draw it: cd plots && gnuplot {}.gp", one_line(name),
                                   one_line(script.stem().string())));
      continue;
    }
    check_svg(file_text(folder / (name + ".svg")), file_text(script), one_line(name) + ".svg", faults);
  }
}

void check_texts(const KeptResult& result, Faults& faults) {
  check_toml(result, faults);
  check_bib(result, faults);
}

}  // namespace thinwall
