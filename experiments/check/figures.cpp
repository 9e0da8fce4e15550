#include <algorithm>
#include <set>

#include <fmt/format.h>

#include <thinwall/experiments/check/html_tags.hpp>
#include <thinwall/experiments/check/parts.hpp>
#include <thinwall/experiments/check/xml.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/file_text.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

/// The string that follows `at`.
std::string quoted_after(const std::string& script, std::size_t at) {
  return gnuplot_unquoted(std::string_view(script).substr(at));
}

/// The title and the labels of the axes, which the script sets as labels 1, 2 and 3.
std::set<std::string> words_of(const std::string& script) {
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
    faults.push_back(file + ": not a whole SVG");
    return;
  }
  if (const std::string fault = xml_fault(svg); !fault.empty()) {
    faults.push_back(file + ": not well-formed: " + fault);
    return;
  }
  const std::string shown = html_unescaped(svg);  // gnuplot escapes some of what could be
  const std::set<std::string> words = words_of(script);
  if (words.size() < 3) faults.push_back(file + ": its script does not label both axes");
  for (const std::string& word : words) {
    if (shown.find(word) == std::string::npos)
      faults.push_back(fmt::format("{}: does not show '{}'", file, one_line(word)));
  }
}

}  // namespace

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

}  // namespace thinwall
