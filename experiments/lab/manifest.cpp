#include <thinwall/experiments/lab/manifest.hpp>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string_view>
#include <thread>

#include <dlfcn.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/utsname.h>
#include <thinwall_build_info.hpp>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const auto value = line.find(": ");
    if (value != std::string::npos) return line.substr(value + 2);
  }
  return "unknown";
}

/// The file that this very code was loaded from: the program, or a module that another program loaded.
std::string file_of_this_code() {
  Dl_info info{};
  void* map = nullptr;
  const auto* const here = reinterpret_cast<const void*>(&this_program_sha256);
  if (::dladdr1(here, &info, &map, RTLD_DL_LINKMAP) == 0 || map == nullptr) return "/proc/self/exe";
  const std::string name = static_cast<const link_map*>(map)->l_name;  // empty for the program itself
  return name.empty() ? "/proc/self/exe" : name;
}

std::string fact_of(const Manifest& manifest, const std::string& name) {
  const auto found = std::ranges::find(manifest.facts, name, &std::pair<std::string, std::string>::first);
  return found == manifest.facts.end() ? "none" : found->second;
}

std::string key_text(const std::string& key) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  return !key.empty() && key.find_first_not_of(plain) == std::string::npos ? key : json_string(key);
}

std::string table_text(const json& table, const std::string& path) {
  std::string values, tables;
  for (const auto& [key, value] : table.items()) {
    if (value.is_object()) {
      const std::string inner = path + (path.empty() ? "" : ".") + key_text(key);
      tables += fmt::format("\n[{}]\n{}", inner, table_text(value, inner));
    } else {
      // A table within a list becomes an inline one.
      values += fmt::format("{} = {}\n", key_text(key), exact_text(value, ", ", " = "));
    }
  }
  return values + tables;
}

constexpr int format_version = 1;

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

/// To BibTeX a brace counts also behind a backslash, so there is none alone.
std::string bibtex_escaped(std::string_view text) {
  std::string out = latex_escaped(text);
  replace_all(out, "\\{", "{\\textbraceleft}");
  replace_all(out, "\\}", "{\\textbraceright}");
  return out;
}

}  // namespace

MachineRecord this_machine() {
  MachineRecord out{
      .cpu = cpu_model(), .system = "unknown", .cores = static_cast<int>(std::thread::hardware_concurrency())};
  if (utsname name{}; uname(&name) == 0) out.system = fmt::format("{} {} {}", name.sysname, name.release, name.machine);
  return out;
}

std::string this_program_sha256() {
  static const std::string hash = sha256_of_file(file_of_this_code());
  return hash;
}

std::string utc_text(std::chrono::system_clock::time_point time) {
  return fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

std::string reproduce_line(const RunRecord& run) {
  const std::string trials = run.trials ? fmt::format(" --trials {}", *run.trials) : "";
  return fmt::format("thinwall run {} --seed {}{} --out {}", run.default_config ? run.experiment : "resolved.toml",
                     run.seed, trials,
                     run.default_config ? "again" : "../again");  // a result within a result is none of it
}

std::string run_id(const RunIdentity& run) {
  const std::string trials = run.trials ? std::to_string(*run.trials) : "default";
  return sha256(fmt::format("{}\n{}\n{}\n{}", run.experiment, run.config, run.seed, trials)).substr(0, 12);
}

std::vector<FactChange> changed_facts(const Manifest& recorded, const Manifest& rerun) {
  std::vector<FactChange> out;
  const auto add = [&](const std::string& name) {
    const FactChange change{name, fact_of(recorded, name), fact_of(rerun, name)};
    if (change.recorded != change.rerun) out.push_back(change);
  };
  for (const auto& [name, value] : recorded.facts) add(name);
  for (const auto& [name, value] : rerun.facts) {
    if (fact_of(recorded, name) == "none") add(name);
  }
  return out;
}

std::string config_toml(const RunIdentity& run) {
  json config = json::parse(run.config);
  config.erase("experiment");
  return fmt::format("experiment = {}\n{}", json_string(run.experiment), table_text(config, ""));
}

std::string resolved_toml(const RunRecord& run) {
  return fmt::format("# To run it again from inside this folder:\n# {}\n{}", reproduce_line(run), config_toml(run));
}

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
  return json_page(out);
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

bool is_unchanged(const fs::path& folder, const std::string& file, const std::string& hash) {
  return holds_file(folder, file) && sha256_of_file(folder / file) == hash;
}

std::vector<std::string> Manifest::files() const {
  std::vector<std::string> out;
  for (const auto& [file, hash] : hashes) out.push_back(file);
  out.insert(out.end(), unhashed.begin(), unhashed.end());
  return out;
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
      .run_id = manifest.text("run_id", is_hex, "hexadecimal digits"),
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
      software.authors, bibtex_escaped(software.title), bibtex_escaped(software.version), bibtex_escaped(software.date),
      bibtex_escaped(software.date.substr(0, 4)), bibtex_escaped(software.license));
}

std::string bibtex(const ResultCitation& result) {
  std::string key = fmt::format("thinwall_{}_{}", result.experiment, result.run_id);
  std::erase_if(key, [](char letter) { return letter != '_' && !std::isalnum(static_cast<unsigned char>(letter)); });
  const std::string commit = result.commit.substr(0, 12) + (result.dirty ? " with uncommitted changes" : "");
  return fmt::format(
      "@misc{{{0},\n  author = {{{2}}},\n  title  = {{{3}}},\n"
      "  note   = {{Result of the thinwall experiment {4}, run {1}, seed {5}, commit {6}}},\n"
      "  date   = {{{7}}},\n  year   = {{{8}}}\n}}\n",
      key, bibtex_escaped(result.run_id), this_software().authors, bibtex_escaped(result.question),
      bibtex_escaped(result.experiment), result.seed, bibtex_escaped(commit), bibtex_escaped(result.date),
      bibtex_escaped(result.date.substr(0, 4)));
}

std::string bibtex(const SoftwareCitation& software, const ResultCitation& result) {
  return bibtex(software) + "\n" + bibtex(result);
}

}  // namespace thinwall
