#pragma once
/// `thinwall plan`, and the options of every command that takes a scene.

#include <string>

#include <thinwall/experiments/program/command.hpp>
#include <thinwall/experiments/program/options.hpp>

namespace thinwall {

void add_scene_target(CLI::App& self, std::string& target);
void add_plan_kind(CLI::App& self, OptionText& plan);

/// Throws UsageError if `target` is empty.
void require_scene_target(const char* command, const std::string& target);

/// "lean", "full", or empty if it was not given. Throws UsageError.
std::string parse_plan_kind(const OptionText& plan);

Command plan_command();

}  // namespace thinwall
