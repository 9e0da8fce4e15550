#pragma once
/// From the words of the command line to the command that they name.

#include <string>
#include <vector>

#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

/// What to do: a command's action, or one that prints a help text or the version. Throws UsageError.
Action parse_command_line(const std::vector<std::string>& argv);

}  // namespace thinwall
