#include <thinwall/experiments/results/manifest.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/json_reader.hpp>
#include <thinwall/experiments/run/identity.hpp>

namespace thinwall {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr int format_version = 1;

constexpr const char* hex_words = "hexadecimal digits";

bool is_hex(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool is_commit(std::string_view text) { return text == "unknown" || is_hex(text); }

/// Digits where `form` has a 0, its own letters elsewhere.
bool has_form(std::string_view text, std::string_view form) {
  return std::ranges::equal(text, form, [](char letter, char place) {
    return place == '0' ? '0' <= letter && letter <= '9' : letter == place;
  });
}

bool is_day(std::string_view text) { return has_form(text, "0000-00-00"); }
bool is_time(std::string_view text) { return has_form(text, "0000-00-00T00:00:00Z"); }

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
  const fs::path normal = fs::path(path).lexically_normal();
  return path.find('\0') == std::string::npos && !normal.empty() && normal.is_relative() && *normal.begin() != ".." &&
         *normal.begin() != ".";
}

bool holds_file(const fs::path& folder, const std::string& file) {
  fs::path path = folder;
  std::error_code none;
  for (const fs::path& part : fs::path(file).lexically_normal()) {
    if (fs::is_symlink(path /= part, none)) return false;
  }
  return fs::is_regular_file(path, none);
}

Manifest parse_manifest(const std::string& text, const std::string& file) {
  const JsonReader manifest(text, file);
  manifest.whole("thinwall_manifest", format_version, format_version);
  const JsonReader program = manifest.object("program"), machine = manifest.object("machine");
  Manifest out{
      .run = read_identity(manifest),
      .question = manifest.text("question"),
      .answer = manifest.text("answer"),
      .summary = manifest.text("summary"),
      .run_id = manifest.text("run_id", is_hex, hex_words),
      .reproduce = manifest.text("reproduce"),
      .finished = manifest.text("finished", is_time, "a time as 2031-02-03T04:05:06Z"),
      .self_test_passed = manifest.flag("self_test_passed"),
      .version = program.text("version"),
      .release_date =
          program.has("release_date") ? program.text("release_date", is_day, "a day as 2031-02-03") : std::string(),
      .commit = program.text("commit", is_commit, "hexadecimal digits, or \"unknown\""),
      .dirty = program.flag("dirty"),
      .facts = {},
      .hashes = manifest.named_texts("files"),
      .unhashed = manifest.has("files_of_times") ? manifest.texts("files_of_times") : std::vector<std::string>()};
  out.run.program = program.text("sha256");
  if (!std::ranges::all_of(out.hashes, stays_within, &std::pair<const std::string, std::string>::first))
    manifest.complain("files", "paths within the folder");
  if (!std::ranges::all_of(out.unhashed, stays_within)) manifest.complain("files_of_times", "paths within the folder");
  out.facts = {{"version", out.version},
               {"commit", out.commit + (out.dirty ? " with uncommitted changes" : "")},
               {"compiler", program.text("compiler")},
               {"flags", program.text("flags")},
               {"build type", program.text("build_type")}};
  for (const auto& library : program.named_texts("libraries")) out.facts.emplace_back(library);
  out.facts.emplace_back("program (SHA-256)", out.run.program);
  out.facts.emplace_back("CPU", machine.text("cpu"));
  out.facts.emplace_back("system", machine.text("system"));
  return out;
}

}  // namespace thinwall
