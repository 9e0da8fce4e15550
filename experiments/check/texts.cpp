#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include <thinwall/experiments/check/parts.hpp>
#include <thinwall/experiments/results/resolved_toml.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/file_text.hpp>

namespace thinwall {
namespace {

constexpr const char* toml_file = "resolved.toml";
constexpr const char* bib_file = "cite.bib";

/// The manifest's configuration as its file should have it.
toml::table config_of(const KeptResult& result) {
  RunRecord run;
  run.experiment = result.citation.experiment;
  run.config = result.config;
  return toml::parse(resolved_toml(run));
}

void check_toml(const KeptResult& result, Faults& faults) {
  const std::string text = file_text(result.folder / toml_file);
  if (text.empty()) return;  // said of the files that are missing
  try {
    const toml::table table = toml::parse(text);
    const std::string experiment = table["experiment"].value_or(std::string());
    if (experiment != result.citation.experiment) {
      faults.push_back(fmt::format("{}: is of experiment '{}', the manifest of '{}'", toml_file, one_line(experiment),
                                   one_line(result.citation.experiment)));
    }
    if (table != config_of(result))
      faults.push_back(fmt::format("{}: is not the configuration that the manifest records", toml_file));
    if (text.find("\n# " + result.reproduce + "\n") == std::string::npos)
      faults.push_back(fmt::format("{}: does not give the manifest's line that reproduces the result", toml_file));
  } catch (const toml::parse_error& error) {
    faults.push_back(
        fmt::format("{}:{}: not TOML: {}", toml_file, error.source().begin.line, one_line(error.description())));
  }
}

/// Braces open and close in turn (BibTeX counts escaped ones too), and there is an entry for the software and one for the result.
void check_bib(const KeptResult& result, Faults& faults) {
  const std::string text = file_text(result.folder / bib_file);
  if (text.empty()) return;
  int depth = 0;
  for (std::size_t i = 0; i < text.size() && depth >= 0; ++i) {
    depth += text[i] == '{' ? 1 : text[i] == '}' ? -1 : 0;
  }
  if (depth != 0) faults.push_back(fmt::format("{}: its braces are not balanced", bib_file));
  if (text.find("@software{thinwall,") == std::string::npos)
    faults.push_back(fmt::format("{}: does not cite the software", bib_file));
  if (text.find(bibtex(result.citation)) == std::string::npos)
    faults.push_back(fmt::format("{}: does not cite the result as its manifest says", bib_file));
}

}  // namespace

void check_texts(const KeptResult& result, Faults& faults) {
  check_toml(result, faults);
  check_bib(result, faults);
}

}  // namespace thinwall
