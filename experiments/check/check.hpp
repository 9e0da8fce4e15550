#pragma once
/// Whether a result folder is what its manifest says, and what a result owes its reader.

#include <filesystem>
#include <string>
#include <vector>

namespace thinwall {

/// What is wrong, a line each, beginning with the file; empty if nothing is. Reads every file of the folder.
std::vector<std::string> check_result(const std::filesystem::path& folder);

}  // namespace thinwall
