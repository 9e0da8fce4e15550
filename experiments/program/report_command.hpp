#pragma once
/// `thinwall report`, and the option --figures that `thinwall run` shares with it.

#include <string>
#include <vector>

#include <thinwall/experiments/program/command.hpp>
#include <thinwall/experiments/program/options.hpp>

namespace thinwall {

void add_figures(CLI::App& self, OptionText& figures);

/// The formats in `pdf,tex`; none if it was not given. Throws UsageError.
std::vector<std::string> parse_figures(const OptionText& figures);

Command report_command();

}  // namespace thinwall
