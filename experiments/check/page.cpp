#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>

#include <thinwall/experiments/check/parts.hpp>
#include <thinwall/experiments/text/escape.hpp>

namespace thinwall {
namespace {

constexpr const char* page_file = "report.html";

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

/// Every value of an attribute whose name ends in `name`, wherever it stands in a tag.
std::vector<std::string> values_of(const std::string& page, const std::string& name) {
  std::vector<std::string> out;
  for (auto at = page.find(name + "="); at != std::string::npos; at = page.find(name + "=", at + 1)) {
    const auto begin = at + name.size() + 1;
    if (begin >= page.size() || (page[begin] != '"' && page[begin] != '\'')) continue;
    out.push_back(page.substr(begin + 1, page.find(page[begin], begin + 1) - begin - 1));
  }
  return out;
}

/// Nothing in the page asks a host for anything, or runs.
void check_stands_alone(const KeptResult& result, const std::string& page, Faults& faults) {
  const std::string lower = lower_case(page);
  for (const char* never :
       {"<script", "<iframe", "<object", "<embed", "<base", "<link rel=\"stylesheet", "@import", "javascript:"}) {
    if (lower.find(never) != std::string::npos)
      faults.push_back(fmt::format("{}: '{}' in a page that stands alone", page_file, never));
  }
  for (const char* attribute : {"src", "href", "srcset", "action"}) {
    for (const std::string& target : values_of(lower, attribute)) {
      if (target.starts_with("data:") || target.starts_with("#")) continue;
      if (target.find(':') != std::string::npos || target.starts_with("//")) {
        faults.push_back(fmt::format("{}: asks for '{}'", page_file, one_line(clipped(target, 60))));
      }
    }
  }
  for (auto at = lower.find("url("); at != std::string::npos; at = lower.find("url(", at + 1)) {
    const std::string target = lower.substr(at + 4, 6);
    if (target.find('#') > 1)
      faults.push_back(fmt::format("{}: 'url({}...' in a page that stands alone", page_file, one_line(target)));
  }
  const std::vector<std::string> links = values_of(page, "href");
  for (const std::string& target : std::set<std::string>(links.begin(), links.end())) {
    if (target.empty() || target.starts_with("#") || target.find(':') != std::string::npos) continue;
    if (!std::filesystem::exists(result.folder / target))
      faults.push_back(fmt::format("{}: links to '{}', which is not there", page_file, one_line(target)));
  }
}

void check_content(const KeptResult& result, const std::string& page, Faults& faults) {
  const auto require = [&](const std::string& html, const char* what) {
    if (page.find(html) == std::string::npos) faults.push_back(fmt::format("{}: {}", page_file, what));
  };
  require("<h1>" + html_escaped(result.citation.question) + "</h1>", "does not ask the manifest's question");
  require("<p class=\"answer\">", "has no answer");
  std::string first = result.answer.substr(0, result.answer.find("\n\n"));
  require(html_escaped(first), "does not give the manifest's answer");
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

}  // namespace

void check_page(const KeptResult& result, Faults& faults) {
  const std::string page = file_text(result.folder / page_file);
  if (page.empty()) {
    faults.push_back(fmt::format("{}: missing or empty", page_file));
    return;
  }
  if (!page.starts_with("<!DOCTYPE html>") || page.find("</html>") == std::string::npos)
    faults.push_back(fmt::format("{}: not a whole page", page_file));
  check_content(result, page, faults);
  check_stands_alone(result, page, faults);
}

}  // namespace thinwall
