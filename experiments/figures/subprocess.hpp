#pragma once
/// Another program as a function: what it said, and how it ended.

#include <filesystem>
#include <string>
#include <vector>

namespace thinwall {

struct ProcessResult {
  bool found = false;  ///< false: there is no such program
  int status = -1;     ///< its exit code; -1 if a signal ended it
  std::string output;  ///< what it wrote to its stdout and stderr
};

/// Runs `words[0]`, looked up in PATH, from inside `folder` and waits for it. It reads nothing from our stdin.
ProcessResult run_process(const std::vector<std::string>& words, const std::filesystem::path& folder);

}  // namespace thinwall
