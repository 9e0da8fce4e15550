#include <thinwall/experiments/results/kept_result.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/results/manifest.hpp>
#include <thinwall/experiments/results/result_folder.hpp>
#include <thinwall/experiments/results/shard_seal.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/file_text.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& folder, const std::string& why) {
  throw UsageError(fmt::format("{}: {}", one_line(folder.string()), why));
}

/// The configuration as its run id was computed from: numbers in their shortest form, which JSON may spell otherwise.
std::string canonical(const nlohmann::json& value) {
  std::string out;
  if (value.is_object()) {
    for (const auto& [key, item] : value.items())
      out += (out.empty() ? "" : ",") + json_string(key) + ":" + canonical(item);
    return "{" + out + "}";
  }
  if (value.is_array()) {
    for (const auto& item : value) out += (out.empty() ? "" : ",") + canonical(item);
    return "[" + out + "]";
  }
  if (value.is_string()) return json_string(value.get<std::string>());
  return value.is_number_float() ? exact_text(value.get<double>()) : value.dump();
}

}  // namespace

KeptResult kept_result(const fs::path& folder, const std::string& file) {
  const Manifest manifest = parse_manifest(file_text(folder / manifest_name), file);
  KeptResult out{.folder = folder,
                 .answer = manifest.answer,
                 .summary = manifest.summary,
                 .config = canonical(nlohmann::json::parse(manifest.run.config)),
                 .trials = manifest.run.trials,
                 .self_test_passed = manifest.self_test_passed,
                 .reproduce = manifest.reproduce,
                 .hashes = manifest.hashes,
                 .unhashed = manifest.unhashed,
                 .software = this_software(),
                 .citation = {.experiment = manifest.run.experiment,
                              .question = manifest.question,
                              .run_id = manifest.run_id,
                              .seed = manifest.run.seed,
                              .commit = manifest.commit,
                              .dirty = manifest.dirty,
                              .date = manifest.finished.substr(0, 10)}};
  out.software.version = manifest.version;
  if (!manifest.release_date.empty()) out.software.date = manifest.release_date;
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

}  // namespace thinwall
