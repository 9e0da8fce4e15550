#pragma once
/// What the user asked of the program.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace thinwall {

enum class Command { help, list, run, compare, plan, validate };

struct CommandLine {
  Command command = Command::help;
  std::string text;  ///< help: what to print

  std::string target;  ///< run: an experiment's name, or a TOML file; compare, plan: a scene's; validate: a folder
  std::string out;     ///< run, compare: the result folder; empty for the default
  std::uint64_t seed = 0;
  std::optional<std::int64_t> trials;
  int threads = 1;
  bool dry_run = false;
  bool json = false;
  bool trace = false;     ///< run: of a scene, write what a viewer needs
  std::string plan_kind;  ///< run, compare, plan: "lean" or "full"; empty: as the scene says

  std::vector<std::string> argv;  ///< as it was called
};

/// Throws UsageError.
CommandLine parse_command_line(std::vector<std::string> argv);

}  // namespace thinwall
