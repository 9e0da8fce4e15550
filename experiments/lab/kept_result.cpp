#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/report.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/shards.hpp>
#include <thinwall/experiments/lab/svg.hpp>
#include <thinwall/experiments/lab/table_text.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& folder, const std::string& why) {
  throw UsageError(fmt::format("{}: {}", one_line(folder.string()), why));
}

}  // namespace

KeptResult kept_result(const fs::path& folder, const std::string& file) {
  KeptResult out;
  static_cast<Manifest&>(out) = parse_manifest(file_text(folder / manifest_name), file);
  out.folder = folder;
  out.run.config = exact_text(nlohmann::json::parse(out.run.config), ",", ":");
  out.software = this_software();
  out.software.version = out.version;
  if (!out.release_date.empty()) out.software.date = out.release_date;
  out.citation = {.experiment = out.run.experiment,
                  .question = out.question,
                  .run_id = out.run_id,
                  .seed = out.run.seed,
                  .commit = out.commit,
                  .dirty = out.dirty,
                  .date = out.finished.substr(0, 10)};
  return out;
}

std::string shard_in(const fs::path& folder) {
  const auto seal = parse_seal(file_text(folder / seal_name));
  return seal ? to_text(seal->shard) : "";
}

KeptResult read_result(const fs::path& folder) {
  std::error_code none;
  if (!fs::exists(folder, none)) refuse(folder, "there is no such folder; name the folder of a result");
  if (!fs::is_directory(folder, none)) refuse(folder, "is not a folder; name the folder of a result");
  const fs::path file = folder / manifest_name;
  if (!fs::exists(file, none)) {
    if (const std::string shard = shard_in(folder); !shard.empty())
      refuse(folder, fmt::format("is shard {} of a run; thinwall merge makes a result of all of them", shard));
    const bool unfinished = fs::exists(folder / journal_name, none);
    refuse(folder, unfinished
                       ? "holds a run that is not finished: no manifest.json yet; the run's own command continues it"
                       : "holds no manifest.json; name the folder of a result, as `thinwall run` leaves it");
  }
  if (!fs::is_regular_file(file, none)) refuse(folder, "its manifest.json is not a file");
  return kept_result(folder, file.string());
}

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
