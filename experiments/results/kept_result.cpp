#include <thinwall/experiments/results/kept_result.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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

/// Nothing else is a run's: not 3.5, which would be read as 3, nor -1.
bool is_seed(const nlohmann::json& value) { return value.is_number_unsigned(); }
bool is_trials(const nlohmann::json& value) { return value.is_null() || value.is_number_integer(); }

}  // namespace

std::optional<KeptResult> parse_kept_result(const std::string& text) {
  using nlohmann::json;
  const json manifest = json::parse(text, nullptr, false);
  if (!manifest.is_object() || !manifest.contains("thinwall_manifest")) return std::nullopt;
  try {
    const json &config = manifest.at("config"), &trials = manifest.at("trials");
    if (!config.is_object() || !is_trials(trials) || !is_seed(manifest.at("seed"))) return std::nullopt;
    const json& program = manifest.at("program");
    KeptResult out{.folder = {},
                   .answer = manifest.at("answer"),
                   .summary = manifest.at("summary"),
                   .config = canonical(config),
                   .trials = trials.is_null() ? std::nullopt : std::optional(trials.get<std::int64_t>()),
                   .self_test_passed = manifest.at("self_test_passed"),
                   .reproduce = manifest.at("reproduce"),
                   .hashes = manifest.at("files"),
                   .unhashed = manifest.value("files_of_times", std::vector<std::string>{}),
                   .software = this_software(),
                   .citation = {.experiment = manifest.at("experiment"),
                                .question = manifest.at("question"),
                                .run_id = manifest.at("run_id"),
                                .seed = manifest.at("seed"),
                                .commit = program.at("commit"),
                                .dirty = program.at("dirty"),
                                .date = manifest.at("finished").get<std::string>().substr(0, 10)}};
    out.software.version = program.at("version");
    out.software.date = program.value("release_date", out.software.date);
    return out;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

std::string shard_in(const fs::path& folder) {
  const auto seal = parse_seal(file_text(folder / seal_name));
  return seal ? to_text(seal->shard) : "";
}

KeptResult read_result(const fs::path& folder) {
  std::error_code none;
  if (!fs::exists(folder, none)) refuse(folder, "there is no such folder; name the folder of a result");
  if (!fs::is_directory(folder, none)) refuse(folder, "is not a folder; name the folder of a result");
  const fs::path file = folder / "manifest.json";
  if (!fs::exists(file, none)) {
    if (const std::string shard = shard_in(folder); !shard.empty())
      refuse(folder, fmt::format("is shard {} of a run; thinwall merge makes a result of all of them", shard));
    const bool unfinished = fs::exists(folder / "journal.tsv", none);
    refuse(folder, unfinished
                       ? "holds a run that is not finished: no manifest.json yet; the run's own command continues it"
                       : "holds no manifest.json; name the folder of a result, as `thinwall run` leaves it");
  }
  if (!fs::is_regular_file(file, none)) refuse(folder, "its manifest.json is not a file");
  auto result = parse_kept_result(file_text(file));
  if (!result) refuse(folder, "its manifest.json is damaged, or not ours");
  result->folder = folder;
  return std::move(*result);
}

}  // namespace thinwall
