#pragma once
/// What a shell completes, taken from the commands themselves, as a script for bash, zsh or fish.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

/// What may stand in a place: words, TOML files, folders.
struct CompletedValue {
  std::vector<std::string> words;
  bool toml = false, folder = false;
};

struct CompletedOption {
  std::string name, meaning;  ///< `--out`
  bool takes_value = false;
  CompletedValue value;
};

struct CompletedCommand {
  std::string name, summary;
  std::vector<CompletedOption> options;
  CompletedValue target;  ///< the words after the command that are no options
};

/// Every command, with the names of the `experiments` where one may stand.
std::vector<CompletedCommand> completed_commands(std::span<const Experiment> experiments);

inline constexpr std::string_view completion_shells[] = {"bash", "zsh", "fish"};

/// `shell` is one of `completion_shells`.
std::string completion_script(std::string_view shell, std::span<const CompletedCommand> commands);

}  // namespace thinwall
