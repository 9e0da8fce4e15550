#include <thinwall/experiments/results/rerun_comparison.hpp>

#include <algorithm>
#include <map>
#include <set>

#include <thinwall/experiments/text/file_text.hpp>
#include <thinwall/experiments/text/sha256.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::vector<std::string> files_changed_since(const fs::path& result, const Manifest& recorded) {
  std::vector<std::string> out;
  for (const auto& [file, hash] : recorded.hashes) {
    if (!holds_file(result, file) || sha256_of_file(result / file) != hash) out.push_back(file);
  }
  return out;
}

RerunComparison compare_rerun(const fs::path& result, const Manifest& recorded, const std::vector<std::string>& changed,
                              const fs::path& rerun, const Manifest& again) {
  RerunComparison out{.differences = {}, .facts = changed_facts(recorded, again)};
  std::set<std::string> files;
  for (const auto* hashes : {&recorded.hashes, &again.hashes}) {
    for (const auto& [file, hash] : *hashes) files.insert(file);
  }
  out.files = static_cast<int>(files.size());
  bool by_hand = true;
  for (const std::string& file : files) {
    const bool there = recorded.hashes.contains(file) && holds_file(result, file), here = again.hashes.contains(file);
    std::optional<FileDifference> difference;
    if (there && here) {
      difference = first_difference(file, file_text(result / file), file_text(rerun / file));
    } else {
      difference.emplace();
      difference->file = file;
      difference->kind = here ? FileDifference::Kind::only_rerun : FileDifference::Kind::only_recorded;
    }
    if (!difference) continue;
    out.differences.push_back(*difference);
    const auto as_recorded = recorded.hashes.find(file), as_rerun = again.hashes.find(file);
    by_hand = by_hand && std::ranges::find(changed, file) != changed.end() && as_recorded != recorded.hashes.end() &&
              as_rerun != again.hashes.end() && (as_recorded->second == as_rerun->second || file.ends_with(".bib"));
  }
  out.explained_by_hand = by_hand && !out.differences.empty();
  return out;
}

}  // namespace thinwall
