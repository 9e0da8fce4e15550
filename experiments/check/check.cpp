#include <thinwall/experiments/check/check.hpp>

#include <fstream>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include <thinwall/experiments/check/parts.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/sha256.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

/// Every file below the folder, by its path from there.
std::set<std::string> files_below(const fs::path& folder) {
  std::set<std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) out.insert(entry.path().lexically_relative(folder).generic_string());
  }
  return out;
}

/// Each file that the manifest names is there, and unchanged if it has a hash.
void check_named_files(const KeptResult& result, const std::set<std::string>& found, Faults& faults) {
  for (const auto& [file, hash] : result.hashes) {
    if (!found.contains(file)) {
      faults.push_back(fmt::format("{}: missing; the manifest names it", one_line(file)));
    } else if (sha256_of_file(result.folder / file) != hash) {
      faults.push_back(
          fmt::format("{}: was changed since the run wrote it: its SHA-256 is not the manifest's", one_line(file)));
    }
  }
  for (const std::string& file : result.unhashed) {
    if (!found.contains(file)) faults.push_back(fmt::format("{}: missing; the manifest names it", one_line(file)));
  }
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
    if (known.contains(file) || is_drawn_again(file, found)) continue;
    const bool journal = file.starts_with("journal.");
    faults.push_back(
        fmt::format("{}: {}", one_line(file),
                    journal ? "a run is at work here, or was interrupted" : "the manifest does not name it"));
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

}  // namespace

std::string file_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> check_result(const fs::path& folder) {
  Faults faults;
  const std::vector<std::string> tables = check_data(folder, faults);
  check_figures(folder, faults);
  if (!fs::exists(folder / "manifest.json")) {
    faults.insert(faults.begin(), "manifest.json: missing; without one a folder is not complete");
    return faults;
  }
  auto result = parse_kept_result(file_text(folder / "manifest.json"));
  if (!result) {
    faults.insert(faults.begin(), "manifest.json: damaged, or not ours");
    return faults;
  }
  result->folder = folder;
  const std::set<std::string> found = files_below(folder);
  check_named_files(*result, found, faults);
  check_unknown_files(*result, found, faults);
  check_tables_are_known(*result, tables, faults);
  check_page(*result, faults);
  check_texts(*result, faults);
  return faults;
}

}  // namespace thinwall
