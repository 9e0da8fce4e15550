#include <algorithm>

#include <fmt/format.h>

#include <thinwall/experiments/check/parts.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/file_text.hpp>

namespace thinwall {
namespace {

void check_content(const KeptResult& result, const std::string& page, Faults& faults) {
  const auto require = [&](const std::string& html, const char* what) {
    if (page.find(html) == std::string::npos) faults.push_back(fmt::format("{}: {}", page_file, what));
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

}  // namespace

void check_page(const KeptResult& result, Faults& faults) {
  if (std::filesystem::is_directory(result.folder / page_file)) {
    faults.push_back(fmt::format("{}: is not a file", page_file));
    return;
  }
  const std::string page = file_text(result.folder / page_file);
  if (page.empty()) {
    faults.push_back(fmt::format("{}: missing or empty", page_file));
    return;
  }
  if (!page.starts_with("<!DOCTYPE html>") || page.find("</html>") == std::string::npos)
    faults.push_back(fmt::format("{}: not a whole page", page_file));
  check_content(result, page, faults);
  check_page_figures(result, page, faults);
  check_page_tables(result, page, faults);
  check_stands_alone(result, page, faults);
}

}  // namespace thinwall
