#include <thinwall/experiments/results/manifest.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/run/identity.hpp>

namespace thinwall {
namespace {

using nlohmann::ordered_json;

constexpr int format_version = 1;

ordered_json program(const BuildRecord& build) {
  ordered_json libraries = ordered_json::object();
  for (const auto& [name, version] : build.libraries) libraries[name] = version;
  return {{"version", build.version},       {"release_date", build.release_date}, {"commit", build.commit},
          {"dirty", build.dirty},           {"compiler", build.compiler},         {"flags", build.flags},
          {"build_type", build.build_type}, {"sha256", this_program_sha256()},    {"libraries", libraries}};
}

}  // namespace

std::string manifest_text(const RunRecord& run, const Outcome& outcome,
                          const std::map<std::string, std::string>& hashes, const std::vector<std::string>& unhashed) {
  ordered_json out = {
      {"thinwall_manifest", format_version},
      {"experiment", run.experiment},
      {"question", run.question},
      {"answer", outcome.answer},
      {"self_test_passed", outcome.self_test_passed},
      {"config", ordered_json::parse(run.config)},
      {"seed", run.seed},
      {"trials", run.trials ? ordered_json(*run.trials) : ordered_json()},
      {"run_id", run_id(run)},
      {"reproduce", reproduce_line(run)},
      {"argv", run.argv},
      {"threads", run.threads},
      {"units", run.units},
      {"resumed_units", run.resumed_units},
      {"total_trials", run.total_trials},
      {"started", utc_text(run.started)},
      {"finished", utc_text(run.finished)},
      {"program", program(run.build)},
      {"machine", {{"cpu", run.machine.cpu}, {"hardware_threads", run.machine.cores}, {"system", run.machine.system}}},
      {"files", hashes},
      {"files_of_times", unhashed},
      {"summary", outcome.summary}};
  if (run.ranks > 1) out["ranks"] = run.ranks;
  for (const ShardRecord& shard : run.shards) {
    out["shards"].push_back({{"shard", shard.shard},
                             {"cpu", shard.cpu},
                             {"system", shard.system},
                             {"started", shard.started},
                             {"finished", shard.finished}});
  }
  return out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

bool stays_within(const std::string& path) {
  const std::filesystem::path normal = std::filesystem::path(path).lexically_normal();
  return !normal.empty() && normal.is_relative() && *normal.begin() != ".." && *normal.begin() != ".";
}

std::optional<Manifest> parse_manifest(const std::string& text) {
  using nlohmann::json;
  const json manifest = json::parse(text, nullptr, false);
  if (!manifest.is_object() || manifest.value("thinwall_manifest", json()) != format_version) return std::nullopt;
  try {
    RunIdentity identity{.experiment = manifest.at("experiment"),
                         .config = manifest.at("config").dump(),
                         .seed = manifest.at("seed"),
                         .trials = std::nullopt,
                         .program = manifest.at("program").at("sha256")};
    if (!manifest.at("trials").is_null()) identity.trials = manifest.at("trials").get<std::int64_t>();
    Manifest out{.identity = identity_text(identity),
                 .answer = manifest.at("answer"),
                 .summary = manifest.at("summary"),
                 .self_test_passed = manifest.at("self_test_passed"),
                 .hashes = manifest.at("files"),
                 .unhashed = manifest.value("files_of_times", std::vector<std::string>())};
    const bool ours = std::ranges::all_of(out.unhashed, stays_within) &&
                      std::ranges::all_of(out.hashes, stays_within, &std::pair<const std::string, std::string>::first);
    return ours ? std::optional(std::move(out)) : std::nullopt;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace thinwall
