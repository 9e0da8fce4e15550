#include <thinwall/experiments/program/configured_run.hpp>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/spelling.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

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

const Experiment* find_experiment(std::span<const Experiment> experiments, std::string_view name) {
  const auto found = std::ranges::find(experiments, name, &Experiment::name);
  return found == experiments.end() ? nullptr : &*found;
}

std::string experiment_named_in(const std::string& text, const std::string& file,
                                std::span<const std::string_view> names) {
  constexpr std::string_view key = "experiment";
  const Settings settings(text, file, "");
  if (!settings.has(key)) {
    throw UsageError(fmt::format("{}:1: key '{}': missing; it says what the file is, as in {} = \"{}\"; {}",
                                 one_line(file), key, key, names.front(), spelling_hint("", names)));
  }
  return settings.choice(key, names);
}

}  // namespace

ConfiguredRun configure_run(const std::string& target, const RunOptions& options,
                            std::span<const Experiment> experiments) {
  std::vector<std::string_view> names;
  for (const Experiment& experiment : experiments) names.push_back(experiment.name);

  ConfiguredRun out{.experiment = find_experiment(experiments, target), .run = nullptr, .config = {}};
  std::string text, file = std::string(target) + " (built-in)";
  if (!out.experiment) {
    const bool is_path = target.ends_with(".toml") || target.find('/') != std::string::npos || fs::exists(target);
    if (!is_path) {
      throw UsageError(fmt::format("'{}': unknown experiment; {}; or name a TOML file", one_line(target),
                                   spelling_hint(target, names)));
    }
    file = target;
    text = read_config(file);
    out.experiment = find_experiment(experiments, experiment_named_in(text, file, names));
  }
  const Settings settings(text, file, out.experiment->default_toml);
  settings.reject_unknown_keys();
  out.run = out.experiment->configure(settings, options);
  out.config = settings.resolved_json();
  out.default_config = out.config == Settings("", "", out.experiment->default_toml).resolved_json();
  return out;
}

}  // namespace thinwall
