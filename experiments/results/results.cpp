#include <thinwall/experiments/results/results.hpp>

#include <thinwall/experiments/figures/figure_json.hpp>
#include <thinwall/experiments/figures/plot.hpp>
#include <thinwall/experiments/results/citation.hpp>
#include <thinwall/experiments/results/manifest.hpp>
#include <thinwall/experiments/results/report.hpp>
#include <thinwall/experiments/results/resolved_toml.hpp>
#include <thinwall/experiments/tables/csv.hpp>
#include <thinwall/experiments/tables/shown_table.hpp>
#include <thinwall/experiments/text/file_text.hpp>

namespace thinwall {
namespace {

constexpr std::size_t room_for_a_figure = 1 << 20;  // [byte]

void stage_tables(ResultFolder& folder, const RunRecord& run, const Outcome& outcome) {
  for (const Table& table : outcome.tables) {
    folder.stage("data/" + table.name + ".csv", csv_text(table));
    if (!table.in_report || table.is_timing) continue;  // only data/ may differ from run to run
    folder.stage("tables/" + table.name + ".md", markdown_table(table));
    folder.stage("tables/" + table.name + ".tex", latex_table(table));
  }
  std::string name = "thinwall-" + run.experiment;
  for (char& letter : name) letter = letter == '_' ? '-' : letter;
  // Its description holds no number: an answer may speak of run times, and this file is the same in every run.
  const PackageInfo info{name, run.question, "The answer stands in report.html and manifest.json.", run.build.version};
  folder.stage("datapackage.json", datapackage_text(info, outcome.tables));
}

/// The figures that could be drawn; `why_no_svg` says what was wrong with another.
void stage_figures(ResultFolder& folder, const Outcome& outcome, ReportParts& parts) {
  for (const Figure& figure : outcome.figures) {
    folder.stage("plots/" + figure.name + ".gp", plot_script(figure));
    folder.stage("plots/" + figure.name + ".dat", plot_data(figure));
    folder.stage("plots/" + figure.name + ".json", figure_json(figure));
    const std::string trouble = draw(folder.staging() / "plots", figure.name);
    if (!trouble.empty()) {
      parts.why_no_svg = trouble;
      folder.stage("plots/" + figure.name + ".svg",
                   std::string(room_for_a_figure, ' '));  // throws if that was the trouble
      std::filesystem::remove(folder.staging() / "plots" / (figure.name + ".svg"));
      continue;
    }
    parts.svgs[figure.name] = file_text(folder.staging() / "plots" / (figure.name + ".svg"));
  }
}

/// Takes what differs from run to run out of `hashes`, and returns its paths.
std::vector<std::string> take_timings(std::map<std::string, std::string>& hashes, const Outcome& outcome) {
  std::vector<std::string> out;
  const auto take = [&](const std::string& file) {
    if (hashes.erase(file) > 0) out.push_back(file);
  };
  for (const Table& table : outcome.tables) {
    if (table.is_timing) take("data/" + table.name + ".csv");
  }
  for (const Figure& figure : outcome.figures) {
    if (!figure.is_timing) continue;
    for (const char* kind : {".dat", ".gp", ".json", ".svg"}) take("plots/" + figure.name + kind);
  }
  return out;
}

}  // namespace

std::vector<std::string> write_results(ResultFolder& folder, const RunRecord& run, const Outcome& outcome) {
  ReportParts parts;
  parts.citation = bibtex(this_software(), citation_of(run));
  stage_tables(folder, run, outcome);
  stage_figures(folder, outcome, parts);
  for (const TextFile& file : outcome.files) folder.stage(file.name, file.text);
  folder.stage("cite.bib", parts.citation);
  folder.stage("resolved.toml", resolved_toml(run));

  auto hashes = folder.staged_hashes();
  parts.files = {"manifest.json"};
  for (const auto& [file, hash] : hashes) parts.files.push_back(file);
  folder.stage("report.html", report_page(run, outcome, parts));
  const std::vector<std::string> unhashed = take_timings(hashes, outcome);
  folder.stage("manifest.json", manifest_text(run, outcome, hashes, unhashed));
  folder.publish();
  if (parts.why_no_svg.empty()) return {};
  return {"figures were not drawn: " + parts.why_no_svg};
}

}  // namespace thinwall
