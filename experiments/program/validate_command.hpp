#pragma once
/// `thinwall validate`.

#include <iosfwd>

#include <thinwall/experiments/program/command_line.hpp>

namespace thinwall {

/// Returns the exit code: 1 if any verdict is wrong. Throws UsageError for what the user must mend.
int validate_command(const CommandLine& line, std::ostream& out, std::ostream& err);

}  // namespace thinwall
