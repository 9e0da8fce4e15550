#pragma once
/// `thinwall plan`.

#include <iosfwd>

#include <thinwall/experiments/program/command_line.hpp>

namespace thinwall {

/// Prints what the scene needs and what is left out. Returns the exit code. Throws UsageError.
int plan_command(const CommandLine& line, std::ostream& out);

}  // namespace thinwall
