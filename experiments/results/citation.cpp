#include <thinwall/experiments/results/citation.hpp>

#include <cctype>

#include <fmt/format.h>

#include <thinwall/experiments/text/escape.hpp>
#include <thinwall_build_info.hpp>

namespace thinwall {

SoftwareCitation this_software() {
  return {.title = std::string(citation_title),
          .authors = std::string(citation_authors),
          .version = std::string(build_version),
          .date = std::string(build_release_date),
          .license = std::string(citation_license)};
}

ResultCitation citation_of(const RunRecord& run) {
  return {.experiment = run.experiment,
          .question = run.question,
          .run_id = run_id(run),
          .seed = run.seed,
          .commit = run.build.commit,
          .dirty = run.build.dirty,
          .date = utc_text(run.finished).substr(0, 10)};
}

std::string bibtex(const SoftwareCitation& software) {
  return fmt::format(
      "@software{{thinwall,\n  author  = {{{}}},\n  title   = {{{}}},\n  version = {{{}}},\n  date    = {{{}}},\n"
      "  year    = {{{}}},\n  license = {{{}}}\n}}\n",
      software.authors, latex_escaped(software.title), latex_escaped(software.version), latex_escaped(software.date),
      latex_escaped(software.date.substr(0, 4)), latex_escaped(software.license));
}

std::string bibtex(const ResultCitation& result) {
  std::string key = fmt::format("thinwall_{}_{}", result.experiment, result.run_id);
  std::erase_if(key, [](char letter) { return letter != '_' && !std::isalnum(static_cast<unsigned char>(letter)); });
  const std::string commit = result.commit.substr(0, 12) + (result.dirty ? " with uncommitted changes" : "");
  return fmt::format(
      "@misc{{{0},\n  author = {{{2}}},\n  title  = {{{3}}},\n"
      "  note   = {{Result of the thinwall experiment {4}, run {1}, seed {5}, commit {6}}},\n"
      "  date   = {{{7}}},\n  year   = {{{8}}}\n}}\n",
      key, latex_escaped(result.run_id), this_software().authors, latex_escaped(result.question),
      latex_escaped(result.experiment), result.seed, latex_escaped(commit), latex_escaped(result.date),
      latex_escaped(result.date.substr(0, 4)));
}

std::string bibtex(const SoftwareCitation& software, const ResultCitation& result) {
  return bibtex(software) + "\n" + bibtex(result);
}

}  // namespace thinwall
