#include <thinwall/experiments/program/configured_run.hpp>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include <thinwall/experiments/results/resolved_toml.hpp>
#include <thinwall/experiments/scene.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/spelling.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

const Experiment* find_experiment(std::span<const Experiment> experiments, std::string_view name) {
  const auto found = std::ranges::find(experiments, name, &Experiment::name);
  return found == experiments.end() ? nullptr : &*found;
}

bool is_scene(const Experiment& experiment) { return experiment.name == "scene" || experiment.name == "compare"; }

/// What the file is: the value of its key `experiment`; without one, a scene if it has the key `scene`.
std::string experiment_named_in(const std::string& text, const std::string& file,
                                std::span<const std::string_view> names) {
  constexpr std::string_view key = "experiment";
  const Settings settings(text, file, "");
  if (settings.has(key)) return settings.choice(key, names);
  if (settings.has("scene")) return "scene";
  throw UsageError(fmt::format("{}:1: key '{}': missing; it says what the file is, as in {} = \"{}\"; {}",
                               one_line(file), key, key, names.front(), spelling_hint("", names)));
}

/// Every experiment that a file may configure.
std::vector<Experiment> with_scenes(std::span<const Experiment> experiments) {
  std::vector<Experiment> all(experiments.begin(), experiments.end());
  all.push_back(scene_experiment());
  all.push_back(compare_experiment());
  return all;
}

/// A configuration may come from anywhere: it names no programs to start. The command line may.
void choose_benchmarks(Settings& settings, const std::string& folder) {
  constexpr std::string_view key = "benchmarks";
  if (!settings.has(key)) {
    if (!folder.empty()) throw UsageError("--benchmarks: only speed starts other programs");
  } else if (!folder.empty()) {
    settings.assign(key, folder);
  } else if (!settings.text(key).empty()) {
    settings.complain(key, "\"\"; to start the programs of that folder, say so: --benchmarks DIR");
  }
}

ConfiguredRun configured(const Experiment& chosen, Settings& settings, const RunOptions& options) {
  ConfiguredRun out{.experiment = chosen,
                    .name = std::string(chosen.name),
                    .question = std::string(chosen.question),
                    .run = chosen.configure(settings, options),
                    .config = settings.resolved_json()};
  out.default_config = out.config == Settings("", "", chosen.default_toml).resolved_json();
  if (is_scene(chosen)) {
    out.name = (chosen.name == "compare" ? "compare_" : "") + settings.text("scene");
    if (chosen.name == "scene") out.question = settings.text("question");
  }
  return out;
}

}  // namespace

ConfiguredRun configure_again(const RunIdentity& identity, int threads, std::span<const Experiment> experiments) {
  const std::vector<Experiment> all = with_scenes(experiments);
  const Experiment* const chosen = find_experiment(all, identity.experiment);
  if (!chosen) throw UsageError(fmt::format("'{}': unknown experiment", one_line(identity.experiment)));
  RunRecord record;
  record.experiment = identity.experiment;
  record.config = identity.config;
  Settings settings(resolved_toml(record), "configuration", chosen->default_toml);
  settings.reject_unknown_keys();
  ConfiguredRun out = configured(*chosen, settings, {identity.seed, identity.trials, threads});
  RunIdentity again = identity;
  again.config = out.config;  // JSON may spell a number otherwise
  if (const std::string difference = identity_difference(identity_text(again), identity); !difference.empty()) {
    throw UsageError(fmt::format("the configuration reads back as another one ({})", difference));
  }
  return out;
}

std::string read_config(const std::string& file) {
  constexpr std::uintmax_t most = 16 << 20;  // [byte]; no configuration is as long
  const std::string name = one_line(file);
  std::error_code error;
  const auto status = fs::status(file, error);
  if (!fs::exists(status)) throw UsageError(name + ": there is no such file");
  if (!fs::is_regular_file(status)) throw UsageError(name + ": is not a file; a TOML file is needed");
  if (fs::file_size(file, error) > most) throw UsageError(name + ": is too long for a configuration; 16 MiB at most");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw UsageError(name + ": cannot be read: " + std::generic_category().message(errno));
  return text;
}

ConfiguredRun configure_run(const std::string& target, const RunRequest& request,
                            std::span<const Experiment> experiments) {
  const std::vector<Experiment> all = with_scenes(experiments);
  std::vector<std::string_view> names;
  for (const Experiment& experiment : all) names.push_back(experiment.name);

  const Experiment* chosen = request.compare || request.text ? nullptr : find_experiment(experiments, target);
  std::string text, file = std::string(target) + " (built-in)";
  if (!chosen) {
    std::error_code none;
    const bool is_path =
        request.text || target.ends_with(".toml") || target.find('/') != std::string::npos || fs::exists(target, none);
    if (!is_path && !request.compare) {
      throw UsageError(fmt::format("'{}': unknown experiment; {}; or name a TOML file", one_line(target),
                                   spelling_hint(target, std::span(names).first(experiments.size()))));
    }
    file = target;
    text = request.text ? *request.text : read_config(file);
    const std::string named = experiment_named_in(text, file, names);
    chosen = find_experiment(all, request.compare && named == "scene" ? "compare" : named);
  }
  if (request.compare && chosen->name != "compare") {
    throw UsageError(
        fmt::format("{}: is a configuration of {}, not a scene; thinwall run it", one_line(file), chosen->name));
  }
  if (!is_scene(*chosen) && request.trace) throw UsageError("--trace: only a scene has a trace");
  if (!is_scene(*chosen) && !request.plan_kind.empty()) throw UsageError("--plan: only a scene has a plan");

  Settings settings(text, file, chosen->default_toml);
  settings.reject_unknown_keys();
  if (is_scene(*chosen)) settings.assign("experiment", std::string(chosen->name));
  if (request.trace) settings.assign_flag("trace", true);
  if (!request.plan_kind.empty()) settings.assign("plan", request.plan_kind);
  choose_benchmarks(settings, request.benchmarks);
  return configured(*chosen, settings, request.options);
}

}  // namespace thinwall
