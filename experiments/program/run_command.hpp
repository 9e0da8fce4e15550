#pragma once
/// `thinwall run`.

#include <iosfwd>
#include <span>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/program/command_line.hpp>

namespace thinwall {

/// Returns the exit code. Results go to `out`, all else to `err`. Throws UsageError for what the user must mend.
int run_command(const CommandLine& given, std::span<const Experiment> experiments, std::ostream& out,
                std::ostream& err);

}  // namespace thinwall
