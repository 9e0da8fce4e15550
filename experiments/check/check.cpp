#include <thinwall/experiments/check/check.hpp>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include <fmt/format.h>

#include <thinwall/experiments/check/parts.hpp>
#include <thinwall/experiments/results/record.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/file_text.hpp>
#include <thinwall/experiments/text/sha256.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

/// Every file, link and empty folder below the folder, by its path from there.
std::set<std::string> files_below(const fs::path& folder) {
  std::set<std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied)) {
    std::error_code unreadable;
    const bool holds_files = !entry.is_symlink() && entry.is_directory() &&
                             fs::directory_iterator(entry.path(), unreadable) != fs::directory_iterator();
    if (!holds_files) out.insert(entry.path().lexically_relative(folder).generic_string());
  }
  return out;
}

/// What a run at work keeps: journal.tsv, journal.old.tsv, journal.rank-2.tsv.
bool is_journal(std::string_view file) {
  if (file == "journal.tsv" || file == "journal.old.tsv") return true;
  constexpr std::string_view begin = "journal.rank-", end = ".tsv";
  if (!file.starts_with(begin) || !file.ends_with(end) || file.size() <= begin.size() + end.size()) return false;
  const std::string_view rank = file.substr(begin.size(), file.size() - begin.size() - end.size());
  return std::ranges::all_of(rank, [](char letter) { return '0' <= letter && letter <= '9'; });
}

/// What lies there, in words.
const char* kind_of(const fs::path& path) {
  if (fs::is_symlink(path)) return "a link that the manifest does not name";
  return fs::is_directory(path) ? "an empty folder that the manifest does not name" : "the manifest does not name it";
}

/// Each file that the manifest names is there, and unchanged if it has a hash.
void check_named_files(const KeptResult& result, Faults& faults) {
  const auto is_there = [&](const std::string& file) {
    const fs::path path = result.folder / file;
    if (fs::is_regular_file(path)) return true;
    faults.push_back(
        fmt::format("{}: {}; the manifest names it", one_line(file), fs::exists(path) ? "is not a file" : "missing"));
    return false;
  };
  for (const auto& [file, hash] : result.hashes) {
    if (is_there(file) && sha256_of_file(result.folder / file) != hash) {
      faults.push_back(
          fmt::format("{}: was changed since the run wrote it: its SHA-256 is not the manifest's", one_line(file)));
    }
  }
  for (const std::string& file : result.unhashed) is_there(file);
}

/// A figure drawn again from its script, which is there.
bool is_drawn_again(const std::string& file, const std::set<std::string>& found) {
  if (!file.starts_with("plots/")) return false;
  for (const char* ending : {".svg", ".pdf", "-latex.pdf", "-latex.tex"}) {
    if (file.ends_with(ending) && found.contains(file.substr(0, file.size() - std::string_view(ending).size()) + ".gp"))
      return true;
  }
  return false;
}

void check_unknown_files(const KeptResult& result, const std::set<std::string>& found, Faults& faults) {
  std::set<std::string> known = {"manifest.json", "report.html"};
  for (const auto& [file, hash] : result.hashes) known.insert(file);
  known.insert(result.unhashed.begin(), result.unhashed.end());
  for (const std::string& file : found) {
    const bool is_known = known.contains(file) || is_drawn_again(file, found);
    if (is_known && fs::is_symlink(result.folder / file)) {
      faults.push_back(fmt::format("{}: is a link, not the file that the run wrote", one_line(file)));
      continue;
    }
    if (is_known) continue;
    faults.push_back(
        fmt::format("{}: {}", one_line(file),
                    is_journal(file) ? "a run is at work here, or was interrupted" : kind_of(result.folder / file)));
  }
}

void check_tables_are_known(const KeptResult& result, const std::vector<std::string>& tables, Faults& faults) {
  const std::set<std::string> described(tables.begin(), tables.end());
  const auto check = [&](const std::string& file) {
    if (file.starts_with("data/") && file.ends_with(".csv") && !described.contains(file))
      faults.push_back(fmt::format("{}: datapackage.json does not describe it", one_line(file)));
  };
  for (const auto& [file, hash] : result.hashes) check(file);
  for (const std::string& file : result.unhashed) check(file);
}

/// The run id is a hash of what was asked, so a change of that shows.
void check_run_id(const KeptResult& result, Faults& faults) {
  RunRecord run;
  run.experiment = result.citation.experiment;
  run.config = result.config;
  run.seed = result.citation.seed;
  run.trials = result.trials;
  if (const std::string id = run_id(run); id != result.citation.run_id) {
    faults.push_back(fmt::format("manifest.json: run_id is '{}', but its experiment, config, seed and trials give '{}'",
                                 one_line(result.citation.run_id), id));
  }
}

}  // namespace

std::vector<std::string> check_result(const fs::path& folder) {
  const bool complete = fs::exists(folder / "manifest.json");
  if (const std::string shard = complete ? "" : shard_in(folder); !shard.empty())
    return {fmt::format("shard.json: is shard {} of a run; thinwall merge makes a result of all of them", shard)};
  Faults faults;
  const std::vector<std::string> tables = check_data(folder, faults);
  check_figures(folder, faults);
  if (!complete) {
    faults.insert(faults.begin(), "manifest.json: missing; without one a folder is not complete");
    return faults;
  }
  if (!fs::is_regular_file(folder / "manifest.json")) {
    faults.insert(faults.begin(), "manifest.json: is not a file");
    return faults;
  }
  std::optional<KeptResult> result;
  try {
    result = kept_result(folder, "manifest.json");
  } catch (const UsageError& error) {
    faults.insert(faults.begin(), error.what());
    return faults;
  }
  const std::set<std::string> found = files_below(folder);
  check_named_files(*result, faults);
  check_run_id(*result, faults);
  check_unknown_files(*result, found, faults);
  check_tables_are_known(*result, tables, faults);
  check_page(*result, faults);
  check_texts(*result, faults);
  return faults;
}

}  // namespace thinwall
